#include "apps/stages/degradations.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "apps/stages/internal/observed_light.h"
#include "apps/text/suggest.h"
#include "inverse/study/degrade.h"

namespace luxfit {
namespace {

// Same numbers at every level of one degradation's trial.
std::mt19937_64 RngOf(uint64_t seed, const std::string& name, int trial) {
  std::vector<uint32_t> words{static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32),
                              static_cast<uint32_t>(trial)};
  for (const char c : name) words.push_back(static_cast<uint32_t>(c));
  std::seed_seq sequence(words.begin(), words.end());
  return std::mt19937_64(sequence);
}

int ShareOf(double percent, int count) { return static_cast<int>(std::lround(percent / 100 * count)); }

// Elements observed, each once.
std::vector<int> ElementsOf(const std::vector<Observation>& observations) {
  std::set<int> elements;
  for (const Observation& o : observations) elements.insert(o.element);
  return {elements.begin(), elements.end()};
}

}  // namespace

const std::vector<Degradation>& AllDegradations() {
  static const std::vector<Degradation> all{
      {DegradationKind::kNoise, "noise", "%", "noise of a pixel, % of its value", {2, 10, 30, 100, 300}},
      {DegradationKind::kExposure, "exposure", "%", "error of each photo's exposure, %", {1, 2, 5, 10, 20}},
      {DegradationKind::kViewsDropped, "views_dropped", "%", "views left out, %", {25, 50, 75, 88}, false},
      {DegradationKind::kStatesDropped,
       "states_dropped",
       "%",
       "states left out, %",
       {17, 33, 50, 67, 83},
       false},
      {DegradationKind::kTagsMoved,
       "tags_moved",
       "mm",
       "error of each tag's place along each axis, mm",
       {1, 3, 10, 30, 100}},
      {DegradationKind::kFacesRemoved,
       "faces_removed",
       "%",
       "furniture missing from the mesh, %",
       {25, 50, 75, 100},
       false},
      {DegradationKind::kLuminairesTogether,
       "luminaires_together",
       "m",
       "distance of the nearest two luminaires, m",
       {1, 0.5, 0.25, 0.1, 0.05}},
      {DegradationKind::kAlbedoRaised,
       "albedo_raised",
       "%",
       "reflectances raised, % of the way to 0.95",
       {0, 30, 60, 80, 95},
       false}};
  return all;
}

std::vector<Degradation> DegradationsNamed(const std::vector<std::string>& names) {
  if (names.empty()) return AllDegradations();
  std::vector<std::string> known;
  for (const Degradation& d : AllDegradations()) known.push_back(d.name);
  for (const std::string& name : names) {
    if (std::count(known.begin(), known.end(), name) == 0)
      throw std::runtime_error("--only: " + ExpectedOneOf(known, name));
  }
  std::vector<Degradation> chosen;
  for (const Degradation& d : AllDegradations()) {
    if (std::count(names.begin(), names.end(), d.name) > 0) chosen.push_back(d);
  }
  return chosen;
}

// What one trial fits; pointers to what it did not change.
struct DegradedSessions::Case {
  Session session;
  const Room* room = nullptr;
  std::optional<Room> own_room;
  std::vector<Observation> observations;
  std::vector<EstimatedLuminaire> truth;
  RunContext context;  // what observing again warned of
};

DegradedSessions::DegradedSessions(const PreparedSession& prepared, std::vector<EstimatedLuminaire> truth,
                                   int max_elements, uint64_t seed, RunContext& context)
    : prepared_(prepared),
      max_elements_(max_elements),
      seed_(seed),
      context_(context),
      truth_(std::move(truth)),
      thinned_(ThinElements(prepared.observations, max_elements)) {
  undegraded_ = RefitSession(prepared.session, prepared.room, {thinned_, {}}, context);
  if (truth_.empty()) truth_ = undegraded_.luminaires;
  known_warnings_ = undegraded_.warnings;
  for (const Warning& warning : context.warnings) known_warnings_.push_back(warning.code);
  undegraded_score_ = ScoreFit(undegraded_.luminaires, truth_, !undegraded_.warnings.empty());
}

