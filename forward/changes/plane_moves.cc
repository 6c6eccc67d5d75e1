#include "forward/changes/plane_moves.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/changes/pieces.h"
#include "forward/room/internal/facet_corners.h"
#include "forward/room/internal/mesh_topology.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;

double Above(const PlaneMove& plane, const Vector3d& p) { return plane.normal.dot(p) - plane.offset_m; }

// Returns how a corner on the plane moves. `others`: normals of the facets that have a corner there.
Vector3d ShiftOf(const PlaneMove& plane, const std::vector<Vector3d>& others) {
  constexpr double kAlongThePlane = 0.9;  // facets turned away by less than 25 degrees hold nothing
  Eigen::MatrixX3d rows(1 + others.size(), 3);
  rows.row(0) = plane.normal.transpose();
  Eigen::Index count = 1;
  for (const Vector3d& m : others)
    if (std::abs(m.dot(plane.normal)) < kAlongThePlane) rows.row(count++) = m.transpose();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  right[0] = plane.by_m;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-6);
  const Vector3d shift = solver.compute(rows.topRows(count)).solve(right);
  // Where more facets meet than a place can slide along, it goes straight.
  return std::abs(shift.dot(plane.normal) - plane.by_m) < 1e-6 ? shift : plane.by_m * plane.normal;
}

// Moves flat pieces that touch the plane, and returns for each facet whether it moved with one.
std::vector<bool> MoveFlatPieces(const PlaneMove& plane, Scene& scene) {
  std::vector<bool> moved(scene.facets.size(), false);
  for (const std::vector<int>& piece : LoosePieces(scene)) {
    double low = kFlatPieceM, high = -kFlatPieceM;
    for (const int f : piece) {
      for (const Vector3d& p : CornersOf(scene.facets[static_cast<size_t>(f)])) {
        low = std::min(low, Above(plane, p));
        high = std::max(high, Above(plane, p));
      }
    }
    // A piece that lies wholly in the plane is a part of it.
    if (std::abs(low) > kOnPlaneM || high > kFlatPieceM || high < kOnPlaneM) continue;
    for (const int f : piece) {
      moved[static_cast<size_t>(f)] = true;
      scene.facets[static_cast<size_t>(f)].origin += plane.by_m * plane.normal;
    }
  }
  return moved;
}

// Returns by vertex of the mesh how it moves.
std::vector<Vector3d> ShiftsOf(const PlaneMove& plane, const Scene& scene, const MeshTopology& mesh,
                               const std::vector<bool>& has_moved) {
  std::vector<std::vector<Vector3d>> normals(mesh.vertices.size());
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    if (has_moved[f]) continue;
    const Vector3d normal = scene.facets[f].Normal();
    for (const int v : mesh.corners[f])
      if (v >= 0 && std::abs(Above(plane, mesh.vertices[static_cast<size_t>(v)])) < kOnPlaneM)
        normals[static_cast<size_t>(v)].push_back(normal);
  }
  std::vector<Vector3d> shifts(mesh.vertices.size(), Vector3d::Zero());
  for (size_t v = 0; v < shifts.size(); ++v)
    if (!normals[v].empty()) shifts[v] = ShiftOf(plane, normals[v]);
  return shifts;
}

bool IsParallelogram(const std::vector<Vector3d>& p) {
  return p.size() == 4 && (p[0] - p[1] + p[2] - p[3]).norm() < 1e-6;
}

Scene WithPlaneMoved(Scene scene, const PlaneMove& plane) {
  const MeshTopology mesh = MakeTopology(scene);
  const std::vector<bool> has_moved = MoveFlatPieces(plane, scene);
  const std::vector<Vector3d> shifts = ShiftsOf(plane, scene, mesh, has_moved);
  std::vector<Facet> facets;
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    Facet facet = scene.facets[f];
    std::vector<Vector3d> corners;
    bool is_shifted = false;
    for (const Vector3d& p : CornersOf(facet)) {
      const Vector3d& shift = shifts[static_cast<size_t>(mesh.corners[f][corners.size()])];
      is_shifted = is_shifted || shift.squaredNorm() > 0;
      corners.push_back(p + shift);
    }
    if (!is_shifted || has_moved[f]) {
      facets.push_back(facet);
    } else if (corners.size() == 3 || IsParallelogram(corners)) {
      facet.origin = corners[0];
      facet.edge_u = corners[1] - corners[0];
      facet.edge_v = corners.back() - corners[0];
      facets.push_back(facet);
    } else {
      for (const Facet& part : FacetsFromPolygon(corners, facet.material)) facets.push_back(part);
    }
  }
  scene.facets = std::move(facets);
  return scene;
}

}  // namespace

Scene WithPlanesMoved(Scene scene, const std::vector<PlaneMove>& moves) {
  if (!moves.empty() && !scene.surface.empty())
    throw std::invalid_argument("WithPlanesMoved: expected a scene without surface triangles");
  for (const PlaneMove& move : moves) scene = WithPlaneMoved(std::move(scene), move);
  return scene;
}

}  // namespace luxfit
