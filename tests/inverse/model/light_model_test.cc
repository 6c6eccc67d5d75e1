#include "inverse/model/internal/light_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "forward/luminaire/luminaire_parts.h"
#include "tests/support/closed_forms.h"
#include "tests/support/room_with_screen.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// Compares every column of the Jacobian with a central difference.
void ExpectCentralDifferences(const Room& room, const LightData& data, const LightState& state,
                              const std::vector<Parameter>& parameters) {
  LightModel model(room, data);
  model.FreezeVisibility(state);
  const Eigen::VectorXd x = PackParameters(state, parameters);
  const Prediction prediction = model.Predict(state, parameters, true);
  for (Eigen::Index p = 0; p < x.size(); ++p) {
    // Steps and tolerances as in forward's illuminance_test: truncation (h / d)^2 = 3e-4 times a few,
    // rounding of floats 1e-6 / h of the value. Logarithms and albedos curve less than 1 / r^2.
    constexpr double kStep = 0.01;
    const auto values = [&](double step) {
      return model
          .Predict(WithParameters(state, parameters, x + step * Eigen::VectorXd::Unit(x.size(), p)), {},
                   false)
          .value;
    };
    const Eigen::VectorXd numeric = (values(kStep) - values(-kStep)) / (2 * kStep);
    const Eigen::VectorXd error = prediction.jacobian.col(p) - numeric;
    // Observations and readings are in different units: each in its own.
    const auto readings = static_cast<Eigen::Index>(data.readings.size());
    const Eigen::Index observations = x.size() > 0 ? numeric.size() - readings : 0;
    for (const auto& [first, count] : {std::pair{Eigen::Index{0}, observations}, {observations, readings}}) {
      const double scale = numeric.segment(first, count).cwiseAbs().maxCoeff();
      const double rounding = 1e-4 * prediction.value.segment(first, count).maxCoeff();
      EXPECT_LT(error.segment(first, count).cwiseAbs().maxCoeff(), 3e-3 * scale + rounding)
          << NameOf(parameters[static_cast<size_t>(p)].id());
    }
    const bool is_of_meter = parameters[static_cast<size_t>(p)].kind == ParameterKind::kLogMeterScale;
    const double moved =
        (is_of_meter ? numeric.tail(readings) : numeric.head(observations)).cwiseAbs().maxCoeff();
    EXPECT_GT(moved, 0) << NameOf(parameters[static_cast<size_t>(p)].id());
  }
}

// A small room with a screen, two lamps and three states. Lamps keep 0.6 m from everything and are no larger
// than 0.2 m, so that no step changes the order of their quadrature.
class SmallRoom : public testing::Test {
 protected:
  SmallRoom() : room_(MakeRoom(support::RoomWithScreen(), {{0.5, 0.25}, {64}})) {
    state_.luminaires.resize(2);
    Luminaire &a = state_.luminaires[0], &b = state_.luminaires[1];
    a.id = "A";
    a.position = Eigen::Vector3d(0.9, 1.1, 1.6);
    a.aim = Eigen::Vector3d(0.2, -0.1, -1).normalized();
    a.distribution = Distribution::kCosinePower;
    a.cosine_exponent = 3;
    a.shape = LuminaireShape::kRectangle;
    a.size_m = {0.2, 0.15};
    a.flux_lm = 700;
    b.id = "B";
    b.position = Eigen::Vector3d(2.3, 1.3, 1.5);
    b.distribution = Distribution::kIsotropic;
    b.flux_lm = 400;
    state_.free = {{true, true, true, true, true}, {}};
    state_.albedo = Eigen::Vector3d(0.6, 0.25, 0.4);
    state_.albedo_free = {true, true, true};
    state_.camera_scale = 0.02;
    data_.dimming = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(0.3, 1)};
    for (int e = 0; e < static_cast<int>(room_.patches.elements.size()); e += 11) {
      Observation o;
      o.element = e;
      o.state = e % 3;
      data_.observations.push_back(o);
    }
    for (int s = 0; s < 3; ++s) data_.readings.push_back({{{0.5, 0.5, 0.01}, {0, 0, 1}}, s, 100, 1, true});
  }

  Room room_;
  LightData data_;
  LightState state_;
};

