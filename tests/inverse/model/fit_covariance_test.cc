#include "inverse/model/internal/intervals/fit_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "inverse/model/internal/intervals/cluster_bootstrap.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// A line through `clusters` groups of 20 points; errors have a part common to each group.
struct FittedLine {
  Eigen::MatrixXd jacobian;
  std::vector<int> cluster;
};
FittedLine MakeLine(int clusters) {
  FittedLine line;
  constexpr int kEach = 20;
  line.jacobian.resize(clusters * kEach, 2);
  for (int i = 0; i < clusters * kEach; ++i) {
    const int c = i / kEach;
    line.jacobian.row(i) << 1, c + 0.01 * (i % kEach);
    line.cluster.push_back(c);
  }
  return line;
}

WeightedRows RowsOf(const FittedLine& line, const Eigen::VectorXd& error) {
  WeightedRows rows;
  rows.jacobian = line.jacobian;
  const Eigen::VectorXd x = line.jacobian.colPivHouseholderQr().solve(error);
  rows.residual = line.jacobian * x - error;
  rows.cluster = line.cluster;
  rows.prior_information = Eigen::Matrix2d::Zero();
  return rows;
}

// The jackknife by its definition: fits without each cluster in turn. Noise below the clusters' spread, so
// that the plain covariance is no floor.
TEST(FitCovarianceTest, IsTheJackknifeOverClusters) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  constexpr int kClusters = 30;
  const FittedLine line = MakeLine(kClusters);
  Eigen::VectorXd error(line.jacobian.rows());
  std::vector<double> common(kClusters);
  for (double& c : common) c = 20 * normal(rng);
  for (Eigen::Index i = 0; i < error.size(); ++i)
    error[i] = common[static_cast<size_t>(line.cluster[static_cast<size_t>(i)])] + normal(rng);
  const Eigen::VectorXd whole = line.jacobian.colPivHouseholderQr().solve(error);
  Eigen::Matrix2d jackknife = Eigen::Matrix2d::Zero();
  for (int c = 0; c < kClusters; ++c) {
    std::vector<int> kept;
    for (size_t i = 0; i < line.cluster.size(); ++i) {
      if (line.cluster[i] != c) kept.push_back(static_cast<int>(i));
    }
    const Eigen::MatrixXd jacobian = line.jacobian(kept, Eigen::all);
    const Eigen::Vector2d move = jacobian.colPivHouseholderQr().solve(Eigen::VectorXd(error(kept))) - whole;
    jackknife += move * move.transpose();
  }
  const FitCovariance found = CovarianceOf(RowsOf(line, error));
  EXPECT_TRUE(found.null_directions.empty());
  const double least = StudentFactor(found.degrees_of_freedom.maxCoeff()),
               most = StudentFactor(found.degrees_of_freedom.minCoeff());
  EXPECT_LT(most, 1.1);  // of 30 clusters
  EXPECT_LT(found.degrees_of_freedom.maxCoeff(), kClusters);
  for (int i = 0; i < 2; ++i) {
    EXPECT_GT(found.covariance(i, i),
              0.97 * least * least * jackknife(i, i));  // axes, not parameters, are enlarged
    EXPECT_LT(found.covariance(i, i), 1.03 * most * most * jackknife(i, i));
  }
}

// 95 % intervals over many draws, with as few clusters as a small room has. Binomial sigma of 1000 draws at
// 95 %: 0.7 %; what was asked for is 90 to 98 %.
TEST(FitCovarianceTest, IntervalsHoldTheTruthWithFewClusters) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  for (const int clusters : {6, 12, 40}) {
    const FittedLine line = MakeLine(clusters);
    constexpr int kDraws = 1000;
    Eigen::Array2i held = Eigen::Array2i::Zero();
    for (int draw = 0; draw < kDraws; ++draw) {
      std::vector<double> common(static_cast<size_t>(clusters));
      for (double& c : common) c = 5 * normal(rng);
      Eigen::VectorXd error(line.jacobian.rows());
      for (Eigen::Index i = 0; i < error.size(); ++i)
        error[i] = common[static_cast<size_t>(line.cluster[static_cast<size_t>(i)])] + normal(rng);
      const Eigen::VectorXd x = line.jacobian.colPivHouseholderQr().solve(error);
      const FitCovariance found = CovarianceOf(RowsOf(line, error));
      for (int i = 0; i < 2; ++i)
        held[i] += std::abs(x[i]) < 1.96 * std::sqrt(found.covariance(i, i)) ? 1 : 0;
    }
    for (int i = 0; i < 2; ++i) {
      const double share = static_cast<double>(held[i]) / kDraws;
      std::printf("%d clusters, parameter %d: %.3f of the intervals hold the truth\n", clusters, i, share);
      EXPECT_GT(share, 0.90);
      EXPECT_LT(share, 0.985);
    }
  }
}

