#include "inverse/model/internal/cross_validation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <tuple>

#include "tests/support/closed_forms.h"
#include "tests/support/inverse/partition_readings.h"
#include "tests/support/inverse/plane_readings.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr int kFolds = 5;
constexpr double kNoise = 0.01;

// Rows 0, 5, 10, ... are fold 0, and so on.
std::vector<int> FoldsInTurn(size_t rows) {
  std::vector<int> folds;
  for (size_t i = 0; i < rows; ++i) folds.push_back(static_cast<int>(i) % kFolds);
  return folds;
}

// Weights are the same in fit and refit, as the prediction assumes: the model error stays at its lower bound,
// which is above the readings' scatter, and no row is an outlier.
FitLuminairesOptions SteadyWeights() {
  FitLuminairesOptions options;
  options.robust_sigmas = 1e3;
  options.initial_relative_sigma = options.min_relative_sigma = 0.02;
  return options;
}

LuminaireFit FitWithout(const Room& room, LightData data, const LuminaireFit& whole,
                        const std::vector<ParameterPrior>& priors, const std::vector<int>& fold_of_row,
                        int fold, const FitLuminairesOptions& options) {
  for (size_t i = 0; i < data.readings.size(); ++i) data.readings[i].used = fold_of_row[i] != fold;
  return FitLuminaires(room, data, whole.state, priors, options);
}

// Compares predictions of rows left out with those of refits, in sigmas of the readings.
struct Comparison {
  double rms_error = 0;
  double rms_move = 0;  // of the refits' predictions from those of the fit to all rows
};
Comparison CompareWithRefits(const Room& room, const LightData& data, const LuminaireFit& fit,
                             const std::vector<ParameterPrior>& priors, const FitLuminairesOptions& options,
                             const std::vector<int>& fold_of_row) {
  const LeftOutPrediction left_out = PredictLeftOut(room, data, fit, priors, fold_of_row);
  Comparison result;
  for (int fold = 0; fold < kFolds; ++fold) {
    const LuminaireFit refit = FitWithout(room, data, fit, priors, fold_of_row, fold, options);
    EXPECT_TRUE(refit.IsUsable()) << refit.message;
    for (size_t i = 0; i < data.readings.size(); ++i) {
      if (fold_of_row[i] != fold) continue;
      const auto row = static_cast<Eigen::Index>(i);
      const double sigma = data.readings[i].sigma_lx;
      result.rms_error += std::pow((left_out.value[row] - refit.predicted[row]) / sigma, 2);
      result.rms_move += std::pow((refit.predicted[row] - fit.predicted[row]) / sigma, 2);
    }
  }
  const auto rows = static_cast<double>(data.readings.size());
  result.rms_error = std::sqrt(result.rms_error / rows), result.rms_move = std::sqrt(result.rms_move / rows);
  return result;
}

// Two Lambertian points at places that are known, both on; only their fluxes are free.
class TwoFluxes : public testing::Test {
 protected:
  static double PerLumen(const Eigen::Vector3d& lamp, const Eigen::Vector3d& p) {
    return support::PointLx(1, support::LambertianCdPerLm, lamp, p);
  }
  TwoFluxes() {
    start_.luminaires.resize(2);
    for (size_t k = 0; k < 2; ++k) {
      Luminaire& lamp = start_.luminaires[k];
      lamp.id = k == 0 ? "A" : "B";
      lamp.position = k == 0 ? a_ : b_;
      lamp.flux_lm = 600;
    }
    start_.free.resize(2);
    for (FreeQuantities& free : start_.free) free.position = false;
    start_.camera_scale_free = false;
  }
  LightData ReadBoth() {
    LightData data;
    data.dimming = {Eigen::Vector2d(1, 1)};
    const auto lux = [&](const Eigen::Vector3d& p) { return 800 * PerLumen(a_, p) + 300 * PerLumen(b_, p); };
    data.readings = support::ReadAt(support::PlanePoints(5, 3, 0), lux, kNoise, rng_);
    return data;
  }

  const Eigen::Vector3d a_{-0.6, 0.1, 1.4}, b_{0.8, -0.2, 1.1};
  const Room room_ = MakeRoom(Scene{});
  std::mt19937_64 rng_ = support::TestRng();
  LightState start_;
};

