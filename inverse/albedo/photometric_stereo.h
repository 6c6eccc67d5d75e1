// Photometric stereo: albedo and normal of every pixel of one fixed view under distant lights switched in
// turn.
//
//   v_ik = s_k rho_i f(n_i, l_k) + a         value of pixel i in image k
//
// rho: albedo, n: normal, l_k: direction to the light, s_k: its strength, f and a:
// inverse/albedo/reflectance_curve.h. Frame: x right, y up, z towards the camera (normal maps' own); orthographic.
// Values are linear (relative luminance), in one unit for all images. Albedo comes in that unit over the
// strengths': it is known up to one factor unless a reference of known albedo is in the picture.
//
// Methods, from the plainest:
//   least squares          v = s rho n.l by linear least squares, everything counts
//   without shadows        the same without values below shadow_fraction of the brightest
//   robust                 Cauchy weights on top, so that cast shadows and highlights drop out
//   robust, strengths      strengths unknown: estimated for all pixels at once, up to the albedo's one factor
// The robust ones choose the reflectance curve: every candidate is fitted with a part of the observations
// left out (each pixel leaves out other images) and scored there, mean of min(z^2, 9) by image; taken is the
// curve of fewest parameters within one standard error of the best, of the paired difference between images.
// Directions known to direction_sigma_rad are adjusted within it, the residuals of one image counting as one
// observation (they share their model error): curve and directions trade off, and many pixels would otherwise
// outvote what was measured.
//
// Sigmas contain noise and the shared unknowns; not what f cannot describe.
// Assumes no interreflection worth mentioning, and nothing of the object's shape.
// Throws std::invalid_argument for shapes that do not match, and directions that are not unit vectors.
// Sources: Woodham (1980), "Photometric method for determining surface orientation from multiple images";
// Triggs et al. (2000), sec. 4; Breiman et al. (1984), sec. 3.4 (one-standard-error rule).
#ifndef LUXFIT_INVERSE_ALBEDO_PHOTOMETRIC_STEREO_H_
#define LUXFIT_INVERSE_ALBEDO_PHOTOMETRIC_STEREO_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "inverse/albedo/reflectance_curve.h"

namespace luxfit {

struct StereoData {
  Eigen::MatrixXd value;                // images x pixels; NaN: not valid there (saturated)
  Eigen::Matrix3Xd to_light;            // unit, one an image
  Eigen::VectorXd direction_sigma_rad;  // one an image; empty: directions are exact
  Eigen::VectorXd strength;             // one an image, > 0; empty: all alike
};

enum class StereoMethod { kLeastSquares, kWithoutShadows, kRobust, kRobustStrengths };
std::string ToString(StereoMethod method);

enum class StereoStatus { kDone, kUndetermined };

struct PhotometricStereoOptions {
  StereoMethod method = StereoMethod::kRobust;
  std::vector<CurveKind> curves = AllCurveKinds();  // candidates; one: taken without a comparison
  double shadow_fraction = 0.02;                    // of the brightest value (95 % are below it)
  int choice_pixels = 1000;                         // taken evenly for the comparison of curves
  int max_folds = 6;                                // parts that the comparison leaves out in turn
  bool covariance = true;
};

struct CurveScore {
  CurveKind kind = CurveKind::kLambert;
  double score = 0;           // on what was left out
  double standard_error = 0;  // of its difference from the best
};

struct PhotometricStereo {
  StereoStatus status = StereoStatus::kUndetermined;
  std::string message;               // why undetermined; else what is known up to a factor
  Eigen::VectorXd albedo;            // one a pixel; NaN: fewer than three lights that span the space
  Eigen::Matrix3Xd normal;           // unit; NaN likewise
  Eigen::VectorXd albedo_sigma;      // empty without covariance
  Eigen::VectorXd normal_sigma_rad;  // root mean square angle
  Eigen::Matrix3Xd to_light;         // as adjusted
  Eigen::VectorXd strength;
  ReflectanceCurve curve;
  std::vector<CurveScore> scores;  // empty where nothing was compared
  std::string because;             // of the curve
  Eigen::MatrixXd residual;        // images x pixels, in the unit of the values
  double residual_sigma = 0;       // robust, of what was used
  bool IsUsable() const { return status == StereoStatus::kDone; }
};

PhotometricStereo SolvePhotometricStereo(const StereoData& data,
                                         const PhotometricStereoOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_PHOTOMETRIC_STEREO_H_
