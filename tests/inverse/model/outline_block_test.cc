#include "inverse/model/internal/blocks/outline_block.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/light_model.h"
#include "tests/support/inverse/luminaire_outlines.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

Luminaire FlatLuminaire(LuminaireShape shape) {
  Luminaire luminaire;
  luminaire.id = "A";
  luminaire.position = {0.1, -0.2, 2.4};
  luminaire.heading = {std::cos(0.35), std::sin(0.35), 0};
  luminaire.shape = shape;
  luminaire.size_m = {0.6, shape == LuminaireShape::kDisc ? 0.6 : 0.3};
  luminaire.flux_lm = 500;
  return luminaire;
}

// One luminaire in no room. One reading tells its flux; all else must come from outlines.
class OutlineRows : public testing::Test {
 protected:
  OutlineRows() {
    data_.dimming = {Eigen::VectorXd::Ones(1)};
    data_.readings.push_back({{{0, 0, 0}, {0, 0, 1}}, 0, 100, 1, true});
    state_.luminaires.resize(1);
    state_.free.resize(1);
    state_.camera_scale_free = false;
  }

  // Returns the outlines' rows with their Jacobian.
  Prediction Predict(const LightState& state, const std::vector<Parameter>& parameters) const {
    LightModel model(room_, data_);
    model.FreezeVisibility(state);
    Prediction prediction = model.Predict(state, parameters, true);
    const Eigen::Index rows = prediction.value.size() - 1;
    prediction.value = prediction.value.tail(rows).eval();
    prediction.jacobian = prediction.jacobian.bottomRows(rows).eval();
    return prediction;
  }
  Eigen::VectorXd Distances(const Luminaire& luminaire, const SeenOutline& seen) {
    data_.outlines = {{0, seen}};
    state_.luminaires = {luminaire};
    return Predict(state_, {}).value;
  }
  static SeenOutline RaysFrom(const Eigen::Vector3d& eye, const std::vector<Eigen::Vector3d>& directions) {
    SeenOutline outline;
    outline.eye = eye;
    outline.rays.reserve(directions.size());
    for (const Eigen::Vector3d& direction : directions)
      outline.rays.push_back({direction.normalized(), kPxPerRad});
    return outline;
  }

  static constexpr double kPxPerRad = 1000;
  const Room room_ = MakeRoom(Scene{});
  LightData data_;
  LightState state_;
};

// Holds pixels at one distance from the image of a rim, positive outside.
struct OffsetPixels {
  std::vector<Eigen::Vector2d> pixels;
  double distance_px = 0;
};

// Offsets three places of each quarter of the rim along the normal of its image, a dense polygon. They keep
// away from corners, so that no other side is nearer.
OffsetPixels OffsetFromRim(const Luminaire& luminaire, const RegisteredView& view, double distance_px) {
  constexpr size_t kDense = 720, kQuarter = kDense / 4;
  const auto rim = support::PixelsOf(support::OutlineCamera(), view, support::RimOf(luminaire, kDense));
  const Eigen::Vector2d center =
      support::PixelsOf(support::OutlineCamera(), view, {luminaire.position}).front();
  OffsetPixels offset{{}, distance_px};
  for (size_t i = 0; i < kDense; ++i) {
    const size_t place = i % kQuarter;
    if (place != 54 && place != 90 && place != 126) continue;
    const Eigen::Vector2d along = rim[i + 1] - rim[i - 1];
    Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
    if (normal.dot(rim[i] - center) < 0) normal = -normal;
    offset.pixels.emplace_back(rim[i] + distance_px * normal);
  }
  return offset;
}

