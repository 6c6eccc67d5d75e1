#include "tests/support/inverse/random_room.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "forward/luminaire/luminaire_parts.h"
#include "tests/support/scenes.h"

namespace luxfit::support {
namespace {

using Eigen::AlignedBox2d;
using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

double Uniform(std::mt19937_64& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}
int Whole(std::mt19937_64& rng, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(rng);
}

// A floor of one rectangle or of two that make an L.
struct Plan {
  std::vector<AlignedBox2d> parts;
  std::vector<Vector2d> corners;  // counter-clockwise
  double height_m = 0;
  std::string name;

  bool Holds(const Vector2d& p, double margin_m) const {
    const auto inside = [&](const AlignedBox2d& part, const Vector2d& q) { return part.contains(q); };
    for (const double a : {-margin_m, margin_m}) {
      for (const double b : {-margin_m, margin_m}) {
        const Vector2d q = p + Vector2d(a, b);
        if (std::none_of(parts.begin(), parts.end(), [&](const auto& part) { return inside(part, q); }))
          return false;
      }
    }
    return true;
  }
  AlignedBox2d Bounds() const {
    AlignedBox2d bounds;
    for (const AlignedBox2d& part : parts) bounds.extend(part);
    return bounds;
  }
};

Plan DrawPlan(std::mt19937_64& rng) {
  Plan plan;
  plan.height_m = Uniform(rng, 2.4, 3.4);
  const int kind = Whole(rng, 0, 9);
  Vector2d size(Uniform(rng, 3, 10), Uniform(rng, 2.5, 7));
  if (kind == 0) size = {Uniform(rng, 9, 15), Uniform(rng, 1.6, 2.4)};
  if (kind < 7) {
    plan.name = kind == 0 ? "corridor" : "box";
    plan.parts = {AlignedBox2d(Vector2d::Zero(), size)};
    plan.corners = {{0, 0}, {size.x(), 0}, size, {0, size.y()}};
    return plan;
  }
  plan.name = "L";
  size = size.cwiseMax(Vector2d(5, 4.5));
  const Vector2d inner(size.x() * Uniform(rng, 0.4, 0.65), size.y() * Uniform(rng, 0.4, 0.65));
  plan.parts = {AlignedBox2d(Vector2d::Zero(), Vector2d(size.x(), inner.y())),
                AlignedBox2d(Vector2d(0, inner.y()), Vector2d(inner.x(), size.y()))};
  plan.corners = {{0, 0}, {size.x(), 0}, {size.x(), inner.y()}, inner, {inner.x(), size.y()}, {0, size.y()}};
  return plan;
}

Scene Shell(const Plan& plan) {
  Scene scene;
  const Vector3d x(1, 0, 0), y(0, 1, 0);
  for (size_t i = 0; i < plan.corners.size(); ++i) {
    const Vector2d along = plan.corners[(i + 1) % plan.corners.size()] - plan.corners[i];
    AddParallelogram(scene, {plan.corners[i].x(), plan.corners[i].y(), 0}, {0, 0, plan.height_m},
                     {along.x(), along.y(), 0}, i == 0 ? "wall_front" : "wall");
  }
  for (const AlignedBox2d& part : plan.parts) {
    const Vector2d at = part.min(), size = part.sizes();
    AddParallelogram(scene, {at.x(), at.y(), 0}, size.x() * x, size.y() * y, "floor");
    AddParallelogram(scene, {at.x(), at.y(), plan.height_m}, size.y() * y, size.x() * x, "ceiling");
  }
  return scene;
}

// A desk's top on nothing, or a cabinet on the floor.
Furniture DrawPiece(const Plan& plan, std::mt19937_64& rng) {
  const AlignedBox2d bounds = plan.Bounds();
  const Vector2d at(Uniform(rng, 0, bounds.sizes().x()), Uniform(rng, 0, bounds.sizes().y()));
  const bool is_desk = Whole(rng, 0, 1) == 0;
  Vector2d size(is_desk ? Uniform(rng, 1.2, 2) : Uniform(rng, 0.6, 1.6),
                is_desk ? Uniform(rng, 0.6, 0.9) : Uniform(rng, 0.35, 0.6));
  if (Whole(rng, 0, 1) == 0) std::swap(size.x(), size.y());
  const double top = is_desk ? Uniform(rng, 0.68, 0.76) : Uniform(rng, 0.7, 2);
  const double bottom = is_desk ? top - 0.03 : 0;
  return {{Vector3d(at.x(), at.y(), bottom), Vector3d(at.x() + size.x(), at.y() + size.y(), top)},
          is_desk ? "desk" : "cabinet"};
}

AlignedBox2d FootprintOf(const Furniture& piece) {
  return {piece.box.min().head<2>(), piece.box.max().head<2>()};
}

bool Fits(const Plan& plan, const Furniture& piece, const std::vector<Furniture>& others) {
  constexpr double kGap = 0.05;
  const AlignedBox2d foot = FootprintOf(piece);
  for (const Vector2d& corner : {foot.min(), foot.max()})
    if (!plan.Holds(corner, kGap)) return false;
  if (!plan.Holds({foot.min().x(), foot.max().y()}, kGap) ||
      !plan.Holds({foot.max().x(), foot.min().y()}, kGap))
    return false;
  const AlignedBox2d wide(foot.min().array() - kGap, foot.max().array() + kGap);
  return std::none_of(others.begin(), others.end(),
                      [&](const Furniture& other) { return wide.intersects(FootprintOf(other)); });
}

std::vector<Furniture> DrawFurniture(const Plan& plan, std::mt19937_64& rng) {
  std::vector<Furniture> pieces;
  const int wanted = Whole(rng, 0, 6);
  for (int tries = 0; tries < 200 && static_cast<int>(pieces.size()) < wanted; ++tries) {
    const Furniture piece = DrawPiece(plan, rng);
    if (Fits(plan, piece, pieces)) pieces.push_back(piece);
  }
  return pieces;
}

// Whether a point stands free: off walls, and not over, in or beside furniture that reaches above `height_m`.
bool IsFree(const Plan& plan, const std::vector<Furniture>& pieces, const Vector2d& p, double height_m,
            double margin_m) {
  if (!plan.Holds(p, margin_m)) return false;
  return std::none_of(pieces.begin(), pieces.end(), [&](const Furniture& piece) {
    const AlignedBox2d foot = FootprintOf(piece);
    return piece.box.max().z() > height_m - 0.05 && foot.exteriorDistance(p) < 0.15;
  });
}

enum class LuminaireKind { kPanel, kStrip, kDownlight, kGlobe, kSpot, kTurnedSpot, kWasher, kPendant };

std::string NameOf(LuminaireKind kind) {
  constexpr const char* kNames[] = {"panels", "strips",       "downlights", "globes",
                                    "spots",  "turned spots", "washers",    "pendants"};
  return kNames[static_cast<size_t>(kind)];
}

// A spot in a short housing below the ceiling: half of the peak at 10 to 30 degrees.
void MakeSpot(Luminaire& type, double height_m, std::mt19937_64& rng) {
  const double half_rad = Uniform(rng, 10, 30) * M_PI / 180;
  type.shape = LuminaireShape::kDisc, type.size_m.setConstant(Uniform(rng, 0.05, 0.11));
  type.distribution = Distribution::kCosinePower;
  type.cosine_exponent = std::log(0.5) / std::log(std::cos(half_rad));
  type.flux_lm = Uniform(rng, 300, 900);
  type.position.z() = height_m - 0.08;
}

// A type: all of one kind are alike but for place and a flux that differs by 2 %.
Luminaire DrawType(LuminaireKind kind, double height_m, std::mt19937_64& rng) {
  Luminaire type;
  type.position.z() = height_m - 0.01;
  if (Whole(rng, 0, 1) == 0) type.heading = {0, 1, 0};
  switch (kind) {
    case LuminaireKind::kPanel:
      type.shape = LuminaireShape::kRectangle, type.size_m = {0.6, 0.6},
      type.flux_lm = Uniform(rng, 2500, 4000);
      break;
    case LuminaireKind::kStrip:
      type.shape = LuminaireShape::kRectangle,
      type.size_m = {Uniform(rng, 1.1, 1.6), Uniform(rng, 0.06, 0.2)};
      type.flux_lm = Uniform(rng, 2000, 4500);
      type.position.z() = height_m - Uniform(rng, 0.01, 0.4);
      break;
    case LuminaireKind::kDownlight:
      type.shape = LuminaireShape::kDisc, type.size_m.setConstant(Uniform(rng, 0.08, 0.2));
      type.distribution = Distribution::kCosinePower, type.cosine_exponent = Uniform(rng, 1.5, 8);
      type.flux_lm = Uniform(rng, 600, 1800);
      break;
    case LuminaireKind::kGlobe:
      type.shape = LuminaireShape::kSphere, type.size_m.setConstant(Uniform(rng, 0.15, 0.35));
      type.distribution = Distribution::kIsotropic, type.flux_lm = Uniform(rng, 600, 1500);
      type.position.z() = height_m - Uniform(rng, 0.4, 0.9);
      break;
    case LuminaireKind::kSpot:
    case LuminaireKind::kTurnedSpot:
    case LuminaireKind::kWasher:
      MakeSpot(type, height_m, rng);
      break;
    case LuminaireKind::kPendant:
      type.shape = LuminaireShape::kRectangle;
      type.size_m = {Uniform(rng, 0.9, 1.5), Uniform(rng, 0.1, 0.3)};
      type.distribution = Distribution::kMeasured;
      type.table = std::make_shared<IntensityTable>(TwoSidedTable(Uniform(rng, 0.2, 0.6)));
      type.flux_lm = Uniform(rng, 2500, 5000);
      type.position.z() = height_m - Uniform(rng, 0.4, 0.9);
      break;
  }
  return type;
}

// The nearest point of the walls.
Vector2d NearestWall(const Plan& plan, const Vector2d& p) {
  Vector2d nearest = plan.corners.front();
  for (size_t i = 0; i < plan.corners.size(); ++i) {
    const Vector2d along = plan.corners[(i + 1) % plan.corners.size()] - plan.corners[i];
    const double share = std::clamp((p - plan.corners[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Vector2d q = plan.corners[i] + share * along;
    if ((q - p).norm() < (nearest - p).norm()) nearest = q;
  }
  return nearest;
}

// Where luminaires of a type may hang.
struct Spacing {
  double apart_m = 0, from_walls_m = 0, within_m = 0;  // of each other; from walls at least and at most
};

Spacing SpacingOf(LuminaireKind kind, const Luminaire& type) {
  const double size_m = type.size_m.maxCoeff();
  if (kind == LuminaireKind::kWasher) return {0.8, 0.5, 1};
  return {std::max(1.3, size_m + 0.1), std::max(0.45, size_m / 2 + 0.05), 100};
}

std::vector<Vector2d> DrawPlaces(const Plan& plan, int count, const Spacing& spacing,
                                 std::vector<Vector2d> taken, std::mt19937_64& rng) {
  const AlignedBox2d bounds = plan.Bounds();
  const size_t before = taken.size();
  for (int tries = 0; tries < 400 && static_cast<int>(taken.size() - before) < count; ++tries) {
    const Vector2d p(Uniform(rng, 0, bounds.sizes().x()), Uniform(rng, 0, bounds.sizes().y()));
    const bool is_apart = std::all_of(taken.begin(), taken.end(), [&](const Vector2d& other) {
      return (other - p).norm() > spacing.apart_m;
    });
    const bool is_near = (NearestWall(plan, p) - p).norm() < spacing.within_m;
    if (is_apart && is_near && plan.Holds(p, spacing.from_walls_m)) taken.push_back(p);
  }
  return {taken.begin() + static_cast<std::ptrdiff_t>(before), taken.end()};
}

// Turned spots are tilted by up to 40 degrees to any side, washers by 20 to 40 degrees towards the nearest wall.
Vector3d DrawAim(LuminaireKind kind, const Plan& plan, const Vector2d& p, std::mt19937_64& rng) {
  if (kind != LuminaireKind::kTurnedSpot && kind != LuminaireKind::kWasher) return {0, 0, -1};
  const bool is_washer = kind == LuminaireKind::kWasher;
  const double tilt_rad = Uniform(rng, is_washer ? 20 : 0, 40) * M_PI / 180,
               turn_rad = Uniform(rng, 0, 2 * M_PI);
  const Vector2d side =
      is_washer ? (NearestWall(plan, p) - p).normalized() : Vector2d(std::cos(turn_rad), std::sin(turn_rad));
  return {std::sin(tilt_rad) * side.x(), std::sin(tilt_rad) * side.y(), -std::cos(tilt_rad)};
}

// Adds one or two kinds, and says which luminaires belong to which (by kind, their indices).
std::vector<std::vector<int>> AddLuminaires(const Plan& plan, RandomRoom& drawn, std::string& words,
                                            std::mt19937_64& rng) {
  TracedRoom& room = drawn.room;
  std::vector<std::vector<int>> kinds;
  std::vector<Vector2d> taken;
  const int count = Whole(rng, 1, 2);
  for (int i = 0; i < count; ++i) {
    const auto kind = static_cast<LuminaireKind>(Whole(rng, 0, static_cast<int>(LuminaireKind::kPendant)));
    const Luminaire type = DrawType(kind, plan.height_m, rng);
    const std::vector<Vector2d> places =
        DrawPlaces(plan, Whole(rng, 1, 6), SpacingOf(kind, type), taken, rng);
    if (places.empty()) continue;
    words += (kinds.empty() ? "" : " + ") + std::to_string(places.size()) + " " + NameOf(kind);
    kinds.emplace_back();
    for (const Vector2d& p : places) {
      Luminaire luminaire = type;
      luminaire.id = std::string(1, static_cast<char>('A' + room.luminaires.size()));
      luminaire.position.head<2>() = p;
      luminaire.aim = DrawAim(kind, plan, p, rng);
      luminaire.flux_lm *= 1 + 0.02 * std::normal_distribution<double>()(rng);
      kinds.back().push_back(static_cast<int>(room.luminaires.size()));
      room.luminaires.push_back(luminaire);
      drawn.kinds.push_back(NameOf(kind));
      taken.push_back(p);
    }
  }
  return kinds;
}

// One state a luminaire, or one a kind; and all on.
void AddStates(const std::vector<std::vector<int>>& kinds, TracedRoom& room, std::mt19937_64& rng) {
  const auto n = static_cast<Eigen::Index>(room.luminaires.size());
  const bool alone = Whole(rng, 0, 1) == 0;
  for (const std::vector<int>& kind : kinds) {
    if (!alone) room.dimming.emplace_back(Eigen::VectorXd::Zero(n));
    for (const int k : kind) {
      if (alone) room.dimming.emplace_back(Eigen::VectorXd::Zero(n));
      room.dimming.back()[k] = 1;
    }
  }
  if (room.dimming.size() > 1) room.dimming.emplace_back(Eigen::VectorXd::Ones(n));
}

void AddViews(const Plan& plan, const std::vector<Furniture>& pieces, TracedRoom& room,
              std::mt19937_64& rng) {
  const AlignedBox2d bounds = plan.Bounds();
  const size_t count = static_cast<size_t>(Whole(rng, 5, 10));
  while (room.eyes.size() < count) {
    const Vector2d p(Uniform(rng, 0, bounds.sizes().x()), Uniform(rng, 0, bounds.sizes().y()));
    const double height_m = Uniform(rng, 1.3, 1.8);
    if (IsFree(plan, pieces, p, height_m, 0.25)) room.eyes.emplace_back(p.x(), p.y(), height_m);
  }
}

void AddReadingPlaces(const Plan& plan, const std::vector<Furniture>& pieces, TracedRoom& room,
                      std::mt19937_64& rng) {
  const AlignedBox2d bounds = plan.Bounds();
  const size_t count = static_cast<size_t>(Whole(rng, 5, 10));
  while (room.places.size() < count) {
    const Vector2d p(Uniform(rng, 0, bounds.sizes().x()), Uniform(rng, 0, bounds.sizes().y()));
    if (IsFree(plan, pieces, p, 0.85, 0.3)) room.places.push_back({{p.x(), p.y(), 0.85}, {0, 0, 1}, {}});
  }
}

double DrawAlbedo(const std::string& material, std::mt19937_64& rng) {
  if (material == "floor") return Uniform(rng, 0.1, 0.4);
  if (material == "ceiling") return Uniform(rng, 0.65, 0.88);
  if (material == "wall") return Uniform(rng, 0.4, 0.85);
  return Uniform(rng, 0.1, 0.8);
}

}  // namespace

Scene WithFurniture(Scene shell, const std::vector<Furniture>& pieces) {
  for (const Furniture& piece : pieces) AddBox(shell, piece.box, Facing::kOutward, {piece.material});
  return shell;
}

RandomRoom DrawRoom(std::mt19937_64& rng) {
  RandomRoom drawn;
  const Plan plan = DrawPlan(rng);
  drawn.pieces = DrawFurniture(plan, rng);
  drawn.shell = Shell(plan);
  drawn.mesh = drawn.room.truth = WithFurniture(drawn.shell, drawn.pieces);
  drawn.room.albedo.resize(static_cast<Eigen::Index>(drawn.room.truth.materials.size()));
  for (size_t m = 0; m < drawn.room.truth.materials.size(); ++m)
    drawn.room.albedo[static_cast<Eigen::Index>(m)] = DrawAlbedo(drawn.room.truth.materials[m], rng);
  std::string kinds;
  AddStates(AddLuminaires(plan, drawn, kinds, rng), drawn.room, rng);
  AddViews(plan, drawn.pieces, drawn.room, rng);
  AddReadingPlaces(plan, drawn.pieces, drawn.room, rng);
  for (const AlignedBox2d& part : plan.parts) drawn.area_m2 += part.volume();
  const Vector2d size = plan.Bounds().sizes();
  char text[160];
  std::snprintf(text, sizeof text, "%s of %.1f m x %.1f m x %.1f m, %zu boxes, ", plan.name.c_str(), size.x(),
                size.y(), plan.height_m, drawn.pieces.size());
  drawn.words = text + kinds + " in " + std::to_string(drawn.room.dimming.size()) + " states, " +
                std::to_string(drawn.room.eyes.size()) + " views";
  return drawn;
}

namespace {

ObservedRandomRoom Observed(RandomRoom drawn, std::mt19937_64& rng) {
  RoomOptions options;
  options.patches.patch_size_m = 0.4;
  options.patches.element_size_m = 0.2;
  Room model = MakeRoom(drawn.mesh, options);
  TracedRoomOptions traced;
  traced.paths_per_point = 128;
  RoomObservations given = ObserveTraced(drawn.room, model, rng, traced);
  return {std::move(drawn), std::move(model), std::move(given)};
}

}  // namespace

ObservedRandomRoom ObserveRandomRoom(std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  RandomRoom drawn = DrawRoom(rng);
  return Observed(std::move(drawn), rng);
}

ObservedRandomRoom ObserveRandomRoomAllOn(std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  RandomRoom drawn = DrawRoom(rng);
  drawn.room.dimming = {drawn.room.dimming.back()};
  return Observed(std::move(drawn), rng);
}

}  // namespace luxfit::support
