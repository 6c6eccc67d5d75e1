#include "inverse/fit/internal/start_at_outlines.h"

#include <cmath>
#include <map>
#include <optional>

#include "calib/register/triangulation.h"
#include "forward/room/in_room.h"

namespace luxfit {
namespace {

// Covers the middle of an outline and the error of its view's pose.
constexpr double kMiddleSigmaPx = 2;

// Returns the ray to the middle of the luminaire; none where its plane is seen edge-on.
std::optional<Sight> SightOf(const Luminaire& luminaire, const SeenOutline& seen) {
  constexpr double kEdgeOn = 0.02;
  std::vector<Eigen::Vector3d> rim;  // in the plane 1 m from the eye
  double px_per_rad = 0;
  for (const OutlineRay& ray : seen.rays) {
    const double cosine = std::abs(ray.direction.dot(luminaire.aim));
    if (cosine < kEdgeOn) return {};
    rim.push_back(ray.direction / cosine);
    px_per_rad += ray.px_per_rad / static_cast<double>(seen.rays.size());
  }
  // Triangles from the first point; all areas have the plane's normal, so they compare by its component along the aim.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double area = 0;
  for (size_t i = 1; i + 1 < rim.size(); ++i) {
    const double twice = (rim[i] - rim[0]).cross(rim[i + 1] - rim[0]).dot(luminaire.aim);
    middle += twice / 3 * (rim[0] + rim[i] + rim[i + 1]);
    area += twice;
  }
  if (area == 0) return {};
  return Sight{seen.view, seen.eye, (middle / area).normalized(), kMiddleSigmaPx / px_per_rad};
}

// Returns where a luminaire gets that is moved: there, or 1 cm in front of the surface on the way.
Eigen::Vector3d Moved(const Room& room, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  constexpr double kInFrontM = 0.01;
  const double way_m = (to - from).norm();
  if (!(way_m > 0)) return from;
  const RayHit hit = room.rays.Trace(from, (to - from) / way_m);
  if (hit.facet < 0 || hit.distance > way_m) return to;
  return InFrontOf(room.scene, hit, to, kInFrontM);
}

}  // namespace

LightState AtOutlines(const Room& room, const std::vector<LuminaireOutline>& outlines, LightState state) {
  constexpr double kReachM = 0.15;
  std::map<int, std::vector<Sight>> sights;
  for (const LuminaireOutline& outline : outlines) {
    const auto k = static_cast<size_t>(outline.luminaire);
    if (!state.free[k].position) continue;
    if (const auto sight = SightOf(state.luminaires[k], outline.seen))
      sights[outline.luminaire].push_back(*sight);
  }
  for (const auto& [k, own] : sights) {
    const std::vector<TriangulatedPoint> points = TriangulateSights(own);
    Eigen::Vector3d& position = state.luminaires[static_cast<size_t>(k)].position;
    if (points.empty() || !((points.front().position - position).norm() < kReachM)) continue;
    const Eigen::Vector3d moved = Moved(room, position, points.front().position);
    // Positions are sought in the room's box.
    if (room.scene.facets.empty() || room.scene.Bounds().contains(moved)) position = moved;
  }
  return state;
}

}  // namespace luxfit