TEST_F(SmallRoom, JacobianIsACentralDifferenceInEveryParameter) {
  state_.meter_scale_free = true;
  state_.meter_scale = 1.07;
  state_.ambient_share = Eigen::Vector3d(0.05, -0.1, 0.2);
  state_.ambient_shares_free = true;
  for (Observation& o : data_.observations) o.relative_ambient = 0.1 + 0.001 * o.element;
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  // A: 3 position, exponent, 2 sizes, 2 tilts, flux; B: 3 position, flux; 3 albedos; camera and meter scale; ambient light by state.
  ASSERT_EQ(parameters.size(), 21u);
  ExpectCentralDifferences(room_, data_, state_, parameters);
}

TEST_F(SmallRoom, JacobianOfATypeIsThatOfAllItsLuminaires) {
  state_.meter_scale_free = true;
  state_.free[0].heading = true;
  state_.first_of_type = {0, 0};
  state_ = WithLikeTypes(state_);
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  // As above with a heading; B's own are its position and flux.
  ASSERT_EQ(parameters.size(), 19u);
  EXPECT_EQ(std::count_if(parameters.begin(), parameters.end(),
                          [](const Parameter& p) { return p.tied == std::vector<int>{1}; }),
            6);
  ExpectCentralDifferences(room_, data_, state_, parameters);
}

TEST_F(SmallRoom, JacobianOfATypeWithDirectionsOfTheirOwn) {
  state_.free[0].heading = true;
  state_.first_of_type = {0, 0};
  const Eigen::Vector3d aim = Eigen::Vector3d(0.3, -0.2, -1).normalized();
  state_.luminaires[1].aim = aim;
  for (FreeQuantities& free : state_.free) free.own_direction = free.tilt = true;
  state_ = WithLikeTypes(state_);
  EXPECT_EQ(state_.luminaires[1].aim, aim);
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  EXPECT_EQ(std::count_if(parameters.begin(), parameters.end(),
                          [](const Parameter& p) { return p.tied == std::vector<int>{1}; }),
            3)
      << "exponent and sizes";
  ExpectCentralDifferences(room_, data_, state_, parameters);
}

