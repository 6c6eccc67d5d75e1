#include "calib/targets/board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::HasSubstr;

std::string ErrorOf(const std::string& text, int count) {
  const TempFolder folder;
  folder.Write("corners.vnl", text);
  try {
    ReadCornersFile(folder.Path("corners.vnl"), count);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CornersFile, ReadsMrcalsTable) {
  const TempFolder folder;
  folder.Write("corners.vnl",
               "## made by a program\n# filename x y level\na.png 1.5 2.5 0\na.png - - -\na.png 3 4 2\n"
               "b.png - - -\nc.png 5 6 0\nc.png 7 8 1\nc.png 9 10 -\n");
  const std::vector<ImageCorners> images = ReadCornersFile(folder.Path("corners.vnl"), 3);
  ASSERT_EQ(images.size(), 3U);
  EXPECT_EQ(images[0].file, "a.png");
  ASSERT_EQ(images[0].corners.size(), 2U);
  EXPECT_EQ(images[0].corners[1].index, 2);
  EXPECT_EQ(images[0].corners[1].pixel, Eigen::Vector2d(3, 4));
  EXPECT_DOUBLE_EQ(images[0].corners[1].sigma_px, 4 * images[0].corners[0].sigma_px);
  EXPECT_TRUE(images[1].corners.empty());
  EXPECT_EQ(images[2].corners.size(), 3U);
}

TEST(CornersFile, WhatIsWrittenIsReadAgain) {
  const std::vector<ImageCorners> images = {{"a.png", {{0, {1.25, 2.5}, 0.1}, {3, {4, 5}, 0.2}}},
                                            {"b.png", {}}};
  const TempFolder folder;
  folder.Write("corners.vnl", CornersFile(images, 4));
  const std::vector<ImageCorners> read = ReadCornersFile(folder.Path("corners.vnl"), 4);
  ASSERT_EQ(read.size(), 2U);
  ASSERT_EQ(read[0].corners.size(), 2U);
  EXPECT_EQ(read[0].corners[1].index, 3);
  EXPECT_NEAR(read[0].corners[0].pixel.x(), 1.25, 1e-6);
  EXPECT_DOUBLE_EQ(read[0].corners[1].sigma_px, 2 * read[0].corners[0].sigma_px);
}

TEST(CornersFile, MalformedTablesAreRefusedByLine) {
  EXPECT_THAT(ErrorOf("# filename x\n", 2), HasSubstr("corners.vnl:1: corners: expected a header"));
  EXPECT_THAT(ErrorOf("# filename x y level\na.png 1 2 0\n", 2), HasSubstr("expected 2 rows for a.png"));
  EXPECT_THAT(ErrorOf("# filename x y level\na.png 1 2,5 0\na.png 1 2 0\n", 2),
              HasSubstr(":2: corners: expected a number"));
  EXPECT_THAT(ErrorOf("# filename x y level\na.png 1 2 0\na.png 1 2 0\na.png 1 2 0\n", 2),
              HasSubstr("expected 2 rows an image"));
  EXPECT_THAT(ErrorOf("a.png 1 2 0\n", 2), HasSubstr("expected the header"));
  EXPECT_THAT(ErrorOf("# filename x y level\n", 2), HasSubstr("at least one row"));
  EXPECT_THAT(ErrorOf("# filename x y level\na.png 1\n", 2), HasSubstr("expected filename, x and y"));
}

}  // namespace
}  // namespace luxfit
