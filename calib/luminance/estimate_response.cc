#include "calib/luminance/response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "calib/luminance/internal/held_out_exposures.h"
#include "calib/luminance/internal/response_levels.h"
#include "calib/luminance/internal/response_noise.h"

namespace luxfit {
namespace {

// Returns one curve for all channels, from shares of full scale to shares of full exposure.
CameraResponse FixedResponse(double full_scale_counts, double (*decoded)(double)) {
  const Eigen::VectorXd share = Eigen::VectorXd::LinSpaced(kResponseLevels, 0, 1);
  const Eigen::VectorXd curve = share.unaryExpr(decoded);
  return {full_scale_counts * share, {curve, curve, curve}};
}

double LinearDecoded(double share) { return share; }

// Decodes sRGB; IEC 61966-2-1.
double SrgbDecoded(double share) {
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

// Solves for the power of the light before the curve of sRGB: makers bend theirs. Least squares of the steps of ln s,
// s = light by sRGB, between one exposure and the next, each step with the noise of equal counts.
CameraResponse SolveSrgbPower(const std::vector<BracketSamples>& brackets, const ResponseOptions& options) {
  const CameraResponse srgb = FixedResponse(options.full_scale_counts, SrgbDecoded);
  double top = 0, bottom = 0;
  for (const BracketSamples& bracket : brackets) {
    for (size_t c = 0; c < 3; ++c) {
      const Eigen::MatrixXd& counts = bracket.counts[c];
      for (Eigen::Index j = 1; j < counts.cols(); ++j) {
        const double step = std::log(bracket.exposure_s[j] / bracket.exposure_s[j - 1]);
        for (Eigen::Index i = 0; i < counts.rows(); ++i) {
          const double from = counts(i, j - 1), to = counts(i, j);
          if (!IsInRange(from, options) || !IsInRange(to, options)) continue;
          const double darker = std::min(from, to), light = srgb.Exposure(c, darker);
          const double weight = std::pow(light / srgb.Slope(c, darker), 2);
          top += weight * step * step;
          bottom += weight * step * std::log(srgb.Exposure(c, to) / srgb.Exposure(c, from));
        }
      }
    }
  }
  constexpr double kLeast = 0.3, kMost = 3;
  const double power = bottom > 0 ? std::clamp(top / bottom, kLeast, kMost) : 1;
  const Eigen::VectorXd curve = srgb.exposure(0).array().pow(power);
  return {srgb.counts(), {curve, curve, curve}};
}

constexpr size_t kFixedCurves = 3;  // number of candidates, the first, with one parameter at most

// Returns the candidates, from the one that assumes most to the one that assumes least.
std::vector<std::pair<std::string, ResponseSolver>> Candidates(const ResponseOptions& options) {
  std::vector<std::pair<std::string, ResponseSolver>> candidates{
      {"linear", [&options](const auto&) { return FixedResponse(options.full_scale_counts, LinearDecoded); }},
      {"sRGB", [&options](const auto&) { return FixedResponse(options.full_scale_counts, SrgbDecoded); }},
      {"sRGB to a power", [&options](const std::vector<BracketSamples>& training) {
         return SolveSrgbPower(training, options);
       }}};
  for (const double smoothing : {1e3, 1.0, 1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4}) {
    candidates.push_back({fmt::format("debevec, smoothing {:g}", smoothing),
                          [&options, smoothing](const std::vector<BracketSamples>& training) {
                            return SolveDebevec(training, options, smoothing);
                          }});
  }
  candidates.push_back({"robertson", [&options](const std::vector<BracketSamples>& training) {
                          return SolveRobertson(training, options);
                        }});
  return candidates;
}

// Says why these samples determine no response; empty where they do.
std::string Lack(const std::vector<BracketSamples>& brackets, const ResponseOptions& options) {
  Eigen::Index exposures = 0;
  double ratio = 1;
  bool overlaps = false;
  for (const BracketSamples& bracket : brackets) {
    if (bracket.exposure_s.size() < 2) continue;
    exposures = std::max(exposures, bracket.exposure_s.size());
    ratio = std::max(ratio, bracket.exposure_s.maxCoeff() / bracket.exposure_s.minCoeff());
    for (Eigen::Index i = 0; i < bracket.counts[1].rows() && !overlaps; ++i) {
      Eigen::Index in_range = 0;
      for (Eigen::Index j = 0; j < bracket.counts[1].cols(); ++j)
        in_range += IsInRange(bracket.counts[1](i, j), options) ? 1 : 0;
      overlaps = in_range > 1;
    }
  }
  if (exposures < 2) return "no view has two exposures of one state";
  if (ratio < 2) return "exposures differ by less than a factor of two";
  return overlaps ? "" : "no surface is well exposed in two exposures";
}

// Returns what pairs of exposures leave open of a free curve, as the standard deviation of ln X: ripples, which
// smoothness keeps within 5 % for every stop beyond the first between the two.
double RippleSigma(const std::vector<BracketSamples>& brackets) {
  constexpr double kSigmaPerStop = 0.05;
  double stops = std::numeric_limits<double>::infinity();
  for (const BracketSamples& bracket : brackets)
    stops = std::min(stops, std::log2(bracket.exposure_s.maxCoeff() / bracket.exposure_s.minCoeff()));
  return kSigmaPerStop * std::max(0.0, stops - 1);
}

}  // namespace

CameraResponse SrgbResponse(double full_scale_counts) {
  constexpr double kSigma = 0.05;
  const CameraResponse response = FixedResponse(full_scale_counts, SrgbDecoded);
  const Eigen::VectorXd sigma = Eigen::VectorXd::Constant(response.counts().size(), kSigma);
  return response.WithRelativeSigma({sigma, sigma, sigma});
}

ResponseEstimate EstimateResponse(const std::vector<BracketSamples>& brackets,
                                  const ResponseOptions& options) {
  ResponseEstimate estimate;
  estimate.message = Lack(brackets, options);
  if (!estimate.message.empty()) return estimate;
  const auto candidates = Candidates(options);
  std::vector<Eigen::ArrayXd> errors;
  errors.reserve(candidates.size());
  estimate.scores.reserve(candidates.size());
  for (const auto& [name, solve] : candidates) {
    errors.push_back(HeldOutErrors(brackets, options, solve));
    estimate.scores.push_back({name, MeanError(errors.back())});
  }
  estimate.chosen = SimplestOfBest(errors);
  const CameraResponse response = candidates[estimate.chosen].second(brackets);
  std::array<Eigen::VectorXd, 3> sigma = RelativeSigma(brackets, response, options);
  if (AreOnlyPairs(brackets) && estimate.chosen >= kFixedCurves) {
    for (Eigen::VectorXd& of_channel : sigma)
      of_channel = (of_channel.array().square() + std::pow(RippleSigma(brackets), 2)).sqrt();
  }
  estimate.response = response.WithRelativeSigma(std::move(sigma));
  return estimate;
}

std::vector<PixelPlace> ChooseSamplePixels(const Photo& photo, size_t count, const ResponseOptions& options,
                                           const PixelMask& allowed) {
  constexpr int kRadius = 2;
  constexpr size_t kBins = 32;
  struct Candidate {
    float spread;
    PixelPlace place;
  };
  std::array<std::vector<Candidate>, kBins> bins;
  const ImagePlane& green = photo.rgb_counts[1];
  // Every third pixel: neighbours say the same.
  for (int v = kRadius; v + kRadius < photo.height_px(); v += 3) {
    for (int u = kRadius; u + kRadius < photo.width_px(); u += 3) {
      if (!IsInRange(green(v, u), options)) continue;
      const Eigen::Index size = 2 * kRadius + 1;
      if (allowed.size() > 0 && !allowed.block(v - kRadius, u - kRadius, size, size).all()) continue;
      const auto around = green.block(v - kRadius, u - kRadius, size, size);
      const size_t bin = std::min(kBins - 1, static_cast<size_t>(green(v, u) / options.full_scale_counts *
                                                                 static_cast<double>(kBins)));
      bins[bin].push_back({around.maxCoeff() - around.minCoeff(), {u, v}});
    }
  }
  std::vector<PixelPlace> places;
  places.reserve(count);
  for (std::vector<Candidate>& bin : bins) {
    const size_t taken = std::min(bin.size(), std::max<size_t>(1, count / kBins));
    std::partial_sort(bin.begin(), bin.begin() + static_cast<std::ptrdiff_t>(taken), bin.end(),
                      [](const Candidate& a, const Candidate& b) {
                        return std::tie(a.spread, a.place.v, a.place.u) <
                               std::tie(b.spread, b.place.v, b.place.u);
                      });
    for (size_t i = 0; i < taken; ++i) places.push_back(bin[i].place);
  }
  return places;
}

Eigen::MatrixX3d CountsAt(const Photo& photo, const std::vector<PixelPlace>& places) {
  Eigen::MatrixX3d counts(static_cast<Eigen::Index>(places.size()), 3);
  for (size_t i = 0; i < places.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) {
      const auto around = photo.rgb_counts[c].block<3, 3>(places[i].v - 1, places[i].u - 1);
      counts(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = static_cast<double>(around.mean());
    }
  }
  return counts;
}

}  // namespace luxfit
