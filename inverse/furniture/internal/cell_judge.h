// Asks for one place whether views see a surface there that the mesh lacks.
//
//   +1   `fewest_views` or more agree on it, at least 60 % of those that face it, and the mesh explains at most half
//        of their pixels
//   -1   as many views face it, and see something else there
//    0   fewer views face it
//
// A view faces a place where it looks at its front by more than 9 degrees and no mesh lies before it.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_CELL_JUDGE_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_CELL_JUDGE_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "inverse/furniture/internal/mesh_agreement.h"
#include "inverse/furniture/internal/signature.h"

namespace luxfit {

constexpr double kLeastCosine = 0.15;          // of a view that faces a place
constexpr double kLeastShareThatAgrees = 0.6;  // of the views that face a place

// Holds what all places share. Views beyond the first kMostViews - 1 take no part.
struct SweptViews {
  const std::vector<SignatureView>& views;
  const std::vector<MeshAgreement>& mesh;
  std::vector<Eigen::Vector3d> eyes;
  double tolerance;  // of signatures
  int fewest_views;  // that agree: 2 or more
};

// It is a class because the buffers serve all places.
class CellJudge {
 public:
  explicit CellJudge(const SweptViews& swept);

  // `agreeing`: those that agree and that the mesh does not explain; 0 unless the vote is +1.
  int VoteOn(const Eigen::Vector3d& place, const Eigen::Vector3d& normal, std::uint64_t& agreeing);

 private:
  struct Facing {
    int view = 0;
    bool is_explained = false;
    Eigen::Vector2d pixel;
  };

  void FindFacing(const Eigen::Vector3d& place, const Eigen::Vector3d& normal);
  int UnexplainedOf(std::uint64_t set) const;
  // Keeps the views whose signature is known.
  void Sample();

  const SweptViews& swept_;
  Signatures signatures_;
  std::array<Facing, kMostViews> facing_;
  int count_ = 0;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_CELL_JUDGE_H_
