#include "inverse/observe/internal/photo_offsets.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr size_t kFewestElements = 30;
constexpr int kRounds = 10;
constexpr double kStill = 1e-4;

// Returns the deviations of a state's photos from the elements' medians, by view.
std::vector<std::vector<double>> Deviations(const ViewTable& table, int state, const Eigen::ArrayXd& offset) {
  std::vector<std::vector<double>> deviations(static_cast<size_t>(offset.size()));
  std::vector<double> values;
  for (int e = 0; e < table.elements(); ++e) {
    const int first = table.first[static_cast<size_t>(e)], end = table.first[static_cast<size_t>(e) + 1];
    values.clear();
    for (int c = first; c < end; ++c) {
      const double y = table.log_luminance(state, c);
      if (std::isfinite(y)) values.push_back(y - offset[table.view[static_cast<size_t>(c)]]);
    }
    if (values.size() < 2) continue;
    const double median = Median(values);
    for (int c = first; c < end; ++c) {
      const double y = table.log_luminance(state, c);
      if (std::isfinite(y))
        deviations[static_cast<size_t>(table.view[static_cast<size_t>(c)])].push_back(y - median);
    }
  }
  return deviations;
}

}  // namespace

Eigen::ArrayXXd PhotoOffsets(const ViewTable& table) {
  const int views = table.view.empty() ? 0 : *std::max_element(table.view.begin(), table.view.end()) + 1;
  Eigen::ArrayXXd offsets = Eigen::ArrayXXd::Zero(table.log_luminance.rows(), views);
  for (Eigen::Index s = 0; s < offsets.rows(); ++s) {
    Eigen::ArrayXd offset = Eigen::ArrayXd::Zero(views);
    for (int round = 0; round < kRounds; ++round) {
      const auto deviations = Deviations(table, static_cast<int>(s), offset);
      Eigen::ArrayXd next = Eigen::ArrayXd::Zero(views);
      Eigen::ArrayXd is_known = next;
      for (int v = 0; v < views; ++v) {
        if (deviations[static_cast<size_t>(v)].size() < kFewestElements) continue;
        next[v] = Median(deviations[static_cast<size_t>(v)]);
        is_known[v] = 1;
      }
      next -= is_known * (next.sum() / std::max(1.0, is_known.sum()));
      const double moved = (next - offset).abs().maxCoeff();
      offset = next;
      if (moved < kStill) break;
    }
    offsets.row(s) = offset.transpose();
  }
  return offsets;
}

}  // namespace luxfit
