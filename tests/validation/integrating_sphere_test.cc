// The inside of a sphere made of triangles: what a closed cavity must keep, whatever its shape.
//
// Rows of form factors add up to 1, A_i F_ij = A_j F_ji, and the area mean of the indirect illuminance is
// rho Phi / (A (1 - rho)). Every two points of a sphere see one another with F_dA,j = A_j / A. Source:
// Ulbricht (1900), the integrating sphere; Walsh (1958), "Photometry", ch. 9.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "forward/light/illuminance.h"
#include "forward/light/room.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

// An octahedron cut in four `cuts` times, its corners moved out to the unit sphere; seen from inside.
Scene Sphere(int cuts) {
  std::vector<Triangle> triangles;
  for (const double x : {-1, 1}) {
    for (const double y : {-1, 1}) {
      for (const double z : {-1, 1}) triangles.push_back({{{x, 0, 0}, {0, y, 0}, {0, 0, z}}});
    }
  }
  for (int i = 0; i < cuts; ++i) {
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const Eigen::Vector3d ab = (a + b).normalized(), bc = (b + c).normalized(), ca = (c + a).normalized();
      for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(t);
    }
    triangles = finer;
  }
  Scene scene;
  for (auto [a, b, c] : triangles) {
    if ((b - a).cross(c - a).dot(a) > 0) std::swap(b, c);
    support::AddTriangle(scene, a, b - a, c - a, "wall");
  }
  return scene;
}

class IntegratingSphere : public testing::Test {
 protected:
  IntegratingSphere() : room_(MakeRoom(Sphere(2))) {}

  const Eigen::VectorXf& areas() const { return room_.transport.patch_area_m2; }

  Room room_;
};

TEST_F(IntegratingSphere, RowsAddUpToOne) {
  ASSERT_EQ(room_.form_factors.method, FormFactorMethod::kHybrid);
  ASSERT_EQ(room_.scene.facets.size(), 128u);
  const Eigen::VectorXf sums = room_.form_factors.element_to_patch.rowwise().sum();
  EXPECT_LT((sums.array() - 1).abs().maxCoeff(), 1e-5);  // float rounding over some hundred patches
  EXPECT_EQ(room_.form_factors.escaped_fraction, 0);
  EXPECT_EQ(room_.form_factors.back_fraction, 0);
  // Before rows were made to add up: in a convex room nothing stands between, so pairs are closed forms and
  // quadrature, kept to some tenths of a percent.
  EXPECT_LT(room_.form_factors.closure_error, 0.003);
}

TEST_F(IntegratingSphere, PairsAreReciprocal) {
  EXPECT_LT(ReciprocityError(room_.patches, room_.form_factors), 0.01);
}

TEST_F(IntegratingSphere, InterreflectionMultipliesByRhoOverOneMinusRho) {
  Luminaire luminaire;
  luminaire.position = {0.3, -0.2, 0.1};
  luminaire.distribution = Distribution::kIsotropic;
  std::vector<int> elements(room_.patches.elements.size());
  for (size_t e = 0; e < elements.size(); ++e) elements[e] = static_cast<int>(e);
  const Receivers receivers = MakeReceivers(room_, elements, {});
  const LuminaireVisibility visibility = ComputeVisibility(room_, receivers, {luminaire});
  for (const double rho : {0.2, 0.5, 0.8, 0.95}) {
    const Illuminance light =
        ComputeIlluminance(room_, receivers, visibility, {luminaire}, Eigen::VectorXd::Constant(1, rho));
    double direct_lm = 0, indirect_lm = 0, area_m2 = 0;
    for (size_t e = 0; e < elements.size(); ++e) {
      const double element_m2 = room_.patches.elements[e].area_m2;
      const Eigen::Index row = static_cast<Eigen::Index>(e);
      area_m2 += element_m2;
      direct_lm += element_m2 * light.direct(row, 0);
      indirect_lm += element_m2 * (light.total(row, 0) - light.direct(row, 0));
    }
    EXPECT_NEAR(area_m2, areas().sum(), 1e-3);
    // Midpoint rule, elements of 0.1 m from 0.6 m on: (h / d)^2 / 24 = 0.1 %, times a curvature of a few.
    EXPECT_NEAR(direct_lm, 1, 0.003);
    // The same error, and that of the form factors' reciprocity, which the mean feels to second order only.
    EXPECT_NEAR(indirect_lm / (rho / (1 - rho)), 1, 0.004) << "rho " << rho;
  }
}

}  // namespace
}  // namespace luxfit
