#include "inverse/choose/internal/luminaire_types.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace luxfit {
namespace {

// A fit by hand of three discs that look down, with sigmas of 1 cm and 1 %.
class LuminaireTypes : public testing::Test {
 protected:
  LuminaireTypes() : open_(3), shown_(3) {
    fit_.status = FitStatus::kConverged;
    fit_.state.luminaires.resize(3);
    fit_.state.free.resize(3);
    for (size_t k = 0; k < 3; ++k) {
      Luminaire& luminaire = fit_.state.luminaires[k];
      luminaire.distribution = Distribution::kCosinePower;
      luminaire.shape = LuminaireShape::kDisc;
      luminaire.cosine_exponent = 3;
      luminaire.size_m.setConstant(0.3);
      luminaire.position = Eigen::Vector3d(static_cast<double>(k), 0, 2);
      fit_.state.free[k].exponent = fit_.state.free[k].size = true;
    }
    fit_.state.camera_scale_free = false;
  }

  std::vector<int> Merged() {
    fit_.parameters = FreeParameters(MakeRoom(Scene{}), fit_.state);
    const auto n = static_cast<Eigen::Index>(fit_.parameters.size());
    fit_.covariance = 1e-4 * Eigen::MatrixXd::Identity(n, n);
    return WithMergedTypes(fit_, open_).state.first_of_type;
  }

  static LightData States(const std::vector<Eigen::Vector3d>& dimming) {
    LightData data;
    for (const Eigen::Vector3d& d : dimming) data.dimming.emplace_back(d);
    return data;
  }

  std::vector<int> TypesFrom(const std::vector<Eigen::Vector3d>& dimming, const LightState& start) const {
    return TypedBySwitching(States(dimming), start, open_, shown_).first_of_type;
  }

  // Spots whose aims the search told: two turned by 40 degrees to either side, one between them.
  LightState Spots() const {
    LightState spots = fit_.state;
    for (size_t k = 0; k < 3; ++k) {
      const double angle = (static_cast<double>(k) - 1) * 40 * M_PI / 180;
      spots.luminaires[k].aim = Eigen::Vector3d(std::sin(angle), 0, -std::cos(angle));
      spots.free[k].tilt = true;
    }
    return spots;
  }

