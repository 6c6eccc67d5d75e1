// Sums the gradient and the information of the rows of each cluster.
//
//   g_c = J_c^T r_c,   A_c = J_c^T J_c
//
// A row may be a sum over rows of many clusters, such as a mean. Its residual then is spread over them: each gets the
// part of the residual that is its own, with the whole derivative, and a share of the row's information.
//
// Clusters without information, whose rows all have the weight 0, are left out: nothing can be drawn from them.
// The order of the others is that of their numbers.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_CLUSTER_SUMS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_CLUSTER_SUMS_H_

#include <Eigen/Core>
#include <vector>

namespace luxfit {

// Holds the parts of one row's residual, by cluster. Its shares sum to 1.
struct SpreadRow {
  struct Part {
    int cluster = 0;
    double residual = 0, share = 0;
  };
  Eigen::Index row = 0;
  std::vector<Part> parts;
};

struct ClusteredRows {
  Eigen::MatrixXd jacobian;  // rows x parameters
  Eigen::VectorXd residual;
  std::vector<int> cluster;         // one for each row, from 0; -1: stands alone; empty: all stand alone
  std::vector<SpreadRow> spread{};  // rows that are no cluster's, but many clusters'
};

struct ClusterSums {
  Eigen::MatrixXd gradient;     // parameters x clusters
  Eigen::MatrixXd information;  // parameters^2 x clusters: the columns of A_c, one below the other

  Eigen::Index count() const { return gradient.cols(); }
  Eigen::Map<const Eigen::MatrixXd> InformationOf(Eigen::Index cluster) const {
    return {information.col(cluster).data(), gradient.rows(), gradient.rows()};
  }
};

ClusterSums SumClusters(const ClusteredRows& rows);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_CLUSTER_SUMS_H_
