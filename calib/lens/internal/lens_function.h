// Makes a lens a function of one vector of parameters, with derivatives, as adjustments need it.
//
//   pixel = f(parameters, p_in_cam);  parameters: fx fy cx cy, then distortion coefficients or control points
//
// libmrcal projects the lenses that it knows, calib/lens/lens_family.h the others. The projection is not finite
// where the lens has no image of the point.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_LENS_FUNCTION_H_
#define LUXFIT_CALIB_LENS_INTERNAL_LENS_FUNCTION_H_

#include <Eigen/Core>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/lens/internal/mrcal_lens.h"
#include "calib/lens/lens_family.h"

namespace luxfit {

struct LensFunction {
  LensKind kind;
  mrcal_lensmodel_t model{};  // set for lenses that libmrcal knows
};

// Returns the function of a kind of lens. `wide` is the plain stereographic camera (splined0) whose image a
// splined lens has to cover.
LensFunction MakeLensFunction(const LensKind& kind, const Camera& wide);

int ParameterCount(const LensFunction& lens);
// Returns the index of the first free parameter; those before it are held. The control points of a splined
// lens can express all that its core (fx fy cx cy) does.
int FirstFreeParameter(const LensFunction& lens);

// Convert a lens' parameters to a camera and back. ParametersOf fills with 0 what the camera lacks.
Camera CameraOf(const LensFunction& lens, const std::vector<double>& parameters, int width_px, int height_px);
std::vector<double> ParametersOf(const LensFunction& lens, const Camera& camera);

struct LensPoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> d_point = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>::Zero();
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> d_parameters;  // empty unless asked for
};
// Projects a point; d_point is 2 x 3, d_parameters 2 x parameters.
LensPoint ProjectByLens(const LensFunction& lens, const double* parameters, const Eigen::Vector3d& p_in_cam,
                        bool with_parameters);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_LENS_FUNCTION_H_
