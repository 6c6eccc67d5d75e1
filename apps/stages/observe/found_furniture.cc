#include "apps/stages/observe/found_furniture.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "apps/session/session_scene.h"
#include "apps/stages/session_light.h"
#include "apps/stages/stage_cache.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/json_vectors.h"

namespace luxfit {
namespace {

using nlohmann::json;

// Returns where meters stood and tags lie: no solid is there.
std::vector<Eigen::Vector3d> FreePlacesOf(const Session& session) {
  std::vector<Eigen::Vector3d> places;
  for (const SessionReading& reading : session.luxmeter.readings) places.push_back(reading.position_m);
  for (const SurveyedTag& tag : session.tags.survey) places.push_back(tag.center_in_world);
  return places;
}

// Returns the box as a session gives it.
std::string BoxText(const FoundBox& found) {
  const RoomBox& b = found.box;
  std::string text =
      fmt::format("{{ name = \"{}\", min = [{:.2f}, {:.2f}, {:.2f}], max = [{:.2f}, {:.2f}, {:.2f}]", b.name,
                  b.min_m.x(), b.min_m.y(), b.min_m.z(), b.max_m.x(), b.max_m.y(), b.max_m.z());
  constexpr double kDegPerRad = 57.29577951308232;
  if (std::abs(b.turn_rad) > 1e-3) text += fmt::format(", turn_deg = {:.1f}", kDegPerRad * b.turn_rad);
  return text + " }";
}

void RecordBoxes(const std::vector<FoundBox>& found, Findings& findings) {
  if (found.empty()) return;
  std::string words;
  for (const FoundBox& f : found) {
    words += (words.empty() ? "" : ", ") + BoxText(f);
  }
  findings.warnings.push_back(
      {"furniture_found",
       fmt::format("photos show {} box{} that the room lacks, and the fit uses {}: box = [{}]", found.size(),
                   found.size() == 1 ? "" : "es", found.size() == 1 ? "it" : "them", words),
       "measure what stands there and give it, or write furniture = \"given\" under [scene] where there is "
       "nothing"});
}

std::string PlaceOf(const Eigen::AlignedBox3d& bounds) {
  return fmt::format("({:.2f}, {:.2f})", bounds.center().x(), bounds.center().y());
}

void RecordMove(const MissingPiece& piece, Findings& findings) {
  const Eigen::AlignedBox3d& was = piece.move.bounds;
  const Eigen::Vector3d size = was.sizes();
  std::string words = fmt::format(
      "furniture of material {}, {:.2f} m x {:.2f} m x {:.2f} m, is not at {}, where the mesh has it: {} "
      "views "
      "see through {:.1f} m2 of the {:.1f} m2 of it that they look at; ",
      piece.material, size.x(), size.y(), size.z(), PlaceOf(was), piece.views, piece.through_m2,
      piece.judged_m2);
  if (piece.move.by_m) {
    const Eigen::AlignedBox3d is(was.min() + *piece.move.by_m, was.max() + *piece.move.by_m);
    words += fmt::format("it stands {:.2f} m from there, at {}, and the fit has it there",
                         piece.move.by_m->norm(), PlaceOf(is));
  } else {
    words += "the fit leaves it out";
  }
  findings.warnings.push_back(
      {"furniture_moved", words,
       "correct the mesh, or write furniture = \"given\" under [scene] where it is right"});
}

// Says how a wall is called: by its material, and by the way it faces.
std::string WallName(const MovedWall& wall) {
  constexpr double kLevel = 0.95;
  const Eigen::Vector3d& n = wall.move.normal;
  std::string kind = fmt::format("wall that faces ({:.2f}, {:.2f}, {:.2f})", n.x(), n.y(), n.z());
  if (n.z() > kLevel) kind = "floor";
  if (n.z() < -kLevel) kind = "ceiling";
  for (int axis = 0; axis < 2; ++axis)
    if (std::abs(n[axis]) > 1 - 1e-6)
      kind = fmt::format("wall that faces {}{}", n[axis] > 0 ? '+' : '-', "xy"[axis]);
  return fmt::format("{} (material {}, {:.1f} m2)", kind, wall.material, wall.area_m2);
}

// Says where a plane lies: on an axis, or how far from the origin along its normal.
std::string PlaneText(const Eigen::Vector3d& normal, double offset_m) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(normal[axis]) > 1 - 1e-6)
      return fmt::format("{} = {:.3f} m", "xyz"[axis],
                         std::round(1000 * offset_m / normal[axis]) / 1000 + 0.0);
  return fmt::format("{:.3f} m from the origin along its normal", offset_m);
}

