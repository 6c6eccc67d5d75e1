#include "apps/stages/observe/observed_light.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/stages/linearize/camera_scale.h"
#include "apps/stages/linearize/linearize.h"
#include "apps/stages/session_light.h"
#include "apps/text/suggest.h"
#include "inverse/choose/calibrated_observations.h"

namespace luxfit {
namespace {

// Holds what the session says of the photos and cameras that the observations come from.
struct StatedRadiometry {
  std::vector<StatedPhoto> photos;
  std::vector<const LinearizedPhoto*> files;  // one for each of `photos`
  OpenRadiometry open;
  std::vector<StatedVignetting> vignetting;  // one for each camera
  std::vector<double> gains;                 // one for each camera; 1 where nothing is stated
  int unit_camera = 0;
};

const LinearizedPhoto* PhotoOf(const Session& session, const LinearizedPhotos& photos,
                               const RegisteredSession& registered, int view, int state) {
  const std::string& name = registered.registration.views[static_cast<size_t>(view)].view;
  for (const LinearizedPhoto& photo : photos.photos) {
    if (photo.view == name && photo.state == session.states[static_cast<size_t>(state)].id) return &photo;
  }
  return nullptr;
}

StatedVignetting VignettingOf(const SessionCamera& camera) {
  if (camera.vignetting == "none") return StatedVignetting::kNone;
  return camera.vignetting == "estimate" ? StatedVignetting::kEstimate : StatedVignetting::kFlatField;
}

StatedRadiometry StatedBy(const Session& session, const LinearizedPhotos& photos,
                          const RegisteredSession& registered, const std::vector<Observation>& observations) {
  StatedRadiometry stated;
  stated.photos = PhotosIn(observations);
  stated.files.reserve(stated.photos.size());
  for (StatedPhoto& photo : stated.photos) {
    stated.files.push_back(PhotoOf(session, photos, registered, photo.view, photo.state));
    photo.exposure_s = stated.files.back()->bracket.front().relative_exposure_s;
  }
  for (const LinearizedCamera& camera : photos.cameras) {
    stated.open.vignetting.push_back(!camera.vignetting);
    stated.open.response.push_back(!camera.response || camera.given.response == "srgb");
    stated.open.gain_is_stated.push_back(LuminancePerUnit(camera).has_value());
    stated.vignetting.push_back(VignettingOf(camera.given));
  }
  stated.gains = StatedGains(photos);
  stated.unit_camera = UnitCamera(photos);
  return stated;
}

// Returns the samples of observations in one unit. Counts are shares of full scale by each camera's own unit.
std::vector<PhotoSample> SamplesInOneUnit(const std::vector<Observation>& observations,
                                          const StatedRadiometry& stated, const Patches& patches,
                                          const RegisteredSession& registered) {
  std::vector<PhotoSample> samples =
      SamplesOf(observations, stated.photos, patches, registered.cameras, registered.registration.views);
  for (PhotoSample& sample : samples)
    sample.log_share += std::log(stated.gains[static_cast<size_t>(sample.camera)]);
  return samples;
}

// Returns the states as the photos say that they were: self-calibration must not blame photos for the table's mistake.
std::vector<Eigen::VectorXd> DimmingOrOne(const Session& session,
                                          const std::vector<StateExplanation>& explained) {
  if (!explained.empty()) return explained.front().dimming;
  if (session.luminaires.empty()) return {session.states.size(), Eigen::VectorXd::Ones(1)};
  return DimmingOf(session);
}

std::string HeldBy(const LinearizedPhotos& photos) {
  std::string held;
  for (const LinearizedCamera& camera : photos.cameras) {
    if (camera.vignetting) held += fmt::format("; vignetting of {} is its flat field's", camera.given.id);
    if (camera.response && camera.given.response != "srgb")
      held += fmt::format("; response of {} is its curve's", camera.given.id);
  }
  return held;
}

void RecordChoice(const LinearizedPhotos& photos, const SelfCalibration& found, RunContext& context) {
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
  for (size_t c = 0; c < photos.cameras.size() && found.Chosen().order > 0; ++c) {
    if (!photos.cameras[c].vignetting)
      choice.because += fmt::format("; the corner of {} has {:.1f} +- {:.2f} % of the centre's light",
                                    photos.cameras[c].given.id, 100 * found.CornerShare(static_cast<int>(c)),
                                    100 * found.corner_sigma);
  }
  choice.because += HeldBy(photos);
  context.choices.push_back(choice);
}

// Holds a camera's gain against the camera that it is relative to, as it was divided out.
struct AppliedGain {
  size_t camera = 0, reference = 0;
  double gain = 1, relative_sigma = 0;
  bool is_stated = false;
};

// Lists the cameras whose counts were divided by a gain.
std::vector<AppliedGain> AppliedGains(const StatedRadiometry& stated, const SelfCalibration& found) {
  std::vector<AppliedGain> applied;
  applied.reserve(found.camera_gains.size());
  for (size_t c = 0; c < found.camera_gains.size(); ++c) {
    const CameraGain& estimated = found.camera_gains[c];
    const size_t unit = static_cast<size_t>(stated.unit_camera);
    const size_t held = static_cast<size_t>(estimated.reference);
    if (stated.gains[c] != 1) {
      applied.push_back({c, unit, stated.gains[c], 0, true});
    } else if (estimated.sigma > 0) {
      // A camera of stated gain counts in the unit already.
      const size_t reference = stated.open.gain_is_stated[held] ? unit : held;
      applied.push_back({c, reference, std::exp(estimated.log_gain), estimated.sigma, false});
    }
  }
  return applied;
}

std::string GainText(const Session& session, const AppliedGain& applied) {
  const std::string& reference = session.cameras[applied.reference].id;
  if (applied.is_stated) return fmt::format("{:.4g} of {}'s", applied.gain, reference);
  return fmt::format("{:.3f} +- {:.3f} of {}'s", applied.gain, applied.gain * applied.relative_sigma,
                     reference);
}

void RecordCameraGains(const Session& session, const SelfCalibration& found,
                       const std::vector<AppliedGain>& gains, RunContext& context) {
  for (const AppliedGain& applied : gains) {
    const std::string because =
        applied.is_stated
            ? std::string("cdm2_per_count_s is given of both")
            : fmt::format(
                  "surfaces left out that several cameras see ask for it (mean squared normalised "
                  "error: cameras alike {:.3f}, each with its gain {:.3f})",
                  found.score_of_equal_cameras, found.score_of_camera_gains);
    context.choices.push_back(
        {"gain of " + session.cameras[applied.camera].id, GainText(session, applied), {}, because});
  }
}

nlohmann::json CameraGainsJson(const Session& session, const std::vector<AppliedGain>& gains) {
  nlohmann::json list = nlohmann::json::array();
  for (const AppliedGain& applied : gains)
    list.push_back({{"camera", session.cameras[applied.camera].id},
                    {"gain", applied.gain},
                    {"relative_sigma", applied.relative_sigma},
                    {"relative_to", session.cameras[applied.reference].id},
                    {"source", applied.is_stated ? "session" : "photos"}});
  return list;
}

void WarnOfUntiedCameras(const Session& session, const StatedRadiometry& stated, const SelfCalibration& found,
                         RunContext& context) {
  std::vector<std::string> untied;
  for (size_t c = 0; c < found.camera_gains.size(); ++c) {
    if (!found.camera_gains[c].is_tied) untied.push_back(session.cameras[c].id);
  }
  if (untied.empty()) return;
  context.warnings.push_back(
      {"camera_gain_undetermined",
       fmt::format("nothing tells the sensitivity of camera {} against that of camera {}: they share too few "
                   "surfaces in one state, and their counts were taken to mean the same light",
                   fmt::join(untied, ", "), session.cameras[static_cast<size_t>(stated.unit_camera)].id),
       "photograph the same surfaces with both cameras in the same state, or give cdm2_per_count_s of both"});
}

void WarnOfContradictions(const Session& session, const SelfCalibration& found, RunContext& context) {
  for (const GainContradiction& c : found.contradictions)
    context.warnings.push_back(
        {"camera_scales_contradict",
         fmt::format(
             "surfaces are {:.3f} +- {:.3f} times as bright in photos of camera \"{}\" as in those of "
             "\"{}\", by the cdm2_per_count_s of both; they were not adjusted to each other",
             std::exp(c.log_ratio), c.sigma * std::exp(c.log_ratio),
             session.cameras[static_cast<size_t>(c.camera)].id,
             session.cameras[static_cast<size_t>(c.reference)].id),
         "check cdm2_per_count_s of both, for the ISO and aperture of each camera's first photo; or give one "
         "only, and the other camera's gain is estimated"});
}

void WarnOfGains(const Session& session, const StatedRadiometry& stated, const SelfCalibration& found,
                 const RadiometryFindings& findings, RunContext& context) {
  for (const int p : findings.wrong_photos) {
    const double factor = std::exp(found.log_gain[p]);
    const LinearizedPhoto& photo = *stated.files[static_cast<size_t>(p)];
    context.warnings.push_back(
        {"exposure_metadata",
         fmt::format(
             "{}: surfaces are {:.3f} times as bright as the other photos say of state {}: its exposure "
             "is not the stated one, or the light had changed; it was corrected here",
             PhotoName(session, photo.bracket.front()), factor, photo.state),
         fmt::format("check its exposure_s and ISO (automatic ISO?): {:.3f} times the stated exposure would "
                     "fit; or take it again",
                     factor)});
  }
}

void WarnOfStates(const Session& session, const RadiometryFindings& findings, RunContext& context) {
  if (findings.loose_states.empty()) return;
  std::vector<std::string> names;
  names.reserve(findings.loose_states.size());
  for (const int s : findings.loose_states) names.push_back(session.states[static_cast<size_t>(s)].id);
  context.warnings.push_back(
      {"state_exposures_undetermined",
       fmt::format(
           "exposures differ from the stated ones, and nothing says by how much those of the photos of "
           "state {} do all together: fluxes of what is on in it share a further uncertainty of up to "
           "{:.1f} %, which their sigmas do not contain",
           fmt::join(names, ", "), 100 * findings.loose_sigma),
       "photograph a state with all luminaires on, or give a reading in each state"});
}

// Warns where the photos contradict what the session says of its cameras.
void WarnOfCameras(const Session& session, const SelfCalibration& found, const RadiometryFindings& findings,
                   RunContext& context) {
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    const std::string& id = session.cameras[c].id;
    const int camera = static_cast<int>(c);
    if (findings.cameras[c].darkens)
      context.warnings.push_back(
          {"vignetting_found",
           fmt::format(
               "the photos of camera \"{}\" darken towards the corners, to {:.1f} % of the centre's light; "
               "it was corrected here",
               id, 100 * found.CornerShare(camera)),
           "write vignetting = \"estimate\", or give a flat field"});
    if (findings.cameras[c].is_curved)
      context.warnings.push_back(
          {"response_not_linear",
           fmt::format(
               "counts of camera \"{}\" are not proportional to light, but go with its power {:.3f}; it "
               "was corrected here",
               id, found.ResponsePower(camera)),
           "develop the photos linearly, without a tone curve, or give response = \"estimate\" with "
           "brackets"});
    if (findings.cameras[c].vignetting_is_undetermined)
      context.warnings.push_back(
          {"vignetting_undetermined",
           fmt::format("the vignetting of camera \"{}\" is not determined: {}; none was corrected", id,
                       found.is_possible
                           ? "too few surfaces are seen both near the centre and near the border of photos"
                           : found.message),
           "add views that show the same walls in their middle and at their border, or give a flat field as "
           "vignetting"});
  }
}

nlohmann::json JsonOf(const Session& session, const StatedRadiometry& stated, const SelfCalibration& found) {
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
  for (size_t p = 0; p < stated.files.size() && found.Chosen().gains; ++p) {
    const Eigen::Index at = static_cast<Eigen::Index>(p);
    found_json["exposure_gains"].push_back({{"file", stated.files[p]->file},
                                            {"factor", std::exp(found.log_gain[at])},
                                            {"relative_sigma", std::sqrt(found.covariance(at, at))}});
  }
  for (size_t s = 0; s < session.states.size() && found.Chosen().gains; ++s) {
    const Eigen::Index at = static_cast<Eigen::Index>(s);
    found_json["states"].push_back({{"state", session.states[s].id},
                                    {"relative_sigma", found.state_sigma[at]},
                                    {"relative_sigma_prior", found.state_prior_sigma[at]}});
  }
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    const auto k = found.vignetting.col(static_cast<Eigen::Index>(c)).head(found.Chosen().order);
    found_json["cameras"].push_back({{"camera", session.cameras[c].id},
                                     {"vignetting_coefficients", std::vector<double>(k.begin(), k.end())},
                                     {"corner_sigma", found.corner_sigma},
                                     {"response_exponent", found.ResponsePower(static_cast<int>(c))},
                                     {"exponent_sigma", found.exponent_sigma}});
  }
  return found_json;
}

}  // namespace

