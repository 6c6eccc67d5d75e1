#include "forward/factors/internal/unoccluded.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "forward/factors/internal/polygon_factor.h"
#include "forward/room/internal/quadrature.h"

namespace luxfit {
namespace {

constexpr double kFar = 4, kMiddle = 2.2;  // distances in radii, see pair_rows.cc
constexpr size_t kPoints = 4;

double RadiusOf(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  return 0.5 * std::max((u + v).norm(), (u - v).norm());
}

// The area of a patch, in m2, with what solids cover of it.
double WholeArea(const Patch& patch, FacetKind kind) {
  return patch.edge_u.cross(patch.edge_v).norm() * (kind == FacetKind::kTriangle ? 0.5 : 1);
}

// Gauss rules for both kinds of facet, made once.
const std::vector<FacetNode>& Rule(FacetKind kind, int order) {
  static const auto make = [](FacetKind k) {
    return std::array<std::vector<FacetNode>, 4>{FacetRule(k, 1), FacetRule(k, 1), FacetRule(k, 2),
                                                 FacetRule(k, 3)};
  };
  static const auto triangle = make(FacetKind::kTriangle), parallelogram = make(FacetKind::kParallelogram);
  return (kind == FacetKind::kTriangle ? triangle : parallelogram)[static_cast<size_t>(order)];
}

#if defined(__x86_64__) && defined(__GNUC__)
#define LUXFIT_FOR_EVERY_PROCESSOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define LUXFIT_FOR_EVERY_PROCESSOR
#endif

struct Receiver {
  float x, y, z, nx, ny, nz;
};

// row += weight cos cos' / (pi r^4) towards one point of every patch. One loop without branches, so that it
// is vectorised; compiled for several instruction sets, of which the loader picks.
LUXFIT_FOR_EVERY_PROCESSOR
void AddPoints(const float* __restrict x, const float* __restrict y, const float* __restrict z,
               const float* __restrict area, const float* __restrict nx, const float* __restrict ny,
               const float* __restrict nz, const Receiver& r, float* __restrict row, size_t count) {
  const Receiver at = r;
  for (size_t j = 0; j < count; ++j) {
    const float dx = x[j] - at.x, dy = y[j] - at.y, dz = z[j] - at.z;
    const float here = at.nx * dx + at.ny * dy + at.nz * dz;
    const float there = -(nx[j] * dx + ny[j] * dy + nz[j] * dz);
    const float r2 = dx * dx + dy * dy + dz * dz + 1e-12f;
    const float cosines = (here > 0 ? here : 0.0f) * (there > 0 ? there : 0.0f);
    row[j] += area[j] * cosines / (r2 * r2);
  }
}

}  // namespace

UnoccludedFactors::UnoccludedFactors(const Patches& patches, bool contour_always)
    : patches_(patches), contour_always_(contour_always), count_(patches.patches.size()) {
  radius_.resize(count_);
  element_radius_.assign(count_, 0);
  points_.resize(kPoints * 4 * count_);
  normals_.resize(3 * count_);
  for (size_t j = 0; j < count_; ++j) {
    const Patch& patch = patches.patches[j];
    radius_[j] = RadiusOf(patch.edge_u, patch.edge_v);
    const auto first = patches.elements.begin() + patch.first_element;
    for (auto element = first; element != first + patch.element_count; ++element) {
      element_radius_[j] = std::max(element_radius_[j], RadiusOf(element->edge_u, element->edge_v));
    }
    const Facet& facet = patches.facets[static_cast<size_t>(patch.facet)];
    const Eigen::Vector3d normal = facet.Normal();
    for (size_t axis = 0; axis < 3; ++axis)
      normals_[axis * count_ + j] = static_cast<float>(normal[static_cast<Eigen::Index>(axis)]);
    const double area = WholeArea(patch, facet.kind);
    const std::vector<FacetNode>& rule = Rule(facet.kind, 2);
    for (size_t k = 0; k < kPoints; ++k) {
      const Eigen::Vector3d p = patch.origin + rule[k].u * patch.edge_u + rule[k].v * patch.edge_v;
      float* const point = points_.data() + k * 4 * count_ + j;
      for (size_t axis = 0; axis < 3; ++axis)
        point[axis * count_] = static_cast<float>(p[static_cast<Eigen::Index>(axis)]);
      point[3 * count_] = static_cast<float>(rule[k].weight * area / M_PI);
    }
  }
}

std::vector<int> UnoccludedFactors::NearOf(int p) const {
  const Patch& patch = patches_.patches[static_cast<size_t>(p)];
  const Eigen::Vector3d center = patch.center;
  std::vector<int> near;
  for (size_t j = 0; j < count_; ++j) {
    const Patch& other = patches_.patches[j];
    const double reach = 2 * radius_[static_cast<size_t>(p)] + radius_[j] +
                         kFar * std::max(radius_[j], element_radius_[static_cast<size_t>(p)]);
    if (contour_always_ || (other.center - center).squaredNorm() < reach * reach)
      near.push_back(static_cast<int>(j));
  }
  return near;
}

void UnoccludedFactors::Far(const Element& element, float* row) const {
  const bool small =
      element_radius_[static_cast<size_t>(element.patch)] < 0.3 * radius_[static_cast<size_t>(element.patch)];
  const FacetKind kind = patches_.FacetOf(element.patch).kind;
  const Eigen::Vector3f normal = element.normal.cast<float>();
  const std::vector<FacetNode>& rule = Rule(kind, small ? 1 : 2);
  std::fill(row, row + count_, 0.0f);
  for (const FacetNode& node : rule) {
    const Eigen::Vector3f p =
        (element.origin + node.u * element.edge_u + node.v * element.edge_v).cast<float>();
    const Receiver at{p.x(),
                      p.y(),
                      p.z(),
                      static_cast<float>(node.weight) * normal.x(),
                      static_cast<float>(node.weight) * normal.y(),
                      static_cast<float>(node.weight) * normal.z()};
    for (size_t k = 0; k < kPoints; ++k) {
      const float* const point = points_.data() + k * 4 * count_;
      AddPoints(point, point + count_, point + 2 * count_, point + 3 * count_, normals_.data(),
                normals_.data() + count_, normals_.data() + 2 * count_, at, row, count_);
    }
  }
}

double UnoccludedFactors::Quadrature(const Element& element, int j, int element_order,
                                     int patch_order) const {
  const Patch& patch = patches_.patches[static_cast<size_t>(j)];
  const Facet& facet = patches_.FacetOf(j);
  const Eigen::Vector3d normal = facet.Normal();
  const FacetKind kind = patches_.FacetOf(element.patch).kind;
  std::array<Eigen::Vector3d, 9> points;
  const std::vector<FacetNode>& patch_rule = Rule(facet.kind, patch_order);
  for (size_t k = 0; k < patch_rule.size(); ++k)
    points[k] = patch.origin + patch_rule[k].u * patch.edge_u + patch_rule[k].v * patch.edge_v;
  double sum = 0;
  for (const FacetNode& node : Rule(kind, element_order)) {
    const Eigen::Vector3d p = element.origin + node.u * element.edge_u + node.v * element.edge_v;
    for (size_t k = 0; k < patch_rule.size(); ++k) {
      const Eigen::Vector3d d = points[k] - p;
      const double here = element.normal.dot(d), there = -normal.dot(d), r2 = d.squaredNorm();
      if (here > 0 && there > 0) sum += node.weight * patch_rule[k].weight * here * there / (r2 * r2);
    }
  }
  return sum * WholeArea(patch, facet.kind) / M_PI;
}

double UnoccludedFactors::Near(const Element& element, int j) const {
  const Patch& patch = patches_.patches[static_cast<size_t>(j)];
  const FacetKind kind = patches_.FacetOf(j).kind, own = patches_.FacetOf(element.patch).kind;
  const double radius = RadiusOf(element.edge_u, element.edge_v);
  const double larger = std::max(radius, radius_[static_cast<size_t>(j)]);
  const double distance =
      (patch.origin + (kind == FacetKind::kTriangle ? 1.0 / 3 : 0.5) * (patch.edge_u + patch.edge_v) -
       element.center)
          .norm();
  const bool small = radius < 0.3 * radius_[static_cast<size_t>(j)];
  if (!contour_always_) {
    if (distance > kFar * larger) return Quadrature(element, j, small ? 1 : 2, 2);
    if (distance > kMiddle * larger) return Quadrature(element, j, small ? 2 : 3, 3);
  }
  const ConvexPolygon polygon = MakePolygon(patch.origin, patch.edge_u, patch.edge_v, kind);
  // Beside the polygon's rim or on it the factor varies too fast over the element for quadrature.
  const double clearance = distance - radius_[static_cast<size_t>(j)];
  if (small && !contour_always_ && clearance > 2 * radius) {
    double sum = 0;
    for (const FacetNode& node : Rule(own, clearance > 5 * radius ? 2 : 3)) {
      sum += node.weight * PointToPolygon(element.origin + node.u * element.edge_u + node.v * element.edge_v,
                                          element.normal, polygon);
    }
    return sum;
  }
  return PolygonToPolygon(MakePolygon(element.origin, element.edge_u, element.edge_v, own), polygon);
}

}  // namespace luxfit