// Six parameters and two clusters: their scatter alone has rank two. C - H^-1 has no negative eigenvalue.
TEST(FitCovarianceTest, FewerClustersThanParametersLeaveNoDirectionWithoutVariance) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  constexpr int kRows = 40, kParameters = 6;
  WeightedRows rows;
  rows.jacobian = Eigen::MatrixXd::NullaryExpr(kRows, kParameters, [&] { return normal(rng); });
  const Eigen::VectorXd error = Eigen::VectorXd::NullaryExpr(kRows, [&] { return 5 * normal(rng); });
  rows.residual = rows.jacobian * rows.jacobian.colPivHouseholderQr().solve(error) - error;
  for (int i = 0; i < kRows; ++i) rows.cluster.push_back(i / 20);
  rows.prior_information = Eigen::MatrixXd::Zero(kParameters, kParameters);
  const Eigen::MatrixXd plain = (rows.jacobian.transpose() * rows.jacobian).inverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(CovarianceOf(rows).covariance - plain);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-9 * eigen.eigenvalues().maxCoeff());
  EXPECT_GT(eigen.eigenvalues().maxCoeff(), plain.trace());  // clusters do say something
}

// One parameter and clusters of unequal information, so that draws differ in it. With one axis the variance is the
// largest of the plain one, the jackknife's and the bootstrap's.
TEST(FitCovarianceTest, TheLargerOfJackknifeAndBootstrapCounts) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  constexpr int kClusters = 40, kDraws = 30;
  int of_jackknife = 0, of_bootstrap = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    WeightedRows rows;
    rows.jacobian.resize(kClusters, 1);
    Eigen::VectorXd error(kClusters);
    for (int i = 0; i < kClusters; ++i) {
      rows.jacobian(i, 0) = std::exp(0.5 * normal(rng));
      error[i] = 2 * normal(rng);
      rows.cluster.push_back(i);
    }
    rows.prior_information = Eigen::MatrixXd::Zero(1, 1);
    const Eigen::VectorXd slope = rows.jacobian.col(0);
    const double information = slope.squaredNorm(), x = slope.dot(error) / information;
    rows.residual = x * slope - error;
    const FitCovariance found = CovarianceOf(rows);
    double jackknife = 0;
    for (int i = 0; i < kClusters; ++i) {
      const double left = information - slope[i] * slope[i];
      jackknife += std::pow((slope.dot(error) - slope[i] * error[i]) / left - x, 2);
    }
    jackknife *= std::pow(StudentFactor(found.degrees_of_freedom[0]), 2);
    const ClusteredRows whitened{slope / std::sqrt(information), rows.residual, rows.cluster};
    const double bootstrap = BootstrapVariance(whitened, Eigen::MatrixXd::Zero(1, 1))[0] / information;
    EXPECT_GT(bootstrap, 0);
    EXPECT_NEAR(found.covariance(0, 0) / std::max({1 / information, jackknife, bootstrap}), 1, 1e-9);
    (bootstrap > jackknife ? of_bootstrap : of_jackknife) += 1;
  }
  std::printf("jackknife larger in %d, bootstrap in %d\n", of_jackknife, of_bootstrap);
  EXPECT_GT(of_jackknife, 0);
  EXPECT_GT(of_bootstrap, 0);
}

TEST(FitCovarianceTest, AKnownBiasIsContained) {
  const FittedLine line = MakeLine(6);
  WeightedRows rows = RowsOf(line, Eigen::VectorXd::Zero(line.jacobian.rows()));
  const Eigen::MatrixXd without = CovarianceOf(rows).covariance;
  rows.biases = line.jacobian * Eigen::Vector2d(3, -4);  // moves the parameters by (3, -4)
  const Eigen::MatrixXd difference = CovarianceOf(rows).covariance - without;
  EXPECT_NEAR(difference(0, 0), 9, 1e-9);
  EXPECT_NEAR(difference(0, 1), -12, 1e-9);
  EXPECT_NEAR(difference(1, 1), 16, 1e-9);
}

