#include "apps/stages/check/session_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "forward/room/in_room.h"

namespace luxfit {
namespace {

constexpr size_t kNamedPlaces = 5;

bool IsReadingOutside(const RayScene& rays, const SessionReading& reading) {
  return !IsInRoom(rays, LiftedOff(reading.position_m, reading.normal));
}

std::string PlaceText(const Eigen::Vector3d& p) {
  return fmt::format("({:g}, {:g}, {:g}) m", p.x(), p.y(), p.z());
}

// Says in which other unit the place would be inside; empty where in none.
std::string UnitHint(const RayScene& rays, const Eigen::Vector3d& p) {
  constexpr double kNoHeightM = 10;  // few meters are read above it, and nearly all that are in cm or mm
  for (const auto& [unit, metres] : {std::pair{"cm", 0.01}, std::pair{"mm", 0.001}}) {
    if (std::abs(p.z()) > kNoHeightM && IsInRoom(rays, {p.x(), p.y(), metres * p.z()}))
      return fmt::format("its z_m may be in {}", unit);
    if (p.norm() > kNoHeightM && IsInRoom(rays, metres * p))
      return fmt::format("its place may be in {}", unit);
  }
  return "";
}

// Says where a reading stands, as its table and the mesh tell.
std::string WhereText(const RayScene& rays, const SessionReading& reading) {
  const std::string place = fmt::format("{} at {}", reading.id, PlaceText(reading.position_m));
  const RayHit hit = rays.Trace(LiftedOff(reading.position_m, reading.normal), reading.normal);
  constexpr double kNearM = 0.3;
  if (hit.facet >= 0 && !hit.front && hit.distance < kNearM)
    return fmt::format("{}, {:.3g} mm behind a surface", place, 1000 * hit.distance);
  const std::string unit = UnitHint(rays, reading.position_m);
  return unit.empty() ? place : place + ", " + unit;
}

// Tells whether most places are inside once the mesh's y axis is taken as up.
bool AreInsideWithYUp(const RayScene& rays, const std::vector<Eigen::Vector3d>& places) {
  const auto inside = std::count_if(places.begin(), places.end(), [&](const Eigen::Vector3d& p) {
    return IsInRoom(rays, {p.x(), p.z(), -p.y()});
  });
  return 2 * inside > static_cast<std::ptrdiff_t>(places.size());
}

void WarnOfReadings(const std::map<std::string, SessionReading>& outside, size_t places, const RayScene& rays,
                    std::vector<Warning>& warnings) {
  if (outside.empty()) return;
  std::vector<std::string> named;
  std::vector<Eigen::Vector3d> points;
  for (const auto& [id, reading] : outside) {
    points.push_back(reading.position_m);
    if (named.size() < kNamedPlaces) named.push_back(WhereText(rays, reading));
  }
  if (outside.size() > named.size())
    named.push_back(fmt::format("and {} more", outside.size() - named.size()));
  warnings.push_back({"reading_outside",
                      fmt::format("{} of {} meter places lie outside the room, inside a solid or on the back "
                                  "of a surface, and their "
                                  "readings are left out: {}",
                                  outside.size(), places, fmt::join(named, "; ")),
                      AreInsideWithYUp(rays, points)
                          ? "they lie inside where the mesh's y axis is up: export the mesh with z up"
                          : "correct x_m, y_m and z_m in the table of readings; where the places are right, "
                            "the mesh, its unit or its "
                            "frame is not",
                      true});
}

void WarnOfLuminaire(const SessionLuminaire& luminaire, const RayScene& rays,
                     std::vector<Warning>& warnings) {
  if (!luminaire.position_m) return;
  const Eigen::Vector3d& p = *luminaire.position_m;
  constexpr double kRecessedM = 0.005;
  const Eigen::Vector3d aim = luminaire.aim.value_or(-Eigen::Vector3d::UnitZ());
  if (IsInRoom(rays, p) || IsInRoom(rays, p + kRecessedM * aim)) return;
  std::string hint = UnitHint(rays, p);
  if (hint.empty() && AreInsideWithYUp(rays, {p})) hint = "it lies inside where the mesh's y axis is up";
  warnings.push_back(
      {"luminaire_outside",
       fmt::format(
           "luminaire {} at {} lies inside a solid, outside the room or on the far side of a wall: rays from "
           "there meet the backs of surfaces, or nothing{}",
           luminaire.id, PlaceText(p), hint.empty() ? "" : "; " + hint),
       "check position_m and scene.unit; a recessed luminaire belongs just below the ceiling's surface; a "
       "facet whose "
       "corners run clockwise seen from inside the room has its front on the wrong side",
       luminaire.is_held || luminaire.position_sigma_m == 0.0});
}

void WarnOfNamesUsedOnce(const Session& session, std::vector<Warning>& warnings) {
  std::map<std::string, int> uses;
  for (const SessionState& state : session.states) {
    for (const auto& [id, dimming] : state.dimming) ++uses[id];
  }
  std::vector<std::string> once;
  for (const SessionLuminaire& luminaire : session.luminaires) {
    if (luminaire.line == 0 && uses[luminaire.id] == 1) once.push_back(luminaire.id);
  }
  // Where no luminaire is on in two states, each is named once.
  const bool is_rare = 2 * once.size() < session.luminaires.size();
  if (once.empty() || !is_rare || session.count_is_estimated) return;
  warnings.push_back(
      {"luminaire_named_once",
       fmt::format("one state alone names {}, and nothing else does, while other luminaires are named "
                   "several times: a slip of the pen would look so, and add a luminaire",
                   fmt::join(once, ", ")),
       "correct the name in [states], or give the luminaire a [[luminaire]] of its own"});
}

}  // namespace

Session OnSurfaceOf(const Room& room, Session session) {
  constexpr double kSigmas = 3;
  if (!room.on_planes) return session;
  const double reach_m = kSigmas * room.on_planes->rms_m;
  const auto move = [&](const Eigen::Vector3d& towards, Eigen::Vector3d& p) {
    const RayHit hit = room.rays.Trace(LiftedOff(p, towards), towards);
    if (hit.facet >= 0 && !hit.front && hit.distance < reach_m) p += (hit.distance + 1e-4) * towards;
  };
  for (SessionReading& reading : session.luxmeter.readings)
    move(reading.normal.normalized(), reading.position_m);
  for (SessionLuminaire& luminaire : session.luminaires) {
    if (luminaire.position_m)
      move(luminaire.aim.value_or(-Eigen::Vector3d::UnitZ()).normalized(), *luminaire.position_m);
  }
  return session;
}

ReadingsOutside FindReadingsOutside(const Session& session, const RayScene& rays) {
  ReadingsOutside places;
  if (!session.scene) return places;
  std::map<std::string, SessionReading> outside;  // by id: a meter stays where it is in all states
  std::set<std::string> ids;
  for (const SessionReading& reading : session.luxmeter.readings) {
    ids.insert(reading.id);
    if (!IsReadingOutside(rays, reading)) continue;
    places.lines.insert(reading.line);
    outside.emplace(reading.id, reading);
  }
  WarnOfReadings(outside, ids.size(), rays, places.warnings);
  return places;
}

SessionCheck CheckSession(const Session& session, const RayScene& rays) {
  SessionCheck check;
  check.readings = FindReadingsOutside(session, rays);
  check.warnings = check.readings.warnings;
  for (const SessionLuminaire& luminaire : session.luminaires) {
    if (session.scene) WarnOfLuminaire(luminaire, rays, check.warnings);
  }
  WarnOfNamesUsedOnce(session, check.warnings);
  return check;
}

}  // namespace luxfit
