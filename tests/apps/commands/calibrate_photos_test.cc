// `luxfit calibrate` on photos without a session, as a user runs it: rendered photos of a board before two cameras.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "tests/support/apps/program.h"
#include "tests/support/calib/board_render.h"
#include "tests/support/calib/sample_boards.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr int kPhotos = 9, kFewPhotos = 4;
constexpr double kBaselineM = 0.06, kTurnRad = 0.05;

Board ShownBoard() { return support::Chessboard(8, 5, 0.03); }

Camera SmallCamera() {
  Camera camera;
  camera.width_px = 480;
  camera.height_px = 360;
  camera.fx_px = camera.fy_px = 420;
  camera.cx_px = 241.2;
  camera.cy_px = 178.7;
  return camera;
}

// Places that fill the image, tilted all ways.
Eigen::Isometry3d PoseOfPhoto(int photo) {
  const double around = 2.4 * photo;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const double tilt = 0.15 + 0.05 * (photo % 7);
  pose.linear() =
      Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(around), std::sin(around), 0)).toRotationMatrix();
  const Eigen::Vector3d place(0.09 * (photo % 3 - 1), 0.065 * (photo / 3 % 3 - 1), 0.36 + 0.02 * (photo % 4));
  pose.translation() = place - pose.linear() * BoardCorners(ShownBoard()).back() / 2;
  return pose;
}

Eigen::Isometry3d RightFromLeft() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(kTurnRad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  pose.translation().x() = -kBaselineM;
  return pose;
}

class CalibratePhotosTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    std::mt19937_64 rng(1);
    const BoardDrawing drawing = DrawBoard(ShownBoard());
    for (int photo = 0; photo < kPhotos; ++photo) {
      const std::string number = "0" + std::to_string(photo + 1) + ".png";
      WritePhoto("left/left" + number, drawing, PoseOfPhoto(photo), rng);
      WritePhoto("right/right" + number, drawing, RightFromLeft() * PoseOfPhoto(photo), rng);
    }
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static void WritePhoto(const std::string& name, const BoardDrawing& drawing, const Eigen::Isometry3d& pose,
                         std::mt19937_64& rng) {
    static const support::BoardRenderer renderer(SmallCamera());
    support::BoardRenderOptions options;
    options.samples_per_axis = 2;
    options.noise_sigma = 0.005;
    ImagePlane grey = 255 * renderer.Render(pose, drawing, rng, options);
    const cv::Mat plane(static_cast<int>(grey.rows()), static_cast<int>(grey.cols()), CV_32F, grey.data());
    cv::Mat counts;
    plane.convertTo(counts, CV_8U);
    fs::create_directories(fs::path(folder_->Path(name)).parent_path());
    cv::imwrite(folder_->Path(name), counts);
  }

  static std::string Path(const std::string& name) { return "'" + folder_->Path(name) + "'"; }

  static support::ProgramRun Calibrate(const std::string& inputs, const std::string& flags) {
    return support::RunProgram("calibrate " + inputs + " " + flags + " -o " + Path("out"));
  }

  // Copies a few photos of a camera under other names: enough to pair up, too few to calibrate.
  template <typename NameOf>
  static void CopyPhotos(const std::string& camera, NameOf name_of) {
    for (int photo = 1; photo <= kFewPhotos; ++photo) {
      const fs::path to = folder_->Path(name_of(photo));
      fs::create_directories(to.parent_path());
      fs::copy_file(folder_->Path(camera + "/" + camera + "0" + std::to_string(photo) + ".png"), to,
                    fs::copy_options::overwrite_existing);
    }
  }

  static std::unique_ptr<TempFolder> folder_;
};
std::unique_ptr<TempFolder> CalibratePhotosTest::folder_;

constexpr char kRightBoard[] = "--board chessboard:8x5:0.03";

