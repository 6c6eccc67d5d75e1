#include "inverse/observe/seen_luminaires.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>

#include "tests/inverse/observe/lamp_photos.h"
#include "tests/support/calib/look_at.h"
#include "tests/support/calib/pinhole.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::LampScene;
using support::LuminousRectangle;

Camera WideCamera() {
  Camera camera = support::Pinhole(480, 360, 340, {239.5, 179.5});
  camera.distortion = {-0.11, 0.06, 4e-4, -7e-4};
  return camera;
}

const PixelDirections& Directions() {
  static const PixelDirections directions = UnprojectAllPixels(WideCamera());
  return directions;
}

// A room of 6 m x 4 m x 2.8 m with a table, seen by five views.
class SeenLuminaires : public testing::Test {
 protected:
  SeenLuminaires() : cameras_{WideCamera()} {
    Scene scene = support::ClosedRoom({6, 4, 2.8});
    support::AddParallelogram(scene, {2, 1, 0.74}, {1.6, 0, 0}, {0, 1, 0}, "table");
    room_ = std::make_unique<Room>(MakeRoom(scene, {{2, 2}, {1}}));
    const std::vector<Eigen::Vector3d> eyes = {
        {0.4, 0.4, 1.6}, {5.6, 3.6, 1.6}, {0.5, 3.5, 1.5}, {5.5, 0.5, 1.4}, {3, 0.3, 1.6}};
    for (const Eigen::Vector3d& eye : eyes) {
      RegisteredView view;
      view.cam_from_world = support::LookAt(eye, {3, 2, 1.8});
      views_.push_back(view);
    }
  }

  PhotoBlobs Seen(const LampScene& scene, int view, int state, double exposure_s = 0.25) const {
    const Photo photo = support::PhotographLamps(
        scene, cameras_[0], Directions(), views_[static_cast<size_t>(view)].cam_from_world, exposure_s);
    return {view, state, FindBrightBlobs(ToRelativeLuminance(photo, exposure_s))};
  }
  std::vector<PhotoBlobs> SeenByAll(const LampScene& scene, int state = 0) const {
    std::vector<PhotoBlobs> photos;
    photos.reserve(views_.size());
    for (int v = 0; v < static_cast<int>(views_.size()); ++v) photos.push_back(Seen(scene, v, state));
    return photos;
  }
  // A square blob about the place's image in each view, its centre off by that noise along each axis.
  std::vector<PhotoBlobs> NoisyBlobs(const Eigen::Vector3d& place, double width_px, double sigma_px,
                                     std::mt19937_64& rng) const {
    std::normal_distribution<double> noise(0, sigma_px);
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(width_px / 2);
    std::vector<PhotoBlobs> photos;
    for (int v = 0; v < static_cast<int>(views_.size()); ++v) {
      const Eigen::Vector3d in_cam = views_[static_cast<size_t>(v)].cam_from_world * place;
      BrightBlob blob;
      blob.center_px = Project(cameras_[0], in_cam) + Eigen::Vector2d(noise(rng), noise(rng));
      blob.extent_px = {blob.center_px - half, blob.center_px + half};
      blob.area_px2 = width_px * width_px;
      photos.push_back({v, 0, {blob}});
    }
    return photos;
  }
  std::vector<SeenPlace> Find(const std::vector<PhotoBlobs>& photos) const {
    return FindSeenLuminaires(*room_, cameras_, views_, photos);
  }

  std::vector<Camera> cameras_;
  std::vector<RegisteredView> views_;
  std::unique_ptr<Room> room_;
};

TEST_F(SeenLuminaires, APanelHasItsPlaceAndArea) {
  const LuminousRectangle panel{{2.7, 2.3, 2.79}, {0.3, 0.3}, 100};
  const auto places = Find(SeenByAll({{panel}, {}, {}}));
  ASSERT_EQ(places.size(), 1u);
  EXPECT_GE(places[0].views, 3);
  EXPECT_EQ(places[0].missing, 0);
  // The middle of a photo's quadrilateral is not the photo of the middle: centimetres, and said to be.
  EXPECT_LT((places[0].position - panel.center).norm(), 0.03) << places[0].position.transpose();
  EXPECT_LT((places[0].position - panel.center).norm(), 3 * places[0].sigma_m);
  // Blobs of 40 to 70 px, their centres known to 2 to 4 px of 340, from five views at 2.3 to 3.6 m: 15 mm upwards.
  std::printf("sigma %.1f mm\n", 1000 * places[0].sigma_m);
  EXPECT_LT(places[0].sigma_m, 0.022);
  EXPECT_NEAR(places[0].area_m2, 0.36, 0.03);  // a pixel of the outline is 3 % of it
  EXPECT_EQ(places[0].states, std::vector<int>{0});
}

