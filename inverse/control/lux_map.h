// Computes the illuminance at every pixel of a photo from the luminance of diffuse surfaces.
//
//   E = pi Y / (c rho)
//   (sigma_E / E)^2 = var(ln c rho) + (sigma_Y / Y)^2 + model^2
//
// Y: relative luminance, c: camera scale (relative luminance per cd/m2), rho: reflectance of the surface that
// the pixel sees. c and rho come from one fit and are correlated: their product is known better than either.
// Assumes diffuse surfaces of even reflectance. On a picture on the wall, the result is the illuminance times
// the ratio of reflectances.
//
// Units: lx; planes are height x width. A pixel of unknown illuminance has NaN, and `gap` holds the reason.
// Throws std::invalid_argument for sizes that do not fit and a scale that is not above 0.
// Sources: own; CIE 244:2021 (luminance photometry with cameras).
#ifndef LUXFIT_INVERSE_CONTROL_LUX_MAP_H_
#define LUXFIT_INVERSE_CONTROL_LUX_MAP_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/luminance/luminance.h"
#include "forward/room/patches.h"
#include "inverse/observe/observe.h"

namespace luxfit {

struct FitUncertainty;  // inverse/model/fit_uncertainty.h

struct SurfaceScale {
  double camera_scale = 0;         // relative luminance per cd/m2
  Eigen::VectorXd albedo;          // by material
  Eigen::VectorXd relative_sigma;  // sigma of c rho, by material; NaN: unknown reflectance
  double relative_model_sigma = 0;
};

// Holds the reflectances of a fit, by material.
struct FittedSurfaces {
  std::vector<std::string> materials;
  Eigen::VectorXd albedo;
  std::vector<bool> is_known;  // false: the data do not determine it, or no photo shows it
};
// Returns the scale with the sigma of each product c rho. Throws std::invalid_argument for sizes that differ.
SurfaceScale ScaleOfSurfaces(double camera_scale, const FittedSurfaces& surfaces,
                             const FitUncertainty& uncertainty);

// Says why a pixel has no illuminance. Files store the numbers.
enum class PixelGap { kNone = 0, kNoSurface = 1, kSaturated = 2, kDark = 3, kReflectanceUnknown = 4 };

struct LuxMap {
  ImagePlane illuminance_lx, sigma_lx;  // NaN where unknown
  ImagePlane gap;                       // PixelGap as a number
  double known_share = 0;               // share of all pixels
  double saturated_share = 0;           // share of the pixels that see a surface
};

// `map`: made with DensePixels(), so that it holds all pixels that see one surface.
LuxMap MapIlluminance(const PixelMap& map, const LuminanceImage& photo, const Patches& patches,
                      const SurfaceScale& scale);

// Returns options of MapPixels that leave out only the borders of surfaces.
PixelMapOptions DensePixels();

// Holds the illuminance of one element, from its observations (inverse/observe/observe.h).
struct ElementIlluminance {
  int element = 0;
  int pixels = 0;
  double illuminance_lx = 0, sigma_lx = 0;
  double random_sigma_lx = 0;  // by the photo alone, without the uncertainty that all photos share
};
// Returns the illuminance of the observed elements. Elements of unknown reflectance are left out.
std::vector<ElementIlluminance> ElementsOf(const std::vector<Observation>& observations,
                                           const Patches& patches, const SurfaceScale& scale);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CONTROL_LUX_MAP_H_
