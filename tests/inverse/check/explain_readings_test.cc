// Readings of point sources in a black box, by the inverse square and cosine law: nothing of our light model.
#include "inverse/check/explain_readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace luxfit {
namespace {

using testing::HasSubstr;

constexpr double kSigma = 0.02;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
const Eigen::AlignedBox3d kRoom(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(6, 4, 2.8));
const Eigen::Vector3d kLamps[] = {{1.5, 2.1, 2.7}, {4.4, 2.7, 2.6}, {3.1, 0.7, 2.5}};
constexpr double kCandela[] = {300, 240, 110};
// By state, then lamp.
constexpr double kDimming[3][3] = {{1, 0, 0}, {0, 1, 0}, {0.3, 1, 1}};

// A place that faces away from a lamp receives 2 % of its intensity per m2, wherever it is.
double PointLx(const Sensor& sensor, int state) {
  double lx = 0;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d to = kLamps[k] - sensor.position;
    const double cosine = sensor.normal.dot(to) / to.norm();
    lx += kDimming[state][k] * kCandela[k] * (cosine > 0 ? cosine / to.squaredNorm() : 0.02);
  }
  return lx;
}

ExplainingLight PointLight() {
  ExplainingLight light;
  light.in_states = [](const std::vector<Sensor>& places) {
    Eigen::MatrixXd lx(static_cast<Eigen::Index>(places.size()), 3);
    for (Eigen::Index i = 0; i < lx.rows(); ++i) {
      const Sensor& place = places[static_cast<size_t>(i)];
      for (int s = 0; s < 3; ++s) lx(i, s) = kRoom.contains(place.position) ? PointLx(place, s) : kUnknown;
    }
    return lx;
  };
  // A table in one half of the room.
  light.top_m = [](double x, double) { return x < 3 ? 0.74 : 0.0; };
  light.states = {"A", "B", "evening"};
  light.bounds = kRoom;
  light.relative_sigma = 0.01;
  return light;
}

// Returns seven places in three states as they are right, half a percent up and down. P3 in state evening sets the scale.
std::vector<ReadingAsGiven> Right(double height_m = 0.8) {
  const Eigen::Vector2d places[] = {{1.2, 1.1}, {2.1, 1.7}, {3.7, 2.9}, {3.4, 2.2},
                                    {0.7, 2.9}, {2.4, 3.3}, {3.0, 1.3}};
  std::vector<ReadingAsGiven> readings;
  for (int s = 0; s < 3; ++s) {
    for (int p = 0; p < 7; ++p) {
      ReadingAsGiven r{"P" + std::to_string(p + 1), {{places[p].x(), places[p].y(), height_m}, {0, 0, 1}}, s};
      r.measured_lx = PointLx(r.sensor, s) * (p % 2 == 0 ? 1.005 : 0.995);
      r.sigma_lx = kSigma * r.measured_lx;
      r.sets_scale = p == 2 && s == 2;
      readings.push_back(r);
    }
  }
  return readings;
}

std::vector<ReadingAsGiven> Changed(std::vector<ReadingAsGiven> readings,
                                    const std::function<void(ReadingAsGiven&)>& change) {
  for (ReadingAsGiven& r : readings) change(r);
  return readings;
}

// Returns the light with its scale matched to the first reading that sets it, as a fit leaves it.
ExplainingLight Matched(const std::vector<ReadingAsGiven>& readings) {
  ExplainingLight light = PointLight();
  for (const ReadingAsGiven& r : readings) {
    if (!r.sets_scale || !kRoom.contains(r.sensor.position)) continue;
    const double factor = r.measured_lx / PointLx(r.sensor, r.state);
    light.in_states = [factor,
                       in_states = light.in_states](const std::vector<Sensor>& places) -> Eigen::MatrixXd {
      return factor * in_states(places);
    };
    break;
  }
  return light;
}

std::vector<ReadingExplanation> Explain(const std::vector<ReadingAsGiven>& readings) {
  return ExplainReadings(Matched(readings), readings);
}

