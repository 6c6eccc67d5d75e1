// `luxfit report` on the folder of a calibration, as a user runs it: one page with the numbers of
// calibrate.json.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "calib/targets/board.h"
#include "tests/support/apps/program.h"
#include "tests/support/calib/board_views.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr double kBaselineM = 0.1;

std::string CornersOf(const CalibrationInput& input, int camera) {
  std::vector<ImageCorners> images;
  for (const CalibrationImage& image : input.images) {
    if (image.camera == camera) images.push_back({image.name + ".png", image.corners});
  }
  return CornersFile(images, static_cast<int>(input.target.points.size()));
}

std::string CameraToml(const std::string& id, const std::string& corners) {
  return "[[camera]]\nid = '" + id + "'\ncalibration_corners = \"" + corners +
         "\"\nimage_size = [1280, 960]\n"
         "board = { type = \"chessboard\", columns = 12, rows = 9, square_size_m = 0.05 }\n";
}

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

class CalibrationReportTest : public testing::Test {
 protected:
  // A rig of two cameras, one of which is named as nobody should, in out; one camera whose board was never
  // tilted and always on the right, in flat.
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    std::mt19937_64 rng(3);
    support::BoardViewsOptions views;
    views.images = 10;
    Camera camera = support::OpenCv8Camera();
    camera.distortion = {-0.2, 0.06, 1e-3, -5e-4};
    Eigen::Isometry3d second = Eigen::Isometry3d::Identity();
    second.translation().x() = -kBaselineM;
    CalibrationInput rig = support::BoardViews(support::GridTarget(), {camera, camera},
                                               {Eigen::Isometry3d::Identity(), second}, views, rng)
                               .input();
    rig.images[0].corners.clear();
    rig.images[2].corners.front().pixel.x() += 40;
    folder_->Write("cam0.vnl", CornersOf(rig, 0));
    folder_->Write("cam1.vnl", CornersOf(rig, 1));
    folder_->Write("session.toml", "name = \"<script>alert(1)</script>\"\n" + CameraToml("cam0", "cam0.vnl") +
                                       CameraToml("<b>&\"", "cam1.vnl") +
                                       "[calibration]\nlens = \"opencv4\"\n");
    calibrated_ = support::RunProgram("calibrate " + Path("session.toml") + " -o " + Path("out"));
    reported_ = support::RunProgram("report " + Path("out"));
    page_ = folder_->Read("out/report.html");
    artifact_ = json::parse(folder_->Read("out/stages/calibrate.json"));

    views.tilt_deg = 2;
    CalibrationInput flat = support::ViewsOf(camera, views, rng);
    for (CalibrationImage& image : flat.images)
      image.corners.erase(std::remove_if(image.corners.begin(), image.corners.end(),
                                         [](const BoardCorner& corner) { return corner.pixel.x() < 500; }),
                          image.corners.end());
    folder_->Write("flat.vnl", CornersOf(flat, 0));
    folder_->Write("flat.toml", CameraToml("alone", "flat.vnl") + "[calibration]\nlens = \"opencv4\"\n");
    support::RunProgram("calibrate " + Path("flat.toml") + " -o " + Path("flat"));
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::string Path(const std::string& name) { return "'" + folder_->Path(name) + "'"; }

  // Copies a calibration, so that the test can spoil it.
  static void Copy(const std::string& from, const std::string& to) {
    fs::copy(folder_->Path(from), folder_->Path(to), fs::copy_options::recursive);
  }

  static std::string Refusal(const std::string& arguments) {
    const support::ProgramRun run = support::RunProgram("report " + arguments);
    EXPECT_EQ(run.status, 2) << run.output;
    return run.output;
  }

  static std::unique_ptr<TempFolder> folder_;
  static support::ProgramRun calibrated_, reported_;
  static std::string page_;
  static json artifact_;
};
std::unique_ptr<TempFolder> CalibrationReportTest::folder_;
support::ProgramRun CalibrationReportTest::calibrated_, CalibrationReportTest::reported_;
std::string CalibrationReportTest::page_;
json CalibrationReportTest::artifact_;

