#include "forward/room/internal/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

TEST(GaussLegendre, IsExactToItsDegree) {
  for (int n = 1; n <= 12; ++n) {
    double sum = 0;
    for (const LineNode& node : GaussLegendre(n)) sum += node.weight * std::pow(node.t, 2 * n - 1);
    EXPECT_NEAR(sum, 1.0 / (2 * n), 1e-13) << n;
  }
}

TEST(FacetRule, IsExactToItsDegree) {
  for (int n = 1; n <= 6; ++n) {
    const int degree = 2 * n - 1, p = degree / 2, q = degree - p;
    double triangle = 0, parallelogram = 0;
    for (const FacetNode& node : FacetRule(FacetKind::kTriangle, n))
      triangle += node.weight * std::pow(node.u, p) * std::pow(node.v, q);
    for (const FacetNode& node : FacetRule(FacetKind::kParallelogram, n))
      parallelogram += node.weight * std::pow(node.u, degree) * std::pow(node.v, degree);
    // Mean of u^p v^q over the unit triangle: 2 p! q! / (p + q + 2)!
    const double expected = 2 * std::tgamma(p + 1) * std::tgamma(q + 1) / std::tgamma(p + q + 3);
    EXPECT_NEAR(triangle, expected, 1e-13) << n;
    EXPECT_NEAR(parallelogram, 1.0 / (4 * n * n), 1e-13) << n;
  }
}

TEST(FacetRule, NeedsANode) { EXPECT_THROW(FacetRule(FacetKind::kTriangle, 0), std::invalid_argument); }

}  // namespace
}  // namespace luxfit
