// Checks whether the tag survey and the mesh have the same frame and unit.
//
// Tags hang on surfaces: their centres are near the mesh where frame and unit are the same. A mesh in another
// unit than declared is off by a known factor. Distances are in m.
// Source: own.
#ifndef LUXFIT_INVERSE_CHECK_SURVEY_CHECK_H_
#define LUXFIT_INVERSE_CHECK_SURVEY_CHECK_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

struct SurveyCheck {
  double distance_m = 0;    // three quarters of the tags' centres are no farther from the mesh
  bool fits = true;         // below tolerance_m
  std::string better_unit;  // m, cm, mm, in or ft where the mesh fits in that unit; else empty
};

// `declared_metres_per_unit`: the scale with which the mesh was read. Without tags, `fits` is true.
SurveyCheck CheckSurvey(const Scene& scene, const std::vector<Eigen::Vector3d>& tag_centers_in_world,
                        double declared_metres_per_unit, double tolerance_m = 0.1);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHECK_SURVEY_CHECK_H_
