#include "apps/session/session_corrections.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/text/formats/json_vectors.h"

namespace luxfit {
namespace {

using nlohmann::json;

[[noreturn]] void FailOf(const std::string& what) {
  throw std::invalid_argument("Corrected: expected corrections of this session, got " + what);
}

void CorrectStates(const SessionCorrections& corrections, Session& session) {
  for (const auto& [id, dimming] : corrections.dimming) {
    const int state = StateIndex(session, id);
    if (state < 0) FailOf("state " + id);
    session.states[static_cast<size_t>(state)].dimming = dimming;
  }
}

// Changes all at once: two photos may have been exchanged.
void CorrectPhotos(const std::vector<CorrectedPhoto>& corrected, Session& session) {
  for (SessionPhoto& photo : session.photos) {
    const std::string& camera = session.cameras[static_cast<size_t>(photo.camera)].id;
    const auto of_photo = std::find_if(corrected.begin(), corrected.end(), [&](const CorrectedPhoto& c) {
      return c.camera == camera && c.view == photo.view && c.state == photo.state;
    });
    if (of_photo != corrected.end()) photo.state = of_photo->as_state;
  }
}

void CorrectReadings(const std::vector<SessionReading>& corrected, Session& session) {
  std::vector<SessionReading>& readings = session.luxmeter.readings;
  for (const SessionReading& row : corrected) {
    const auto given = std::find_if(readings.begin(), readings.end(),
                                    [&](const SessionReading& r) { return r.line == row.line; });
    if (given == readings.end()) FailOf("a reading in line " + std::to_string(row.line));
    given->position_m = row.position_m;
    given->normal = row.normal;
    given->state = row.state;
    given->illuminance_lx = row.illuminance_lx;
  }
}

json ReadingJson(const SessionReading& r) {
  return {{"id", r.id},
          {"line", r.line},
          {"state", r.state},
          {"position_m", VectorJson(r.position_m)},
          {"normal", VectorJson(r.normal)},
          {"illuminance_lx", r.is_measured ? json(r.illuminance_lx) : json()}};
}

SessionReading ReadingFromJson(const json& in) {
  SessionReading r;
  r.id = in.at("id");
  r.line = in.at("line");
  r.state = in.at("state");
  r.position_m = VectorFromJson(in.at("position_m"));
  r.normal = VectorFromJson(in.at("normal"));
  r.is_measured = in.at("illuminance_lx").is_number();
  if (r.is_measured) r.illuminance_lx = in.at("illuminance_lx");
  return r;
}

}  // namespace

Session Corrected(Session session, const SessionCorrections& corrections) {
  CorrectStates(corrections, session);
  CorrectPhotos(corrections.photos, session);
  CorrectReadings(corrections.readings, session);
  if (corrections.mesh && session.scene) session.scene->mesh_move = corrections.mesh;
  return session;
}

json CorrectionsJson(const SessionCorrections& corrections) {
  json out = json::object();
  if (!corrections.dimming.empty()) out["states"] = corrections.dimming;
  for (const CorrectedPhoto& p : corrections.photos)
    out["photos"].push_back(
        {{"camera", p.camera}, {"view", p.view}, {"state", p.state}, {"as_state", p.as_state}});
  for (const SessionReading& r : corrections.readings) out["readings"].push_back(ReadingJson(r));
  if (corrections.mesh)
    out["mesh"] = {{"right_from_given", MatrixJson(corrections.mesh->right_from_given.matrix())},
                   {"furniture_alone", corrections.mesh->is_furniture_alone}};
  return out;
}

SessionCorrections CorrectionsFromJson(const json& in) {
  SessionCorrections corrections;
  if (in.contains("states")) corrections.dimming = in.at("states");
  for (const json& p : in.value("photos", json::array()))
    corrections.photos.push_back({p.at("camera"), p.at("view"), p.at("state"), p.at("as_state")});
  for (const json& r : in.value("readings", json::array()))
    corrections.readings.push_back(ReadingFromJson(r));
  if (in.contains("mesh")) {
    MeshMove move;
    move.right_from_given.matrix() = MatrixFromJson(in.at("mesh").at("right_from_given"));
    move.is_furniture_alone = in.at("mesh").at("furniture_alone");
    corrections.mesh = move;
  }
  return corrections;
}

}  // namespace luxfit
