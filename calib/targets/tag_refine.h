// Tag corners refined against the photo itself.
//
// The picture of the tag, seen through the camera, is fitted to the linear grey values of every pixel on the
// tag:
//   I(u, v) = black + gradient_b . (s, t) + (contrast + gradient_c . (s, t)) * mean of picture over the pixel
//   (s, t)  = H * undistort(u, v)
// Unknowns: H (8), black and contrast with their gradients (6), lens blur (variance, px^2). Gauss-Newton,
// Huber weights. The edges of all cells count, not only the outline, and the mean over a pixel's area is
// exact for sharp edges, so that photos sharper than the pixel grid do no harm: a few hundredths of a pixel,
// where edge detectors reach 0.1 to 0.3. The lens blur is a Gaussian's in variance and fourth moment.
//
// Assumes a flat tag, linear counts (a gamma moves edges), and fewer than about a third of the tag hidden or
// shadowed. Pixels that are NaN are left out: give saturated pixels so, for clipped whites move edges.
//
// Source: the inverse compositional view of direct alignment, Baker and Matthews (2004), "Lucas-Kanade 20
// years on".
#ifndef LUXFIT_CALIB_TARGETS_TAG_REFINE_H_
#define LUXFIT_CALIB_TARGETS_TAG_REFINE_H_

#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/luminance/image.h"
#include "calib/luminance/luminance.h"
#include "calib/targets/tags.h"

namespace luxfit {

struct RefineTagCornersOptions {
  std::string family = "tag36h11";
  int border_bits = 1;  // width of the black border in cells; Kalibr prints 2
  int max_iterations = 20;
  int max_pixels = 1500;  // of a large tag that are looked at, most about edges: more gain nothing but time
  double max_shift_cells = 0.5;  // further from the detector's corner (1 px at least) the fit has gone astray
  double max_residual = 0.25;  // robust residual per unit of contrast; beyond it the pixels are not this tag
  double min_corner_sigma_px = 0.03;  // the model's own floor: aliasing, flatness, print, lens model
};

// The same detections in the same order with refined corners, side and corner_sigma_px (from the fit's
// covariance and residual, not below the floor). Detections that could not be refined are returned as they
// came. Throws std::invalid_argument for an unknown family and ids that the family does not have.
std::vector<TagDetection> RefineTagCorners(const ImagePlane& grey, const Camera& camera,
                                           const std::vector<TagDetection>& detections,
                                           const RefineTagCornersOptions& options = {});

// Detects the tags of a photo and refines their corners: DetectTags, then RefineTagCorners. Saturated pixels say nothing about an
// edge's place and are left out. Throws as both do.
std::vector<TagDetection> FindTagCorners(const LuminanceImage& photo, const Camera& camera,
                                         const std::string& family = "tag36h11");

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_TAG_REFINE_H_
