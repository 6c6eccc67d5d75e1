#include "apps/export/fitted_room.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/stages/check/session_check.h"
#include "apps/stages/observe/found_furniture.h"
#include "apps/stages/register/registration_json.h"
#include "apps/stages/simulate/given_session.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/text/input_error.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

using nlohmann::json;

std::string SessionPathOf(const json& result, const std::string& given, const std::string& result_path) {
  if (!given.empty()) return given;
  std::string path = result.value("session_file", "");
  if (path.empty())
    throw InputError(
        {result_path, 0}, "session_file",
        "expected the path of the session, got nothing; run `luxfit run` again, or give --session");
  if (!std::filesystem::exists(path))
    throw InputError(
        {result_path, 0}, "session_file",
        "expected " + path + " to be there still, found none; give --session FILE where it is now");
  return path;
}

// Checks that mesh, if any, and session have not changed since the result, which describes the room of that time.
void ExpectSameRoom(const json& result, const Session& session, const std::string& result_path) {
  for (const std::string& file : {session.path, session.scene ? session.scene->mesh : std::string()}) {
    if (file.empty()) continue;
    const auto known = result.at("inputs").find(file);
    if (known == result.at("inputs").end() || *known == HashFile(file)) continue;
    throw InputError(
        {result_path, 0}, "inputs",
        "expected " + file + " as it was in the run, but it has changed; run `luxfit run` again");
  }
}

void KeepFound(const json& result, Session& session) {
  const auto is_found = [&](const SessionLuminaire& l) {
    return std::any_of(result.at("luminaires").begin(), result.at("luminaires").end(),
                       [&](const json& entry) { return entry.at("id") == l.id; });
  };
  session.luminaires.erase(std::remove_if(session.luminaires.begin(), session.luminaires.end(),
                                          [&](const SessionLuminaire& l) { return !is_found(l); }),
                           session.luminaires.end());
}

Eigen::VectorXd AlbedoOf(const json& result, const Scene& scene) {
  Eigen::VectorXd albedo = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(scene.materials.size()));
  for (const json& material : result.at("materials")) {
    const auto at = std::find(scene.materials.begin(), scene.materials.end(), material.at("name"));
    if (at != scene.materials.end()) albedo[at - scene.materials.begin()] = material.at("albedo_in_model");
  }
  return albedo;
}

// Returns the tint of each material in the exchange of light; empty where that is grey.
Eigen::Matrix3Xd TintOf(const json& result, const Scene& scene) {
  Eigen::Matrix3Xd tint;
  for (const json& material : result.at("materials")) {
    const auto at = std::find(scene.materials.begin(), scene.materials.end(), material.at("name"));
    if (at == scene.materials.end() || !material.contains("tint_in_model")) continue;
    if (tint.size() == 0) tint.setOnes(3, static_cast<Eigen::Index>(scene.materials.size()));
    tint.col(at - scene.materials.begin()) = VectorFromJson(material.at("tint_in_model"));
  }
  return tint;
}

// Returns the factors of patches that stages/fit.json holds; empty where there are none.
Eigen::VectorXd PatchFactorIn(const std::string& out) {
  const std::string path = out + "/stages/fit.json";
  if (!std::filesystem::exists(path)) return {};
  const std::vector<double> factor = ReadJson(path).value("patch_factor", std::vector<double>());
  return Eigen::Map<const Eigen::VectorXd>(factor.data(), static_cast<Eigen::Index>(factor.size()));
}

BodyPresence BodiesOf(const json& result) {
  const std::string word = result.value("luminaire_bodies", ToString(BodyPresence::kNone));
  for (const BodyPresence bodies : {BodyPresence::kWhenOn, BodyPresence::kAlways})
    if (word == ToString(bodies)) return bodies;
  return BodyPresence::kNone;
}

// Gives groups whose number was estimated the luminaires of the result.
Session WithGroupsOf(const json& result, Session session) {
  const json& luminaires = result.at("luminaires");
  for (const std::string& group : OpenGroups(session)) {
    const std::string first = group + "_";
    const auto count = std::count_if(luminaires.begin(), luminaires.end(), [&](const json& luminaire) {
      return luminaire.at("id").get<std::string>().compare(0, first.size(), first) == 0;
    });
    session = WithCountedGroup(std::move(session), group, static_cast<int>(count));
  }
  return session;
}

Session FittedSession(const json& result, const std::string& given, const std::string& path,
                      FluxUnit fluxes) {
  if (result.at("luminaires").empty())
    throw InputError({path, 0}, "luminaires",
                     "expected the luminaires of a fit, got none; its warnings say what the data lack");
  Session session = ReadSession(SessionPathOf(result, given, path));
  ExpectSameRoom(result, session, path);
  if (session.scene && result.contains("furniture"))
    session.scene->furniture = BoxesFromJson(result.at("furniture"));
  if (session.scene && result.contains("walls_moved"))
    session.scene->walls = WallsFromJson(result.at("walls_moved"));
  if (session.scene && result.contains("furniture_moved"))
    session.scene->moves = MovesFromJson(result.at("furniture_moved"));
  if (session.scene && result.contains("painted_parts"))
    session.scene->parts = PartsFromJson(result.at("painted_parts"));
  if (session.count_is_estimated)
    session = WithMoreLuminaires(std::move(session), static_cast<int>(result.at("luminaires").size()));
  session = WithGroupsOf(result, std::move(session));
  session = WithResult(std::move(session), path, fluxes);
  KeepFound(result, session);
  return session;
}