// The fit without each fold from the closed forms alone, as linear least squares in the two fluxes. What is
// left: the logarithm's curvature, a few tenths of a percent squared; and floats.
TEST_F(TwoFluxes, PredictionsAreThoseOfLinearLeastSquares) {
  const LightData data = ReadBoth();
  const auto rows = static_cast<Eigen::Index>(data.readings.size());
  const FitLuminairesOptions options = SteadyWeights();
  const LuminaireFit fit = FitLuminaires(room_, data, start_, {}, options);
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
  const std::vector<int> fold_of_row = FoldsInTurn(data.readings.size());
  const LeftOutPrediction left_out = PredictLeftOut(room_, data, fit, {}, fold_of_row);
  ASSERT_EQ(left_out.value.size(), rows);
  EXPECT_EQ(left_out.relative_sigma, fit.relative_sigma);
  Eigen::MatrixXd per_lumen(rows, 2);
  Eigen::VectorXd value(rows), sigma(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Reading& reading = data.readings[static_cast<size_t>(i)];
    per_lumen.row(i) << PerLumen(a_, reading.sensor.position), PerLumen(b_, reading.sensor.position);
    value[i] = reading.illuminance_lx;
    sigma[i] = std::hypot(reading.sigma_lx, fit.relative_sigma * value[i]);
  }
  double largest_move = 0, largest_error = 0;
  for (int fold = 0; fold < kFolds; ++fold) {
    Eigen::VectorXd weight = sigma.cwiseInverse();
    for (Eigen::Index i = fold; i < rows; i += kFolds) weight[i] = 0;
    const Eigen::Vector2d flux =
        (weight.asDiagonal() * per_lumen).colPivHouseholderQr().solve(weight.cwiseProduct(value).eval());
    for (Eigen::Index i = fold; i < rows; i += kFolds) {
      const double expected = per_lumen.row(i) * flux;
      largest_error = std::max(largest_error, std::abs(left_out.value[i] - expected) / sigma[i]);
      largest_move = std::max(largest_move, std::abs(fit.predicted[i] - expected) / sigma[i]);
    }
  }
  std::printf("linear: error %.5f sigma, move %.3f sigma\n", largest_error, largest_move);
  EXPECT_LT(largest_error, 0.001);
  EXPECT_GT(largest_move, 0.05);
}

// Without the only fold where B shines, nothing says how bright B is.
TEST_F(TwoFluxes, AFluxThatOneFoldAloneDeterminesStays) {
  LightData data;
  data.dimming = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)};
  std::vector<int> fold_of_row;
  for (const auto& [state, lamp, side] : {std::tuple{0, a_, 6}, {1, b_, 3}}) {
    const auto lux = [&, at = lamp](const Eigen::Vector3d& p) { return 500 * PerLumen(at, p); };
    for (const Reading& reading :
         support::ReadAt(support::PlanePoints(side, 2, 0), lux, kNoise, rng_, state)) {
      data.readings.push_back(reading);
      fold_of_row.push_back(state == 1 ? 0 : 1 + static_cast<int>(fold_of_row.size()) % 4);
    }
  }
  const LuminaireFit fit = FitLuminaires(room_, data, start_, {}, SteadyWeights());
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
  const LeftOutPrediction left_out = PredictLeftOut(room_, data, fit, {}, fold_of_row);
  bool has_moved = false;
  for (size_t i = 0; i < data.readings.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double move = std::abs(left_out.value[row] - fit.predicted[row]) / data.readings[i].sigma_lx;
    if (fold_of_row[i] == 0) {
      EXPECT_LT(move, 1e-4) << i;
    }
    has_moved = has_moved || (fold_of_row[i] != 0 && move > 0.05);
  }
  EXPECT_TRUE(has_moved);  // A is told by the other folds
}

// A Lambertian point whose position and flux are free.
class OneLamp : public testing::Test {
 protected:
  OneLamp() {
    start_ = support::CosinePowerStart(lamp_ + Eigen::Vector3d(0.1, -0.1, 0.1), 1);
    start_.luminaires[0].distribution = Distribution::kLambertian;
    start_.free[0].exponent = false;
  }
  LightData Read(int side, double noise = kNoise) {
    const auto lux = [&](const Eigen::Vector3d& p) {
      return support::PointLx(800, support::LambertianCdPerLm, lamp_, p);
    };
    LightData data;
    data.dimming = {Eigen::VectorXd::Ones(1)};
    data.readings = support::ReadAt(support::PlanePoints(side, 2.5, 0), lux, noise, rng_);
    return data;
  }

  const Eigen::Vector3d lamp_{0.33, -0.41, 1.27};
  const Room room_ = MakeRoom(Scene{});
  std::mt19937_64 rng_ = support::TestRng();
  LightState start_;
};

