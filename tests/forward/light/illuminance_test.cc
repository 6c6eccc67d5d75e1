#include "forward/light/illuminance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "forward/direct/direct_light.h"
#include "forward/luminaire/photometry.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A room with a screen standing in it. Lamps keep 0.6 m from everything and are no larger than 0.2 m: the
// order of their quadrature (forward/direct/direct_light.h) is then the same for every receiver, before and after a
// step.
class RoomWithScreen : public testing::Test {
 protected:
  RoomWithScreen() : room_(MakeRoom(RoomScene(), {{0.5, 0.25}, {64}})) {
    lamps_.resize(2);
    lamps_[0].position = Eigen::Vector3d(0.9, 1.1, 1.6);
    lamps_[0].aim = Eigen::Vector3d(0.2, -0.1, -1).normalized();
    lamps_[0].distribution = Distribution::kCosinePower;  // cos^3 has no kink at its horizon
    lamps_[0].cosine_exponent = 3;
    lamps_[0].shape = LuminaireShape::kRectangle;
    lamps_[0].size_m = {0.2, 0.15};
    lamps_[1].position = Eigen::Vector3d(2.3, 1.3, 1.5);
    lamps_[1].distribution = Distribution::kIsotropic;
    std::vector<int> elements;
    for (int e = 0; e < static_cast<int>(room_.patches.elements.size()); e += 7) elements.push_back(e);
    receivers_ = MakeReceivers(
        room_, elements,
        {{{0.5, 0.5, 0.01}, {0, 0, 1}}, {{2.5, 1.5, 0.01}, {0, 0, 1}}, {{2, 1.9, 1}, {0, -1, 0}}});
    visibility_ = ComputeVisibility(room_, receivers_, lamps_);
  }

  static Scene RoomScene() {
    Scene scene = support::ClosedRoom({3.2, 2.2, 2.4}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
    support::AddBox(scene, {Eigen::Vector3d(1.55, 0.6, 0.2), Eigen::Vector3d(1.65, 1.6, 1.2)},
                    support::Facing::kOutward, {"screen"});
    return scene;
  }

  Illuminance Compute(const std::vector<Luminaire>& lamps, const Eigen::VectorXd& albedo,
                      const DerivativeRequest& request = {}) const {
    return ComputeIlluminance(room_, receivers_, visibility_, lamps, albedo, request);
  }

  Room room_;
  std::vector<Luminaire> lamps_;
  Receivers receivers_;
  LuminaireVisibility visibility_;
  const Eigen::VectorXd albedo_ = Eigen::Vector4d(0.6, 0.25, 0.8, 0.4);
};

// Step 0.01 (m, rad): truncation (h / d)^2 = 3e-4 at d = 0.6 m, a few times that for 1 / r^2; float rounding
// of the values 1e-6 / h = 1e-4. Of the largest derivative in the column, because small ones are differences
// of large ones.
constexpr double kStep = 0.01, kTolerance = 3e-3;

struct QuantityCase {
  LuminaireQuantity quantity;
  std::string name;
  std::function<void(Luminaire&, double)> change;
};

std::vector<QuantityCase> AllQuantities() {
  const auto tilt = [](Luminaire& lamp, double along, double across) {
    const LuminaireAxes axes = AxesOf(lamp);
    lamp.aim = (lamp.aim + along * axes.along + across * axes.across).normalized();
    lamp.heading = axes.along;
  };
  using Q = LuminaireQuantity;
  return {{Q::kPositionX, "x", [](Luminaire& l, double h) { l.position.x() += h; }},
          {Q::kPositionY, "y", [](Luminaire& l, double h) { l.position.y() += h; }},
          {Q::kPositionZ, "z", [](Luminaire& l, double h) { l.position.z() += h; }},
          {Q::kExponent, "exponent", [](Luminaire& l, double h) { l.cosine_exponent += h; }},
          {Q::kSizeAlong, "size along", [](Luminaire& l, double h) { l.size_m[0] += h; }},
          {Q::kSizeAcross, "size across", [](Luminaire& l, double h) { l.size_m[1] += h; }},
          {Q::kTiltAlong, "tilt along", [tilt](Luminaire& l, double h) { tilt(l, h, 0); }},
          {Q::kTiltAcross, "tilt across", [tilt](Luminaire& l, double h) { tilt(l, 0, h); }}};
}

TEST_F(RoomWithScreen, PreparedReceiversSeeTheSame) {
  DerivativeRequest request;
  request.parameters = {{0, LuminaireQuantity::kPositionX}, {1, LuminaireQuantity::kPositionZ}};
  request.materials = {2, 0};
  const Illuminance through = Compute(lamps_, albedo_, request);
  PrepareGather(room_, receivers_);
  const Illuminance prepared = Compute(lamps_, albedo_, request);
  const auto expect_same = [](const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
    ASSERT_GT(a.size(), 0);
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 2e-6 * a.cwiseAbs().maxCoeff());
  };
  expect_same(through.total, prepared.total);
  expect_same(through.direct, prepared.direct);
  expect_same(through.d_luminaire, prepared.d_luminaire);
  expect_same(through.d_albedo, prepared.d_albedo);
}

