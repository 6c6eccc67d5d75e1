#include "inverse/choose/internal/held_luminaires.h"

#include <gtest/gtest.h>

#include <vector>

#include "inverse/model/internal/light_model.h"
#include "tests/support/room_with_screen.h"

namespace luxfit {
namespace {

// A room with a screen, a disc A and a rectangle B, both on in two states, the second at other levels.
class TwoOnTogether : public testing::Test {
 protected:
  TwoOnTogether() : room_(MakeRoom(support::RoomWithScreen(), {{0.5, 0.25}, {64}})) {
    state_.luminaires.resize(2);
    Luminaire &a = state_.luminaires[0], &b = state_.luminaires[1];
    a.id = "A";
    a.position = Eigen::Vector3d(0.9, 1.1, 1.9);
    a.shape = LuminaireShape::kDisc;
    a.size_m = {0.2, 0.2};
    a.flux_lm = 700;
    b.id = "B";
    b.position = Eigen::Vector3d(2.3, 1.3, 1.8);
    b.distribution = Distribution::kCosinePower;
    b.cosine_exponent = 2;
    b.shape = LuminaireShape::kRectangle;
    b.size_m = {0.3, 0.2};
    b.flux_lm = 400;
    state_.free.resize(2);
    state_.albedo = Eigen::Vector3d(0.6, 0.25, 0.4);
    state_.albedo_free = {true, true, true};
    state_.camera_scale = 0.02;
    state_.camera_scale_free = false;
    data_.dimming = {Eigen::Vector2d(1, 1), Eigen::Vector2d(0.3, 0.8)};
    data_.indirect_is_held = true;
    for (int e = 0; e < static_cast<int>(room_.patches.elements.size()); e += 3) {
      Observation o;
      o.element = e;
      o.state = (e / 3) % 2;
      o.relative_indirect = 0.05 + 0.001 * (e % 7);
      data_.observations.push_back(o);
    }
  }

  // Returns A's problem with the light of B known.
  LightData DataOfA() const {
    LightData data;
    for (const Eigen::VectorXd& dimming : data_.dimming) data.dimming.emplace_back(dimming.head<1>());
    data.indirect_is_held = true;
    data.observations = WithHeldLight(room_, data_.dimming, state_, {0}, data_.observations);
    return data;
  }

  LightState StateOfA() const {
    LightState state = state_;
    state.luminaires.pop_back();
    state.free.pop_back();
    return state;
  }

  // Returns the observations whose elements see a luminaire in part.
  std::vector<bool> SeePart(const Eigen::Vector2d& on) const {
    LightData data = data_;
    data.dimming = {on, on};
    LightModel model(room_, data);
    model.FreezeVisibility(state_);
    return model.InPenumbra();
  }

  Room room_;
  LightData data_;
  LightState state_;
};

TEST_F(TwoOnTogether, OneIsPredictedAsBesideTheOther) {
  const LightData alone = DataOfA();
  LightModel both_model(room_, data_), alone_model(room_, alone);
  both_model.FreezeVisibility(state_);
  alone_model.FreezeVisibility(StateOfA());
  // Position, flux and three reflectances.
  const std::vector<Parameter> parameters = FreeParameters(room_, StateOfA());
  ASSERT_EQ(parameters.size(), 7U);
  const Prediction both = both_model.Predict(state_, parameters, true);
  const Prediction by_itself = alone_model.Predict(StateOfA(), parameters, true);
  Eigen::Index row = 0;
  const double scale = both.value.maxCoeff();
  const Eigen::RowVectorXd slope = both.jacobian.colwise().lpNorm<Eigen::Infinity>();
  for (size_t i = 0; i < data_.observations.size(); ++i) {
    if (row == by_itself.value.size() ||
        alone.observations[static_cast<size_t>(row)].element != data_.observations[i].element)
      continue;
    const auto at = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(by_itself.value[row], both.value[at], 1e-5 * scale);
    for (Eigen::Index p = 0; p < slope.size(); ++p)
      EXPECT_NEAR(by_itself.jacobian(row, p), both.jacobian(at, p), 1e-5 * slope[p]);
    ++row;
  }
  EXPECT_EQ(row, by_itself.value.size());
}

TEST_F(TwoOnTogether, ElementsThatSeeAPartOfAHeldOneAreLeftOut) {
  const std::vector<bool> part_of_b = SeePart({0, 1}), part_of_a = SeePart({1, 0});
  std::vector<int> expected, left;
  int of_a_alone = 0;
  for (size_t i = 0; i < data_.observations.size(); ++i) {
    if (!part_of_b[i]) expected.push_back(data_.observations[i].element);
    of_a_alone += part_of_a[i] && !part_of_b[i] ? 1 : 0;
  }
  for (const Observation& o : DataOfA().observations) left.push_back(o.element);
  EXPECT_EQ(left, expected);
  EXPECT_LT(left.size(), data_.observations.size());
  EXPECT_GT(of_a_alone, 0) << "those that see a part of A itself stay: its fit judges them";
}

TEST_F(TwoOnTogether, NothingIsHeldWhereAllAreMembers) {
  const std::vector<Observation> same =
      WithHeldLight(room_, data_.dimming, state_, {0, 1}, data_.observations);
  ASSERT_EQ(same.size(), data_.observations.size());
  for (size_t i = 0; i < same.size(); ++i)
    EXPECT_EQ(same[i].relative_indirect, data_.observations[i].relative_indirect);
}

}  // namespace
}  // namespace luxfit