// One step leaves out the model's curvature over moves of some millimetres.
TEST_F(OneLamp, PredictionsAreThoseOfRefits) {
  const FitLuminairesOptions options = SteadyWeights();
  for (int draw = 0; draw < 5; ++draw) {
    const LightData data = Read(6);
    const LuminaireFit fit = FitLuminaires(room_, data, start_, {}, options);
    ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
    const Comparison with =
        CompareWithRefits(room_, data, fit, {}, options, FoldsInTurn(data.readings.size()));
    std::printf("position and flux: error %.5f sigma, move %.3f sigma\n", with.rms_error, with.rms_move);
    EXPECT_LT(with.rms_error, 0.0025);
    EXPECT_GT(with.rms_move, 0.1);
  }
}

// Robust weights and model error at their defaults: those of a refit to 29 of 36 readings differ.
TEST_F(OneLamp, PredictionsAreNearThoseOfRefitsWithWeightsOfTheirOwn) {
  for (int draw = 0; draw < 5; ++draw) {
    const LightData data = Read(6);
    const LuminaireFit fit = FitLuminaires(room_, data, start_);
    ASSERT_TRUE(fit.IsUsable()) << fit.message;
    const Comparison with = CompareWithRefits(room_, data, fit, {}, {}, FoldsInTurn(data.readings.size()));
    std::printf("own weights: error %.5f sigma, move %.3f sigma\n", with.rms_error, with.rms_move);
    EXPECT_LT(with.rms_error, 0.06);
    EXPECT_GT(with.rms_move, 0.1);
  }
}

// Readings of 10 %, and an exponent beside: without the readings of one side, the luminaire moves by decimetres.
// One step errs by two thirds of the move there; the steps together come near the refit.
TEST_F(OneLamp, StepsFollowWhereOneIsNotEnough) {
  start_.luminaires[0].distribution = Distribution::kCosinePower;
  start_.free[0].exponent = true;
  FitLuminairesOptions options = SteadyWeights();
  options.initial_relative_sigma = options.min_relative_sigma = 0.2;
  double error = 0, move = 0;
  for (int draw = 0; draw < 10; ++draw) {
    const LightData data = Read(6, 0.1);
    const LuminaireFit fit = FitLuminaires(room_, data, start_, {}, options);
    ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
    std::vector<int> fold_of_row;
    for (const Reading& r : data.readings) fold_of_row.push_back(r.sensor.position.x() > -0.5 ? 0 : 1);
    const Comparison with = CompareWithRefits(room_, data, fit, {}, options, fold_of_row);
    error += with.rms_error, move += with.rms_move;
  }
  std::printf("far: error %.3f sigma, move %.3f sigma\n", error / 10, move / 10);
  EXPECT_LT(error, 0.15 * move);
  EXPECT_GT(move, 10);
}

// A height stated to 5 mm, 10 mm beside the truth: it says as much as the readings do.
TEST_F(OneLamp, PriorsCountInEveryFold) {
  ParameterPrior height;
  height.quantity = LuminaireQuantity::kPositionZ;
  height.mean = lamp_.z() + 0.01;
  height.sigma = 0.005;
  const FitLuminairesOptions options = SteadyWeights();
  const LightData data = Read(6);
  const LuminaireFit fit = FitLuminaires(room_, data, start_, {height}, options);
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
  const Comparison with =
      CompareWithRefits(room_, data, fit, {height}, options, FoldsInTurn(data.readings.size()));
  std::printf("prior: error %.5f sigma, move %.3f sigma\n", with.rms_error, with.rms_move);
  EXPECT_LT(with.rms_error, 0.0025);
  EXPECT_GT(with.rms_move, 0.1);
}

// All readings but two are in one fold: two rows for four parameters. The other directions stay.
TEST_F(OneLamp, DirectionsThatOneFoldAloneDeterminesStay) {
  const LightData data = Read(6);
  const LuminaireFit fit = FitLuminaires(room_, data, start_, {}, SteadyWeights());
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
  std::vector<int> fold_of_row(data.readings.size(), 0);
  fold_of_row[8] = fold_of_row[21] = 1;
  const LeftOutPrediction left_out = PredictLeftOut(room_, data, fit, {}, fold_of_row);
  double largest_move = 0;
  for (Eigen::Index i = 0; i < left_out.value.size(); ++i) {
    const double sigma = data.readings[static_cast<size_t>(i)].sigma_lx;
    largest_move = std::max(largest_move, std::abs(left_out.value[i] - fit.predicted[i]) / sigma);
  }
  std::printf("two rows: move %.2f sigma\n", largest_move);
  EXPECT_GT(largest_move, 0.5);
  EXPECT_LT(largest_move, 5);  // two residuals of a sigma or two, carried by the least move
}

