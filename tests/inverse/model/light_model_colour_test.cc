#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <tuple>
#include <vector>

#include "inverse/model/internal/light_model.h"
#include "tests/support/closed_forms.h"
#include "tests/support/inverse/box_paths.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kFluxLm = 1000, kCameraScale = 0.02;
const Eigen::Vector3d kSize(3, 2.4, 2.5), kLamp(1.3, 1.4, 2.1), kWeights(0.265, 0.670, 0.065);
const Eigen::Vector3d kGreyWall(0.4, 0.4, 0.4), kRedFloor(0.8, 0.15, 0.1), kBlueCeiling(0.2, 0.5, 0.9);

const Eigen::Vector3d& AlbedoRgbFacing(const Eigen::Vector3d& normal) {
  if (normal.z() > 0.5) return kRedFloor;
  return normal.z() < -0.5 ? kBlueCeiling : kGreyWall;
}

// A downlight over a red floor, below a blue ceiling that only reflected light reaches.
class ColouredBox : public testing::Test {
 protected:
  ColouredBox() {
    rgb_.resize(3, 3);
    rgb_ << kGreyWall, kRedFloor, kBlueCeiling;
    state_.luminaires.resize(1);
    state_.luminaires[0].id = "A";
    state_.luminaires[0].position = kLamp;
    state_.luminaires[0].flux_lm = kFluxLm;
    state_.free.resize(1);
    state_.albedo = rgb_.transpose() * kWeights;
    state_.albedo_free = {false, false, false};
    state_.camera_scale = kCameraScale;
    data_.dimming = {Eigen::VectorXd::Ones(1)};
    data_.luminance_weights = kWeights;
    for (int material = 0; material < 3; ++material) ObserveMaterial(material);
    for (const Eigen::Vector3d& up : {Eigen::Vector3d(0, 0, 1), {0, 0, -1}, {1, 0, 0}})
      data_.readings.push_back({{{1.5, 1.0, 0.8}, up}, 0, 100, 1, true});
  }

  // Observes four elements, spread evenly over the material.
  void ObserveMaterial(int material) {
    std::vector<int> elements;
    for (int e = 0; e < static_cast<int>(room_.patches.elements.size()); ++e)
      if (room_.patches.PatchOf(e).material == material) elements.push_back(e);
    constexpr size_t kEach = 4;
    for (size_t i = 0; i < kEach; ++i) {
      Observation o;
      o.element = elements.at((2 * i + 1) * elements.size() / (2 * kEach));
      data_.observations.push_back(o);
    }
  }

  LightState Tinted(const Eigen::Matrix3Xd& tint) const {
    LightState state = state_;
    state.tint = tint;
    return state;
  }
  // Have a mean of 1 by the luminance's weights.
  Eigen::Matrix3Xd Tint() const { return rgb_ * state_.albedo.cwiseInverse().asDiagonal(); }

  Eigen::VectorXd Predicted(const LightState& state) const {
    LightModel model(room_, data_);
    model.FreezeVisibility(state);
    return model.Predict(state, {}, false).value;
  }

  Room room_ = MakeRoom(support::ClosedRoom(kSize, {"wall", "wall", "wall", "wall", "floor", "ceiling"}),
                        {{0.15, 0.15}, {64}});
  Eigen::Matrix3Xd rgb_;  // by material
  LightData data_;
  LightState state_;
};

struct PathEstimate {
  double value = 0, standard_error = 0;
};

// Returns sum_c weight_c E_c at a place, the light of each channel by paths: the mean over them of
// rho_c(x_1) ... rho_c(x_n) D(x_n), summed over n. The remainder after 20 reflections is below 1e-4.
PathEstimate PathLight(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, const Eigen::Vector3d& weight,
                       std::mt19937_64& rng) {
  constexpr int kPaths = 80000, kReflections = 20;
  std::uniform_real_distribution<double> unit;
  const auto direct_lx = [](const Eigen::Vector3d& at, const Eigen::Vector3d& facing) {
    return support::PointLx(kFluxLm, support::LambertianCdPerLm, kLamp, at, facing);
  };
  double sum = 0, squares = 0;
  for (int path = 0; path < kPaths; ++path) {
    Eigen::Vector3d at = p, facing = normal, carried = weight;
    double lx = 0;
    for (int reflection = 0; reflection < kReflections; ++reflection) {
      const double radial = unit(rng), azimuthal = unit(rng);
      std::tie(at, facing) = support::HitBox(kSize, at, support::CosineWeighted(facing, radial, azimuthal));
      carried = carried.cwiseProduct(AlbedoRgbFacing(facing));
      lx += carried.sum() * direct_lx(at, facing);
    }
    sum += lx;
    squares += lx * lx;
  }
  const double mean = sum / kPaths;
  return {weight.sum() * direct_lx(p, normal) + mean, std::sqrt((squares / kPaths - mean * mean) / kPaths)};
}

