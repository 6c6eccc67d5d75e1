// Boards and tags in photos that nobody here made. LUXFIT_REAL_DATA names the folder that holds `calibration`
// (its licences do not let it be shipped); without it these tests are skipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "calib/board.h"
#include "calib/image.h"
#include "calib/tags.h"

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
    if (std::getenv("DUMP")) {
      std::ofstream f("/tmp/bd/dump_" + name.substr(name.rfind('/') + 1) + ".csv");
      for (const BoardCorner& corner : outcome.detection.corners)
        f << corner.index << " " << corner.pixel.transpose() << " " << corner.sigma_px << "\n";
    }
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

TEST_F(RealBoardsTest, PhotosOfAKalibrGrid) {
  for (const char* name : {"000", "001", "002", "003", "004"})
    Detect("aprilgrid/example/data/" + std::string(name) + ".jpg", Grid(6, 6, 0.3));
}

TEST_F(RealBoardsTest, WallsOfTouchingTags) {
  Detect("apriltags_tas/apriltags_tas/example_images/0001.png", Grid(23, 7, 0.385));
  Detect("apriltags_tas/apriltags_tas/example_images/0002.png", Grid(23, 7, 0.385));
}

TEST_F(RealBoardsTest, Chessboards) {
  Board board;
  board.type = BoardType::kChessboard;
  board.columns = 9;
  board.rows = 6;
  board.square_size_m = 0.025;
  for (const char* side : {"left", "right"}) {
    for (const char* number : {"01", "02", "03", "04", "05", "06", "07", "08", "09", "11", "12", "13", "14"})
      Detect("opencv_stereo/" + std::string(side) + number + ".jpg", board);
  }
}

}  // namespace
}  // namespace luxfit