// Sampson's distance errs by the angle itself times the tangent of the obliqueness: 3 px of 600, tan 65 deg is 2,
// 1 %. The scale's mean over both axes errs by 0.6 % at 0.15 rad off the axis. An ellipse bends by a / b^2 at its
// tips, and half of a bend's d^2 / 2 counts.
TEST_F(OutlineRows, DistancesAreThoseOfTheProjectedRim) {
  for (const LuminaireShape shape : {LuminaireShape::kRectangle, LuminaireShape::kDisc}) {
    Luminaire luminaire = FlatLuminaire(shape);
    for (const double oblique_deg : {0.0, 40.0, 65.0}) {
      const double angle = oblique_deg * support::kPi / 180;
      luminaire.aim = {1, 0, 0};
      luminaire.heading = {0, 0.8, 0.6};
      const Eigen::Vector3d eye =
          luminaire.position + 2.2 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      const RegisteredView view = support::ViewFrom(eye, luminaire.position);
      for (const double distance_px : {-3.0, -1.0, 0.0, 1.0, 3.0}) {
        const OffsetPixels offset = OffsetFromRim(luminaire, view, distance_px);
        const Eigen::VectorXd found =
            Distances(luminaire, support::OutlineThrough(support::OutlineCamera(), view, offset.pixels));
        ASSERT_EQ(found.size(), 12);
        const double bend_per_px =
            shape == LuminaireShape::kDisc ? 2.2 / (600 * 0.3 * std::pow(std::cos(angle), 2)) : 0;
        const double tolerance_px =
            2e-3 + 0.02 * std::abs(distance_px) + 0.25 * bend_per_px * distance_px * distance_px;
        EXPECT_LT((found.array() - distance_px).abs().maxCoeff(), tolerance_px)
            << ToString(shape) << ", " << oblique_deg << " deg, " << distance_px
            << " px: " << found.transpose();
      }
    }
  }
}

TEST_F(OutlineRows, OutsideOfACornerTheCornerIsNearest) {
  Luminaire luminaire = FlatLuminaire(LuminaireShape::kRectangle);
  luminaire.aim = {1, 0, 0};
  luminaire.heading = {0, 1, 0};
  const RegisteredView view =
      support::ViewFrom(luminaire.position + Eigen::Vector3d(2.2, 0, 0), luminaire.position);
  const Eigen::Vector3d corner = luminaire.position + Eigen::Vector3d(0, 0.3, 0.15);
  const Eigen::Vector2d corner_px = support::PixelsOf(support::OutlineCamera(), view, {corner}).front();
  const Eigen::Vector2d center_px(support::OutlineCamera().cx_px, support::OutlineCamera().cy_px);
  const Eigen::Vector2d outwards = (corner_px - center_px).cwiseSign();
  const std::vector<Eigen::Vector2d> pixels(6, corner_px + outwards.cwiseProduct(Eigen::Vector2d(3, 4)));
  const Eigen::VectorXd found =
      Distances(luminaire, support::OutlineThrough(support::OutlineCamera(), view, pixels));
  EXPECT_NEAR(found[0], 5, 0.02 * 5);  // as above
}

// The cone that touches a sphere of radius r at distance d has half the angle asin(r / d); the model takes the angle
// atan(r / d), which is smaller by (r / d)^3 / 2: 0.008 px here.
TEST_F(OutlineRows, ASphereIsJudgedByItsConeAndAPointByItsPlace) {
  const Eigen::Vector3d eye(0, 0, 0);
  Luminaire luminaire;
  luminaire.position = {2, 0, 0};
  luminaire.size_m = {0.1, 0.1};
  for (const LuminaireShape shape : {LuminaireShape::kSphere, LuminaireShape::kPoint}) {
    luminaire.shape = shape;
    const double radius_rad = shape == LuminaireShape::kSphere ? std::asin(0.05 / 2) : 0;
    const double tolerance_px = shape == LuminaireShape::kSphere ? 0.012 : 1e-5;
    for (const double off_rad : {-0.004, 0.0, 0.003}) {
      if (radius_rad + off_rad < 0) continue;
      std::vector<Eigen::Vector3d> directions;
      directions.reserve(8);
      const double angle = radius_rad + off_rad;
      for (int i = 0; i < 8; ++i) {
        const double round = support::kPi * i / 4;
        directions.emplace_back(std::cos(angle), std::sin(angle) * std::cos(round),
                                std::sin(angle) * std::sin(round));
      }
      const Eigen::VectorXd found = Distances(luminaire, RaysFrom(eye, directions));
      EXPECT_LT((found.array() - kPxPerRad * off_rad).abs().maxCoeff(), tolerance_px)
          << ToString(shape) << " " << off_rad;
    }
  }
}