std::optional<std::string> DegradedSessions::WhyNot(const Degradation& degradation) const {
  switch (degradation.kind) {
    case DegradationKind::kNoise:
    case DegradationKind::kExposure:
      if (thinned_.empty()) return "the session has no photos";
      break;
    case DegradationKind::kViewsDropped:
      if (CountViews(thinned_) < 2) return "fewer than two views are observed";
      break;
    case DegradationKind::kStatesDropped:
      if (CountStates(thinned_) < 2) return "fewer than two states are observed";
      break;
    case DegradationKind::kTagsMoved:
      for (const RegisteredView& view : prepared_.registered.registration.views) {
        if (MethodOf(view) != "tags") return "views are registered by more than tags";
      }
      if (prepared_.session.tags.survey.empty() || thinned_.empty()) return "no surveyed tags are used";
      break;
    case DegradationKind::kFacesRemoved:
      if (thinned_.empty() || LoosePieces(prepared_.room.scene).empty())
        return "the session has no photos, or its mesh no furniture";
      break;
    case DegradationKind::kLuminairesTogether:
      if (undegraded_.luminaires.size() < 2) return "fewer than two luminaires were found";
      [[fallthrough]];
    case DegradationKind::kAlbedoRaised:
      if (!prepared_.session.scene) return "the session has no scene to simulate";
      break;
  }
  if (undegraded_.undetermined) return "the undegraded session leaves its luminaires undetermined";
  return std::nullopt;
}

DegradedSessions::Case DegradedSessions::Degrade(const Degradation& degradation, double level,
                                                 std::mt19937_64& rng) {
  Case c;
  c.session = prepared_.session;
  c.room = &prepared_.room;
  c.observations = thinned_;
  c.truth = truth_;
  c.context.out = context_.out;
  c.context.is_quiet = true;
  switch (degradation.kind) {
    case DegradationKind::kNoise:
      c.observations = WithPixelNoise(thinned_, level / 100, rng);
      break;
    case DegradationKind::kExposure: {
      nlohmann::json unused;
      c.observations = WithSelfCalibration(c.session, prepared_.registered, prepared_.room.patches,
                                           WithExposureErrors(thinned_, level / 100, rng), c.context, unused);
      break;
    }
    case DegradationKind::kViewsDropped: {
      const int views = CountViews(thinned_);
      c.observations = WithoutViews(thinned_, std::clamp(ShareOf(level, views), 1, views - 1), rng);
      break;
    }
    case DegradationKind::kStatesDropped: {
      const int states = CountStates(thinned_);
      c.observations = WithoutStates(thinned_, std::clamp(ShareOf(level, states), 1, states - 1), rng);
      break;
    }
    case DegradationKind::kTagsMoved:
      ObserveWithMovedTags(level / 1000, rng, c);
      break;
    case DegradationKind::kFacesRemoved:
      ObserveWithoutFurniture(level, rng, c);
      break;
    case DegradationKind::kLuminairesTogether:
    case DegradationKind::kAlbedoRaised:
      Simulate(degradation, level, rng, c);
      break;
  }
  return c;
}

void DegradedSessions::ObserveWithMovedTags(double sigma_m, std::mt19937_64& rng, Case& c) {
  const std::vector<Camera>& cameras = prepared_.registered.cameras;
  if (!detections_)
    detections_ = DetectViews(prepared_.session, cameras, PhotosByView(prepared_.session), c.context);
  c.session.tags.survey = WithMovedTags(c.session.tags.survey, sigma_m, rng);
  RegisteredSession registered;
  registered.cameras = cameras;
  registered.registration = RegisterViews(cameras, c.session.tags.survey, *detections_);
  for (const RegistrationNote& note : registered.registration.notes)
    c.context.warnings.push_back({note.code, note.message, note.remedy});
  if (!registered.registration.IsUsable())
    throw std::runtime_error("no view has a pose: " + registered.registration.message);
  const std::vector<double>& focal_scale = registered.registration.focal_scale;
  for (size_t i = 0; i < focal_scale.size(); ++i) {
    if (focal_scale[i] == 1) continue;
    registered.cameras[i] = WithFocalScale(cameras[i], focal_scale[i]);
    c.context.warnings.push_back({"focal_length_off", "the tags contradict the focal length", ""});
  }
  c.observations =
      ThinElements(ObserveSession(c.session, registered, *c.room, c.context).observations, max_elements_);
}

