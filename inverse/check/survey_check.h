// Does the tag survey belong to the mesh?
//
// Tags hang on surfaces: their centres are near the mesh when both are in the
// same frame and unit. A mesh in another unit than declared is off by a known factor.
//
// Distances m.
// Source: house.
#ifndef LUXFIT_INVERSE_CHECK_SURVEY_CHECK_H_
#define LUXFIT_INVERSE_CHECK_SURVEY_CHECK_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

struct SurveyCheck {
  double distance_m = 0;    // of three quarters of the tags' centres to the mesh, at most
  bool fits = true;         // below tolerance_m
  std::string better_unit;  // m, cm, mm, in or ft, where the mesh would fit in that unit; else empty
};

// `declared_metres_per_unit` is the scale that the mesh was read with. No tags: fits.
SurveyCheck CheckSurvey(const Scene& scene, const std::vector<Eigen::Vector3d>& tag_centers_in_world,
                        double declared_metres_per_unit, double tolerance_m = 0.1);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHECK_SURVEY_CHECK_H_
