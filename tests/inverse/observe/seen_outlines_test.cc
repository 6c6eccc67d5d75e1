#include "inverse/observe/seen_luminaires.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/inverse/luminaire_outlines.h"

namespace luxfit {
namespace {

const Eigen::Vector3d kEye(0.2, -0.4, 0.5);

Camera DistortedCamera() {
  Camera camera = support::OutlineCamera();
  camera.distortion = {-0.11, 0.06, 4e-4, -7e-4};
  return camera;
}

BrightBlob BlobOf(const std::vector<Eigen::Vector2d>& contour_px) {
  BrightBlob blob;
  blob.contour_px = contour_px;
  return blob;
}

std::vector<Eigen::Vector2d> Circle(const Eigen::Vector2d& center, double radius_px, int points) {
  std::vector<Eigen::Vector2d> circle;
  circle.reserve(static_cast<size_t>(points));
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * support::kPi * i / points;
    circle.push_back(center + radius_px * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return circle;
}

Luminaire Disc(const std::string& id, const Eigen::Vector3d& position) {
  Luminaire disc;
  disc.id = id;
  disc.position = position;
  disc.shape = LuminaireShape::kDisc;
  disc.size_m = {0.3, 0.3};
  return disc;
}

TEST(FindSeenOutlines, RaysMeetTheContour) {
  const Camera camera = DistortedCamera();
  const RegisteredView view = support::ViewFrom(kEye, {2, 1, 2.2});
  const std::vector<Eigen::Vector2d> contour_px = Circle({150, 420}, 60, 32);
  const auto outlines = FindSeenOutlines({camera}, {view}, {{0, 3, {BlobOf(contour_px)}}});
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_EQ(outlines[0].view, 0);
  EXPECT_EQ(outlines[0].state, 3);
  EXPECT_LT((outlines[0].eye - kEye).norm(), 1e-12);
  ASSERT_EQ(outlines[0].rays.size(), contour_px.size());
  for (size_t i = 0; i < contour_px.size(); ++i) {
    const Eigen::Vector3d& direction = outlines[0].rays[i].direction;
    EXPECT_NEAR(direction.norm(), 1, 1e-12);
    const Eigen::Vector2d pixel = Project(camera, view.cam_from_world * (kEye + 2.5 * direction));
    EXPECT_LT((pixel - contour_px[i]).norm(), 1e-6);
  }
}

// Off the axis by t, a pinhole has f / cos^2(t) along the radius and f / cos(t) across it.
TEST(FindSeenOutlines, ScaleOfAPinholeIsItsFocalLengthOnTheAxis) {
  const Camera camera = support::OutlineCamera();
  const Eigen::Vector2d axis(camera.cx_px, camera.cy_px);
  std::vector<Eigen::Vector2d> pixels(5, axis);
  pixels.emplace_back(axis + Eigen::Vector2d(210, -160));
  const SeenOutline outline = support::OutlineThrough(camera, support::ViewFrom(kEye, {2, 1, 2}), pixels);
  ASSERT_EQ(outline.rays.size(), 6u);
  for (size_t i = 0; i < 5; ++i) EXPECT_NEAR(outline.rays[i].px_per_rad, camera.fx_px, 1e-6);
  const double cosine = camera.fx_px / std::hypot(camera.fx_px, 210, 160);
  EXPECT_NEAR(outline.rays[5].px_per_rad, camera.fx_px / std::pow(cosine, 1.5), 1e-6);
}

TEST(FindSeenOutlines, FewPointsAreNoOutline) {
  const RegisteredView view = support::ViewFrom(kEye, {2, 1, 2.2});
  const PhotoBlobs photo{0, 0, {BlobOf(Circle({200, 200}, 3, 5)), BlobOf(Circle({300, 200}, 3, 6)), {}}};
  const auto outlines = FindSeenOutlines({support::OutlineCamera()}, {view}, {photo});
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_EQ(outlines[0].rays.size(), 6u);
}

TEST(FindSeenOutlines, AViewOutOfRangeIsRefused) {
  const std::vector<RegisteredView> views{support::ViewFrom(kEye, {2, 1, 2.2})};
  for (const int view : {-1, 1})
    EXPECT_THROW(FindSeenOutlines({support::OutlineCamera()}, views, {{view, 0, {}}}), std::invalid_argument);
}

// Two discs of 0.3 m, 1.2 m apart under a ceiling. State 0: both are on, 1: A alone, 2: B alone.
class MatchedOutlines : public testing::Test {
 protected:
  std::vector<LuminaireOutline> Match(const std::vector<SeenOutline>& outlines) const {
    return MatchOutlines(outlines, {a_, b_}, dimming_);
  }
  // Returns the angle between the luminaire's centre and the mean of the outline's rays.
  static double AngleOff(const SeenOutline& outline, const Luminaire& luminaire) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const OutlineRay& ray : outline.rays) sum += ray.direction;
    const Eigen::Vector3d to = luminaire.position - outline.eye;
    return std::atan2(sum.cross(to).norm(), sum.dot(to));
  }

