// A lens as an adjustment sees it: a function of one vector of parameters, with derivatives.
//
//   pixel = f(parameters, p_in_cam);  parameters: fx fy cx cy, then distortion coefficients or control points
//
// Everything but the fisheye is libmrcal's; the fisheye is calib/lens/camera.h's. Points that a lens has no image
// of give a projection that is not finite.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_LENS_FUNCTION_H_
#define LUXFIT_CALIB_LENS_INTERNAL_LENS_FUNCTION_H_

#include <Eigen/Core>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/lens/internal/mrcal_lens.h"
#include "calib/lens/lens_kind.h"

namespace luxfit {

struct LensFunction {
  LensKind kind;
  mrcal_lensmodel_t model{};  // of all but the fisheye
};

// `wide` is the plain stereographic camera (SPLINED0) whose image a splined lens has to cover.
LensFunction MakeLensFunction(const LensKind& kind, const Camera& wide);

int ParameterCount(const LensFunction& lens);
// Parameters before this one are held: a splined lens' core says what its control points can say too.
int FirstFreeParameter(const LensFunction& lens);

Camera CameraOf(const LensFunction& lens, const std::vector<double>& parameters, int width_px, int height_px);
std::vector<double> ParametersOf(const LensFunction& lens, const Camera& camera);

struct LensPoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> d_point = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>::Zero();
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> d_parameters;  // empty unless asked for
};
LensPoint ProjectByLens(const LensFunction& lens, const double* parameters, const Eigen::Vector3d& p_in_cam,
                        bool with_parameters);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_LENS_FUNCTION_H_