TEST_F(CalibrationReportTest, IsOnePageThatAsksForNothing) {
  ASSERT_EQ(calibrated_.status, 0) << calibrated_.output;
  ASSERT_EQ(reported_.status, 0) << reported_.output;
  EXPECT_THAT(reported_.output, HasSubstr("Usable: every gate passed; cam0, <b>&\": reprojection error 0."));
  EXPECT_THAT(reported_.output, HasSubstr("out/report.html"));
  EXPECT_EQ(page_.rfind("<!doctype html>", 0), 0U);
  EXPECT_THAT(page_, HasSubstr("content=\"default-src 'none'; style-src 'unsafe-inline'"))
      << "no script runs";
  for (const char* request : {" src=", " href=\"http", "url(http", "@import", "<link", "<iframe", "<script"})
    EXPECT_THAT(page_, Not(HasSubstr(request)));
  EXPECT_LT(page_.size(), 2'000'000U);
  for (const char* part :
       {"answer", "residuals", "coverage", "uncertainty", "rig", "photos", "choices", "provenance"})
    EXPECT_THAT(page_, HasSubstr("<section id=\"" + std::string(part) + "\">"));
  EXPECT_EQ(Count(page_, "<svg"), 2U * 5 + 2)
      << "vectors, histogram, coverage and two maps a camera; two views of the rig";
  EXPECT_EQ(Count(page_, "<svg"), Count(page_, "</svg>"));
}

TEST_F(CalibrationReportTest, ShowsTheNumbersOfTheArtifact) {
  const json& group = artifact_["groups"][0];
  const json& second = group["cameras"][1];
  const auto has = [](const std::string& text) { EXPECT_THAT(page_, HasSubstr(text)); };
  has("chessboard:12x9:0.05");
  has(fmt::format("<div class=\"card-value\">{:.3f}<small> px",
                  group["reprojection_rms_px"]["per_axis"].get<double>()));
  has(fmt::format("<div class=\"card-value\">{:.3f}<small> px", group["held_out_rms_px"].get<double>()));
  has(fmt::format("<div class=\"card-value\">{:.2f}<small> mm", 1000 * second["baseline_m"].get<double>()));
  has(fmt::format("{:.2f} ± {:.2f}", second["fx_px"].get<double>(),
                  second["fx_fy_cx_cy_sigma_px"][0].get<double>()));
  for (const json& image : group["images"])
    has(fmt::format("<th class=\"text\" scope=\"row\">{}</th>", image["file"].get<std::string>()));
  for (const json& choice : artifact_["choices"]) {
    if (choice["what"] == "lens of cam0, <b>&\"") has(choice["because"].get<std::string>());
  }
  for (const auto& [file, hash] : artifact_["inputs"].items()) has(hash.get<std::string>());
  has("<div class=\"card-value\">19<small> of 20</small>");
  has("cam0 to &lt;b&gt;&amp;&quot;: " + fmt::format("{:.1f} mm", 1000 * second["baseline_m"].get<double>()));
  has(fmt::format("points {:.0f} mm away", 1000 * second["uncertainty"]["maps"][1]["range_m"].get<double>()));
}

// The page is handed on, and its readers have other folders.
TEST_F(CalibrationReportTest, ShowsNoFolderOfThisMachine) {
  EXPECT_THAT(page_, Not(HasSubstr(folder_->Path(""))));
  EXPECT_THAT(page_, Not(HasSubstr(fs::path(LUXFIT_PROGRAM).parent_path().string())));
  EXPECT_THAT(page_, HasSubstr("<td>cam0.vnl</td><td><code>"));
  EXPECT_THAT(page_, HasSubstr("<td>luxfit report "));
}

TEST_F(CalibrationReportTest, PrintedSheetsHaveAHeadAndANumber) {
  EXPECT_THAT(page_, HasSubstr("@page { @top-left { content: \"\\3c script\\3e alert"))
      << "no name ends the string or the style";
  EXPECT_THAT(page_, HasSubstr("@bottom-right { content: counter(page) \" / \" counter(pages);"));
}

TEST_F(CalibrationReportTest, NamesWhatWasLeftOutAndWhy) {
  ASSERT_EQ(artifact_["groups"][0]["images_left_out"].size(), 1U);
  EXPECT_EQ(artifact_["groups"][0]["images_left_out"][0]["file"], "cam0_0.png");
  EXPECT_THAT(page_, HasSubstr("left out: no corners in the table"));
  int outliers = 0;
  for (const json& image : artifact_["groups"][0]["images"]) {
    if (image["camera"] == "cam0") outliers += image["outliers"].get<int>();
  }
  EXPECT_GE(outliers, 1) << "one was moved by 40 px";
  EXPECT_THAT(page_, HasSubstr(fmt::format(" corners, {} of them left out.", outliers)));
}