void Multiply(ReadingAsGiven& r, double factor) {
  r.measured_lx *= factor;
  r.sigma_lx *= factor;
}

void ExpectOnly(const std::vector<ReadingExplanation>& found, const std::string& as_if) {
  ASSERT_EQ(found.size(), 1u) << (found.empty() ? "" : InWords(found));
  EXPECT_THAT(found[0].as_if, HasSubstr(as_if));
  // The readings are half a percent off.
  EXPECT_LT(found[0].rms_percent, 1.5);
  EXPECT_FALSE(found[0].rms_percent_as_given < 10);
  EXPECT_FALSE(found[0].remedy.empty());
}

TEST(ExplainReadings, RightReadingsNeedNoExplanation) {
  EXPECT_TRUE(Explain(Right()).empty());
  EXPECT_TRUE(ExplainReadings(PointLight(), {}).empty());
}

TEST(ExplainReadings, ExchangedAxes) {
  const auto found = Explain(
      Changed(Right(), [](ReadingAsGiven& r) { std::swap(r.sensor.position.x(), r.sensor.position.y()); }));
  ExpectOnly(found, "x and y were exchanged");
  EXPECT_THAT(InWords(found),
              HasSubstr("the readings look as if x and y were exchanged: so read, they are 0."));
}

TEST(ExplainReadings, MirroredAxes) {
  ExpectOnly(
      Explain(Changed(Right(), [](ReadingAsGiven& r) { r.sensor.position.x() = 6 - r.sensor.position.x(); })),
      "x was counted from the opposite wall");
  ExpectOnly(
      Explain(Changed(Right(), [](ReadingAsGiven& r) { r.sensor.position.y() = 4 - r.sensor.position.y(); })),
      "y was counted from the opposite wall");
}

TEST(ExplainReadings, TurnedAxes) {
  const auto given_by_turned = [](ReadingAsGiven& r) {
    const Eigen::Vector3d p = r.sensor.position;
    r.sensor.position = {p.y(), 6 - p.x(), p.z()};
  };
  ExpectOnly(Explain(Changed(Right(), given_by_turned)),
             "turned by 90 degrees: the given y is counted along x");
}

TEST(ExplainReadings, DirectionsReversed) {
  ExpectOnly(Explain(Changed(Right(), [](ReadingAsGiven& r) { r.sensor.normal *= -1; })),
             "the meter faced the other way");
}

TEST(ExplainReadings, UnitsOfPlaces) {
  const auto found = Explain(Changed(Right(), [](ReadingAsGiven& r) { r.sensor.position *= 100; }));
  ExpectOnly(found, "their places were in cm");
  EXPECT_TRUE(std::isnan(found[0].rms_percent_as_given));
  EXPECT_THAT(InWords(found),
              HasSubstr("as given nothing predicts them; 7 of 7 places lie outside the room"));
  ExpectOnly(Explain(Changed(Right(), [](ReadingAsGiven& r) { r.sensor.position /= 0.3048; })),
             "their places were in ft");
  ExpectOnly(Explain(Changed(Right(), [](ReadingAsGiven& r) { r.sensor.position.z() *= 1000; })),
             "their heights were in mm");
}

TEST(ExplainReadings, HeightsOffAlike) {
  ExpectOnly(Explain(Changed(Right(1.1), [](ReadingAsGiven& r) { r.sensor.position.z() = 0; })),
             "the meter was 1.10 m higher");
}

TEST(ExplainReadings, HeadsTiltedAlike) {
  const Eigen::AngleAxisd towards_x(5 * M_PI / 180, Eigen::Vector3d::UnitY());
  std::vector<ReadingAsGiven> readings = Right();
  for (ReadingAsGiven& r : readings) {
    Sensor tilted = r.sensor;
    tilted.normal = towards_x * tilted.normal;
    r.measured_lx = PointLx(tilted, r.state);
  }
  const auto found = Explain(readings);
  ASSERT_EQ(found.size(), 1u) << (found.empty() ? "" : InWords(found));
  EXPECT_THAT(found[0].as_if, HasSubstr("the meter's head was tilted by about 5 degrees towards (1, 0)"));
}