TEST_F(SmallRoom, LuminairesOfATypeAreAlikeButForPlaceAndFlux) {
  state_.first_of_type = {0, 0};
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  Eigen::VectorXd x = PackParameters(state_, parameters);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += 0.01 * static_cast<double>(i + 1);
  const LightState moved = WithParameters(state_, parameters, x);
  const Luminaire &a = moved.luminaires[0], &b = moved.luminaires[1];
  EXPECT_EQ(a.cosine_exponent, b.cosine_exponent);
  EXPECT_EQ(a.size_m, b.size_m);
  EXPECT_EQ(a.aim, b.aim);
  EXPECT_EQ(b.shape, LuminaireShape::kRectangle);
  EXPECT_EQ(b.id, "B");
  EXPECT_GT((a.position - b.position).norm(), 1);
  EXPECT_NE(a.flux_lm, b.flux_lm);
  EXPECT_EQ(TypesOf(moved), (std::vector<std::vector<int>>{{0, 1}}));
  EXPECT_LT((PackParameters(moved, parameters) - x).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(SmallRoom, RefreezingTracesThoseThatMoved) {
  LightModel model(room_, data_), anew(room_, data_);
  model.FreezeVisibility(state_);
  const Eigen::VectorXd before = model.Predict(state_, {}, false).value;
  const Eigen::MatrixXf at_start = model.frozen().elements;
  LightState moved = state_;
  moved.luminaires[1].position.x() += 0.4;
  anew.FreezeVisibility(moved);
  model.RefreezeVisibility(moved, 3, 1.0);
  EXPECT_EQ(model.frozen().elements.col(1), at_start.col(1)) << "within the tolerance";
  model.RefreezeVisibility(moved, 3, 0.1);
  EXPECT_EQ(model.frozen().elements, anew.frozen().elements);
  EXPECT_EQ(model.Predict(moved, {}, false).value, anew.Predict(moved, {}, false).value);
  EXPECT_NE(model.Predict(moved, {}, false).value, before);
}

TEST_F(SmallRoom, AnotherModelTakesVisibilityOver) {
  LightModel model(room_, data_), other(room_, data_);
  model.FreezeVisibility(state_);
  other.TakeOver(model.frozen());
  other.RefreezeVisibility(state_, 3, 1e-3);
  EXPECT_EQ(other.Predict(state_, {}, false).value, model.Predict(state_, {}, false).value);
}

// Where the indirect light is held, receivers alone are traced: the shares of all elements hold them, and those of the
// same elements do, but no others.
TEST_F(SmallRoom, AModelOfHeldLightTakesVisibilityOver) {
  LightData held = data_;
  held.readings.clear();
  held.indirect_is_held = true;
  LightData fewer = held;
  fewer.observations.resize(held.observations.size() / 2);
  LightState moved = state_;
  moved.luminaires[0].position.x() += 0.4;
  LightModel whole(room_, data_), own(room_, held);
  whole.FreezeVisibility(moved), own.FreezeVisibility(moved);
  const Eigen::VectorXd at_moved = own.Predict(state_, {}, false).value;
  constexpr double kAnyMove = 1.0;  // what was taken over stays
  for (const FrozenLight& frozen : {whole.frozen(), own.frozen()}) {
    LightModel other(room_, held);
    other.TakeOver(frozen);
    other.RefreezeVisibility(state_, 3, kAnyMove);
    EXPECT_EQ(other.Predict(state_, {}, false).value, at_moved);
  }
  LightModel other(room_, fewer), anew(room_, fewer);
  other.TakeOver(own.frozen());
  other.RefreezeVisibility(state_, 3, kAnyMove);
  anew.FreezeVisibility(state_);
  EXPECT_EQ(other.Predict(state_, {}, false).value, anew.Predict(state_, {}, false).value);
}

TEST_F(SmallRoom, StatesAreSumsOfTheirLuminaires) {
  LightData one_place;
  one_place.dimming = data_.dimming;
  for (int s = 0; s < 3; ++s) {
    Observation o;
    o.element = 40;
    o.state = s;
    one_place.observations.push_back(o);
  }
  one_place.readings = data_.readings;
  LightModel model(room_, one_place);
  model.FreezeVisibility(state_);
  const Eigen::VectorXd value = model.Predict(state_, {}, false).value;
  ASSERT_EQ(value.size(), 6);
  EXPECT_NEAR(value[2], 0.3 * value[0] + value[1], 1e-6 * value[2]);  // float rounding
  EXPECT_NEAR(value[5], 0.3 * value[3] + value[4], 1e-6 * value[5]);
}

// A floor in a black room, where all light is direct: under a point and a panel, each at its own level.
// kRho / kPi is the luminance that 1 lx gives a diffuse surface.
TEST(LightModelClosedForm, AFloorInABlackRoomIsLitByTheInverseSquareAndCosineLaw) {
  constexpr double kRho = 0.3, kCameraScale = 0.02;
  const Room room =
      MakeRoom(support::ClosedRoom({3, 2, 2.4}, {"wall", "wall", "wall", "wall", "floor", "wall"}),
               {{0.5, 0.25}, {16}});
  const Eigen::Vector3d p_point(0.9, 1.1, 1.6), p_panel(2.2, 0.8, 1.4);
  LightState state;
  state.luminaires.resize(2);
  state.luminaires[0].position = p_point;
  state.luminaires[0].distribution = Distribution::kIsotropic;
  state.luminaires[0].flux_lm = 700;
  state.luminaires[1].position = p_panel;
  state.luminaires[1].distribution = Distribution::kLambertian;
  state.luminaires[1].shape = LuminaireShape::kRectangle;
  state.luminaires[1].size_m = {0.6, 0.3};
  state.luminaires[1].flux_lm = 400;
  state.free.resize(2);
  state.albedo = Eigen::Vector2d(0, kRho);
  state.albedo_free = {false, false};
  state.camera_scale = kCameraScale;
  ASSERT_EQ(room.scene.materials.at(1), "floor");
  LightData data;
  data.dimming = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0.3, 0.8)};
  const auto lux = [&](const Eigen::Vector3d& p, int s) {
    const double of_point = support::PointLx(700, support::IsotropicCdPerLm, p_point, p),
                 of_panel = support::LambertianRectangleLx(400, p_panel, 0.6, 0.3, p);
    return s == 0 ? of_point : 0.3 * of_point + 0.8 * of_panel;
  };
  std::vector<double> expected;
  for (int e = 0; e < static_cast<int>(room.patches.elements.size()); ++e) {
    if (room.patches.PatchOf(e).material != 1) continue;
    for (int s = 0; s < 2; ++s) {
      Observation o;
      o.element = e;
      o.state = s;
      data.observations.push_back(o);
      const double lx = lux(room.patches.elements[static_cast<size_t>(e)].center, s);
      expected.push_back(kCameraScale * kRho / support::kPi * lx);
    }
  }
  ASSERT_EQ(expected.size(), 2u * 12 * 8);
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.4, 0.5, 0.3), {1.5, 1.2, 0.75}, {2.6, 0.6, 0.75}}) {
    for (int s = 0; s < 2; ++s) {
      data.readings.push_back({{p, {0, 0, 1}}, s, 100, 1, true});
      expected.push_back(lux(p, s));
    }
  }
  LightModel model(room, data);
  model.FreezeVisibility(state);
  const Prediction prediction = model.Predict(state, {}, false);
  ASSERT_EQ(prediction.value.size(), static_cast<Eigen::Index>(expected.size()));
  for (size_t i = 0; i < expected.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    // The quadrature of luminous surfaces, as in forward's direct_light_test.
    EXPECT_NEAR(prediction.value[row] / expected[i], 1, 1e-3) << i;
    EXPECT_NEAR(prediction.direct[row] / prediction.value[row], 1, 1e-6) << i;  // floats
  }
}

