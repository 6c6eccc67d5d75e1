#include "inverse/model/internal/weights/indirect_error.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "inverse/model/internal/light_model.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

Room Box() {
  RoomOptions options;
  options.patches.patch_size_m = 0.5;
  options.patches.element_size_m = 0.25;
  return MakeRoom(support::ClosedRoom({2, 1.5, 1}, {"wall", "wall", "wall", "wall", "floor", "ceiling"}),
                  options);
}

LightState BoxState() {
  LightState state;
  state.luminaires.resize(1);
  state.luminaires[0].position = {0.8, 0.6, 0.9};
  state.luminaires[0].flux_lm = 1000;
  FreeQuantities held;
  held.position = held.flux = false;
  state.free = {held};
  state.albedo = Eigen::Vector3d(0.6, 0.3, 0.8);
  state.albedo_free = {true, true, true};
  state.camera_scale_free = false;
  return state;
}

// Readings that face up and down.
LightData BoxReadings() {
  LightData data;
  data.dimming = {Eigen::VectorXd::Constant(1, 0.7)};
  data.readings.reserve(8);
  for (int i = 0; i < 8; ++i) {
    Reading reading;
    reading.sensor = {{0.3 + 0.2 * i, 0.4 + 0.1 * i, 0.2 + 0.05 * i}, {0, 0, i % 2 == 0 ? 1.0 : -1.0}, {}};
    data.readings.push_back(reading);
  }
  return data;
}

IndirectCells CellsOf(const Room& room) { return CutIntoCells(room, {true, true, true}); }

