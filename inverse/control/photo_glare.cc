#include "inverse/control/photo_glare.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calib/lens/camera.h"
#include "forward/views/glare.h"
#include "inverse/control/pixel_groups.h"

namespace luxfit {
namespace {

// A fisheye of 180 degrees whose border loses a pixel still counts as whole.
constexpr double kWholeCoverage = 0.98;

void ExpectGlareInputs(const ImagePlane& luminance, const PixelMask& clipped, const PixelField& field,
                       const PhotoGlareOptions& options) {
  const auto& omega = field.solid_angle_sr;
  if (luminance.rows() != omega.rows() || luminance.cols() != omega.cols() ||
      clipped.rows() != omega.rows() || clipped.cols() != omega.cols())
    throw std::invalid_argument("GlareOfPhoto: expected a photo of the camera's size");
  if (!(options.threshold_cd_m2 > 0) || options.threshold_over_mean < 0)
    throw std::invalid_argument("GlareOfPhoto: threshold: expected > 0");
}

Observer ObserverOf(const Eigen::Matrix3d& level_from_cam) {
  return {Eigen::Vector3d::Zero(), level_from_cam.col(2)};
}

// Sums the groups of one mask into sources, which are appended.
void AddSources(const PixelMask& mask, const ImagePlane& luminance, const PixelMask& clipped,
                const PixelField& field, double merge_angle_rad, std::vector<PhotoGlareSource>& sources) {
  const PixelGroups groups = GroupPixels(mask, field.directions, merge_angle_rad);
  const size_t first = sources.size();
  sources.resize(first + static_cast<size_t>(groups.count));
  for (size_t k = first; k < sources.size(); ++k) sources[k].direction.setZero();
  for (Eigen::Index i = 0; i < mask.size(); ++i) {
    if (groups.group.data()[i] < 0) continue;
    PhotoGlareSource& source = sources[first + static_cast<size_t>(groups.group.data()[i])];
    const double omega = field.solid_angle_sr.data()[i], flux = luminance.data()[i] * omega;
    const Eigen::Vector3d direction = field.directions.col(i).cast<double>();
    ++source.pixels;
    source.solid_angle_sr += omega;
    source.luminance_cd_m2 += flux;
    source.illuminance_lx += flux * direction.z();
    source.direction += omega * direction;
    source.is_clipped = source.is_clipped || clipped.data()[i];
  }
  for (size_t k = first; k < sources.size(); ++k) {
    sources[k].luminance_cd_m2 /= sources[k].solid_angle_sr;
    sources[k].direction.normalize();
  }
}

// Tells whether a group of clipped pixels shows nothing above the threshold. Their margin may be darker.
bool HidesSource(const ImagePlane& luminance, const PixelMask& clipped, const PixelField& field,
                 double threshold_cd_m2, double merge_angle_rad) {
  const PixelMask seen = clipped && field.solid_angle_sr > 0.0f;
  const PixelGroups groups = GroupPixels(seen, field.directions, merge_angle_rad);
  std::vector<float> most(static_cast<size_t>(groups.count), 0.0f);
  for (Eigen::Index i = 0; i < seen.size(); ++i) {
    if (groups.group.data()[i] < 0) continue;
    float& of_group = most[static_cast<size_t>(groups.group.data()[i])];
    of_group = std::max(of_group, luminance.data()[i]);
  }
  return std::any_of(most.begin(), most.end(), [&](float cd_m2) { return cd_m2 <= threshold_cd_m2; });
}

double Weight(const PhotoGlareSource& source) {
  return source.luminance_cd_m2 * source.luminance_cd_m2 * source.solid_angle_sr;
}

}  // namespace

PixelField FieldOf(const Camera& camera) {
  PixelField field;
  field.directions = UnprojectAllPixels(camera);
  field.solid_angle_sr = ImagePlane::Zero(camera.height_px, camera.width_px);
  tbb::parallel_for(0, camera.height_px, [&](int v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const Eigen::Vector3d d =
          field.directions.col(static_cast<Eigen::Index>(v) * camera.width_px + u).cast<double>();
      if (!d.allFinite() || !(d.z() > 0)) continue;
      const Eigen::Matrix<double, 2, 3> jacobian = ProjectWithJacobian(camera, d).d_pixel_d_point;
      // The determinant on the plane that d is normal to.
      const double det = jacobian.row(0).transpose().cross(jacobian.row(1).transpose()).dot(d);
      if (std::isfinite(det) && det != 0) field.solid_angle_sr(v, u) = static_cast<float>(1 / std::abs(det));
    }
  });
  double projected_sr = 0;
  for (Eigen::Index i = 0; i < field.solid_angle_sr.size(); ++i)
    if (field.solid_angle_sr.data()[i] > 0)
      projected_sr += field.solid_angle_sr.data()[i] * field.directions(2, i);
  field.coverage = projected_sr / M_PI;
  return field;
}

