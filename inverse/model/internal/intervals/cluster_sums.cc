#include "inverse/model/internal/intervals/cluster_sums.h"

#include <algorithm>
#include <utility>

namespace luxfit {
namespace {

// Returns the numbers of each cluster's rows.
std::vector<std::vector<Eigen::Index>> RowsByCluster(const std::vector<int>& cluster) {
  const int count = cluster.empty() ? 0 : *std::max_element(cluster.begin(), cluster.end()) + 1;
  std::vector<std::vector<Eigen::Index>> members(static_cast<size_t>(count));
  for (size_t i = 0; i < cluster.size(); ++i) {
    if (cluster[i] >= 0) members[static_cast<size_t>(cluster[i])].push_back(static_cast<Eigen::Index>(i));
  }
  return members;
}

void AddSpread(const ClusteredRows& rows, const std::vector<std::pair<size_t, SpreadRow::Part>>& parts,
               Eigen::Ref<Eigen::VectorXd> gradient, Eigen::Ref<Eigen::MatrixXd> information) {
  for (const auto& [number, part] : parts) {
    const Eigen::VectorXd derivative = rows.jacobian.row(rows.spread[number].row);
    gradient += part.residual * derivative;
    information += part.share * derivative * derivative.transpose();
  }
}

// Returns, by cluster, the number of each spread row that has a part in it, and that part.
std::vector<std::vector<std::pair<size_t, SpreadRow::Part>>> PartsByCluster(
    const std::vector<SpreadRow>& spread, size_t clusters) {
  std::vector<std::vector<std::pair<size_t, SpreadRow::Part>>> parts(clusters);
  for (size_t i = 0; i < spread.size(); ++i) {
    for (const SpreadRow::Part& part : spread[i].parts)
      parts[static_cast<size_t>(part.cluster)].emplace_back(i, part);
  }
  return parts;
}

}  // namespace

ClusterSums SumClusters(const ClusteredRows& rows) {
  const Eigen::Index n = rows.jacobian.cols();
  const std::vector<std::vector<Eigen::Index>> members = RowsByCluster(rows.cluster);
  const auto most = static_cast<Eigen::Index>(members.size());
  ClusterSums sums{Eigen::MatrixXd(n, most), Eigen::MatrixXd(n * n, most)};
  const auto parts = PartsByCluster(rows.spread, members.size());
  Eigen::Index count = 0;
  for (size_t c = 0; c < members.size(); ++c) {
    const Eigen::MatrixXd jacobian = rows.jacobian(members[c], Eigen::all);
    if (jacobian.isZero(0)) continue;
    sums.gradient.col(count) = jacobian.transpose() * rows.residual(members[c]);
    Eigen::Map<Eigen::MatrixXd> information(sums.information.col(count).data(), n, n);
    information.setZero();
    information.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
    information.triangularView<Eigen::StrictlyUpper>() = information.transpose();
    AddSpread(rows, parts[c], sums.gradient.col(count), information);
    ++count;
  }
  sums.gradient.conservativeResize(Eigen::NoChange, count);
  sums.information.conservativeResize(Eigen::NoChange, count);
  return sums;
}

}  // namespace luxfit