bool IsTilt(const Parameter& p) {
  return p.kind == ParameterKind::kLuminaire &&
         (p.quantity == LuminaireQuantity::kTiltAlong || p.quantity == LuminaireQuantity::kTiltAcross);
}

// Every kind of parameter and every quantity of a luminaire at once.
LightState WithEverythingFree(LightState state) {
  state.free[0].heading = true;
  Luminaire table = state.luminaires[1], cells = state.luminaires[0];
  table.id = "T";
  table.distribution = Distribution::kMeasured;
  table.table = std::make_shared<IntensityTable>(RotationalTable({0, 0.4, 0.8, 1.2, 1.5}, {5, 4, 3, 2, 1}));
  cells.id = "C";
  cells.distribution = Distribution::kLambertian;
  cells.emission = Eigen::ArrayXXd::Constant(2, 3, 1.0 / 6);
  cells.emission(1, 1) = 2.0 / 6;
  cells.emission /= cells.emission.sum();
  Luminaire sides = table;
  sides.id = "S";
  sides.table = std::make_shared<IntensityTable>(TwoSidedTable(0.3));
  state.luminaires.insert(state.luminaires.end(), {table, cells, sides});
  FreeQuantities of_table, of_cells, of_sides;
  of_table.table_sigma = 0.1;
  of_cells.emission_sigma = 1;
  of_sides.sides = true;
  state.free.insert(state.free.end(), {of_table, of_cells, of_sides});
  state.meter_scale_free = state.sensor_gains_free = true;
  state.sensor_gain = Eigen::Vector2d(1.02, 0.97);
  state.ambient_share = Eigen::Vector3d(0.05, -0.1, 0.2);
  state.ambient_shares_free = true;
  return state;
}

