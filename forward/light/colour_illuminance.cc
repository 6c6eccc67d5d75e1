#include "forward/light/illuminance.h"

#include <algorithm>
#include <stdexcept>

#include "forward/light/internal/direct_columns.h"
#include "forward/light/internal/gather.h"
#include "forward/radiosity/internal/sparse_transport.h"

namespace luxfit {
namespace {

RadiositySolution Solve(const Room& room, const Eigen::VectorXd& albedo, const Eigen::MatrixXf& patch_direct,
                        RadiositySolverOptions solver) {
  if (!room.sparse) return SolveRadiosity(room.transport, albedo, patch_direct, solver);
  if (solver.solver == RadiositySolver::kLu || solver.solver == RadiositySolver::kCholesky)
    solver.solver = RadiositySolver::kAuto;  // these need all pairs
  return SolveRadiosity(*room.sparse, room.transport.patch_area_m2, room.transport.patch_material, albedo,
                        patch_direct, solver);
}

}  // namespace

ColourIlluminance ComputeColourIlluminance(const Room& room, const Receivers& receivers,
                                           const LuminaireVisibility& visibility,
                                           const std::vector<Luminaire>& luminaires,
                                           const Eigen::Matrix3Xd& albedo_rgb, const Eigen::Vector3d& weights,
                                           const RadiositySolverOptions& solver) {
  if (albedo_rgb.cols() != static_cast<Eigen::Index>(room.scene.materials.size()))
    throw std::invalid_argument("ComputeColourIlluminance: expected a reflectance for every material");
  if (!(weights.array() >= 0).all() || !(weights.sum() > 0))
    throw std::invalid_argument("ComputeColourIlluminance: expected weights >= 0, not all 0");
  const DirectColumns direct = ComputeDirectColumns(room, receivers, visibility, luminaires, {});
  ColourIlluminance result;
  result.direct = direct.receivers;
  result.total = direct.receivers;
  result.element_indirect.setZero(direct.elements.rows(), direct.elements.cols());
  const bool reflects = !room.patches.patches.empty();
  const Eigen::MatrixXf patch_direct = PatchMean(room.patches, direct.elements);
  Eigen::Vector3d share = weights / weights.sum();
  for (int channel = 0; channel < 3; ++channel) {
    if (share[channel] == 0) continue;
    const Eigen::VectorXd albedo = albedo_rgb.row(channel).transpose();
    double weight = 0;
    for (int other = channel; other < 3; ++other) {
      if (albedo_rgb.row(other) != albedo_rgb.row(channel)) continue;
      weight += share[other];
      share[other] = 0;  // solved with this one
    }
    if (reflects) {
      const RadiositySolution solution = Solve(room, albedo, patch_direct, solver);
      const Eigen::MatrixXf indirect = IndirectAtElements(room, solution.exitance);
      const Eigen::MatrixXf exitance =
          ElementAlbedo(room.patches, albedo).asDiagonal() * (direct.elements + indirect);
      result.total += static_cast<float>(weight) * GatherAtReceivers(receivers, indirect, exitance);
      result.element_indirect += static_cast<float>(weight) * indirect;
      result.solver = solution.solver;
      result.iterations = std::max(result.iterations, solution.iterations);
      result.error_percent = std::max(result.error_percent, solution.error_percent);
    }
    ++result.solved_channels;
  }
  return result;
}

}  // namespace luxfit