TEST_F(ColouredBox, TheLightIsThatOfThreeGreyRooms) {
  ASSERT_EQ(room_.scene.materials, (std::vector<std::string>{"wall", "floor", "ceiling"}));
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data_.observations.size()) + 3);
  for (Eigen::Index c = 0; c < 3; ++c) {
    LightState grey = state_;
    grey.albedo = rgb_.row(c).transpose();
    expected += kWeights[c] * Predicted(grey);
  }
  const Eigen::VectorXd found = Predicted(Tinted(Tint()));
  ASSERT_EQ(found.size(), expected.size());
  for (Eigen::Index i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i] / expected[i], 1, 1e-5) << i;  // floats
}

TEST_F(ColouredBox, NeutralTintsChangeNothing) {
  const Eigen::VectorXd grey = Predicted(state_), neutral = Predicted(Tinted(Eigen::Matrix3Xd::Ones(3, 3)));
  for (Eigen::Index i = 0; i < grey.size(); ++i) EXPECT_NEAR(neutral[i] / grey[i], 1, 1e-6) << i;
}

// Channels that another model factored serve reflectances up to 0.002 away: what colours do to the light changes by less
// than a tenth of the 1 % by which views differ. Farther away, and for other tints, they are factored anew.
TEST_F(ColouredBox, ChannelsOfAnotherModelServeNearbyReflectances) {
  LightModel first(room_, data_);
  first.FreezeVisibility(Tinted(Tint()));
  const auto with_those_of_first = [&](const LightState& state) {
    LightModel model(room_, data_);
    model.TakeOver(first.frozen());
    model.RefreezeVisibility(state);
    EXPECT_EQ(model.frozen().channels == first.frozen().channels,
              (state.albedo - state_.albedo).norm() < 0.002 && state.tint == Tint());
    return model.Predict(state, {}, false).value;
  };
  EXPECT_EQ(with_those_of_first(Tinted(Tint())), Predicted(Tinted(Tint())));
  LightState other = Tinted(Tint());
  other.albedo[1] += 0.05;
  EXPECT_EQ(with_those_of_first(other), Predicted(other));
  other = Tinted((Tint().array() + 1) / 2);
  EXPECT_EQ(with_those_of_first(other), Predicted(other));
  other = Tinted(Tint());
  other.albedo[1] += 0.0015;
  const Eigen::VectorXd served = with_those_of_first(other), anew = Predicted(other);
  for (Eigen::Index i = 0; i < served.size(); ++i) EXPECT_NEAR(served[i] / anew[i], 1, 1e-3) << i;
}

// Tolerance: four standard errors of the paths (0.9 % of the light at most), and 0.5 % for patches of 0.15 m that send
// light evenly. On the ceiling, light as luminance alone is 12 to 14 % too much: red light meets a blue surface.
TEST_F(ColouredBox, TheLightIsThatOfPathsInEachChannel) {
  std::mt19937_64 rng = support::TestRng();
  const Eigen::VectorXd tinted = Predicted(Tinted(Tint())), grey = Predicted(state_);
  int on_ceiling = 0;
  const auto expect_near_paths = [&](Eigen::Index row, const PathEstimate& paths) {
    const double tolerance = 4 * paths.standard_error / paths.value + 0.005;
    std::printf("row %2d: tinted %+.2f %%, grey %+.2f %%, tolerance %.2f %%\n", static_cast<int>(row),
                100 * (tinted[row] / paths.value - 1), 100 * (grey[row] / paths.value - 1), 100 * tolerance);
    EXPECT_NEAR(tinted[row] / paths.value, 1, tolerance) << row;
    EXPECT_LT(tolerance, 0.015) << row << ": too noisy for the test to tell";
    return tolerance;
  };
  const auto observations = static_cast<Eigen::Index>(data_.observations.size());
  for (Eigen::Index i = 0; i < observations; ++i) {
    const Element& element =
        room_.patches.elements[static_cast<size_t>(data_.observations[static_cast<size_t>(i)].element)];
    const Eigen::Vector3d weight =
        kCameraScale / support::kPi * kWeights.cwiseProduct(AlbedoRgbFacing(element.normal));
    const PathEstimate paths = PathLight(element.center, element.normal, weight, rng);
    const double tolerance = expect_near_paths(i, paths);
    if (element.normal.z() > -0.5) continue;
    ++on_ceiling;
    EXPECT_GT(grey[i] / paths.value - 1, 3 * tolerance) << i;
  }
  EXPECT_EQ(on_ceiling, 4);
  for (size_t r = 0; r < data_.readings.size(); ++r) {
    const Sensor& sensor = data_.readings[r].sensor;
    expect_near_paths(observations + static_cast<Eigen::Index>(r),
                      PathLight(sensor.position, sensor.normal, kWeights, rng));
  }
}

}  // namespace
}  // namespace luxfit
