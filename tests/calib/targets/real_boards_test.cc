// Boards and tags in photos that nobody here made. LUXFIT_REAL_DATA names the folder that holds `calibration`
// (its licences do not let it be shipped); without it these tests are skipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "calib/photo_files/image.h"
#include "calib/targets/board.h"
#include "calib/targets/tags.h"

namespace luxfit {
namespace {

class RealBoardsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("LUXFIT_REAL_DATA");
    if (!folder) GTEST_SKIP() << "set LUXFIT_REAL_DATA to the folder that holds calibration/";
    folder_ = std::string(folder) + "/calibration/";
  }

  // 8-bit counts are sRGB's; taken to be linear light by a power of 2.2.
  ImagePlane ReadGrey(const std::string& name, double gamma) const {
    const Photo photo = ReadPhoto(folder_ + name);
    const ImagePlane grey =
        (photo.rgb_counts[0] * 0.265f + photo.rgb_counts[1] * 0.67f + photo.rgb_counts[2] * 0.065f) /
        static_cast<float>(photo.full_scale_counts);
    return grey.pow(static_cast<float>(gamma));
  }

  struct Outcome {
    BoardDetection detection;
    double cpu_s = 0;
    double sigma_px = 0;  // median
  };
  Outcome Detect(const std::string& name, const Board& board, double gamma = 1) const {
    const ImagePlane grey = ReadGrey(name, gamma);
    const std::clock_t start = std::clock();
    Outcome outcome;
    outcome.detection = DetectBoard(grey, board);
    outcome.cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::vector<double> sigmas_px;
    for (const BoardCorner& corner : outcome.detection.corners) sigmas_px.push_back(corner.sigma_px);
    std::sort(sigmas_px.begin(), sigmas_px.end());
    if (!sigmas_px.empty()) outcome.sigma_px = sigmas_px[sigmas_px.size() / 2];
    std::printf("%-40s %4zu corners, median sigma %.3f px, %.2f CPU s; %s\n", name.c_str(),
                outcome.detection.corners.size(), outcome.sigma_px, outcome.cpu_s,
                outcome.detection.message.c_str());
    return outcome;
  }

  std::string folder_;
};

Board Grid(int columns, int rows, double spacing) {
  Board board;
  board.columns = columns;
  board.rows = rows;
  board.tag_size_m = 0.088;
  board.spacing = spacing;
  return board;
}

constexpr double kMostCpuS = 1;  // asked for photos of 12 megapixels

// Phone photos of 12.5 megapixels of a screen that shows a Kalibr grid; 004 holds 24 tags in part or whole.
TEST_F(RealBoardsTest, PhotosOfAKalibrGrid) {
  for (const char* name : {"000", "001", "002", "003", "004"}) {
    const Outcome outcome = Detect("aprilgrid/example/data/" + std::string(name) + ".jpg", Grid(6, 6, 0.3));
    EXPECT_GE(outcome.detection.corners.size(), std::string(name) == "004" ? 88u : 144u) << name;
    EXPECT_LT(outcome.sigma_px, 0.1) << name;
    EXPECT_LT(outcome.cpu_s, kMostCpuS) << name;
  }
}

// Rendered walls of 23 x 7 touching tags numbered from the bottom right, a border of one bit; the last column
// lies outside of 0002.
TEST_F(RealBoardsTest, WallsOfTouchingTags) {
  const std::string folder = "apriltags_tas/apriltags_tas/example_images/";
  const Outcome oblique = Detect(folder + "0001.png", Grid(23, 7, 0.385));
  EXPECT_GE(oblique.detection.corners.size(), 4u * 60u - 4u);
  const Outcome whole = Detect(folder + "0002.png", Grid(23, 7, 0.385));
  EXPECT_EQ(whole.detection.corners.size(), 4u * 154u);
}

TEST_F(RealBoardsTest, EveryChessboardOfOpenCvsPairs) {
  Board board;
  board.type = BoardType::kChessboard;
  board.columns = 9;
  board.rows = 6;
  board.square_size_m = 0.025;
  for (const char* side : {"left", "right"}) {
    for (const char* number :
         {"01", "02", "03", "04", "05", "06", "07", "08", "09", "11", "12", "13", "14"}) {
      const Outcome outcome = Detect("opencv_stereo/" + std::string(side) + number + ".jpg", board);
      EXPECT_EQ(outcome.detection.corners.size(), 54u) << side << number;
    }
  }
}

struct ExpectedTag {
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners_px;  // the house's order and pixels
};

std::vector<ExpectedTag> ReadExpected(const std::string& path) {
  std::ifstream file(path);
  std::vector<ExpectedTag> tags;
  for (std::string line; std::getline(file, line);) {
    ExpectedTag tag;
    auto& c = tag.corners_px;
    // libapriltag's order, centre of the first pixel at (0.5, 0.5).
    if (std::sscanf(line.c_str(), "%d, (%lf %lf), (%lf %lf), (%lf %lf), (%lf %lf)", &tag.id, &c[3].x(),
                    &c[3].y(), &c[2].x(), &c[2].y(), &c[1].x(), &c[1].y(), &c[0].x(), &c[0].y()) != 9)
      continue;
    for (Eigen::Vector2d& corner : c) corner.array() -= 0.5;
    tags.push_back(tag);
  }
  return tags;
}

// AprilRobotics' own test photos: 47 tags of id 0, 12 to 45 px. Their expected corners are those of their own
// later detector, good to some 0.2 px at these sizes (DetectorCornerSigmaPx), as ours are.
TEST_F(RealBoardsTest, AprilRoboticsTestPhotos) {
  double square_px2 = 0;
  int found_tags = 0, expected_tags = 0;
  for (const char* name :
       {"33369213973_9d9bb4cc96_c", "34085369442_304b6bafd9_c", "34139872896_defdb2f8d9_c"}) {
    const std::string path = "apriltag_test/test/data/" + std::string(name);
    DetectTagsOptions options;
    options.enlarge = 3;
    options.min_decision_margin = 0;
    options.min_side_px = 8;
    const std::vector<TagDetection> found = DetectTags(ReadGrey(path + ".jpg", 2.2), options);
    int here = 0;
    const std::vector<ExpectedTag> expected = ReadExpected(folder_ + path + ".txt");
    for (const ExpectedTag& tag : expected) {
      double least_px2 = 8 * 9;  // 3 px a coordinate is no match
      for (const TagDetection& other : found) {
        double px2 = 0;
        for (std::size_t k = 0; k < 4; ++k) px2 += (other.corners_px[k] - tag.corners_px[k]).squaredNorm();
        if (other.id == tag.id) least_px2 = std::min(least_px2, px2);
      }
      if (least_px2 >= 8 * 9) continue;
      ++here;
      square_px2 += least_px2;
    }
    std::printf("%s: %d of %zu expected tags, %zu found\n", name, here, expected.size(), found.size());
    found_tags += here;
    expected_tags += static_cast<int>(expected.size());
  }
  const double rms_px = std::sqrt(square_px2 / (8 * found_tags));
  std::printf("%d of %d, rms %.3f px an axis\n", found_tags, expected_tags, rms_px);
  EXPECT_EQ(found_tags, expected_tags);
  EXPECT_LT(rms_px, 0.45);
}

}  // namespace
}  // namespace luxfit
