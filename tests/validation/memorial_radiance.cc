// Our merge of Debevec's Stanford Memorial Church against the radiance map that he published:
//   memorial_radiance FOLDER
// FOLDER holds list.txt (file, exposure time in s), the frames it names and memorial.hdr. The frames are
// scans of film, their response unknown: it is estimated from them.
//
// Printed: what was chosen, then the relative difference of our map and the published one over the pixels
// that a frame exposes well, after one free scale (the median ratio), by channel and for luminance. Not our
// error alone: the published map was merged from 16 frames, of which 8 are left, and from scans before they
// were made into PNG and JPEG; and it is rounded to steps (last column, median), which its dim channels share
// with the brightest: blue to several percent.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "calib/luminance/bracket.h"
#include "calib/luminance/response.h"

namespace {

constexpr std::array<const char*, 4> kNames{"red", "green", "blue", "luminance"};

using luxfit::BracketSamples;
using luxfit::CameraResponse;
using luxfit::Photo;
using luxfit::PixelMask;

struct Frame {
  double exposure_s;
  Photo photo;
};

std::vector<Frame> ReadFrames(const std::string& folder) {
  std::ifstream list(folder + "/list.txt");
  std::vector<Frame> frames;
  std::string file;
  for (double exposure_s = 0; list >> file >> exposure_s;)
    frames.push_back({exposure_s, luxfit::ReadPhoto(folder + "/" + file)});
  return frames;
}

cv::Mat View(const luxfit::ImagePlane& plane) {
  return {static_cast<int>(plane.rows()), static_cast<int>(plane.cols()), CV_32F,
          const_cast<float*>(plane.data())};
}

// Edges of the logarithm of counts: alike in all exposures, but for what is dark or saturated in one.
cv::Mat Edges(const Photo& photo) {
  cv::Mat log_counts, horizontal, vertical;
  cv::log(View(photo.rgb_counts[1]) + 5, log_counts);
  cv::Sobel(log_counts, horizontal, CV_32F, 1, 0);
  cv::Sobel(log_counts, vertical, CV_32F, 0, 1);
  cv::Mat edges;
  cv::magnitude(horizontal, vertical, edges);
  return edges;
}

// `moved` as `reference` shows it; itself where they agree to half a pixel.
Photo AlignedTo(const Photo& reference, const Photo& moved) {
  constexpr int kBlock = 96, kStep = 48, kMinBlocks = 12;
  const cv::Mat to = Edges(reference), from = Edges(moved);
  cv::Mat window;
  cv::createHanningWindow(window, {kBlock, kBlock}, CV_32F);
  std::vector<cv::Point2f> at, shifted;
  std::vector<double> lengths;
  for (int v = 24; v + kBlock < to.rows - 24; v += kStep) {
    for (int u = 24; u + kBlock < to.cols - 24; u += kStep) {
      const cv::Rect block(u, v, kBlock, kBlock);
      double peak = 0;
      const cv::Point2d shift = cv::phaseCorrelate(to(block), from(block), window, &peak);
      if (peak < 0.1) continue;
      const cv::Point2f center(u + kBlock / 2.0f, v + kBlock / 2.0f);
      at.push_back(center);
      shifted.push_back(center + cv::Point2f(shift));
      lengths.push_back(cv::norm(shift));
    }
  }
  if (at.size() < kMinBlocks) return moved;
  std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2),
                   lengths.end());
  if (lengths[lengths.size() / 2] < 0.5) return moved;
  const cv::Mat homography = cv::findHomography(at, shifted, cv::RANSAC, 0.5);
  Photo aligned = moved;
  for (luxfit::ImagePlane& plane : aligned.rgb_counts) {
    cv::Mat warped;
    cv::warpPerspective(View(plane), warped, homography, View(plane).size(),
                        cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
    plane = Eigen::Map<const luxfit::ImagePlane>(warped.ptr<float>(), warped.rows, warped.cols);
  }
  return aligned;
}

std::vector<Frame> Aligned(std::vector<Frame> frames) {
  for (size_t i = frames.size() - 1; i-- > 0;) {
    for (int round = 0; round < 3; ++round) frames[i].photo = AlignedTo(frames[i + 1].photo, frames[i].photo);
  }
  return frames;
}

// Registration left pure blue (in the one JPEG frame: black) where a frame does not reach; nothing within 6
// px of such a border pixel is used.
PixelMask InsideAllFrames(const std::vector<Frame>& frames) {
  constexpr int kReach = 6, kBorder = 20;
  const int height = frames[0].photo.height_px(), width = frames[0].photo.width_px();
  PixelMask inside = PixelMask::Constant(height, width, true);
  for (const Frame& frame : frames) {
    const auto& rgb = frame.photo.rgb_counts;
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        const bool is_blue = rgb[0](v, u) < 60 && rgb[1](v, u) < 60 && rgb[2](v, u) > 180;
        const bool is_black = rgb[0](v, u) < 8 && rgb[1](v, u) < 8 && rgb[2](v, u) < 8;
        const bool at_border = std::min({u, v, width - 1 - u, height - 1 - v}) < kBorder;
        if (!at_border || (!is_blue && !is_black)) continue;
        const int top = std::max(0, v - kReach), left = std::max(0, u - kReach);
        inside
            .block(top, left, std::min(height, v + kReach + 1) - top, std::min(width, u + kReach + 1) - left)
            .setConstant(false);
      }
    }
  }
  return inside;
}

