// Computes albedo and normal of every pixel of a fixed view under distant lights switched in turn.
//
//   v_ik = s_k rho_i f(n_i, l_k) + a         value of pixel i in image k
//
// rho: albedo, n: normal, l_k: direction to the light, s_k: its strength. f, a: the reflectance curve
// (inverse/albedo/reflectance_curve.h). Frame: x right, y up, z towards the camera, as in normal maps;
// orthographic. Values are linear (relative luminance), in one unit for all images. Albedo has that unit over
// that of the strengths: it is known up to one factor unless the picture shows a reference of known albedo.
//
// LightOnMirrorSphere finds the direction to a light from its highlight on a mirror sphere in the picture.
//
// Methods, from the simplest:
//   least squares          v = s rho n.l by linear least squares, all values count
//   without shadows        the same without values below shadow_fraction of the brightest
//   robust                 Cauchy weights on top, so that cast shadows and highlights drop out
//   robust, strengths      strengths unknown: estimated for all pixels at once, up to the albedo's one factor
// The robust methods choose the reflectance curve. Every candidate is fitted with a part of the observations
// left out (each pixel leaves out other images). It is scored there by the mean of min(z^2, 9) by image. The
// curve of fewest parameters within one standard error of the best is chosen; the standard error is that of
// the paired difference between images.
//
// Directions known to direction_sigma_rad are adjusted within it. The residuals of one image share their
// model error and count as one observation. Curve and directions trade off, and many pixels would otherwise
// outweigh the measured directions.
//
// Sigmas contain noise and the shared unknowns, but not what f cannot describe. Assumes negligible
// interreflection, and nothing about the object's shape. Status is kUndetermined where the data do not
// suffice; `message` says why.
// Throws std::invalid_argument for shapes that do not match, and directions that are not unit vectors.
// Sources: Woodham (1980), "Photometric method for determining surface orientation from multiple images";
// Triggs et al. (2000), sec. 4; Breiman et al. (1984), sec. 3.4 (one-standard-error rule).
#ifndef LUXFIT_INVERSE_ALBEDO_PHOTOMETRIC_STEREO_H_
#define LUXFIT_INVERSE_ALBEDO_PHOTOMETRIC_STEREO_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/luminance/luminance.h"
#include "calib/photo_files/image.h"
#include "inverse/albedo/reflectance_curve.h"

namespace luxfit {

struct StereoData {
  Eigen::MatrixXd value;                // images x pixels; NaN: not valid there (saturated)
  Eigen::Matrix3Xd to_light;            // unit vectors, one for each image
  Eigen::VectorXd direction_sigma_rad;  // one for each image; empty: directions are exact
  Eigen::VectorXd strength;             // one for each image, > 0; empty: all alike
};

enum class StereoMethod { kLeastSquares, kWithoutShadows, kRobust, kRobustStrengths };
std::string ToString(StereoMethod method);

enum class StereoStatus { kDone, kUndetermined };

struct PhotometricStereoOptions {
  StereoMethod method = StereoMethod::kRobust;
  std::vector<CurveKind> curves = AllCurveKinds();  // candidates; a single one needs no comparison
  double shadow_fraction = 0.02;                    // share of the bright value below which 95 % lie
  int choice_pixels = 1000;                         // taken evenly for the comparison of curves
  int max_folds = 6;                                // parts that the comparison leaves out in turn
  bool covariance = true;
};

struct CurveScore {
  CurveKind kind = CurveKind::kLambert;
  double score = 0;           // on data left out
  double standard_error = 0;  // standard error of the difference from the best
};

struct PhotometricStereo {
  StereoStatus status = StereoStatus::kUndetermined;
  std::string message;               // why it is undetermined; else what is known up to a factor
  Eigen::VectorXd albedo;            // one for each pixel; NaN: fewer than three lights that span the space
  Eigen::Matrix3Xd normal;           // unit; NaN likewise
  Eigen::VectorXd albedo_sigma;      // empty without covariance
  Eigen::VectorXd normal_sigma_rad;  // root mean square angle
  Eigen::Matrix3Xd to_light;         // as adjusted
  Eigen::VectorXd strength;
  ReflectanceCurve curve;
  std::vector<CurveScore> scores;  // empty where nothing was compared
  std::string because;             // reason for the curve
  Eigen::MatrixXd residual;        // images x pixels, in the unit of the values
  double residual_sigma = 0;       // robust, of the values used
  bool IsUsable() const { return status == StereoStatus::kDone; }
};

PhotometricStereo SolvePhotometricStereo(const StereoData& data,
                                         const PhotometricStereoOptions& options = {});

// Tells what the pixels show.
struct StereoRegions {
  std::vector<bool> is_object, is_reference;  // for every pixel
  double reference_albedo = 0;                // reflectance of the reference
};

// Summarizes a solution over the object's pixels. Numbers are NaN where no pixel is determined.
struct StereoSummary {
  bool is_absolute = false;  // true: a reference tells the reflectance
  double factor = 1;         // from the solution's albedo to that of the summary
  int pixels = 0, determined = 0;
  double albedo_mean = 0, albedo_variation = 0;   // variation: relative standard deviation
  double albedo_sigma = 0, normal_sigma_rad = 0;  // medians
  Eigen::VectorXd adjusted_rad;     // by light: angle between the direction given and the adjusted one
  Eigen::VectorXd median_residual;  // by light: of the absolute residuals
  std::vector<int> suspect_lights;  // adjusted by 3 sigmas or more: measured less well than stated
};
// Throws std::invalid_argument for a solution that is not usable and regions of other pixels.
StereoSummary Summarize(const StereoData& data, const PhotometricStereo& result,
                        const StereoRegions& regions);

// Finds the direction to a distant light from its highlight on a mirror sphere.
//
//   n = ((u - u0) / R, -(v - v0) / R, sqrt(1 - ...)),   l = 2 (n . z) n - z,   z = (0, 0, 1) to the camera
//
// n: normal at the highlight (u, v); (u0, v0), R: centre and radius of the sphere's circle; l: direction to
// the light. Frame: x right, y up, z towards the camera; orthographic. Pixel (0, 0) is the centre of the
// top-left one. Where no direction is found, `message` says why.
// Sources: Chen, Goldman, Seitz (2011), "Photometric stereo with mirror spheres" (the usual arrangement);
// reflection at a sphere.

struct SphereCircle {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double radius_px = 0;
  std::string message;  // why the mask is not a whole circle; empty: it is one
  bool IsUsable() const { return message.empty(); }
};

// Fits the circle to the area and centroid of the mask's pixels. A whole circle has second moments R^2 / 4.
SphereCircle CircleOfMask(const PixelMask& mask);

// Returns the outward normal of a sphere at a pixel; none outside the circle.
std::optional<Eigen::Vector3d> SphereNormal(const SphereCircle& circle, const Eigen::Vector2d& pixel);

struct MirrorDirection {
  Eigen::Vector3d to_light = Eigen::Vector3d::UnitZ();
  double sigma_rad = 0;  // by half a pixel each of the highlight's centroid and of the circle
  std::string message;   // why there is no direction; empty: found
  bool IsUsable() const { return message.empty(); }
};

// Uses the centroid of the brightest connected area in the circle: pixels above `share` of the brightest.
MirrorDirection LightOnMirrorSphere(const ImagePlane& image, const SphereCircle& circle, double share = 0.8);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_PHOTOMETRIC_STEREO_H_
