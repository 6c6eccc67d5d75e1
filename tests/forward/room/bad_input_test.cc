// What no light can be computed for is refused with std::invalid_argument that names it, before it reaches
// the ray tracer or the solver.
#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "forward/direct/luminaire_body.h"
#include "forward/light/illuminance.h"
#include "forward/light/internal/adaptive_patches.h"
#include "forward/light/light_tracer.h"
#include "forward/light/room.h"
#include "forward/views/surface_view.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using testing::HasSubstr;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string RefusalOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BadFacets, WithoutAreaOrOutsideTheNumbersAreNamed) {
  Scene good = support::ClosedRoom({2, 2, 2});
  const Facet whole = good.facets[3];
  std::vector<Facet> bad(6, whole);
  bad[0].edge_v = 2 * whole.edge_u;
  bad[1].edge_u.setZero();
  bad[2].edge_u = bad[2].edge_v = Eigen::Vector3d::Zero();
  bad[3].origin.x() = kNan;
  bad[4].edge_v.y() = kInfinity;
  bad[5].material = 1;
  const RayScene rays(good);
  for (const Facet& facet : bad) {
    for (const FacetKind kind : {FacetKind::kParallelogram, FacetKind::kTriangle}) {
      Scene scene = good;
      scene.facets[3] = facet;
      scene.facets[3].kind = kind;
      EXPECT_THAT(RefusalOf([&] { RayScene made(scene); }), HasSubstr("facet 3: expected"));
      EXPECT_THAT(RefusalOf([&] { MakeRoom(scene); }), HasSubstr("facet 3: expected"));
      EXPECT_THAT(RefusalOf([&] { Subdivide(scene, rays); }), HasSubstr("facet 3: expected"));
    }
  }
}

// A square nanometre has an area, though float coordinates do not show it.
TEST(BadFacets, ATinyFacetIsNone) {
  Scene scene = support::ClosedRoom({2, 2, 2});
  support::AddTriangle(scene, {1, 1, 1}, {1e-9, 0, 0}, {0, 1e-9, 0}, "wall");
  const Room room = MakeRoom(scene);
  EXPECT_TRUE(room.form_factors.element_to_patch.allFinite());
}

class BadLight : public testing::Test {
 protected:
  BadLight() : room_(MakeRoom(support::ClosedRoom({2, 2, 2}))) { good_.position = {1, 1, 1.9}; }

  std::vector<Luminaire> BadLuminaires() const {
    std::vector<Luminaire> bad(9, good_);
    bad[0].position.y() = kNan;
    bad[1].aim.x() = kNan;
    bad[2].aim.setZero();
    bad[3].heading.z() = kNan;
    bad[4].size_m[1] = kNan;
    bad[5].size_m[0] = -0.1;
    bad[6].flux_lm = kNan;
    bad[7].distribution = Distribution::kCosinePower;
    bad[7].cosine_exponent = kNan;
    bad[8].distribution = Distribution::kMeasured;
    return bad;
  }

  Room room_;
  Luminaire good_;
  const Sensor sensor_{{1, 1, 0}, {0, 0, 1}, {}};
  const Eigen::VectorXd albedo_ = Eigen::VectorXd::Constant(1, 0.5);
};

TEST_F(BadLight, LuminairesAreRefusedByEveryPath) {
  const Receivers receivers = MakeReceivers(room_, {}, {sensor_});
  const LuminaireVisibility visibility = ComputeVisibility(room_, receivers, {good_, good_});
  for (const Luminaire& bad : BadLuminaires()) {
    const std::vector<Luminaire> luminaires{good_, bad};
    const auto expect_refused = [&](const std::function<void()>& action) {
      EXPECT_THAT(RefusalOf(action), HasSubstr("luminaire 1 (\"\"): expected"));
    };
    expect_refused([&] { ComputeVisibility(room_, receivers, luminaires); });
    expect_refused([&] { ComputeIlluminance(room_, receivers, visibility, luminaires, albedo_); });
    expect_refused([&] { LightRoom(room_, luminaires, albedo_); });
    expect_refused([&] { TraceIlluminance(room_.scene, room_.rays, luminaires, albedo_, {sensor_}); });
    expect_refused([&] { WithLuminaireBodies(room_.scene, luminaires); });
    expect_refused([&] { AdaptivePatches(MakeRoom({}), {}, luminaires, 10); });
    EXPECT_THAT(RefusalOf([&] { ShareOutsideRoom(room_.rays, bad); }), HasSubstr("luminaire \"\": expected"));
  }
}

TEST_F(BadLight, SensorsAreRefusedByEveryPath) {
  std::vector<Sensor> bad(4, sensor_);
  bad[0].position.x() = kNan;
  bad[1].normal.y() = kNan;
  bad[2].normal.setZero();
  bad[3].response.facing.z() = kNan;
  for (const Sensor& sensor : bad) {
    EXPECT_THAT(RefusalOf([&] {
                  MakeReceivers(room_, {}, {sensor_, sensor});
                }),
                HasSubstr("sensor 1: expected"));
    EXPECT_THAT(RefusalOf([&] { SensorFormFactors(room_.rays, room_.patches, sensor); }),
                HasSubstr("sensor: expected"));
    EXPECT_THAT(RefusalOf([&] { TraceIlluminance(room_.scene, room_.rays, {good_}, albedo_, {sensor}); }),
                HasSubstr("sensor 0: expected"));
  }
  EXPECT_THROW(TableResponse({0, kNan, 1}, {1, 0.9, 0.5}), std::invalid_argument);
  EXPECT_THROW(TableResponse({0, 0.5, 1}, {1, kNan, 0.5}), std::invalid_argument);
  EXPECT_THROW(TableResponse({0, 0.5, 1}, {1, kInfinity, 0.5}), std::invalid_argument);
}

TEST_F(BadLight, ReflectancesOutsideZeroToOneAreRefused) {
  const Receivers receivers = MakeReceivers(room_, {}, {sensor_});
  const LuminaireVisibility visibility = ComputeVisibility(room_, receivers, {good_});
  for (const double rho : {-0.1, 1.0, 1.1, kNan}) {
    EXPECT_THAT(RefusalOf([&] {
                  ComputeIlluminance(room_, receivers, visibility, {good_},
                                     Eigen::VectorXd::Constant(1, rho));
                }),
                HasSubstr("reflectances in [0, 1)"))
        << rho;
  }
}

}  // namespace
}  // namespace luxfit
