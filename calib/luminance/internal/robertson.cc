#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/luminance/internal/response_levels.h"
#include "calib/luminance/response.h"

namespace luxfit {
namespace {

constexpr int kMaxRobertsonIterations = 200;
constexpr double kTolerance = 1e-4;  // relative change of f, root mean square

// Returns the paper's weight of a count: a Gaussian about half scale, shifted to 0 at both ends.
double Certainty(double counts, double full_scale_counts) {
  const double x = 2 * counts / full_scale_counts - 1;
  return (std::exp(-4 * x * x) - std::exp(-4.0)) / (1 - std::exp(-4.0));
}

// Holds one count that is in range.
struct Entry {
  LevelPosition at;
  double time, weight;
};

// Returns pixels with at least two such counts: one exposure alone fits any response.
std::vector<std::vector<Entry>> EntriesOf(const std::vector<BracketSamples>& brackets, size_t channel,
                                          const ResponseOptions& options) {
  std::vector<std::vector<Entry>> pixels;
  for (const BracketSamples& bracket : brackets) {
    const Eigen::MatrixXd& counts = bracket.counts[channel];
    for (Eigen::Index i = 0; i < counts.rows(); ++i) {
      std::vector<Entry> entries;
      entries.reserve(static_cast<size_t>(counts.cols()));
      for (Eigen::Index j = 0; j < counts.cols(); ++j) {
        if (!IsInRange(counts(i, j), options)) continue;
        entries.push_back({PositionOf(counts(i, j), options.full_scale_counts), bracket.exposure_s[j],
                           Certainty(counts(i, j), options.full_scale_counts)});
      }
      if (entries.size() > 1) pixels.push_back(std::move(entries));
    }
  }
  return pixels;
}

// Returns f at the knots that occur, interpolated between them and in proportion to the count beyond them.
Eigen::VectorXd Filled(const Eigen::VectorXd& sum, const Eigen::VectorXd& weight,
                       const Eigen::VectorXd& before) {
  Eigen::VectorXd curve = before;
  Eigen::Index last = -1;
  for (Eigen::Index k = 0; k < kResponseLevels; ++k) {
    if (!(weight[k] > 0)) continue;
    curve[k] = sum[k] / weight[k];
    if (last < 0) {
      for (Eigen::Index m = 0; m < k; ++m)
        curve[m] = curve[k] * (static_cast<double>(m) + 0.5) / (static_cast<double>(k) + 0.5);
    }
    for (Eigen::Index m = last + 1; last >= 0 && m < k; ++m) {
      const double share = static_cast<double>(m - last) / static_cast<double>(k - last);
      curve[m] = curve[last] + share * (curve[k] - curve[last]);
    }
    last = k;
  }
  for (Eigen::Index m = last + 1; last >= 0 && m < kResponseLevels; ++m)
    curve[m] = curve[last] * (static_cast<double>(m) + 0.5) / (static_cast<double>(last) + 0.5);
  return curve;
}

Eigen::VectorXd OneRound(const std::vector<std::vector<Entry>>& pixels, const Eigen::VectorXd& curve) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(kResponseLevels), weight = sum;
  for (const std::vector<Entry>& entries : pixels) {
    double top = 0, bottom = 0;
    for (const Entry& e : entries) {
      const double exposure = (1 - e.at.share) * curve[e.at.below] + e.at.share * curve[e.at.below + 1];
      top += e.weight * e.time * exposure;
      bottom += e.weight * e.time * e.time;
    }
    if (!(bottom > 0)) continue;
    for (const Entry& e : entries) {
      const double expected = e.time * top / bottom;
      // A count between knots informs both, moved along the present curve to the place of each.
      const double here = (1 - e.at.share) * curve[e.at.below] + e.at.share * curve[e.at.below + 1];
      for (Eigen::Index side = 0; side < 2; ++side) {
        const double share = side == 0 ? 1 - e.at.share : e.at.share;
        if (!(share > 0)) continue;
        sum[e.at.below + side] += share * expected * curve[e.at.below + side] / here;
        weight[e.at.below + side] += share;
      }
    }
  }
  return Filled(sum, weight, curve);
}

Eigen::VectorXd SolveChannel(const std::vector<std::vector<Entry>>& pixels) {
  // The iteration starts from a linear response, as in the paper.
  Eigen::VectorXd curve =
      (Eigen::VectorXd::LinSpaced(kResponseLevels, 0, kResponseLevels - 1).array() + 0.5) / kResponseLevels;
  for (int iteration = 0; iteration < kMaxRobertsonIterations; ++iteration) {
    Eigen::VectorXd next = OneRound(pixels, curve);
    next /= next[kResponseLevels / 2];
    const double change =
        ((next - curve / curve[kResponseLevels / 2]).array() / next.array()).matrix().norm() /
        std::sqrt(static_cast<double>(kResponseLevels));
    curve = next;
    if (change < kTolerance) break;
  }
  return curve;
}

}  // namespace

CameraResponse SolveRobertson(const std::vector<BracketSamples>& brackets, const ResponseOptions& options) {
  CheckSamples(brackets);
  std::array<Eigen::VectorXd, 3> curves;
  for (size_t c = 0; c < 3; ++c) {
    const Eigen::VectorXd curve = SolveChannel(EntriesOf(brackets, c, options));
    curves[c] = Monotone(curve.array().log(), kLeastLogStep);
  }
  return ResponseOf(std::move(curves), options.full_scale_counts);
}

}  // namespace luxfit
