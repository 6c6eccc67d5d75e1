// Bodies of luminaires in the light model, and in the covariance of a fit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "forward/light/covered_surfaces.h"
#include "inverse/model/fit_luminaires.h"
#include "inverse/model/fitted_light.h"
#include "inverse/model/internal/light_model.h"
#include "tests/support/forward/cut_ceiling.h"

namespace luxfit {
namespace {

const Eigen::Vector3d kRoom(3.2, 2.6, 2.4);
const Luminaire kPanel = support::PanelUnder(kRoom.z(), 0.01, {1.5, 1.2}, {0.8, 0.8});
constexpr int kPanelAlone = 0, kPointAlone = 1;  // states; both are on in a third

// A panel under the ceiling and a point, in three states; all surfaces but that behind the panel are observed.
class RoomWithPanel : public testing::Test {
 protected:
  RoomWithPanel() : room_(MakeRoom(support::CutCeiling(kRoom, kPanel, "behind"), {{0.4, 0.2}, {256}})) {
    Luminaire point;
    point.id = "point";
    point.position = {2.4, 0.9, 1.5};
    point.distribution = Distribution::kIsotropic;
    point.flux_lm = 900;
    state_.luminaires = {kPanel, point};
    state_.luminaires[0].flux_lm = 1500;
    state_.free = {{false, true}, {false, true}};
    state_.albedo = Eigen::Vector4d(0.6, 0.3, 0.8, 0.8);
    state_.albedo_free.assign(4, false);
    state_.camera_scale = 0.02;
    state_.camera_scale_free = false;
    data_.dimming = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(0.4, 1)};
    for (int e = 0; e < static_cast<int>(room_.patches.elements.size()); e += 4) {
      if (room_.patches.PatchOf(e).material == kBehind) continue;
      for (int s = 0; s < 3; ++s) {
        Observation o;
        o.element = e;
        o.state = s;
        data_.observations.push_back(o);
      }
    }
    for (int s = 0; s < 3; ++s)
      data_.readings.push_back({{{0.8, 1.9, 0.75}, {0, 0, 1}, {}}, s, 100, 1, true});
  }

  Prediction Predict(BodyPresence bodies, const std::vector<Parameter>& parameters = {}) const {
    LightState state = state_;
    state.bodies = bodies;
    LightModel model(room_, data_);
    model.FreezeVisibility(state);
    return model.Predict(state, parameters, !parameters.empty());
  }
  int StateOf(Eigen::Index row) const {
    const auto i = static_cast<size_t>(row);
    return i < data_.observations.size() ? data_.observations[i].state
                                         : data_.readings[i - data_.observations.size()].state;
  }

  // Expects ratios near 1, one for each row. They depart from it by light that the part behind the panel throws on
  // itself, and by the point's light falling unevenly, as in covered_surfaces_test.
  void ExpectAsTheSurface(const char* what, const Eigen::ArrayXd& ratio) const {
    double worst_of_panel = 0, worst = 0;
    for (Eigen::Index i = 0; i < ratio.size(); ++i) {
      const double error = std::abs(ratio[i] - 1);
      worst = std::max(worst, error);
      if (StateOf(i) == kPanelAlone) worst_of_panel = std::max(worst_of_panel, error);
    }
    std::printf("%s: within %.2f %%, panel alone %.2f %%\n", what, 100 * worst, 100 * worst_of_panel);
    EXPECT_LT(worst_of_panel, 0.021);
    EXPECT_LT(worst, 0.073);
  }

