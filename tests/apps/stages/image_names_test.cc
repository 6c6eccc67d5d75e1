#include "apps/stages/register/image_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace luxfit {
namespace {

using testing::HasSubstr;
using testing::Pair;
using testing::UnorderedElementsAre;

const std::vector<PhotoOfView> kRig = {
    {"/data/rig/left/0000.png", "l0"}, {"/data/rig/right/0000.png", "r0"}, {"/data/rig/left/0001.png", "l1"}};

TEST(ImageNames, FoldersTellPhotosOfOneNameApart) {
  EXPECT_THAT(
      ViewsOfImages({"left/0000.png", "right\\0000.jpg", "left/0001.png", "front/0002.png"}, kRig, "m"),
      UnorderedElementsAre(Pair("left/0000.png", "l0"), Pair("right\\0000.jpg", "r0"),
                           Pair("left/0001.png", "l1")));
}

TEST(ImageNames, ANameThatFitsTwoViewsIsRefused) {
  try {
    ViewsOfImages({"0000.png"}, kRig, "sparse/0");
    FAIL() << "expected a refusal";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("sparse/0: image 0000.png: expected a name that one view's photos end in, got "
                          "one that /data/rig/left/0000.png and /data/rig/right/0000.png end in"));
  }
  EXPECT_THAT(ViewsOfImages({"0001.png"}, kRig, "m"), UnorderedElementsAre(Pair("0001.png", "l1")));
}

TEST(ImageNames, PhotosOfOneViewAreOneAndViewsHaveNames) {
  const std::vector<PhotoOfView> photos = {
      {"a/dark/v0.png", "v0"}, {"a/light/v0.png", "v0"}, {"a/IMG_1.x.png", "v1"}};
  EXPECT_THAT(ViewsOfImages({"v0.jpg", "IMG_1.x.jpg", "v1.png"}, photos, "m"),
              UnorderedElementsAre(Pair("v0.jpg", "v0"), Pair("IMG_1.x.jpg", "v1"), Pair("v1.png", "v1")));
}

}  // namespace
}  // namespace luxfit
