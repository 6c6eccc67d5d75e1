#include "apps/stages/observe/observed_light.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/stages/linearize/linearize.h"
#include "apps/stages/session_light.h"
#include "apps/text/suggest.h"
#include "inverse/choose/self_calibration.h"

namespace luxfit {
namespace {

// Smallest error of ln exposure that gives a warning.
constexpr double kWorthAWarning = 0.08;
// Share of the prior's sigma above which the photos tell nothing of a state's exposures.
constexpr double kPriorAlone = 0.7;

const SessionPhoto* PhotoOf(const Session& session, const RegisteredSession& registered, int view,
                            int state) {
  const std::string& name = registered.registration.views[static_cast<size_t>(view)].view;
  for (const SessionPhoto& photo : session.photos) {
    if (photo.view == name && photo.state == session.states[static_cast<size_t>(state)].id) return &photo;
  }
  return nullptr;
}

// Numbers the photos of registered views in their order.
struct NumberedPhotos {
  std::map<std::pair<int, int>, int> number;  // by view, state
  std::vector<const SessionPhoto*> photos;
};

NumberedPhotos Number(const Session& session, const RegisteredSession& registered,
                      const std::vector<Observation>& observations) {
  NumberedPhotos numbered;
  for (const Observation& o : observations) {
    const bool is_new =
        numbered.number.emplace(std::pair(o.view, o.state), static_cast<int>(numbered.photos.size())).second;
    if (is_new) numbered.photos.push_back(PhotoOf(session, registered, o.view, o.state));
  }
  return numbered;
}

PhotoSample SampleOf(const Observation& observation, const RegisteredSession& registered,
                     const Patches& patches, const NumberedPhotos& numbered) {
  const RegisteredView& view = registered.registration.views[static_cast<size_t>(observation.view)];
  const Camera& camera = registered.cameras[static_cast<size_t>(view.camera)];
  const Vignetting frame = NoVignetting(camera.width_px, camera.height_px);
  const Eigen::Vector3d center = patches.elements[static_cast<size_t>(observation.element)].center;
  PhotoSample sample;
  sample.element = observation.element;
  sample.state = observation.state;
  sample.photo = numbered.number.at({observation.view, observation.state});
  sample.camera = view.camera;
  sample.radius2 = (Project(camera, view.cam_from_world * center) - frame.center_px).squaredNorm() /
                   (frame.radius_px * frame.radius_px);
  sample.log_value = std::log(observation.relative_luminance);
  const SessionPhoto* const photo = numbered.photos[static_cast<size_t>(sample.photo)];
  sample.log_share = sample.log_value + std::log(photo->bracket.front().relative_exposure_s);
  constexpr double kLeast = 1e-4;
  sample.relative_sigma = std::max(kLeast, std::sqrt(observation.variance) / observation.relative_luminance);
  return sample;
}

OpenRadiometry OpenOf(const Session& session) {
  OpenRadiometry open;
  for (const SessionCamera& camera : session.cameras) {
    open.vignetting.push_back(!camera.vignetting_model);
    open.response.push_back(!camera.response_curve);
  }
  return open;
}

std::vector<Eigen::VectorXd> DimmingOrOne(const Session& session) {
  if (session.luminaires.empty()) return {session.states.size(), Eigen::VectorXd::Ones(1)};
  return DimmingOf(session);
}

double Corner(const SelfCalibration& found, size_t camera) {
  return std::exp(found.vignetting.col(static_cast<Eigen::Index>(camera)).sum());
}

std::string HeldBy(const Session& session) {
  std::string held;
  for (const SessionCamera& camera : session.cameras) {
    if (camera.vignetting_model) held += fmt::format("; vignetting of {} is its flat field's", camera.id);
    if (camera.response_curve) held += fmt::format("; response of {} is its curve's", camera.id);
  }
  return held;
}

void RecordChoice(const Session& session, const SelfCalibration& found, RunContext& context) {
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
  for (size_t c = 0; c < session.cameras.size() && found.Chosen().order > 0; ++c) {
    if (!session.cameras[c].vignetting_model)
      choice.because += fmt::format("; the corner of {} has {:.1f} +- {:.2f} % of the centre's light",
                                    session.cameras[c].id, 100 * Corner(found, c), 100 * found.corner_sigma);
  }
  choice.because += HeldBy(session);
  context.choices.push_back(choice);
}

void WarnOfGains(const Session& session, const NumberedPhotos& numbered, const SelfCalibration& found,
                 RunContext& context) {
  for (size_t p = 0; p < numbered.photos.size(); ++p) {
    const double log_gain = found.log_gain[static_cast<Eigen::Index>(p)];
    if (std::abs(log_gain) < kWorthAWarning) continue;
    const double factor = std::exp(log_gain);
    const SessionPhoto& photo = *numbered.photos[p];
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

void WarnOfStates(const Session& session, const SelfCalibration& found, RunContext& context) {
  if (!found.Chosen().gains) return;
  std::vector<std::string> names;
  double sigma = 0;
  for (size_t s = 0; s < session.states.size(); ++s) {
    const Eigen::Index state = static_cast<Eigen::Index>(s);
    if (found.state_sigma[state] < kPriorAlone * found.state_prior_sigma[state] ||
        found.state_prior_sigma[state] == 0)
      continue;
    names.push_back(session.states[s].id);
    sigma = std::max(sigma, found.state_sigma[state]);
  }
  if (names.empty()) return;
  context.warnings.push_back(
      {"state_exposures_undetermined",
       fmt::format(
           "exposures differ from the stated ones, and nothing says by how much those of the photos of "
           "state {} do all together: fluxes of what is on in it share a further uncertainty of up to "
           "{:.1f} %, which their sigmas do not contain",
           fmt::join(names, ", "), 100 * sigma),
       "photograph a state with all luminaires on, or give a reading in each state"});
}

// Warns where the photos contradict what the session says of its cameras.
void WarnOfCameras(const Session& session, const SelfCalibration& found, RunContext& context) {
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    const SessionCamera& camera = session.cameras[c];
    const double exponent = 1 / (1 + found.exponent[static_cast<Eigen::Index>(c)]);
    if (found.Chosen().order > 0 && camera.vignetting == "none")
      context.warnings.push_back(
          {"vignetting_found",
           fmt::format(
               "the photos of camera \"{}\" darken towards the corners, to {:.1f} % of the centre's light; "
               "it was corrected here",
               camera.id, 100 * Corner(found, c)),
           "write vignetting = \"estimate\", or give a flat field"});
    if (found.Chosen().exponent && !camera.response_curve)
      context.warnings.push_back(
          {"response_not_linear",
           fmt::format(
               "counts of camera \"{}\" are not proportional to light, but go with its power {:.3f}; it "
               "was corrected here",
               camera.id, exponent),
           "develop the photos linearly, without a tone curve, or give response = \"estimate\" with "
           "brackets"});
    const bool is_told =
        found.Chosen().order > 0 || found.corner_sigma <= SelfCalibrationOptions().max_corner_sigma;
    if (camera.vignetting == "estimate" && !(found.is_possible && is_told))
      context.warnings.push_back(
          {"vignetting_undetermined",
           fmt::format("the vignetting of camera \"{}\" is not determined: {}; none was corrected", camera.id,
                       found.is_possible
                           ? "too few surfaces are seen both near the centre and near the border of photos"
                           : found.message),
           "add views that show the same walls in their middle and at their border, or give a flat field as "
           "vignetting"});
  }
}

nlohmann::json JsonOf(const Session& session, const NumberedPhotos& numbered, const SelfCalibration& found) {
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
  for (size_t p = 0; p < numbered.photos.size() && found.Chosen().gains; ++p) {
    const Eigen::Index at = static_cast<Eigen::Index>(p);
    found_json["exposure_gains"].push_back({{"file", numbered.photos[p]->file},
                                            {"factor", std::exp(found.log_gain[at])},
                                            {"relative_sigma", std::sqrt(found.covariance(at, at))}});
  }
  for (size_t s = 0; s < session.states.size() && found.Chosen().gains; ++s) {
    const Eigen::Index at = static_cast<Eigen::Index>(s);
    found_json["states"].push_back({{"state", session.states[s].id},
                                    {"relative_sigma", found.state_sigma[at]},
                                    {"relative_sigma_beforehand", found.state_prior_sigma[at]}});
  }
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    const auto k = found.vignetting.col(static_cast<Eigen::Index>(c)).head(found.Chosen().order);
    found_json["cameras"].push_back(
        {{"camera", session.cameras[c].id},
         {"vignetting_coefficients", std::vector<double>(k.begin(), k.end())},
         {"corner_sigma", found.corner_sigma},
         {"response_exponent", 1 / (1 + found.exponent[static_cast<Eigen::Index>(c)])},
         {"exponent_sigma", found.exponent_sigma}});
  }
  return found_json;
}

}  // namespace

std::vector<Observation> WithSelfCalibration(const Session& session, const RegisteredSession& registered,
                                             const Patches& patches, std::vector<Observation> observations,
                                             RunContext& context, nlohmann::json& artifact) {
  if (observations.empty()) return observations;
  const NumberedPhotos numbered = Number(session, registered, observations);
  std::vector<PhotoSample> samples;
  samples.reserve(observations.size());
  for (const Observation& o : observations) samples.push_back(SampleOf(o, registered, patches, numbered));
  const StageTimer timer(context, "self_calibration", "");
  const SelfCalibration found = SelfCalibrate(patches, DimmingOrOne(session), samples, OpenOf(session));
  WarnOfCameras(session, found, context);
  if (!found.is_possible) return observations;
  artifact["self_calibration"] = JsonOf(session, numbered, found);
  RecordChoice(session, found, context);
  WarnOfGains(session, numbered, found, context);
  WarnOfStates(session, found, context);
  for (size_t i = 0; i < observations.size(); ++i) {
    Observation& o = observations[i];
    const PhotoSample& sample = samples[i];
    const double factor =
        std::exp(found.CorrectionOf(sample.photo, sample.camera).LogFactor(sample.log_share, sample.radius2));
    o.relative_luminance *= factor;
    o.relative_rgb *= factor;
    o.variance = o.variance * factor * factor +
                 found.covariance(sample.photo, sample.photo) * o.relative_luminance * o.relative_luminance;
  }
  return observations;
}

}  // namespace luxfit
