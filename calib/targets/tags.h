// Finds the corners of AprilTags in a photo, refines them on its pixels, and holds the survey of where the
// tags hang.
//
// Corner order, everywhere in this project: top-left, top-right, bottom-right, bottom-left of the tag's
// *black square* as AprilTag's own images show it (tag36_11_00000.png). Seen from the front, with u = up and
// n = normal (out of the wall, towards the viewer), right = u x n.
//
// Pixels: (0, 0) is the centre of the top-left pixel. libapriltag puts that centre at (0.5, 0.5); tags.cc
// shifts, and no other file does.
//
// To refine the corners, the picture of the tag, seen through the camera, is fitted to the linear grey values
// of every pixel on the tag:
//   I(u, v) = black + gradient_b . (s, t) + (contrast + gradient_c . (s, t)) * mean of picture over the pixel
//   (s, t)  = H * undistort(u, v)
// Unknowns: H (8), black and contrast with their gradients (6), lens blur (variance, px^2). Gauss-Newton,
// Huber weights. The lens blur is a Gaussian's in variance and fourth moment.
//
// The edges of all cells count, not only the outline. The mean over a pixel's area is exact for sharp edges,
// so photos sharper than the pixel grid do no harm. The error is a few hundredths of a pixel, where edge
// detectors reach 0.1 to 0.3.
//
// The fit assumes a flat tag, linear counts (a gamma moves edges), and fewer than about a third of the tag
// hidden or shadowed. Pixels that are NaN are left out. Set saturated pixels to NaN, since clipped whites
// move edges.
//
// Source: Olson (2011), "AprilTag: A robust and flexible visual fiducial system"; Wang and Olson (2016),
// "AprilTag 2"; the inverse compositional view of direct alignment, Baker and Matthews (2004), "Lucas-Kanade
// 20 years on".
#ifndef LUXFIT_CALIB_TARGETS_TAGS_H_
#define LUXFIT_CALIB_TARGETS_TAGS_H_

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/luminance/luminance.h"
#include "calib/photo_files/image.h"

namespace luxfit {

struct SurveyedTag {
  int id = 0;
  double size_m = 0;                // side of the black square
  Eigen::Vector3d center_in_world;  // m
  Eigen::Vector3d normal_in_world;  // unit, out of the surface
  Eigen::Vector3d up_in_world;      // unit, perpendicular to normal
};

// Returns the four corners of the black square in world coordinates, m, in the project's order.
std::array<Eigen::Vector3d, 4> TagCornersInWorld(const SurveyedTag& tag);

struct TagDetection {
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners_px;  // in the project's order
  double side_px = 0;                         // MeanSidePx of the corners
  double corner_sigma_px = 0;                 // expected corner error per axis, by side length
  double decision_margin = 0;                 // as libapriltag gives it
};

// Returns what a tag's size is the side of, in words: the black square, or the white one in the black frame of families
// with a reversed border (tagStandard41h12). Throws std::invalid_argument for an unknown family.
std::string TagSquareWords(const std::string& family);

// Returns the mean length of a tag's sides.
double MeanSidePx(const std::array<Eigen::Vector2d, 4>& corners_px);

struct DetectTagsOptions {
  std::string family = "tag36h11";
  double min_side_px = 12;          // smaller tags are mostly missed: a cell is 1.5 px, and bits are luck
  double min_decision_margin = 20;  // libapriltag's own recommendation lies between 10 and 50
  // Detection in a photo reduced by this factor (1.5, or whole numbers) is faster; edges are refined in the
  // full photo. 0: 1.5 above 8 megapixels, else 1. Tags below some 20 px times this factor are missed.
  double decimate = 0;
  bool refine_edges = true;
  // Above 1: looks a second time, in the photo enlarged by this factor, for tags of some 10 to 20 px. Takes
  // 1 + enlarge^2 times as long.
  double enlarge = 1;
  double display_gamma = 2.2;  // linear counts are compressed before detection: dark tags keep their contrast
};

// Detects tags in a linear grey plane (height x width, any scale). NaN is shown as white: it is better to
// leave clipped pixels as they are. Detections whose id is seen twice are returned twice. Ordered by id.
// Throws std::invalid_argument for an unknown family (tag36h11, tag36h10, tag25h9, tag16h5,
// tagStandard41h12).
std::vector<TagDetection> DetectTags(const ImagePlane& grey, const DetectTagsOptions& options = {});

// Returns the expected corner error of DetectTags per axis, px, by the tag's side.
double DetectorCornerSigmaPx(double side_px);

struct CombineDetectionsOptions {
  // Part of a corner's sigma that all photos of a view share. The pixel grid cuts the same edges in the same
  // places, so more photos average only noise and shadows away.
  double systematic_fraction = 0.8;
};

// Combines detections of one view, in several photos taken at the same pose, into one for each tag.
//
//   corners = mean weighted by 1 / sigma^2
//   sigma^2 = f^2 s^2 + max((1 - f^2) s^2 / n, variance of the mean from the photos' scatter)
// f = systematic_fraction, n photos, s^2 the mean variance.
//
// Photos more than 5 sigma off the median, or 3 times less precise than the best, are left out. Detections of
// one id at different places (two copies of a tag) stay apart. Ordered by id.
std::vector<TagDetection> CombineDetections(const std::vector<std::vector<TagDetection>>& photos,
                                            const CombineDetectionsOptions& options = {});

struct RefineTagCornersOptions {
  std::string family = "tag36h11";
  int border_bits = 1;  // width of the black border in cells; Kalibr prints 2
  int max_iterations = 20;
  int max_pixels = 1500;         // used of a large tag, most of them about edges: more only cost time
  double max_shift_cells = 0.5;  // from the detector's corner, at least 1 px: beyond, the fit has failed
  double max_residual = 0.25;  // robust residual per unit of contrast; beyond it the pixels are not this tag
  double min_corner_sigma_px = 0.03;  // floor of the model: aliasing, flatness, print, lens model
};

// Returns the same detections in the same order, with refined corners, side and corner_sigma_px. The sigma
// comes from the fit's covariance and residual and is not below the floor. Detections that could not be
// refined are returned as they came. Throws std::invalid_argument for an unknown family and ids that the
// family does not have.
std::vector<TagDetection> RefineTagCorners(const ImagePlane& grey, const Camera& camera,
                                           const std::vector<TagDetection>& detections,
                                           const RefineTagCornersOptions& options = {});

// Detects the tags of a photo and refines their corners: DetectTags, then RefineTagCorners. Saturated pixels
// are left out, since they do not determine the place of an edge. Throws as both do.
std::vector<TagDetection> FindTagCorners(const LuminanceImage& photo, const Camera& camera,
                                         const std::string& family = "tag36h11");

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_TAGS_H_
