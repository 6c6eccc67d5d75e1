// Advice in a closed room of two luminaires, against sigmas that follow by hand.
#include "inverse/advise/advise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

const ParameterId kFluxOfA{ParameterKind::kLogFlux, "A"}, kFluxOfB{ParameterKind::kLogFlux, "B"};
constexpr double kReadingSigma = 0.02;  // of a meter of unknown class

class Advice : public testing::Test {
 protected:
  Advice() {
    given_.luminaires = {LampAt("A", {1.2, 1.4, 2.4}), LampAt("B", {3.0, 1.8, 2.4})};
    given_.albedo = Eigen::VectorXd::Constant(1, 0.5);
    given_.dimming = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)};
    Know({kFluxOfA, kFluxOfB}, Eigen::Vector2d(0.1, 0.05));
  }

  static Luminaire LampAt(const std::string& id, const Eigen::Vector3d& position) {
    Luminaire lamp;
    lamp.id = id;
    lamp.position = position;
    lamp.shape = LuminaireShape::kDisc;
    lamp.size_m = {0.3, 0.3};
    lamp.flux_lm = 1000;
    return lamp;
  }

  void Know(const std::vector<ParameterId>& parameters, const Eigen::VectorXd& sigmas) {
    given_.fit.parameters = parameters;
    given_.fit.is_determined.assign(parameters.size(), true);
    given_.fit.values.setZero(sigmas.size());
    given_.fit.covariance = sigmas.cwiseAbs2().asDiagonal();
  }

  void AddReading(const std::string& id, const Eigen::Vector2d& at, int state) {
    given_.readings.push_back({id, {{at.x(), at.y(), 0.001}, {0, 0, 1}, {}}, state});
  }

  AdvicePlan Plan(const AdviceOptions& options = {}) { return Advise(room_, given_, options); }

  static double SigmaOf(const std::vector<SigmaChange>& changes, const std::string& owner) {
    for (const SigmaChange& change : changes) {
      if (change.of.owner == owner) return change.after;
    }
    return -1;
  }

  const Room room_ = MakeRoom(support::ClosedRoom({4, 3, 2.5}));
  AdviceGiven given_;
};

// Light is proportional to flux: the reading of a state tells the flux as well as the meter reads.
double WithReading(double sigma) { return 1 / std::hypot(1 / sigma, 1 / kReadingSigma); }

TEST_F(Advice, TheWorseFluxIsReadFirstThenTheOther) {
  AddReading("under B", {3.0, 1.8}, 1);
  AddReading("under A", {1.2, 1.4}, 0);
  const AdvicePlan plan = Plan();
  ASSERT_EQ(plan.steps.size(), 2u);
  EXPECT_EQ(given_.readings[plan.steps[0].candidate].id, "under A");
  EXPECT_EQ(plan.steps[0].helped.of.owner, "A");
  EXPECT_NEAR(plan.steps[0].helped.before, 0.1, 1e-9);
  EXPECT_NEAR(plan.steps[0].helped.after, WithReading(0.1), 1e-4);
  EXPECT_NEAR(SigmaOf(plan.steps[0].changes, "B"), 0.05, 1e-9) << "B is off";
  EXPECT_EQ(given_.readings[plan.steps[1].candidate].id, "under B");
  EXPECT_NEAR(plan.steps[1].helped.after, WithReading(0.05), 1e-4);
  EXPECT_TRUE(plan.is_enough) << "each was read";
}

TEST_F(Advice, EnoughIsSaidWhereNothingHelpsByATenth) {
  Know({kFluxOfA, kFluxOfB}, Eigen::Vector2d(0.008, 0.008));
  AddReading("under A", {1.2, 1.4}, 0);
  const AdvicePlan plan = Plan();
  EXPECT_TRUE(plan.steps.empty());
  EXPECT_TRUE(plan.is_enough);
  AdviceOptions eager;
  eager.least_gain = 0.05;  // 1 - WithReading(0.008) / 0.008 = 7 %
  EXPECT_EQ(Plan(eager).steps.size(), 1u);
}

