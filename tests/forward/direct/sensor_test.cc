#include "forward/direct/sensor.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "forward/direct/internal/sensor_rows.h"
#include "forward/light/illuminance.h"
#include "forward/light/room.h"
#include "tests/support/closed_forms.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using support::kPi;

const Eigen::Vector3d kAxis = Eigen::Vector3d(0.2, -0.3, 0.9).normalized();

// What a good meter with a flat diffuser reads, in per cent of the cosine: a few below at 60 degrees, a sixth
// at 80; in the form of the makers' f2 sheets.
SensorResponse MeterCurve() {
  std::vector<double> angle_rad, relative;
  const double of_cosine[] = {1, 1.003, 1.004, 1.001, 0.995, 0.985, 0.967, 0.93, 0.83};
  for (int i = 0; i < 9; ++i) {
    angle_rad.push_back(i * kPi / 18);
    relative.push_back(of_cosine[i] * std::cos(angle_rad.back()));
  }
  return TableResponse(angle_rad, relative);
}

SensorResponse CosineTable() {
  std::vector<double> angle_rad, relative;
  for (int i = 0; i <= 6; ++i) {
    angle_rad.push_back(i * kPi / 12);
    relative.push_back(std::max(0.0, 2 * std::cos(angle_rad.back())));  // made relative by the reader
  }
  return TableResponse(angle_rad, relative);
}

SensorResponse ResponseOf(ResponseKind kind) {
  if (kind == ResponseKind::kTable) return MeterCurve();
  SensorResponse response;
  response.kind = kind;
  response.facing = {0.8, 0.5, 0.1};
  return response;
}

// int f(d) w(d) dOmega by the midpoint rule.
template <typename Function>
double SphereIntegral(const Sensor& sensor, const Function& f) {
  constexpr int kPolar = 600, kAzimuth = 600;
  double sum = 0;
  for (int i = 0; i < kPolar; ++i) {
    const double theta = (i + 0.5) * kPi / kPolar;
    for (int j = 0; j < kAzimuth; ++j) {
      const double phi = (j + 0.5) * 2 * kPi / kAzimuth;
      const Eigen::Vector3d d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                              std::cos(theta));
      sum += f(d) * WeightOf(sensor, d).value * std::sin(theta);
    }
  }
  return sum * 2 * kPi * kPi / (kPolar * kAzimuth);
}

class EveryResponse : public testing::TestWithParam<ResponseKind> {
 protected:
  Sensor SensorAt(const Eigen::Vector3d& p, const Eigen::Vector3d& normal = kAxis) const {
    return {p, normal, ResponseOf(GetParam())};
  }
};
INSTANTIATE_TEST_SUITE_P(Kinds, EveryResponse,
                         testing::Values(ResponseKind::kCosine, ResponseKind::kTable,
                                         ResponseKind::kCylindrical, ResponseKind::kSemicylindrical,
                                         ResponseKind::kSpherical));

TEST_P(EveryResponse, AUniformLuminanceGivesPiL) {
  const Sensor sensor = SensorAt({0, 0, 0});
  // 1e-4: the midpoint rule over the kink at the horizon.
  const double expected = GetParam() == ResponseKind::kTable ? kPi * SampleResponse(sensor, 1).total : kPi;
  EXPECT_NEAR(SphereIntegral(sensor, [](const Eigen::Vector3d&) { return 1.0; }), expected, 1e-4 * expected);
  if (GetParam() == ResponseKind::kTable) {
    EXPECT_LT(SampleResponse(sensor, 1).total, 0.995);  // this meter reads a diffuse field too low
  }
}

TEST_P(EveryResponse, RaysAreDistributedAsTheWeight) {
  const Sensor sensor = SensorAt({0, 0, 0});
  const auto f = [](const Eigen::Vector3d& d) {
    return 1 + d.x() + d.y() * d.y() + std::exp(d.z() - 0.5 * d.x());
  };
  const SensorRays rays = SampleResponse(sensor, 16384);
  double sum = 0;
  for (Eigen::Index k = 0; k < rays.directions.cols(); ++k) {
    EXPECT_NEAR(rays.directions.col(k).norm(), 1, 1e-12);
    sum += f(rays.directions.col(k));
  }
  const double expected = SphereIntegral(sensor, f) / kPi;
  // Evenly spread points on a smooth function: far better than the 1 / sqrt(n) = 0.8 % of random ones.
  EXPECT_NEAR(rays.total * sum / static_cast<double>(rays.directions.cols()), expected, 3e-4 * expected);
}