Eigen::Matrix3d UprightCamera() {
  Eigen::Matrix3d level_from_cam;
  level_from_cam << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return level_from_cam;
}

PhotoGlare GlareOfPhoto(const ImagePlane& luminance_cd_m2, const PixelMask& clipped, const PixelField& field,
                        const Eigen::Matrix3d& level_from_cam, const PhotoGlareOptions& options) {
  ExpectGlareInputs(luminance_cd_m2, clipped, field, options);
  // NaN is left out, too.
  const ImagePlane luminance =
      (field.solid_angle_sr > 0.0f && luminance_cd_m2 > 0.0f).select(luminance_cd_m2, 0.0f);
  PhotoGlare glare;
  double sum_omega = 0, sum_flux = 0;
  for (Eigen::Index i = 0; i < luminance.size(); ++i) {
    const double omega = field.solid_angle_sr.data()[i];
    if (!(omega > 0)) continue;
    sum_omega += omega;
    sum_flux += omega * luminance.data()[i];
    glare.seen_lx += omega * luminance.data()[i] * field.directions(2, i);
    glare.is_clipped = glare.is_clipped || clipped.data()[i];
  }
  glare.threshold_cd_m2 = options.threshold_over_mean > 0 ? options.threshold_over_mean * sum_flux / sum_omega
                                                          : options.threshold_cd_m2;
  if (glare.is_clipped)
    glare.is_hidden = HidesSource(luminance, clipped, field, glare.threshold_cd_m2, options.merge_angle_rad);
  const auto threshold = static_cast<float>(glare.threshold_cd_m2),
             peak = static_cast<float>(std::max(options.peak_cd_m2, glare.threshold_cd_m2));
  AddSources(luminance > peak, luminance, clipped, field, options.merge_angle_rad, glare.sources);
  AddSources(luminance > threshold && luminance <= peak, luminance, clipped, field, options.merge_angle_rad,
             glare.sources);
  const Observer observer = ObserverOf(level_from_cam);
  double sources_lx = 0, sources_projected_sr = 0;
  for (PhotoGlareSource& source : glare.sources) {
    const Eigen::Vector3d towards = level_from_cam * source.direction;
    source.ugr_index = PositionIndex(observer, towards);
    source.hemisphere_index = HemisphereIndex(observer, towards);
    sources_lx += source.illuminance_lx;
    sources_projected_sr += source.illuminance_lx / source.luminance_cd_m2;
  }
  std::sort(glare.sources.begin(), glare.sources.end(), [](const auto& a, const auto& b) {
    return Weight(a) / std::pow(a.hemisphere_index, 2) > Weight(b) / std::pow(b.hemisphere_index, 2);
  });
  const double background_sr = field.coverage * M_PI - sources_projected_sr;
  if (background_sr > 0) glare.seen_background_cd_m2 = (glare.seen_lx - sources_lx) / background_sr;
  glare.is_whole = field.coverage >= kWholeCoverage;
  glare.is_vertical_given = options.vertical_lx.has_value();
  if (glare.is_vertical_given) {
    glare.vertical_lx = options.vertical_lx;
  } else if (glare.is_whole) {
    glare.vertical_lx = glare.seen_lx;
  }
  return glare;
}

GlareRating RatingOf(const PhotoGlare& glare, double luminance_factor) {
  const double k = luminance_factor;
  double ugr_sum = 0, dgp_sum = 0, sources_lx = 0;
  for (const PhotoGlareSource& source : glare.sources) {
    const double weight = k * k * Weight(source);
    sources_lx += k * source.illuminance_lx;
    dgp_sum += weight / (source.hemisphere_index * source.hemisphere_index);
    if (std::isfinite(source.ugr_index)) ugr_sum += weight / (source.ugr_index * source.ugr_index);
  }
  GlareRating rating;
  const bool is_partial = !glare.is_whole || glare.is_clipped;
  rating.dgp_bound = is_partial ? GlareBound::kAtLeast : GlareBound::kValue;
  rating.ugr_bound = glare.vertical_lx ? rating.dgp_bound : GlareBound::kOfWhatIsSeen;
  rating.background_cd_m2 = k * glare.seen_background_cd_m2;
  if (glare.vertical_lx) {
    const double vertical_lx = *glare.vertical_lx * (glare.is_vertical_given ? 1 : k);
    rating.background_cd_m2 = (vertical_lx - sources_lx) / M_PI;
    if (vertical_lx > 0) rating.dgp = DaylightGlareProbability(dgp_sum, vertical_lx);
  }
  const bool is_known = glare.is_vertical_given || !glare.is_hidden;
  if (ugr_sum > 0 && rating.background_cd_m2 > 0 && is_known)
    rating.ugr = UnifiedGlareRating(ugr_sum, rating.background_cd_m2);
  return rating;
}

}  // namespace luxfit