  const Luminaire a_ = Disc("A", {1.2, 1.0, 2.4}), b_ = Disc("B", {2.4, 1.0, 2.4});
  const std::vector<Eigen::VectorXd> dimming_{Eigen::Vector2d(1, 0.5), Eigen::Vector2d(1, 0),
                                              Eigen::Vector2d(0, 1)};
};

TEST_F(MatchedOutlines, EachBelongsToItsOwnLuminaire) {
  const auto matched = Match({support::OutlineFrom(kEye, b_), support::OutlineFrom(kEye, a_)});
  ASSERT_EQ(matched.size(), 2u);
  for (const LuminaireOutline& outline : matched)
    EXPECT_LT(AngleOff(outline.seen, outline.luminaire == 0 ? a_ : b_), 0.01);
  EXPECT_NE(matched[0].luminaire, matched[1].luminaire);
}

TEST_F(MatchedOutlines, APlaceToFiveCentimetresIsEnough) {
  const SeenOutline seen = support::OutlineFrom(kEye, a_);
  for (const double off_m : {0.04, 0.5}) {
    Luminaire guess = a_;
    guess.position.x() -= off_m;
    EXPECT_EQ(MatchOutlines({seen}, {guess, b_}, dimming_).size(), off_m < 0.05 ? 1u : 0u) << off_m;
  }
}

TEST_F(MatchedOutlines, AnOutlineOfTwoLuminairesIsLeftOut) {
  Luminaire both = Disc("both", {1.8, 1.0, 2.4});
  both.size_m.setConstant(1.6);
  EXPECT_TRUE(Match({support::OutlineFrom(kEye, both)}).empty());
  // Where only one of them is on, the outline is its own.
  const auto alone = Match({support::OutlineFrom(kEye, both, {0, 2})});
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_EQ(alone[0].luminaire, 1);
}

TEST_F(MatchedOutlines, ALuminaireThatIsOffHasNone) {
  EXPECT_TRUE(Match({support::OutlineFrom(kEye, a_, {0, 2})}).empty());
  EXPECT_EQ(Match({support::OutlineFrom(kEye, a_, {0, 1})}).size(), 1u);
}

TEST_F(MatchedOutlines, OfOneViewThePhotoWithFewestLuminairesOnCounts) {
  std::vector<SeenOutline> outlines{support::OutlineFrom(kEye, a_, {0, 0}),
                                    support::OutlineFrom(kEye, a_, {0, 1})};
  for (int order = 0; order < 2; ++order) {
    const auto matched = Match(outlines);
    ASSERT_EQ(matched.size(), 1u);
    EXPECT_EQ(matched[0].seen.state, 1);
    std::reverse(outlines.begin(), outlines.end());
  }
  outlines[0].view = 1;
  EXPECT_EQ(Match(outlines).size(), 2u);
}

}  // namespace
}  // namespace luxfit
