#include "inverse/fit/internal/outlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "inverse/model/internal/light_model.h"
#include "tests/support/inverse/luminaire_outlines.h"

namespace luxfit {
namespace {

// Two discs of 0.3 m in no room, both on, and a reading that only checks. Three views see them.
class Outlines : public testing::Test {
 protected:
  Outlines() {
    for (const double x : {0.0, 1.2}) {
      KnownLuminaire known;
      known.shape_is_known = true;
      known.luminaire.id = x > 0 ? "B" : "A";
      known.luminaire.position = {x, 0.1, 2.4};
      known.luminaire.shape = LuminaireShape::kDisc;
      known.luminaire.size_m = {0.3, 0.3};
      known.luminaire.flux_lm = 500;
      given_.luminaires.push_back(known);
      state_.luminaires.push_back(known.luminaire);
    }
    given_.dimming = {Eigen::Vector2d(1, 1)};
    state_.free.resize(2);
  }

  // Shows the luminaires in every view, larger by those factors.
  void Show(double growth_a, double growth_b) {
    given_.outlines.clear();
    for (int view = 0; view < 3; ++view) {
      for (size_t k = 0; k < 2; ++k) {
        given_.outlines.push_back(support::OutlineFrom(eyes_[static_cast<size_t>(view)], state_.luminaires[k],
                                                       {view, 0, k == 0 ? growth_a : growth_b}));
      }
    }
  }

  std::vector<LuminaireOutline> Taken(const std::vector<bool>& found = {true, true}) const {
    return OutlinesOf(given_, found, state_);
  }
  static std::ptrdiff_t CountOf(const std::vector<LuminaireOutline>& outlines, int luminaire) {
    return std::count_if(outlines.begin(), outlines.end(),
                         [&](const LuminaireOutline& o) { return o.luminaire == luminaire; });
  }

