// Tests what a photo shows, in rooms where that is plain to see.
#include "inverse/advise/internal/photo_view.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numeric>

#include "inverse/advise/candidates.h"
#include "inverse/advise/internal/light_derivatives.h"
#include "inverse/model/internal/intervals/known_parameters.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

constexpr double kFocalPx = 400;

Camera PlainCamera() {
  Camera camera;
  camera.width_px = 640, camera.height_px = 480;
  camera.fx_px = camera.fy_px = kFocalPx;
  camera.cx_px = 319.5, camera.cy_px = 239.5;
  return camera;
}

Scene RoomWithTable() {
  Scene scene = support::ClosedRoom({4, 4, 2.5}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  support::AddBox(scene, {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(3, 3, 0.75)}, support::Facing::kOutward,
                  {"table"});
  return scene;
}

Luminaire Disc() {
  Luminaire lamp;
  lamp.id = "A";
  lamp.position = {2, 2, 2.4};
  lamp.shape = LuminaireShape::kDisc;
  lamp.size_m = {0.4, 0.4};
  lamp.flux_lm = 1000;
  return lamp;
}

std::vector<Parameter> PositionOf(const Room& room, const LightState& state) {
  std::vector<Parameter> parameters;
  for (const Parameter& p : FreeParameters(room, state)) {
    if (p.kind == ParameterKind::kLuminaire && static_cast<int>(p.quantity) < 3) parameters.push_back(p);
  }
  return parameters;
}

TEST(OutlineInformation, TellsTheCentreToAQuarterOfAPixel) {
  const Room room = MakeRoom(support::ClosedRoom({4, 4, 2.5}));
  const LightState state = AllFree(room, {Disc()}, Eigen::VectorXd::Constant(1, 0.5));
  const double distance_m = 1.6;
  const AdviceView below = ViewFrom("", {2, 2, 2.4 - distance_m}, {0, 0, 1}, PlainCamera());
  const Eigen::MatrixXd information =
      OutlineInformation(room, state, PositionOf(room, state), 0, below.camera, below.cam_from_world);
  ASSERT_EQ(information.rows(), 3);
  // Points of 1 px: sqrt(2 / 32) = 0.25 px along each axis, at the scale of the rim, cos^1.5 of its angle.
  const double tilt = std::atan(0.2 / distance_m), px_per_m = kFocalPx / distance_m;
  const double expected_m = 0.25 / px_per_m;
  EXPECT_NEAR(1 / std::sqrt(information(0, 0)), expected_m, 2 * tilt * tilt * expected_m);
  EXPECT_NEAR(information(0, 0), information(1, 1), 1e-6 * information(0, 0));
  // Growth by half a pixel is what depth looks like.
  EXPECT_LT(information(2, 2), 0.1 * information(0, 0));
}

TEST(OutlineInformation, WhatDoesNotShowTellsNothing) {
  const Room room = MakeRoom(RoomWithTable());
  const LightState state = AllFree(room, {Disc()}, Eigen::VectorXd::Constant(4, 0.5));
  const auto from = [&](const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) {
    const AdviceView view = ViewFrom("", eye, direction, PlainCamera());
    return OutlineInformation(room, state, PositionOf(room, state), 0, view.camera, view.cam_from_world)
        .size();
  };
  EXPECT_GT(from({2, 0.3, 1.6}, {0, 1.7, 0.8}), 0);
  EXPECT_EQ(from({2, 0.3, 1.6}, {0, -1, 0}), 0) << "looks the other way";
  EXPECT_EQ(from({2, 0.3, 1.6}, {0.75, 1, 0.5}), 0) << "at the picture's edge";
  EXPECT_EQ(from({2, 0.3, 2.45}, {0, 1, 0}), 0) << "from above";
}

TEST(VisibleElements, AreThoseInThePictureWithNothingBetween) {
  const Room room = MakeRoom(RoomWithTable());
  std::vector<int> all(room.patches.elements.size());
  std::iota(all.begin(), all.end(), 0);
  const AdviceView view = ViewFrom("", {0.5, 2, 1.2}, {1, 0, -0.3}, PlainCamera());
  int tops = 0, floors_behind = 0;
  for (const int i : VisibleElements(room, all, view.camera, view.cam_from_world)) {
    const Element& element = room.patches.elements[static_cast<size_t>(i)];
    EXPECT_GT((Eigen::Vector3d(0.5, 2, 1.2) - element.center).dot(element.normal), 0);
    tops += element.center.z() == 0.75 ? 1 : 0;
    // Behind the table, in its middle: the floor is hidden.
    floors_behind +=
        element.center.z() == 0 && element.center.x() > 3 && std::abs(element.center.y() - 2) < 0.5;
  }
  EXPECT_GT(tops, 100);
  EXPECT_EQ(floors_behind, 0);
}

TEST(Candidates, StandOnTheFloorAndReadWhatLiesBelow) {
  const Room room = MakeRoom(RoomWithTable());
  const std::vector<AdviceView> views = ViewsToTake(room, PlainCamera(), {});
  ASSERT_FALSE(views.empty());
  for (const AdviceView& view : views) {
    const Eigen::Vector3d eye = view.cam_from_world.inverse().translation();
    EXPECT_FALSE(eye.x() > 1 && eye.x() < 3 && eye.y() > 1 && eye.y() < 3) << eye.transpose();
    EXPECT_NEAR(eye.z(), kEyeHeightM, 1e-9);
  }
  int on_table = 0;
  for (const Sensor& place : PlacesToRead(room)) {
    EXPECT_GT(room.scene.Bounds().exteriorDistance(place.position + 0.01 * place.normal), -1e-9);
    on_table += std::abs(place.position.z() - 0.751) < 1e-6 && place.normal.z() > 0.9 ? 1 : 0;
  }
  EXPECT_EQ(on_table, 4) << "a grid of 1 m";
  SurveyedTag tag;
  tag.size_m = 0.15;
  tag.center_in_world = {0, 2, 1.5};
  tag.normal_in_world = {1, 0, 0};
  tag.up_in_world = {0, 0, 1};
  EXPECT_TRUE(ViewsToTake(room, PlainCamera(), {tag}).empty()) << "one tag places no view";
}

TEST(LightDerivatives, AreThoseOfFiniteDifferences) {
  const Room room = MakeRoom(support::ClosedRoom({4, 4, 2.5}));
  Luminaire other = Disc();
  other.id = "B";
  other.position = {1, 3, 2.4};
  const LightState state = AllFree(room, {Disc(), other}, Eigen::VectorXd::Constant(1, 0.5));
  const std::vector<Parameter> parameters = PositionOf(room, state);
  const std::vector<Sensor> sensors = {{{0.5, 1.5, 0.001}, {0, 0, 1}, {}}};
  const Eigen::Vector2d dimming(0.3, 1);
  const RelativeRow row = LightDerivatives(room, state, parameters, {}, sensors).OfSensor(0, dimming);
  ASSERT_EQ(row.derivative.size(), static_cast<Eigen::Index>(parameters.size()));
  const Eigen::VectorXd x = PackParameters(state, parameters);
  for (Eigen::Index p = 0; p < x.size(); ++p) {
    constexpr double kStepM = 0.01;
    double value[2];
    for (const int side : {0, 1}) {
      Eigen::VectorXd moved = x;
      moved[p] += side == 0 ? -kStepM : kStepM;
      const LightState shifted = WithParameters(state, parameters, moved);
      value[side] = LightDerivatives(room, shifted, parameters, {}, sensors).OfSensor(0, dimming).value;
    }
    const double expected = (value[1] - value[0]) / (2 * kStepM) / row.value;
    // Single precision of light, over a step of a centimetre.
    EXPECT_NEAR(row.derivative[p], expected, 2e-3 + 5e-3 * std::abs(expected)) << p;
  }
}

}  // namespace
}  // namespace luxfit
