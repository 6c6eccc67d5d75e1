#include "forward/room/internal/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>

#include "forward/room/internal/facet_corners.h"

namespace luxfit {
namespace {

// Finds or adds vertices by a grid much coarser than the tolerance: mostly one cell is searched.
class Welder {
 public:
  int IdOf(const Eigen::Vector3d& p, std::vector<Eigen::Vector3d>& vertices) {
    const Eigen::Array3d low = ((p.array() - kWeldM) / kCellM).floor(),
                         high = ((p.array() + kWeldM) / kCellM).floor();
    for (double x = low.x(); x <= high.x(); ++x) {
      for (double y = low.y(); y <= high.y(); ++y) {
        for (double z = low.z(); z <= high.z(); ++z) {
          const auto [first, last] = in_cell_.equal_range(HashOf({x, y, z}));
          for (auto at = first; at != last; ++at) {
            if ((vertices[static_cast<size_t>(at->second)] - p).norm() < kWeldM) return at->second;
          }
        }
      }
    }
    const int id = static_cast<int>(vertices.size());
    vertices.push_back(p);
    in_cell_.emplace(HashOf((p.array() / kCellM).floor()), id);
    return id;
  }

 private:
  static constexpr double kCellM = 16 * kWeldM;

  static uint64_t HashOf(const Eigen::Array3d& cell) {
    uint64_t hash = 0;
    for (const double c : cell) {
      hash = (hash ^ static_cast<uint64_t>(static_cast<int64_t>(c))) * 0x9e3779b97f4a7c15ull;
      hash ^= hash >> 29;
    }
    return hash;
  }

  std::unordered_multimap<uint64_t, int> in_cell_;
};

}  // namespace

MeshTopology MakeTopology(const Scene& scene) {
  MeshTopology mesh;
  Welder welder;
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const FacetCorners points = CornersOf(scene.facets[f]);
    std::array<int, 4> ids{-1, -1, -1, -1};
    for (size_t c = 0; c < points.count; ++c) ids[c] = welder.IdOf(points.points[c], mesh.vertices);
    mesh.corners.push_back(ids);
    for (size_t c = 0; c < points.count; ++c) {
      const int from = ids[c], to = ids[(c + 1) % points.count];
      if (from != to)
        mesh.edges.push_back({std::min(from, to), std::max(from, to), static_cast<int>(f), from > to});
    }
  }
  std::sort(mesh.edges.begin(), mesh.edges.end(), [](const FacetEdge& x, const FacetEdge& y) {
    return std::tie(x.a, x.b, x.facet) < std::tie(y.a, y.b, y.facet);
  });
  return mesh;
}

Shells FindShells(const MeshTopology& mesh) {
  struct Join {
    int facet;
    bool turns;
  };
  const size_t count = mesh.corners.size();
  std::vector<std::vector<Join>> joined(count);
  std::vector<bool> open(count, false);
  ForEachEdge(mesh, [&](size_t first, size_t last) {
    int balance = 0;
    for (size_t e = first; e < last; ++e) balance += mesh.edges[e].reversed ? -1 : 1;
    if (last - first == 2) {
      const FacetEdge &x = mesh.edges[first], &y = mesh.edges[first + 1];
      joined[static_cast<size_t>(x.facet)].push_back({y.facet, x.reversed == y.reversed});
      joined[static_cast<size_t>(y.facet)].push_back({x.facet, x.reversed == y.reversed});
    } else if (balance != 0) {
      for (size_t e = first; e < last; ++e) open[static_cast<size_t>(mesh.edges[e].facet)] = true;
    }
  });
  Shells shells;
  shells.of_facet.assign(count, -1);
  shells.turned.assign(count, false);
  std::vector<int> stack;
  for (size_t start = 0; start < count; ++start) {
    if (shells.of_facet[start] >= 0) continue;
    const int shell = static_cast<int>(shells.closed.size());
    shells.closed.push_back(true);
    shells.orientable.push_back(true);
    shells.of_facet[start] = shell;
    stack.push_back(static_cast<int>(start));
    while (!stack.empty()) {
      const size_t f = static_cast<size_t>(stack.back());
      stack.pop_back();
      if (open[f]) shells.closed.back() = false;
      for (const Join& join : joined[f]) {
        const size_t g = static_cast<size_t>(join.facet);
        const bool turned = shells.turned[f] != join.turns;
        if (shells.of_facet[g] < 0) {
          shells.of_facet[g] = shell;
          shells.turned[g] = turned;
          stack.push_back(join.facet);
        } else if (shells.turned[g] != turned) {
          shells.orientable.back() = false;
        }
      }
    }
  }
  return shells;
}

}  // namespace luxfit