// Errors of independent causes add as b1 b1^T + b2 b2^T; their sum as one error would have products of both.
TEST(FitCovarianceTest, BiasesOfTwoCausesAddUp) {
  const FittedLine line = MakeLine(6);
  WeightedRows rows = RowsOf(line, Eigen::VectorXd::Zero(line.jacobian.rows()));
  const Eigen::MatrixXd without = CovarianceOf(rows).covariance;
  Eigen::Matrix2d moves;
  moves << 3, 2, -4, 1;  // one column for each cause
  rows.biases = line.jacobian * moves;
  const Eigen::MatrixXd difference = CovarianceOf(rows).covariance - without;
  EXPECT_NEAR(difference(0, 0), 9 + 4, 1e-9);
  EXPECT_NEAR(difference(0, 1), -12 + 2, 1e-9);
  EXPECT_NEAR(difference(1, 1), 16 + 1, 1e-9);
}

TEST(FitCovarianceTest, WhatNothingDeterminesIsNamed) {
  FittedLine line = MakeLine(6);
  line.jacobian.col(1) = 2 * line.jacobian.col(0);
  WeightedRows rows;
  rows.jacobian = line.jacobian;
  rows.residual = Eigen::VectorXd::Zero(line.jacobian.rows());
  rows.cluster = line.cluster;
  rows.prior_information = Eigen::Matrix2d::Zero();
  const FitCovariance found = CovarianceOf(rows);
  ASSERT_EQ(found.null_directions.size(), 1u);
  EXPECT_TRUE(found.covariance.allFinite());
}

TEST(FitCovarianceTest, PriorsAloneGiveTheirOwnSigma) {
  WeightedRows rows;
  rows.jacobian = Eigen::MatrixXd::Zero(1, 2);
  rows.residual = Eigen::VectorXd::Zero(1);
  rows.cluster = {0};
  rows.prior_information = Eigen::Vector2d(4, 25).asDiagonal();
  const FitCovariance found = CovarianceOf(rows);
  EXPECT_NEAR(found.covariance(0, 0), 0.25, 1e-12);
  EXPECT_NEAR(found.covariance(1, 1), 0.04, 1e-12);
  EXPECT_TRUE(std::isinf(found.degrees_of_freedom[0]));
}

// Tables of Student's t: 97.5 % quantiles 3.182, 2.571, 2.228, 2.042 at 3, 5, 10, 30.
TEST(FitCovarianceTest, StudentFactorIsThatOfTheTables) {
  EXPECT_NEAR(1.96 * StudentFactor(3), 3.182, 0.002 * 3.182);
  EXPECT_NEAR(1.96 * StudentFactor(5), 2.571, 0.003);
  EXPECT_NEAR(1.96 * StudentFactor(10), 2.228, 0.001);
  EXPECT_NEAR(1.96 * StudentFactor(30), 2.042, 0.001);
  EXPECT_EQ(StudentFactor(1), StudentFactor(3));
}

// Residuals of unit variance in clusters of `each` rows with one Jacobian row; `rho` is their intra-class correlation.
WeightedRows CorrelatedRows(int clusters, int each, double rho, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  FittedLine line;
  line.jacobian.resize(clusters * each, 2);
  Eigen::VectorXd error(line.jacobian.rows());
  for (int c = 0; c < clusters; ++c) {
    const double common = normal(rng);
    for (int i = c * each; i < (c + 1) * each; ++i) {
      line.jacobian.row(i) << 1, c;
      line.cluster.push_back(c);
      error[i] = std::sqrt(rho) * common + std::sqrt(1 - rho) * normal(rng);
    }
  }
  return RowsOf(line, error);
}

double MeanDesignEffect(double rho, std::mt19937_64& rng) {
  constexpr int kClusters = 200, kEach = 20, kDraws = 50;
  double sum = 0;
  for (int draw = 0; draw < kDraws; ++draw) sum += DesignEffect(CorrelatedRows(kClusters, kEach, rho, rng));
  return sum / kDraws;
}

// The estimate of one draw scatters by 10 %. Values below 1 count as 1, so the mean is 1.06.
TEST(DesignEffectTest, IndependentResidualsHaveNone) {
  std::mt19937_64 rng = support::TestRng();
  const double mean = MeanDesignEffect(0, rng);
  std::printf("mean design effect of independent rows %.3f\n", mean);
  EXPECT_GE(mean, 1);
  EXPECT_LT(mean, 1.1);
}

// Kish: 1 + (n - 1) rho for clusters of n rows. The mean of 50 draws has a sigma of 1.6 %, and the jackknife over
// 200 clusters is 1 % too large.
TEST(DesignEffectTest, ACommonErrorCountsAsKishsFormulaSays) {
  std::mt19937_64 rng = support::TestRng();
  for (const double rho : {0.1, 0.3}) {
    const double mean = MeanDesignEffect(rho, rng), kish = 1 + 19 * rho;
    std::printf("rho %.1f: mean design effect %.3f, by Kish %.3f\n", rho, mean, kish);
    EXPECT_NEAR(mean / kish, 1, 0.05);
  }
}

