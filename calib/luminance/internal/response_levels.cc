#include "calib/luminance/internal/response_levels.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace luxfit {

LevelPosition PositionOf(double counts, double full_scale_counts) {
  const double position =
      std::clamp(counts / full_scale_counts, 0.0, 1.0) * static_cast<double>(kResponseLevels - 1);
  const Eigen::Index below = std::min(static_cast<Eigen::Index>(position), kResponseLevels - 2);
  return {below, position - static_cast<double>(below)};
}

bool IsInRange(double counts, const ResponseOptions& options) {
  return counts > options.dark_fraction * options.full_scale_counts &&
         counts < options.saturation_fraction * options.full_scale_counts;
}

void CheckSamples(const std::vector<BracketSamples>& brackets) {
  Eigen::Index pixels = 0;
  for (const BracketSamples& bracket : brackets) {
    if (!(bracket.exposure_s.array() > 0).all() || !bracket.exposure_s.allFinite())
      throw std::invalid_argument("BracketSamples: exposure_s: expected > 0");
    for (const Eigen::MatrixXd& counts : bracket.counts) {
      if (counts.cols() != bracket.exposure_s.size() || counts.rows() != bracket.counts[0].rows())
        throw std::invalid_argument("BracketSamples: counts: expected pixels x exposures in every channel");
    }
    pixels += bracket.counts[0].rows();
  }
  if (pixels == 0) throw std::invalid_argument("BracketSamples: expected pixels, got none");
}

CameraResponse ResponseOf(std::array<Eigen::VectorXd, 3> log_exposure, double full_scale_counts) {
  const LevelPosition half = PositionOf(full_scale_counts / 2, full_scale_counts);
  double largest = -1e300;
  for (Eigen::VectorXd& curve : log_exposure) {
    curve.array() -= (1 - half.share) * curve[half.below] + half.share * curve[half.below + 1];
    largest = std::max(largest, curve[kResponseLevels - 1]);
  }
  std::array<Eigen::VectorXd, 3> exposure;
  for (size_t c = 0; c < 3; ++c) exposure[c] = (log_exposure[c].array() - largest).exp();
  return {Eigen::VectorXd::LinSpaced(kResponseLevels, 0, full_scale_counts), exposure};
}

Eigen::VectorXd Monotone(const Eigen::VectorXd& values, double least_step) {
  struct Block {
    double sum;
    Eigen::Index size;
    double mean() const { return sum / static_cast<double>(size); }
  };
  std::vector<Block> blocks;
  blocks.reserve(static_cast<size_t>(values.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    blocks.push_back({values[i], 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() >= blocks.back().mean()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum;
      blocks.back().size += last.size;
    }
  }
  Eigen::VectorXd monotone(values.size());
  Eigen::Index at = 0;
  for (const Block& block : blocks) {
    for (Eigen::Index i = 0; i < block.size; ++i) monotone[at++] = block.mean();
  }
  for (Eigen::Index i = 1; i < monotone.size(); ++i)
    monotone[i] = std::max(monotone[i], monotone[i - 1] + least_step);
  return monotone;
}

}  // namespace luxfit