  LuminaireFit fit_;
  std::vector<OpenChoice> open_;
  ShownLuminaires shown_;
};

TEST_F(LuminaireTypes, WhatIsAlwaysOnTogetherIsOfOneType) {
  const LightState& start = fit_.state;
  EXPECT_EQ(TypesFrom({{1, 0, 1}, {0, 1, 0}, {0.5, 1, 0.5}}, start), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(TypesFrom({{1, 0, 1}, {0, 1, 0}, {0.5, 1, 1}}, start), (std::vector<int>{0, 1, 2}));
}

// Two downlights, the second of which no photo shows, and a pendant on one switch.
TEST_F(LuminaireTypes, WhatPhotosShowToBeOfAnotherKindStaysApart) {
  LightState start = fit_.state;
  start.luminaires[1].position.z() = 1.4;
  const auto show = [&](size_t k) {
    shown_[k].emplace();
    shown_[k]->position = start.luminaires[k].position;
  };
  show(0);
  EXPECT_EQ(TypesFrom({{1, 1, 1}}, start), (std::vector<int>{0, 0, 0}));
  show(1);
  EXPECT_EQ(TypesFrom({{1, 1, 1}}, start), (std::vector<int>{0, 1, 0}));
  start.luminaires[1].position.z() = 1.9;
  show(1);
  EXPECT_EQ(TypesFrom({{1, 1, 1}}, start), (std::vector<int>{0, 0, 0}));
}

TEST_F(LuminaireTypes, AGivenModelOrAnotherAimStaysApart) {
  LightState start = fit_.state;
  open_[1].distribution = false;
  EXPECT_EQ(TypesFrom({{1, 1, 1}}, start), (std::vector<int>{0, 1, 0}));
  start.luminaires[2].aim = Eigen::Vector3d(1, 0, -1).normalized();
  open_[2].aim = false;
  EXPECT_EQ(TypesFrom({{1, 1, 1}}, start), (std::vector<int>{0, 1, 2}));
}

// Pendants that shine both ways hang among downlights.
TEST_F(LuminaireTypes, OneThatShinesAllRoundIsOfAnotherKindThanBeams) {
  LightState start = fit_.state;
  start.luminaires[0].cosine_exponent = start.luminaires[2].cosine_exponent = 7;
  start.luminaires[1].distribution = Distribution::kIsotropic;
  EXPECT_EQ(TypesFrom({{1, 1, 1}}, start), (std::vector<int>{0, 1, 0}));
  start.luminaires[1].distribution = Distribution::kMeasured;
  start.free[1].sides = true;
  EXPECT_EQ(TypesFrom({{1, 1, 1}}, start), (std::vector<int>{0, 1, 0}));
  start.luminaires[0].cosine_exponent = start.luminaires[2].cosine_exponent = 1;
  EXPECT_EQ(TypesFrom({{1, 1, 1}}, start), (std::vector<int>{0, 0, 0})) << "a wide lobe may be either";
}

TEST_F(LuminaireTypes, AnAimThatTheFirstGuessSeesWrongIsThatOfTheOthers) {
  LightState start = fit_.state;
  start.luminaires[0].aim = Eigen::Vector3d(1, 0, -1).normalized();
  const LightState typed = WithTypes(start, TypesFrom({{1, 1, 1}}, start));
  for (const Luminaire& luminaire : typed.luminaires) EXPECT_EQ(luminaire.aim, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(typed.luminaires[0].position, start.luminaires[0].position);
}

TEST_F(LuminaireTypes, SpotsOfOneTypeHaveAimsOfTheirOwn) {
  const LightState spots = Spots();
  LightState typed = TypedBySwitching(States({{1, 1, 1}}), spots, open_, shown_);
  EXPECT_EQ(typed.first_of_type, (std::vector<int>{0, 0, 0}));
  typed.luminaires[1].cosine_exponent = 20;
  typed = WithTypes(typed, typed.first_of_type);
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(typed.luminaires[k].aim, spots.luminaires[k].aim);
    EXPECT_EQ(typed.luminaires[k].cosine_exponent, 20) << "the lobe of the one between the others";
  }
  const std::vector<Parameter> parameters = FreeParameters(MakeRoom(Scene{}), typed);
  const auto count = [&](LuminaireQuantity quantity) {
    return std::count_if(parameters.begin(), parameters.end(), [&](const Parameter& p) {
      return p.kind == ParameterKind::kLuminaire && p.quantity == quantity;
    });
  };
  EXPECT_EQ(count(LuminaireQuantity::kTiltAlong), 3);
  EXPECT_EQ(count(LuminaireQuantity::kExponent), 1);
}

// Sigma of a tilt: 0.6 degrees.
TEST_F(LuminaireTypes, AimsThatTheFitDoesNotTellApartBecomeOne) {
  fit_.state = TypedBySwitching(States({{1, 1, 1}}), Spots(), open_, shown_);
  Merged();
  EXPECT_TRUE(WithMergedTypes(fit_, open_).turned_alike.empty());
  for (size_t k = 0; k < 3; ++k) {
    const double angle = static_cast<double>(k) * 0.8 * M_PI / 180;
    fit_.state.luminaires[k].aim = Eigen::Vector3d(std::sin(angle), 0, -std::cos(angle));
  }
  Merged();
  const TypedState typed = WithMergedTypes(fit_, open_);
  EXPECT_EQ(typed.turned_alike, std::vector<int>{0});
  for (const Luminaire& luminaire : typed.state.luminaires)
    EXPECT_EQ(luminaire.aim, fit_.state.luminaires[0].aim);
  fit_.state.luminaires[2].aim = Eigen::Vector3d(std::sin(0.05), 0, -std::cos(0.05));  // 2.9 degrees
  Merged();
  EXPECT_TRUE(WithMergedTypes(fit_, open_).turned_alike.empty());
}

TEST_F(LuminaireTypes, PlacesThatPhotosShowAreASecondStart) {
  LightState state = WithTypes(fit_.state, {0, 0, 2});
  const LightData data = States({{1, 1, 0}, {0, 0, 1}});
  const auto place = [](double x, double area_m2, std::vector<int> states) {
    SeenPlace seen;
    seen.position = Eigen::Vector3d(x, 0, 2);
    seen.area_m2 = area_m2;
    seen.states = std::move(states);
    return seen;
  };
  // A highlight is smaller than a luminaire, and the third is on in another state.
  std::vector<SeenPlace> seen{place(3, 0.1, {0}), place(1.5, 0.01, {0}), place(2, 1, {1})};
  EXPECT_TRUE(SeenPlacesOfTypes({seen[0], seen[2]}, data, state, shown_).empty());
  seen.push_back(place(0, 0.1, {0}));
  const std::vector<TypePlaces> places = SeenPlacesOfTypes(seen, data, state, shown_);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0].first, 0);
  ASSERT_EQ(places[0].places.size(), 2U);
  EXPECT_EQ(places[0].places[0].x(), 0);
  EXPECT_EQ(places[0].places[1].x(), 3);
  shown_[0] = seen[3];
  seen[0].position.z() = seen[1].position.z() = 2.4;
  EXPECT_TRUE(SeenPlacesOfTypes(seen, data, state, shown_).empty()) << "of another kind";
  seen[0].position.z() = seen[1].position.z() = 2;
  state.luminaires[1].position.x() = 2.9;
  EXPECT_TRUE(SeenPlacesOfTypes(seen, data, state, shown_).empty()) << "the fit is there";
}

