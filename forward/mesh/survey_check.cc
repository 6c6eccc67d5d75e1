#include "forward/mesh/mesh_check.h"

#include <algorithm>
#include <cstddef>

namespace luxfit {
namespace {

// Returns the distance, m, that three quarters of the points keep. `points` is not empty.
double TypicalDistance(const Scene& scene, const std::vector<Eigen::Vector3d>& points, double mesh_scale) {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const Eigen::Vector3d& p : points)
    distances.push_back(mesh_scale * DistanceToSurface(scene, p / mesh_scale));
  const auto rank = static_cast<std::ptrdiff_t>(0.75 * static_cast<double>(distances.size()));
  std::nth_element(distances.begin(), distances.begin() + rank, distances.end());
  return distances[static_cast<size_t>(rank)];
}

}  // namespace

SurveyCheck CheckSurvey(const Scene& scene, const std::vector<Eigen::Vector3d>& points_in_world,
                        double declared_metres_per_unit, double tolerance_m) {
  SurveyCheck check;
  if (points_in_world.empty()) return check;
  check.distance_m = TypicalDistance(scene, points_in_world, 1.0);
  check.fits = check.distance_m < tolerance_m;
  if (check.fits) return check;
  struct Unit {
    const char* name;
    double metres;
  };
  double least = tolerance_m;
  for (const Unit& unit :
       {Unit{"m", 1}, Unit{"cm", 0.01}, Unit{"mm", 0.001}, Unit{"in", 0.0254}, Unit{"ft", 0.3048}}) {
    const double scale = unit.metres / declared_metres_per_unit;
    const double distance = TypicalDistance(scene, points_in_world, scale);
    if (distance < least) {
      least = distance;
      check.better_unit = unit.name;
    }
  }
  if (!check.better_unit.empty()) return check;
  // A point of the world lies in the mesh's own frame at (x, z, -y).
  std::vector<Eigen::Vector3d> in_mesh;
  in_mesh.reserve(points_in_world.size());
  for (const Eigen::Vector3d& p : points_in_world) in_mesh.emplace_back(p.x(), p.z(), -p.y());
  check.fits_y_up = TypicalDistance(scene, in_mesh, 1.0) < tolerance_m;
  return check;
}

}  // namespace luxfit
