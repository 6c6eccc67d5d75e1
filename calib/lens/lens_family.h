// Lists the families of lenses, one row each, and names the kinds of lens that are fitted.
//
//   (x', y') = image(direction),   pixel = (fx x', fy y') + (cx, cy)      (calib/lens/camera.h)
//
// A kind is a family and its number of parameters. In order of complexity: opencv4, 5, 8, 12 (coefficients of
// kOpenCv in calib/lens/camera.h), fisheye (Kannala and Brandt's four), splined followed by the number of
// control points along the image's width (splined8). splined0 is the plain stereographic lens: a wide lens
// without distortion, where fits start.
//
// A row has the family's functions and what readers, fits and writers need. A new family is a value of
// LensModel, one file that makes its row (such as lens/internal/fisheye_lens.cc) and the row's line in
// lens_family.cc. No other file tells families apart by their names.
//
// Derivatives are those of (x', y') with respect to the point (X, Y, Z) in the camera frame. Functions return
// NaN where the lens has no image.
#ifndef LUXFIT_CALIB_LENS_LENS_FAMILY_H_
#define LUXFIT_CALIB_LENS_LENS_FAMILY_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "calib/lens/camera.h"

namespace luxfit {

struct LensKind {
  LensModel lens = LensModel::kOpenCv;
  int coefficients = 8;  // kOpenCv: 4, 5, 8 or 12; unused by other families
  int knots = 0;         // kSplined: control points along x, 0 or at least 4
};

bool operator==(const LensKind& a, const LensKind& b);

// Returns the kind of a family by its size: its number of coefficients, or of control points along x.
LensKind KindOfSize(LensModel lens, int size);

// Returns the number of parameters that a fit of the kind has, fx fy cx cy included. The number is
// approximate for control points, whose rows follow the image's shape.
double ParameterCount(const LensKind& kind, double height_over_width);

// Returns the name of a kind as session files spell it, such as opencv8.
std::string ToString(const LensKind& kind);

// Returns the kind of a name, in letters of either case; nothing where no kind has that name.
std::optional<LensKind> LensKindOf(const std::string& name);

struct LensImage {
  Eigen::Vector2d xy;
  Eigen::Matrix<double, 2, 3> d_point;
};

struct LensOps {
  LensModel lens = LensModel::kOpenCv;
  const char* key = "";  // in artifacts, and before the size in the names of its kinds

  // Sizes: the field of LensKind that tells them apart, which sizes exist, and which a calibration tries.
  int LensKind::*size = nullptr;  // nullptr: there is only one
  bool (*has_size)(int) = nullptr;
  std::vector<int> tried_sizes;
  bool is_tried_on_wide_fields_only = false;

  // Distortion.
  int coefficients = 0;                             // at most, in Camera::distortion
  std::vector<const char*> coefficient_names = {};  // as its equation in camera.h has them
  bool has_control_points = false;                  // over a stereographic lens, instead of coefficients
  bool is_pinhole = false;                          // without distortion; sees nothing behind it
  bool is_nested = false;                  // a size contains the smaller ones: its fit starts from theirs
  const char* distortion_model = nullptr;  // in OpenCV's and Kalibr's files, where it alone tells the family

  // Libraries that know it.
  bool is_in_mrcal = false;
  bool is_in_opencv = false;

  LensImage (*image)(const Camera& camera, const Eigen::Vector3d& p_in_cam) = nullptr;
  // Inverts `image`; returns a direction of any length.
  Eigen::Vector3d (*direction)(const Camera& camera, const Eigen::Vector2d& xy) = nullptr;
  // Returns d (x', y') / d coefficients, 2 x coefficients. Needed where libmrcal does not know the lens.
  Eigen::Matrix2Xd (*d_coefficients)(const Camera& camera, const Eigen::Vector3d& p_in_cam) = nullptr;
  // Returns the first coefficients of the lens that comes nearest to a plain stereographic one, up to the
  // given angle from the axis.
  std::vector<double> (*like_stereographic)(double half_field_rad) = nullptr;
};

// Returns all families, in the order in which equally complex ones are tried.
const std::array<LensOps, 3>& Lenses();
// Returns the row of a family.
const LensOps& OpsOf(LensModel lens);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_LENS_FAMILY_H_
