// Spots aimed sideways at the walls, of which no photo shows where they hang: found from their light alone.
//
//   L_e = sum_k d_k mean over p in e of rho E_k(p) / pi        e: element, k: luminaire, by the light tracer
//
// 5 m x 4 m x 2.7 m. A and B: spots of exponent 30, 24 degrees wide at half of the peak, aimed 19 and 24 degrees below
// the horizontal. C: a downlight. The truth shares no patch and no form factor with the model. Photos have noise of
// 0.3 %, readings of 1 %; the tracer's own errors are stated as noise of the photos.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "forward/light/light_tracer.h"
#include "forward/light/room.h"
#include "inverse/fit/fit_room.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

Room Model() {
  RoomOptions options;
  options.patches.patch_size_m = 0.5;
  options.patches.element_size_m = 0.125;
  return MakeRoom(support::ClosedRoom({5, 4, 2.7}, {"wall", "wall", "wall", "wall", "floor", "ceiling"}),
                  options);
}

Eigen::VectorXd TrueAlbedo() { return Eigen::Vector3d(0.6, 0.25, 0.8); }

std::vector<Luminaire> TrueLuminaires() {
  std::vector<Luminaire> luminaires(3);
  const std::vector<Eigen::Vector3d> places = {{1.2, 1.0, 2.4}, {3.9, 1.5, 2.3}, {2.6, 2.7, 2.55}};
  const std::vector<Eigen::Vector3d> directions = {{-0.3, 1, -0.35}, {1, 0.5, -0.5}, {0, 0, -1}};
  const std::vector<double> fluxes_lm = {700, 900, 1500}, exponents = {30, 30, 2};
  for (size_t k = 0; k < luminaires.size(); ++k) {
    luminaires[k].id = std::string(1, static_cast<char>('A' + k));
    luminaires[k].position = places[k];
    luminaires[k].aim = directions[k].normalized();
    luminaires[k].distribution = Distribution::kCosinePower;
    luminaires[k].cosine_exponent = exponents[k];
    luminaires[k].flux_lm = fluxes_lm[k];
  }
  return luminaires;
}

// Holds what the tracer found: elements, or places of readings, x luminaires.
struct Traced {
  std::vector<int> elements;
  Eigen::MatrixXd luminance, sigma;  // cd/m2
  std::vector<Sensor> sensors;
  Eigen::MatrixXd illuminance_lx;
};

TracedIlluminance Trace(const Room& room, const std::vector<Sensor>& sensors, int paths) {
  LightTracerOptions options;
  options.paths_per_sensor = paths;
  options.replicates = 16;
  return TraceIlluminance(room.scene, room.rays, TrueLuminaires(), TrueAlbedo(), sensors, options);
}

// Traces half of the elements, which lie all over the room: eight in the core of a beam. Also traces eight places at
// the height of a desk.
Traced TraceRoom(const Room& room) {
  constexpr size_t kStride = 2;
  constexpr int kPaths = 2048, kReadingPaths = 65536;
  Traced traced;
  std::vector<Sensor> points;
  std::vector<double> albedo;
  size_t points_of_element = 0;
  for (size_t e = 0; e < room.patches.elements.size(); e += kStride) {
    const Element& element = room.patches.elements[e];
    const auto probes = ProbesOf(element, false);
    points_of_element = probes.size();
    traced.elements.push_back(static_cast<int>(e));
    albedo.push_back(TrueAlbedo()[room.patches.PatchOf(static_cast<int>(e)).material]);
    for (const Eigen::Vector3d& p : probes) points.push_back({p, element.normal, {}});
  }
  const TracedIlluminance lx = Trace(room, points, kPaths);
  const Eigen::Index luminaires = lx.direct.cols();
  traced.luminance.setZero(static_cast<Eigen::Index>(traced.elements.size()), luminaires);
  traced.sigma = traced.luminance;
  for (size_t p = 0; p < points.size(); ++p) {
    const auto row = static_cast<Eigen::Index>(p), e = static_cast<Eigen::Index>(p / points_of_element);
    const double share = albedo[p / points_of_element] / (static_cast<double>(points_of_element) * M_PI);
    traced.luminance.row(e) += share * (lx.direct.row(row) + lx.indirect.row(row));
    traced.sigma.row(e) += share * share * lx.indirect_sigma.row(row).cwiseAbs2();
  }
  traced.sigma = traced.sigma.cwiseSqrt();
  for (const double y : {1.0, 3.0})
    for (const double x : {0.7, 1.8, 3.1, 4.4}) traced.sensors.push_back({{x, y, 0.75}, {0, 0, 1}, {}});
  const TracedIlluminance readings = Trace(room, traced.sensors, kReadingPaths);
  traced.illuminance_lx = readings.direct + readings.indirect;
  return traced;
}