// Eyes in the luminaire's plane, a degree beside it, and rays that leave it behind the eye.
TEST_F(OutlineRows, EdgeOnTheyAreFinite) {
  for (const LuminaireShape shape : {LuminaireShape::kRectangle, LuminaireShape::kDisc}) {
    const Luminaire luminaire = FlatLuminaire(shape);
    for (const double below_m : {0.0, 1e-9, 0.04, -0.04}) {
      const Eigen::Vector3d eye = luminaire.position + Eigen::Vector3d(2.2, 0, -below_m);
      std::vector<Eigen::Vector3d> directions{luminaire.position - eye, {1, 0, 0}, {1, 0.1, -0.3}};
      for (const Eigen::Vector3d& p : support::RimOf(luminaire, 16)) directions.emplace_back(p - eye);
      data_.outlines = {{0, RaysFrom(eye, directions)}};
      state_.luminaires = {luminaire};
      state_.free[0] = {true, false, false, true, true, true};
      const Prediction prediction = Predict(state_, FreeParameters(room_, state_));
      EXPECT_TRUE(prediction.value.allFinite()) << ToString(shape) << " " << below_m;
      EXPECT_TRUE(prediction.jacobian.allFinite()) << ToString(shape) << " " << below_m;
    }
  }
}

// Rims 3 % too large and moved by some pixels: rows inside, outside and beside corners. Steps of 1e-5 truncate at
// (1e-5 / 0.1)^2 and round at 1e-13 px / 1e-5.
TEST_F(OutlineRows, JacobianIsACentralDifferenceInEveryQuantity) {
  for (const LuminaireShape shape :
       {LuminaireShape::kRectangle, LuminaireShape::kDisc, LuminaireShape::kSphere, LuminaireShape::kPoint}) {
    const bool is_disc = shape == LuminaireShape::kDisc;
    const Luminaire rim = FlatLuminaire(is_disc ? LuminaireShape::kDisc : LuminaireShape::kRectangle);
    data_.outlines = {{0, support::OutlineFrom({1.5, 0.5, 0.9}, rim, {0, 0, 1.03, {4.3, -2.7}})},
                      {0, support::OutlineFrom({-1.2, 1.1, 0.8}, rim, {1, 0, 1.03, {-3.1, 1.9}})}};
    state_.luminaires = {rim};
    state_.luminaires[0].shape = shape;
    state_.luminaires[0].aim = Eigen::Vector3d(0.1, -0.05, -1).normalized();
    state_.free[0] = {true, true, false, true, true, true};
    const std::vector<Parameter> parameters = FreeParameters(room_, state_);
    const bool is_flat = is_disc || shape == LuminaireShape::kRectangle;
    const Eigen::VectorXd x = PackParameters(state_, parameters);
    const RowMajorMatrix jacobian = Predict(state_, parameters).jacobian;
    for (Eigen::Index p = 0; p < x.size(); ++p) {
      constexpr double kStep = 1e-5;
      const auto values = [&](double step) {
        const Eigen::VectorXd at = x + step * Eigen::VectorXd::Unit(x.size(), p);
        return Predict(WithParameters(state_, parameters, at), {}).value;
      };
      const Eigen::VectorXd numeric = (values(kStep) - values(-kStep)) / (2 * kStep);
      const double largest = numeric.cwiseAbs().maxCoeff();
      const Parameter& parameter = parameters[static_cast<size_t>(p)];
      EXPECT_LT((jacobian.col(p) - numeric).cwiseAbs().maxCoeff(), 1e-5 * largest + 1e-6)
          << ToString(shape) << ": " << NameOf(parameter.id());
      const bool is_turn = parameter.quantity == LuminaireQuantity::kTiltAlong ||
                           parameter.quantity == LuminaireQuantity::kTiltAcross ||
                           (parameter.quantity == LuminaireQuantity::kHeading && !is_disc);
      const bool moves = parameter.kind == ParameterKind::kLuminaire &&
                         (is_turn ? is_flat : parameter.quantity != LuminaireQuantity::kHeading);
      EXPECT_EQ(largest > 1, moves) << ToString(shape) << ": " << NameOf(parameter.id());
    }
  }
}

// Turns the camera's rays about its centre by `step` rad, or moves its centre by `step` m, along a world axis.
SeenOutline Moved(SeenOutline seen, Eigen::Index quantity, double step) {
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(quantity % 3);
  if (quantity >= 3) {
    seen.eye += step * axis;
  } else {
    for (OutlineRay& ray : seen.rays) ray.direction = Eigen::AngleAxisd(step, axis) * ray.direction;
  }
  return seen;
}