TEST_P(EveryResponse, WeightDerivativesAreCentralDifferences) {
  const Sensor sensor = SensorAt({0, 0, 0});
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(0.6, 0.2, 0.7), Eigen::Vector3d(-0.5, 0.4, 0.5)}) {
    const Eigen::Vector3d d = direction.normalized();
    const DirectionWeight weight = WeightOf(sensor, d);
    EXPECT_NEAR(weight.d_direction.dot(d), 0, 1e-12);
    for (const Eigen::Vector3d& t : {d.unitOrthogonal().eval(), d.cross(d.unitOrthogonal()).eval()}) {
      constexpr double kStep = 1e-5;
      const double numeric = (WeightOf(sensor, (d + kStep * t).normalized()).value -
                              WeightOf(sensor, (d - kStep * t).normalized()).value) /
                             (2 * kStep);
      EXPECT_NEAR(weight.d_direction.dot(t), numeric, 1e-8);  // kStep^2 times a third derivative
    }
  }
}

// An isotropic point of 4 pi lm has 1 cd.
TEST_P(EveryResponse, APointSourceGivesItsWeightOverTheSquareOfTheDistance) {
  const Sensor sensor = SensorAt({1, 2, 0.5}, {0, 0, 1});
  Luminaire lamp;
  lamp.distribution = Distribution::kIsotropic;
  const double angle = 0.7, azimuth = 0.4, r = 2.3;
  lamp.position = sensor.position + r * Eigen::Vector3d(std::sin(angle) * std::cos(azimuth),
                                                        std::sin(angle) * std::sin(azimuth), std::cos(angle));
  const double facing = std::atan2(0.5, 0.8);  // of ResponseOf
  double weight = std::cos(angle);
  if (GetParam() == ResponseKind::kTable) {  // between 40 and 50 degrees
    const double share = (angle - 4 * kPi / 18) / (kPi / 18);
    weight +=
        (1 - share) * (0.995 - 1) * std::cos(4 * kPi / 18) + share * (0.985 - 1) * std::cos(5 * kPi / 18);
  }
  if (GetParam() == ResponseKind::kCylindrical) weight = std::sin(angle) / kPi;
  if (GetParam() == ResponseKind::kSemicylindrical)
    weight = std::sin(angle) * (1 + std::cos(azimuth - facing)) / kPi;
  if (GetParam() == ResponseKind::kSpherical) weight = 0.25;
  EXPECT_NEAR(4 * kPi * SensorIlluminancePerLumen(lamp, sensor).lx_per_lm, weight / (r * r), 1e-12);
}

TEST_P(EveryResponse, DirectDerivativesAreCentralDifferences) {
  const Sensor sensor = SensorAt({1, 2, 0.5});
  Luminaire lamp;
  lamp.position = {1.8, 1.1, 2.6};
  lamp.aim = Eigen::Vector3d(-0.1, 0.2, -1).normalized();
  lamp.heading = {0.3, 1, 0};
  lamp.distribution = Distribution::kCosinePower;
  lamp.cosine_exponent = 1.7;
  lamp.shape = LuminaireShape::kRectangle;
  lamp.size_m = {0.6, 0.3};
  const DirectIlluminance direct = SensorIlluminancePerLumen(lamp, sensor);
  const double scale = direct.lx_per_lm;
  constexpr double kStep = 1e-4,
                   kTolerance = 1e-5;  // of the value per m or rad: kStep^2 and the table's kinks
  const auto numeric = [&](auto change) {
    Luminaire plus = lamp, minus = lamp;
    change(plus, kStep);
    change(minus, -kStep);
    return (SensorIlluminancePerLumen(plus, sensor).lx_per_lm -
            SensorIlluminancePerLumen(minus, sensor).lx_per_lm) /
           (2 * kStep);
  };
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(direct.d_position[axis], numeric([&](Luminaire& l, double h) { l.position[axis] += h; }),
                kTolerance * scale);
  }
  for (int side = 0; side < 2; ++side) {
    EXPECT_NEAR(direct.d_size[side], numeric([&](Luminaire& l, double h) { l.size_m[side] += h; }),
                kTolerance * scale);
  }
  EXPECT_NEAR(direct.d_exponent, numeric([](Luminaire& l, double h) { l.cosine_exponent += h; }),
              kTolerance * scale);
  const LuminaireAxes axes = AxesOf(lamp);
  EXPECT_NEAR(direct.d_tilt[0], numeric([&](Luminaire& l, double h) {
                const Eigen::AngleAxisd turn(h, axes.across);  // takes the aim towards along
                l.aim = turn * lamp.aim;
                l.heading = turn * axes.along;
              }),
              kTolerance * scale);
  EXPECT_NEAR(direct.d_heading, numeric([&](Luminaire& l, double h) {
                l.heading = std::cos(h) * axes.along + std::sin(h) * axes.across;
              }),
              kTolerance * scale);
}