TEST_F(CalibratePhotosTest, TwoFoldersAreARig) {
  const support::ProgramRun run = Calibrate(Path("left") + "/*.png " + Path("right"), kRightBoard);
  EXPECT_LE(run.status, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("photos of left: 9, in left\n"));
  EXPECT_THAT(run.output, HasSubstr("photos of right: 9, in right\n"));
  EXPECT_THAT(run.output,
              HasSubstr("sets of left, right: 9, by numbers, left01.png with right01.png and so on\n"));
  EXPECT_THAT(run.output, HasSubstr("  left to right: baseline 0.0"));
  const json artifact = json::parse(folder_->Read("out/stages/calibrate.json"));
  ASSERT_EQ(artifact["groups"].size(), 1U);
  const json& right = artifact["groups"][0]["cameras"][1];
  EXPECT_NEAR(right["baseline_m"], kBaselineM, 4 * right["baseline_sigma_m"].get<double>());
  EXPECT_NEAR(right["rotation_deg"], kTurnRad * 180 / M_PI, 4 * right["rotation_sigma_deg"].get<double>());
  EXPECT_LT(right["baseline_sigma_m"], 0.001);
  EXPECT_EQ(artifact["inputs"].size(), 18U);
}

TEST_F(CalibratePhotosTest, OneFolderHoldsTwoCamerasWherePrefixesPair) {
  for (const std::string camera : {"left", "right"})
    CopyPhotos(camera, [&](int photo) { return "both/" + camera + "_" + std::to_string(photo) + ".png"; });
  const support::ProgramRun run = Calibrate(Path("both"), kRightBoard);
  EXPECT_THAT(run.output, HasSubstr("photos of left: 4, in both\n"));
  EXPECT_THAT(run.output, HasSubstr("sets of left, right: 4, by numbers"));
}

TEST_F(CalibratePhotosTest, OneFolderIsOneCamera) {
  const support::ProgramRun run = Calibrate(Path("left") + "/left0[1-4].png", kRightBoard);
  EXPECT_THAT(run.output, HasSubstr("photos of left: 4, in left\n"));
  EXPECT_THAT(run.output, Not(HasSubstr("sets of")));
  EXPECT_THAT(run.output, Not(HasSubstr("baseline")));
}

TEST_F(CalibratePhotosTest, EqualNamesPairAndWithoutThemTheOrder) {
  const auto letter = [](int photo) { return std::string(1, static_cast<char>('a' + photo)) + ".png"; };
  CopyPhotos("left", [&](int photo) { return "named/A/" + letter(photo); });
  CopyPhotos("right", [&](int photo) { return "named/B/" + letter(photo); });
  EXPECT_THAT(Calibrate(Path("named"), kRightBoard).output,
              HasSubstr("sets of A, B: 4, by names, b.png with b.png"));
  CopyPhotos("right", [&](int photo) { return "ordered/B/x" + letter(photo); });
  EXPECT_THAT(Calibrate(Path("named/A") + " " + Path("ordered"), kRightBoard).output,
              HasSubstr("sets of A, B: 4, by order, b.png with xb.png"));
}

TEST_F(CalibratePhotosTest, AWrongBoardNamesTheRightOne) {
  const support::ProgramRun run = Calibrate(Path("left"), "--board chessboard:6x4:0.03");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(
      run.output,
      HasSubstr(
          "--board: expected photos of chessboard:6x4:0.03, got a chessboard of 8x5 inner corners in "));
  EXPECT_THAT(run.output, HasSubstr(" of 9 photos that were looked at; write --board chessboard:8x5:0.03\n"));
  folder_->Write(
      "session.toml",
      "[[camera]]\nid = \"cam0\"\ncalibration_images = \"left/left0[1-4].png\"\n"
      "board = { type = \"charuco\", columns = 8, rows = 6, square_size_m = 0.03, marker_size_m = 0.02 }\n");
  const support::ProgramRun session = Calibrate(Path("session.toml"), "");
  EXPECT_EQ(session.status, 2);
  EXPECT_THAT(session.output,
              HasSubstr("session.toml:1: camera[0].board: expected photos of charuco:8x6:0.03"));
  EXPECT_THAT(
      session.output,
      HasSubstr("write board = { type = \"chessboard\", columns = 8, rows = 5, square_size_m = 0.03 }"));
}

// `luxfit doctor` looks at the same photos, in the same words.
TEST_F(CalibratePhotosTest, DoctorLooksForTheBoard) {
  const auto doctor = [&](const std::string& columns) {
    folder_->Write("doctor.toml",
                   "[[camera]]\nid = \"cam0\"\ncalibration_images = \"left/left0[1-4].png\"\n"
                   "board = { type = \"chessboard\", columns = " +
                       columns + ", rows = 5, square_size_m = 0.03 }\n");
    return support::RunProgram("doctor " + Path("doctor.toml"));
  };
  EXPECT_THAT(doctor("8").output,
              HasSubstr("good  cam0: 4 of 4 calibration images show the board, chessboard:8x5:0.03\n"));
  const support::ProgramRun wrong = doctor("7");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.output,
              HasSubstr("note  cam0: 0 of 4 calibration images show the board, chessboard:7x5:0.03\n"));
  EXPECT_THAT(wrong.output,
              HasSubstr("doctor.toml:1: camera[0].board: expected photos of chessboard:7x5:0.03, "
                        "got a chessboard of 8x5 inner corners in "));
  EXPECT_THAT(wrong.output, HasSubstr("write board = { type = \"chessboard\", columns = 8, rows = 5"));
}