// Rims and steps are those of the Jacobian's test.
TEST_F(OutlineRows, PoseDerivativesAreCentralDifferences) {
  for (const LuminaireShape shape :
       {LuminaireShape::kRectangle, LuminaireShape::kDisc, LuminaireShape::kSphere, LuminaireShape::kPoint}) {
    const bool is_disc = shape == LuminaireShape::kDisc;
    const Luminaire rim = FlatLuminaire(is_disc ? LuminaireShape::kDisc : LuminaireShape::kRectangle);
    const std::vector<LuminaireOutline> seen{
        {0, support::OutlineFrom({1.5, 0.5, 0.9}, rim, {0, 0, 1.03, {4.3, -2.7}})},
        {0, support::OutlineFrom({-1.2, 1.1, 0.8}, rim, {1, 0, 1.03, {-3.1, 1.9}})}};
    state_.luminaires = {rim};
    state_.luminaires[0].shape = shape;
    state_.luminaires[0].aim = Eigen::Vector3d(0.1, -0.05, -1).normalized();
    const auto values = [&](Eigen::Index quantity, double step) {
      LightData moved = data_;
      moved.outlines = seen;
      for (LuminaireOutline& outline : moved.outlines) outline.seen = Moved(outline.seen, quantity, step);
      const OutlineBlock block(moved);
      Eigen::VectorXd distances_px(block.row_count());
      for (int row = 0; row < block.row_count(); ++row)
        distances_px[row] = block.ResponseOf(state_, row).offset;
      return distances_px;
    };
    data_.outlines = seen;
    const OutlineBlock block(data_);
    const Eigen::MatrixXd derivative = block.SharedErrorsOf(state_, ViewErrors::kJoint).effect;
    ASSERT_EQ(derivative.rows(), block.row_count());
    ASSERT_EQ(derivative.cols(), 7);
    for (Eigen::Index quantity = 0; quantity < 6; ++quantity) {
      constexpr double kStep = 1e-5;
      const Eigen::VectorXd numeric = (values(quantity, kStep) - values(quantity, -kStep)) / (2 * kStep);
      const double largest = numeric.cwiseAbs().maxCoeff();
      EXPECT_GT(largest, 1) << ToString(shape) << ": " << quantity;  // px per rad and per m
      EXPECT_LT((derivative.col(quantity) - numeric).cwiseAbs().maxCoeff(), 1e-5 * largest + 1e-6)
          << ToString(shape) << ": " << quantity;
    }
  }
}

TEST_F(OutlineRows, RowsShareTheErrorsOfTheirView) {
  const Luminaire luminaire = FlatLuminaire(LuminaireShape::kDisc);
  data_.outlines = {{0, support::OutlineFrom({1.5, 0.5, 0.9}, luminaire, {2})},
                    {0, support::OutlineFrom({-1.2, 1.1, 0.8}, luminaire, {0})}};
  const OutlineBlock block(data_);
  const int of_first = static_cast<int>(data_.outlines[0].seen.rays.size());
  ASSERT_GT(block.row_count(), of_first);
  const RowErrors errors = block.SharedErrorsOf(state_, ViewErrors::kJoint);
  for (int row = 0; row < block.row_count(); ++row)
    EXPECT_EQ(errors.owner[static_cast<size_t>(row)], row < of_first ? 2 : 0);
  EXPECT_EQ(block.SharedErrorsOf(state_, ViewErrors::kHeld).effect.size(), 0);
}

TEST_F(OutlineRows, ViewsOfOneCameraGrowAlike) {
  const Luminaire luminaire = FlatLuminaire(LuminaireShape::kDisc);
  data_.outlines = {{0, support::OutlineFrom({1.5, 0.5, 0.9}, luminaire, {0})},
                    {0, support::OutlineFrom({-1.2, 1.1, 0.8}, luminaire, {1})},
                    {0, support::OutlineFrom({0.2, -1.9, 1}, luminaire, {2})}};
  data_.outlines[2].seen.camera = 1;
  const OutlineBlock block(data_);
  const auto covariance = [&](ViewErrors views, int a, int b) {
    const Eigen::MatrixXd root = block.SharedErrorsOf(state_, views).root;
    return root.row(7 * a + 6).dot(root.row(7 * b + 6));
  };
  EXPECT_GT(covariance(ViewErrors::kJoint, 0, 0), 0);
  EXPECT_EQ(covariance(ViewErrors::kJoint, 0, 1), covariance(ViewErrors::kJoint, 0, 0));
  EXPECT_EQ(covariance(ViewErrors::kJoint, 0, 2), 0);
  EXPECT_EQ(covariance(ViewErrors::kViewByView, 0, 1), 0);
}