// A row alone with a wild residual takes a tenth of the information: the clusters' ratio stays. Where it gives
// nearly all, nothing is known of the clusters.
TEST(DesignEffectTest, RowsThatStandAloneDoNotCount) {
  std::mt19937_64 rng = support::TestRng();
  WeightedRows rows = CorrelatedRows(200, 20, 0.3, rng);
  rows.jacobian = Eigen::MatrixXd(rows.jacobian.leftCols(1));
  rows.prior_information = Eigen::MatrixXd::Zero(1, 1);
  const double of_clusters = DesignEffect(rows);
  EXPECT_GT(of_clusters, 4);
  const Eigen::Index last = rows.jacobian.rows();
  rows.jacobian.conservativeResize(last + 1, 1);
  rows.residual.conservativeResize(last + 1);
  rows.residual[last] = 1e3;
  rows.cluster.push_back(-1);
  rows.jacobian(last, 0) = std::sqrt(0.1 * static_cast<double>(last));
  EXPECT_NEAR(DesignEffect(rows) / of_clusters, 1, 0.01);  // the leverage of one cluster in 200 is 0.5 %
  rows.jacobian(last, 0) = std::sqrt(100 * static_cast<double>(last));
  EXPECT_EQ(DesignEffect(rows), 1);
}

Eigen::MatrixXd RandomRows(int count, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(count, 3, [&] { return normal(rng); });
}

// Tolerances are rounding, 1e-16 times a condition number of some tens. Units of parameters may differ by much more
// than determined and undetermined directions do.
TEST(InverseOfTest, IsTheInverseInAnyUnits) {
  std::mt19937_64 rng = support::TestRng();
  const Eigen::MatrixXd rows = RandomRows(12, rng), hessian = rows.transpose() * rows;
  EXPECT_LT((hessian * InverseOf(hessian) - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  const Eigen::MatrixXd unit = Eigen::Vector3d(1e6, 1, 1e-6).asDiagonal();
  const Eigen::MatrixXd found = unit * InverseOf(unit * hessian * unit) * unit;
  EXPECT_LT((hessian * found - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(InverseOfTest, IsZeroAlongNullDirections) {
  std::mt19937_64 rng = support::TestRng();
  Eigen::MatrixXd rows = RandomRows(12, rng);
  rows.col(2) = rows.col(0);  // only the sum of these parameters is seen
  const Eigen::MatrixXd hessian = rows.transpose() * rows, inverse = InverseOf(hessian);
  EXPECT_LT((inverse * Eigen::Vector3d(1, 0, -1)).norm(), 1e-12 * inverse.norm());
  EXPECT_LT((hessian * inverse * hessian - hessian).norm(), 1e-12 * hessian.norm());
}

// The mean of elements on 40 facets, each facet with an error that its elements share. The row of the mean takes its
// own scatter, 1, for granted; its facets' parts show 9.
TEST(FitCovariance, AMeanOverClustersHasTheirScatter) {
  constexpr int kClusters = 40;
  constexpr double kDerivative = 10, kPart = 3;
  WeightedRows rows;
  rows.jacobian.setConstant(kClusters + 1, 1, 1e-3);
  rows.jacobian(kClusters, 0) = kDerivative;
  rows.residual = Eigen::VectorXd::Zero(kClusters + 1);
  rows.prior_information = Eigen::MatrixXd::Zero(1, 1);
  SpreadRow mean{kClusters, {}};
  for (int c = 0; c < kClusters; ++c) {
    rows.cluster.push_back(c);
    mean.parts.push_back({c, (c % 2 == 0 ? kPart : -kPart) / std::sqrt(kClusters), 1.0 / kClusters});
  }
  rows.cluster.push_back(-1);
  rows.coarse_cluster = rows.cluster;
  const double alone = CovarianceOf(rows).covariance(0, 0) * kDerivative * kDerivative;
  EXPECT_NEAR(alone, 1, 0.3);  // the bootstrap's 199 draws may raise it
  rows.spread = rows.coarse_spread = {mean};
  const double scatter = CovarianceOf(rows).covariance(0, 0) * kDerivative * kDerivative;
  EXPECT_GT(scatter, kPart * kPart);  // few clusters enlarge it
  EXPECT_LT(scatter, 1.3 * kPart * kPart);
}

}  // namespace
}  // namespace luxfit
