#include "forward/mesh/mesh_check.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "forward/room/internal/box_tree.h"
#include "forward/room/internal/facet_corners.h"
#include "forward/room/internal/mesh_topology.h"
#include "forward/room/internal/shell_volume.h"

namespace luxfit {
namespace {

constexpr size_t kShown = 5;            // places that a finding keeps
constexpr double kSliverAspect = 1000;  // longest side over height
// Rays that leak between facets that do close: 0 of 2e6 in Embree's robust mode.
constexpr double kEscapedShare = 1e-3;
constexpr double kBackShare = 0.05;  // elements partly under a solid have honest ones
constexpr char kCloseMesh[] = "close the mesh, or expect less interreflection than the real room has";
constexpr char kTurnFacets[] =
    "turn the facets so that their corners run counter-clockwise seen from inside the room";

std::string Text(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::string At(const Eigen::Vector3d& p) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "(%.3f, %.3f, %.3f)", p.x(), p.y(), p.z());
  return text.data();
}

Eigen::Vector3d CenterOf(const Facet& facet) {
  const bool triangle = facet.kind == FacetKind::kTriangle;
  return facet.PointAt(triangle ? 1. / 3 : 0.5, triangle ? 1. / 3 : 0.5);
}

// Counts a defect, and keeps the first few.
void Add(MeshFinding& finding, int facet, const Eigen::Vector3d& place, double extent) {
  ++finding.count;
  finding.extent += extent;
  if (finding.places.size() == kShown) return;
  finding.facets.push_back(facet);
  finding.places.push_back(place);
}

// Writes the message "3 facets (0.2 m2) WHAT, the first at (0, 1, 2)"; none where nothing was found.
void Describe(MeshFinding& finding, const std::string& things, const std::string& unit,
              const std::string& what) {
  if (finding.count == 0) return;
  finding.message = std::to_string(finding.count) + " " + things + " (" + Text("%.3g", finding.extent) + " " +
                    unit + ") " + what + ", the first at " + At(finding.places[0]);
}

double DistanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d ab = b - a;
  return (p - a - std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0, 1.0) * ab).norm();
}

// Tells whether a point lies on a facet, its rim included.
bool LiesOn(const Facet& facet, const Eigen::Vector3d& p) {
  const Eigen::Vector3d normal = facet.Normal();
  if (std::abs(normal.dot(p - facet.origin)) > kWeldM) return false;
  const FacetCorners corners = CornersOf(facet);
  for (size_t i = 0; i < corners.count; ++i) {
    const Eigen::Vector3d &a = corners.points[i], &b = corners.points[(i + 1) % corners.count];
    if ((b - a).normalized().cross(p - a).dot(normal) < -kWeldM) return false;
  }
  return true;
}

// Returns the share of an edge's length that no facet but its own lies along.
double OpenShare(const Scene& scene, const BoxTree& tree, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                 int own_facet) {
  constexpr int kProbes = 16;
  int open = 0;
  for (int k = 0; k < kProbes; ++k) {
    const Eigen::Vector3d p = a + (k + 0.5) / kProbes * (b - a);
    bool closed = false;
    tree.ForEach(Eigen::AlignedBox3d(p), [&](int f) {
      closed = f != own_facet && LiesOn(scene.facets[static_cast<size_t>(f)], p);
      return !closed;
    });
    open += closed ? 0 : 1;
  }
  return static_cast<double>(open) / kProbes;
}

MeshFinding OpenEdges(const Scene& scene, const MeshTopology& mesh, const BoxTree& tree) {
  std::vector<const FacetEdge*> single;
  ForEachEdge(mesh, [&](size_t first, size_t last) {
    if (last - first == 1) single.push_back(&mesh.edges[first]);
  });
  std::vector<double> share(single.size());
  const auto from = [&](size_t i) { return mesh.vertices[static_cast<size_t>(single[i]->a)]; };
  const auto to = [&](size_t i) { return mesh.vertices[static_cast<size_t>(single[i]->b)]; };
  tbb::parallel_for(size_t{0}, single.size(),
                    [&](size_t i) { share[i] = OpenShare(scene, tree, from(i), to(i), single[i]->facet); });
  MeshFinding finding;
  finding.defect = MeshDefect::kOpenMesh;
  for (size_t i = 0; i < single.size(); ++i) {
    if (share[i] > 0)
      Add(finding, single[i]->facet, 0.5 * (from(i) + to(i)), share[i] * (to(i) - from(i)).norm());
  }
  Describe(finding, "edges", "m", "end in the open");
  finding.effect = "light leaves the room there and does not come back";
  finding.remedy = kCloseMesh;
  return finding;
}

