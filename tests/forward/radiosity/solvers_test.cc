#include "forward/radiosity/solvers.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "forward/direct/direct_light.h"
#include "forward/light/room.h"
#include "forward/radiosity/internal/linear_transport.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr RadiositySolver kSolvers[] = {RadiositySolver::kLu,
                                        RadiositySolver::kCholesky,
                                        RadiositySolver::kJacobi,
                                        RadiositySolver::kGaussSeidel,
                                        RadiositySolver::kNeumann,
                                        RadiositySolver::kShooting,
                                        RadiositySolver::kConjugateGradient,
                                        RadiositySolver::kBicgstab};

// The series with so many reflections that what it leaves out, rho^200, is nothing beside float rounding.
RadiositySolverOptions With(RadiositySolver solver, double tolerance_percent = 0.1) {
  RadiositySolverOptions options;
  options.solver = solver;
  options.tolerance_percent = tolerance_percent;
  options.bounces = 200;
  return options;
}

double Uniform(std::mt19937_64& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

Eigen::MatrixXf RandomLight(std::mt19937_64& rng, Eigen::Index patches, Eigen::Index columns) {
  return Eigen::MatrixXf::NullaryExpr(patches, columns,
                                      [&] { return static_cast<float>(std::pow(Uniform(rng, 0, 10), 3)); });
}

// F and rho in double, from the coupling.
struct DoubleSystem {
  Eigen::MatrixXd form_factors;
  Eigen::VectorXd rho;
  DoubleSystem(const TransportGeometry& geometry, const Eigen::VectorXd& albedo) {
    const Eigen::VectorXd root = geometry.patch_area_m2.cast<double>().cwiseSqrt();
    form_factors = root.cwiseInverse().asDiagonal() * geometry.coupling.cast<double>() * root.asDiagonal();
    rho.resize(root.size());
    for (Eigen::Index i = 0; i < rho.size(); ++i)
      rho[i] = albedo[geometry.patch_material[static_cast<size_t>(i)]];
  }
  Eigen::MatrixXd Illuminance(const Eigen::MatrixXf& direct_lx, const Eigen::MatrixXf& exitance) const {
    return direct_lx.cast<double>() + form_factors * exitance.cast<double>();
  }
  Eigen::MatrixXd ExactIlluminance(const Eigen::MatrixXf& direct_lx) const {
    const Eigen::MatrixXd matrix =
        Eigen::MatrixXd::Identity(rho.size(), rho.size()) - form_factors * rho.asDiagonal();
    return matrix.partialPivLu().solve(direct_lx.cast<double>());
  }
};

// Greatest error at any patch, in percent of the area mean, of the worst column.
double ErrorPercent(const TransportGeometry& geometry, const Eigen::MatrixXd& lux,
                    const Eigen::MatrixXd& exact) {
  const Eigen::VectorXd area = geometry.patch_area_m2.cast<double>();
  double worst = 0;
  for (Eigen::Index c = 0; c < lux.cols(); ++c) {
    const double mean = area.dot(exact.col(c).cwiseAbs()) / area.sum();
    worst = std::max(worst, 100 * (lux.col(c) - exact.col(c)).cwiseAbs().maxCoeff() / mean);
  }
  return worst;
}

// A room with two solids and seven materials.
Room RoomWithOccluders(double patch_size_m = 0.4) {
  Scene scene = support::ClosedRoom({4, 3, 2.5}, {"a", "b", "c", "d", "floor", "ceiling"});
  support::AddBox(scene, {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(2.1, 1.9, 1.2)},
                  support::Facing::kOutward, {"solid"});
  support::AddBox(scene, {Eigen::Vector3d(2.8, 0.4, 0.9), Eigen::Vector3d(3.3, 2.2, 1.1)},
                  support::Facing::kOutward, {"solid"});
  RoomOptions options;
  options.patches.patch_size_m = patch_size_m;
  options.patches.element_size_m = patch_size_m / 2;
  return MakeRoom(scene, options);
}

TEST(Solvers, AgreeWithADoublePrecisionSolutionWithinTheirTolerance) {
  std::mt19937_64 rng = support::TestRng();
  const Room room = RoomWithOccluders();
  const Eigen::Index n = room.transport.patch_area_m2.size();
  for (int trial = 0; trial < 3; ++trial) {
    const Eigen::VectorXd albedo = Eigen::VectorXd::NullaryExpr(7, [&] { return Uniform(rng, 0, 0.95); });
    const Eigen::MatrixXf direct = RandomLight(rng, n, 3);
    const DoubleSystem system(room.transport, albedo);
    const Eigen::MatrixXd exact = system.ExactIlluminance(direct);
    // 0.01 %: ten times what float rounding through a solution with rho 0.95 may add up to.
    for (const double tolerance_percent : {1.0, 0.01}) {
      for (const RadiositySolver solver : kSolvers) {
        const RadiositySolution solution =
            SolveRadiosity(room.transport, albedo, direct, With(solver, tolerance_percent));
        EXPECT_TRUE(solution.converged) << ToString(solver) << ": " << solution.message;
        const double error =
            ErrorPercent(room.transport, system.Illuminance(direct, solution.exitance), exact);
        EXPECT_LE(error, tolerance_percent) << ToString(solver);
        EXPECT_LE(error, solution.error_percent + 1e-3)
            << ToString(solver) << ": the bound, but for rounding";
        EXPECT_EQ(solution.solver, solver);
        EXPECT_FALSE(solution.reason.empty());
      }
    }
  }
}

// Inside a sphere F_ij = A_j / A, also to a patch itself: E = D + mean(rho D) / (1 - mean rho), area means.
class Sphere : public testing::Test {
 protected:
  Sphere() {
    constexpr Eigen::Index n = 300;  // more than one block of Gauss-Seidel
    geometry_.patch_area_m2 =
        Eigen::VectorXf::NullaryExpr(n, [&] { return static_cast<float>(Uniform(rng_, 0.1, 2)); });
    for (Eigen::Index i = 0; i < n; ++i) geometry_.patch_material.push_back(static_cast<int>(i % 5));
    const Eigen::VectorXf root = geometry_.patch_area_m2.cwiseSqrt();
    geometry_.coupling = root * root.transpose() / geometry_.patch_area_m2.sum();
  }
  std::mt19937_64 rng_ = support::TestRng();
  TransportGeometry geometry_;
};

TEST_F(Sphere, EverySolverGivesTheClosedForm) {
  const Eigen::VectorXd albedo = Eigen::VectorXd::NullaryExpr(5, [&] { return Uniform(rng_, 0.1, 0.95); });
  const Eigen::MatrixXf direct = RandomLight(rng_, geometry_.patch_area_m2.size(), 2);
  const DoubleSystem system(geometry_, albedo);
  const Eigen::VectorXd area = geometry_.patch_area_m2.cast<double>();
  const double mean_rho = area.dot(system.rho) / area.sum();
  const Eigen::RowVectorXd indirect =
      area.transpose() * system.rho.asDiagonal() * direct.cast<double>() / area.sum() / (1 - mean_rho);
  const Eigen::MatrixXd exact = direct.cast<double>().rowwise() + indirect;
  for (const RadiositySolver solver : kSolvers) {
    const RadiositySolution solution = SolveRadiosity(geometry_, albedo, direct, With(solver));
    EXPECT_LE(ErrorPercent(geometry_, system.Illuminance(direct, solution.exitance), exact), 0.1)
        << ToString(solver);
  }
}

TEST_F(Sphere, FurnaceMultipliesLightByOneOverOneMinusRho) {
  const Eigen::MatrixXf direct = Eigen::MatrixXf::Ones(geometry_.patch_area_m2.size(), 1);
  for (const double rho : {0.0, 0.3, 0.7, 0.95}) {
    const Eigen::VectorXd albedo = Eigen::VectorXd::Constant(5, rho);
    const DoubleSystem system(geometry_, albedo);
    for (const RadiositySolver solver : kSolvers) {
      const RadiositySolution solution = SolveRadiosity(geometry_, albedo, direct, With(solver));
      const Eigen::MatrixXd lux = system.Illuminance(direct, solution.exitance);
      // The tolerance is of the mean direct illuminance, 1 lx; float rounding grows with the result.
      EXPECT_NEAR(lux.minCoeff(), 1 / (1 - rho), 1e-3 + 1e-5 / (1 - rho))
          << ToString(solver) << " rho " << rho;
      EXPECT_NEAR(lux.maxCoeff(), 1 / (1 - rho), 1e-3 + 1e-5 / (1 - rho))
          << ToString(solver) << " rho " << rho;
    }
  }
}

TEST_F(Sphere, TheBoundOfATruncatedSeriesIsWhatItLeavesOut) {
  const double rho = 0.8;
  const Eigen::MatrixXf direct = Eigen::MatrixXf::Ones(geometry_.patch_area_m2.size(), 1);
  RadiositySolverOptions options = With(RadiositySolver::kNeumann);
  for (const int bounces : {0, 1, 4, 9}) {
    options.bounces = bounces;
    const RadiositySolution solution =
        SolveRadiosity(geometry_, Eigen::VectorXd::Constant(5, rho), direct, options);
    // sum_{k > n} rho^k of sum_{k <= n} rho^k
    const double left_out = std::pow(rho, bounces + 1) / (1 - std::pow(rho, bounces + 1));
    EXPECT_NEAR(solution.error_percent, 100 * left_out, 1e-4 * 100 * left_out) << bounces;  // float rounding
    EXPECT_EQ(solution.iterations, bounces);
  }
}

// With equal reflectances the sphere spreads unshot light exactly as the ambient term assumes.
TEST_F(Sphere, TheAmbientTermCompletesAShootingThatWasCutShort) {
  const Eigen::VectorXd albedo = Eigen::VectorXd::Constant(5, 0.8);
  const Eigen::MatrixXf direct = RandomLight(rng_, geometry_.patch_area_m2.size(), 1);
  RadiositySolverOptions options = With(RadiositySolver::kShooting);
  options.max_iterations = 3;
  const RadiositySolution cut = SolveRadiosity(geometry_, albedo, direct, options);
  const RadiositySolution full = SolveRadiosity(geometry_, albedo, direct, With(RadiositySolver::kLu));
  EXPECT_EQ(cut.iterations, 3);
  EXPECT_LT((cut.exitance - full.exitance).cwiseAbs().maxCoeff(), 1e-4 * full.exitance.maxCoeff());
}

TEST_F(Sphere, GaussSeidelIsTheSequentialSweep) {
  const Eigen::VectorXd albedo = Eigen::VectorXd::NullaryExpr(5, [&] { return Uniform(rng_, 0.1, 0.95); });
  const Eigen::MatrixXf direct = RandomLight(rng_, geometry_.patch_area_m2.size(), 1);
  const DoubleSystem system(geometry_, albedo);
  const Eigen::MatrixXd& f = system.form_factors;
  Eigen::VectorXd exitance = system.rho.cwiseProduct(direct.col(0).cast<double>());
  for (Eigen::Index i = 0; i < exitance.size(); ++i) {
    const double others = f.row(i).dot(exitance) - f(i, i) * exitance[i];
    exitance[i] = system.rho[i] * (direct(i, 0) + others) / (1 - system.rho[i] * f(i, i));
  }
  const Eigen::VectorXd gathered = system.rho.cwiseProduct(direct.col(0).cast<double>() + f * exitance);
  RadiositySolverOptions options = With(RadiositySolver::kGaussSeidel);
  options.max_iterations = 1;
  const RadiositySolution solution = SolveRadiosity(geometry_, albedo, direct, options);
  EXPECT_LT((solution.exitance.col(0).cast<double>() - gathered).cwiseAbs().maxCoeff(),
            1e-5 * gathered.maxCoeff());  // float rounding
}

TEST(Neumann, ItsTermsArePowersOfTheOperator) {
  std::mt19937_64 rng = support::TestRng();
  const Room room = RoomWithOccluders(0.8);
  const Eigen::VectorXd albedo = Eigen::VectorXd::NullaryExpr(7, [&] { return Uniform(rng, 0.1, 0.9); });
  const Eigen::MatrixXf direct = RandomLight(rng, room.transport.patch_area_m2.size(), 2);
  const DoubleSystem system(room.transport, albedo);
  Eigen::MatrixXd lux = direct.cast<double>(), power = lux;
  for (int bounces = 0; bounces < 6; ++bounces) {
    RadiositySolverOptions options = With(RadiositySolver::kNeumann);
    options.bounces = bounces;
    const RadiositySolution solution = SolveRadiosity(room.transport, albedo, direct, options);
    const Eigen::MatrixXd sum = system.Illuminance(direct, solution.exitance);
    EXPECT_LT((sum - lux).cwiseAbs().maxCoeff(), 1e-5 * lux.maxCoeff()) << bounces;  // float rounding
    power = system.form_factors * system.rho.asDiagonal() * power;
    lux += power;
  }
}

// CIE 171:2006, test case 5.8: a cube of 4 m with an isotropic luminaire of 10 000 lm in its middle; area
// mean of the indirect illuminance rho Phi / (A (1 - rho)).
TEST(Cie171, Case58ForEverySolver) {
  constexpr double kFluxLm = 10000;
  const std::vector<std::pair<double, double>> published_lx = {
      {0, 0},         {0.05, 5.482}, {0.1, 11.574},  {0.2, 26.042},  {0.3, 44.643}, {0.4, 69.444},
      {0.5, 104.167}, {0.6, 156.25}, {0.7, 243.056}, {0.8, 416.667}, {0.9, 937.5},  {0.95, 1979.167}};
  RoomOptions room_options;
  room_options.patches = {0.5, 0.1};
  const Room room = MakeRoom(support::ClosedRoom({4, 4, 4}), room_options);
  Luminaire lamp;
  lamp.position = {2, 2, 2};
  lamp.distribution = Distribution::kIsotropic;
  Eigen::MatrixXf at_elements(static_cast<Eigen::Index>(room.patches.elements.size()), 1);
  for (size_t e = 0; e < room.patches.elements.size(); ++e) {
    const Element& element = room.patches.elements[e];
    at_elements(static_cast<Eigen::Index>(e), 0) = static_cast<float>(
        kFluxLm * DirectIlluminancePerLumen(lamp, element.center, element.normal).lx_per_lm);
  }
  const Eigen::MatrixXf direct = PatchMean(room.patches, at_elements);
  const Eigen::VectorXd area = room.transport.patch_area_m2.cast<double>();
  for (const auto& [rho, expected_lx] : published_lx) {
    const DoubleSystem system(room.transport, Eigen::VectorXd::Constant(1, rho));
    for (const RadiositySolver solver : kSolvers) {
      const RadiositySolution solution =
          SolveRadiosity(room.transport, Eigen::VectorXd::Constant(1, rho), direct, With(solver, 0.01));
      const double indirect_lx =
          area.dot(system.form_factors * solution.exitance.col(0).cast<double>()) / area.sum();
      // 0.2 %: the midpoint rule of the direct light, (h / d)^2 / 24 = 0.01 % times a curvature of about 5,
      // and the noise of sampled, symmetrised form factors, which does not bias the mean to first order (see
      // transport_test). 1e-3 lx: rounding in the table.
      EXPECT_NEAR(indirect_lx, expected_lx, 0.002 * expected_lx + 1e-3) << ToString(solver) << " rho " << rho;
    }
  }
}

TEST_F(Sphere, CutShortIsReportedAndFinite) {
  const Eigen::VectorXd albedo = Eigen::VectorXd::Constant(5, 0.999999);
  const Eigen::MatrixXf direct = RandomLight(rng_, geometry_.patch_area_m2.size(), 1);
  // A step of conjugate gradients or BiCGSTAB solves the sphere (its coupling has rank 1): not among these.
  for (const RadiositySolver solver :
       {RadiositySolver::kJacobi, RadiositySolver::kGaussSeidel, RadiositySolver::kShooting}) {
    RadiositySolverOptions options = With(solver);
    options.max_iterations = 2;
    geometry_.patch_material.back() = 0;
    const RadiositySolution solution = SolveRadiosity(geometry_, albedo, direct, options);
    EXPECT_FALSE(solution.converged) << ToString(solver);
    EXPECT_NE(solution.message.find("not converged"), std::string::npos);
    EXPECT_TRUE(solution.exitance.allFinite());
  }
}

TEST_F(Sphere, DarknessStaysDark) {
  for (const RadiositySolver solver : kSolvers) {
    const RadiositySolution solution =
        SolveRadiosity(geometry_, Eigen::VectorXd::Constant(5, 0.5),
                       Eigen::MatrixXf::Zero(geometry_.patch_area_m2.size(), 2), With(solver));
    EXPECT_TRUE(solution.converged) << ToString(solver);
    EXPECT_EQ(solution.exitance.cwiseAbs().maxCoeff(), 0) << ToString(solver);
  }
}

TEST_F(Sphere, WhatHasNoSolutionIsRefused) {
  const Eigen::Index n = geometry_.patch_area_m2.size();
  const Eigen::MatrixXf direct = Eigen::MatrixXf::Ones(n, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const RadiositySolver solver : kSolvers) {
    for (const double rho : {-0.01, 1.0, 1.5, nan}) {
      EXPECT_THROW(SolveRadiosity(geometry_, Eigen::VectorXd::Constant(5, rho), direct, With(solver)),
                   std::invalid_argument);
    }
  }
  const Eigen::VectorXd albedo = Eigen::VectorXd::Constant(5, 0.5);
  EXPECT_THROW(SolveRadiosity(geometry_, albedo.head(4), direct), std::invalid_argument);
  EXPECT_THROW(SolveRadiosity(geometry_, albedo, direct.topRows(n - 1)), std::invalid_argument);
  EXPECT_THROW(SolveRadiosity(geometry_, albedo, direct * static_cast<float>(nan)), std::invalid_argument);
  EXPECT_THROW(SolveRadiosity(geometry_, albedo, direct, With(RadiositySolver::kAuto, 0)),
               std::invalid_argument);
  const DenseTransport operator_only(geometry_.coupling);
  EXPECT_THROW(SolveRadiosity(operator_only, geometry_.patch_area_m2, geometry_.patch_material, albedo,
                              direct, With(RadiositySolver::kCholesky)),
               std::invalid_argument);
}

TEST_F(Sphere, AutoFactorsForManyColumnsOnly) {
  const Eigen::VectorXd albedo = Eigen::VectorXd::Constant(5, 0.5);
  const Eigen::Index n = geometry_.patch_area_m2.size();
  const auto chosen = [&](Eigen::Index columns) {
    return SolveRadiosity(geometry_, albedo, Eigen::MatrixXf::Ones(n, columns)).solver;
  };
  EXPECT_EQ(chosen(1), RadiositySolver::kConjugateGradient);
  EXPECT_EQ(chosen(n), RadiositySolver::kCholesky);
}

}  // namespace
}  // namespace luxfit
