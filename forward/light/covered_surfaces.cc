#include "forward/light/covered_surfaces.h"

#include <cmath>
#include <map>

#include "forward/light/internal/direct_columns.h"
#include "forward/light/internal/gather.h"

namespace luxfit {
namespace {

double AreaOf(const Luminaire& luminaire) {
  if (luminaire.shape == LuminaireShape::kRectangle) return luminaire.size_m.prod();
  return luminaire.shape == LuminaireShape::kDisc ? M_PI / 4 * luminaire.size_m[0] * luminaire.size_m[0] : 0;
}

// Returns the form factor between two equal coaxial discs.
double FacingDiscs(double area_m2, double distance_m) {
  const double ratio2 = area_m2 / (M_PI * distance_m * distance_m);  // (radius / distance)^2
  const double x = 2 + 1 / ratio2;
  return 0.5 * (x - std::sqrt(x * x - 4));
}

// Returns whether a ray met the same surface as the one of `behind`. Meshes cut surfaces into facets.
bool IsSameSurface(const Scene& scene, const RayHit& hit, const RayHit& behind) {
  constexpr double kFlatM = 0.01;
  if (hit.facet == behind.facet) return true;
  if (hit.facet < 0 || !hit.front) return false;
  const Facet& own = scene.facets[static_cast<size_t>(hit.facet)];
  const Facet& first = scene.facets[static_cast<size_t>(behind.facet)];
  const double off_m = first.Normal().dot(own.PointAt(hit.u, hit.v) - first.origin);
  return own.material == first.material && std::abs(off_m) < kFlatM;
}

}  // namespace

std::vector<CoveredSurface> FindCoveredSurfaces(const Room& room, const std::vector<Luminaire>& luminaires) {
  constexpr int kSide = 8;
  constexpr double kLeastShare = 0.1;
  std::vector<CoveredSurface> surfaces;
  for (size_t k = 0; k < luminaires.size(); ++k) {
    const Luminaire& luminaire = luminaires[k];
    const double area = AreaOf(luminaire);
    if (!(area > 0)) continue;
    const RayHit behind = room.rays.Trace(luminaire.position, -luminaire.aim);
    if (behind.facet < 0 || !behind.front) continue;
    CoveredSurface surface;
    surface.luminaire = static_cast<int>(k);
    surface.share = FacingDiscs(area, std::max(behind.distance, 1e-6));
    if (surface.share < kLeastShare) continue;
    std::map<int, double> covered;
    const LuminaireAxes axes = AxesOf(luminaire);
    for (const SurfaceSample& sample : SampleSurface(luminaire.shape, kSide)) {
      const double width = luminaire.size_m[0];
      const double depth = luminaire.shape == LuminaireShape::kDisc ? width : luminaire.size_m[1];
      const Eigen::Vector3d point =
          luminaire.position + sample.a * width * axes.along + sample.b * depth * axes.across;
      const RayHit hit = room.rays.Trace(point, -luminaire.aim);
      if (!IsSameSurface(room.scene, hit, behind)) continue;
      const int element = room.patches.ElementAt(hit.facet, hit.u, hit.v);
      if (element >= 0) covered[element] += sample.weight * area;
    }
    if (covered.empty()) continue;
    surface.elements.assign(covered.begin(), covered.end());
    const int patch = room.patches.elements[static_cast<size_t>(covered.begin()->first)].patch;
    surface.material = room.patches.patches[static_cast<size_t>(patch)].material;
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

CoveredLight ComputeCoveredLight(const Room& room, const Receivers& receivers,
                                 const LuminaireVisibility& visibility,
                                 const std::vector<Luminaire>& luminaires, const Transport& transport,
                                 const std::vector<CoveredSurface>& surfaces) {
  const auto count = static_cast<Eigen::Index>(surfaces.size());
  const auto elements = static_cast<Eigen::Index>(room.patches.elements.size());
  const DirectColumns direct = ComputeDirectColumns(room, receivers, visibility, luminaires, {});
  const Eigen::MatrixXf patch_direct = PatchMean(room.patches, direct.elements);
  const Eigen::MatrixXf patch_total = patch_direct + transport.Irradiance(transport.Exitance(patch_direct));

  CoveredLight light;
  light.incident.setZero(count, static_cast<Eigen::Index>(luminaires.size()));
  Eigen::MatrixXf emitted = Eigen::MatrixXf::Zero(elements, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    double area = 0;
    for (const auto& [element, covered_m2] : surfaces[static_cast<size_t>(k)].elements) {
      const Element& e = room.patches.elements[static_cast<size_t>(element)];
      light.incident.row(k) += covered_m2 * patch_total.row(e.patch).cast<double>();
      emitted(element, k) = static_cast<float>(covered_m2 / e.area_m2);
      area += covered_m2;
    }
    light.incident.row(k) /= area;
  }
  // M = e + rho F M, of which Exitance solves the part that is reflected.
  const Eigen::MatrixXf patch_emitted = PatchMean(room.patches, emitted);
  const Eigen::MatrixXf exitance = patch_emitted + transport.Exitance(transport.Irradiance(patch_emitted));
  light.response = GatherEmitted(room, receivers, transport.albedo(), emitted, exitance).cast<double>();
  return light;
}

Eigen::MatrixXd HiddenLight(const std::vector<CoveredSurface>& surfaces, const CoveredLight& light,
                            const Eigen::VectorXd& albedo, double body_albedo, bool always_there) {
  Eigen::MatrixXd hidden = Eigen::MatrixXd::Zero(light.response.rows(), light.incident.cols());
  for (size_t k = 0; k < surfaces.size(); ++k) {
    const auto surface = static_cast<Eigen::Index>(k);
    const double lost = surfaces[k].share * (albedo[surfaces[k].material] - body_albedo);
    if (always_there) {
      hidden += lost * light.response.col(surface) * light.incident.row(surface);
    } else {
      const Eigen::Index own = surfaces[k].luminaire;
      hidden.col(own) += lost * light.incident(surface, own) * light.response.col(surface);
    }
  }
  return hidden;
}

}  // namespace luxfit