TEST_F(OneLamp, ReadingsAreSmooth) {
  const LightData data = Read(4);
  const LuminaireFit fit = FitLuminaires(room_, data, start_);
  const LeftOutPrediction left_out = PredictLeftOut(room_, data, fit, {}, FoldsInTurn(data.readings.size()));
  EXPECT_EQ(left_out.is_smooth, std::vector<bool>(data.readings.size(), true));
}

TEST_F(OneLamp, WhereNothingIsFreeTheFitPredicts) {
  const LightData data = Read(4);
  start_.free[0].position = start_.free[0].flux = false;
  const LuminaireFit fit = FitLuminaires(room_, data, start_);
  const LeftOutPrediction left_out = PredictLeftOut(room_, data, fit, {}, FoldsInTurn(data.readings.size()));
  EXPECT_EQ(left_out.value, fit.predicted);
}

// A panel of 0.4 m beside a partition, seen by a camera: the partition's top edge at 1.6 m casts the panel's
// edges at x = -1.2 and -0.8 m, y about 0, on the floor at x_floor = -x (1.6 - floor) / (z - 1.6).
TEST(PredictLeftOut, RowsAtShadowEdgesAreNotSmooth) {
  RoomOptions room_options;
  room_options.patches.element_size_m = 0.1;
  const Room room = MakeRoom(support::PartitionScene(), room_options);
  const Eigen::Vector3d panel(-1, 0, 2.6);
  constexpr double kFloorZ = -0.01, kRho = 0.5;
  const auto shadow_of = [&](double x) { return -x * (1.6 - kFloorZ) / (panel.z() - 1.6); };
  LightState start;
  start.luminaires.resize(1);
  start.luminaires[0].id = "A";
  start.luminaires[0].position = panel;
  start.luminaires[0].shape = LuminaireShape::kRectangle;
  start.luminaires[0].size_m.setConstant(0.4);
  start.luminaires[0].flux_lm = 700;
  start.free.resize(1);
  start.free[0].position = false;
  start.albedo = Eigen::Vector3d::Constant(kRho);
  start.albedo_free.assign(3, false);
  start.camera_scale_free = false;
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  data.indirect_is_held = true;  // and there is none
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  enum class Light { kWhole, kEdge, kNone };
  std::vector<Light> light;
  for (size_t e = 0; e < room.patches.elements.size(); ++e) {
    const Element& element = room.patches.elements[e];
    const Eigen::Vector3d& p = element.center;
    if (element.normal.z() < 0.5 || p.z() > 0 || std::abs(p.y()) > 1) continue;
    // Quarters of a panel and of an element are far enough inside.
    const double near = shadow_of(-0.8), far = shadow_of(-1.2);
    Light kind = Light::kEdge;
    if (p.x() < -0.2 || p.x() > far + 0.1)
      kind = Light::kWhole;
    else if (p.x() > 0.2 && p.x() < near - 0.1)
      kind = Light::kNone;
    else if (p.x() < shadow_of(-0.9) || p.x() > shadow_of(-1.1))
      continue;
    const double lx = kind == Light::kNone ? 0 : support::LambertianRectangleLx(800, panel, 0.4, 0.4, p);
    Observation o;
    o.element = static_cast<int>(e);
    o.relative_luminance = kRho / support::kPi * lx * (1 + kNoise * normal(rng));
    o.variance = std::pow(kNoise * o.relative_luminance + 0.01, 2);
    data.observations.push_back(o);
    light.push_back(kind);
  }
  const LuminaireFit fit = FitLuminaires(room, data, start);
  ASSERT_TRUE(fit.IsUsable()) << fit.message;
  const LeftOutPrediction left_out =
      PredictLeftOut(room, data, fit, {}, FoldsInTurn(data.observations.size()));
  std::array<int, 3> count{};
  for (size_t i = 0; i < light.size(); ++i) {
    ++count[static_cast<size_t>(light[i])];
    EXPECT_EQ(left_out.is_smooth[i], light[i] != Light::kEdge)
        << room.patches.elements[static_cast<size_t>(data.observations[i].element)].center.transpose();
    if (light[i] == Light::kNone) {
      EXPECT_EQ(left_out.value[static_cast<Eigen::Index>(i)], 0);
    }
  }
  for (const int each : count) EXPECT_GT(each, 20);
  // 800 lm from the rows that are smooth; the start and half-lit rows say otherwise.
  EXPECT_NEAR(fit.state.luminaires[0].flux_lm, 800, 2);
}

}  // namespace
}  // namespace luxfit
