// `luxfit board`, as a user runs it: what it draws is found again, at the size that it says.
#include <gmock/gmock.h>

#include <cstdio>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>

#include "apps/session/session.h"
#include "apps/stages/calibrate/board_text.h"
#include "calib/targets/board.h"
#include "calib/targets/tags.h"
#include "tests/support/apps/program.h"
#include "tests/support/calib/board_render.h"
#include "tests/support/temp_folder.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class BoardCommandTest : public testing::Test {
 protected:
  support::ProgramRun Run(const std::string& arguments, const std::string& out) const {
    return support::RunProgram("board " + arguments + " -o '" + folder_.Path(out) + "'");
  }

  // What it says where it ends with status 2.
  std::string Refusal(const std::string& arguments, const std::string& out = "board.pdf") const {
    const support::ProgramRun run = Run(arguments, out);
    EXPECT_EQ(run.status, 2) << arguments << ": " << run.output;
    EXPECT_FALSE(std::filesystem::exists(folder_.Path(out))) << arguments;
    return run.output;
  }

  // The board that a session with this line has.
  Board BoardOf(const std::string& line) const {
    folder_.Write("cam0.yaml", "%YAML:1.0\n");
    folder_.Write("session.toml", "[[camera]]\nid = \"cam0\"\nintrinsics = \"cam0.yaml\"\n" + line);
    return *ReadSession(folder_.Path("session.toml")).cameras.at(0).board;
  }

  // The black rectangles of an SVG file, in metres on the paper; its margin reaches to the paper's rim.
  BoardDrawing ReadSvg(const std::string& name) const {
    std::istringstream text(folder_.Read(name));
    BoardDrawing drawing;
    drawing.min_m.setConstant(std::numeric_limits<double>::infinity());
    drawing.max_m = -drawing.min_m;
    for (std::string line; std::getline(text, line);) {
      double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
      const std::size_t at = line.find('M');
      if (at == std::string::npos ||
          std::sscanf(line.c_str() + at, "M%lf %lfH%lfV%lf", &x0, &y0, &x1, &y1) != 4)
        continue;
      drawing.black.push_back({1e-3 * Eigen::Vector2d(x0, y0), 1e-3 * Eigen::Vector2d(x1, y1)});
      drawing.min_m = drawing.min_m.cwiseMin(drawing.black.back().min_m);
      drawing.max_m = drawing.max_m.cwiseMax(drawing.black.back().max_m);
    }
    drawing.margin_m = 0.005;
    return drawing;
  }

  // The paper seen from straight in front, 2 px a millimetre: pixel = 2000 (place - first) + 0.
  static constexpr double kPxPerM = 2000;
  ImagePlane Photo(const BoardDrawing& drawing) const {
    const Eigen::Vector2d size_px = kPxPerM * (drawing.max_m - drawing.min_m).array() + 60;
    Camera camera;
    camera.width_px = static_cast<int>(size_px.x());
    camera.height_px = static_cast<int>(size_px.y());
    camera.fx_px = camera.fy_px = kPxPerM;
    camera.cx_px = camera.cy_px = 0;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << -(drawing.min_m.array() - 30 / kPxPerM), 1;
    std::mt19937_64 rng = support::TestRng();
    return support::BoardRenderer(camera).Render(pose, drawing, rng);
  }

  TempFolder folder_;
};

TEST_F(BoardCommandTest, WhatItDrawsIsDetectedAtTheSizeThatItSays) {
  for (const char* arguments :
       {"aprilgrid", "aprilgrid --corner-squares --border-bits 2 --columns 6 --rows 6",
        "aprilgrid --paper letter --family tag25h9 --first-id 0 --columns 3 --rows 4",
        "chessboard --paper 200x150", "charuco --paper A5"}) {
    const support::ProgramRun run = Run(arguments, "board.svg");
    ASSERT_EQ(run.status, 0) << arguments << run.output;
    const Board board = BoardOf(run.output);
    const BoardDetection detection = DetectBoard(Photo(ReadSvg("board.svg")), board);
    const std::vector<Eigen::Vector3d> corners = BoardCorners(board);
    ASSERT_EQ(detection.corners.size(), corners.size()) << arguments << " " << detection.message;
    const Eigen::Vector2d first = detection.corners.front().pixel;
    for (const BoardCorner& corner : detection.corners) {
      const Eigen::Vector2d place_px = kPxPerM * corners[static_cast<std::size_t>(corner.index)].head<2>();
      EXPECT_LT((corner.pixel - first - place_px).norm(), 0.3) << arguments << " " << corner.index;
    }
  }
}

TEST_F(BoardCommandTest, ItsCharucoIsThatOfCalibrateWithoutADictionary) {
  const support::ProgramRun run = Run("charuco --columns 8 --rows 6", "board.svg");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_EQ(BoardOf(run.output).dictionary, BoardFromArgument("charuco:8x6:0.02").dictionary);
  EXPECT_THAT(Refusal("charuco --columns 12 --rows 9"),
              HasSubstr("the board has 54 tags, DICT_4X4_50 50; DICT_4X4_100 has enough"));
}