TEST_F(Advice, WhatIsNotDeterminedComesFirst) {
  given_.fit.is_determined[1] = false;
  AddReading("under A", {1.2, 1.4}, 0);
  AddReading("under B", {3.0, 1.8}, 1);
  const AdvicePlan plan = Plan();
  ASSERT_FALSE(plan.steps.empty());
  EXPECT_EQ(given_.readings[plan.steps[0].candidate].id, "under B");
  EXPECT_FALSE(plan.steps[0].helped.was_determined);
  EXPECT_TRUE(plan.steps[0].helped.is_determined);
  EXPECT_NEAR(plan.steps[0].helped.after, kReadingSigma, 1e-4);
}

TEST_F(Advice, OneReadingTellsTheScaleOfAllFluxes) {
  Know({kFluxOfA, kFluxOfB}, Eigen::Vector2d(0.003, 0.003));
  given_.is_absolute = false;
  AddReading("under A", {1.2, 1.4}, 0);
  const AdvicePlan plan = Plan();
  ASSERT_EQ(plan.steps.size(), 1u);
  for (const SigmaChange& change : plan.steps[0].changes) {
    EXPECT_FALSE(change.was_determined);
    EXPECT_TRUE(change.is_determined);
    EXPECT_LT(change.after, 1.1 * kReadingSigma) << change.of.owner;
  }
}

TEST_F(Advice, OnlyWhatIsAskedForCounts) {
  AddReading("under A", {1.2, 1.4}, 0);
  AddReading("under B", {3.0, 1.8}, 1);
  AdviceOptions of_b;
  of_b.owner = "B";
  const AdvicePlan plan = Plan(of_b);
  ASSERT_EQ(plan.now.size(), 1u);
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_EQ(given_.readings[plan.steps[0].candidate].id, "under B");
}

TEST_F(Advice, APredictedReadingIsAQuantity) {
  given_.predicted.push_back({"P@both", {{2, 1.5, 0.8}, {0, 0, 1}, {}}, 0});
  AddReading("under A", {1.2, 1.4}, 0);
  AdviceOptions of_readings;
  of_readings.kinds = {AdviceKind::kReading};
  const AdvicePlan plan = Plan(of_readings);
  ASSERT_EQ(plan.now.size(), 1u);
  EXPECT_NEAR(plan.now[0].before, 0.1, 1e-4) << "only A is on";
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_NEAR(plan.steps[0].helped.after, WithReading(0.1), 1e-4);
}

// The same photo again adds nothing. From another place it shows other elements, and the outline anew.
TEST_F(Advice, APhotoThatWasTakenIsNoAdvice) {
  std::vector<ParameterId> position;
  for (int axis = 0; axis < 3; ++axis)
    position.push_back({ParameterKind::kLuminaire, "A", static_cast<LuminaireQuantity>(axis)});
  Know(position, Eigen::Vector3d(0.05, 0.05, 0.05));
  Camera camera;
  camera.width_px = 400, camera.height_px = 300;
  camera.fx_px = camera.fy_px = 200, camera.cx_px = 200, camera.cy_px = 150;
  given_.views = {ViewFrom("first", {0.5, 0.5, 1.6}, {1, 1, 0}, camera),
                  ViewFrom("second", {3.5, 0.5, 1.6}, {-1, 1, 0}, camera)};
  given_.taken = {{0, 0}};
  given_.photos = {{0, 0}, {1, 0}, {1, 1}};
  const AdvicePlan plan = Plan();
  for (const AdviceStep& step : plan.steps) EXPECT_EQ(step.candidate, 1u) << "A is on in no other new photo";
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_LT(plan.steps[0].helped.after, plan.steps[0].helped.before);
}

TEST_F(Advice, BadInputIsRefused) {
  given_.fit.covariance.resize(0, 0);
  EXPECT_THROW(Plan(), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
