#include "calib/lens/internal/mrcal_lens.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

mrcal_lensmodel_t PlainModel(mrcal_lensmodel_type_t type) {
  mrcal_lensmodel_t model{};
  model.type = type;
  return model;
}

MrcalLens SplinedToMrcal(const Camera& camera) {
  const LensSpline& spline = camera.spline;
  MrcalLens lens{PlainModel(MRCAL_LENSMODEL_STEREOGRAPHIC),
                 {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px}};
  if (spline.control_points.empty()) return lens;
  const auto count = 2 * static_cast<std::size_t>(spline.nx) * static_cast<std::size_t>(spline.ny);
  if ((spline.order != 2 && spline.order != 3) || spline.nx <= spline.order || spline.ny <= spline.order ||
      spline.fov_x_deg <= 0 || spline.fov_x_deg >= 360 || spline.control_points.size() != count) {
    throw std::invalid_argument(
        "camera: splined lens: expected order 2 or 3, more control points than the order along x and y, "
        "fov_x_deg in 1..359 and 2 nx ny numbers");
  }
  lens.model.type = MRCAL_LENSMODEL_SPLINED_STEREOGRAPHIC;
  auto& config = lens.model.LENSMODEL_SPLINED_STEREOGRAPHIC__config;
  config.order = static_cast<uint16_t>(spline.order);
  config.Nx = static_cast<uint16_t>(spline.nx);
  config.Ny = static_cast<uint16_t>(spline.ny);
  config.fov_x_deg = static_cast<uint16_t>(spline.fov_x_deg);
  lens.intrinsics.insert(lens.intrinsics.end(), spline.control_points.begin(), spline.control_points.end());
  return lens;
}

}  // namespace

MrcalLens ToMrcal(const Camera& camera, int min_coefficients) {
  const LensOps& ops = OpsOf(camera.lens);
  if (!ops.is_in_mrcal)
    throw std::invalid_argument("camera: libmrcal has no lens of the family " + std::string(ops.key));
  if (ops.has_control_points) return SplinedToMrcal(camera);
  int used = min_coefficients;
  for (int i = 0; i < 12; ++i) {
    if (camera.distortion[static_cast<std::size_t>(i)] != 0) used = std::max(used, i + 1);
  }
  const auto type = used > 8   ? MRCAL_LENSMODEL_OPENCV12
                    : used > 5 ? MRCAL_LENSMODEL_OPENCV8
                    : used > 4 ? MRCAL_LENSMODEL_OPENCV5
                               : MRCAL_LENSMODEL_OPENCV4;
  MrcalLens lens{PlainModel(type), {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px}};
  const int coefficients = mrcal_lensmodel_num_params(&lens.model) - 4;
  lens.intrinsics.insert(lens.intrinsics.end(), camera.distortion.begin(),
                         camera.distortion.begin() + coefficients);
  return lens;
}

std::optional<Projection> ProjectByMrcal(const mrcal_lensmodel_t& model, const double* intrinsics,
                                         const Eigen::Vector3d& p_in_cam, double* d_intrinsics) {
  mrcal_point3_t p{};
  mrcal_point2_t q{};
  mrcal_point3_t gradient[2];
  p.x = p_in_cam.x();
  p.y = p_in_cam.y();
  p.z = p_in_cam.z();
  if (!mrcal_project(&q, gradient, d_intrinsics, &p, 1, &model, intrinsics)) return std::nullopt;
  Projection projection{{q.x, q.y}, {}};
  for (int row = 0; row < 2; ++row)
    projection.d_pixel_d_point.row(row) << gradient[row].x, gradient[row].y, gradient[row].z;
  return projection;
}

Camera FromMrcal(const MrcalLens& lens, const Camera& size) {
  const std::vector<double>& in = lens.intrinsics;
  const auto type = lens.model.type;
  const bool is_splined = type == MRCAL_LENSMODEL_SPLINED_STEREOGRAPHIC;
  const bool is_opencv = type == MRCAL_LENSMODEL_PINHOLE || MRCAL_LENSMODEL_IS_OPENCV(type);
  if (!is_opencv && !is_splined && type != MRCAL_LENSMODEL_STEREOGRAPHIC)
    throw std::invalid_argument(
        "camera: expected a pinhole, OPENCV4/5/8/12, stereographic or splined "
        "stereographic model, got " +
        std::string(mrcal_lensmodel_name_unconfigured(&lens.model)));
  if (static_cast<int>(in.size()) != mrcal_lensmodel_num_params(&lens.model))
    throw std::invalid_argument("camera: wrong number of intrinsics for the lens model");
  Camera camera;
  camera.width_px = size.width_px;
  camera.height_px = size.height_px;
  camera.fx_px = in[0];
  camera.fy_px = in[1];
  camera.cx_px = in[2];
  camera.cy_px = in[3];
  if (is_opencv) {
    std::copy(in.begin() + 4, in.end(), camera.distortion.begin());
    return camera;
  }
  camera.lens = LensModel::kSplined;
  if (is_splined) {
    const auto& config = lens.model.LENSMODEL_SPLINED_STEREOGRAPHIC__config;
    camera.spline = {config.order, config.Nx, config.Ny, config.fov_x_deg, {in.begin() + 4, in.end()}};
    ToMrcal(camera);  // throws where the numbers do not agree
  }
  return camera;
}

}  // namespace luxfit