  static constexpr int kBehind = 3;
  Room room_;
  LightData data_;
  LightState state_;
};

// A fitted room's light is that of the fit's own rows, whichever bodies there are. Rows hold what bodies hide relative to the
// light without them, in single precision.
TEST_F(RoomWithPanel, FittedLightIsThatOfTheRows) {
  constexpr double kRounding = 2e-6;
  for (const BodyPresence bodies : {BodyPresence::kNone, BodyPresence::kWhenOn, BodyPresence::kAlways}) {
    const Eigen::VectorXd rows = Predict(bodies).value;
    const FittedLight light(room_, {state_.luminaires, state_.albedo, bodies});
    const PlaceLight place = light.LightAt({data_.readings[0].sensor});
    for (const Reading& reading : data_.readings) {
      const Eigen::VectorXd& dimming = data_.dimming[static_cast<size_t>(reading.state)];
      const double row_lx = rows[rows.size() - 3 + reading.state];
      EXPECT_NEAR(place.Under(dimming)[0], row_lx, kRounding * row_lx) << ToString(bodies) << reading.state;
      EXPECT_NEAR((place.While(dimming) * dimming)[0], row_lx, kRounding * row_lx);
    }
    for (size_t i = 0; i < data_.observations.size(); ++i) {
      const Observation& o = data_.observations[i];
      const double gain =
          state_.camera_scale * state_.albedo[room_.patches.PatchOf(o.element).material] / M_PI;
      const double element_lx =
          light.AtElements().Under(data_.dimming[static_cast<size_t>(o.state)])[o.element];
      const double row = rows[static_cast<Eigen::Index>(i)];
      ASSERT_NEAR(gain * element_lx, row, kRounding * row) << ToString(bodies) << i;
    }
  }
}

// A room whose part behind the panel reflects as a body does, by the model without bodies, loses the same light
// but for the share that passes beside the body. The limits are those of the derivative below, which departs for the
// same reasons and by no less.
TEST_F(RoomWithPanel, PredictionsDropAsWithTheBodysReflectanceBehind) {
  const Eigen::ArrayXd without = Predict(BodyPresence::kNone).value,
                       with = Predict(BodyPresence::kAlways).value;
  const double share = FindCoveredSurfaces(room_, state_.luminaires).at(0).share;
  state_.albedo[kBehind] = kBodyAlbedo;
  const Eigen::ArrayXd darker = Predict(BodyPresence::kNone).value;
  ExpectAsTheSurface("drop against the darker surface", (without - with) / (share * (without - darker)));
}

TEST_F(RoomWithPanel, ABodyThatIsThereWhereOnHidesNothingWhereOff) {
  const Eigen::VectorXd none = Predict(BodyPresence::kNone).value, on = Predict(BodyPresence::kWhenOn).value,
                        always = Predict(BodyPresence::kAlways).value;
  for (Eigen::Index i = 0; i < none.size(); ++i) {
    EXPECT_EQ(on[i], StateOf(i) == kPointAlone ? none[i] : always[i]) << i;
    EXPECT_LT(always[i], none[i]) << i;
  }
}

TEST_F(RoomWithPanel, ABodyAsBrightAsItsCeilingChangesNothing) {
  state_.albedo.tail<2>().setConstant(kBodyAlbedo);
  const Prediction none = Predict(BodyPresence::kNone), always = Predict(BodyPresence::kAlways);
  EXPECT_LT((always.value - none.value).cwiseQuotient(none.value).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(always.d_body.minCoeff(), 0);
  EXPECT_EQ(none.d_body.size(), 0);
}

// The part behind the panel has a material of its own, by whose reflectance the model without bodies is
// differentiated, at that of a body. The differences are those of covered_surfaces_test: light that the part
// throws on itself, and the point's light falling unevenly.
TEST_F(RoomWithPanel, DerivativeByTheBodyIsThatByTheSurfaceInItsPlace) {
  const Prediction bodies = Predict(BodyPresence::kAlways);
  const double share = FindCoveredSurfaces(room_, state_.luminaires)[0].share;
  state_.albedo[kBehind] = kBodyAlbedo;
  state_.albedo_free[kBehind] = true;
  state_.free = {{false, false}, {false, false}};
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  ASSERT_EQ(parameters.size(), 1u);
  const Eigen::ArrayXd numeric = share * Predict(BodyPresence::kNone, parameters).jacobian.col(0);
  ExpectAsTheSurface("d_body against the surface in its place", bodies.d_body.array() / numeric);
}

TEST_F(RoomWithPanel, BodiesScaleTheJacobianAsTheyScaleTheLight) {
  state_.free = {{true, true, false, true}, {true, true}};
  state_.albedo_free.assign(4, true);
  state_.camera_scale_free = true;
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  const Prediction none = Predict(BodyPresence::kNone, parameters),
                   on = Predict(BodyPresence::kWhenOn, parameters);
  const Eigen::VectorXd left = on.value.cwiseQuotient(none.value);
  const Eigen::MatrixXd expected = left.asDiagonal() * Eigen::MatrixXd(none.jacobian);
  EXPECT_LT((on.jacobian - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
  EXPECT_EQ(on.direct, none.direct);
  EXPECT_LT(left.minCoeff(), 0.998);
}

// Data of bodies whose reflectance is one sigma off move the fluxes by what the body adds to their covariance.
TEST_F(RoomWithPanel, FluxesMoveByTheBodysShareOfTheirSigma) {
  FitLuminairesOptions options;
  options.start_is_near = true;
  options.initial_relative_sigma = options.min_relative_sigma;
  const auto fit_to = [&](BodyPresence bodies, const Eigen::VectorXd& values) {
    LightData data = data_;
    for (size_t i = 0; i < data.observations.size(); ++i)
      data.observations[i].relative_luminance = values[static_cast<Eigen::Index>(i)];
    data.readings.clear();
    LightState state = state_;
    state.bodies = bodies;
    return FitLuminaires(room_, data, state, {}, options);
  };
  const Prediction truth = Predict(BodyPresence::kWhenOn);
  const LuminaireFit fit = fit_to(BodyPresence::kWhenOn, truth.value),
                     moved = fit_to(BodyPresence::kWhenOn, truth.value + kBodyAlbedoSigma * truth.d_body),
                     without = fit_to(BodyPresence::kNone, Predict(BodyPresence::kNone).value);
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
  ASSERT_EQ(fit.parameters.size(), 2u);
  const Eigen::VectorXd move =
      PackParameters(moved.state, moved.parameters) - PackParameters(fit.state, fit.parameters);
  const double of_body = fit.covariance(0, 0) - without.covariance(0, 0);
  std::printf("panel's log flux: moves by %.5f, sigma %.5f, without bodies %.5f\n", move[0],
              std::sqrt(fit.covariance(0, 0)), std::sqrt(without.covariance(0, 0)));
  EXPECT_GT(std::abs(move[0]), 0.002);
  EXPECT_NEAR(std::sqrt(of_body), std::abs(move[0]), 0.08 * std::abs(move[0]));
}

}  // namespace
}  // namespace luxfit
