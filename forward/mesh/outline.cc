#include "forward/mesh/outline.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "forward/mesh/internal/outline_ceiling.h"
#include "forward/mesh/internal/plan_polygon.h"

namespace luxfit {
namespace {

int MaterialOf(Scene& scene, const std::string& name) {
  const auto known = std::find(scene.materials.begin(), scene.materials.end(), name);
  const int index = static_cast<int>(known - scene.materials.begin());
  if (known == scene.materials.end()) scene.materials.push_back(name);
  return index;
}

void AddPolygon(Scene& scene, const std::vector<Eigen::Vector3d>& polygon, int material) {
  const std::vector<Facet> facets = FacetsFromPolygon(polygon, material);
  scene.facets.insert(scene.facets.end(), facets.begin(), facets.end());
}

void AddSolid(Scene& scene, const RoomBox& box) {
  const int material = MaterialOf(scene, box.name);
  const std::array<Eigen::Vector2d, 4> plan = PlanOf(box);
  std::vector<Eigen::Vector3d> low, high;
  for (const Eigen::Vector2d& p : plan) {
    low.emplace_back(p.x(), p.y(), box.min_m.z());
    high.emplace_back(p.x(), p.y(), box.max_m.z());
  }
  for (size_t k = 0; k < 4; ++k) {
    const size_t next = (k + 1) % 4;
    AddPolygon(scene, {low[k], low[next], high[next], high[k]}, material);
  }
  AddPolygon(scene, high, material);
  std::reverse(low.begin(), low.end());
  AddPolygon(scene, low, material);
}

// Everything of an outline that makes facets, its corners counter-clockwise.
class OutlineScene {
 public:
  explicit OutlineScene(const RoomOutline& outline) : outline_(outline), count_(outline.corners_m.size()) {}

  Scene Make() {
    AddFloorAndCeiling();
    for (size_t wall = 0; wall < count_; ++wall) AddWall(static_cast<int>(wall));
    for (const WallRectangle& rectangle : outline_.rectangles) AddRectangle(rectangle);
    for (const RoomBox& box : outline_.boxes) AddSolid(scene_, box);
    return std::move(scene_);
  }

 private:
  Eigen::Vector2d Corner(size_t i) const { return outline_.corners_m[i % count_]; }
  double Height(size_t i) const {
    return outline_.heights_m.size() == 1 ? outline_.heights_m[0] : outline_.heights_m[i % count_];
  }
  bool IsClockwise() const { return SignedAreaM2(outline_.corners_m) < 0; }

  int Material(const std::string& name) { return MaterialOf(scene_, name); }
  void Add(const std::vector<Eigen::Vector3d>& polygon, int material) {
    AddPolygon(scene_, polygon, material);
  }

  void AddFloorAndCeiling() {
    std::vector<Eigen::Vector3d> top;
    for (size_t i = 0; i < count_; ++i) top.emplace_back(Corner(i).x(), Corner(i).y(), Height(i));
    if (IsClockwise()) std::reverse(top.begin(), top.end());
    std::vector<Eigen::Vector3d> bottom = top;
    for (Eigen::Vector3d& p : bottom) p.z() = 0;
    const int floor = Material("floor"), ceiling = Material("ceiling");
    for (const auto& piece : PlanePieces(bottom)) Add(piece, floor);
    for (auto& piece : PlanePieces(top)) {
      std::reverse(piece.begin(), piece.end());  // seen from below
      Add(piece, ceiling);
    }
  }

  // Returns a place on a wall, s along it and z above the floor.
  Eigen::Vector3d OnWall(int wall, double s, double z) const {
    const Eigen::Vector2d a = Corner(static_cast<size_t>(wall)), b = Corner(static_cast<size_t>(wall) + 1);
    const double share = s / (b - a).norm();
    const Eigen::Vector2d p = (1 - share) * a + share * b;
    return {p.x(), p.y(), z};
  }
  double WallHeight(int wall, double s) const {
    const auto i = static_cast<size_t>(wall);
    const double share = s / (Corner(i + 1) - Corner(i)).norm();
    return (1 - share) * Height(i) + share * Height(i + 1);
  }