void RecordWall(const MovedWall& wall, Findings& findings) {
  const PlaneMove& move = wall.move;
  std::string words = fmt::format(
      "the {} stands {:.1f} +- {:.1f} cm farther {} than the mesh has it: the mesh has it at {}, and {} "
      "views show "
      "it at {}",
      WallName(wall), 100 * std::abs(move.by_m), 100 * wall.sigma_m, move.by_m > 0 ? "in" : "out",
      PlaneText(move.normal, move.offset_m), wall.views, PlaneText(move.normal, move.offset_m + move.by_m));
  if (wall.tags > 0)
    words += fmt::format(", where {} surveyed tag{} too", wall.tags, wall.tags == 1 ? " lies" : "s lie");
  findings.warnings.push_back(
      {"wall_moved", words + "; the fit has it there",
       "move the corners of that surface in the mesh, or correct size or outline; or write furniture = "
       "\"given\" under [scene] where they are right"});
}

// Returns where the part lies and how bright it is.
std::string PartText(const PaintedPart& part) {
  const PaintedRectangle& r = part.rectangle;
  const Eigen::Vector3d middle = r.corner + 0.5 * (r.edge_u + r.edge_v);
  return fmt::format(
      "{} of {}, {:.2f} m x {:.2f} m about ({:.2f}, {:.2f}, {:.2f}) m, {:.2g} times as bright as around it",
      r.name, part.material, r.edge_u.norm(), r.edge_v.norm(), middle.x(), middle.y(), middle.z(),
      part.luminance_ratio);
}

void RecordParts(const std::vector<PaintedPart>& parts, Findings& findings) {
  if (parts.empty()) return;
  std::string words;
  for (const PaintedPart& part : parts) words += (words.empty() ? "" : "; ") + PartText(part);
  findings.warnings.push_back(
      {"paint_found",
       fmt::format("photos show {} of walls painted otherwise than the room has {}, and the fit gives {} a "
                   "reflectance of its own: {}",
                   parts.size() == 1 ? "a part" : fmt::format("{} parts", parts.size()),
                   parts.size() == 1 ? "it" : "them", parts.size() == 1 ? "it" : "each", words),
       "give doors, windows and boards as scene.opening or as materials of the mesh, or write furniture = "
       "\"given\" under [scene] where there are none"});
}

json PointJson(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Eigen::Vector3d PointFromJson(const json& p) {
  return {p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()};
}

json MeshAsIfJson(const std::vector<MeshExplanation>& explanations) {
  json list = json::array();
  for (const MeshExplanation& e : explanations)
    list.push_back({{"as_if", e.as_if},
                    {"remedy", e.remedy},
                    {"right_from_given", MatrixJson(e.right_from_given.matrix())},
                    {"is_furniture_alone", e.is_furniture_alone},
                    {"agreement_as_given", e.agreement_as_given},
                    {"agreement", e.agreement},
                    {"tags_on_mesh_as_given", e.tags_on_mesh_as_given},
                    {"tags_on_mesh", e.tags_on_mesh},
                    {"tags", e.tags}});
  return list;
}

std::vector<MeshExplanation> MeshAsIfFromJson(const json& list) {
  std::vector<MeshExplanation> explanations;
  for (const json& entry : list) {
    MeshExplanation e;
    e.as_if = entry.at("as_if");
    e.remedy = entry.at("remedy");
    e.right_from_given.matrix() = MatrixFromJson(entry.at("right_from_given"));
    e.is_furniture_alone = entry.at("is_furniture_alone");
    e.agreement_as_given = entry.at("agreement_as_given");
    e.agreement = entry.at("agreement");
    e.tags_on_mesh_as_given = entry.at("tags_on_mesh_as_given");
    e.tags_on_mesh = entry.at("tags_on_mesh");
    e.tags = entry.at("tags");
    explanations.push_back(std::move(e));
  }
  return explanations;
}

}  // namespace

json BoxesJson(const std::vector<RoomBox>& boxes) {
  json list = json::array();
  for (const RoomBox& b : boxes)
    list.push_back({{"name", b.name},
                    {"min_m", PointJson(b.min_m)},
                    {"max_m", PointJson(b.max_m)},
                    {"turn_rad", b.turn_rad}});
  return list;
}

std::vector<RoomBox> BoxesFromJson(const json& list) {
  std::vector<RoomBox> boxes;
  for (const json& entry : list) {
    RoomBox box;
    box.name = entry.at("name");
    box.min_m = PointFromJson(entry.at("min_m"));
    box.max_m = PointFromJson(entry.at("max_m"));
    box.turn_rad = entry.at("turn_rad");
    boxes.push_back(box);
  }
  return boxes;
}

