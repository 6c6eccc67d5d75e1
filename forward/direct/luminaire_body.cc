#include "forward/direct/luminaire_body.h"

#include <algorithm>
#include <cmath>

#include "forward/direct/internal/luminous_surface.h"
#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/internal/expect_luminaire.h"
#include "forward/room/in_room.h"

namespace luxfit {
namespace {

constexpr double kBehindM = 1e-4;  // above the ray tracer's rounding, below any room's detail
constexpr int kDiscCorners = 12;

// Counter-clockwise seen from where the luminaire shines.
std::vector<Eigen::Vector3d> OpeningOutline(const Luminaire& luminaire) {
  const LuminaireAxes axes = AxesOf(luminaire);
  std::vector<Eigen::Vector3d> outline;
  if (luminaire.shape == LuminaireShape::kRectangle) {
    const Eigen::Vector3d u = 0.5 * luminaire.size_m[0] * axes.along,
                          v = 0.5 * luminaire.size_m[1] * axes.across;
    outline = {-u - v, u - v, u + v, v - u};
  } else {
    const double area_of_unit = 0.5 * kDiscCorners * std::sin(2 * M_PI / kDiscCorners);
    const double radius_m = 0.5 * luminaire.size_m[0] * std::sqrt(M_PI / area_of_unit);
    for (int i = 0; i < kDiscCorners; ++i) {
      const double angle = 2 * M_PI * i / kDiscCorners;
      outline.push_back(radius_m * (std::cos(angle) * axes.along + std::sin(angle) * axes.across));
    }
  }
  return outline;
}

}  // namespace

Scene WithLuminaireBodies(Scene scene, const std::vector<Luminaire>& luminaires) {
  ExpectValid(luminaires);
  const int material = static_cast<int>(scene.materials.size());
  for (const Luminaire& luminaire : luminaires) {
    const bool flat =
        luminaire.shape == LuminaireShape::kDisc || luminaire.shape == LuminaireShape::kRectangle;
    if (!flat || !OpsOf(luminaire.distribution).shines_to_one_side(luminaire)) continue;
    for (const bool front : {true, false}) {
      // along x across = aim: the outline's own order faces where the luminaire shines.
      std::vector<Eigen::Vector3d> corners = OpeningOutline(luminaire);
      if (!front) std::reverse(corners.begin(), corners.end());
      for (Eigen::Vector3d& corner : corners)
        corner += luminaire.position - (front ? 1 : 2) * kBehindM * luminaire.aim;
      const std::vector<Facet> facets = FacetsFromPolygon(corners, material);
      scene.facets.insert(scene.facets.end(), facets.begin(), facets.end());
    }
  }
  const bool added = !scene.facets.empty() && scene.facets.back().material == material;
  if (added) scene.materials.emplace_back(kLuminaireBodyMaterial);
  return scene;
}

double ShareOutsideRoom(const RayScene& rays, const Luminaire& luminaire) {
  ExpectValid(luminaire);
  const LuminousSurface surface(luminaire);
  double share = 0;
  for (const SurfaceSample& s : SampleSurface(luminaire.shape, 2)) {
    if (!IsInRoom(rays, surface.PointOf({s.a, s.b}))) share += s.weight;
  }
  return share;
}

}  // namespace luxfit