// Finds the lesser part of each shell where its facets are wound against one another.
MeshFinding FlippedFacets(const Scene& scene, const Shells& shells) {
  std::vector<std::array<double, 2>> area(shells.closed.size(), {0, 0});
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    area[static_cast<size_t>(shells.of_facet[f])][shells.turned[f] ? 1 : 0] += scene.facets[f].AreaM2();
  }
  MeshFinding finding;
  finding.defect = MeshDefect::kFlippedFacets;
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const size_t shell = static_cast<size_t>(shells.of_facet[f]);
    const bool lesser_is_turned = area[shell][1] <= area[shell][0];
    if (shells.orientable[shell] && area[shell][1] > 0 && shells.turned[f] == lesser_is_turned)
      Add(finding, static_cast<int>(f), CenterOf(scene.facets[f]), scene.facets[f].AreaM2());
  }
  Describe(finding, "facets", "m2", "are wound against their neighbours");
  finding.affects_light = finding.count > 0;
  finding.effect = "a back reflects nothing: these facets are black to the room";
  finding.remedy = kTurnFacets;
  return finding;
}

MeshFinding InsideOut(const Scene& scene, const Shells& shells) {
  MeshFinding finding;
  finding.defect = MeshDefect::kInsideOut;
  for (const int f : FacetsOfShellsInsideOut(scene, shells))
    Add(finding, f, CenterOf(scene.facets[static_cast<size_t>(f)]),
        scene.facets[static_cast<size_t>(f)].AreaM2());
  Describe(finding, "facets", "m2", "form shells that are inside out");
  finding.affects_light = finding.count > 0;
  finding.effect = "a room that faces outwards, or a solid that faces inwards, is black";
  finding.remedy = "flip the normals of the whole object: rooms face inwards, solids outwards";
  return finding;
}

// Tells whether the facet is a copy: same outline, facing and material.
bool IsCopy(const Scene& scene, const FacetOverlap& overlap) {
  const Facet &top = scene.facets[static_cast<size_t>(overlap.on_top)],
              &below = scene.facets[static_cast<size_t>(overlap.below)];
  return top.material == below.material &&
         overlap.area_m2 > (1 - 1e-4) * std::max(top.AreaM2(), below.AreaM2());
}

MeshFinding Duplicates(const Scene& scene, const std::vector<FacetOverlap>& overlaps) {
  MeshFinding finding;
  finding.defect = MeshDefect::kDuplicateFacets;
  std::set<int> seen;
  for (const FacetOverlap& overlap : overlaps) {
    const Facet& below = scene.facets[static_cast<size_t>(overlap.below)];
    if (IsCopy(scene, overlap) && seen.insert(overlap.below).second)
      Add(finding, overlap.below, CenterOf(below), below.AreaM2());
  }
  Describe(finding, "facets", "m2", "are drawn twice");
  finding.affects_light = finding.count > 0;
  finding.effect = "none: each counts once";
  finding.remedy = "none needed; remove the copies to silence this";
  return finding;
}

MeshFinding Overlaps(const Scene& scene, const std::vector<FacetOverlap>& overlaps) {
  MeshFinding finding;
  finding.defect = MeshDefect::kCoplanarOverlap;
  std::map<std::pair<int, int>, double> area_of_materials;
  const auto material = [&](int f) { return scene.facets[static_cast<size_t>(f)].material; };
  for (const FacetOverlap& overlap : overlaps) {
    if (IsCopy(scene, overlap)) continue;
    Add(finding, overlap.on_top, CenterOf(scene.facets[static_cast<size_t>(overlap.on_top)]),
        overlap.area_m2);
    area_of_materials[{material(overlap.on_top), material(overlap.below)}] += overlap.area_m2;
  }
  if (finding.count > 0) {
    finding.message = "facets lie in one place over " + Text("%.3g", finding.extent) + " m2";
    for (const auto& [pair, area_m2] : area_of_materials)
      finding.message += ", " + scene.materials[static_cast<size_t>(pair.first)] + " on " +
                         scene.materials[static_cast<size_t>(pair.second)] + " " + Text("%.3g", area_m2) +
                         " m2";
    finding.message += ", the first at " + At(finding.places[0]);
  }
  finding.affects_light = finding.count > 0;
  finding.effect = "only the material with the lesser area in that plane is seen";
  finding.remedy =
      "if the other material should be seen, remove the one on top, or lift what lies on top by 1 mm";
  return finding;
}

