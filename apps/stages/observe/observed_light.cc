#include "apps/stages/observe/observed_light.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/stages/session_light.h"

namespace luxfit {
namespace {

std::string HeldBy(const std::vector<StatedCamera>& cameras, const PhotoNames& names) {
  std::string held;
  for (size_t c = 0; c < cameras.size(); ++c) {
    if (!cameras[c].vignetting_is_open)
      held += fmt::format("; vignetting of {} is its flat field's", names.cameras[c]);
    if (!cameras[c].response_is_open)
      held += fmt::format("; response of {} is its curve's", names.cameras[c]);
  }
  return held;
}

void RecordChoice(const std::vector<StatedCamera>& cameras, const PhotoNames& names,
                  const SelfCalibration& found, Findings& findings) {
  Choice choice{"exposures, vignetting and response", found.Chosen().name, {}, ""};
  std::string scores;
  for (const RadiometryCandidate& c : found.candidates) {
    choice.among.push_back(c.name);
    scores += fmt::format("{}{} {}", scores.empty() ? "" : ", ", c.name,
                          c.is_determined ? fmt::format("{:.3f}", c.score) : "not determined");
  }
  choice.because =
      "the fewest parameters within one standard error of the best on surfaces left out, seen by several "
      "photos "
      "(mean squared normalised error: " +
      scores + ")";
  for (size_t c = 0; c < cameras.size() && found.Chosen().order > 0; ++c) {
    if (cameras[c].vignetting_is_open)
      choice.because +=
          fmt::format("; the corner of {} has {:.1f} +- {:.2f} % of the centre's light", names.cameras[c],
                      100 * found.CornerShare(static_cast<int>(c)), 100 * found.corner_sigma);
  }
  choice.because += HeldBy(cameras, names);
  findings.choices.push_back(choice);
}

std::string GainText(const PhotoNames& names, const AppliedGain& applied) {
  const std::string& reference = names.cameras[applied.reference];
  if (applied.is_stated) return fmt::format("{:.4g} of {}'s", applied.gain, reference);
  return fmt::format("{:.3f} +- {:.3f} of {}'s", applied.gain, applied.gain * applied.relative_sigma,
                     reference);
}

void RecordCameraGains(const PhotoNames& names, const SelfCalibration& found,
                       const std::vector<AppliedGain>& gains, Findings& findings) {
  for (const AppliedGain& applied : gains) {
    const std::string because =
        applied.is_stated
            ? std::string("cdm2_per_count_s is given of both")
            : fmt::format(
                  "surfaces left out that several cameras see ask for it (mean squared normalised "
                  "error: cameras alike {:.3f}, each with its gain {:.3f})",
                  found.score_of_equal_cameras, found.score_of_camera_gains);
    findings.choices.push_back(
        {"gain of " + names.cameras[applied.camera], GainText(names, applied), {}, because});
  }
}

nlohmann::json CameraGainsJson(const PhotoNames& names, const std::vector<AppliedGain>& gains) {
  nlohmann::json list = nlohmann::json::array();
  for (const AppliedGain& applied : gains)
    list.push_back({{"camera", names.cameras[applied.camera]},
                    {"gain", applied.gain},
                    {"relative_sigma", applied.relative_sigma},
                    {"relative_to", names.cameras[applied.reference]},
                    {"source", applied.is_stated ? "session" : "photos"}});
  return list;
}

void WarnOfUntiedCameras(const PhotoNames& names, int unit_camera, const SelfCalibration& found,
                         Findings& findings) {
  std::vector<std::string> untied;
  for (size_t c = 0; c < found.camera_gains.size(); ++c) {
    if (!found.camera_gains[c].is_tied) untied.push_back(names.cameras[c]);
  }
  if (untied.empty()) return;
  findings.warnings.push_back(
      {"camera_gain_undetermined",
       fmt::format("nothing tells the sensitivity of camera {} against that of camera {}: they share too few "
                   "surfaces in one state, and their counts were taken to mean the same light",
                   fmt::join(untied, ", "), names.cameras[static_cast<size_t>(unit_camera)]),
       "photograph the same surfaces with both cameras in the same state, or give cdm2_per_count_s of both"});
}

void WarnOfContradictions(const PhotoNames& names, const SelfCalibration& found, Findings& findings) {
  for (const GainContradiction& c : found.contradictions)
    findings.warnings.push_back(
        {"camera_scales_contradict",
         fmt::format(
             "surfaces are {:.3f} +- {:.3f} times as bright in photos of camera \"{}\" as in those of "
             "\"{}\", by the cdm2_per_count_s of both; they were not adjusted to each other",
             std::exp(c.log_ratio), c.sigma * std::exp(c.log_ratio),
             names.cameras[static_cast<size_t>(c.camera)], names.cameras[static_cast<size_t>(c.reference)]),
         "check cdm2_per_count_s of both, for the ISO and aperture of each camera's first photo; or give one "
         "only, and the other camera's gain is estimated"});
}

void WarnOfGains(const PhotoNames& names, const RoomPhotos& photos, const PhotoRadiometry& radiometry,
                 Findings& findings) {
  for (const int p : radiometry.findings.wrong_photos) {
    const double factor = std::exp(radiometry.found.log_gain[p]);
    const size_t photo = radiometry.photos[static_cast<size_t>(p)];
    findings.warnings.push_back(
        {"exposure_metadata",
         fmt::format(
             "{}: surfaces are {:.3f} times as bright as the other photos say of state {}: its exposure "
             "is not the stated one, or the light had changed; it was corrected here",
             names.photos[photo], factor, names.states[static_cast<size_t>(photos.photos[photo].state)]),
         fmt::format("check its exposure_s and ISO (automatic ISO?): {:.3f} times the stated exposure would "
                     "fit; or take it again",
                     factor)});
  }
}

void WarnOfLooseStates(const PhotoNames& names, const RadiometryFindings& found, Findings& findings) {
  if (found.loose_states.empty()) return;
  std::vector<std::string> states;
  states.reserve(found.loose_states.size());
  for (const int s : found.loose_states) states.push_back(names.states[static_cast<size_t>(s)]);
  findings.warnings.push_back(
      {"state_exposures_undetermined",
       fmt::format(
           "exposures differ from the stated ones, and nothing says by how much those of the photos of "
           "state {} do all together: fluxes of what is on in it share a further uncertainty of up to "
           "{:.1f} %, which their sigmas do not contain",
           fmt::join(states, ", "), 100 * found.loose_sigma),
       "photograph a state with all luminaires on, or give a reading in each state"});
}

// Warns where the photos contradict what the session says of its cameras.
void WarnOfCameras(const PhotoNames& names, const SelfCalibration& found, const RadiometryFindings& of_photos,
                   Findings& findings) {
  for (size_t c = 0; c < names.cameras.size(); ++c) {
    const std::string& id = names.cameras[c];
    const int camera = static_cast<int>(c);
    if (of_photos.cameras[c].darkens)
      findings.warnings.push_back(
          {"vignetting_found",
           fmt::format(
               "the photos of camera \"{}\" darken towards the corners, to {:.1f} % of the centre's light; "
               "it was corrected here",
               id, 100 * found.CornerShare(camera)),
           "write vignetting = \"estimate\", or give a flat field"});
    if (of_photos.cameras[c].is_curved)
      findings.warnings.push_back(
          {"response_not_linear",
           fmt::format(
               "counts of camera \"{}\" are not proportional to light, but go with its power {:.3f}; it "
               "was corrected here",
               id, found.ResponsePower(camera)),
           "develop the photos linearly, without a tone curve, or give response = \"estimate\" with "
           "brackets"});
    if (of_photos.cameras[c].vignetting_is_undetermined)
      findings.warnings.push_back(
          {"vignetting_undetermined",
           fmt::format("the vignetting of camera \"{}\" is not determined: {}; none was corrected", id,
                       found.is_possible
                           ? "too few surfaces are seen both near the centre and near the border of photos"
                           : found.message),
           "add views that show the same walls in their middle and at their border, or give a flat field as "
           "vignetting"});
  }
}

nlohmann::json JsonOf(const PhotoNames& names, const std::vector<std::string>& files,
                      const SelfCalibration& found) {
  nlohmann::json found_json = {
      {"chosen", found.Chosen().name},         {"relative_difference_of_views", found.residual_sigma},
      {"candidates", nlohmann::json::array()}, {"exposure_gains", nlohmann::json::array()},
      {"states", nlohmann::json::array()},     {"cameras", nlohmann::json::array()}};
  for (const RadiometryCandidate& c : found.candidates)
    found_json["candidates"].push_back({{"name", c.name},
                                        {"parameters", c.parameters},
                                        {"score", c.score},
                                        {"standard_error", c.standard_error},
                                        {"is_determined", c.is_determined}});
  for (size_t p = 0; p < files.size() && found.Chosen().gains; ++p) {
    const Eigen::Index at = static_cast<Eigen::Index>(p);
    found_json["exposure_gains"].push_back({{"file", files[p]},
                                            {"factor", std::exp(found.log_gain[at])},
                                            {"relative_sigma", std::sqrt(found.covariance(at, at))}});
  }
  for (size_t s = 0; s < names.states.size() && found.Chosen().gains; ++s) {
    const Eigen::Index at = static_cast<Eigen::Index>(s);
    found_json["states"].push_back({{"state", names.states[s]},
                                    {"relative_sigma", found.state_sigma[at]},
                                    {"relative_sigma_prior", found.state_prior_sigma[at]}});
  }
  for (size_t c = 0; c < names.cameras.size(); ++c) {
    const auto k = found.vignetting.col(static_cast<Eigen::Index>(c)).head(found.Chosen().order);
    found_json["cameras"].push_back({{"camera", names.cameras[c]},
                                     {"vignetting_coefficients", std::vector<double>(k.begin(), k.end())},
                                     {"corner_sigma", found.corner_sigma},
                                     {"response_exponent", found.ResponsePower(static_cast<int>(c))},
                                     {"exponent_sigma", found.exponent_sigma}});
  }
  return found_json;
}

}  // namespace

void RecordRadiometry(const PhotoRadiometry& radiometry, const RoomPhotos& photos, const PhotoNames& names,
                      Findings& findings) {
  const SelfCalibration& found = radiometry.found;
  RecordCameraGains(names, found, radiometry.gains, findings);
  WarnOfUntiedCameras(names, radiometry.unit_camera, found, findings);
  WarnOfContradictions(names, found, findings);
  WarnOfCameras(names, found, radiometry.findings, findings);
  if (!found.is_possible) return;
  RecordChoice(photos.cameras, names, found, findings);
  WarnOfGains(names, photos, radiometry, findings);
  WarnOfLooseStates(names, radiometry.findings, findings);
}

void AddRadiometry(const PhotoRadiometry& radiometry, const LinearizedPhotos& photos, const PhotoNames& names,
                   nlohmann::json& artifact) {
  if (!radiometry.gains.empty()) artifact["camera_gains"] = CameraGainsJson(names, radiometry.gains);
  if (!radiometry.found.is_possible) return;
  std::vector<std::string> files;
  files.reserve(radiometry.photos.size());
  for (const size_t photo : radiometry.photos) files.push_back(photos.photos[photo].file);
  artifact["self_calibration"] = JsonOf(names, files, radiometry.found);
}

std::vector<Observation> WithSelfCalibration(const Session& session, const LinearizedPhotos& photos,
                                             const RegisteredSession& registered, const Patches& patches,
                                             const std::vector<StateExplanation>& states_as_if,
                                             std::vector<Observation> observations, RunContext& context,
                                             nlohmann::json& artifact) {
  const RoomPhotos given = RoomPhotosOf(session, photos);
  const StageTimer timer(context, "self_calibration", "");
  CorrectedObservations corrected =
      CorrectRadiometry(patches, given, registered.cameras, registered.registration.views,
                        DimmingSeen(StateTableOf(session), states_as_if), std::move(observations));
  if (corrected.radiometry) {
    const PhotoNames names = PhotoNamesOf(session, photos);
    RecordRadiometry(*corrected.radiometry, given, names, context);
    AddRadiometry(*corrected.radiometry, photos, names, artifact);
  }
  return std::move(corrected.observations);
}

}  // namespace luxfit
