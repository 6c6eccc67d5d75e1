#include "calib/luminance/internal/blob_contour.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace luxfit {
namespace {

constexpr double kEdgeMarginPx = 3;

// Returns the luminance at a place inside the photo. A value that is not finite counts as bright.
double LuminanceAt(const ImagePlane& luminance, const Eigen::Vector2d& p, double bright) {
  const auto u = static_cast<Eigen::Index>(std::floor(p.x())),
             v = static_cast<Eigen::Index>(std::floor(p.y()));
  const double a = p.x() - static_cast<double>(u), b = p.y() - static_cast<double>(v);
  const auto at = [&](Eigen::Index row, Eigen::Index column) {
    const double value = luminance(row, column);
    return std::isfinite(value) ? std::min(value, bright) : bright;
  };
  return (1 - b) * ((1 - a) * at(v, u) + a * at(v, u + 1)) +
         b * ((1 - a) * at(v + 1, u) + a * at(v + 1, u + 1));
}

// Returns where the luminance falls below the level on the way outwards.
std::optional<Eigen::Vector2d> Crossing(const ImagePlane& luminance, const Eigen::Vector2d& from,
                                        const Eigen::Vector2d& outwards, double level) {
  constexpr double kReachPx = 2, kStepPx = 0.25;
  // A plateau of twice the level is where the level is half.
  const double bright = 2 * level;
  double before = LuminanceAt(luminance, from - kReachPx * outwards, bright);
  for (double along = -kReachPx + kStepPx; along <= kReachPx; along += kStepPx) {
    const double here = LuminanceAt(luminance, from + along * outwards, bright);
    if (before >= level && here < level)
      return from + (along - kStepPx * (level - here) / (before - here)) * outwards;
    before = here;
  }
  return std::nullopt;
}

std::vector<cv::Point> ChainOf(const cv::Mat& labels, const cv::Rect& box, int label) {
  std::vector<std::vector<cv::Point>> chains;
  cv::findContours(labels(box) == label, chains, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE, box.tl());
  return chains.empty() ? std::vector<cv::Point>() : chains.front();
}

// Returns 1 for a chain that turns from x to y, else -1.
double TurnOf(const std::vector<cv::Point>& chain) {
  double twice_area = 0;
  for (size_t i = 0; i < chain.size(); ++i) twice_area += chain[i].cross(chain[(i + 1) % chain.size()]);
  return twice_area >= 0 ? 1 : -1;
}

// Returns the unit normal of the chain, away from the blob. Zero where the chain returns on itself.
Eigen::Vector2d OutwardNormal(const std::vector<cv::Point>& chain, double turn, size_t i) {
  const size_t n = chain.size(), reach = std::min<size_t>(3, std::max<size_t>(1, n / 4));
  const cv::Point along = chain[(i + reach) % n] - chain[(i + n - reach) % n];
  const Eigen::Vector2d normal = turn * Eigen::Vector2d(along.y, -along.x);
  return normal.norm() > 0 ? Eigen::Vector2d(normal.normalized()) : Eigen::Vector2d(0, 0);
}

}  // namespace

std::vector<Eigen::Vector2d> TraceBlobContour(const ImagePlane& luminance, const cv::Mat& labels,
                                              const cv::Rect& box, int label, float level, int points) {
  const std::vector<cv::Point> chain = ChainOf(labels, box, label);
  const Eigen::AlignedBox2d inside(
      Eigen::Vector2d::Constant(kEdgeMarginPx),
      Eigen::Vector2d(static_cast<double>(luminance.cols()) - 1 - kEdgeMarginPx,
                      static_cast<double>(luminance.rows()) - 1 - kEdgeMarginPx));
  std::vector<Eigen::Vector2d> contour;
  const size_t wanted = std::min(chain.size(), static_cast<size_t>(std::max(points, 0)));
  contour.reserve(wanted);
  const double turn = TurnOf(chain);
  for (size_t k = 0; k < wanted; ++k) {
    const size_t i = k * chain.size() / wanted;
    const Eigen::Vector2d from(chain[i].x, chain[i].y), normal = OutwardNormal(chain, turn, i);
    if (!inside.contains(from) || normal.isZero()) continue;
    if (const auto crossing = Crossing(luminance, from, normal, level)) contour.push_back(*crossing);
  }
  return contour;
}

}  // namespace luxfit