BracketSamples SampleFrames(const std::vector<Frame>& frames, const PixelMask& inside) {
  std::vector<luxfit::PixelPlace> places;
  for (const size_t quarter : {1, 2, 3}) {
    const auto more = luxfit::ChooseSamplePixels(frames[quarter * frames.size() / 4].photo, 700, {}, inside);
    places.insert(places.end(), more.begin(), more.end());
  }
  BracketSamples samples;
  const auto rows = static_cast<Eigen::Index>(places.size()),
             columns = static_cast<Eigen::Index>(frames.size());
  samples.exposure_s.resize(columns);
  for (Eigen::MatrixXd& counts : samples.counts) counts.resize(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    const Frame& frame = frames[static_cast<size_t>(j)];
    samples.exposure_s[j] = frame.exposure_s;
    const Eigen::MatrixX3d counts = luxfit::CountsAt(frame.photo, places);
    for (size_t c = 0; c < 3; ++c) samples.counts[c].col(j) = counts.col(static_cast<Eigen::Index>(c));
  }
  return samples;
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The published map's own resolution at a pixel: its channels share one exponent, that of the largest.
double StepOf(const Photo& published, Eigen::Index i) {
  float largest = 0;
  for (const auto& plane : published.rgb_counts) largest = std::max(largest, plane.data()[i]);
  return std::exp2(std::floor(std::log2(largest)) + 1 - 8);
}

void Compare(const std::vector<Frame>& frames, const CameraResponse& response, const Photo& published,
             const PixelMask& inside) {
  luxfit::LuminanceOptions options;
  options.response = response;
  luxfit::BracketMerger merger(options);
  for (const Frame& frame : frames) merger.Add(frame.photo, frame.exposure_s);
  const luxfit::LuminanceImage merged = merger.Merged();
  std::printf("%-10s %8s %9s %9s %9s %9s %9s\n", "", "pixels", "scale", "median %", "68 % %", "95 % %",
              "step %");
  // Channels, then luminance.
  const Eigen::Vector3f weights = options.weights.cast<float>();
  for (size_t c = 0; c < 4; ++c) {
    const luxfit::ImagePlane ours = c < 3 ? merged.relative_rgb[c] : merged.relative_luminance;
    const luxfit::ImagePlane reference = c < 3 ? published.rgb_counts[c]
                                               : luxfit::ImagePlane(weights[0] * published.rgb_counts[0] +
                                                                    weights[1] * published.rgb_counts[1] +
                                                                    weights[2] * published.rgb_counts[2]);
    std::vector<double> ratio, step;
    for (Eigen::Index i = 0; i < inside.size(); ++i) {
      const double theirs = reference.data()[i];
      if (!inside.data()[i] || !merged.valid.data()[i] || !(theirs > 0)) continue;
      ratio.push_back(ours.data()[i] / theirs);
      step.push_back(100 * StepOf(published, i) / theirs);
    }
    const double scale = Quantile(ratio, 0.5);
    std::vector<double> difference;
    difference.reserve(ratio.size());
    for (const double r : ratio) difference.push_back(100 * std::abs(r / scale - 1));
    std::printf("%-10s %8zu %9.5f %9.2f %9.2f %9.2f %9.2f\n", kNames[c], ratio.size(), scale,
                Quantile(difference, 0.5), Quantile(difference, 0.68), Quantile(difference, 0.95),
                Quantile(step, 0.5));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: memorial_radiance FOLDER\n");
    return 2;
  }
  const std::string folder = argv[1];
  try {
    const std::vector<Frame> frames = Aligned(ReadFrames(folder));
    if (frames.size() < 3) throw std::runtime_error(folder + "/list.txt: expected three frames or more");
    const Photo published = luxfit::ReadPhoto(folder + "/memorial.hdr");
    const PixelMask inside = InsideAllFrames(frames);
    const std::vector<BracketSamples> samples{SampleFrames(frames, inside)};
    const luxfit::ResponseEstimate estimate = luxfit::EstimateResponse(samples, {});
    if (!estimate.response) throw std::runtime_error(folder + ": " + estimate.message);
    std::printf("%ld samples; held-out error, counts:\n", static_cast<long>(samples[0].counts[0].rows()));
    for (const luxfit::ResponseScore& score : estimate.scores)
      std::printf("  %-28s %.3f\n", score.method.c_str(), score.held_out_error_counts);
    std::printf("chosen: %s\n", estimate.scores[estimate.chosen].method.c_str());
    Compare(frames, *estimate.response, published, inside);
    std::printf("robertson:\n");
    Compare(frames, luxfit::SolveRobertson(samples, {}), published, inside);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "memorial_radiance: %s\n", error.what());
    return 2;
  }
  return 0;
}