// A photo's quadrilateral is put on the plane of the place, which is known to 20 mm in height.
TEST_F(SeenLuminaires, ALongOneHasItsSidesAndHeading) {
  for (const bool is_along_x : {true, false}) {
    LuminousRectangle strip{{2.7, 2.3, 2.2}, {0.6, 0.1}, 100};
    if (!is_along_x) strip.half_size_m = {0.1, 0.6};
    const auto places = Find(SeenByAll({{strip}, {}, {}}));
    ASSERT_EQ(places.size(), 1u);
    std::printf("%.3f m x %.3f m\n", places[0].size_m[0], places[0].size_m[1]);
    EXPECT_NEAR(places[0].size_m[0], 1.2, 0.05);
    EXPECT_NEAR(places[0].size_m[1], 0.2, 0.03);
    EXPECT_GT(std::abs(places[0].heading[is_along_x ? 0 : 1]), std::cos(0.03));
    EXPECT_NEAR(places[0].heading.norm(), 1, 1e-12);
  }
}

// From one end a strip could as well be a body that hangs down.
TEST_F(SeenLuminaires, AlongTheSightNoLengthIsTold) {
  const LuminousRectangle strip{{2.7, 2.0, 2.2}, {0.6, 0.1}, 100};
  views_.resize(3);
  for (size_t v = 0; v < views_.size(); ++v)
    views_[v].cam_from_world = support::LookAt({0.4, 1.2 + 0.8 * static_cast<double>(v), 1.2}, strip.center);
  const auto places = Find(SeenByAll({{strip}, {}, {}}));
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].size_m, Eigen::Vector2d::Zero());
}

TEST_F(SeenLuminaires, AShortExposureDoesAsWell) {
  const LuminousRectangle panel{{2.7, 2.3, 2.79}, {0.3, 0.3}, 100};
  std::vector<PhotoBlobs> photos;
  photos.reserve(views_.size());
  for (int v = 0; v < 5; ++v) photos.push_back(Seen({{panel}, {}, {}}, v, 0, 0.009));  // 0.9 of full scale
  const auto places = Find(photos);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_LT((places[0].position - panel.center).norm(), 0.03);
}

// A centre is known to a pixel and a twentieth of the blob's width: one cause rules a small blob, the other a large
// one. A pixel is a smaller angle off the axis than on it (cos^2 of 10 degrees: 0.97), so that sigma is cautious by
// some percent. The scatter of 400 draws is itself known to 4 %.
TEST_F(SeenLuminaires, SigmaIsTheScatterOfManyDraws) {
  const Eigen::Vector3d place(2.7, 2.3, 2.2);
  std::mt19937_64 rng = support::TestRng();
  constexpr int kDraws = 400;
  for (const double width_px : {5.0, 60.0}) {
    const double sigma_px = std::hypot(1, 0.05 * width_px);
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    double stated_m2 = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const std::vector<SeenPlace> places = Find(NoisyBlobs(place, width_px, sigma_px, rng));
      ASSERT_FALSE(places.empty()) << draw;
      const Eigen::Vector3d error = places[0].position - place;
      scatter += error * error.transpose() / kDraws;
      stated_m2 += places[0].sigma_m * places[0].sigma_m / kDraws;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter, Eigen::EigenvaluesOnly);
    const double ratio = std::sqrt(axes.eigenvalues()[2] / stated_m2);
    std::printf("blobs of %.0f px: scatter %.1f mm, %.2f of sigma\n", width_px,
                1e3 * std::sqrt(axes.eigenvalues()[2]), ratio);
    EXPECT_GT(ratio, 0.85);
    EXPECT_LT(ratio, 1.15);
  }
}