TEST_F(OutlineRows, AnOutlineOfNoLuminaireIsRefused) {
  data_.outlines = {{1, support::OutlineFrom({1.5, 0.5, 0.9}, FlatLuminaire(LuminaireShape::kDisc))}};
  EXPECT_THROW(LightModel(room_, data_), std::invalid_argument);
}

TEST_F(OutlineRows, LightTellsNoSizeThatOutlinesTell) {
  const Luminaire luminaire = FlatLuminaire(LuminaireShape::kRectangle);
  state_.luminaires = {luminaire};
  state_.free[0] = {true, true, false, true, false, false};
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  // Returns the derivatives of the reading, the first row.
  const auto of_reading = [&] {
    LightModel model(room_, data_);
    model.FreezeVisibility(state_);
    return Eigen::RowVectorXd(model.Predict(state_, parameters, true).jacobian.row(0));
  };
  const Eigen::RowVectorXd by_light = of_reading();
  data_.outlines = {{0, support::OutlineFrom({1.5, 0.5, 0.9}, luminaire)}};
  const Eigen::RowVectorXd beside_outlines = of_reading();
  for (size_t p = 0; p < parameters.size(); ++p) {
    const auto column = static_cast<Eigen::Index>(p);
    const bool is_size = parameters[p].quantity == LuminaireQuantity::kSizeAlong ||
                         parameters[p].quantity == LuminaireQuantity::kSizeAcross;
    EXPECT_NE(by_light[column], 0) << NameOf(parameters[p].id());
    EXPECT_EQ(beside_outlines[column], is_size ? 0 : by_light[column]) << NameOf(parameters[p].id());
  }
}

// Seen where it is small, a rectangle that has grown far across is judged by its sides along alone: light brings it back.
TEST_F(OutlineRows, LightTellsASizeThatOutlinesDoNot) {
  const Luminaire seen = FlatLuminaire(LuminaireShape::kRectangle);
  data_.outlines = {{0, support::OutlineFrom({1.5, 0.5, 0.9}, seen)}};
  Luminaire grown = seen;
  grown.size_m.y() = 2;
  state_.luminaires = {grown};
  state_.free[0] = {true, true, false, true, false, false};
  const std::vector<Parameter> parameters = FreeParameters(room_, state_);
  LightModel model(room_, data_);
  model.FreezeVisibility(state_);
  const Eigen::RowVectorXd of_reading = model.Predict(state_, parameters, true).jacobian.row(0);
  for (size_t p = 0; p < parameters.size(); ++p) {
    const double derivative = of_reading[static_cast<Eigen::Index>(p)];
    if (parameters[p].quantity == LuminaireQuantity::kSizeAlong) {
      EXPECT_EQ(derivative, 0);
    }
    if (parameters[p].quantity == LuminaireQuantity::kSizeAcross) {
      EXPECT_NE(derivative, 0);
    }
  }
}

// A turned rectangle of 0.6 m x 0.3 m that three views see. The start is some centimetres and 10 degrees off.
class SeenRectangle : public OutlineRows {
 protected:
  LuminaireFit Fit(double shift_sigma_px, std::mt19937_64& rng) {
    std::normal_distribution<double> normal;
    const std::vector<Eigen::Vector3d> eyes{{1.5, 0.5, 0.9}, {-1.2, 1.1, 0.8}, {0.2, -1.9, 1}};
    data_.outlines.clear();
    for (int view = 0; view < static_cast<int>(eyes.size()); ++view) {
      support::RimView rim{view};
      rim.shift_px = shift_sigma_px * Eigen::Vector2d(normal(rng), normal(rng));
      data_.outlines.push_back({0, support::OutlineFrom(eyes[static_cast<size_t>(view)], truth_, rim)});
    }
    Luminaire start = truth_;
    start.position += Eigen::Vector3d(0.03, -0.02, 0.04);
    start.heading = {std::cos(0.175), std::sin(0.175), 0};
    start.size_m = {0.5, 0.4};
    state_.luminaires = {start};
    state_.free[0] = {true, true, false, true, false, true};
    return FitLuminaires(room_, data_, state_);
  }

