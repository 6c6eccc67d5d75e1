#include "calib/register/internal/survey/survey_diagnosis.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "calib/register/internal/bundle/pose_start.h"
#include "calib/register/internal/view_sample.h"

namespace luxfit {
namespace {

using Change = std::function<SurveyedTag(SurveyedTag)>;

int CountTags(const std::vector<BundleView>& views) {
  int tags = 0;
  for (const BundleView& view : views) tags += static_cast<int>(view.tags.size());
  return tags;
}

// Counts the tags that agree, in views where at least three do (all, if fewer are seen): any two tags of one
// plane nearly agree on some pose.
int CountAgreeing(const BundleContext& context, const std::map<int, SurveyedTag>& survey,
                  const std::vector<BundleView>& views, const Change& change) {
  PoseStartOptions options;
  options.survey_sigma_m = context.options.survey_sigma_m;
  int agreeing = 0;
  for (BundleView view : views) {
    for (TagObservation& tag : view.tags) {
      const SurveyedTag changed = change(survey.at(tag.id));
      tag.size_m = changed.size_m;
      tag.corners_in_world = TagCornersInWorld(changed);
    }
    const PoseStart start = EstimatePoseStart(context.CameraOf(view), view.tags, options);
    const auto count = static_cast<int>(std::count(start.agrees.begin(), start.agrees.end(), true));
    const int needed = std::min(3, static_cast<int>(view.tags.size()));
    if (count >= needed) agreeing += count;
  }
  return agreeing;
}

struct Hypothesis {
  Change change;
  RegistrationNote note;
};

RegistrationNote SizesWrong(double factor) {
  return {
      "", -1, "tag_sizes_wrong",
      fmt::format("The photos show all tags {:.3g} times as large, against the distances between them, as "
                  "the survey says; nothing is registered.",
                  factor),
      "Measure a printed tag's black square, and see whether sizes and places are in one unit (m)."};
}

std::vector<Hypothesis> Hypotheses() {
  std::vector<Hypothesis> hypotheses;
  hypotheses.push_back(
      {[](SurveyedTag tag) {
         for (Eigen::Vector3d* v : {&tag.center_in_world, &tag.normal_in_world, &tag.up_in_world})
           v->x() = -v->x();
         return tag;
       },
       {"", -1, "map_mirrored",
        "The tag map is the mirror image of what the photos show; nothing is registered.",
        "Use a right-handed frame with z up: see whether x and y are swapped or one of them is "
        "counted the wrong way."}});
  hypotheses.push_back(
      {[](SurveyedTag tag) {
         tag.normal_in_world = -tag.normal_in_world;
         return tag;
       },
       {"", -1, "map_turned", "The tag map's normals point into the walls; nothing is registered.",
        "Turn every normal round: it points out of the surface, towards the viewer."}});
  for (const int degrees : {90, 180, 270}) {
    hypotheses.push_back(
        {[degrees](SurveyedTag tag) {
           tag.up_in_world = Eigen::AngleAxisd(degrees * M_PI / 180, tag.normal_in_world) * tag.up_in_world;
           return tag;
         },
         {"", -1, "map_turned",
          "The photos show every tag turned by " + std::to_string(degrees) +
              " degrees in its plane against the tag map's up; nothing is registered.",
          "Give as up the top of the tag as AprilTag's own images show it: OpenCV draws the same "
          "tags turned by 180 degrees."}});
  }
  return hypotheses;
}

// Returns the factor on all sizes under which `needed` tags agree, searched from 1 outwards and among units
// taken for others. The result is the middle of adjacent factors that agree.
std::optional<double> FindSizeFactor(const std::function<int(double)>& count_agreeing, int needed,
                                     double size_m) {
  constexpr double kStep = 1.02;  // tags agree within some two percent of their size
  constexpr double kMost = 3.2;   // beyond it sizes are wrong by a unit
  constexpr double kLeastTagM = 0.005, kMostTagM = 5;
  for (const double step : {kStep, 1 / kStep}) {
    double log_sum = 0, found = 0;
    for (double factor = step; factor < kMost && factor > 1 / kMost; factor *= step) {
      const bool agrees = count_agreeing(factor) >= needed;
      if (!agrees && found > 0) break;
      if (!agrees) continue;
      log_sum += std::log(factor);
      ++found;
    }
    if (found > 0) return std::exp(log_sum / found);
  }
  for (const double unit : {0.001, 0.01, 0.0254, 0.1, 0.3048, 3.28084, 10., 39.3701, 100., 1000.}) {
    // Tags of a millimetre are points, whose places agree with wrong intrinsics as well.
    if (unit * size_m < kLeastTagM || unit * size_m > kMostTagM) continue;
    if (count_agreeing(unit) >= needed) return unit;
  }
  return std::nullopt;
}

}  // namespace

std::optional<RegistrationNote> DiagnoseSurvey(const BundleContext& context,
                                               const std::map<int, SurveyedTag>& survey,
                                               const std::vector<BundleView>& views) {
  const std::vector<BundleView> sample = SampleOf(views);
  const int tags = CountTags(sample);
  constexpr int kFewestTags = 4;  // fewer are no evidence against a survey
  if (tags < kFewestTags) return std::nullopt;
  const int as_it_is = CountAgreeing(context, survey, sample, [](SurveyedTag tag) { return tag; });
  if (2 * as_it_is > tags) return std::nullopt;
  const int needed = std::max(2 * as_it_is, (6 * tags + 9) / 10);
  for (const Hypothesis& hypothesis : Hypotheses()) {
    if (CountAgreeing(context, survey, sample, hypothesis.change) >= needed) return hypothesis.note;
  }
  const auto count_agreeing = [&](double factor) {
    return CountAgreeing(context, survey, sample, [factor](SurveyedTag tag) {
      tag.size_m *= factor;
      return tag;
    });
  };
  const std::optional<double> factor = FindSizeFactor(count_agreeing, needed, survey.begin()->second.size_m);
  return factor ? std::optional(SizesWrong(*factor)) : std::nullopt;
}

}  // namespace luxfit
