#include "inverse/albedo/internal/stereo_terms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace luxfit {
namespace {

StereoState StateWith(CurveKind kind) {
  StereoState state;
  state.b.resize(3, 1);
  state.b.col(0) << 0.2, -0.25, 0.6;
  state.to_light.resize(3, 1);
  state.to_light.col(0) = Eigen::Vector3d(0.5, 0.1, 0.8).normalized();
  state.strength = Eigen::VectorXd::Constant(1, 1.3);
  state.curve = StartCurve(kind);
  return state;
}

double ValueOf(const StereoState& state) { return StereoPixel(state, 0).Term(0, false).value; }

// Every derivative of an observation, against central differences.
TEST(StereoTerms, DerivativesMatchFiniteDifferences) {
  constexpr double kStep = 1e-6;
  for (const CurveKind kind : AllCurveKinds()) {
    const StereoState state = StateWith(kind);
    const StereoTerm term = StereoPixel(state, 0).Term(0);
    EXPECT_EQ(term.value, ValueOf(state));
    const auto slope = [&](const auto& change) {
      StereoState above = state, below = state;
      change(above, kStep);
      change(below, -kStep);
      return (ValueOf(above) - ValueOf(below)) / (2 * kStep);
    };
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(term.d_b[axis], slope([&](StereoState& s, double h) { s.b(axis, 0) += h; }), 1e-7)
          << ToString(kind);
    }
    for (Eigen::Index p = 0; p < state.curve.parameters.size(); ++p) {
      EXPECT_NEAR(term.d_curve[p], slope([&](StereoState& s, double h) { s.curve.parameters[p] += h; }), 1e-7)
          << ToString(kind) << " parameter " << p;
    }
    EXPECT_NEAR(term.d_log_strength, slope([](StereoState& s, double h) { s.strength[0] *= std::exp(h); }),
                1e-7);
  }
}

// By the direction along its two tangents, as a step moves it.
TEST(StereoTerms, AStepMovesWhatItSays) {
  constexpr double kStep = 1e-6;
  for (const CurveKind kind : AllCurveKinds()) {
    const StereoState state = StateWith(kind);
    StereoProblem problem;
    problem.value = Eigen::MatrixXd::Ones(1, 1);
    problem.used = ObservationMask::Constant(1, 1, true);
    problem.to_light = state.to_light;
    problem.direction_sigma_rad = Eigen::VectorXd::Constant(1, 0.01);
    problem.strengths_free = true;
    const SharedUnknowns shared(problem, state);
    ASSERT_EQ(shared.count(), state.curve.parameters.size() + 3);
    const StereoTerm term = StereoPixel(state, 0).Term(0);
    Eigen::VectorXd slopes = Eigen::VectorXd::Zero(shared.count());
    shared.Row(term, 0, [&](Eigen::Index column, double slope) { slopes[column] += slope; });
    for (Eigen::Index c = 0; c < shared.count(); ++c) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(shared.count(), c);
      const double difference = ValueOf(shared.Applied(state, step)) - ValueOf(shared.Applied(state, -step));
      EXPECT_NEAR(slopes[c], difference / (2 * kStep), 1e-6) << ToString(kind) << " unknown " << c;
    }
  }
}

// A direction that has moved turns about another place than the state's.
TEST(StereoTerms, SlopesAfterAStep) {
  constexpr double kStep = 1e-6;
  const StereoState state = StateWith(CurveKind::kExponent);
  StereoProblem problem;
  problem.value = Eigen::MatrixXd::Ones(1, 1);
  problem.used = ObservationMask::Constant(1, 1, true);
  problem.to_light = state.to_light;
  problem.direction_sigma_rad = Eigen::VectorXd::Constant(1, 0.01);
  problem.strengths_free = true;
  const SharedUnknowns shared(problem, state);
  const Eigen::VectorXd x = Eigen::Vector4d(0.1, 0.2, -0.15, 0.1);
  const StereoState moved = shared.Applied(state, x);
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(shared.count());
  shared.At(x).Row(StereoPixel(moved, 0).Term(0), 0,
                   [&](Eigen::Index column, double slope) { slopes[column] += slope; });
  for (Eigen::Index c = 0; c < shared.count(); ++c) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(shared.count(), c);
    const double difference =
        ValueOf(shared.Applied(state, x + step)) - ValueOf(shared.Applied(state, x - step));
    EXPECT_NEAR(slopes[c], difference / (2 * kStep), 1e-6) << "unknown " << c;
  }
}

// Bounds of steps end on those of the curve, so that a parameter there is known to be at its bound.
TEST(StereoTerms, StepsEndOnTheCurvesBounds) {
  const StereoState state = StateWith(CurveKind::kOrenNayar);
  StereoProblem problem;
  problem.value = Eigen::MatrixXd::Ones(1, 1);
  problem.used = ObservationMask::Constant(1, 1, true);
  problem.to_light = state.to_light;
  problem.direction_sigma_rad = Eigen::VectorXd::Zero(1);
  const SharedUnknowns shared(problem, state);
  EXPECT_FALSE(IsAtBound(shared.Applied(state, shared.upper()).curve));
  EXPECT_TRUE(IsAtBound(shared.Applied(state, shared.lower()).curve));
}

}  // namespace
}  // namespace luxfit
