// Tables, uneven emission and headings: chosen where the data ask for them, by closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "forward/luminaire/luminaire_parts.h"
#include "inverse/choose/internal/choose_model.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/part_smoothness.h"
#include "tests/support/closed_forms.h"
#include "tests/support/inverse/plane_readings.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::kPi;
const Eigen::Vector3d kRefinedLamp(0.13, -0.21, 1.5);

// cd per lm. Between 0.2 at the nadir and a ring of 1.2 at 45 degrees, dark at 90: no cosine power.
// Its flux: 2 pi int (0.2 cos + sin^2 2g) sin g dg = 2 pi (0.1 + 8 / 15).
double BatwingCdPerLm(double cosine) {
  const double sine2 = 1 - cosine * cosine;
  return (0.2 * cosine + 4 * sine2 * cosine * cosine) / (2 * kPi * (0.1 + 8.0 / 15));
}

LightData ReadingsNear(const std::function<double(const Eigen::Vector3d&)>& lux, double nearest_m,
                       double width_m) {
  std::mt19937_64 rng = support::TestRng();
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  for (const double below : {nearest_m, nearest_m + 0.5}) {
    const std::vector<Reading> plane =
        support::ReadAt(support::PlanePoints(12, width_m, kRefinedLamp.z() - below), lux, 0.01, rng);
    data.readings.insert(data.readings.end(), plane.begin(), plane.end());
  }
  return data;
}

ModelChoice Choose(const LightData& data, const OpenRefinements& refinements, LuminaireFit* last = nullptr) {
  const Room room = MakeRoom(Scene{});
  const LightState start = support::CosinePowerStart(kRefinedLamp + Eigen::Vector3d(0.05, 0.05, -0.05), 1);
  const LuminaireFit fit = FitLuminaires(room, data, start);
  OpenChoice open;
  open.shape = false;
  open.aim = false;
  open.refinements = refinements;
  const ModelChoice choice = ChooseLuminaireModels(room, data, fit.state, {open});
  if (last != nullptr) *last = FitLuminaires(room, data, choice.state);
  return choice;
}

TEST(RefineLuminaire, ABatwingIsATableThatRecoversItsIntensities) {
  const LightData data = ReadingsNear(
      [](const Eigen::Vector3d& p) { return support::PointLx(900, BatwingCdPerLm, kRefinedLamp, p); }, 0.5,
      4);
  OpenRefinements open;
  open.table = true;
  LuminaireFit fit;
  const ModelChoice choice = Choose(data, open, &fit);
  ASSERT_FALSE(choice.refinements.empty());
  const Refinement& step = choice.refinements.front();
  EXPECT_EQ(step.kind, RefinementKind::kTable);
  ASSERT_GT(step.chosen, 0);
  EXPECT_GT(step.score[0], 2 * step.score[static_cast<size_t>(step.chosen)]);
  EXPECT_GT(fit.effective_parts, 3);
  EXPECT_LT(fit.effective_parts, 12);
  const Luminaire& lamp = fit.state.luminaires[0];
  ASSERT_EQ(lamp.distribution, Distribution::kMeasured);
  EXPECT_LT((lamp.position - kRefinedLamp).norm(), 0.02);
  // To 70 degrees, where readings lie: 288 readings of 1 %, and straight lines over 7.5 degrees (0.13^2 / 8
  // of a second derivative of 8 times the peak: 2 %).
  const double peak = BatwingCdPerLm(std::sqrt(0.5)) * 900;
  for (size_t j = 0; j < lamp.table->gamma_rad.size(); ++j) {
    const double gamma = lamp.table->gamma_rad[j];
    if (gamma > 70 * kPi / 180) continue;
    EXPECT_NEAR(fit.state.luminaires[0].flux_lm * lamp.table->cd_per_lm[j],
                900 * BatwingCdPerLm(std::cos(gamma)), 0.05 * peak)
        << gamma * 180 / kPi << " deg";
  }
  EXPECT_NEAR(FluxIntegral(*lamp.table), 1, 1e-9);
}

TEST(RefineLuminaire, ACosinePowerNeedsNoTable) {
  const auto cos3 = [](double c) { return 4 * std::pow(c, 3) / (2 * kPi); };
  const LightData data = ReadingsNear(
      [&](const Eigen::Vector3d& p) { return support::PointLx(900, cos3, kRefinedLamp, p); }, 0.8, 3);
  OpenRefinements open;
  open.table = true;
  const ModelChoice choice = Choose(data, open);
  EXPECT_EQ(choice.state.luminaires[0].distribution, Distribution::kCosinePower);
  EXPECT_EQ(choice.state.free[0].table_sigma, 0);
}

