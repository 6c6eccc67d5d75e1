#include "inverse/observe/internal/label_posterior.h"

#include <gtest/gtest.h>

#include <cmath>

namespace luxfit {
namespace {

// Returns ln N(d; 0, sigma^2) but for a constant, of the differences of `values`.
Eigen::MatrixXd LogDensities(const Eigen::VectorXd& values, double sigma) {
  Eigen::MatrixXd log(values.size(), values.size());
  for (Eigen::Index a = 0; a < values.size(); ++a)
    for (Eigen::Index b = 0; b < values.size(); ++b)
      log(a, b) = -0.5 * std::pow((values[a] - values[b]) / sigma, 2) - std::log(sigma);
  return log;
}

LabelPosterior PosteriorOf(const Eigen::VectorXd& values, double prior) {
  return luxfit::PosteriorOf(LogDensities(values, 0.014), LogDensities(values, 0.5),
                             Eigen::VectorXd::Constant(values.size(), prior));
}

TEST(LabelPosterior, AViewAloneIsItsPrior) {
  EXPECT_NEAR(PosteriorOf(Eigen::VectorXd::Zero(1), 0.8).own[0], 0.8, 1e-12);  // double rounding
}

TEST(LabelPosterior, TheOneThatDiffersFromAgreeingViewsIsSomethingElse) {
  const Eigen::Vector4d values(0, 0.3, 0.01, -0.01);
  const Eigen::VectorXd own = PosteriorOf(values, 0.9).own;
  EXPECT_LT(own[1], 1e-3);
  for (const Eigen::Index agreeing : {0, 2, 3}) EXPECT_GT(own[agreeing], 0.99);
}

// Nothing tells which of two is the element: neither is with more than one half, so neither counts.
TEST(LabelPosterior, OfTwoThatDifferNeitherIsTheElement) {
  const LabelPosterior posterior = PosteriorOf(Eigen::Vector2d(0, 0.3), 0.9);
  EXPECT_NEAR(posterior.own[0], posterior.own[1], 1e-12);
  EXPECT_LT(posterior.own[0], 0.5);
  EXPECT_GT(posterior.own[0], 0.4);
  EXPECT_NEAR(posterior.other(0, 1), posterior.own[0], 1e-6);  // if one is, the other is not
}

TEST(LabelPosterior, NeighboursDecideBetweenTwo) {
  const Eigen::VectorXd values = Eigen::Vector2d(0, 0.3), prior = Eigen::Vector2d(0.99, 0.05);
  const Eigen::VectorXd own =
      luxfit::PosteriorOf(LogDensities(values, 0.014), LogDensities(values, 0.5), prior).own;
  EXPECT_GT(own[0], 0.9);
  EXPECT_LT(own[1], 0.1);
}

}  // namespace
}  // namespace luxfit