  // Adds a polygon of (s, z), counter-clockwise on paper with s to the right and z up.
  void AddOnWall(int wall, std::vector<Eigen::Vector2d> polygon, int material) {
    // Seen from inside, s runs to the left where the corners run counter-clockwise.
    if (!IsClockwise()) std::reverse(polygon.begin(), polygon.end());
    std::vector<Eigen::Vector3d> facing;
    facing.reserve(polygon.size());
    for (const Eigen::Vector2d& p : polygon) facing.push_back(OnWall(wall, p.x(), p.y()));
    Add(facing, material);
  }

  void AddWall(int wall) {
    const int material = Material("wall " + std::to_string(wall + 1));
    const auto i = static_cast<size_t>(wall);
    const double length = (Corner(i + 1) - Corner(i)).norm();
    std::vector<double> ends{0, length};
    for (const WallRectangle& r : outline_.rectangles) {
      if (r.wall != wall) continue;
      ends.push_back(std::clamp(r.from_m, 0.0, length));
      ends.push_back(std::clamp(r.to_m, 0.0, length));
    }
    const std::vector<double> cuts = SortedCuts(ends);
    std::vector<PlanStrip> strips;
    for (size_t k = 0; k + 1 < cuts.size(); ++k) {
      const double left = WallHeight(wall, cuts[k]), right = WallHeight(wall, cuts[k + 1]);
      strips.push_back({cuts[k], cuts[k + 1], FreeOn(wall, cuts[k], cuts[k + 1], std::min(left, right))});
      if (left == right) continue;
      const double low = std::min(left, right);
      const Eigen::Vector2d peak =
          left > right ? Eigen::Vector2d(cuts[k], left) : Eigen::Vector2d(cuts[k + 1], right);
      AddOnWall(wall, {{cuts[k], low}, {cuts[k + 1], low}, peak}, material);
    }
    for (const PlanRectangle& r : MergedStrips(strips))
      AddOnWall(wall, {{r.s0, r.t0}, {r.s1, r.t0}, {r.s1, r.t1}, {r.s0, r.t1}}, material);
  }

  // Returns the heights between 0 and `top` that no rectangle covers from s0 to s1.
  std::vector<std::pair<double, double>> FreeOn(int wall, double s0, double s1, double top) const {
    const double middle = 0.5 * (s0 + s1);
    std::vector<std::pair<double, double>> covered, free;
    for (const WallRectangle& r : outline_.rectangles) {
      if (r.wall == wall && r.from_m < middle && middle < r.to_m) covered.emplace_back(r.low_m, r.high_m);
    }
    std::sort(covered.begin(), covered.end());
    double reached = 0;
    for (const auto& [low, high] : covered) {
      if (low - reached > kSliverM) free.emplace_back(reached, low);
      reached = high;
    }
    if (top - reached > kSliverM) free.emplace_back(reached, top);
    return free;
  }

  void AddRectangle(const WallRectangle& r) {
    const auto i = static_cast<size_t>(r.wall);
    const double length = (Corner(i + 1) - Corner(i)).norm();
    const double from = std::max(r.from_m, 0.0), to = std::min(r.to_m, length);
    AddOnWall(r.wall, {{from, r.low_m}, {to, r.low_m}, {to, r.high_m}, {from, r.high_m}}, Material(r.name));
  }

  static constexpr double kSliverM = 1e-6;
  const RoomOutline& outline_;
  size_t count_;
  Scene scene_;
};

}  // namespace

RoomOutline OutlineOfBox(const Eigen::Vector3d& size_m) {
  return {{{0, 0}, {size_m.x(), 0}, {size_m.x(), size_m.y()}, {0, size_m.y()}}, {size_m.z()}, {}, {}};
}

Scene SceneFrom(const RoomOutline& outline) {
  if (const auto fault = FindFault(outline)) throw std::invalid_argument("SceneFrom: " + fault->message);
  return OutlineScene(outline).Make();
}

Scene WithBoxes(Scene scene, const std::vector<RoomBox>& boxes) {
  for (const RoomBox& box : boxes) AddSolid(scene, box);
  return scene;
}

}  // namespace luxfit