json MovesJson(const std::vector<PieceMove>& moves) {
  json list = json::array();
  for (const PieceMove& move : moves)
    list.push_back({{"min_m", PointJson(move.bounds.min())},
                    {"max_m", PointJson(move.bounds.max())},
                    {"moved_m", move.by_m ? PointJson(*move.by_m) : json()}});
  return list;
}

std::vector<PieceMove> MovesFromJson(const json& list) {
  std::vector<PieceMove> moves;
  for (const json& entry : list) {
    PieceMove move{{PointFromJson(entry.at("min_m")), PointFromJson(entry.at("max_m"))}, std::nullopt};
    if (!entry.at("moved_m").is_null()) move.by_m = PointFromJson(entry.at("moved_m"));
    moves.push_back(move);
  }
  return moves;
}

json WallsJson(const std::vector<PlaneMove>& walls) {
  json list = json::array();
  for (const PlaneMove& wall : walls)
    list.push_back({{"normal", PointJson(wall.normal)}, {"offset_m", wall.offset_m}, {"moved_m", wall.by_m}});
  return list;
}

std::vector<PlaneMove> WallsFromJson(const json& list) {
  std::vector<PlaneMove> walls;
  for (const json& entry : list)
    walls.push_back({PointFromJson(entry.at("normal")), entry.at("offset_m"), entry.at("moved_m")});
  return walls;
}

json PartsJson(const std::vector<PaintedRectangle>& parts) {
  json list = json::array();
  for (const PaintedRectangle& part : parts)
    list.push_back({{"name", part.name},
                    {"corner_m", PointJson(part.corner)},
                    {"edge_u_m", PointJson(part.edge_u)},
                    {"edge_v_m", PointJson(part.edge_v)}});
  return list;
}

std::vector<PaintedRectangle> PartsFromJson(const json& list) {
  std::vector<PaintedRectangle> parts;
  for (const json& entry : list)
    parts.push_back({entry.at("name"), PointFromJson(entry.at("corner_m")),
                     PointFromJson(entry.at("edge_u_m")), PointFromJson(entry.at("edge_v_m"))});
  return parts;
}

void RecordFurniture(const RevisedRoom& revised, Findings& findings) {
  if (!revised.mesh_as_if.empty())
    findings.warnings.push_back(
        {"mesh_as_if", InWords(revised.mesh_as_if), RemedyOf(revised.mesh_as_if), true});
  for (const MovedWall& wall : revised.walls) RecordWall(wall, findings);
  for (const MissingPiece& piece : revised.furniture.missing) RecordMove(piece, findings);
  RecordBoxes(revised.furniture.found, findings);
  RecordParts(revised.parts, findings);
}

KeptFurniture FurnitureKept(const Session& session, const LinearizedPhotos& photos,
                            const RegisteredSession& registered, const Room& room,
                            const SessionInputs& inputs, RunContext& context) {
  if (!session.scene || !session.scene->finds_furniture || registered.registration.views.size() < 3)
    return {};
  if (const auto kept = KeptProduct("furniture", inputs.furniture, context))
    return {{BoxesFromJson(kept->at("boxes")), MovesFromJson(kept->at("moves")),
             WallsFromJson(kept->at("walls")), PartsFromJson(kept->at("parts"))},
            MeshAsIfFromJson(kept->at("mesh_as_if"))};
  const StageMark mark(context);
  const StageTimer timer(context, "furniture", "what views agree on and the room lacks, or sees through");
  RoomPhotos given = RoomPhotosOf(session, photos);
  given.read = [&](size_t i) {
    const LinearizedPhoto& photo = photos.photos[i];
    return ReadKept(photos, photo, registered.cameras[static_cast<size_t>(photo.camera)], context);
  };
  const RevisedRoom revised = LookForFurniture(
      SceneOf(*session.scene), room.scene, given, registered.cameras, registered.registration.views,
      static_cast<int>(session.states.size()), FreePlacesOf(session), session.tags.survey);
  RecordFurniture(revised, context);
  FurnitureChange change = ChangeOf(revised);
  const json product = {{"boxes", BoxesJson(change.boxes)},
                        {"moves", MovesJson(change.moves)},
                        {"walls", WallsJson(change.walls)},
                        {"parts", PartsJson(change.parts)},
                        {"mesh_as_if", MeshAsIfJson(revised.mesh_as_if)}};
  json artifact = ProvenanceJson("luxfit-furniture-1", context.provenance);
  artifact.update(product);
  WriteJson(context.out + "/stages/furniture.json", artifact);  // without it, the kept product does not count
  KeepProduct("furniture", inputs.furniture, context, mark, product);
  return {std::move(change), revised.mesh_as_if};
}

}  // namespace luxfit
