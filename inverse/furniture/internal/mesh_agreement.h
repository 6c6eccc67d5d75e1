// Tells which pixels of the views the mesh explains.
//
// The ray of a pixel meets the mesh at a place. The mesh explains the pixel where at least half of the other views
// that see this place show the same signature there (internal/signature.h). Something in front of the mesh, or a
// mirror, shows another one in each view.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_MESH_AGREEMENT_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_MESH_AGREEMENT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/room/visibility.h"
#include "inverse/furniture/internal/signature.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {

// Holds one number a cell of kCellPx x kCellPx pixels, for the pixel in its middle.
struct MeshAgreement {
  static constexpr int kCellPx = 2;
  int width = 0, height = 0;
  std::vector<float> distance_m;  // from the eye to the mesh; infinity: there is none
  std::vector<char> is_explained;
  std::vector<char> is_compared;  // another view sees the place

  size_t CellOf(double u, double v) const {
    return static_cast<size_t>(static_cast<int>(v) / kCellPx) * static_cast<size_t>(width) +
           static_cast<size_t>(static_cast<int>(u) / kCellPx);
  }
};

// A surface behind the mesh by no more than this is on it, m.
constexpr double kOnMeshM = 0.05;

// Returns the agreement of each view.
std::vector<MeshAgreement> FindMeshAgreement(const RayScene& mesh, const std::vector<SignatureView>& views,
                                             double tolerance);

// Counts the other views that see a place, and those of them that show the same signature there as view `a`.
struct OthersAt {
  int seen = 0, agree = 0;
  bool Explain() const { return seen > 0 && 2 * agree >= seen; }
};
// `sees(b, pixel)` tells whether no mesh hides the place from view b, which shows it at that pixel.
template <typename Sees>
OthersAt CompareOthers(const std::vector<SignatureView>& views, size_t a, const Eigen::Vector3d& place,
                       double tolerance, Signatures& signatures, const Sees& sees);

std::vector<Eigen::Vector3d> EyesOf(const std::vector<SignatureView>& views);

// Returns the unit direction of a cell's pixel, world frame.
Eigen::Vector3d RayOf(const SignatureView& view, int column, int row);

template <typename Sees>
OthersAt CompareOthers(const std::vector<SignatureView>& views, size_t a, const Eigen::Vector3d& place,
                       double tolerance, Signatures& signatures, const Sees& sees) {
  OthersAt others;
  const Eigen::Vector2d own = PixelOf(views[a], place);
  signatures.Clear();
  if (!own.allFinite() || !signatures.Add(views[a], own.x(), own.y())) return others;
  for (size_t b = 0; b < views.size(); ++b) {
    if (b == a) continue;
    const Eigen::Vector2d p = PixelOf(views[b], place);
    if (!p.allFinite() || !sees(b, p) || !signatures.Add(views[b], p.x(), p.y())) continue;
    ++others.seen;
    others.agree += signatures.Agree(0, signatures.count() - 1, tolerance) ? 1 : 0;
  }
  return others;
}

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_MESH_AGREEMENT_H_