TEST(RefineLuminaire, ATableThatIsAskedForIsMade) {
  const auto cos3 = [](double c) { return 4 * std::pow(c, 3) / (2 * kPi); };
  const LightData data = ReadingsNear(
      [&](const Eigen::Vector3d& p) { return support::PointLx(900, cos3, kRefinedLamp, p); }, 0.8, 3);
  OpenRefinements open;
  open.table = open.table_asked_for = true;
  const ModelChoice choice = Choose(data, open);
  EXPECT_EQ(choice.state.luminaires[0].distribution, Distribution::kMeasured);
  EXPECT_GT(choice.state.free[0].table_sigma, 0);
}

// A panel of which a third is dark, read from near by: cells of closed-form rectangles.
TEST(RefineLuminaire, APanelThatShinesUnevenlyIsFoundToDoSo) {
  const auto lux = [](const Eigen::Vector3d& p) {
    const Eigen::Vector3d side(0.4, 0, 0);
    return support::LambertianRectangleLx(600, kRefinedLamp - side, 0.4, 0.6, p) +
           support::LambertianRectangleLx(300, kRefinedLamp + side, 0.4, 0.6, p);
  };
  const LightData data = ReadingsNear(lux, 0.25, 2);
  const Room room = MakeRoom(Scene{});
  LightState start = support::CosinePowerStart(kRefinedLamp, 1);
  start.luminaires[0].distribution = Distribution::kLambertian;
  start.luminaires[0].shape = LuminaireShape::kRectangle;
  start.luminaires[0].size_m = {1.1, 0.6};
  start.free[0].size = true;
  const LuminaireFit even = FitLuminaires(room, data, start);
  OpenChoice open{false, false, false, {}};
  open.refinements.emission = true;
  const ModelChoice choice = ChooseLuminaireModels(room, data, even.state, {open});
  ASSERT_FALSE(choice.refinements.empty());
  EXPECT_EQ(choice.refinements.front().kind, RefinementKind::kEmission);
  EXPECT_GT(choice.refinements.front().chosen, 0);
  const Eigen::ArrayXXd& emission = choice.state.luminaires[0].emission;
  ASSERT_GT(emission.size(), 0);
  // Heading is x: more light at low x.
  EXPECT_GT(emission.topRows(emission.rows() / 2).sum(), 0.55);
  const LuminaireFit uneven = FitLuminaires(room, data, choice.state);
  EXPECT_LT(uneven.relative_sigma, 0.5 * even.relative_sigma);
}

// An asymmetric lobe: I = (1 + 0.6 cos(C - C0)) cos(gamma) / pi per lm, whose flux is 1 lm for any C0.
TEST(RefineLuminaire, TheHeadingOfAGivenPhotometryIsFound) {
  constexpr double kTurned = 2.1;  // rad, far from all four starts
  const auto intensity = [](double c, double cosine) { return (1 + 0.6 * std::cos(c)) * cosine / kPi; };
  const auto lux = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d d = p - kRefinedLamp;
    const double cosine = -d.z() / d.norm();
    // C runs counter-clockwise seen from above, from the heading.
    const double c = std::atan2(d.y(), d.x()) - kTurned;
    return 700 * intensity(c, cosine) * cosine / d.squaredNorm();
  };
  const LightData data = ReadingsNear(lux, 0.8, 3);
  std::vector<double> c_rad, gamma_rad, table;
  for (int c = 0; c < 360; c += 10) c_rad.push_back(c * kPi / 180);
  for (int g = 0; g <= 90; g += 3) gamma_rad.push_back(g * kPi / 180);
  for (const double c : c_rad) {
    for (const double g : gamma_rad) table.push_back(intensity(c, std::max(0.0, std::cos(g))));
  }
  LightState start = support::CosinePowerStart(kRefinedLamp, 1);
  start.luminaires[0].distribution = Distribution::kMeasured;
  start.luminaires[0].table = std::make_shared<IntensityTable>(
      Normalized(ExpandPlanes(c_rad, gamma_rad, table, PlaneSymmetry::kNone)));
  EXPECT_FALSE(IsSymmetricAboutAim(*start.luminaires[0].table));
  OpenChoice open{false, false, false, {}};
  open.refinements.heading = true;
  const Room room = MakeRoom(Scene{});
  const ModelChoice choice = ChooseLuminaireModels(room, data, start, {open});
  ASSERT_EQ(choice.refinements.size(), 1u);
  EXPECT_EQ(choice.refinements[0].kind, RefinementKind::kHeading);
  EXPECT_EQ(choice.refinements[0].among.size(), 4u);
  const LuminaireFit fit = FitLuminaires(room, data, choice.state);
  const Eigen::Vector3d heading = AxesOf(fit.state.luminaires[0]).along;
  // 288 readings of 1 %, a modulation of 0.6: a tenth of a degree; the table's steps of 10 and 3 degrees.
  EXPECT_NEAR(std::atan2(heading.y(), heading.x()), kTurned, 0.01);
}