MeshFinding Slivers(const Scene& scene) {
  MeshFinding finding;
  finding.defect = MeshDefect::kSliverFacets;
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const Facet& facet = scene.facets[f];
    double longest = std::max(facet.edge_u.norm(), facet.edge_v.norm());
    if (facet.kind == FacetKind::kTriangle) longest = std::max(longest, (facet.edge_u - facet.edge_v).norm());
    const double height = facet.edge_u.cross(facet.edge_v).norm() / longest;
    if (longest > kSliverAspect * height) Add(finding, static_cast<int>(f), CenterOf(facet), facet.AreaM2());
  }
  if (finding.count > 0)
    finding.message = std::to_string(finding.count) + " facets are over " + Text("%g", kSliverAspect) +
                      " times as long as high, the first at " + At(finding.places[0]);
  finding.effect = "none on the light; they cost time";
  finding.remedy = "none needed";
  return finding;
}

MeshFinding NonManifoldEdges(const MeshTopology& mesh) {
  MeshFinding finding;
  finding.defect = MeshDefect::kNonManifoldEdges;
  ForEachEdge(mesh, [&](size_t first, size_t last) {
    if (last - first < 3) return;
    const Eigen::Vector3d &a = mesh.vertices[static_cast<size_t>(mesh.edges[first].a)],
                          &b = mesh.vertices[static_cast<size_t>(mesh.edges[first].b)];
    Add(finding, mesh.edges[first].facet, 0.5 * (a + b), (b - a).norm());
  });
  Describe(finding, "edges", "m", "join three or more facets");
  finding.effect = "none: solids may touch along an edge";
  finding.remedy = "none needed";
  return finding;
}

MeshFinding TJunctions(const MeshTopology& mesh) {
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<const FacetEdge*> edges;
  ForEachEdge(mesh, [&](size_t first, size_t) {
    edges.push_back(&mesh.edges[first]);
    Eigen::AlignedBox3d box(mesh.vertices[static_cast<size_t>(edges.back()->a)]);
    boxes.push_back(box.extend(mesh.vertices[static_cast<size_t>(edges.back()->b)]));
  });
  const BoxTree tree(std::move(boxes));
  std::vector<int> facet_of_vertex(mesh.vertices.size(), -1);  // that with the edge it lies in
  tbb::parallel_for(size_t{0}, mesh.vertices.size(), [&](size_t v) {
    const Eigen::Vector3d& p = mesh.vertices[v];
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kWeldM);
    tree.ForEach({p - margin, p + margin}, [&](int index) {
      const FacetEdge& edge = *edges[static_cast<size_t>(index)];
      const bool own = edge.a == static_cast<int>(v) || edge.b == static_cast<int>(v);
      if (!own && DistanceToSegment(p, mesh.vertices[static_cast<size_t>(edge.a)],
                                    mesh.vertices[static_cast<size_t>(edge.b)]) < kWeldM)
        facet_of_vertex[v] = edge.facet;
      return facet_of_vertex[v] < 0;
    });
  });
  MeshFinding finding;
  finding.defect = MeshDefect::kTJunctions;
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (facet_of_vertex[v] >= 0) Add(finding, facet_of_vertex[v], mesh.vertices[v], 0);
  }
  if (finding.count > 0)
    finding.message = std::to_string(finding.count) +
                      " vertices lie inside an edge of another facet, the first at " + At(finding.places[0]);
  finding.effect = "none: rays need no shared vertices";
  finding.remedy = "none needed";
  return finding;
}

