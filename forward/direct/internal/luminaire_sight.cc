#include "forward/direct/internal/luminaire_sight.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "forward/direct/internal/luminous_surface.h"
#include "forward/direct/internal/surface_rule.h"

namespace luxfit {
namespace {

// Encloses the luminaire in a square or its rectangle, on the side that the patch lies on. A point is a
// square so small that it lies between all that can be told apart.
struct Outline {
  ConvexPolygon polygon;
  Eigen::Vector3d normal;
};
constexpr double kPointM = 1e-5;

// Returns nothing where the patch lies on both sides of the luminaire's plane.
std::optional<Outline> OutlineTowards(const Luminaire& luminaire, const ConvexPolygon& patch) {
  const LuminousSurface surface(luminaire);
  Eigen::Vector3d along = surface.sides()[0] * surface.axes().along,
                  across = surface.sides()[1] * surface.axes().across, normal = luminaire.aim;
  if (!surface.has_extent()) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int i = 0; i < patch.count; ++i) centre += patch[i] / patch.count;
    normal = (centre - luminaire.position).normalized();
    along = kPointM * normal.unitOrthogonal();
    across = normal.cross(along);
  }
  bool in_front = true, behind = true;
  for (int i = 0; i < patch.count; ++i) {
    const double height = normal.dot(patch[i] - luminaire.position);
    in_front = in_front && height > 0;
    behind = behind && height < 0;
  }
  if (!in_front && !behind) return {};
  if (behind) {
    normal = -normal;
    across = -across;
  }
  return Outline{
      MakePolygon(luminaire.position - 0.5 * (along + across), along, across, FacetKind::kParallelogram),
      normal};
}

// Holds the points of a luminaire that rays aim at.
struct Targets {
  std::vector<Eigen::Vector3f> point;
  std::vector<float> weight;
};

Targets TargetsOn(const Luminaire& luminaire, int order) {
  const LuminousSurface surface(luminaire);
  Targets targets;
  for (const SurfaceSample& sample : SurfaceRule(luminaire.shape, std::max(order, 1), std::max(order, 1))) {
    targets.point.emplace_back(surface.PointOf({sample.a, sample.b}).cast<float>());
    targets.weight.push_back(static_cast<float>(sample.weight));
  }
  return targets;
}

constexpr int kPartsASide = 4, kShadowProbes = kPartsASide * kPartsASide;

// Returns the mean over the probes of the share that each sees.
float ProbedShare(const RayScene& rays, const std::vector<Eigen::Vector3d>& probes,
                  const Eigen::Vector3d& normal, const Targets& targets) {
  std::array<float, kShadowProbes> seen{}, in_front{};
  RayPacket packet;
  std::array<std::pair<size_t, float>, RayPacket::kSize> of_ray;
  const auto cast = [&] {
    if (packet.count == 0) return;
    const unsigned blocked = rays.Occluded(packet);
    for (int k = 0; k < packet.count; ++k) {
      const auto& [probe, weight] = of_ray[static_cast<size_t>(k)];
      if ((blocked >> k & 1U) == 0) seen[probe] += weight;
    }
    packet.count = 0;
  };
  const Eigen::Vector3f up = normal.cast<float>();
  for (size_t p = 0; p < probes.size(); ++p) {
    const Eigen::Vector3f from = LiftedOff(probes[p], normal).cast<float>(), at = probes[p].cast<float>();
    for (size_t t = 0; t < targets.point.size(); ++t) {
      if (!(up.dot(targets.point[t] - at) > 0)) continue;
      in_front[p] += targets.weight[t];
      of_ray[static_cast<size_t>(packet.count)] = {p, targets.weight[t]};
      packet.Add(from, targets.point[t] - from);
      if (packet.count == RayPacket::kSize) cast();
    }
  }
  cast();
  float sum = 0;
  for (size_t p = 0; p < probes.size(); ++p) sum += in_front[p] > 0 ? seen[p] / in_front[p] : 0;
  return sum / static_cast<float>(probes.size());
}

// Returns the sight of the patches that hold any of the elements, patches x luminaires.
Eigen::Array<Sight, Eigen::Dynamic, Eigen::Dynamic> SightOfPatches(const Patches& patches,
                                                                   const std::vector<int>& elements,
                                                                   const std::vector<Luminaire>& luminaires) {
  const std::vector<Blocker> blockers = BlockersOf(patches.facets);
  std::vector<int> wanted;
  wanted.reserve(elements.size());
  for (const int e : elements) wanted.push_back(patches.elements[static_cast<size_t>(e)].patch);
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  Eigen::Array<Sight, Eigen::Dynamic, Eigen::Dynamic> sight(static_cast<Eigen::Index>(patches.patches.size()),
                                                            static_cast<Eigen::Index>(luminaires.size()));
  sight.setConstant(Sight::kPartial);
  // A shaft costs about as much as the rays of one or two elements, and more among many facets.
  constexpr size_t kElementsAPatch = 3, kMostFacets = 500;
  if (elements.size() < kElementsAPatch * wanted.size() || blockers.size() > kMostFacets) return sight;
  tbb::parallel_for(size_t{0}, wanted.size(), [&](size_t i) {
    for (size_t k = 0; k < luminaires.size(); ++k)
      sight(wanted[i], static_cast<Eigen::Index>(k)) =
          PatchSightOf(patches, wanted[i], luminaires[k], blockers);
  });
  return sight;
}

