#include "inverse/furniture/missing_pieces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <utility>

#include "forward/room/visibility.h"
#include "inverse/furniture/internal/mesh_agreement.h"
#include "inverse/furniture/internal/new_place.h"
#include "inverse/furniture/internal/room_axes.h"
#include "inverse/furniture/internal/see_through.h"

namespace luxfit {
namespace {

constexpr size_t kFewestViewsOfMesh = 3;
constexpr double kLeastThroughM2 = 0.1;
constexpr double kLeastThroughShare =
    0.1;  // of what views see of a piece: much of a desk may still stand there

struct Candidate {
  std::vector<int> facets;
  MissingPiece missing;
};

std::string MaterialOf(const Scene& mesh, const std::vector<int>& facets) {
  std::map<int, double> area_m2;
  for (const int f : facets) {
    const Facet& facet = mesh.facets[static_cast<size_t>(f)];
    area_m2[facet.material] += facet.AreaM2();
  }
  const auto largest = std::max_element(area_m2.begin(), area_m2.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  return mesh.materials[static_cast<size_t>(largest->first)];
}

std::vector<int> FacetsOf(const std::vector<Candidate>& pieces) {
  std::vector<int> facets;
  for (const Candidate& piece : pieces) facets.insert(facets.end(), piece.facets.begin(), piece.facets.end());
  return facets;
}

// Returns those of the pieces that views see through once the known ones are out, and takes them from the list.
std::vector<Candidate> TakeMissing(const Scene& mesh, const std::vector<SignatureView>& views,
                                   double tolerance, const std::vector<Candidate>& known,
                                   std::vector<std::vector<int>>& pieces) {
  const std::vector<int> out = FacetsOf(known);
  const RayScene rays(WithoutFacets(mesh, out));
  std::vector<SeeThrough> seen(pieces.size());
  tbb::parallel_for(size_t{0}, pieces.size(), [&](size_t i) {
    seen[i] = LookThrough(mesh, out, rays, pieces[i], views, tolerance, kLeastThroughM2);
  });
  std::vector<Candidate> missing;
  std::vector<std::vector<int>> left;
  for (size_t i = 0; i < pieces.size(); ++i) {
    const SeeThrough& s = seen[i];
    if (s.through_m2 < std::max(kLeastThroughM2, kLeastThroughShare * s.judged_m2)) {
      left.push_back(pieces[i]);
      continue;
    }
    const PieceMove move{BoundsOf(mesh, pieces[i]), std::nullopt};
    missing.push_back(
        {pieces[i],
         {MaterialOf(mesh, pieces[i]), move, s.judged_m2, s.through_m2, __builtin_popcountll(s.views)}});
  }
  pieces = std::move(left);
  return missing;
}

// Looks again once a piece is out: what it hid may show that views see through another.
std::vector<Candidate> FindMissing(const Scene& mesh, const std::vector<SignatureView>& views,
                                   double tolerance) {
  std::vector<std::vector<int>> pieces = LoosePieces(mesh);
  std::vector<Candidate> missing;
  while (!pieces.empty()) {
    const std::vector<Candidate> more = TakeMissing(mesh, views, tolerance, missing, pieces);
    if (more.empty()) break;
    missing.insert(missing.end(), more.begin(), more.end());
  }
  std::sort(missing.begin(), missing.end(), [](const Candidate& a, const Candidate& b) {
    return a.missing.move.bounds.volume() > b.missing.move.bounds.volume();
  });
  return missing;
}

// Takes out boxes of which half or more lies in a piece that moved there. `moved`: along the axes.
void DropBoxesIn(const Eigen::AlignedBox3d& moved, const RoomAxes& axes, std::vector<FoundBox>& found) {
  const auto lies_in = [&](const FoundBox& f) {
    const Eigen::AlignedBox3d box = AlongAxes(f.box, axes);
    return 2 * box.intersection(moved).volume() > box.volume();
  };
  found.erase(std::remove_if(found.begin(), found.end(), lies_in), found.end());
}

// Puts missing pieces where views show them, one after the other: each explains what views see of it.
void PutBack(const Scene& mesh, const std::vector<SignatureView>& views, const FurnitureOptions& options,
             std::vector<Candidate>& pieces, std::vector<FoundBox>& found) {
  const RoomAxes axes = AxesOf(mesh);
  std::vector<PieceMove> moves;
  moves.reserve(pieces.size());
  for (const Candidate& piece : pieces) moves.push_back(piece.missing.move);
  std::vector<MeshAgreement> agreement;
  for (size_t i = 0; i < pieces.size() && !found.empty(); ++i) {
    if (agreement.empty())
      agreement = FindMeshAgreement(RayScene(WithPiecesMoved(mesh, moves)), views, options.tolerance);
    const SweptViews swept{views, agreement, EyesOf(views), options.tolerance, 3};
    moves[i].by_m = FindNewPlace(mesh, pieces[i].facets, swept, axes, found, options);
    pieces[i].missing.move = moves[i];
    if (!moves[i].by_m) continue;
    const Eigen::Vector3d along = axes.world_from_axes.transpose() * *moves[i].by_m;
    const Eigen::AlignedBox3d was = AlongAxes(mesh, pieces[i].facets, axes);
    DropBoxesIn({was.min() + along, was.max() + along}, axes, found);
    agreement.clear();
  }
}

}  // namespace

RevisedFurniture ReviseFurniture(const Scene& mesh, const Scene& room,
                                 const std::vector<SignatureView>& views, const FurnitureOptions& options) {
  RevisedFurniture revised;
  if (views.size() < kFewestViewsOfMesh || mesh.facets.empty()) return revised;
  std::vector<Candidate> missing = FindMissing(mesh, views, options.tolerance);
  if (missing.empty()) return {{}, FindFurniture(room, views, options)};
  revised.found = FindFurniture(WithoutFacets(mesh, FacetsOf(missing)), views, options);
  PutBack(mesh, views, options, missing, revised.found);
  for (const Candidate& piece : missing) revised.missing.push_back(piece.missing);
  return revised;
}

}  // namespace luxfit
