#include "inverse/observe/as_if/internal/superposed_columns.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "calib/luminance/median.h"
#include "inverse/observe/internal/photo_offsets.h"
#include "inverse/observe/internal/view_table.h"

namespace luxfit {
namespace {

constexpr size_t kFewestScattered = 6;  // photos whose offsets tell the exposures' error
constexpr double kUnknownExposure = 0.05;

// Returns the relative error of exposures: how much offsets of one view scatter from state to state.
double ExposureError(const ViewTable& table) {
  const Eigen::ArrayXXd offset = PhotoOffsets(table);
  std::vector<double> scatter;
  for (Eigen::Index v = 0; v < offset.cols() && offset.cols() >= 3; ++v) {
    const auto of_view = offset.col(v);
    const auto known = (of_view != 0).count();
    if (known < 2) continue;
    const double mean = of_view.sum() / static_cast<double>(known);
    for (const double g : of_view)
      if (g != 0) scatter.push_back(std::abs(g - mean));
  }
  if (scatter.size() < kFewestScattered) return kUnknownExposure;
  return std::max(kLeastBetweenViews, kSigmaPerMad * Median(std::move(scatter)));
}

std::vector<int> PhotographedStates(const ViewTable& table) {
  std::vector<int> states;
  for (Eigen::Index s = 0; s < table.log_luminance.rows(); ++s)
    if (table.log_luminance.row(s).isFinite().any()) states.push_back(static_cast<int>(s));
  return states;
}

}  // namespace

SuperposedColumns ColumnsOf(const Patches& patches, const std::vector<Observation>& observations) {
  const ViewTable table = TableOfViews(observations);
  SuperposedColumns columns;
  columns.states = PhotographedStates(table);
  const double error = ExposureError(table);
  const auto rows = static_cast<Eigen::Index>(columns.states.size());
  columns.luminance.resize(rows, table.columns());
  columns.sigma.resize(rows, table.columns());
  Eigen::Index kept = 0;
  for (int c = 0; c < table.columns(); ++c) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto s = static_cast<Eigen::Index>(columns.states[static_cast<size_t>(i)]);
      const double y = std::exp(table.log_luminance(s, c));
      columns.luminance(i, kept) = y;
      columns.sigma(i, kept) = y * std::sqrt(table.variance(s, c) + error * error);
    }
    if (!columns.luminance.col(kept).allFinite()) continue;
    columns.patch.push_back(
        patches.elements[static_cast<size_t>(table.element[static_cast<size_t>(c)])].patch);
    ++kept;
  }
  columns.luminance.conservativeResize(rows, kept);
  columns.sigma.conservativeResize(rows, kept);
  return columns;
}

int RankOf(const Eigen::MatrixXd& dimming) {
  return static_cast<int>(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(dimming).rank());
}

SuperpositionScore ScoreOf(const SuperposedColumns& columns, const Eigen::MatrixXd& dimming) {
  const auto freedom = static_cast<double>(dimming.rows() - RankOf(dimming));
  SuperpositionScore score;
  double squares = 0;
  for (Eigen::Index c = 0; c < columns.luminance.cols(); ++c) {
    const Eigen::ArrayXd y = columns.luminance.col(c), sigma = columns.sigma.col(c);
    const Eigen::MatrixXd weighed = sigma.inverse().matrix().asDiagonal() * dimming;
    const Eigen::VectorXd right = y / sigma;
    const Eigen::ArrayXd residual = right - weighed * weighed.colPivHouseholderQr().solve(right);
    score.scores[columns.patch[static_cast<size_t>(c)]].Add(std::sqrt(residual.square().sum() / freedom));
    squares += (residual * sigma / y).square().mean();
  }
  score.relative_difference = std::sqrt(squares / static_cast<double>(columns.luminance.cols()));
  return score;
}

Eigen::MatrixXd LightWithout(const SuperposedColumns& columns, const Eigen::MatrixXd& dimming,
                             Eigen::Index left_out) {
  Eigen::MatrixXd light(dimming.cols(), columns.luminance.cols());
  for (Eigen::Index c = 0; c < light.cols(); ++c) {
    Eigen::VectorXd weight = columns.sigma.col(c).cwiseInverse();
    weight[left_out] = 0;
    const Eigen::MatrixXd weighed = weight.asDiagonal() * dimming;
    light.col(c) = weighed.colPivHouseholderQr().solve(weight.cwiseProduct(columns.luminance.col(c)));
  }
  return light;
}

}  // namespace luxfit