// A disc in the open room lights the ceiling as well; readings of a cosine and of a cylinder.
TEST_F(SmallRoom, DerivativeByTheShareOfASideIsACentralDifference) {
  Luminaire& lamp = state_.luminaires[0];
  lamp.distribution = Distribution::kMeasured;
  lamp.table = std::make_shared<IntensityTable>(TwoSidedTable(0.3));
  lamp.shape = LuminaireShape::kDisc;
  lamp.size_m = {0.2, 0.2};
  state_.free[0] = {};
  state_.free[0].sides = true;
  data_.readings.push_back({{{0.5, 0.5, 0.8}, {0, 0, 1}, {ResponseKind::kCylindrical}}, 0, 100, 1, true});
  LightModel model(room_, data_);
  model.FreezeVisibility(state_);
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  const auto side = std::find_if(parameters.begin(), parameters.end(), [](const Parameter& p) {
    return p.Is(ParameterKind::kLuminaire, 0, LuminaireQuantity::kSide);
  });
  ASSERT_NE(side, parameters.end());
  EXPECT_EQ(side->part, 1);  // over the larger share, that of the light down
  const Eigen::Index p = side - parameters.begin();
  const Eigen::VectorXd x = PackParameters(state_, parameters);
  EXPECT_NEAR(x[p], 0.3 / 0.7, 1e-12);
  constexpr double kStep = 0.01;  // light is a ratio of linear functions of it: truncation step^2
  const auto values = [&](double step) {
    Eigen::VectorXd moved = x;
    moved[p] += step;
    return model.Predict(WithParameters(state_, parameters, moved), {}, false).value;
  };
  const Prediction at = model.Predict(state_, parameters, true);
  const Eigen::VectorXd numeric = (values(kStep) - values(-kStep)) / (2 * kStep);
  EXPECT_GT(numeric.norm(), 0.1 * at.value.norm());
  for (Eigen::Index i = 0; i < numeric.size(); ++i)
    EXPECT_NEAR(at.jacobian(i, p), numeric[i], 3e-4 * std::abs(at.value[i]) + 1e-9) << i;
}

TEST_F(SmallRoom, PackAndWithAreInverseInEveryParameter) {
  const LightState state = WithEverythingFree(state_);
  const std::vector<Parameter> parameters = FreeParameters(room_, state);
  std::set<std::pair<ParameterKind, LuminaireQuantity>> kinds;
  for (const Parameter& p : parameters) kinds.insert({p.kind, p.quantity});
  EXPECT_EQ(kinds.size(), 12u + 6u);  // quantities of luminaires, and the other kinds
  const Eigen::VectorXd x = PackParameters(state, parameters);
  Eigen::VectorXd moved = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Parameter& p = parameters[static_cast<size_t>(i)];
    const double by = 0.01 * static_cast<double>(i % 9 + 1);
    moved[i] += x[i] + by < p.upper ? by : -by;
  }
  const Eigen::VectorXd again = PackParameters(WithParameters(state, parameters, moved), parameters);
  for (Eigen::Index i = 0; i < x.size(); ++i)
    EXPECT_NEAR(again[i], moved[i], 1e-12) << NameOf(parameters[static_cast<size_t>(i)].id());  // rounding
  const LightState same = WithParameters(state, parameters, x);
  EXPECT_NEAR((same.luminaires[0].aim - state.luminaires[0].aim).norm(), 0, 1e-12);
  EXPECT_NEAR(same.luminaires[0].flux_lm, 700, 1e-9);
  EXPECT_NEAR(same.camera_scale, 0.02, 1e-12);
}

TEST_F(SmallRoom, TurnsAreCountedFromWhereTheyAreRecentred) {
  state_.free[0].heading = true;
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  Eigen::VectorXd x = PackParameters(state_, parameters);
  for (size_t i = 0; i < parameters.size(); ++i)
    if (IsTilt(parameters[i])) x[static_cast<Eigen::Index>(i)] = 0.2;
  const LightState turned = WithParameters(state_, parameters, x);
  const Eigen::VectorXd packed = PackParameters(turned, Recentred(parameters, turned));
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (IsTilt(parameters[i])) {
      EXPECT_NEAR(packed[static_cast<Eigen::Index>(i)], 0, 1e-12);
    }
  }
}

