#include "inverse/albedo/photometric_stereo.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace luxfit {
namespace {

// A mask's border and a saturated highlight each leave half a pixel open.
constexpr double kCentroidSigmaPx = 0.5, kCircleSigmaPx = 0.5;
// Relative tolerance of the variances of a mask's pixels against those of a disc.
constexpr double kRoundness = 0.05;

struct Area {
  double weight = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
};

// Returns the connected area around a pixel and removes it from `bright`.
Area TakeArea(const ImagePlane& image, int row, int column, PixelMask& bright) {
  Area area;
  std::vector<std::pair<int, int>> open{{row, column}};
  bright(row, column) = false;
  while (!open.empty()) {
    const auto [v, u] = open.back();
    open.pop_back();
    const double weight = image(v, u);
    area.weight += weight;
    area.sum += weight * Eigen::Vector2d(u, v);
    for (const auto& [dv, du] : {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
      const int next_v = v + dv, next_u = u + du;
      if (next_v < 0 || next_u < 0 || next_v >= bright.rows() || next_u >= bright.cols()) continue;
      if (!bright(next_v, next_u)) continue;
      bright(next_v, next_u) = false;
      open.emplace_back(next_v, next_u);
    }
  }
  return area;
}

}  // namespace

SphereCircle CircleOfMask(const PixelMask& mask) {
  SphereCircle circle;
  double count = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (Eigen::Index v = 0; v < mask.rows(); ++v) {
    for (Eigen::Index u = 0; u < mask.cols(); ++u) {
      if (!mask(v, u)) continue;
      const Eigen::Vector2d p(static_cast<double>(u), static_cast<double>(v));
      count += 1;
      sum += p;
      squares += p * p.transpose();
    }
  }
  if (count < 100) {
    circle.message = "the mask has " + std::to_string(static_cast<int>(count)) + " pixels; 100 are needed";
    return circle;
  }
  circle.center_px = sum / count;
  circle.radius_px = std::sqrt(count / M_PI);
  const Eigen::Matrix2d variance = squares / count - circle.center_px * circle.center_px.transpose();
  const double expected = circle.radius_px * circle.radius_px / 4;
  if ((variance / expected - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff() > kRoundness)
    circle.message = "the mask is not one whole circle";
  return circle;
}

std::optional<Eigen::Vector3d> SphereNormal(const SphereCircle& circle, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d d = (pixel - circle.center_px) / circle.radius_px;
  const double z2 = 1 - d.squaredNorm();
  if (!(z2 > 0)) return std::nullopt;
  return Eigen::Vector3d(d.x(), -d.y(), std::sqrt(z2));
}

MirrorDirection LightOnMirrorSphere(const ImagePlane& image, const SphereCircle& circle, double share) {
  MirrorDirection result;
  PixelMask bright = PixelMask::Constant(image.rows(), image.cols(), false);
  double brightest = 0;
  const auto inside = [&](Eigen::Index v, Eigen::Index u) {
    return SphereNormal(circle, {static_cast<double>(u), static_cast<double>(v)}).has_value();
  };
  for (Eigen::Index v = 0; v < image.rows(); ++v) {
    for (Eigen::Index u = 0; u < image.cols(); ++u) {
      if (inside(v, u)) brightest = std::max(brightest, static_cast<double>(image(v, u)));
    }
  }
  if (!(brightest > 0)) {
    result.message = "the sphere is black in the image";
    return result;
  }
  for (Eigen::Index v = 0; v < image.rows(); ++v) {
    for (Eigen::Index u = 0; u < image.cols(); ++u)
      bright(v, u) = inside(v, u) && image(v, u) >= share * brightest;
  }
  Area largest;
  for (int v = 0; v < bright.rows(); ++v) {
    for (int u = 0; u < bright.cols(); ++u) {
      if (!bright(v, u)) continue;
      const Area area = TakeArea(image, v, u, bright);
      if (area.weight > largest.weight) largest = area;
    }
  }
  const auto normal = SphereNormal(circle, largest.sum / largest.weight);
  // At the rim one pixel spans many degrees.
  constexpr double kLeastCosine = 0.2;
  if (!normal || normal->z() < kLeastCosine) {
    result.message = "the brightest place on the sphere lies at its rim";
    return result;
  }
  result.to_light = (2 * normal->z() * *normal - Eigen::Vector3d::UnitZ()).normalized();
  result.sigma_rad = 2 * std::hypot(kCentroidSigmaPx, kCircleSigmaPx) / (circle.radius_px * normal->z());
  return result;
}

}  // namespace luxfit