FittedRoom Assemble(const std::string& out, const json& result, Session session, RegisteredSession registered,
                    Room room) {
  RunContext context;
  context.is_quiet = true;
  session = OnSurfaceOf(room, std::move(session));
  const Eigen::Vector3d weights = result.contains("luminance_weights")
                                      ? VectorFromJson(result["luminance_weights"]).head<3>().eval()
                                      : LuminanceWeights(session);
  FittedScene scene{GivenLuminaires(session, "report", context),
                    AlbedoOf(result, room.scene),
                    BodiesOf(result),
                    TintOf(result, room.scene),
                    PatchFactorIn(out),
                    weights / weights.sum()};
  const auto held_room = std::make_shared<const Room>(std::move(room));
  return {out,
          std::make_shared<const json>(result),
          std::move(session),
          std::move(registered),
          !result.at("luminaires").at(0).contains("flux_relative"),
          result.value("camera_scale", 0.0),
          held_room,
          std::make_shared<const FittedLight>(*held_room, std::move(scene))};
}

std::string AbsoluteFolder(const std::string& out) {
  return std::filesystem::absolute(out).lexically_normal().string();
}

RegisteredSession RegisteredIn(const json& result, const std::string& folder) {
  return result.at("views").empty() ? RegisteredSession{}
                                    : RegistrationFromJson(ReadJson(folder + "/stages/register.json"));
}

template <typename Make>
auto WithResultOf(const std::string& out, const Make& make) {
  const json result = ReadResult(out + "/result.json");
  try {
    return make(result);
  } catch (const json::exception& e) {
    throw InputError(
        {out + "/result.json", 0}, "",
        std::string("expected a whole result of this version; run `luxfit run` again; ") + e.what());
  }
}

}  // namespace

FittedRoom ReadFittedRoom(const std::string& out, const std::string& session_path, FluxUnit fluxes) {
  const std::string folder = AbsoluteFolder(out);
  return WithResultOf(folder, [&](const json& result) {
    Session session = FittedSession(result, session_path, folder + "/result.json", fluxes);
    RegisteredSession registered = RegisteredIn(result, folder);
    RunContext context;
    context.is_quiet = true;
    Room room = LoadRoom(session, context);
    return Assemble(folder, result, std::move(session), std::move(registered), std::move(room));
  });
}

FittedPhotos ReadFittedPhotos(const std::string& out, const std::string& session_path) {
  const std::string folder = AbsoluteFolder(out), path = folder + "/result.json";
  return WithResultOf(folder, [&](const json& result) {
    Session session = WithCorrectionsOf(ReadSession(SessionPathOf(result, session_path, path)), result);
    ExpectSameRoom(result, session, path);
    return FittedPhotos{folder, std::move(session), RegisteredIn(result, folder),
                        result.value("camera_scale", 0.0)};
  });
}

FittedRoom FittedRoomOf(const std::string& out, RegisteredSession registered, Room room) {
  return WithResultOf(out, [&](const json& result) {
    return Assemble(out, result, FittedSession(result, "", out + "/result.json", FluxUnit::kAny),
                    std::move(registered), std::move(room));
  });
}

Eigen::VectorXd DimmingOf(const FittedRoom& fitted, const std::string& state) {
  std::vector<std::string> known;
  for (const SessionState& s : fitted.session.states) {
    known.push_back(s.id);
    if (s.id != state) continue;
    Eigen::VectorXd dimming = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(fitted.luminaires.size()));
    for (size_t k = 0; k < fitted.luminaires.size(); ++k) {
      const auto on = s.dimming.find(fitted.luminaires[k].id);
      if (on != s.dimming.end()) dimming[static_cast<Eigen::Index>(k)] = on->second;
    }
    return dimming;
  }
  throw std::runtime_error(fitted.session.path + ": states: " + ExpectedOneOf(known, state));
}

std::string BrightestState(const FittedRoom& fitted) {
  std::string brightest;
  double largest = -1;
  for (const SessionState& state : fitted.session.states) {
    const Eigen::VectorXd dimming = DimmingOf(fitted, state.id);
    double flux = 0;
    for (size_t k = 0; k < fitted.luminaires.size(); ++k)
      flux += dimming[static_cast<Eigen::Index>(k)] * fitted.luminaires[k].flux_lm;
    if (flux <= largest) continue;
    largest = flux;
    brightest = state.id;
  }
  return brightest;
}

}  // namespace luxfit
