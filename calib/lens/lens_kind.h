// What a lens is fitted with: its family and how many parameters it has.
//
// In order of complexity: OPENCV4, 5, 8, 12 (parameters of calib/lens/camera.h's kOpenCv), FISHEYE (Kannala and
// Brandt's four), SPLINED followed by the number of control points along the image's width (SPLINED8).
// SPLINED0 is the plain stereographic lens: a wide lens without distortion, where fits start.
#ifndef LUXFIT_CALIB_LENS_LENS_KIND_H_
#define LUXFIT_CALIB_LENS_LENS_KIND_H_

#include <optional>
#include <string>

#include "calib/lens/camera.h"

namespace luxfit {

struct LensKind {
  LensModel lens = LensModel::kOpenCv;
  int coefficients = 8;  // kOpenCv: 4, 5, 8 or 12; of other families unused
  int knots = 0;         // kSplined: control points along x, 0 or at least 4
};

bool operator==(const LensKind& a, const LensKind& b);

std::string ToString(const LensKind& kind);

// The inverse; nothing where the name is none of these. Letters of either case.
std::optional<LensKind> LensKindOf(const std::string& name);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_LENS_KIND_H_
