#include "inverse/furniture/internal/mesh_agreement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace luxfit {
namespace {

constexpr int kCellPx = MeshAgreement::kCellPx;

MeshAgreement DistancesOf(const RayScene& mesh, const SignatureView& view) {
  MeshAgreement cells;
  cells.width = (view.width_px + kCellPx - 1) / kCellPx;
  cells.height = (view.height_px + kCellPx - 1) / kCellPx;
  const Eigen::Vector3d eye = view.Eye();
  for (int row = 0; row < cells.height; ++row) {
    for (int column = 0; column < cells.width; ++column) {
      const RayHit hit = mesh.Trace(eye, RayOf(view, column, row));
      cells.distance_m.push_back(hit.facet < 0 ? std::numeric_limits<float>::infinity()
                                               : static_cast<float>(hit.distance));
    }
  }
  cells.is_explained.assign(cells.distance_m.size(), 0);
  cells.is_compared = cells.is_explained;
  return cells;
}

void Compare(const std::vector<SignatureView>& views, const std::vector<MeshAgreement>& cells, size_t a,
             double tolerance, MeshAgreement& result) {
  const SignatureView& view = views[a];
  const Eigen::Vector3d eye = view.Eye();
  const std::vector<Eigen::Vector3d> eyes = EyesOf(views);
  Signatures signatures(view.states);
  size_t at = 0;
  for (int row = 0; row < result.height; ++row) {
    for (int column = 0; column < result.width; ++column, ++at) {
      if (!(result.distance_m[at] < 1e6F)) continue;
      const Eigen::Vector3d place = eye + result.distance_m[at] * RayOf(view, column, row);
      const OthersAt others =
          CompareOthers(views, a, place, tolerance, signatures, [&](size_t b, const Eigen::Vector2d& p) {
            return (place - eyes[b]).norm() <= cells[b].distance_m[cells[b].CellOf(p.x(), p.y())] + kOnMeshM;
          });
      result.is_compared[at] = others.seen > 0;
      result.is_explained[at] = others.Explain();
    }
  }
}

}  // namespace

std::vector<Eigen::Vector3d> EyesOf(const std::vector<SignatureView>& views) {
  std::vector<Eigen::Vector3d> eyes;
  eyes.reserve(views.size());
  for (const SignatureView& view : views) eyes.push_back(view.Eye());
  return eyes;
}

Eigen::Vector3d RayOf(const SignatureView& view, int column, int row) {
  const Eigen::Vector3d pixel(kCellPx * column + 0.5 * (kCellPx - 1), kCellPx * row + 0.5 * (kCellPx - 1), 1);
  return view.cam_from_world.linear().transpose() * (view.pixel_from_ray.inverse() * pixel).normalized();
}

std::vector<MeshAgreement> FindMeshAgreement(const RayScene& mesh, const std::vector<SignatureView>& views,
                                             double tolerance) {
  std::vector<MeshAgreement> cells(views.size());
  tbb::parallel_for(size_t{0}, views.size(), [&](size_t a) { cells[a] = DistancesOf(mesh, views[a]); });
  std::vector<MeshAgreement> result = cells;
  tbb::parallel_for(size_t{0}, views.size(),
                    [&](size_t a) { Compare(views, cells, a, tolerance, result[a]); });
  return result;
}

}  // namespace luxfit
