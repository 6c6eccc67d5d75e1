// Finds luminaires in a photo: connected pixels far brighter than surfaces that reflect.
//
// A pixel is bright by either of two rules. Every exposure of it saturated, and it shows at least half of the
// most that a saturated pixel does (masks of saturation have a margin, calib/luminance/luminance.h). Or its
// luminance exceeds `times_surfaces` times that of all but the brightest twentieth of the valid pixels: in
// short exposures a luminaire does not saturate.
//
// Highlights, windows and overexposed surfaces are blobs too. Only several views together, and the light
// itself, tell which blobs are luminaires.
//
// A blob's contour lies where the luminance is half of what the blob shows: of its median, which for a
// saturated blob is the sensor's limit. The blur of a lens thus moves it outwards by a fraction of a pixel.
//
// Pixels; (0, 0) is the centre of the top-left one. Bright pixels touching by a side or a corner are one
// blob.
// Sources: connected components after Bolelli et al. (2020), "Spaghetti labeling", in OpenCV; contours as in
// calib/luminance/internal/blob_contour.h.
#ifndef LUXFIT_CALIB_LUMINANCE_BRIGHT_BLOBS_H_
#define LUXFIT_CALIB_LUMINANCE_BRIGHT_BLOBS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "calib/luminance/luminance.h"

namespace luxfit {

struct BrightBlob {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  // mean of its pixels
  Eigen::AlignedBox2d extent_px;                        // outer edges of its outermost pixels
  double area_px2 = 0;
  double saturated_share = 0;
  bool touches_edge = false;  // the photo's edge: the blob's centre is not the luminaire's
  // Evenly spaced points of its outer contour. The photo's edge is no contour.
  std::vector<Eigen::Vector2d> contour_px;
};

struct BrightBlobOptions {
  double times_surfaces = 4;
  double min_area_px2 = 4;  // a smaller blob is a tag's corner or a hot pixel
  int max_blobs = 24;       // the largest are kept: in a photo with more, most are texture
  int contour_points = 32;
};

// Returns the blobs, largest first. Throws std::invalid_argument for an image whose planes differ in size.
std::vector<BrightBlob> FindBrightBlobs(const LuminanceImage& image, const BrightBlobOptions& options = {});

// Returns whether a pixel lies inside the blob's contour, or no farther from it; false for a blob without one.
bool IsWithin(const BrightBlob& blob, const Eigen::Vector2d& pixel, double tolerance_px);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_BRIGHT_BLOBS_H_