RoomObservations Observe(const Traced& traced, const std::vector<Eigen::VectorXd>& dimming) {
  constexpr double kNoise = 0.003, kReadingNoise = 0.01, kScale = 2e-3;
  std::mt19937_64 rng(7);
  std::normal_distribution<double> normal;
  RoomObservations given;
  given.dimming = dimming;
  for (const Luminaire& luminaire : TrueLuminaires()) {
    given.luminaires.emplace_back();
    given.luminaires.back().luminaire.id = luminaire.id;
  }
  for (size_t s = 0; s < dimming.size(); ++s) {
    const Eigen::VectorXd luminance = traced.luminance * dimming[s];
    const Eigen::VectorXd variance = traced.sigma.cwiseAbs2() * dimming[s].cwiseAbs2();
    for (size_t i = 0; i < traced.elements.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      Observation o;
      o.element = traced.elements[i];
      o.state = static_cast<int>(s);
      o.pixels = 100;
      o.relative_luminance = kScale * luminance[row] * (1 + kNoise * normal(rng));
      o.variance = kScale * kScale * (std::pow(kNoise * luminance[row], 2) + variance[row]);
      o.relative_rgb.setConstant(o.relative_luminance);
      given.observations.push_back(o);
    }
  }
  const auto last = static_cast<int>(dimming.size()) - 1;
  const Eigen::VectorXd lx = traced.illuminance_lx * dimming.back();
  for (size_t i = 0; i < traced.sensors.size(); ++i) {
    const double read_lx = lx[static_cast<Eigen::Index>(i)] * (1 + kReadingNoise * normal(rng));
    given.meter.readings.push_back({traced.sensors[i], last, read_lx, 0, true, -1});
  }
  return given;
}

// The room is traced once for all tests.
class AimedSpots : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    room_ = new Room(Model());
    traced_ = new Traced(TraceRoom(*room_));
    std::printf("tracer: %.2f %% of an element's light, rms\n",
                100 * std::sqrt((traced_->sigma.array() / traced_->luminance.array()).square().mean()));
  }
  static void TearDownTestSuite() {
    delete traced_;
    delete room_;
  }

  static void ExpectFound(const std::vector<Eigen::VectorXd>& dimming) {
    const RoomFit fit = FitRoom(*room_, Observe(*traced_, dimming));
    ASSERT_TRUE(fit.IsUsable()) << fit.fit.message;
    const std::vector<Luminaire> truth = TrueLuminaires();
    for (size_t k = 0; k < truth.size(); ++k) {
      const Luminaire& found = fit.fit.state.luminaires[k];
      const double off_mm = 1000 * (found.position - truth[k].position).norm();
      const double off_percent = 100 * (found.flux_lm / truth[k].flux_lm - 1);
      const double turned_deg =
          180 / M_PI * std::atan2(found.aim.cross(truth[k].aim).norm(), found.aim.dot(truth[k].aim));
      std::printf("  %s off by %5.1f mm, flux %+5.2f %%, aim %.2f deg, exponent %.2f, %s\n",
                  truth[k].id.c_str(), off_mm, off_percent, turned_deg, found.cosine_exponent,
                  ToString(found.shape).c_str());
      EXPECT_LT(off_mm, 40) << truth[k].id;
      EXPECT_LT(std::abs(off_percent), 5) << truth[k].id;
      EXPECT_LT(turned_deg, 1) << truth[k].id;
    }
  }

  static const Room* room_;
  static const Traced* traced_;
};
const Room* AimedSpots::room_ = nullptr;
const Traced* AimedSpots::traced_ = nullptr;

TEST_F(AimedSpots, AreFoundWhereEachIsOnAlone) {
  ExpectFound({Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1),
               Eigen::Vector3d(1, 1, 1)});
}

// The second spot is dimmed. The order by x is that of their names.
TEST_F(AimedSpots, AreFoundWhereBothAreOnTogether) {
  ExpectFound({Eigen::Vector3d(1, 0.8, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0.8, 1)});
}

}  // namespace
}  // namespace luxfit