// Sigma of a difference: 1.4 cm and 1.4 %.
TEST_F(LuminaireTypes, AreMergedWhereTheFitDoesNotTellThemApart) {
  fit_.state.luminaires[1].size_m.setConstant(0.32);
  fit_.state.luminaires[2].size_m.setConstant(0.38);
  EXPECT_EQ(Merged(), (std::vector<int>{0, 0, 2}));
}

TEST_F(LuminaireTypes, AnotherExponentStaysApart) {
  fit_.state.luminaires[1].cosine_exponent = 3.3;
  EXPECT_EQ(Merged(), (std::vector<int>{0, 1, 0}));
}

TEST_F(LuminaireTypes, AnotherFormStaysApart) {
  fit_.state.luminaires[0].shape = LuminaireShape::kRectangle;
  fit_.state.luminaires[1].distribution = Distribution::kLambertian;
  EXPECT_EQ(Merged(), (std::vector<int>{0, 1, 2}));
}

// A strip of 1.5 m x 0.1 m along x may be told as 0.1 m x 1.5 m with a heading along y.
TEST_F(LuminaireTypes, AStripIsTheSameWhicheverSideItsHeadingFollows) {
  for (size_t k = 0; k < 3; ++k) {
    fit_.state.luminaires[k].shape = LuminaireShape::kRectangle;
    fit_.state.luminaires[k].size_m = {1.5, 0.1};
    open_[k].heading = true;
  }
  Luminaire& turned = fit_.state.luminaires[2];
  turned.size_m = {0.1, 1.5};
  turned.heading = {0, 1, 0};
  EXPECT_EQ(Merged(), (std::vector<int>{0, 0, 2}));
  const LightState named = WithSidesAlike(fit_.state, open_);
  EXPECT_EQ(named.luminaires[2].size_m, Eigen::Vector2d(1.5, 0.1));
  EXPECT_NEAR(std::abs(AxesOf(named.luminaires[2]).along.x()), 1, 1e-12);  // double rounding
  fit_.state = named;
  EXPECT_EQ(Merged(), (std::vector<int>{0, 0, 0}));
}

TEST_F(LuminaireTypes, SquaresKeepTheirHeading) {
  for (size_t k = 0; k < 3; ++k) {
    fit_.state.luminaires[k].shape = LuminaireShape::kRectangle;
    fit_.state.luminaires[k].size_m = {0.6 + 0.01 * static_cast<double>(k),
                                       0.61 - 0.01 * static_cast<double>(k)};
    open_[k].heading = true;
  }
  const LightState named = WithSidesAlike(fit_.state, open_);
  for (size_t k = 0; k < 3; ++k) EXPECT_EQ(named.luminaires[k].heading, fit_.state.luminaires[k].heading);
}

// A heading that the user gives stays as it is.
TEST_F(LuminaireTypes, AGivenHeadingIsKept) {
  for (size_t k = 0; k < 3; ++k) {
    fit_.state.luminaires[k].shape = LuminaireShape::kRectangle;
    fit_.state.luminaires[k].size_m = k == 2 ? Eigen::Vector2d(0.1, 1.5) : Eigen::Vector2d(1.5, 0.1);
    open_[k].heading = k != 2;
  }
  EXPECT_EQ(WithSidesAlike(fit_.state, open_).luminaires[2].size_m, Eigen::Vector2d(0.1, 1.5));
}

TEST_F(LuminaireTypes, WithoutACovarianceNothingIsMerged) {
  fit_.covariance.resize(0, 0);
  EXPECT_TRUE(WithMergedTypes(fit_, open_).merged.empty());
}

TEST_F(LuminaireTypes, TypesKeepTheirMembersWhenTheyMerge) {
  fit_.state.first_of_type = {0, 1, 1};
  EXPECT_EQ(Merged(), (std::vector<int>{0, 0, 0}));
}

}  // namespace
}  // namespace luxfit
