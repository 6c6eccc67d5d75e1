// Lists where photos and readings of a room could be taken.
//
// Photos: places on a grid of `spacing_m` at kEyeHeightM over the floor, in the open, with nothing but floor below;
// kStandDirections headings, level and tilted up, in every state. Where tags place the views, a candidate shows
// kFewestTags of at least kLeastTagSidePx.
// Readings: on the same grid, on what lies below (floor, furniture), and on walls at kWallHeightM, in every state.
//
// Units: m, world frame. An empty room has no candidates. Source: own.
#ifndef LUXFIT_INVERSE_ADVISE_CANDIDATES_H_
#define LUXFIT_INVERSE_ADVISE_CANDIDATES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/targets/tags.h"
#include "forward/direct/sensor.h"
#include "forward/light/room.h"

namespace luxfit {

constexpr double kStandSpacingM = 1, kEyeHeightM = 1.6, kWallHeightM = 1.2;
constexpr int kStandDirections = 8, kFewestTags = 3;
constexpr double kLeastTagSidePx = 16;

// A view is a pose of one camera. Photos of one view differ in their states alone.
struct AdviceView {
  std::string id;
  Eigen::Isometry3d cam_from_world = Eigen::Isometry3d::Identity();
  Camera camera;
};
struct PhotoCandidate {
  int view = 0;  // index into a list of views
  int state = 0;
};
struct ReadingCandidate {
  std::string id;
  Sensor sensor;
  int state = 0;
};

// Returns the view from `eye` along `direction`, upright. Throws std::invalid_argument for a direction of no length.
AdviceView ViewFrom(const std::string& id, const Eigen::Vector3d& eye, const Eigen::Vector3d& direction,
                    const Camera& camera);

// `tags`: empty where the views are placed by other means.
std::vector<AdviceView> ViewsToTake(const Room& room, const Camera& camera,
                                    const std::vector<SurveyedTag>& tags, double spacing_m = kStandSpacingM);

// Returns one sensor for each place.
std::vector<Sensor> PlacesToRead(const Room& room, double spacing_m = kStandSpacingM);

// Returns the material that the middle of the view shows; empty where it shows nothing.
std::string MaterialInView(const Room& room, const AdviceView& view);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ADVISE_CANDIDATES_H_