// Every view saw it from the room, whatever triangulation says.
TEST_F(SeenLuminaires, APlaceAboveTheCeilingLiesJustBelowIt) {
  std::mt19937_64 rng = support::TestRng();
  const Eigen::Vector3d above(2.7, 2.3, 2.815);
  const auto places = Find(NoisyBlobs(above, 5, 0.2, rng));
  ASSERT_EQ(places.size(), 1u);
  EXPECT_NEAR(places[0].position.z(), 2.79, 1e-6);
  EXPECT_LT((places[0].position - above).head<2>().norm(), 0.01);
}

TEST_F(SeenLuminaires, SeveralLampsAreTheirOwnPlaces) {
  const LampScene scene{{{{1.5, 2.0, 2.79}, {0.3, 0.3}, 100}, {{2.9, 0.9, 2.78}, {0.05, 0.05}, 300}}, {}, {}};
  const auto places = Find(SeenByAll(scene));
  // Two views show all of the panel and leave 44 mm; four show the small lamp and leave 8.7 mm. 1.5 times that.
  const std::vector<double> most_sigma_m{0.066, 0.013};
  for (size_t k = 0; k < scene.lamps.size(); ++k) {
    const Eigen::Vector3d& center = scene.lamps[k].center;
    bool found = false;
    for (const SeenPlace& place : places) {
      const double off_m = (place.position - center).norm();
      if (off_m < 0.3)
        std::printf("lamp %zu: off by %.1f mm, sigma %.1f mm\n", k, 1000 * off_m, 1000 * place.sigma_m);
      found = found || (off_m < 3 * place.sigma_m && place.sigma_m < most_sigma_m[k]);
    }
    EXPECT_TRUE(found) << center.transpose();
  }
}

// A glossy counter mirrors a low lamp: its image below the floor is as well triangulated as the lamp itself.
TEST_F(SeenLuminaires, MirrorImagesLieOutsideTheRoom) {
  const LuminousRectangle lamp{{2.7, 1.6, 1.9}, {0.1, 0.1}, 100};
  const LuminousRectangle counter{{3, 2, 0.74}, {2.9, 1.9}, 0};
  for (RegisteredView& view : views_)
    view.cam_from_world = support::LookAt(view.cam_from_world.inverse().translation(), {2.7, 1.6, 0.7});
  const auto photos = SeenByAll({{lamp}, {counter}, {}});
  int with_both = 0;
  for (const PhotoBlobs& photo : photos) with_both += photo.blobs.size() == 2 ? 1 : 0;
  ASSERT_GE(with_both, 3);
  const auto places = Find(photos);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_LT((places[0].position - lamp.center).norm(), 3 * places[0].sigma_m);
  // Blobs of 6 to 10 px, their centres known to a pixel of 340, from four views at 2.6 to 3.5 m: 9.1 mm.
  std::printf("sigma %.1f mm\n", 1000 * places[0].sigma_m);
  EXPECT_LT(places[0].sigma_m, 0.014);
}

// The white paper of a tag on a table saturates as a lamp does, in every state in which that lamp is on.
TEST_F(SeenLuminaires, PaperOfASurveyedTagIsNoLuminaire) {
  const LuminousRectangle lamp{{4.2, 2.6, 2.79}, {0.3, 0.3}, 100}, paper{{2.8, 1.5, 0.741}, {0.1, 0.1}, 100};
  const auto photos = SeenByAll({{lamp, paper}, {}, {}});
  const auto near = [](const std::vector<SeenPlace>& places, const Eigen::Vector3d& center) {
    return std::count_if(places.begin(), places.end(),
                         [&](const SeenPlace& p) { return (p.position - center).norm() < 0.1; });
  };
  EXPECT_GE(near(Find(photos), paper.center), 1);
  SeenLuminairesOptions options;
  options.tags = {{7, 0.2, {2.8, 1.5, 0.74}, {0, 0, 1}, {0, 1, 0}}};
  const auto places = FindSeenLuminaires(*room_, cameras_, views_, photos, options);
  EXPECT_EQ(near(places, paper.center), 0);
  EXPECT_EQ(near(places, lamp.center), near(Find(photos), lamp.center));
  // A lamp above the same tag stays.
  options.tags[0].center_in_world.z() = 0.5;
  EXPECT_GE(near(FindSeenLuminaires(*room_, cameras_, views_, photos, options), paper.center), 1);
}