void DegradedSessions::ObserveWithoutFurniture(double share, std::mt19937_64& rng, Case& c) {
  const Scene whole = LoadMesh(prepared_.session).scene;
  const int pieces = static_cast<int>(LoosePieces(whole).size());
  c.own_room = MakeRoom(WithoutPieces(whole, std::clamp(ShareOf(share, pieces), 1, pieces), rng));
  c.room = &*c.own_room;
  c.observations = ThinElements(
      ObserveSession(c.session, prepared_.registered, *c.room, c.context).observations, max_elements_);
}

void DegradedSessions::Simulate(const Degradation& degradation, double level, std::mt19937_64& rng, Case& c) {
  LightState light = undegraded_.fit.fit.state;
  if (degradation.kind == DegradationKind::kLuminairesTogether) {
    light.luminaires = WithLuminairesTogether(light.luminaires, level);
  } else {
    light.albedo = WithRaisedAlbedo(light.albedo, level / 100);
  }
  const std::vector<Reading>& readings = undegraded_.fit.data.readings;
  const auto key = std::make_pair(degradation.kind, level);
  if (traced_.count(key) == 0)
    traced_[key] = TraceLight(prepared_.room, ElementsOf(thinned_), readings, light);
  const LightData data =
      SimulateLight(prepared_.room, traced_.at(key), light, undegraded_.fit.data.dimming, readings, rng);
  c.observations = data.observations;
  for (size_t r = 0; r < data.readings.size(); ++r) {
    c.session.luxmeter.readings[r].illuminance_lx = data.readings[r].illuminance_lx;
    c.session.luxmeter.readings[r].ambient_lx = 0;
  }
  for (size_t m = 0; m < prepared_.room.scene.materials.size(); ++m) {
    const auto known = c.session.scene->known_albedo_rgb.find(prepared_.room.scene.materials[m]);
    if (known != c.session.scene->known_albedo_rgb.end())
      known->second.setConstant(light.albedo[static_cast<Eigen::Index>(m)]);
  }
  c.truth.clear();
  for (size_t k = 0; k < light.luminaires.size(); ++k) {
    const Luminaire& lamp = light.luminaires[k];
    if (k < c.session.luminaires.size() && c.session.luminaires[k].position_m)
      c.session.luminaires[k].position_m = lamp.position;
    c.truth.push_back({lamp.id, lamp.position, Eigen::Vector3d::Zero(), lamp.flux_lm, 0});
  }
}

DegradedFit DegradedSessions::Fit(const Degradation& degradation, double level, int trial) {
  std::mt19937_64 rng = RngOf(seed_, degradation.name, trial);
  DegradedFit result;
  const auto start = std::chrono::steady_clock::now();
  try {
    const Case c = Degrade(degradation, level, rng);
    result.refit = RefitSession(c.session, *c.room, {c.observations, {}}, context_);
    for (const Warning& warning : c.context.warnings) result.refit.warnings.push_back(warning.code);
    for (const std::string& code : result.refit.warnings) {
      if (std::count(known_warnings_.begin(), known_warnings_.end(), code) == 0)
        result.new_warnings.push_back(code);
    }
    result.score = ScoreFit(result.refit.luminaires, c.truth, !result.new_warnings.empty());
  } catch (const std::runtime_error& e) {  // what the program says instead of a result
    result.failed = true;
    result.message = e.what();
    result.score = ScoreFit({}, truth_, true);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace luxfit