  // Returns the errors of position, sides and heading, in the order of FreeParameters.
  Eigen::VectorXd ErrorOf(const LuminaireFit& fit) const {
    const Luminaire& found = fit.state.luminaires[0];
    const LuminaireAxes axes = AxesOf(truth_);
    Eigen::VectorXd error(6);
    error << found.position - truth_.position, found.size_m - truth_.size_m,
        std::atan2(found.heading.dot(axes.across), found.heading.dot(axes.along));
    return error;
  }

  const Luminaire truth_ = FlatLuminaire(LuminaireShape::kRectangle);
};

TEST_F(SeenRectangle, ExactOutlinesGiveItsPlaceSizeAndHeading) {
  std::mt19937_64 rng = support::TestRng();
  const LuminaireFit fit = Fit(0, rng);
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
  EXPECT_TRUE(fit.undetermined.empty());
  const Eigen::VectorXd error = ErrorOf(fit);
  // The last step is below 0.5 mm, and steps converge quadratically.
  EXPECT_LT(error.head<3>().norm(), 1e-4);
  EXPECT_LT(error.segment<2>(3).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT(std::abs(error[5]), 3e-4);
  EXPECT_NEAR(fit.predicted[0], 100, 0.1);  // the flux follows the only reading
}

// A pose's error moves a whole outline; 0.3 px of each axis is what a sigma of 1 px of 32 points allows for. Growth by
// half a pixel all round, which all rows share, makes sides 4.3 and 4.5 mm longer; with the rows' own 1.3 mm their sigma
// is 4.7 mm. The rows tell the heading to 3.5 mrad, which no shift changes. Limits of sides and heading are 1.5 times that.
TEST_F(SeenRectangle, OutlinesThatAreShiftedGiveItWithinItsSigma) {
  std::mt19937_64 rng = support::TestRng();
  double worst = 0;
  Eigen::Matrix<double, 6, 1> largest = Eigen::Matrix<double, 6, 1>::Zero();
  for (int draw = 0; draw < 8; ++draw) {
    const LuminaireFit fit = Fit(0.3, rng);
    ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
    const Eigen::VectorXd error = ErrorOf(fit);
    for (Eigen::Index i = 0; i < error.size(); ++i) {
      const double sigma = std::sqrt(fit.covariance(i, i));
      worst = std::max(worst, std::abs(error[i]) / sigma);
      EXPECT_LT(std::abs(error[i]), 4 * sigma) << NameOf(fit.parameters[static_cast<size_t>(i)].id());
    }
    // Half a pixel of 600 at 2.2 m is 1.8 mm.
    EXPECT_LT(std::sqrt(fit.covariance.diagonal().head<3>().sum()), 0.01);
    largest = largest.cwiseMax(fit.covariance.diagonal().cwiseSqrt().head<6>());
  }
  std::printf(
      "worst error: %.2f sigma; largest sigmas %.2f %.2f %.2f mm, sides %.2f %.2f mm, heading %.2f mrad\n",
      worst, 1000 * largest[0], 1000 * largest[1], 1000 * largest[2], 1000 * largest[3], 1000 * largest[4],
      1000 * largest[5]);
  EXPECT_LT(largest.segment<2>(3).maxCoeff(), 0.007);
  EXPECT_LT(largest[5], 0.0052);
}

// Outlines of one camera from 1.1, 2.2 and 4.4 m, all a pixel too large: 3.7 mm to 15 mm of the sides. Distances tell this
// from the size. 36 points of 1 px tell the growth to a third of a pixel or so, beside its prior of 0 +- 1 px.
TEST_F(SeenRectangle, GrowthOfACameraIsToldFromTheSize) {
  int view = 0;
  for (const double distance_m : {1.1, 2.2, 4.4}) {
    const Eigen::Vector3d direction = Eigen::Vector3d(view - 1, 0.4, -1.2).normalized();
    const RegisteredView from = support::ViewFrom(truth_.position + distance_m * direction, truth_.position);
    data_.outlines.push_back(
        {0, support::OutlineThrough(support::OutlineCamera(), from, OffsetFromRim(truth_, from, 1).pixels)});
    data_.outlines.back().seen.view = view++;
  }
  state_.luminaires = {truth_};
  state_.free[0] = {true, true, false, true, false, false};
  const LuminaireFit fit = FitLuminaires(room_, data_, state_);
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
  const Eigen::Vector2d error = fit.state.luminaires[0].size_m - truth_.size_m;
  std::printf("sides are off by %.2f and %.2f mm\n", 1000 * error[0], 1000 * error[1]);
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 0.0025);
}

}  // namespace
}  // namespace luxfit
