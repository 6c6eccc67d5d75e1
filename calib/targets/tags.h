// AprilTags: the survey of where they hang, and their corners in a photo.
//
// Corner order everywhere in the house: top-left, top-right, bottom-right, bottom-left of the tag's *black
// square* as AprilTag's own images show it (tag36_11_00000.png). Seen from the front, with u = up and n =
// normal (out of the wall, towards the viewer), right = u x n.
//
// Pixels: (0, 0) is the centre of the top-left pixel. libapriltag puts that centre at (0.5, 0.5); the shift
// is made here and nowhere else.
//
// Source: Olson (2011), "AprilTag: A robust and flexible visual fiducial system"; Wang and Olson (2016),
// "AprilTag 2".
#ifndef LUXFIT_CALIB_TARGETS_TAGS_H_
#define LUXFIT_CALIB_TARGETS_TAGS_H_

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "calib/luminance/image.h"

namespace luxfit {

struct SurveyedTag {
  int id = 0;
  double size_m = 0;                // side of the black square
  Eigen::Vector3d center_in_world;  // m
  Eigen::Vector3d normal_in_world;  // unit, out of the surface
  Eigen::Vector3d up_in_world;      // unit, perpendicular to normal
};

// The four corners of the black square in world coordinates, in the house's order.
std::array<Eigen::Vector3d, 4> TagCornersInWorld(const SurveyedTag& tag);

struct TagDetection {
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners_px;  // in the house's order
  double side_px = 0;                         // mean side length
  double corner_sigma_px = 0;                 // expected corner error per axis, by side length
  double decision_margin = 0;                 // libapriltag's
};

struct DetectTagsOptions {
  std::string family = "tag36h11";
  double min_side_px = 12;          // smaller ones are mostly missed, and a cell is 1.5 px: bits by luck
  double min_decision_margin = 20;  // libapriltag's own recommendation lies between 10 and 50
  // Detection in a photo reduced by this much is faster (1.5, or whole numbers); edges are refined in the
  // full one. 0: 1.5 above 8 megapixels, else 1. Tags below some 20 px times this are missed.
  double decimate = 0;
  bool refine_edges = true;
  // Above 1: looks a second time, in the photo enlarged by this much, for tags of some 10 to 20 px; takes
  // 1 + enlarge^2 times as long.
  double enlarge = 1;
  double display_gamma = 2.2;  // linear counts are compressed before detection: dark tags keep their contrast
};

// Detects tags in a linear grey plane (height x width, any scale; NaN is shown as white: better leave clipped
// pixels as they are). Detections whose id
// is seen twice are returned twice. Ordered by id. Throws std::invalid_argument for an unknown family
// (tag36h11, tag36h10, tag25h9, tag16h5, tagStandard41h12).
std::vector<TagDetection> DetectTags(const ImagePlane& grey, const DetectTagsOptions& options = {});

// Expected corner error of DetectTags per axis, by the tag's side.
double DetectorCornerSigmaPx(double side_px);

struct CombineDetectionsOptions {
  // Part of a corner's sigma that all photos of a view share: the pixel grid cuts the same edges in the same
  // places, so more photos average only noise and shadows away.
  double systematic_fraction = 0.8;
};

// Detections of one view in several photos taken at the same pose, combined into one per tag: the mean of the
// corners weighted by 1 / sigma^2, without photos more than 5 sigma off the median or 3 times less precise
// than the best. With f = systematic_fraction, n photos and s^2 the mean variance, sigma^2 = f^2 s^2 + max((1
// - f^2) s^2 / n, variance of the mean from the photos' scatter). Detections of one id at different places
// (two copies of a tag) stay apart. Ordered by id.
std::vector<TagDetection> CombineDetections(const std::vector<std::vector<TagDetection>>& photos,
                                            const CombineDetectionsOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_TAGS_H_