TEST(ExplainReadings, OnTopOfWhatStandsThere) {
  std::vector<ReadingAsGiven> readings = Right(0);
  for (ReadingAsGiven& r : readings) {
    Sensor on_top = r.sensor;
    on_top.position.z() = r.sensor.position.x() < 3 ? 0.741 : 0.001;
    r.measured_lx = PointLx(on_top, r.state);
  }
  ExpectOnly(Explain(readings), "the meter lay on top of what stands at each place");
}

TEST(ExplainReadings, StatesWrittenForEachOther) {
  ExpectOnly(Explain(Changed(Right(), [](ReadingAsGiven& r) { r.state = r.state == 2 ? 2 : 1 - r.state; })),
             "the readings of states A and B were written for each other");
}

TEST(ExplainReadings, TheReadingThatSetsTheScale) {
  const auto times = [](double factor) {
    return Explain(Changed(Right(), [=](ReadingAsGiven& r) { Multiply(r, r.sets_scale ? factor : 1); }));
  };
  ExpectOnly(times(1 / 10.764),
             "the reading that sets the scale, P3@evening, was 10.8 times too low, as in foot-candles");
  ExpectOnly(times(2), "the reading that sets the scale, P3@evening, was 2 times too high");
  ExpectOnly(times(10), "times too high, as by a decimal point, or another range of the meter");
}

TEST(ExplainReadings, SoReadTheTableIsRight) {
  const std::function<void(ReadingAsGiven&)> mistakes[] = {
      [](ReadingAsGiven& r) { std::swap(r.sensor.position.x(), r.sensor.position.y()); },
      [](ReadingAsGiven& r) { r.sensor.position.x() = 6 - r.sensor.position.x(); },
      [](ReadingAsGiven& r) { r.sensor.normal *= -1; },
      [](ReadingAsGiven& r) { r.sensor.position *= 100; },
      [](ReadingAsGiven& r) { r.state = r.state == 2 ? 2 : 1 - r.state; },
      [](ReadingAsGiven& r) { Multiply(r, r.sets_scale ? 1 / 10.7639 : 1); },
  };
  const std::vector<ReadingAsGiven> right = Right();
  for (const auto& mistake : mistakes) {
    const std::vector<ReadingAsGiven> given = Changed(right, mistake);
    const auto found = Explain(given);
    ASSERT_EQ(found.size(), 1u);
    ASSERT_TRUE(found[0].so_read) << found[0].as_if;
    for (size_t i = 0; i < right.size(); ++i) {
      const ReadingAsGiven read = found[0].so_read(given[i]);
      EXPECT_TRUE(read.sensor.position.isApprox(right[i].sensor.position, 1e-12)) << found[0].as_if;
      EXPECT_EQ(read.sensor.normal, right[i].sensor.normal) << found[0].as_if;
      EXPECT_EQ(read.state, right[i].state) << found[0].as_if;
      EXPECT_NEAR(read.measured_lx, right[i].measured_lx, 1e-9 * right[i].measured_lx) << found[0].as_if;
    }
  }
}

// Two thirds of the readings set the scale: they may be wrong, or the others.
TEST(ExplainReadings, WhereNothingTellsWhichReadingsAreWrongNoneIsCorrected) {
  std::vector<ReadingAsGiven> readings =
      Changed(Right(), [](ReadingAsGiven& r) { r.sets_scale = r.state != 1; });
  for (ReadingAsGiven& r : readings) Multiply(r, r.sets_scale ? 1 / 10.7639 : 1);
  const auto found = ExplainReadings(Matched(readings), readings);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].as_if, HasSubstr("or the other 7 the other way"));
  EXPECT_FALSE(found[0].so_read);
}