// Photos of these markers do not tell which dictionary drew the board.
TEST_F(CalibratePhotosTest, EveryDictionaryThatMayHaveDrawnTheBoardIsNamed) {
  std::mt19937_64 rng(2);
  Board board = ShownBoard();
  board.type = BoardType::kCharuco;
  board.tag_size_m = 0.021;
  board.dictionary = "DICT_5X5_100";
  for (const int photo : {3, 4, 5})
    WritePhoto("fives/" + std::to_string(photo) + ".png", DrawBoard(board), PoseOfPhoto(photo), rng);
  const support::ProgramRun run = Calibrate(Path("fives"), "--board charuco:8x5:0.03");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output,
              HasSubstr("a ChArUco board of 8x5 squares with markers of DICT_5X5_50 (DICT_5X5_100, "
                        "DICT_5X5_250 or DICT_5X5_1000 may have drawn it too) in "));
}

TEST_F(CalibratePhotosTest, LostCornersAreNoReasonForAdviceButAMissingBoardIs) {
  std::mt19937_64 rng(2);
  Board board = ShownBoard();
  board.type = BoardType::kCharuco;
  board.tag_size_m = 0.021;
  Eigen::Isometry3d cut_off = PoseOfPhoto(4);
  cut_off.translation().x() += 0.13;
  Eigen::Isometry3d away = PoseOfPhoto(4);
  away.translation().x() += 2;
  WritePhoto("some/whole.png", DrawBoard(board), PoseOfPhoto(4), rng);
  WritePhoto("some/tilted.png", DrawBoard(board), PoseOfPhoto(3), rng);
  WritePhoto("some/part.png", DrawBoard(board), cut_off, rng);
  WritePhoto("some/wall.png", DrawBoard(board), away, rng);
  const support::ProgramRun run = Calibrate(Path("some"), "--board charuco:8x5:0.03:0.021");
  EXPECT_THAT(run.output, HasSubstr("wall.png: no marker of the board was found"));
  EXPECT_THAT(run.output, Not(HasSubstr("part.png:")));
  const std::string table = folder_->Read("out/corners.vnl");
  int lost = 0;
  for (std::size_t at = table.find("part.png -"); at != std::string::npos;
       at = table.find("part.png -", at + 1))
    ++lost;
  EXPECT_GT(lost, 0) << "of 28 corners";
  EXPECT_LT(lost, 14);
}

TEST_F(CalibratePhotosTest, WrongInputsNameTheRemedy) {
  const auto refusal = [](const std::string& inputs, const std::string& flags) {
    const support::ProgramRun run = Calibrate(inputs, flags);
    EXPECT_EQ(run.status, 2) << inputs << " " << flags;
    return run.output;
  };
  EXPECT_THAT(refusal(Path("left"), ""),
              HasSubstr("--board: expected what the photos show, got none; such as --board chessboard"));
  EXPECT_THAT(refusal(Path("left"), "--board chess"),
              HasSubstr("--board: expected chessboard, charuco or aprilgrid, got \"chess\""));
  EXPECT_THAT(refusal(Path("left/left77.png"), kRightBoard), HasSubstr("expected an existing file"));
  EXPECT_THAT(refusal(Path("left"), kRightBoard + std::string(" --rig number")),
              HasSubstr("did you mean \"numbers\"?"));
  folder_->Write("session.toml", "name = \"s\"\n");
  EXPECT_THAT(refusal(Path("session.toml"), kRightBoard),
              HasSubstr("--board: expected photos, got a session"));
  EXPECT_THAT(refusal(Path("session.toml") + " " + Path("left"), kRightBoard),
              HasSubstr("name the session alone"));
  folder_->Write("empty/notes.txt", "none");
  EXPECT_THAT(refusal(Path("empty"), kRightBoard), HasSubstr("PHOTO: expected photos"));
}

}  // namespace
}  // namespace luxfit
