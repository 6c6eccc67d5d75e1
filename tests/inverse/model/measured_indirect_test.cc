#include "inverse/model/internal/measured_indirect.h"

#include <gtest/gtest.h>

#include "inverse/model/internal/light_model.h"
#include "tests/support/inverse/cube_photos.h"

namespace luxfit {
namespace {

// A closed room that is equally bright everywhere lights every white element as much as it is bright: rows of
// F sum to 1.
TEST(WithMeasuredIndirect, AnEvenRoomLightsItselfEvenly) {
  const Room cube = support::CubeRoom();
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  for (int e = 0; e < static_cast<int>(cube.patches.elements.size()); e += 3) {
    Observation o;
    o.element = e;
    o.relative_luminance = 0.2;
    data.observations.push_back(o);
  }
  const LightData measured = WithMeasuredIndirect(cube, data);
  EXPECT_TRUE(measured.indirect_is_held);
  ASSERT_EQ(measured.observations.size(), data.observations.size());
  for (const Observation& o : measured.observations) EXPECT_NEAR(o.relative_indirect, 0.2, 1e-3);
}

// The photos' closed form: indirect light is even, rho / (1 - rho) of what the lamp's flux is per area.
TEST(WithMeasuredIndirect, IsWhatTheClosedFormSays) {
  const Room cube = support::CubeRoom();
  const double rho = 0.5;
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  data.observations = support::CubePhotos(cube, {1.1, 0.9, 1.2}, Eigen::Vector3d::Constant(rho));
  data.readings.resize(1);
  const LightData measured = WithMeasuredIndirect(cube, data);
  EXPECT_TRUE(measured.readings.empty());
  double mean_white = 0, mean_own = 0, area = 0;
  for (const Observation& o : measured.observations) {
    const double a = cube.patches.elements[static_cast<size_t>(o.element)].area_m2;
    mean_white += a * o.relative_indirect;
    mean_own += a * o.relative_luminance;
    area += a;
  }
  // What the walls send out they get back.
  EXPECT_NEAR(mean_white / mean_own, 1, 5e-3);
  EXPECT_GT(area, 0);
}

// Held at the model's own indirect light, the short cut predicts what the whole model does.
TEST(WithModelledIndirect, PredictsWhatTheRadiosityDoes) {
  const Room cube = support::CubeRoom();
  LightData data;
  data.dimming = {Eigen::VectorXd::Constant(1, 0.7)};
  data.observations = support::CubePhotos(cube, {1.1, 0.9, 1.2}, Eigen::Vector3d::Constant(0.5));
  LightState light;
  light.luminaires.resize(1);
  light.luminaires[0].position = {0.8, 1.2, 1.1};
  light.luminaires[0].flux_lm = 300;
  light.free.resize(1);
  light.albedo = Eigen::VectorXd::Constant(1, 0.4);
  light.albedo_free = {true};
  light.camera_scale = 0.02;
  const auto predict = [&](const LightData& from) {
    LightModel model(cube, from);
    model.FreezeVisibility(light);
    return model.Predict(light, {}, false).value;
  };
  EXPECT_TRUE(predict(WithModelledIndirect(cube, data, light)).isApprox(predict(data), 1e-5));
}

}  // namespace
}  // namespace luxfit
