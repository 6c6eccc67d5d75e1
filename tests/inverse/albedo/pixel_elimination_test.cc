#include "inverse/albedo/internal/pixel_elimination.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <random>

#include "tests/support/inverse/stereo_scene.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr int kImages = 7;

// A ray-cast sphere under lights whose given directions are off.
StereoProblem Problem() {
  std::mt19937_64 rng = support::TestRng();
  support::StereoScene scene;
  scene.pixels_across = 9;
  scene.has_second_sphere = false;
  scene.exponent = 0.85;
  const support::StereoPicture picture = support::RenderStereo(scene, support::LightsAround(kImages), rng);
  StereoProblem problem;
  problem.value = picture.value;
  problem.used = picture.value.array() > 0.02;
  problem.to_light = picture.to_light;
  std::normal_distribution<double> off(0, 0.03);
  for (auto light : problem.to_light.colwise()) {
    light += Eigen::Vector3d(off(rng), off(rng), off(rng));
    light.normalize();
  }
  problem.direction_sigma_rad = Eigen::VectorXd::Constant(kImages, 0.03);
  problem.strengths_free = true;
  return problem;
}

Eigen::MatrixXd WeightOf(const StereoProblem& problem) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> weight(500, 2000);
  return problem.value.unaryExpr([&](double) { return weight(rng); });
}

// Returns a state at which every pixel is at its best.
StereoState SolvedState(const StereoProblem& problem, const Eigen::MatrixXd& weight, CurveKind kind) {
  const Eigen::VectorXd strength = Eigen::VectorXd::Ones(kImages);
  StereoState state{SolveLambert(problem, strength), problem.to_light, strength, StartCurve(kind)};
  for (int k = 0; k < 5; ++k) {
    PixelElimination pixels(problem, weight, state);
    state = pixels.StateAt(Eigen::VectorXd::Zero(pixels.shared().count()));
  }
  return state;
}

// The squares as a function of the shared unknowns alone, by central differences.
TEST(PixelElimination, GradientIsThatOfTheReducedSquares) {
  constexpr double kStep = 1e-4;
  const StereoProblem problem = Problem();
  const Eigen::MatrixXd weight = WeightOf(problem);
  for (const CurveKind kind : {CurveKind::kLambert, CurveKind::kOffset, CurveKind::kExponent}) {
    const StereoState state = SolvedState(problem, weight, kind);
    PixelElimination pixels(problem, weight, state);
    const Eigen::Index count = pixels.shared().count();
    const NormalEquations at = pixels.EquationsAt(Eigen::VectorXd::Zero(count));
    Eigen::VectorXd slope(count);
    for (Eigen::Index c = 0; c < count; ++c) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(count, c);
      const double difference = pixels.EquationsAt(step).squares - pixels.EquationsAt(-step).squares;
      slope[c] = difference / (2 * kStep);
    }
    EXPECT_LT((2 * at.gradient - slope).norm(), 1e-4 * slope.norm()) << ToString(kind);
  }
}

// All unknowns side by side, with a Jacobian by central differences: their normal equations without the pixels'.
TEST(PixelElimination, MatrixIsTheSchurComplement) {
  constexpr double kStep = 1e-6;
  StereoProblem problem = Problem();
  problem.strengths_free = false;  // a held direction is no row of the data
  const Eigen::MatrixXd weight = WeightOf(problem);
  const StereoState state = SolvedState(problem, weight, CurveKind::kExponent);
  const SharedUnknowns shared(problem, state);
  const Eigen::Index pixels = state.b.cols(), all = 3 * pixels + shared.count();
  const auto rows = [&](const Eigen::VectorXd& x) {
    StereoState moved = shared.Applied(state, x.tail(shared.count()));
    moved.b += x.head(3 * pixels).reshaped(3, pixels);
    Eigen::MatrixXd model = problem.value - StereoResiduals(problem, moved);
    model = problem.used.select(model.cwiseProduct(weight.cwiseSqrt()), 0);
    return Eigen::VectorXd(model.reshaped());
  };
  Eigen::MatrixXd jacobian(problem.value.size(), all);
  for (Eigen::Index c = 0; c < all; ++c) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(all, c);
    jacobian.col(c) = (rows(step) - rows(-step)) / (2 * kStep);
  }
  const Eigen::MatrixXd own = jacobian.leftCols(3 * pixels), common = jacobian.rightCols(shared.count());
  const Eigen::MatrixXd left = common - own * own.colPivHouseholderQr().solve(common);
  NormalEquations priors(shared.count());
  shared.AddPriors(Eigen::VectorXd::Zero(shared.count()), priors);
  const Eigen::MatrixXd expected = left.transpose() * left + priors.matrix;
  const Eigen::MatrixXd found = ReducedEquations(problem, weight, state).reduced.matrix;
  EXPECT_LT((found - expected).norm(), 1e-5 * expected.norm());
}

// Scores of all images add up to the gradient: without priors, and with the pixels at their best.
TEST(PixelElimination, ScoresAddUpToTheGradient) {
  StereoProblem problem = Problem();
  const Eigen::MatrixXd weight = WeightOf(problem);
  const StereoState state = SolvedState(problem, weight, CurveKind::kLambert);
  const StereoEquations equations = ReducedEquations(problem, weight, state);
  const SharedUnknowns shared(problem, state);
  NormalEquations priors(shared.count());
  shared.AddPriors(Eigen::VectorXd::Zero(shared.count()), priors);
  const Eigen::VectorXd gradient = equations.reduced.gradient - priors.gradient;
  EXPECT_LT((equations.scores.rowwise().sum() - gradient).norm(), 1e-9 * gradient.norm());
}

}  // namespace
}  // namespace luxfit