TEST_F(CalibrationReportTest, NoNameIsReadAsHtml) {
  EXPECT_THAT(page_, HasSubstr("<title>&lt;script&gt;alert(1)&lt;/script&gt;"));
  EXPECT_THAT(page_, HasSubstr("&lt;b&gt;&amp;&quot;"));
  EXPECT_THAT(page_, Not(HasSubstr("<b>&")));
}

TEST_F(CalibrationReportTest, SaysWhatIsNotUsableAndWhereCornersLack) {
  const support::ProgramRun run = support::RunProgram("report " + Path("flat"));
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("Not usable as it is: alone: "));
  const std::string page = folder_->Read("flat/report.html");
  EXPECT_THAT(page, HasSubstr("not usable as it is</span>"));
  EXPECT_THAT(page, HasSubstr("Lacks: no corner in the left third of the image; the board was never tilted"));
  EXPECT_THAT(page, HasSubstr("url(#no-corner)"));
  EXPECT_THAT(page, HasSubstr("<b>Remedy: </b>"));
}

TEST_F(CalibrationReportTest, PhotosWithoutABoardGiveAPageThatSaysSo) {
  std::string table = folder_->Read("cam0.vnl");
  folder_->Write("none.vnl", table.substr(0, table.find('\n') + 1) + "a.png - - -\nb.png - - -\n");
  folder_->Write("none.toml", CameraToml("blind", "none.vnl"));
  support::RunProgram("calibrate " + Path("none.toml") + " -o " + Path("none"));
  const support::ProgramRun run = support::RunProgram("report " + Path("none"));
  ASSERT_EQ(run.status, 0) << run.output;
  const std::string page = folder_->Read("none/report.html");
  EXPECT_THAT(page, HasSubstr("Nothing was calibrated"));
  EXPECT_THAT(page, HasSubstr("left out: no corners in the table"));
  EXPECT_THAT(page, Not(HasSubstr("<svg")));
}

TEST_F(CalibrationReportTest, JsonHasTheSameFigures) {
  const support::ProgramRun run = support::RunProgram("report " + Path("out") + " --json 2>/dev/null");
  ASSERT_EQ(run.status, 0) << run.output;
  const json summary = json::parse(run.output);
  EXPECT_EQ(summary["status"], "done");
  EXPECT_EQ(summary["groups"][0]["cameras"][1]["baseline_m"],
            artifact_["groups"][0]["cameras"][1]["baseline_m"]);
  EXPECT_EQ(summary["groups"][0]["images"], 19);
  EXPECT_EQ(summary["groups"][0]["images_left_out"], 1);
  EXPECT_TRUE(fs::exists(summary["report"].get<std::string>()));
}

TEST_F(CalibrationReportTest, WrongInputsNameTheRemedy) {
  folder_->Write("empty/notes.txt", "none");
  EXPECT_THAT(Refusal(Path("empty")),
              HasSubstr("empty/result.json: expected the result of a room, or stages/calibrate.json "
                        "of cameras beside it, got neither; run `luxfit run` or `luxfit calibrate`"));
  EXPECT_THAT(Refusal(Path("out") + " --state all"),
              HasSubstr("--state: expected the result of a room, got the calibration"));
  Copy("out", "bare");
  fs::remove(folder_->Path("bare/corner_residuals.csv"));
  EXPECT_THAT(Refusal(Path("bare")), HasSubstr("corner_residuals.csv"));
  Copy("out", "mixed");
  fs::copy_file(folder_->Path("flat/corner_residuals.csv"), folder_->Path("mixed/corner_residuals.csv"),
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(Refusal(Path("mixed")), HasSubstr("of another calibration; run `luxfit calibrate` again"));
  Copy("out", "older");
  folder_->Replace("older/stages/calibrate.json", "\"target_extent_m\"", "\"else\"");
  EXPECT_THAT(Refusal(Path("older")),
              HasSubstr("expected a whole calibration of this version; run `luxfit calibrate` again"));
  Copy("out", "other");
  folder_->Replace("other/stages/calibrate.json", "luxfit-calibrate-1", "luxfit-fit-1");
  EXPECT_THAT(Refusal(Path("other")), HasSubstr("format: expected \"luxfit-calibrate-1\""));
  Copy("out", "broken");
  folder_->Replace("broken/stages/calibrate.json", "\"R_camera_from_rig\": [", "\"R_camera_from_rig\": [3, ");
  EXPECT_THAT(Refusal(Path("broken")), HasSubstr("expected a whole calibration of this version"));
}

}  // namespace
}  // namespace luxfit