TEST_F(RoomWithScreen, DerivativesOfALuminaireAreCentralDifferences) {
  DerivativeRequest request;
  for (const QuantityCase& c : AllQuantities()) request.parameters.push_back({0, c.quantity});
  const Illuminance light = Compute(lamps_, albedo_, request);
  for (size_t i = 0; i < AllQuantities().size(); ++i) {
    const QuantityCase c = AllQuantities()[i];
    std::vector<Luminaire> up = lamps_, down = lamps_;
    c.change(up[0], kStep);
    c.change(down[0], -kStep);
    const Eigen::VectorXf numeric =
        (Compute(up, albedo_).total.col(0) - Compute(down, albedo_).total.col(0)) /
        static_cast<float>(2 * kStep);
    const Eigen::VectorXf error = light.d_luminaire.col(static_cast<Eigen::Index>(i)) - numeric;
    // Sizes act in the second order only (the light of a small lamp is that of its middle): their derivatives
    // are a hundredth of the light, so float rounding of the light, 1e-6 / h, counts.
    const double rounding = 1e-4 * light.total.col(0).maxCoeff();
    EXPECT_LT(error.cwiseAbs().maxCoeff(), kTolerance * numeric.cwiseAbs().maxCoeff() + rounding) << c.name;
    EXPECT_GT(numeric.cwiseAbs().maxCoeff(), 10 * rounding) << c.name << ": nothing to compare";
  }
}

// A measured lobe that is four times as strong along C0 as along C180, linear in C between them: kinks at two
// planes only, so that a step of 1 mrad meets few of them; float rounding of the light is then 1e-6 / 1e-3.
TEST_F(RoomWithScreen, TheDerivativeOfAHeadingIsACentralDifference) {
  const double pi = 3.14159265358979323846;
  lamps_[0].distribution = Distribution::kMeasured;
  lamps_[0].table = std::make_shared<IntensityTable>(
      Normalized(ExpandPlanes({0, pi}, {0, pi / 4, pi / 2}, {2, 4, 1, 2, 1, 0.25}, PlaneSymmetry::kC0C180)));
  DerivativeRequest request;
  request.parameters = {{0, LuminaireQuantity::kHeading}};
  const Illuminance light = Compute(lamps_, albedo_, request);
  constexpr double kTurn = 1e-3;
  const LuminaireAxes axes = AxesOf(lamps_[0]);
  std::vector<Luminaire> up = lamps_, down = lamps_;
  up[0].heading = std::cos(kTurn) * axes.along + std::sin(kTurn) * axes.across;
  down[0].heading = std::cos(kTurn) * axes.along - std::sin(kTurn) * axes.across;
  const Eigen::VectorXf numeric = (Compute(up, albedo_).total.col(0) - Compute(down, albedo_).total.col(0)) /
                                  static_cast<float>(2 * kTurn);
  const double largest = numeric.cwiseAbs().maxCoeff(), rounding = 1e-3 * light.total.col(0).maxCoeff();
  EXPECT_LT((light.d_luminaire.col(0) - numeric).cwiseAbs().maxCoeff(), kTolerance * largest + rounding);
  EXPECT_GT(largest, 100 * rounding);
}

TEST_F(RoomWithScreen, DerivativesOfReflectancesAreCentralDifferences) {
  DerivativeRequest request;
  request.materials = {3, 0, 2, 1};  // an order of the caller's own
  const Illuminance light = Compute(lamps_, albedo_, request);
  for (size_t m = 0; m < request.materials.size(); ++m) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(4, request.materials[m]);
    const Eigen::MatrixXf numeric =
        (Compute(lamps_, albedo_ + step).total - Compute(lamps_, albedo_ - step).total) /
        static_cast<float>(2 * kStep);
    for (Eigen::Index k = 0; k < 2; ++k) {
      const Eigen::VectorXf analytic = light.d_albedo.col(k * 4 + static_cast<Eigen::Index>(m));
      // The screen's own light is small: float rounding of the whole, as above.
      const double tolerance = kTolerance * numeric.col(k).maxCoeff() + 1e-4 * light.total.col(k).maxCoeff();
      EXPECT_LT((analytic - numeric.col(k)).cwiseAbs().maxCoeff(), tolerance)
          << "material " << request.materials[m];
    }
  }
}

