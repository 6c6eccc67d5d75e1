#include "inverse/model/internal/search/sparse_luminaires.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "inverse/model/internal/search/alike_places.h"
#include "tests/support/closed_forms.h"
#include "tests/support/inverse/plane_readings.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// A Lambertian strip along x, one end of which is as bright as the rest, lights two planes of sensors in no room.
class SeenStrip : public testing::Test {
 protected:
  static constexpr double kHalfM = 0.6, kHeightM = 1.6;

  static double IlluminanceAt(const Eigen::Vector3d& p) {
    constexpr int kParts = 12;
    double lx = support::PointLx(1000, support::LambertianCdPerLm, {kHalfM, 0, kHeightM}, p);
    for (int i = 0; i < kParts; ++i) {
      const double x = kHalfM * ((2 * i + 1.0) / kParts - 1);
      lx += support::PointLx(1000.0 / kParts, support::LambertianCdPerLm, {x, 0, kHeightM}, p);
    }
    return lx;
  }

  // Returns how far the second source lies from the strip.
  static double SecondSourceM(double seen_length_m) {
    std::mt19937_64 rng = support::TestRng();
    LightData data;
    data.dimming = {Eigen::VectorXd::Ones(1)};
    for (const double height : {0.0, 0.3})
      for (const Reading& reading :
           support::ReadAt(support::PlanePoints(9, 3, height), IlluminanceAt, 0.0, rng))
        data.readings.push_back(reading);
    SeenPlace place;
    place.position = {0, 0, kHeightM};
    place.size_m = {seen_length_m, 0.1};
    const Room room = MakeRoom(Scene{});
    const GroupedLight light = GroupLight(room, data, 300);
    const SparseSearch search(room, light, {}, 0.4, 3);
    const SparseLuminaires found = search.Find(0, 2, {SourceAt(place)});
    EXPECT_EQ(found.sources.size(), 2u);
    const Eigen::Vector3d second = found.sources.back().luminaire.position;
    const Eigen::Vector3d nearest(std::clamp(second.x(), -kHalfM, kHalfM), 0, kHeightM);
    return (second - nearest).norm();
  }
};

TEST_F(SeenStrip, HasNoOtherSourceBesideIt) {
  EXPECT_LT(SecondSourceM(0), 0.3);  // one that seems small has
  EXPECT_GE(SecondSourceM(2 * kHalfM), 0.3);
}

}  // namespace
}  // namespace luxfit