// Two views were exposed so long that a lit part of the table is washed out; three show that it is no lamp.
TEST_F(SeenLuminaires, AWashedOutSurfaceIsNotOneInShorterExposures) {
  const LampScene scene{{}, {}, {{{2.8, 1.5, 0.741}, {0.2, 0.2}, 3.5}}};
  std::vector<PhotoBlobs> photos;
  photos.reserve(views_.size());
  for (int v = 0; v < 5; ++v) photos.push_back(Seen(scene, v, 0, v < 2 ? 0.5 : 0.1));
  ASSERT_EQ(photos[0].blobs.size() + photos[1].blobs.size(), 2u);
  EXPECT_TRUE(Find(photos).empty());
  // Where nothing contradicts, it stays a candidate.
  photos.resize(2);
  EXPECT_EQ(Find(photos).size(), 1u);
}

TEST_F(SeenLuminaires, StatesOfOnePlaceAreCollected) {
  const LuminousRectangle a{{1.5, 2.0, 2.79}, {0.3, 0.3}, 100}, b{{4.2, 2.6, 2.79}, {0.3, 0.3}, 100};
  std::vector<PhotoBlobs> photos = SeenByAll({{a}, {}, {}}, 0);
  for (const PhotoBlobs& photo : SeenByAll({{b}, {}, {}}, 1)) photos.push_back(photo);
  for (const PhotoBlobs& photo : SeenByAll({{a, b}, {}, {}}, 2)) photos.push_back(photo);
  const auto places = Find(photos);
  ASSERT_EQ(places.size(), 2u);
  for (const SeenPlace& place : places) {
    const bool is_a = place.position.x() < 3;
    EXPECT_EQ(place.states, (std::vector<int>{is_a ? 0 : 1, 2}));
  }
}

// In state 0 something small shines at one end of a pendant that is on in state 1.
TEST_F(SeenLuminaires, APlaceOnALongLuminaireIsPartOfIt) {
  const LuminousRectangle end{{2.5, 2.0, 2.2}, {0.06, 0.06}, 100}, pendant{{3.0, 2.0, 2.2}, {1.0, 0.1}, 100};
  std::vector<PhotoBlobs> photos = SeenByAll({{end}, {}, {}}, 0);
  for (const PhotoBlobs& photo : SeenByAll({{pendant}, {}, {}}, 1)) photos.push_back(photo);
  const auto places = Find(photos);
  const auto at_end = std::find_if(places.begin(), places.end(), [&](const SeenPlace& place) {
    return (place.position - Eigen::Vector3d(2.5, 2.0, 2.2)).norm() < 0.1;
  });
  ASSERT_NE(at_end, places.end());
  EXPECT_EQ(at_end->states, std::vector<int>{0});
  EXPECT_EQ(at_end->covered_states, std::vector<int>{1});
  const auto may_be = [&](double in_0, double in_1) {
    return MayBePlaceOf(*at_end, {Eigen::VectorXd::Constant(1, in_0), Eigen::VectorXd::Constant(1, in_1)}, 0);
  };
  EXPECT_FALSE(may_be(1, 0));
  EXPECT_TRUE(may_be(1, 1));
}

// A wall near a lamp is washed out where that lamp is on alone. With all on, exposures are shorter, and it is not.
TEST_F(SeenLuminaires, APlaceThatIsDarkWhereALuminaireIsOnIsNotIts) {
  const LampScene scene{{}, {}, {{{2.8, 1.5, 0.741}, {0.2, 0.2}, 3.5}}};
  std::vector<PhotoBlobs> photos;
  for (int v = 0; v < 5; ++v) {
    photos.push_back(Seen(scene, v, 0, 0.5));
    photos.push_back(Seen(scene, v, 1, 0.1));
  }
  const auto places = Find(photos);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].states, std::vector<int>{0});
  EXPECT_EQ(places[0].dark_states, std::vector<int>{1});
  const auto may_be = [&](double in_0, double in_1) {
    return MayBePlaceOf(places[0], {Eigen::VectorXd::Constant(1, in_0), Eigen::VectorXd::Constant(1, in_1)},
                        0);
  };
  EXPECT_FALSE(may_be(1, 1));
  EXPECT_FALSE(may_be(0.3, 1));
  EXPECT_FALSE(may_be(0, 1));
  EXPECT_TRUE(may_be(1, 0.3));  // a dimmed luminaire may be too weak for the exposure
  EXPECT_TRUE(may_be(1, 0));
}

