// Finds the glare sources that a photo shows, and rates its glare: vertical illuminance at the lens, UGR and DGP.
//
//   omega = 1 / |det d(pixel) / d(direction)|                         solid angle of a pixel, by its lens
//   E = sum L omega cos theta                                         of the pixels; theta: angle from the axis
//   L_s = sum L omega / sum omega,   p_s: index of the mean direction    of a source's pixels
//   UGR = 8 log10(0.25 / L_b  sum L_s^2 omega_s / p_s^2),   L_b = (E_v - sum E_s) / pi
//   DGP of sum L_s^2 omega_s / p_s^2 and E_v                          forward/views/glare.h
//
// Pixels above the threshold are glare. Those that touch are one source, as are groups that come within the merging
// angle. Pixels above the peak luminance are sources of their own, so that the sun is not averaged with the sky about it.
//
// A photo of a whole hemisphere tells E_v. A smaller one tells its part alone:
// - E_v is at least that part, unless it is given, such as by a luxmeter at the lens.
// - With E_v given, UGR and DGP are at least those of the sources seen.
// - Without it, L_b is the mean background of what is seen, UGR that of what is seen, and DGP is not known.
// Clipped pixels are at least as bright as they show, and so is what they give. Where they clip below the threshold,
// they may hide a glare source: without a given E_v, UGR is not known then.
//
// Units: cd/m2, sr, lx. Camera frame: x right, y down, z forward, the line of sight.
// Sources: CIE 117-1995; Wienold and Christoffersen (2006); evalglare 2.06, whose thresholds and merging these are (its
// search radius of 0.2 rad is the opening of a cone).
#ifndef LUXFIT_INVERSE_CONTROL_PHOTO_GLARE_H_
#define LUXFIT_INVERSE_CONTROL_PHOTO_GLARE_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/photo_files/image.h"
#include "inverse/observe/observe.h"

namespace luxfit {

// Holds where the pixels of a camera look, and how much of the sphere each covers; 0 where the lens has no image and
// behind the plane of the lens.
struct PixelField {
  PixelDirections directions;
  ImagePlane solid_angle_sr;
  double coverage = 0;  // sum omega cos theta / pi: 1 for a hemisphere
};
PixelField FieldOf(const Camera& camera);

struct PhotoGlareOptions {
  double threshold_cd_m2 = 2000;
  double threshold_over_mean = 0;  // above 0: threshold as a multiple of the photo's mean luminance instead
  double peak_cd_m2 = 50000;
  double merge_angle_rad = 0.1;
  std::optional<double> vertical_lx;  // E_v at the lens; empty: by the photo
};

struct PhotoGlareSource {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // mean, unit, camera frame
  int pixels = 0;
  double solid_angle_sr = 0;
  double luminance_cd_m2 = 0;   // mean
  double illuminance_lx = 0;    // E_s
  double ugr_index = 0;         // infinity: CIE 117 leaves it out
  double hemisphere_index = 0;  // for DGP
  bool is_clipped = false;      // some pixel is
};

enum class GlareBound { kValue, kAtLeast, kOfWhatIsSeen };

struct PhotoGlare {
  bool is_whole = false;              // the photo shows a hemisphere
  bool is_clipped = false;            // some pixel is
  bool is_hidden = false;             // some clip below the threshold
  double seen_lx = 0;                 // E of the photo
  double seen_background_cd_m2 = 0;   // mean by cos theta of the pixels that are no source
  double threshold_cd_m2 = 0;         // as used
  std::optional<double> vertical_lx;  // given, or by a whole hemisphere
  bool is_vertical_given = false;
  std::vector<PhotoGlareSource> sources;  // the one that glares most first
};
// `level_from_cam`: turns directions so that z is up. Throws std::invalid_argument for sizes that differ and a threshold
// or angle that is not above 0.
PhotoGlare GlareOfPhoto(const ImagePlane& luminance_cd_m2, const PixelMask& clipped, const PixelField& field,
                        const Eigen::Matrix3d& level_from_cam, const PhotoGlareOptions& options = {});

// Returns that rotation of a camera held upright and level: the photo's top is up.
Eigen::Matrix3d UprightCamera();

struct GlareRating {
  double background_cd_m2 = 0;
  std::optional<double>
      ugr;  // empty: nothing glares, no background is left, or clipped pixels hide what glares
  std::optional<double> dgp;  // empty: E_v is not known
  GlareBound ugr_bound = GlareBound::kValue, dgp_bound = GlareBound::kValue;
};
// Rates the glare with all luminances of the photo multiplied by a factor; a given E_v stays. Calls with 1 and 1 + sigma
// tell what an error of the photo's scale does.
GlareRating RatingOf(const PhotoGlare& glare, double luminance_factor = 1);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CONTROL_PHOTO_GLARE_H_