// Returns the probes nearest to the corners of an element. Between them, one edge of a shadow hides nothing that it does
// not hide at one of them.
std::vector<Eigen::Vector3d> CornersOf(const std::vector<Eigen::Vector3d>& probes, bool triangle) {
  if (probes.size() < kShadowProbes || triangle) return probes;
  return {probes.front(), probes[kPartsASide - 1], probes[kShadowProbes - kPartsASide], probes.back()};
}

}  // namespace

std::vector<Eigen::Vector3d> ShadowProbesOf(const Element& element, bool triangle) {
  if (!element.is_whole) return ProbesOf(element, triangle);
  std::vector<Eigen::Vector3d> probes;
  probes.reserve(kShadowProbes);
  const auto add = [&](double i, double j) {
    probes.push_back(element.origin + i / kPartsASide * element.edge_u + j / kPartsASide * element.edge_v);
  };
  for (int i = 0; i < kPartsASide; ++i) {
    for (int j = 0; j < kPartsASide; ++j) {
      if (!triangle) add(i + 0.5, j + 0.5);
      if (triangle && i + j < kPartsASide) add(i + 1.0 / 3, j + 1.0 / 3);
      if (triangle && i + j < kPartsASide - 1) add(i + 2.0 / 3, j + 2.0 / 3);
    }
  }
  return probes;
}

Sight PatchSightOf(const Patches& patches, int patch, const Luminaire& luminaire,
                   const std::vector<Blocker>& blockers) {
  const Patch& of = patches.patches[static_cast<size_t>(patch)];
  const Facet& facet = patches.facets[static_cast<size_t>(of.facet)];
  // The parallelogram encloses the free part of a patch that is not whole. Its triangle may not.
  const ConvexPolygon polygon =
      MakePolygon(of.origin, of.edge_u, of.edge_v, of.is_whole ? facet.kind : FacetKind::kParallelogram);
  const std::optional<Outline> outline = OutlineTowards(luminaire, polygon);
  if (!outline) return Sight::kPartial;
  Shaft shaft(polygon, facet.Normal(), outline->polygon, outline->normal);
  if (shaft.FacesAway()) return Sight::kNone;
  std::vector<const Blocker*> near;
  for (const Blocker& blocker : blockers) {
    if (blocker.facet != of.facet && !shaft.ClearlyExcludes(blocker)) near.push_back(&blocker);
  }
  if (near.empty()) return Sight::kFree;
  shaft.MakeSides();
  bool is_free = true;
  for (const Blocker* blocker : near) {
    if (shaft.SidesExclude(*blocker)) continue;
    if (shaft.IsBlockedBy(*blocker)) return Sight::kNone;
    is_free = false;
  }
  return is_free ? Sight::kFree : Sight::kPartial;
}

Eigen::MatrixXf ElementVisibility(const RayScene& rays, const Patches& patches,
                                  const std::vector<int>& elements, const std::vector<Luminaire>& luminaires,
                                  int order) {
  const auto sight = SightOfPatches(patches, elements, luminaires);
  std::vector<Targets> rough, fine;
  for (const Luminaire& luminaire : luminaires) {
    rough.push_back(TargetsOn(luminaire, std::min(order, 2)));
    fine.push_back(TargetsOn(luminaire, order));
  }
  Eigen::MatrixXf share(static_cast<Eigen::Index>(elements.size()),
                        static_cast<Eigen::Index>(luminaires.size()));
  tbb::parallel_for(size_t{0}, elements.size(), [&](size_t i) {
    const Element& element = patches.elements[static_cast<size_t>(elements[i])];
    const std::vector<Eigen::Vector3d> probes = ShadowProbesOf(element, patches.IsTriangle(element.patch));
    const std::vector<Eigen::Vector3d> corners = CornersOf(probes, patches.IsTriangle(element.patch));
    for (size_t k = 0; k < luminaires.size(); ++k) {
      const auto lamp = static_cast<Eigen::Index>(k);
      float& of = share(static_cast<Eigen::Index>(i), lamp);
      const Sight patch_sees = sight(element.patch, lamp);
      if (patch_sees != Sight::kPartial) {
        of = patch_sees == Sight::kFree ? 1.0F : 0.0F;
        continue;
      }
      // Most elements see all of a luminaire or nothing, and the outer points of both show which.
      of = ProbedShare(rays, corners, element.normal, rough[k]);
      if (corners.size() < probes.size() && of != 0 && of != 1)
        of = ProbedShare(rays, probes, element.normal, rough[k]);
      if (order > 2 && of != 0 && of != 1) of = ProbedShare(rays, probes, element.normal, fine[k]);
    }
  });
  return share;
}

}  // namespace luxfit
