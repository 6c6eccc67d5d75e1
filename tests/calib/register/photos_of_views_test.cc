#include "calib/register/photos_of_views.h"

#include <gtest/gtest.h>

#include <vector>

namespace luxfit {
namespace {

TagDetection Tag(int id, double x, double y) {
  TagDetection tag;
  tag.id = id;
  tag.corners_px = {Eigen::Vector2d(x, y), Eigen::Vector2d(x + 40, y), Eigen::Vector2d(x + 40, y + 40),
                    Eigen::Vector2d(x, y + 40)};
  return tag;
}

// View 0 shows tags 1 and 2, view 1 tags 2 and 3; detections scatter by 0.2 px.
PhotoTags Photo(int view, int shows, double noise_px) {
  if (shows == 0) return {view, {Tag(1, 100 + noise_px, 100), Tag(2, 300, 120 - noise_px)}};
  return {view, {Tag(2, 80 - noise_px, 90), Tag(3, 200, 50 + noise_px)}};
}

std::vector<PhotoTags> Photos() {
  return {Photo(0, 0, 0.2), Photo(0, 0, -0.1), Photo(0, 0, 0),
          Photo(1, 1, 0.2), Photo(1, 1, -0.2), Photo(1, 1, 0.1)};
}

TEST(PhotosOfViews, RightPhotosAreLeftAlone) { EXPECT_TRUE(FindPhotosOfOtherViews(Photos()).empty()); }

TEST(PhotosOfViews, ExchangedPhotosAreNamed) {
  std::vector<PhotoTags> photos = Photos();
  photos.push_back(Photo(0, 1, 0.1));
  photos.push_back(Photo(1, 0, -0.2));
  const std::vector<PhotoOfOtherView> found = FindPhotosOfOtherViews(photos);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].photo, 6u);
  EXPECT_EQ(found[0].as_if, 1);
  EXPECT_EQ(found[0].tags, 2);
  EXPECT_EQ(found[1].photo, 7u);
  EXPECT_EQ(found[1].as_if, 0);
}

TEST(PhotosOfViews, ATagThatMovedIsNoOtherView) {
  std::vector<PhotoTags> photos = Photos();
  photos.push_back({0, {Tag(1, 130, 100), Tag(2, 300, 120)}});  // one tag was moved
  photos.push_back({0, {Tag(1, 400, 100), Tag(2, 10, 10)}});    // the camera was moved, to no other view
  EXPECT_TRUE(FindPhotosOfOtherViews(photos).empty());
}

TEST(PhotosOfViews, OfTwoPhotosNobodyKnowsWhichIsWrong) {
  std::vector<PhotoTags> photos = Photos();
  photos.erase(photos.begin(), photos.begin() + 2);
  photos.push_back(Photo(0, 1, 0));
  EXPECT_TRUE(FindPhotosOfOtherViews(photos).empty());
}

TEST(PhotosOfViews, PhotosWithoutTagsTellNothing) {
  EXPECT_TRUE(FindPhotosOfOtherViews({}).empty());
  std::vector<PhotoTags> photos = Photos();
  photos.push_back({0, {}});
  EXPECT_TRUE(FindPhotosOfOtherViews(photos).empty());
}

}  // namespace
}  // namespace luxfit
