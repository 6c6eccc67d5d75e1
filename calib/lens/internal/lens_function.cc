#include "calib/lens/internal/lens_function.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace luxfit {
namespace {

constexpr int kCore = 4;
constexpr int kSplineOrder = 3;  // cubic: its curvature is continuous, as that of glass

// Returns half of the image in stereographic units, along x and y.
Eigen::Vector2d HalfField(const Camera& wide) {
  const Eigen::Vector2d focal(wide.fx_px, wide.fy_px), center(wide.cx_px, wide.cy_px);
  const Eigen::Vector2d size(wide.width_px - 1, wide.height_px - 1);
  return center.cwiseMax(size - center).cwiseQuotient(focal);
}

// Returns a model with as many rows of knots as cover the image's height, with one to spare.
mrcal_lensmodel_t SplinedModel(int knots, const Camera& wide) {
  const Eigen::Vector2d half = HalfField(wide);
  mrcal_lensmodel_t model{};
  model.type = MRCAL_LENSMODEL_SPLINED_STEREOGRAPHIC;
  auto& config = model.LENSMODEL_SPLINED_STEREOGRAPHIC__config;
  config.order = kSplineOrder;
  config.Nx = static_cast<uint16_t>(knots);
  // The corners of the image lie further out than its sides, and the seed's focal length is not exact.
  const double fov_deg = 4 * std::atan(1.03 * half.x() / 2) * 180 / M_PI;
  config.fov_x_deg = static_cast<uint16_t>(std::clamp(std::ceil(fov_deg), 2.0, 350.0));
  constexpr int kMostRows = 128;
  for (int rows = kSplineOrder + 1; rows <= kMostRows; ++rows) {
    config.Ny = static_cast<uint16_t>(rows);
    std::vector<double> ux(static_cast<std::size_t>(knots)), uy(static_cast<std::size_t>(rows));
    if (!mrcal_knots_for_splined_models(ux.data(), uy.data(), &model))
      throw std::invalid_argument("calibration: a splined lens of this field of view has no knots");
    if (uy.back() - (uy[1] - uy[0]) > 1.03 * half.y()) break;
  }
  return model;
}

mrcal_lensmodel_t ModelOf(const LensKind& kind, const Camera& wide) {
  if (OpsOf(kind.lens).has_control_points && kind.knots > 0) return SplinedModel(kind.knots, wide);
  Camera plain;
  plain.lens = kind.lens;
  return ToMrcal(plain, kind.coefficients).model;
}

Camera CoefficientCamera(const LensOps& ops, const double* parameters) {
  Camera camera;
  camera.lens = ops.lens;
  camera.fx_px = parameters[0];
  camera.fy_px = parameters[1];
  camera.cx_px = parameters[2];
  camera.cy_px = parameters[3];
  std::copy(parameters + kCore, parameters + kCore + ops.coefficients, camera.distortion.begin());
  return camera;
}

LensPoint ProjectByOps(const LensOps& ops, const double* parameters, const Eigen::Vector3d& p_in_cam,
                       bool with_parameters) {
  const Camera camera = CoefficientCamera(ops, parameters);
  const Projection projection = ProjectWithJacobian(camera, p_in_cam);
  LensPoint out;
  out.pixel = projection.pixel;
  out.d_point = projection.d_pixel_d_point;
  if (!with_parameters) return out;
  out.d_parameters.setZero(2, kCore + ops.coefficients);
  const Eigen::Vector2d focal(camera.fx_px, camera.fy_px), center(camera.cx_px, camera.cy_px);
  const Eigen::Vector2d xy = (out.pixel - center).cwiseQuotient(focal);
  out.d_parameters(0, 0) = xy.x();
  out.d_parameters(1, 1) = xy.y();
  out.d_parameters(0, 2) = out.d_parameters(1, 3) = 1;
  out.d_parameters.rightCols(ops.coefficients) = focal.asDiagonal() * ops.d_coefficients(camera, p_in_cam);
  return out;
}

}  // namespace

LensFunction MakeLensFunction(const LensKind& kind, const Camera& wide) {
  LensFunction lens;
  lens.kind = kind;
  if (OpsOf(kind.lens).is_in_mrcal) lens.model = ModelOf(kind, wide);
  return lens;
}

int ParameterCount(const LensFunction& lens) {
  const LensOps& ops = OpsOf(lens.kind.lens);
  return ops.is_in_mrcal ? mrcal_lensmodel_num_params(&lens.model) : kCore + ops.coefficients;
}

int FirstFreeParameter(const LensFunction& lens) {
  return OpsOf(lens.kind.lens).has_control_points && lens.kind.knots > 0 ? kCore : 0;
}

Camera CameraOf(const LensFunction& lens, const std::vector<double>& parameters, int width_px,
                int height_px) {
  Camera size;
  size.width_px = width_px;
  size.height_px = height_px;
  const LensOps& ops = OpsOf(lens.kind.lens);
  if (ops.is_in_mrcal) return FromMrcal({lens.model, parameters}, size);
  Camera camera = CoefficientCamera(ops, parameters.data());
  camera.width_px = width_px;
  camera.height_px = height_px;
  return camera;
}

std::vector<double> ParametersOf(const LensFunction& lens, const Camera& camera) {
  std::vector<double> parameters(static_cast<std::size_t>(ParameterCount(lens)), 0.0);
  const std::array<double, kCore> core = {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px};
  std::copy(core.begin(), core.end(), parameters.begin());
  const bool is_splined = OpsOf(lens.kind.lens).has_control_points;
  const std::size_t rest = parameters.size() - kCore;
  if (is_splined && camera.spline.control_points.size() == rest) {
    std::copy(camera.spline.control_points.begin(), camera.spline.control_points.end(),
              parameters.begin() + kCore);
  } else if (!is_splined) {
    std::copy_n(camera.distortion.begin(), rest, parameters.begin() + kCore);
  }
  return parameters;
}

LensPoint ProjectByLens(const LensFunction& lens, const double* parameters, const Eigen::Vector3d& p_in_cam,
                        bool with_parameters) {
  const LensOps& ops = OpsOf(lens.kind.lens);
  if (!ops.is_in_mrcal) return ProjectByOps(ops, parameters, p_in_cam, with_parameters);
  LensPoint out;
  out.pixel.setConstant(std::numeric_limits<double>::quiet_NaN());
  // A pinhole's formula mirrors points behind the camera into the image, where no camera sees them.
  if (!p_in_cam.allFinite() || (ops.is_pinhole && !(p_in_cam.z() > 0))) return out;
  if (with_parameters) out.d_parameters.resize(2, ParameterCount(lens));
  double* const d_parameters = with_parameters ? out.d_parameters.data() : nullptr;
  const auto projection = ProjectByMrcal(lens.model, parameters, p_in_cam, d_parameters);
  if (!projection) return out;
  out.pixel = projection->pixel;
  out.d_point = projection->d_pixel_d_point;
  return out;
}

}  // namespace luxfit