std::vector<Observation> WithSelfCalibration(const Session& session, const LinearizedPhotos& photos,
                                             const RegisteredSession& registered, const Patches& patches,
                                             const std::vector<StateExplanation>& states_as_if,
                                             std::vector<Observation> observations, RunContext& context,
                                             nlohmann::json& artifact) {
  if (observations.empty()) return observations;
  const StatedRadiometry stated = StatedBy(session, photos, registered, observations);
  const std::vector<PhotoSample> samples = SamplesInOneUnit(observations, stated, patches, registered);
  const StageTimer timer(context, "self_calibration", "");
  const SelfCalibration found =
      SelfCalibrate(patches, DimmingOrOne(session, states_as_if), samples, stated.open);
  const RadiometryFindings findings = FindingsOf(found, stated.open, stated.vignetting);
  const std::vector<AppliedGain> gains = AppliedGains(stated, found);
  if (!gains.empty()) artifact["camera_gains"] = CameraGainsJson(session, gains);
  RecordCameraGains(session, found, gains, context);
  WarnOfUntiedCameras(session, stated, found, context);
  WarnOfContradictions(session, found, context);
  WarnOfCameras(session, found, findings, context);
  if (!found.is_possible) return observations;
  artifact["self_calibration"] = JsonOf(session, stated, found);
  RecordChoice(photos, found, context);
  WarnOfGains(session, stated, found, findings, context);
  WarnOfStates(session, findings, context);
  return WithCorrections(std::move(observations), samples, found);
}

}  // namespace luxfit