  const std::vector<Eigen::Vector3d> eyes_{{1.9, 0.7, 0.9}, {-1.2, 1.3, 0.8}, {0.4, -1.9, 1}};
  RoomObservations given_;
  LightState state_;
};

TEST_F(Outlines, AHaloTwiceAsLargeIsDroppedAndRecorded) {
  Show(1, 2);
  LightData data;
  data.dimming = given_.dimming;
  data.readings.push_back({{{0, 0, 0}, {0, 0, 1}}, 0, 100, 1, false});
  data.outlines = Taken();
  ASSERT_EQ(data.outlines.size(), 6u);
  const Room room = MakeRoom(Scene{});
  LightModel model(room, data);
  model.FreezeVisibility(state_);
  LuminaireFit fit;
  fit.state = state_;
  fit.predicted = model.Predict(state_, {}, false).value;

  Findings findings;
  const std::vector<LuminaireOutline> kept = ExplainedOutlines(given_, data, fit, findings);
  EXPECT_EQ(CountOf(kept, 0), 3);
  EXPECT_EQ(CountOf(kept, 1), 0);
  ASSERT_EQ(findings.choices.size(), 2u);
  for (const Choice& choice : findings.choices) {
    EXPECT_EQ(choice.chosen, choice.what == "outline of A" ? "used" : "not used") << choice.what;
    EXPECT_NE(choice.because.find("3 views"), std::string::npos) << choice.because;
  }
  EXPECT_EQ(findings.choices[0].what, "outline of A");
  EXPECT_EQ(findings.choices[1].what, "outline of B");
}

TEST_F(Outlines, APointHasNoOutline) {
  Show(1, 1);
  EXPECT_EQ(CountOf(Taken(), 1), 3);
  KnownLuminaire& b = given_.luminaires[1];
  b.luminaire.shape = LuminaireShape::kPoint;
  EXPECT_EQ(CountOf(Taken(), 0), 3);
  EXPECT_EQ(CountOf(Taken(), 1), 0);
  // A point that nobody stated is the start of a search for the shape.
  b.shape_is_known = false;
  EXPECT_EQ(CountOf(Taken(), 1), 3);
  b.photometry = KnownPhotometry::kFile;
  EXPECT_EQ(CountOf(Taken(), 1), 0);
}

// Seen at a slant, a disc of 0.3 m is an ellipse: the median of its radii lies between the half axes.
TEST_F(Outlines, APointOfOpenShapeBecomesADiscOfTheSizeThatPhotosShow) {
  Show(1, 1);
  const std::vector<LuminaireOutline> outlines = Taken();
  LightState points = state_;
  for (Luminaire& l : points.luminaires) {
    l.shape = LuminaireShape::kPoint;
    l.distribution = Distribution::kLambertian;
    l.size_m.setZero();
  }
  std::vector<OpenChoice> open(2);
  Findings findings;
  const LightState sized = WithSeenSizes(open, outlines, points, findings);
  for (size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(sized.luminaires[k].shape, LuminaireShape::kDisc);
    EXPECT_GT(sized.luminaires[k].size_m[0], 0.15);
    EXPECT_LT(sized.luminaires[k].size_m[0], 0.31);
    EXPECT_TRUE(sized.free[k].size);
  }
  ASSERT_EQ(findings.choices.size(), 2u);
  EXPECT_EQ(findings.choices[0].what, "shape of A");
  EXPECT_EQ(findings.choices[0].chosen, "disc");

  // Not where the shape is given, nor where the luminaire has no aim, nor where it looks as small as a point.
  open[0].shape = false;
  points.luminaires[1].distribution = Distribution::kIsotropic;
  EXPECT_EQ(WithSeenSizes(open, outlines, points, findings).luminaires[0].shape, LuminaireShape::kPoint);
  EXPECT_EQ(WithSeenSizes(open, outlines, points, findings).luminaires[1].shape, LuminaireShape::kPoint);
  points.luminaires[1].distribution = Distribution::kLambertian;
  Show(0.01, 0.01);
  EXPECT_EQ(WithSeenSizes(open, Taken(), points, findings).luminaires[1].shape, LuminaireShape::kPoint);
  EXPECT_EQ(findings.choices.size(), 2u);
}

// Seen at a slant from three sides: 32 points of a circle enclose 0.6 % less than it.
TEST_F(Outlines, TheShownAreaIsThatOfTheOpening) {
  Show(1, 2);
  const std::vector<LuminaireOutline> outlines = Taken();
  const double own_m2 = OpeningAreaM2(state_.luminaires[0]);
  EXPECT_NEAR(own_m2, support::kPi / 4 * 0.09, 1e-12);
  EXPECT_NEAR(ShownAreaM2(state_.luminaires[0], outlines, 0), own_m2, 0.01 * own_m2);
  EXPECT_NEAR(ShownAreaM2(state_.luminaires[1], outlines, 1), 4 * own_m2, 0.04 * own_m2);
  EXPECT_EQ(ShownAreaM2(state_.luminaires[0], {}, 0), 0);
  Luminaire beside = state_.luminaires[0];
  beside.position.z() = eyes_[0].z();  // in the plane of the eye, above the others'
  EXPECT_EQ(ShownAreaM2(beside, {outlines[0]}, 0), 0);
  beside.shape = LuminaireShape::kSphere;
  EXPECT_EQ(OpeningAreaM2(beside), 0);
}

// As a panel ended once in very noisy photos: 2.9 m x 2.4 m, its rim near the points of the panel's.
TEST_F(Outlines, AFarLargerOpeningGetsTheSizeThatPhotosShow) {
  Show(1, 1);
  const std::vector<LuminaireOutline> outlines = Taken();
  LightState large = state_;
  large.luminaires[0].shape = LuminaireShape::kRectangle;
  large.luminaires[0].size_m = {2.9, 2.4};
  large.luminaires[1].size_m = {0.6, 0.6};  // four times: a lit housing may be that much larger
  std::vector<OpenChoice> open(2);
  Findings findings;
  const LightState sized = WithSeenSizes(open, outlines, large, findings);
  const double shown_m2 = ShownAreaM2(large.luminaires[0], outlines, 0);
  EXPECT_NEAR(sized.luminaires[0].size_m.prod(), shown_m2, 1e-9);
  EXPECT_NEAR(sized.luminaires[0].size_m[0] / sized.luminaires[0].size_m[1], 2.9 / 2.4, 1e-9);
  EXPECT_EQ(sized.luminaires[1].size_m, large.luminaires[1].size_m);
  ASSERT_EQ(findings.choices.size(), 1u);
  EXPECT_EQ(findings.choices[0].what, "size of A");
  EXPECT_EQ(findings.choices[0].chosen, "as photos show");
  open[0].shape = false;
  EXPECT_EQ(WithSeenSizes(open, outlines, large, findings).luminaires[0].size_m, large.luminaires[0].size_m);
}

TEST_F(Outlines, LuminairesThatAreHeldOrNotFoundHaveNone) {
  Show(1, 1);
  EXPECT_EQ(CountOf(Taken({true, false}), 1), 0);
  EXPECT_EQ(CountOf(Taken({true, false}), 0), 3);
  given_.luminaires[0].is_held = true;
  EXPECT_EQ(CountOf(Taken(), 0), 0);
}

// Twelve views stand 1 m to 12 m from A: the nearest three hold 87 % of the sum of 1 / distance^2, four hold 91 %. Two
// views of B tell alike.
TEST_F(Outlines, ViewsThatTellLittleMoreAreNotNeeded) {
  given_.outlines.clear();
  const Eigen::Vector3d a = state_.luminaires[0].position, b = state_.luminaires[1].position;
  for (int view = 11; view >= 0; --view) {
    const Eigen::Vector3d eye = a - (view + 1.0) * Eigen::Vector3d(0.6, 0, 0.8);
    given_.outlines.push_back(support::OutlineFrom(eye, state_.luminaires[0], {view, 0, 1}));
  }
  for (const int view : {12, 13}) {
    const Eigen::Vector3d eye = b + Eigen::Vector3d(0, view - 12.5, -1.5);
    given_.outlines.push_back(support::OutlineFrom(eye, state_.luminaires[1], {view, 0, 1}));
  }
  std::vector<int> views;
  for (const LuminaireOutline& outline : TellingOutlines(Taken(), state_)) views.push_back(outline.seen.view);
  EXPECT_EQ(views, (std::vector<int>{0, 1, 2, 3, 12, 13}));
}

}  // namespace
}  // namespace luxfit
