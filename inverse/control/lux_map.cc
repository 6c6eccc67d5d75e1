#include "inverse/control/lux_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "inverse/model/fit_uncertainty.h"

namespace luxfit {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

void ExpectScale(const SurfaceScale& scale) {
  if (!(scale.camera_scale > 0)) throw std::invalid_argument("LuxMap: expected a camera scale above 0");
  if (scale.albedo.size() != scale.relative_sigma.size())
    throw std::invalid_argument("LuxMap: expected a sigma for each reflectance");
}

int MaterialOf(const Patches& patches, int element) {
  const int patch = patches.elements.at(static_cast<size_t>(element)).patch;
  return patches.patches[static_cast<size_t>(patch)].material;
}

bool IsKnown(const SurfaceScale& scale, int material) {
  return material < scale.albedo.size() && scale.albedo[material] > 0 &&
         std::isfinite(scale.relative_sigma[material]);
}

double LuxOf(const SurfaceScale& scale, int material, double relative_luminance) {
  return M_PI * relative_luminance / (scale.camera_scale * scale.albedo[material]);
}

PixelGap GapOf(const LuminanceImage& photo, const SurfaceScale& scale, int material, Eigen::Index v,
               Eigen::Index u) {
  if (photo.saturated(v, u)) return PixelGap::kSaturated;
  if (!photo.valid(v, u)) return PixelGap::kDark;
  return IsKnown(scale, material) ? PixelGap::kNone : PixelGap::kReflectanceUnknown;
}

// Returns the relative sigma of camera scale times reflectance. The fit correlates them.
double SigmaOfProduct(const std::string& material, double albedo, const FitUncertainty& uncertainty) {
  const ParameterId camera{ParameterKind::kLogCameraScale, ""}, rho{ParameterKind::kAlbedo, material};
  const double variance = uncertainty.Covariance(camera, camera) +
                          2 * uncertainty.Covariance(camera, rho) / albedo +
                          uncertainty.Covariance(rho, rho) / (albedo * albedo);
  return std::sqrt(std::max(variance, 0.0));
}

}  // namespace

SurfaceScale ScaleOfSurfaces(double camera_scale, const FittedSurfaces& surfaces,
                             const FitUncertainty& uncertainty) {
  const size_t count = surfaces.materials.size();
  if (surfaces.is_known.size() != count || surfaces.albedo.size() != static_cast<Eigen::Index>(count))
    throw std::invalid_argument("ScaleOfSurfaces: expected a reflectance for each material");
  SurfaceScale scale;
  scale.camera_scale = camera_scale;
  scale.albedo = surfaces.albedo;
  scale.relative_sigma = Eigen::VectorXd::Constant(surfaces.albedo.size(), kUnknown);
  scale.relative_model_sigma = uncertainty.relative_model_sigma;
  for (size_t m = 0; m < count; ++m) {
    if (!surfaces.is_known[m]) continue;
    const Eigen::Index i = static_cast<Eigen::Index>(m);
    scale.relative_sigma[i] = SigmaOfProduct(surfaces.materials[m], surfaces.albedo[i], uncertainty);
  }
  return scale;
}

PixelMapOptions DensePixels() {
  PixelMapOptions options;
  options.min_pixels = 1;
  options.centroid_tolerance = std::numeric_limits<double>::infinity();
  return options;
}

LuxMap MapIlluminance(const PixelMap& map, const LuminanceImage& photo, const Patches& patches,
                      const SurfaceScale& scale) {
  ExpectScale(scale);
  const Eigen::Index rows = map.element.rows(), cols = map.element.cols();
  if (photo.relative_luminance.rows() != rows || photo.relative_luminance.cols() != cols)
    throw std::invalid_argument("MapIlluminance: expected a photo of the size of the pixel map");
  LuxMap lux;
  lux.illuminance_lx = lux.sigma_lx = ImagePlane::Constant(rows, cols, kUnknown);
  lux.gap = ImagePlane::Constant(rows, cols, static_cast<float>(PixelGap::kNoSurface));
  Eigen::Index surface = 0, known = 0, saturated = 0;
  for (Eigen::Index v = 0; v < rows; ++v) {
    for (Eigen::Index u = 0; u < cols; ++u) {
      const int element = map.element(v, u);
      if (element < 0) continue;
      ++surface;
      const int material = MaterialOf(patches, element);
      const PixelGap gap = GapOf(photo, scale, material, v, u);
      lux.gap(v, u) = static_cast<float>(gap);
      saturated += gap == PixelGap::kSaturated ? 1 : 0;
      if (gap != PixelGap::kNone) continue;
      ++known;
      const double y = photo.relative_luminance(v, u), lx = LuxOf(scale, material, y);
      const double noise = photo.variance.size() > 0 ? std::sqrt(photo.variance(v, u)) / y : 0;
      lux.illuminance_lx(v, u) = static_cast<float>(lx);
      lux.sigma_lx(v, u) = static_cast<float>(
          lx * std::hypot(noise, std::hypot(scale.relative_sigma[material], scale.relative_model_sigma)));
    }
  }
  if (map.element.size() > 0)
    lux.known_share = static_cast<double>(known) / static_cast<double>(map.element.size());
  if (surface > 0) lux.saturated_share = static_cast<double>(saturated) / static_cast<double>(surface);
  return lux;
}

std::vector<ElementIlluminance> ElementsOf(const std::vector<Observation>& observations,
                                           const Patches& patches, const SurfaceScale& scale) {
  ExpectScale(scale);
  std::vector<ElementIlluminance> elements;
  elements.reserve(observations.size());
  for (const Observation& o : observations) {
    const int material = MaterialOf(patches, o.element);
    if (!IsKnown(scale, material)) continue;
    ElementIlluminance e{o.element, o.pixels, LuxOf(scale, material, o.relative_luminance), 0, 0};
    const double noise = std::hypot(std::sqrt(o.variance) / o.relative_luminance, scale.relative_model_sigma);
    e.random_sigma_lx = e.illuminance_lx * noise;
    e.sigma_lx = e.illuminance_lx * std::hypot(noise, scale.relative_sigma[material]);
    elements.push_back(e);
  }
  return elements;
}

}  // namespace luxfit