// Three lamps are seen by all views. A fourth of their kind was photographed from one: its ray and the others' height tell
// its place.
class LampsOfOneHeight : public SeenLuminaires {
 protected:
  static LuminousRectangle At(double x, double y) { return {{x, y, 2.6}, {0.1, 0.1}, 100}; }
  std::vector<PhotoBlobs> OfOthers(int count) const {
    const std::vector<LuminousRectangle> others = {At(2.4, 1.7), At(3.6, 1.7), At(3.0, 2.6)};
    return SeenByAll({{others.begin(), others.begin() + count}, {}, {}}, 0);
  }
  static const SeenPlace* InState(const std::vector<SeenPlace>& places, int state) {
    const auto found = std::find_if(places.begin(), places.end(), [&](const SeenPlace& place) {
      return place.states == std::vector<int>{state};
    });
    return found == places.end() ? nullptr : &*found;
  }
};

TEST_F(LampsOfOneHeight, OneViewIsEnoughForAFourth) {
  const LuminousRectangle fourth = At(4.1, 2.5);
  std::vector<PhotoBlobs> photos = OfOthers(3);
  photos.push_back(Seen({{fourth}, {}, {}}, 0, 1));
  const std::vector<SeenPlace> places = Find(photos);
  const SeenPlace* const place = InState(places, 1);
  ASSERT_NE(place, nullptr);
  const double off_m = (place->position - fourth.center).norm();
  std::printf("off by %.1f mm, sigma %.1f mm\n", 1e3 * off_m, 1e3 * place->sigma_m);
  EXPECT_TRUE(place->is_at_common_height);
  EXPECT_EQ(place->views, 1);
  EXPECT_FALSE(IsSure(*place));
  EXPECT_LT(off_m, 3 * place->sigma_m);
  EXPECT_LT(place->sigma_m, 0.15);
  EXPECT_EQ(place->dark_states, std::vector<int>{0});
}

TEST_F(LampsOfOneHeight, TwoViewsMakeItSure) {
  std::vector<PhotoBlobs> photos = OfOthers(3);
  for (const int view : {0, 2}) photos.push_back(Seen({{At(4.1, 2.5)}, {}, {}}, view, 1));
  const std::vector<SeenPlace> places = Find(photos);
  const SeenPlace* const place = InState(places, 1);
  ASSERT_NE(place, nullptr);
  EXPECT_EQ(place->views, 2);
  EXPECT_TRUE(IsSure(*place));
}

TEST_F(LampsOfOneHeight, TwoLampsShareAHeightByChance) {
  std::vector<PhotoBlobs> photos = OfOthers(2);
  photos.push_back(Seen({{At(4.1, 2.5)}, {}, {}}, 0, 1));
  EXPECT_EQ(InState(Find(photos), 1), nullptr);
}

TEST_F(LampsOfOneHeight, ALargerLampIsOfAnotherKind) {
  std::vector<PhotoBlobs> photos = OfOthers(3);
  photos.push_back(Seen({{{{4.1, 2.5, 2.6}, {0.2, 0.2}, 100}}, {}, {}}, 0, 1));
  EXPECT_EQ(InState(Find(photos), 1), nullptr);
}

TEST_F(LampsOfOneHeight, NeighboursOfDifferentStatesStayApart) {
  std::vector<PhotoBlobs> photos = OfOthers(3);
  photos.push_back(Seen({{At(4.1, 2.5)}, {}, {}}, 0, 1));
  photos.push_back(Seen({{At(4.3, 2.5)}, {}, {}}, 0, 2));
  const std::vector<SeenPlace> places = Find(photos);
  ASSERT_NE(InState(places, 1), nullptr);
  ASSERT_NE(InState(places, 2), nullptr);
}

TEST_F(SeenLuminaires, NothingBrightIsNoPlace) {
  EXPECT_TRUE(Find(SeenByAll({})).empty());
  EXPECT_TRUE(Find({}).empty());
  PhotoBlobs wrong;
  wrong.view = 9;
  EXPECT_THROW(Find({wrong}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