TEST_F(BoardCommandTest, LibapriltagSeesGridsWithoutCornerSquaresAndRoomTags) {
  ASSERT_EQ(Run("aprilgrid --first-id 20", "board.svg").status, 0);
  const std::vector<TagDetection> tags = DetectTags(Photo(ReadSvg("board.svg")));
  ASSERT_EQ(tags.size(), 35u);
  EXPECT_EQ(tags.front().id, 20);
  EXPECT_GT(tags[5].corners_px[0].x(), 0);
  EXPECT_LT(tags[5].corners_px[0].y(), tags[0].corners_px[0].y()) << "ids go up from the bottom left";
  for (const TagDetection& tag : tags) EXPECT_LT(tag.corners_px[0].x(), tag.corners_px[1].x()) << "upright";

  const support::ProgramRun run = Run("tags --ids 7,30-33 --tag-size 0.06", "tags.svg");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("[tags]\nfamily = \"tag36h11\""), HasSubstr("\"size_m\": 0.06")));
  std::set<int> ids;
  for (const TagDetection& tag : DetectTags(Photo(ReadSvg("tags.svg")))) {
    ids.insert(tag.id);
    // The detector sees the photo with a display curve, which moves every edge by up to 0.5 px.
    EXPECT_NEAR(tag.side_px, 0.06 * kPxPerM, 1.1);
    EXPECT_LT(tag.corners_px[0].y(), tag.corners_px[3].y()) << "its top up, as the arrow says";
  }
  EXPECT_EQ(ids, (std::set<int>{7, 30, 31, 32, 33}));
  EXPECT_THAT(folder_.Read("tags.svg"), AllOf(HasSubstr(">id 31<"), HasSubstr("width=\"210mm\""),
                                              HasSubstr("60 mm"), HasSubstr("100 mm: measure it")));
}

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST_F(BoardCommandTest, PdfPagesHaveTheSizeOfThePaper) {
  ASSERT_EQ(Run("tags --ids 0-2 --paper A3", "tags.pdf").status, 0);
  const std::string pdf = folder_.Read("tags.pdf");
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_EQ(Count(pdf, "MediaBox"), 3);  // A3 is 841.89 x 1190.55 points
  EXPECT_EQ(Count(pdf, "841.889771 1190.551147") + Count(pdf, "841.8898 1190.551") +
                Count(pdf, "841.889764 1190.551181"),
            3)
      << pdf.substr(pdf.find("MediaBox"), 60);
}

TEST_F(BoardCommandTest, BadInputIsRefusedWithTheWayOut) {
  EXPECT_THAT(
      Refusal("aprilgrid --tag-size 0.1"),
      AllOf(HasSubstr("--paper: expected at least 658 x 930 mm for this board, got A4 (210 x 297 mm)"),
            HasSubstr("it fits on A0 (841 x 1189 mm), or make it smaller")));
  EXPECT_THAT(Refusal("aprilgrid --tag-size 0.7"), HasSubstr("give --paper 4527x6359"));
  EXPECT_THAT(Refusal("aprilgrid --columns 40 --rows 40"),
              HasSubstr("the board has 1600 tags, tag36h11 587"));
  EXPECT_THAT(Refusal("aprilgrid --family tag36"), HasSubstr("--family: expected tag36h11, "));
  EXPECT_THAT(Refusal("aprilgrid --spacing 0.05"), HasSubstr("--spacing: expected at least 0.125"));
  EXPECT_THAT(Refusal("aprilgrid --border-bits 3"), HasSubstr("border-bits"));
  EXPECT_THAT(Refusal("aprilgrid --tag-size nan"), HasSubstr("tag-size"));
  EXPECT_THAT(Refusal("chessboard --columns 2"), HasSubstr("--columns: expected at least 3 inner corners"));
  EXPECT_THAT(Refusal("charuco --square-size 0.02 --marker-size 0.03"),
              HasSubstr("--marker-size: expected a marker smaller than its square, got 0.03"));
  EXPECT_THAT(Refusal("tags --ids 5-x"), HasSubstr("--ids: expected ids and ranges such as 0-11,20"));
  EXPECT_THAT(Refusal("tags --ids ''"), HasSubstr("--ids: expected ids"));
  EXPECT_THAT(Refusal("tags --ids 9-3"), HasSubstr("--ids: expected ids"));
  EXPECT_THAT(Refusal("tags --ids 600"), HasSubstr("--ids: expected 0 to 586 of tag36h11, got 600"));
  EXPECT_THAT(Refusal("tags --ids 0-99 --tag-size 0.05", "tags.svg"),
              HasSubstr("--out: expected a .pdf for 12 pages"));
  EXPECT_THAT(Refusal("aprilgird"), HasSubstr("did you mean \"aprilgrid\"?"));
  EXPECT_THAT(Refusal("aprilgrid", "board.png"),
              HasSubstr("--out: expected a file name ending in .svg or .pdf"));
  EXPECT_THAT(Refusal("aprilgrid --paper B4"), HasSubstr("--paper: expected A5, A4, "));
  EXPECT_THAT(Refusal("aprilgrid --paper 20x20"), HasSubstr("--paper: expected room"));
}

}  // namespace
}  // namespace luxfit
