#include "forward/light/internal/clustered_room.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <stdexcept>
#include <vector>

#include "forward/room/internal/facet_corners.h"

namespace luxfit {
namespace {

// Gives a patch the corner and the edges of the parallelogram round others of its facet, in the facet's directions.
void Enclose(const Facet& facet, const std::vector<Patch>& members, Patch& patch) {
  Eigen::Matrix<double, 3, 2> edges;
  edges << facet.edge_u, facet.edge_v;
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 3, 2>> to_facet(edges);
  Eigen::AlignedBox2d box;
  for (const Patch& member : members) {
    for (const Eigen::Vector3d& corner :
         CornersOf({facet.kind, member.origin, member.edge_u, member.edge_v, facet.material}))
      box.extend(Eigen::Vector2d(to_facet.solve(corner - facet.origin)));
  }
  patch.origin = facet.PointAt(box.min().x(), box.min().y());
  patch.edge_u = box.sizes().x() * facet.edge_u;
  patch.edge_v = box.sizes().y() * facet.edge_v;
}

// Its elements are not numbered consecutively.
Patch MergedPatch(const Facet& facet, const std::vector<Patch>& members) {
  Patch cluster = members.front();
  cluster.first_element = cluster.element_count = 0;
  if (members.size() == 1) return cluster;
  cluster.area_m2 = 0;
  cluster.center.setZero();
  for (const Patch& patch : members) {
    cluster.area_m2 += patch.area_m2;
    cluster.center += patch.area_m2 * patch.center;
    cluster.is_whole = cluster.is_whole && patch.is_whole;
  }
  cluster.center /= cluster.area_m2;
  Enclose(facet, members, cluster);
  constexpr double kFills = 1 - 1e-6;
  cluster.is_whole = cluster.is_whole && facet.kind == FacetKind::kParallelogram &&
                     cluster.area_m2 > kFills * cluster.edge_u.cross(cluster.edge_v).norm();
  return cluster;
}

size_t ClusterCount(const std::vector<Patch>& patches) {
  size_t count = 0;
  for (const Patch& patch : patches) count = std::max(count, static_cast<size_t>(patch.cluster) + 1);
  return count;
}

Patches MergedPatches(const Patches& patches) {
  std::vector<std::vector<Patch>> members(ClusterCount(patches.patches));
  for (const Patch& patch : patches.patches) members[static_cast<size_t>(patch.cluster)].push_back(patch);
  Patches merged = patches;
  merged.patches.clear();
  for (const std::vector<Patch>& of_cluster : members)
    merged.patches.push_back(
        MergedPatch(patches.facets[static_cast<size_t>(of_cluster.front().facet)], of_cluster));
  for (Element& element : merged.elements)
    element.patch = patches.patches[static_cast<size_t>(element.patch)].cluster;
  return merged;
}

// Adds up the columns of each cluster.
FormFactors ClusteredFormFactors(const Room& room) {
  const FormFactorMatrix& fine = room.form_factors.element_to_patch;
  const std::vector<Patch>& patches = room.patches.patches;
  FormFactors clustered;
  clustered.method = room.form_factors.method;
  clustered.because = room.form_factors.because;
  clustered.escaped_fraction = room.form_factors.escaped_fraction;
  clustered.back_fraction = room.form_factors.back_fraction;
  clustered.closure_error = room.form_factors.closure_error;
  clustered.rays = room.form_factors.rays;
  clustered.element_to_patch.setZero(fine.rows(), static_cast<Eigen::Index>(ClusterCount(patches)));
  tbb::parallel_for(Eigen::Index{0}, fine.rows(), [&](Eigen::Index e) {
    for (Eigen::Index p = 0; p < fine.cols(); ++p)
      clustered.element_to_patch(e, patches[static_cast<size_t>(p)].cluster) += fine(e, p);
  });
  return clustered;
}

}  // namespace

bool HasClusters(const Patches& patches) {
  constexpr size_t kFewPatches = 300;  // their radiosity costs less than the direct light
  constexpr double kFewer = 0.6;
  const size_t count = patches.patches.size();
  return count > kFewPatches &&
         static_cast<double>(ClusterCount(patches.patches)) < kFewer * static_cast<double>(count);
}

Room ClusteredRoom(const Room& room) {
  if (room.sparse) throw std::invalid_argument("ClusteredRoom: expected a room of dense form factors");
  Room clustered{room.scene,     room.rays, MergedPatches(room.patches), {}, {}, nullptr,
                 room.on_planes, nullptr};
  clustered.form_factors = ClusteredFormFactors(room);
  clustered.transport = MakeTransportGeometry(clustered.patches, clustered.form_factors);
  return clustered;
}

}  // namespace luxfit