MeshFinding Dropped(const Scene& scene) {
  MeshFinding finding;
  finding.defect = MeshDefect::kFacetsDropped;
  finding.count = scene.dropped_facets;
  finding.message = std::to_string(finding.count) + " facets without area were left out";
  finding.effect = "none";
  finding.remedy = "none needed; clean the mesh to silence this";
  return finding;
}

MeshFinding SeenByRays(MeshDefect defect, const std::string& message, const std::string& remedy) {
  MeshFinding finding;
  finding.defect = defect;
  finding.count = 1;
  finding.affects_light = true;
  finding.message = message;
  finding.remedy = remedy;
  return finding;
}

}  // namespace

std::string ToString(MeshDefect defect) {
  switch (defect) {
    case MeshDefect::kOpenMesh:
      return "open_mesh";
    case MeshDefect::kFlippedFacets:
      return "flipped_facets";
    case MeshDefect::kInsideOut:
      return "inside_out";
    case MeshDefect::kDuplicateFacets:
      return "duplicate_facets";
    case MeshDefect::kCoplanarOverlap:
      return "coplanar_overlap";
    case MeshDefect::kFacetsDropped:
      return "facets_dropped";
    case MeshDefect::kSliverFacets:
      return "sliver_facets";
    case MeshDefect::kNonManifoldEdges:
      return "non_manifold_edges";
    case MeshDefect::kTJunctions:
      return "t_junctions";
  }
  return "";
}

std::vector<MeshFinding> CheckMesh(const Scene& given) {
  const std::vector<FacetOverlap> overlaps = FindOverlaps(given);
  std::vector<MeshFinding> all{Duplicates(given, overlaps), Overlaps(given, overlaps), Dropped(given),
                               Slivers(given)};
  // A facet that is there twice would make every edge of it odd.
  const Scene scene = overlaps.empty() ? given : WithoutOverlaps(given);
  const MeshTopology mesh = MakeTopology(scene);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Facet& facet : scene.facets) boxes.push_back(BoxOf(facet, kWeldM));
  const Shells shells = FindShells(mesh);
  all.push_back(InsideOut(scene, shells));
  all.push_back(OpenEdges(scene, mesh, BoxTree(std::move(boxes))));
  all.push_back(FlippedFacets(scene, shells));
  all.push_back(NonManifoldEdges(mesh));
  all.push_back(TJunctions(mesh));
  std::vector<MeshFinding> findings;
  std::copy_if(all.begin(), all.end(), std::back_inserter(findings),
               [](const MeshFinding& f) { return f.count > 0; });
  return findings;
}

std::vector<MeshFinding> WithRayShares(std::vector<MeshFinding> findings, const RayShares& shares) {
  const auto find = [&](MeshDefect defect) {
    return std::find_if(findings.begin(), findings.end(),
                        [&](const MeshFinding& f) { return f.defect == defect; });
  };
  // A room that is inside out loses all its rays, which is no second defect.
  const bool explained = find(MeshDefect::kInsideOut) != findings.end();
  // Elements behind a flipped facet lie outside, and light that falls on those beside it is lost: no hole
  // either.
  const bool flipped = find(MeshDefect::kFlippedFacets) != findings.end();
  if (find(MeshDefect::kOpenMesh) == findings.end() && shares.escaped > kEscapedShare && !explained &&
      !flipped) {
    findings.push_back(SeenByRays(MeshDefect::kOpenMesh, "the mesh does not enclose the room", kCloseMesh));
  }
  if (find(MeshDefect::kFlippedFacets) == findings.end() && shares.back > kBackShare && !explained) {
    findings.push_back(
        SeenByRays(MeshDefect::kFlippedFacets, "facets turn their backs to the room", kTurnFacets));
  }
  for (MeshFinding& finding : findings) {
    if (finding.defect == MeshDefect::kOpenMesh) {
      finding.affects_light = shares.escaped > kEscapedShare && !explained;
      finding.effect = Text("%.2g", 100 * shares.escaped) + " % of the rays between surfaces leave the room";
    } else if (finding.defect == MeshDefect::kFlippedFacets) {
      finding.effect =
          Text("%.2g", 100 * shares.back) + " % of the rays between surfaces meet a back, which is black";
    }
  }
  return findings;
}

}  // namespace luxfit