// All quantities that this adds, in a room with interreflection.
TEST(RefineLuminaire, JacobianOfPartsAndGainsIsACentralDifference) {
  const Room room =
      MakeRoom(support::ClosedRoom({3.2, 2.2, 2.4}, {"wall", "wall", "wall", "wall", "floor", "wall"}),
               {{0.5, 0.25}, {64}});
  LightState state;
  state.luminaires.resize(1);
  Luminaire& lamp = state.luminaires[0];
  lamp.position = {1.4, 1.2, 1.7};
  lamp.shape = LuminaireShape::kRectangle;
  lamp.size_m = {0.2, 0.15};
  lamp.emission.resize(2, 2);
  lamp.emission << 0.1, 0.2, 0.4, 0.3;
  lamp.distribution = Distribution::kMeasured;
  std::vector<double> gamma_rad, intensity;
  for (int j = 0; j <= 6; ++j) {
    gamma_rad.push_back(j * kPi / 12);
    intensity.push_back(0.3 + std::sin(2 * gamma_rad.back()));
  }
  lamp.table = std::make_shared<IntensityTable>(RotationalTable(gamma_rad, intensity));
  lamp.flux_lm = 500;
  state.free.resize(1);
  state.free[0] = {false, true, false, false, false};
  state.free[0].heading = true;
  state.free[0].table_sigma = 0.1;
  state.free[0].emission_sigma = 1;
  state.albedo = Eigen::Vector2d(0.6, 0.25);
  state.albedo_free = {false, false};
  state.camera_scale_free = false;
  state.sensor_gain = Eigen::Vector2d(1.02, 0.97);
  state.sensor_gains_free = true;
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d p(0.3 + 0.2 * i, 0.5 + 0.1 * i, 0.01);
    data.readings.push_back({{p, {0, 0, 1}}, 0, 100, 1, true, i % 3 - 1});
  }
  LightModel model(room, data);
  model.FreezeVisibility(state);
  const std::vector<Parameter> parameters = FreeParameters(room, state);
  ASSERT_EQ(parameters.size(), 1 + 6 + 3 + 1 + 2u);  // heading, nodes, cells, flux, gains
  const Eigen::VectorXd x = PackParameters(state, parameters);
  const Prediction prediction = model.Predict(state, parameters, true);
  for (Eigen::Index p = 0; p < x.size(); ++p) {
    constexpr double kStep = 0.01;  // as in light_model_test; light is in floats
    const auto values = [&](double step) {
      return model
          .Predict(WithParameters(state, parameters, x + step * Eigen::VectorXd::Unit(x.size(), p)), {},
                   false)
          .value;
    };
    const Eigen::VectorXd numeric = (values(kStep) - values(-kStep)) / (2 * kStep);
    const double scale = numeric.cwiseAbs().maxCoeff(), rounding = 1e-4 * prediction.value.maxCoeff();
    EXPECT_LT((prediction.jacobian.col(p) - numeric).cwiseAbs().maxCoeff(), 3e-3 * scale + rounding)
        << NameOf(parameters[static_cast<size_t>(p)].id());
    EXPECT_GT(scale, rounding) << NameOf(parameters[static_cast<size_t>(p)].id());
  }
}

TEST(PartSmoothness, StraightTablesAndEvenCellsCostNothing) {
  LightState state;
  state.luminaires.resize(1);
  Luminaire& lamp = state.luminaires[0];
  lamp.shape = LuminaireShape::kRectangle;
  lamp.emission = Eigen::ArrayXXd::Constant(3, 2, 1.0 / 6);
  lamp.distribution = Distribution::kMeasured;
  const std::vector<double> gamma_rad{0, 0.3, 0.6, 0.9, 1.2};
  lamp.table = std::make_shared<IntensityTable>(RotationalTable(gamma_rad, {1, 1, 1, 1, 1}));
  state.free.resize(1);
  state.free[0] = {false, false, false, false, false};
  state.free[0].table_sigma = 0.1;
  state.free[0].emission_sigma = 0.5;
  state.camera_scale_free = false;
  const std::vector<Parameter> parameters = FreeParameters(MakeRoom(Scene{}), state);
  const Eigen::VectorXd x = PackParameters(state, parameters);
  const std::vector<SmoothnessRow> rows = SmoothnessRows(state, parameters);
  ASSERT_EQ(rows.size(), 4u + 7u);  // nodes but the last; neighbours of 3 x 2 cells
  for (const SmoothnessRow& row : rows) EXPECT_NEAR(row.Value(x), 0, 1e-9);
  // No data: nothing is effective; data without end: everything is.
  const Eigen::Index n = x.size();
  EXPECT_NEAR(EffectiveParts(Eigen::MatrixXd::Zero(n, n), rows, parameters), 0, 1e-9);
  EXPECT_NEAR(EffectiveParts(1e12 * Eigen::MatrixXd::Identity(n, n), rows, parameters), 4 + 5, 1e-3);
}

}  // namespace
}  // namespace luxfit
