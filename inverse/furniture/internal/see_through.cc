#include "inverse/furniture/internal/see_through.h"

#include <algorithm>

#include "forward/changes/pieces.h"
#include "inverse/furniture/internal/cell_judge.h"
#include "inverse/furniture/internal/piece_cells.h"

namespace luxfit {
namespace {

constexpr double kPieceCellM = 0.08;
constexpr double kLeastBehindM = 0.1;
constexpr int kFewestViewsOfPiece = 3;

// Returns the place moved towards an eye by as much as a mesh may be off.
Eigen::Vector3d BeforeMesh(const Eigen::Vector3d& place, const Eigen::Vector3d& eye) {
  return place + kOnMeshM * (eye - place).normalized();
}

// It is a class because signatures and eyes serve all cells.
class PieceWatcher {
 public:
  PieceWatcher(const std::vector<SignatureView>& views, double tolerance)
      : views_(views), tolerance_(tolerance), signatures_(views.front().states), eyes_(EyesOf(views)) {}

  // Lists the views that see a cell, and tells whether they agree on it.
  bool Confirms(const RayScene& whole, const PieceCell& cell, std::vector<size_t>& seeing) {
    signatures_.Clear();
    seeing.clear();
    for (size_t v = 0; v < std::min<size_t>(views_.size(), kMostViews); ++v) {
      const Eigen::Vector3d to_eye = eyes_[v] - cell.place;
      if (to_eye.dot(cell.normal) < kLeastCosine * to_eye.norm()) continue;
      const Eigen::Vector2d pixel = PixelOf(views_[v], cell.place);
      if (!pixel.allFinite() || whole.Occluded(eyes_[v], LiftedOff(cell.place, cell.normal))) continue;
      if (signatures_.Add(views_[v], pixel.x(), pixel.y())) seeing.push_back(v);
    }
    if (seeing.size() < kFewestViewsOfPiece) return false;
    const int agree = __builtin_popcountll(signatures_.LargestAgreement(tolerance_));
    return agree >= kFewestViewsOfPiece &&
           agree >= kLeastShareThatAgrees * static_cast<double>(seeing.size());
  }

  // Tells whether what view v shows at a place lies behind it.
  bool SeesThrough(const RayScene& without, const Eigen::Vector3d& place, size_t v) {
    const Eigen::Vector3d along = (place - eyes_[v]).normalized();
    const RayHit hit = without.Trace(eyes_[v], along);
    if (hit.facet < 0 || hit.distance < (place - eyes_[v]).norm() + kLeastBehindM) return false;
    const Eigen::Vector3d behind = eyes_[v] + hit.distance * along;
    return CompareOthers(views_, v, behind, tolerance_, signatures_,
                         [&](size_t b, const Eigen::Vector2d&) {
                           return !without.Occluded(eyes_[b], BeforeMesh(behind, eyes_[b]));
                         })
        .Explain();
  }

 private:
  const std::vector<SignatureView>& views_;
  double tolerance_;
  Signatures signatures_;
  std::vector<Eigen::Vector3d> eyes_;
};

struct OpenCell {
  PieceCell cell;
  std::vector<size_t> seeing;
};

}  // namespace

SeeThrough LookThrough(const Scene& mesh, const std::vector<int>& left_out, const RayScene& rays,
                       const std::vector<int>& piece, const std::vector<SignatureView>& views,
                       double tolerance, double least_m2) {
  SeeThrough result;
  PieceWatcher watcher(views, tolerance);
  std::vector<OpenCell> open;
  std::vector<size_t> seeing;
  for (const PieceCell& cell : CellsOf(mesh, piece, kPieceCellM)) {
    const bool is_confirmed = watcher.Confirms(rays, cell, seeing);
    if (seeing.size() < kFewestViewsOfPiece) continue;
    result.judged_m2 += cell.area_m2;
    if (is_confirmed) result.confirmed_m2 += cell.area_m2;
    if (!is_confirmed) open.push_back({cell, seeing});
  }
  if (result.judged_m2 - result.confirmed_m2 < least_m2) return result;
  std::vector<int> out = left_out;
  out.insert(out.end(), piece.begin(), piece.end());
  const Scene rest = WithoutFacets(mesh, out);
  if (rest.facets.empty()) return result;
  const RayScene without(rest);
  for (const OpenCell& o : open) {
    std::uint64_t through = 0;
    for (const size_t v : o.seeing)
      through |= std::uint64_t{watcher.SeesThrough(without, o.cell.place, v)} << v;
    if (__builtin_popcountll(through) < kLeastShareThatAgrees * static_cast<double>(o.seeing.size()))
      continue;
    result.through_m2 += o.cell.area_m2;
    result.views |= through;
  }
  return result;
}

}  // namespace luxfit