// Form factors against quadrature over each patch of the ceiling.
TEST_P(EveryResponse, FormFactorsAreTheIntegralsOverPatches) {
  const Scene scene = support::ClosedRoom({3, 2, 2.5});
  const RayScene rays(scene);
  const Patches patches = Subdivide(scene, rays, {1, 0.5});
  const Sensor sensor = SensorAt({1.3, 0.8, 0.9});
  const Eigen::VectorXf row = SensorFormFactors(rays, patches, sensor);
  EXPECT_NEAR(row.sum(), SampleResponse(sensor, 1).total, 1e-5);  // float rounding; 1 but for the table
  for (size_t j = 0; j < patches.patches.size(); ++j) {
    const Patch& patch = patches.patches[j];
    const double factor = row.segment(patch.first_element, patch.element_count).sum();
    double expected = 0;
    constexpr int kSide = 60;
    for (int e = patch.first_element; e < patch.first_element + patch.element_count; ++e) {
      const Element& element = patches.elements[static_cast<size_t>(e)];
      for (int k = 0; k < kSide * kSide; ++k) {
        const Eigen::Vector3d at = element.origin + (k % kSide + 0.5) / kSide * element.edge_u +
                                   (std::floor(k / kSide) + 0.5) / kSide * element.edge_v;
        const Eigen::Vector3d to = at - sensor.position;
        expected += element.area_m2 / (kSide * kSide) * WeightOf(sensor, to.normalized()).value *
                    -element.normal.dot(to) / std::pow(to.norm(), 3) / kPi;
      }
    }
    // Two standard deviations of random rays for every patch: even ones are better.
    EXPECT_NEAR(factor, expected, 2 * std::sqrt(expected / 16384)) << j;
  }
}

TEST(Sensor, RowsOfManySensorsAreThoseOfEach) {
  const Scene scene = support::ClosedRoom({3, 2, 2.5});
  const RayScene rays(scene);
  const Patches patches = Subdivide(scene, rays, {1, 0.5});
  SensorResponse half, other_half, round;
  half.kind = other_half.kind = ResponseKind::kSemicylindrical;
  other_half.facing = {0, -1, 0};  // sampled alike, but turned
  round.kind = ResponseKind::kSpherical;
  std::vector<Sensor> sensors;
  for (const SensorResponse& response :
       {SensorResponse(), half, other_half, round, MeterCurve(), SensorResponse()}) {
    const double shift = 0.1 * static_cast<double>(sensors.size());
    sensors.push_back({{1.3 + shift, 0.8, 0.9}, {0, 0, 1}, response});
  }
  constexpr int kRays = 1000;
  const SensorRowMatrix rows = SensorRows(rays, patches, sensors, kRays);
  ASSERT_EQ(rows.rows(), static_cast<Eigen::Index>(sensors.size()));
  for (size_t i = 0; i < sensors.size(); ++i) {
    const Eigen::VectorXf row = rows.row(static_cast<Eigen::Index>(i)).transpose();
    EXPECT_EQ(row, SensorFormFactors(rays, patches, sensors[i], kRays)) << i;
  }
  EXPECT_EQ(SensorRows(rays, patches, {}, kRays).rows(), 0);
}

TEST(TableResponse, OfTheCosineIsTheCosine) {
  const Sensor cosine{{0, 0, 0}, kAxis, {}}, table{{0, 0, 0}, kAxis, CosineTable()};
  for (int k = 0; k < 100; ++k) {
    const Eigen::Vector3d d =
        Eigen::Vector3d(std::sin(k), std::cos(1.7 * k), std::sin(2.3 * k + 1)).normalized();
    EXPECT_NEAR(WeightOf(table, d).value, WeightOf(cosine, d).value, 1e-12);
    EXPECT_NEAR((WeightOf(table, d).d_direction - WeightOf(cosine, d).d_direction).norm(), 0, 1e-9);
  }
  EXPECT_NEAR(SampleResponse(table, 1).total, 1, 1e-9);
  const SensorRays a = SampleResponse(cosine, 1000), b = SampleResponse(table, 1000);
  EXPECT_NEAR((a.directions - b.directions).cwiseAbs().maxCoeff(), 0,
              1e-3);  // 2048 cells of the quantile table
}

