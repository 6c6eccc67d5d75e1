#include "calib/register/view_tags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TagDetection TagAt(int id, double u, double v) {
  TagDetection tag;
  tag.id = id;
  tag.corners_px = {Eigen::Vector2d(u, v), Eigen::Vector2d(u + 40, v), Eigen::Vector2d(u + 40, v + 40),
                    Eigen::Vector2d(u, v + 40)};
  tag.side_px = 40;
  tag.corner_sigma_px = 0.1;
  return tag;
}

TEST(ViewTagsTest, SixPhotosOfMostLightTellAView) {
  const PhotosOfViews photos =
      MostLitPhotos({"b", "a", "b", "b", "b", "b", "b", "b"}, {1, 1, 4, 4, 0, 2, 3, 5});
  ASSERT_THAT(photos, SizeIs(2));
  EXPECT_THAT(photos.at("a"), ElementsAre(1));
  // The first of equally lit photos comes first. The darkest takes no part.
  EXPECT_THAT(photos.at("b"), ElementsAre(7, 2, 3, 6, 5, 0));
}

TEST(ViewTagsTest, APhotoOfAnotherViewIsNamedAndItsTagsAreInNone) {
  // Photos 0 to 2 are of view a, 3 to 5 of b; photo 5 shows a.
  const auto detect = [](std::size_t photo) {
    const bool shows_a = photo < 3 || photo == 5;
    return std::vector<TagDetection>{shows_a ? TagAt(1, 100, 100) : TagAt(2, 300, 200)};
  };
  const ViewTags found = FindViewTags({{"a", {0, 1, 2}}, {"b", {3, 4, 5}}}, {0, 0, 0, 1, 1, 1}, detect);
  ASSERT_THAT(found.of_other_views, SizeIs(1));
  EXPECT_EQ(found.of_other_views[0].photo, 5U);
  EXPECT_EQ(found.views.at(static_cast<std::size_t>(found.of_other_views[0].as_if)).view, "a");
  ASSERT_THAT(found.views, SizeIs(2));
  EXPECT_EQ(found.views[1].camera, 1);
  ASSERT_THAT(found.views[1].tags, SizeIs(1));
  EXPECT_EQ(found.views[1].tags[0].id, 2);
}

TEST(ViewTagsTest, AViewWithoutTagsStays) {
  const ViewTags found =
      FindViewTags({{"a", {0}}}, {0}, [](std::size_t) { return std::vector<TagDetection>{}; });
  ASSERT_THAT(found.views, SizeIs(1));
  EXPECT_THAT(found.views[0].tags, IsEmpty());
}

}  // namespace
}  // namespace luxfit
