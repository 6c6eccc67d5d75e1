#include "forward/room/internal/shell_volume.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forward/room/internal/facet_corners.h"

namespace luxfit {
namespace {

constexpr double kMaxSolidAngles = 1e7;  // about half a second: the largest shells come first
constexpr size_t kPlaces = 5;
constexpr double kThin = 1e-6;          // volume over area^1.5: a sheet with two sides has none
constexpr double kNearlyClosed = 0.02;  // sum of area vectors over the area

struct Shell {
  std::vector<int> facets;
  Eigen::AlignedBox3d box;
  Eigen::Vector3d area_vector_m2 = Eigen::Vector3d::Zero();
  double area_m2 = 0;
  double volume_m3 = 0;
};

double VolumeOf(const Facet& facet, const Eigen::Vector3d& origin) {
  const double triangle = facet.edge_u.cross(facet.edge_v).dot(facet.origin - origin) / 6;
  return facet.kind == FacetKind::kTriangle ? triangle : 2 * triangle;
}

// Returns the signed solid angle of a triangle seen from the origin.
double SolidAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

// Tells whether an odd number of shells other than this one lie round a point.
bool IsWithinOdd(const Scene& scene, const Shell& shell, const Eigen::Vector3d& p) {
  std::vector<bool> own(scene.facets.size(), false);
  for (const int f : shell.facets) own[static_cast<size_t>(f)] = true;
  double angle = 0;
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    if (own[f]) continue;
    const FacetCorners c = CornersOf(scene.facets[f]);
    angle += SolidAngle(c.points[0] - p, c.points[1] - p, c.points[2] - p);
    if (c.count == 4) angle += SolidAngle(c.points[0] - p, c.points[2] - p, c.points[3] - p);
  }
  return std::llround(angle / (4 * M_PI)) % 2 != 0;
}

// Returns the closed shells, and all open ones as one.
std::vector<Shell> ShellsOf(const Scene& scene, const Shells& shells) {
  std::vector<Shell> result(shells.closed.size() + 1);
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const Facet& facet = scene.facets[f];
    const size_t index = static_cast<size_t>(shells.of_facet[f]);
    Shell& shell = shells.closed[index] && shells.orientable[index] ? result[index] : result.back();
    shell.facets.push_back(static_cast<int>(f));
    shell.box.extend(BoxOf(facet, 0));
    shell.area_vector_m2 += facet.AreaM2() * facet.Normal();
    shell.area_m2 += facet.AreaM2();
  }
  for (Shell& shell : result) {
    for (const int f : shell.facets)
      shell.volume_m3 += VolumeOf(scene.facets[static_cast<size_t>(f)], shell.box.center());
  }
  return result;
}

// Returns a place just off one of the shell's facets, within it.
Eigen::Vector3d PointWithin(const Scene& scene, const Shell& shell, size_t index) {
  const Facet& facet = scene.facets[static_cast<size_t>(shell.facets[index])];
  return facet.PointAt(0.31, 0.29) - (shell.volume_m3 > 0 ? 1e-3 : -1e-3) * facet.Normal();
}

// Tells whether the shell is the inside of something. Most of a few places decide: one of them may lie in a solid
// that stands on the facet.
bool ShouldBeRoom(const Scene& scene, const Shell& shell) {
  const size_t places = std::min(kPlaces, shell.facets.size());
  size_t in_odd = 0;
  for (size_t k = 0; k < places; ++k)
    in_odd += IsWithinOdd(scene, shell, PointWithin(scene, shell, k * shell.facets.size() / places)) ? 1 : 0;
  return 2 * in_odd < places;
}

bool CanBeJudged(const Shell& shell) {
  return std::abs(shell.volume_m3) > kThin * std::pow(shell.area_m2, 1.5) &&
         shell.area_vector_m2.norm() < kNearlyClosed * shell.area_m2;
}

}  // namespace

std::vector<int> FacetsOfShellsInsideOut(const Scene& scene, const Shells& shells) {
  std::vector<Shell> judged = ShellsOf(scene, shells);
  judged.erase(std::remove_if(judged.begin(), judged.end(), [](const Shell& s) { return !CanBeJudged(s); }),
               judged.end());
  std::sort(judged.begin(), judged.end(),
            [](const Shell& a, const Shell& b) { return a.box.volume() > b.box.volume(); });
  const size_t affordable =
      1 + static_cast<size_t>(kMaxSolidAngles / static_cast<double>(kPlaces * (scene.facets.size() + 1)));
  judged.resize(std::min(judged.size(), affordable));
  std::vector<int> inside_out;
  for (const Shell& shell : judged) {
    if ((shell.volume_m3 < 0) != ShouldBeRoom(scene, shell))
      inside_out.insert(inside_out.end(), shell.facets.begin(), shell.facets.end());
  }
  std::sort(inside_out.begin(), inside_out.end());
  return inside_out;
}

}  // namespace luxfit