TEST(TableResponse, PastItsEndTheRatioToTheCosineIsHeldUpToTheHorizon) {
  const Sensor meter{{0, 0, 0}, {0, 0, 1}, MeterCurve()};  // ends at 80 degrees with 0.83
  const auto weight = [&](double angle_deg) {
    const double a = angle_deg * kPi / 180;
    return WeightOf(meter, {std::sin(a), 0, std::cos(a)}).value;
  };
  EXPECT_NEAR(weight(85), 0.83 * std::cos(85 * kPi / 180), 1e-12);
  EXPECT_EQ(weight(95), 0);
  const Sensor dome{{0, 0, 0}, {0, 0, 1}, TableResponse({0, kPi / 2, 1.8}, {1, 0.05, 0.01})};
  EXPECT_NEAR(WeightOf(dome, {1, 0, 0}).value, 0.05, 1e-12);
  EXPECT_GT(WeightOf(dome, {std::sin(1.7), 0, std::cos(1.7)}).value, 0.01);
  EXPECT_EQ(WeightOf(dome, {std::sin(1.9), 0, std::cos(1.9)}).value, 0);
}

TEST(TableResponse, RefusesWhatIsNoCurve) {
  EXPECT_THROW(TableResponse({0}, {1}), std::invalid_argument);
  EXPECT_THROW(TableResponse({0.1, 1}, {1, 0}), std::invalid_argument);
  EXPECT_THROW(TableResponse({0, 1, 1}, {1, 0.5, 0}), std::invalid_argument);
  EXPECT_THROW(TableResponse({0, 1}, {1, -0.1}), std::invalid_argument);
  EXPECT_THROW(TableResponse({0, 1}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(TableResponse({0, 4}, {1, 0}), std::invalid_argument);
  EXPECT_THROW(TableResponse({0, 1}, {1}), std::invalid_argument);
}

TEST(Sensor, ABackIsBlack) {
  Scene scene = support::ClosedRoom({3, 2, 2.5});
  support::AddParallelogram(scene, {0, 0, 2}, {3, 0, 0}, {0, 2, 0}, "shelf");  // faces up
  const RayScene rays(scene);
  const Patches patches = Subdivide(scene, rays, {1, 0.5});
  const Eigen::Vector3d p(1.5, 1, 1);
  const Eigen::VectorXf row = SensorFormFactors(rays, patches, {p, {0, 0, 1}, {}});
  // What is not shelf; sampled with 16384 rays.
  EXPECT_NEAR(row.sum(), 1 - support::RectangleFactor({1.5, 1, 2}, 3, 2, p), 2 * std::sqrt(0.25 / 16384));
}

TEST(Sensor, ACylinderSeesTheLampBehindItAndAScreenHidesIt) {
  Scene scene = support::ClosedRoom({4, 4, 3});
  support::AddParallelogram(scene, {2.5, 1, 0}, {0, 2, 0}, {0, 0, 3}, "screen");
  const RayScene rays(scene);
  SensorResponse cylinder;
  cylinder.kind = ResponseKind::kCylindrical;
  const Sensor sensor{{1.5, 2, 1.2}, {0, 0, 1}, cylinder};
  Luminaire lamp;
  lamp.shape = LuminaireShape::kRectangle;
  lamp.size_m = {0.6, 0.6};
  lamp.position = {1, 2, 0.5};  // below the sensor
  EXPECT_NEAR(SensorVisibleFraction(rays, lamp, sensor, 5), 1, 1e-12);
  EXPECT_EQ(VisibleFraction(rays, lamp, sensor.position, sensor.normal, 5), 0);
  lamp.position = {3.5, 2, 0.5};
  EXPECT_EQ(SensorVisibleFraction(rays, lamp, sensor, 5), 0);
}

// In a room lit evenly from all sides every meter reads the same; through the whole chain.
TEST(Sensor, TheirIlluminancesAgreeInADiffuseRoom) {
  const Room room = MakeRoom(support::ClosedRoom({3, 3, 3}), {{1, 0.5}, {256}});
  std::vector<Sensor> sensors;
  for (const ResponseKind kind : {ResponseKind::kCosine, ResponseKind::kCylindrical,
                                  ResponseKind::kSemicylindrical, ResponseKind::kSpherical})
    sensors.push_back({{1.6, 1.4, 1.5}, {0, 0, 1}, ResponseOf(kind)});
  Luminaire lamp;
  lamp.position = {0.4, 0.5, 2.6};
  lamp.distribution = Distribution::kIsotropic;
  const Receivers receivers = MakeReceivers(room, {}, sensors);
  const Illuminance light = ComputeIlluminance(room, receivers, ComputeVisibility(room, receivers, {lamp}),
                                               {lamp}, Eigen::VectorXd::Constant(1, 0.98));
  // A reflectance of 0.98 evens the light out to the share of the first bounces, some 2 % of it.
  for (Eigen::Index r = 1; r < 4; ++r) EXPECT_NEAR(light.total(r, 0) / light.total(0, 0), 1, 0.06);
}

}  // namespace
}  // namespace luxfit