// The state of the reading that sets the scale is not what it is said to be.
TEST(ExplainReadings, AStateThatIsOffIsNoWrongScale) {
  EXPECT_TRUE(
      Explain(Changed(Right(), [](ReadingAsGiven& r) { Multiply(r, r.state == 2 ? 1.4 : 1); })).empty());
}

// Something else than readings sets the scale.
TEST(ExplainReadings, TheUnitOfAllReadings) {
  const auto readings = Changed(Right(), [](ReadingAsGiven& r) { Multiply(r, 1 / 10.764); });
  ExplainingLight light = PointLight();
  light.scale = ScaleSource::kOther;
  ExpectOnly(ExplainReadings(light, readings), "all 21 readings were 10.7 times too low, as in foot-candles");
  light.scale = ScaleSource::kReadings;
  EXPECT_TRUE(ExplainReadings(Matched(readings), readings).empty()) << "nothing else tells the scale";
}

TEST(ExplainReadings, OneReadingOffIsNoMistakeOfAll) {
  std::vector<ReadingAsGiven> readings = Right();
  Multiply(readings[4], 10);
  EXPECT_TRUE(Explain(readings).empty());
}

// One place ten times too high does not hide that axes were exchanged.
TEST(ExplainReadings, AMistakeBesideAnother) {
  std::vector<ReadingAsGiven> readings =
      Changed(Right(), [](ReadingAsGiven& r) { std::swap(r.sensor.position.x(), r.sensor.position.y()); });
  Multiply(readings[4], 10);
  const auto found = Explain(readings);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].as_if, "x and y were exchanged");
}

TEST(ExplainReadings, WhatExplainsEquallyIsSaidToo) {
  ExplainingLight light = PointLight();
  // One lamp in the middle of the ceiling: a place and its mirror images are lit alike.
  light.in_states = [](const std::vector<Sensor>& places) {
    Eigen::MatrixXd lx(static_cast<Eigen::Index>(places.size()), 3);
    for (Eigen::Index i = 0; i < lx.rows(); ++i) {
      const Eigen::Vector3d to = Eigen::Vector3d(3, 2, 2.7) - places[static_cast<size_t>(i)].position;
      const bool is_inside = kRoom.contains(places[static_cast<size_t>(i)].position);
      lx.row(i).setConstant(is_inside ? 300 * to.z() / std::pow(to.norm(), 3) : kUnknown);
    }
    return lx;
  };
  std::vector<ReadingAsGiven> readings = Right();
  for (ReadingAsGiven& r : readings) {
    r.measured_lx = light.in_states({r.sensor})(0, 0);
    r.sigma_lx = kSigma * r.measured_lx;
    std::swap(r.sensor.position.x(), r.sensor.position.y());
  }
  const auto found = ExplainReadings(light, readings);
  ASSERT_EQ(found.size(), 4u) << InWords(found);
  EXPECT_THAT(InWords(found), HasSubstr("which explain them equally"));
  EXPECT_THAT(InWords(found), HasSubstr("x and y were exchanged"));
  EXPECT_THAT(InWords(found), HasSubstr("turned by 90 degrees"));
}

// Readings that no mistake explains: as if luminaires had changed.
TEST(ExplainReadings, OtherLightIsNoMistakeOfTheTable) {
  std::vector<ReadingAsGiven> readings = Right();
  for (size_t i = 0; i < readings.size(); ++i)
    Multiply(readings[i], 0.5 + 0.15 * static_cast<double>(i * 5 % 7));
  EXPECT_TRUE(Explain(readings).empty());
}

TEST(ExplainReadings, ThreePlacesTellNothing) {
  std::vector<ReadingAsGiven> few;
  for (ReadingAsGiven r : Right()) {
    std::swap(r.sensor.position.x(), r.sensor.position.y());
    if (r.id == "P1" || r.id == "P2" || r.id == "P3") few.push_back(r);
  }
  EXPECT_TRUE(Explain(few).empty());
}

}  // namespace
}  // namespace luxfit