TEST(IndirectErrorTest, CellsCoverTheSurfacesOnce) {
  const Room room = Box();
  const IndirectCells cells = CellsOf(room);
  const double area_m2 = 2 * (2 * 1.5 + 2 * 1 + 1.5 * 1);
  EXPECT_NEAR(cells.area_m2.sum(), area_m2, 1e-9);
  std::vector<int> seen(room.patches.elements.size());
  for (const CoveredSurface& surface : cells.surfaces) {
    for (const auto& [element, covered_m2] : surface.elements) {
      ++seen[static_cast<size_t>(element)];
      EXPECT_EQ(room.patches.PatchOf(element).material, surface.material);
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
  EXPECT_NEAR(CutIntoCells(room, {false, true, false}).area_m2.sum(), 2 * 1.5, 1e-9);
}

TEST(IndirectErrorTest, MeanOfAMaterialHasNoError) {
  const IndirectCells cells = CellsOf(Box());
  for (const double length_m : {0.0, 0.3, 5.0}) {
    const Eigen::MatrixXd correlation = CellCorrelation(cells, length_m);
    for (int m = 0; m < 3; ++m) {
      Eigen::VectorXd mean = cells.area_m2;
      for (Eigen::Index p = 0; p < mean.size(); ++p)
        if (cells.surface_of[static_cast<size_t>(p)][0] != m) mean[p] = 0;
      EXPECT_NEAR(mean.dot(correlation * mean) / mean.squaredNorm(), 0, 1e-9) << length_m << " " << m;
    }
    EXPECT_GE(correlation.diagonal().minCoeff(), 0);
  }
}

// By central differences of the whole model, by way of the transport's factors of patches.
TEST(IndirectErrorTest, EffectIsTheDerivativeByThePatchsFactor) {
  const Room room = Box();
  const LightData data = BoxReadings();
  const LightState state = BoxState();
  LightModel model(room, data);
  model.FreezeVisibility(state);
  const auto patches = static_cast<Eigen::Index>(room.patches.patches.size());
  std::vector<CoveredSurface> surfaces(room.patches.patches.size());
  for (size_t e = 0; e < room.patches.elements.size(); ++e) {
    const Element& element = room.patches.elements[e];
    CoveredSurface& surface = surfaces[static_cast<size_t>(element.patch)];
    surface.material = room.patches.PatchOf(static_cast<int>(e)).material;
    surface.elements.emplace_back(static_cast<int>(e), element.area_m2);
  }
  const RowMajorMatrix effect = model.LightReflectedBy(state, surfaces);
  const auto values = [&](const Eigen::VectorXd& factor) {
    model.SetPatchFactor(factor);
    model.FreezeVisibility(state);
    return model.Predict(state, {}, false).value;
  };
  constexpr double kStep = 0.05;  // light is float
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(patches);
  double squares = 0, error_squares = 0;
  for (Eigen::Index p = 0; p < patches; ++p) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(patches, p);
    const Eigen::VectorXd difference = (values(one + step) - values(one - step)) / (2 * kStep);
    squares += difference.squaredNorm();
    error_squares += (effect.col(p) - difference).squaredNorm();
  }
  // Light varies within a patch of 0.5 m below a luminaire, and the effect takes its mean: 4.3 %.
  EXPECT_LT(std::sqrt(error_squares / squares), 0.065);
}

// The parts of a material's light add up to the derivative by the logarithm of its reflectance.
TEST(IndirectErrorTest, EffectsOfAMaterialSumToTheDerivativeByItsReflectance) {
  const Room room = Box();
  const LightData data = BoxReadings();
  const LightState state = BoxState();
  LightModel model(room, data);
  model.FreezeVisibility(state);
  const std::vector<Parameter> parameters = FreeParameters(room, state);
  const Prediction prediction = model.Predict(state, parameters, true);
  const IndirectCells cells = CellsOf(room);
  const RowMajorMatrix effect = model.LightReflectedBy(state, cells.surfaces);
  for (size_t i = 0; i < parameters.size(); ++i) {
    ASSERT_EQ(parameters[i].kind, ParameterKind::kAlbedo);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(effect.rows());
    for (Eigen::Index p = 0; p < effect.cols(); ++p)
      if (cells.surface_of[static_cast<size_t>(p)][0] == parameters[i].index) sum += effect.col(p);
    const Eigen::VectorXd derivative =
        state.albedo[parameters[i].index] * prediction.jacobian.col(static_cast<Eigen::Index>(i));
    // Cells of a quarter of a metre take the mean of their patch's light.
    EXPECT_LT((sum - derivative).norm(), 0.1 * derivative.norm()) << parameters[i].index;
  }
}

// Holds a grid of readings with noise of 1 %, as rows of the reflectances, and what cells do to them.
struct GridRows {
  WeightedRows rows;
  Eigen::MatrixXd effect;
};
GridRows RowsOfGrid(const Room& room, const IndirectCells& cells) {
  constexpr double kNoise = 0.01;
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  data.readings.reserve(120);
  for (int i = 0; i < 120; ++i) {
    Reading reading;
    reading.sensor = {{0.2 + 0.4 * (i % 5), 0.2 + 0.2 * (i / 5 % 6), 0.2 + 0.2 * (i / 30)}, {0, 0, 1}, {}};
    data.readings.push_back(reading);
  }
  const LightState state = BoxState();
  LightModel model(room, data);
  model.FreezeVisibility(state);
  const Prediction prediction = model.Predict(state, FreeParameters(room, state), true);
  const Eigen::VectorXd root_weight = (kNoise * prediction.value).cwiseInverse();
  GridRows grid;
  grid.effect = root_weight.asDiagonal() * model.LightReflectedBy(state, cells.surfaces);
  grid.rows.jacobian = root_weight.asDiagonal() * prediction.jacobian;
  grid.rows.prior_information = Eigen::Matrix3d::Zero();
  return grid;
}

// Draws errors of cells and noise. The parameters' errors over the sigmas that follow from the covariance found have
// an rms of 1. Of 10 draws it is below 1.43 and above 0.57 with a probability of 95 % (chi2 of 10) for each parameter.
// Without an error of the cells, the amplitude found is small beside the one drawn.
TEST(IndirectErrorTest, SigmasFollowTheErrorsThatWereDrawn) {
  constexpr int kDraws = 10;
  constexpr double kTau = 0.3;
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  const Room room = Box();
  const IndirectCells cells = CellsOf(room);
  GridRows grid = RowsOfGrid(room, cells);
  WeightedRows& rows = grid.rows;
  const Eigen::MatrixXd inverse = InverseOf(rows.jacobian.transpose() * rows.jacobian);
  const auto draw_rows = [&](double tau) {
    Eigen::VectorXd t(grid.effect.cols()), noise(grid.effect.rows());
    for (double& x : t) x = tau * normal(rng);
    for (double& x : noise) x = normal(rng);
    return Eigen::VectorXd(grid.effect * t + noise);
  };
  const auto root_of = [&](const Eigen::VectorXd& error, const Eigen::VectorXd& moved) {
    rows.residual = rows.jacobian * moved - error;
    return RootOfCellErrors(rows, Eigen::Vector3d::Zero(), grid.effect, cells,
                            static_cast<int>(error.size()));
  };
  Eigen::ArrayXXd z(kDraws, 3);
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::VectorXd error = draw_rows(kTau);
    const Eigen::VectorXd moved = inverse * (rows.jacobian.transpose() * error);
    const Eigen::MatrixXd shift =
        inverse * (rows.jacobian.transpose() * (grid.effect * root_of(error, moved)));
    const Eigen::VectorXd variance = inverse.diagonal() + shift.rowwise().squaredNorm();
    z.row(draw) = (moved.array() / variance.array().sqrt()).transpose();
  }
  for (int m = 0; m < 3; ++m) {
    const double rms = std::sqrt(z.col(m).square().mean());
    EXPECT_LT(rms, 1.43) << m;
    EXPECT_GT(rms, 0.57) << m;
  }
  const Eigen::VectorXd noise = draw_rows(0);
  const Eigen::MatrixXd root = root_of(noise, inverse * (rows.jacobian.transpose() * noise));
  EXPECT_LT(std::sqrt(root.squaredNorm() / CellCorrelation(cells, 0).trace()), 0.5 * kTau);
}

TEST(IndirectErrorTest, AMaterialIsSeenByRowsOfWeightOnly) {
  const Room room = Box();
  LightData data;
  for (const int material : {0, 1}) {
    int e = 0;
    while (room.patches.PatchOf(e).material != material) ++e;
    Observation o;
    o.element = e;
    data.observations.push_back(o);
  }
  EXPECT_EQ(MaterialsWithoutPhotos(room, data, Eigen::Vector2d(1, 1)),
            (std::vector<bool>{false, false, true}));
  EXPECT_EQ(MaterialsWithoutPhotos(room, data, Eigen::Vector2d(1, 0)),
            (std::vector<bool>{false, true, true}));
  EXPECT_EQ(MaterialsWithoutPhotos(room, {}, {}), (std::vector<bool>{true, true, true}));
}

}  // namespace
}  // namespace luxfit