TEST_F(RoomWithScreen, DirectLightIsTheVisibleShareOfTheOpenLight) {
  const Illuminance light = Compute(lamps_, albedo_);
  int shadowed = 0;
  for (int r = 0; r < receivers_.count(); ++r) {
    const Sensor& place = receivers_.points[static_cast<size_t>(r)];
    for (int k = 0; k < 2; ++k) {
      const double open =
          DirectIlluminancePerLumen(lamps_[static_cast<size_t>(k)], place.position, place.normal).lx_per_lm;
      EXPECT_NEAR(light.direct(r, k), visibility_.receivers(r, k) * open, 1e-6 * open);  // float rounding
      shadowed += open > 0 && visibility_.receivers(r, k) == 0;
    }
  }
  EXPECT_GT(shadowed, 0);  // the screen does stand in the way
}

TEST_F(RoomWithScreen, BlackWallsReflectNothing) {
  const Illuminance light = Compute(lamps_, Eigen::VectorXd::Zero(4));
  EXPECT_EQ(light.total, light.direct);
  EXPECT_GT((Compute(lamps_, albedo_).total - light.total).minCoeff(), 0);
}

TEST(Illuminance, OfAnEmptySceneIsDirect) {
  const Room room = MakeRoom(Scene{});
  const Receivers receivers = MakeReceivers(room, {}, {{{0, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 0, 1}}});
  Luminaire lamp;
  lamp.position = Eigen::Vector3d(0, 0, 2);
  DerivativeRequest request;
  request.parameters = {{0, LuminaireQuantity::kPositionZ}};
  const LuminaireVisibility visibility = ComputeVisibility(room, receivers, {lamp});
  const Illuminance light = ComputeIlluminance(room, receivers, visibility, {lamp}, {}, request);
  EXPECT_EQ(light.total, light.direct);
  const double pi = 3.14159265358979323846;
  EXPECT_NEAR(light.total(0, 0), 1 / (4 * pi), 1e-6);         // cos / pi / h^2, in floats
  EXPECT_NEAR(light.total(1, 0), 4. / 5 / (5 * pi), 1e-6);    // cos^2 / pi / r^2
  EXPECT_NEAR(light.d_luminaire(0, 0), -2 / (8 * pi), 1e-6);  // d(h^-2 / pi) / dh
}

// In a penumbra the motion of the shadow's edge is most of the change.
TEST_F(RoomWithScreen, MovingShadowsAreThoseOfARoomComputedAnew) {
  Luminaire panel;
  panel.position = {0.7, 1.1, 2.2};
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {0.8, 0.5};
  // On the floor behind the screen, whose top at x = 1.65, z = 1.2 hides the panel's parts beyond its line of
  // sight.
  const Receivers sensors =
      MakeReceivers(room_, {}, {{{2.6, 1.1, 0.01}, {0, 0, 1}}, {{2.4, 1.1, 0.01}, {0, 0, 1}}});
  const auto compute = [&](const Luminaire& lamp, const DerivativeRequest& request) {
    return ComputeIlluminance(room_, sensors, ComputeVisibility(room_, sensors, {lamp}), {lamp}, albedo_,
                              request);
  };
  DerivativeRequest request;
  request.parameters = {{0, LuminaireQuantity::kPositionX}, {0, LuminaireQuantity::kPositionZ}};
  const Illuminance frozen = compute(panel, request);
  request.moving_shadows = true;
  const Illuminance moving = compute(panel, request);
  const float open_lx =
      static_cast<float>(DirectIlluminancePerLumen(panel, {2.5, 1.1, 0.01}, {0, 0, 1}).lx_per_lm);
  int partly = 0;
  for (int parameter = 0; parameter < 2; ++parameter) {
    // 4 cm each way: shares are found to 1 / 64 of the panel, so the quotient to open / 64 / 8 cm.
    constexpr double kMove = 0.04;
    Luminaire up = panel, down = panel;
    up.position[parameter == 0 ? 0 : 2] += kMove;
    down.position[parameter == 0 ? 0 : 2] -= kMove;
    const Eigen::VectorXf slope = (compute(up, {}).total - compute(down, {}).total).col(0) / (2 * kMove);
    for (Eigen::Index r = 0; r < 2; ++r) {
      EXPECT_NEAR(moving.d_luminaire(r, parameter), slope[r], open_lx / 64 / (2 * kMove))
          << r << " " << parameter;
      partly +=
          std::abs(frozen.d_luminaire(r, parameter) - slope[r]) > 2 * open_lx / 64 / (2 * kMove) ? 1 : 0;
    }
  }
  EXPECT_GT(partly, 0);  // with visibility held the derivative is another
}

}  // namespace
}  // namespace luxfit
