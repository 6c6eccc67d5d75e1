#include "apps/stages/register/registration_words.h"

#include <fmt/format.h>

#include <cmath>

#include "calib/register/millimetres.h"

namespace luxfit {
namespace {

void RecordFocalLengths(const Registration& registration, const std::vector<Camera>& cameras,
                        const std::vector<std::string>& camera_ids, Findings& findings) {
  for (size_t c = 0; c < registration.focal_scale.size(); ++c) {
    const double scale = registration.focal_scale[c], sigma = registration.focal_scale_sigma[c];
    if (scale == 1) continue;
    const std::string found =
        fmt::format("{:.2f} +- {:.2f} % {} than its intrinsics say", 100 * std::abs(scale - 1), 100 * sigma,
                    scale > 1 ? "longer" : "shorter");
    findings.choices.push_back({"focal length of " + camera_ids[c],
                                fmt::format("{:.1f} px", cameras[c].fx_px),
                                {"as given", "estimated with the poses"},
                                "the tags agree with one that is " + found});
    findings.warnings.push_back(
        {"focal_length_off",
         fmt::format("The tags show a focal length of {} that is {}; it is used.", camera_ids[c], found),
         "Calibrate the camera as it was focused for the photos (luxfit calibrate): its "
         "distortion may be off as well."});
  }
}

// Records the sigma of the survey with which the poses were found, and why.
void RecordSurveySigma(const Registration& registration, Findings& findings) {
  const double given_m = RegisterViewsOptions().survey_sigma_m;
  if (!(registration.survey_sigma_m > 0)) return;
  const bool is_larger = registration.survey_sigma_m > given_m;
  findings.choices.push_back(
      {"survey sigma",
       Millimetres(registration.survey_sigma_m),
       {Millimetres(given_m) + " as given", "estimated from the tags' displacements"},
       is_larger
           ? "the tags hang further off their places than the given sigma allows, and no single moved tag "
             "explains it"
           : "the tags do not contradict it (chi-square test of their displacements, 99 %)"});
}

// Records whether the tags count as lying on the mesh's surfaces, and why.
void RecordTagsOnSurfaces(const TagsOnSurfaces& laid, Findings& findings) {
  if (laid.reason.empty()) return;
  const auto tags = [&laid](int count) { return fmt::format("{} of {}", count, laid.seen); };
  findings.choices.push_back(
      {"tags on surfaces", tags(laid.used), {tags(0), "up to " + tags(laid.candidates)}, laid.reason});
}

// The scatter of views is what tells how far errors of poses and surfaces go beyond noise.
void WarnOfOneView(const Registration& registration, Findings& findings) {
  if (registration.views.size() != 1) return;
  findings.warnings.push_back(
      {"one_view",
       fmt::format("view {} is the only one with a pose: no other view checks the pose, or what it shows of "
                   "surfaces, so that positions and fluxes may be off by more than their sigmas",
                   registration.views.front().view),
       "add views from other places, three or more"});
}

}  // namespace

void WarnOfNotes(const Registration& registration, Findings& findings) {
  for (const RegistrationNote& note : registration.notes)
    findings.warnings.push_back({note.code, note.message, note.remedy});
}

void RecordRegistration(const Registration& registration, const std::vector<Camera>& cameras,
                        const std::vector<std::string>& camera_ids, bool has_survey, Findings& findings) {
  if (has_survey) RecordSurveySigma(registration, findings);
  RecordTagsOnSurfaces(registration.tags_on_surfaces, findings);
  RecordFocalLengths(registration, cameras, camera_ids, findings);
  WarnOfOneView(registration, findings);
}

void WarnOfOtherView(const std::string& name, const std::string& view, const std::string& state,
                     const std::string& as_if_view, int tags, Findings& findings) {
  findings.warnings.push_back(
      {"photo_of_other_view",
       fmt::format("{} shows view {}, not {}: {} of its tags lie where the other photos of {} show them, and "
                   "none where those of {} do; it was not used",
                   name, as_if_view, view, tags, as_if_view, view),
       fmt::format("correct its view in the photo table, or take {} in state {} again", view, state)});
}

}  // namespace luxfit
