#include "apps/stages/check/applied_explanations.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/stages/check/explain_check.h"
#include "apps/text/formats/artifact.h"
#include "inverse/observe/as_if/mesh_as_if.h"

namespace luxfit {
namespace {

// Says what was corrected. `evidence`: a sentence without a full stop.
void Record(const std::string& what, const std::string& as_if, const std::string& evidence,
            const std::string& remedy, Findings& findings) {
  findings.choices.push_back({what, as_if, {"as given", as_if}, evidence});
  findings.warnings.push_back(
      {"session_corrected", fmt::format("{}; the fit takes {} so (--apply)", evidence, what), remedy});
}

bool TakeMesh(const std::vector<MeshExplanation>& explanations, AppliedExplanations& applied) {
  if (explanations.size() != 1 || applied.corrections.mesh) return false;
  const MeshExplanation& e = explanations.front();
  applied.corrections.mesh = MeshMove{e.right_from_given, e.is_furniture_alone};
  Record("the mesh", e.as_if, InWords(explanations), e.remedy, applied.findings);
  return true;
}

// A table may say 0 of what is off.
std::map<std::string, double> WithoutZeros(std::map<std::string, double> dimming) {
  for (auto at = dimming.begin(); at != dimming.end();)
    at = at->second > 0 ? std::next(at) : dimming.erase(at);
  return dimming;
}

bool TakeStates(const Session& session, const std::vector<StateExplanation>& explanations,
                AppliedExplanations& applied) {
  if (explanations.size() != 1 || !explanations.front().IsOfTable() || !applied.corrections.dimming.empty())
    return false;
  const StateExplanation& e = explanations.front();
  for (size_t s = 0; s < session.states.size(); ++s) {
    std::map<std::string, double> dimming;
    for (size_t k = 0; k < session.luminaires.size(); ++k) {
      const double value = e.dimming[s][static_cast<Eigen::Index>(k)];
      if (value > 0) dimming[session.luminaires[k].id] = value;
    }
    if (dimming != WithoutZeros(session.states[s].dimming))
      applied.corrections.dimming[session.states[s].id] = std::move(dimming);
  }
  Record("[states]", e.as_if, InWords(explanations), e.remedy, applied.findings);
  return true;
}

// Photos of a state of which the view has another photo are left out as before: nobody knows which of the two to use.
bool TakePhotos(const PreparedSession& prepared, AppliedExplanations& applied) {
  if (!applied.corrections.photos.empty()) return false;
  const Session& session = prepared.session;
  const std::vector<PhotoAsIf>& found = prepared.observed.photos_as_if;
  const auto name = [&](int state) { return session.states[static_cast<size_t>(state)].id; };
  for (const PhotoAsIf& photo : found) {
    if (!photo.is_exchanged) continue;
    const RegisteredView& view = prepared.registered.registration.views[static_cast<size_t>(photo.view)];
    const std::string &camera = session.cameras[static_cast<size_t>(view.camera)].id,
                      state = name(photo.state), as_if = name(photo.as_if);
    applied.corrections.photos.push_back({camera, view.view, state, as_if});
    if (photo.state > photo.as_if) continue;  // the other photo of the two says it
    Record(
        fmt::format("photos of view {}", view.view), fmt::format("{} and {} exchanged", state, as_if),
        fmt::format("the pattern of light of photos {0} and {1} of view {2} differs from the other views' by "
                    "{3:.1f} % as given and by {4:.1f} % the other way round",
                    state, as_if, view.view, 100 * photo.difference, 100 * photo.difference_as_if),
        fmt::format("exchange their states, {} and {}, in the photo table", state, as_if), applied.findings);
  }
  return !applied.corrections.photos.empty();
}

// Returns the rows of the table as they are so read; those alone that change.
std::vector<SessionReading> SoRead(const Session& session, const std::vector<LuminaireReading>& readings,
                                   const ReadingExplanation& explanation) {
  std::vector<SessionReading> corrected;
  for (const SessionReading& given : session.luxmeter.readings) {
    const auto own = std::find_if(readings.begin(), readings.end(),
                                  [&](const LuminaireReading& r) { return r.given.line == given.line; });
    const double ambient_lx = own == readings.end() ? 0 : own->ambient_lx;
    const ReadingAsGiven as_given{given.id,
                                  {given.position_m, given.normal, session.luxmeter.response},
                                  StateIndex(session, given.state),
                                  given.illuminance_lx - ambient_lx,
                                  0,
                                  given.role != ReadingRole::kCheck};
    const ReadingAsGiven right = explanation.so_read(as_given);
    const bool is_same = right.sensor == as_given.sensor && right.state == as_given.state &&
                         right.measured_lx == as_given.measured_lx;
    if (is_same) continue;
    SessionReading row = given;
    row.position_m = right.sensor.position;
    row.normal = right.sensor.normal;
    if (right.state >= 0) row.state = session.states[static_cast<size_t>(right.state)].id;
    if (row.is_measured) row.illuminance_lx = right.measured_lx + ambient_lx;
    corrected.push_back(std::move(row));
  }
  return corrected;
}

}  // namespace

bool TakeFromPhotos(const PreparedSession& prepared, AppliedExplanations& applied) {
  // A mesh that lies elsewhere misleads all that looks for the light on it.
  if (TakeMesh(prepared.mesh_as_if, applied)) return true;
  const bool has_photos = TakePhotos(prepared, applied);
  return TakeStates(prepared.session, prepared.observed.states_as_if, applied) || has_photos;
}

bool TakeFromReadings(const PreparedSession& prepared, const Session& fitted, const RoomFit& fit,
                      AppliedExplanations& applied) {
  // Readings do not yield to a light that is in doubt itself.
  const bool is_in_doubt = !prepared.mesh_as_if.empty() || !prepared.observed.states_as_if.empty() ||
                           fit.findings.IsUndetermined();
  if (is_in_doubt || !applied.corrections.readings.empty()) return false;
  const std::vector<LuminaireReading>& readings = prepared.linearized.readings;
  const std::vector<ReadingExplanation> explanations = ExplainCheck(fitted, readings, prepared.room, fit);
  if (explanations.size() != 1 || !explanations.front().so_read) return false;
  const ReadingExplanation& e = explanations.front();
  applied.corrections.readings = SoRead(fitted, readings, e);
  if (applied.corrections.readings.empty()) return false;
  Record("the readings", e.as_if, InWords(explanations), e.remedy, applied.findings);
  return true;
}

SessionInputs WithCorrections(SessionInputs inputs, const SessionCorrections& corrections) {
  SessionCorrections of_photos = corrections;
  of_photos.readings.clear();
  if (!corrections.readings.empty())
    inputs.furniture["corrections of readings"] = HashText(CorrectionsJson(corrections).dump());
  if (of_photos.IsEmpty()) return inputs;
  const std::string hash = HashText(CorrectionsJson(of_photos).dump());
  for (StageInputs* stage : {&inputs.linearize, &inputs.registration, &inputs.observe, &inputs.furniture})
    (*stage)["corrections"] = hash;
  return inputs;
}

}  // namespace luxfit
