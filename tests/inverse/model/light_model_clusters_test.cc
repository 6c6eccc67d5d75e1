#include <gtest/gtest.h>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/light_model.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A lamp near a wall of a room of 0.25 m patches, so that clusters of 0.5 m miss some of the light.
class ClusteredBox : public testing::Test {
 protected:
  ClusteredBox() {
    plain_.clusters = nullptr;
    state_.luminaires.resize(1);
    state_.luminaires[0].id = "A";
    state_.luminaires[0].position = Eigen::Vector3d(0.5, 1.4, 1.9);
    state_.luminaires[0].flux_lm = 1000;
    state_.free = {{true}};
    state_.albedo = Eigen::Vector3d(0.6, 0.3, 0.8);
    state_.albedo_free = {true, true, true};
    state_.camera_scale = 0.02;
    data_.dimming = {Eigen::VectorXd::Ones(1)};
    for (int e = 0; e < static_cast<int>(room_.patches.elements.size()); e += 31) {
      Observation o;
      o.element = e;
      data_.observations.push_back(o);
    }
    for (const Eigen::Vector3d& up : {Eigen::Vector3d(0, 0, 1), {1, 0, 0}})
      data_.readings.push_back({{{1.5, 1.0, 0.8}, up}, 0, 100, 1, true});
  }
  Eigen::VectorXd Predicted(const Room& room, const LightState& frozen_at, const LightState& state) const {
    LightModel model(room, data_);
    model.FreezeVisibility(frozen_at);
    return model.Predict(state, {}, false).value;
  }

  Room room_ =
      MakeRoom(support::ClosedRoom({3.2, 2.6, 2.4}, {"wall", "wall", "wall", "wall", "floor", "ceiling"}),
               {{0.25, 0.125}, {64}});
  Room plain_ = room_;
  LightData data_;
  LightState state_;
};

TEST_F(ClusteredBox, ThePatchesLightIsPredicted) {
  ASSERT_TRUE(room_.clusters);
  const Eigen::VectorXd fine = Predicted(plain_, state_, state_), found = Predicted(room_, state_, state_),
                        coarse = Predicted(*room_.clusters, state_, state_);
  constexpr double kRounding = 3e-6;  // of floats
  EXPECT_LT(((found - fine).array() / fine.array()).abs().maxCoeff(), kRounding);
  EXPECT_GT(((coarse - fine).array() / fine.array()).abs().maxCoeff(), 1000 * kRounding);
}

TEST_F(ClusteredBox, AfterAStepOfAFitTheLightIsStillThatOfPatches) {
  LightState moved = state_;
  moved.luminaires[0].position += Eigen::Vector3d(0.006, -0.006, 0.004);
  moved.albedo += Eigen::Vector3d(0.008, -0.005, 0.003);
  const Eigen::VectorXd fine = Predicted(plain_, state_, moved), found = Predicted(room_, state_, moved),
                        before = Predicted(plain_, state_, state_);
  // The correction is frozen: it errs by its own change alone, which stays below the least error that a fit gives its model.
  EXPECT_GT(((fine - before).array() / fine.array()).abs().maxCoeff(), 0.01);
  const double least = FitLuminairesOptions().min_relative_sigma;
  EXPECT_LT(((found - fine).array() / fine.array()).abs().maxCoeff(), least);
}

TEST_F(ClusteredBox, TintsCountOnce) {
  LightState tinted = state_;
  tinted.tint.resize(3, 3);
  tinted.tint << 1.2, 0.8, 1.1, 1.0, 1.0, 1.0, 0.7, 1.3, 0.8;
  data_.luminance_weights = Eigen::Vector3d(0.3, 0.6, 0.1);
  const Eigen::VectorXd fine = Predicted(plain_, tinted, tinted), found = Predicted(room_, tinted, tinted);
  EXPECT_LT(((found - fine).array() / fine.array()).abs().maxCoeff(), 3e-6);
}

}  // namespace
}  // namespace luxfit