TEST(ParameterIds, WordsOfFilesReadBackAndNamesAreForPeople) {
  for (int k = 0; k < 6; ++k) {
    const auto kind = static_cast<ParameterKind>(k);
    EXPECT_EQ(ParameterKindFrom(ToString(kind)), kind);
  }
  for (int q = 0; q < 12; ++q) {
    const auto quantity = static_cast<LuminaireQuantity>(q);
    EXPECT_EQ(LuminaireQuantityFrom(ToString(quantity)), quantity);
  }
  EXPECT_FALSE(ParameterKindFrom("flux of A"));
  const ParameterId node{ParameterKind::kLuminaire, "A of B", LuminaireQuantity::kGammaNode, 3};
  EXPECT_EQ(NameOf(node), "gamma node 3 of A of B");
  EXPECT_NE(node, (ParameterId{ParameterKind::kLuminaire, "A of B", LuminaireQuantity::kGammaNode, 4}));
  EXPECT_NE(node, (ParameterId{ParameterKind::kLogFlux, "A of B"}));
}

TEST_F(SmallRoom, ATiltTurnsTheAimAndKeepsTheHeadingPerpendicular) {
  std::vector<Parameter> parameters;
  for (const Parameter& p : FreeParameters(room_, state_)) {
    if (IsTilt(p)) parameters.push_back(p);
  }
  ASSERT_EQ(parameters.size(), 2u);
  const LuminaireAxes axes = AxesOf(state_.luminaires[0]);
  const Luminaire tilted = WithParameters(state_, parameters, Eigen::Vector2d(0.1, -0.2)).luminaires[0];
  const Eigen::Vector3d expected =
      (state_.luminaires[0].aim + 0.1 * axes.along - 0.2 * axes.across).normalized();
  EXPECT_NEAR((tilted.aim - expected).norm(), 0, 1e-12);  // double rounding
  EXPECT_NEAR(tilted.heading.dot(tilted.aim), 0, 1e-12);
  EXPECT_GT(tilted.heading.dot(axes.along), 0.9);
}

TEST_F(SmallRoom, BoundsKeepThingsPossible) {
  for (const Parameter& p : FreeParameters(room_, state_)) {
    EXPECT_LT(p.lower, p.upper) << NameOf(p.id());
    EXPECT_FALSE(NameOf(p.id()).empty());
    if (p.kind == ParameterKind::kAlbedo) {
      EXPECT_GT(p.lower, 0);
      EXPECT_LT(p.upper, 1);
    }
    if (p.kind == ParameterKind::kLuminaire && static_cast<int>(p.quantity) < 3) {
      const int axis = static_cast<int>(p.quantity);
      EXPECT_GT(p.lower, 0);
      EXPECT_LT(p.upper, room_.scene.Bounds().max()[axis]);
    }
  }
  state_.luminaires[0].position.x() = 50;  // far outside
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  EXPECT_EQ(PackParameters(state_, parameters)[0], parameters[0].upper);
}

TEST_F(SmallRoom, OnlyWhatIsFreeAndExistsIsAParameter) {
  state_.free = {{false, true, true, true, false}, {true, false, true, true, false}};
  state_.luminaires[0].distribution = Distribution::kLambertian;  // has no exponent
  state_.luminaires[0].shape = LuminaireShape::kDisc;             // has one size
  state_.albedo_free = {false, true, false};
  state_.camera_scale_free = false;
  std::vector<std::string> names;
  for (const Parameter& p : FreeParameters(room_, state_)) names.push_back(NameOf(p.id()));
  EXPECT_EQ(names, (std::vector<std::string>{"size along of A", "log flux of A", "position x of B",
                                             "position y of B", "position z of B", "albedo of floor"}));
}

TEST_F(SmallRoom, IndicesOutOfRangeAreRefused) {
  LightData wrong_state = data_, wrong_element = data_;
  wrong_state.observations[0].state = 3;
  EXPECT_THROW(LightModel(room_, wrong_state), std::invalid_argument);
  wrong_element.observations[0].element = static_cast<int>(room_.patches.elements.size());
  EXPECT_THROW(LightModel(room_, wrong_element), std::invalid_argument);
  wrong_element.observations[0].element = -1;
  EXPECT_THROW(LightModel(room_, wrong_element), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
