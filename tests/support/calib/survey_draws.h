// Draws of a tag survey with errors, of what all views see, and the errors of the poses that follow.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_SURVEY_DRAWS_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_SURVEY_DRAWS_H_

#include <Eigen/Core>
#include <random>
#include <string>
#include <vector>

#include "tests/support/calib/feature_room.h"

namespace luxfit::support {

// What all views see of tags that really hang as `truth` says.
inline std::vector<ViewDetections> DetectTagsInAll(const FeatureRoom& room,
                                                   const std::vector<SurveyedTag>& truth, double noise_px,
                                                   std::mt19937_64& rng) {
  std::vector<ViewDetections> views;
  views.reserve(room.poses.size());
  for (std::size_t v = 0; v < room.poses.size(); ++v)
    views.push_back(DetectTagsOf(room, truth, v, noise_px, rng));
  return views;
}

// A survey with that error of each tag's place, per axis.
inline std::vector<SurveyedTag> SurveyOf(const FeatureRoom& room, double error_m, std::mt19937_64& rng) {
  std::normal_distribution<double> normal(0, error_m);
  std::vector<SurveyedTag> survey = room.tags;
  for (SurveyedTag& tag : survey) {
    for (double& coordinate : tag.center_in_world) coordinate += normal(rng);
  }
  return survey;
}

// Six for each registered view, as in PoseError.
inline Eigen::VectorXd PoseErrors(const Registration& registration, const FeatureRoom& room) {
  Eigen::VectorXd errors(6 * static_cast<Eigen::Index>(registration.views.size()));
  for (std::size_t i = 0; i < registration.views.size(); ++i) {
    const RegisteredView& view = registration.views[i];
    const auto v = static_cast<std::size_t>(std::stoi(view.view.substr(1)));
    errors.segment<6>(6 * static_cast<Eigen::Index>(i)) = PoseError(view, room.poses[v]);
  }
  return errors;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_SURVEY_DRAWS_H_
