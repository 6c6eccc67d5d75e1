// export, luxmap, commission and dim on the office, fitted without its evening photos: an independent
// renderer's photos, readings and truth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "tests/support/apps/office_copy.h"
#include "tests/support/apps/program.h"
#include "tests/support/office_truth.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// One fit for all tests.
class RoomCommands : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    office_ = new support::OfficeCopy;
    office_->KeepPhotos([](const std::string&, const std::string& state) { return state != "evening"; });
    run_ = office_->Run("run");
  }
  static void TearDownTestSuite() {
    delete office_;
    office_ = nullptr;
  }
  void SetUp() override { ASSERT_EQ(run_.status, 0) << run_.output; }

  static support::ProgramRun Command(const std::string& name, const std::string& arguments) {
    return support::RunProgram(name + " " + office_->Out() + " " + arguments);
  }
  static json Artifact(const std::string& name) { return office_->Json("out/" + name); }

  // Without noise, of the state evening.
  static double EveningLux(const std::string& place) {
    const auto rows = support::OfficeTable("truth_lux_per_lamp.csv");
    double lux = 0;
    for (size_t column = 1; column < rows[0].size(); ++column) {
      if (rows[0][column] != place) continue;
      for (size_t row = 1; row < rows.size(); ++row) {
        const double dimming = rows[row][0] == "A" ? 0.3 : (rows[row][0] == "B" ? 0 : 1);
        lux += dimming * std::stod(rows[row][column]);
      }
    }
    return lux;
  }

  static support::OfficeCopy* office_;
  static support::ProgramRun run_;
};
support::OfficeCopy* RoomCommands::office_ = nullptr;
support::ProgramRun RoomCommands::run_;

TEST_F(RoomCommands, APhotoOfAStateThatNobodyFittedIsALuxmeter) {
  const support::ProgramRun run =
      Command("luxmap", support::kOfficeFolder + "photos/v00_evening.png --view v00 --exposure-s 0.206");
  ASSERT_EQ(run.status, 0) << run.output;
  const json photo = Artifact("luxmap/luxmap.json")["photos"][0];
  const double truth[] = {0.3, 0, 1, 1};
  for (size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(photo["luminaires"][k]["dimming"].get<double>(), truth[k], 0.03) << k;
  int seen = 0;
  for (const json& place : photo["places"]) {
    const double lux = EveningLux(place["id"]);
    // The scale hangs on one reading of 1 % noise; stated sigmas are 2 %.
    EXPECT_NEAR(place["predicted_lx"].get<double>(), lux, 0.03 * lux) << place["id"];
    const double sigma_lx = place["predicted_sigma_lx"];
    EXPECT_LT(std::abs(place["predicted_lx"].get<double>() - lux), 3 * sigma_lx);
    std::printf("%s: predicted sigma %.2f %%\n", place["id"].get<std::string>().c_str(),
                100 * sigma_lx / lux);
    EXPECT_LT(sigma_lx, 0.03 * lux) << "1.5 times 2 %";
    if (place["seen_lx"].is_null()) continue;
    ++seen;
    EXPECT_NEAR(place["seen_lx"].get<double>(), lux, 0.02 * lux) << place["id"];
  }
  EXPECT_GE(seen, 4);
  EXPECT_TRUE(std::filesystem::exists(office_->Path("out/luxmap/maps/v00_evening.exr")));
}

// One reading sets the scale; the renderer's own is known.
TEST_F(RoomCommands, ASpotOfAPhotoHasItsLuminanceWithinItsSigma) {
  const support::ProgramRun run = Command("spot", "v00_all:400,300");
  ASSERT_EQ(run.status, 0) << run.output;
  const json spot = Artifact("luminance/spots.json")["spots"][0];
  const double per_cdm2_s = support::OfficeTruth().at("cameras").at("cam0").at("counts_per_cdm2_s");
  const double luminance = spot["luminance_cd_m2"], sigma = spot["sigma_cd_m2"];
  const double z = (luminance - spot["relative_luminance"].get<double>() / per_cdm2_s) / sigma;
  std::printf("spot: %.2f +- %.2f cd/m2, z %.2f by the renderer's scale\n", luminance, sigma, z);
  EXPECT_LT(std::abs(z), 2);
  EXPECT_LT(sigma / luminance, 0.03);
}

TEST_F(RoomCommands, WhatIsNotOnAsItShouldBeIsNamed) {
  const support::ProgramRun run =
      Command("luxmap", support::kOfficeFolder +
                            "photos/v00_evening.png --pose tags --exposure-s 0.206 --state all -o " +
                            office_->Path("tags"));
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("luminaire B is at 0.00"));
  EXPECT_THAT(run.output, Not(HasSubstr("luminaire D is at")));
  EXPECT_EQ(
      Command("luxmap", support::kOfficeFolder + "photos/v00_evening.png --exposure-s 1 --view v77").status,
      2);
}

TEST_F(RoomCommands, APhotoWithoutExposureIsNamedItself) {
  const support::ProgramRun run =
      Command("luxmap", support::kOfficeFolder + "photos/v00_evening.png --view v00");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("v00_evening.png: exposure_s: expected the exposure time of the photo"));
  EXPECT_THAT(run.output, HasSubstr("give --exposure-s"));
}

TEST_F(RoomCommands, TheOneThatDiffersFromTheDesignIsNamed) {
  office_->Write("design.toml", R"([[luminaire]]
id = "A"
photometry = "lambertian"
position_m = [1.5, 2.0, 2.79]
flux_lm = 3600
[[luminaire]]
id = "B"
photometry = "lambertian"
position_m = [4.2, 2.6, 2.79]
flux_lm = 3900
[[luminaire]]
id = "C"
photometry = "cosine_power"
cosine_exponent = 3
position_m = [2.9, 0.7, 2.78]
flux_lm = 1100
[[luminaire]]
id = "D"
photometry = "cosine_power"
cosine_exponent = 3
position_m = [5.2, 1.6, 2.78]
flux_lm = 850
[[point]]
id = "L1"
illuminance_lx = 200
)");
  const support::ProgramRun run = Command("commission", "--design " + office_->Path("design.toml"));
  ASSERT_EQ(run.status, 0) << run.output;
  const json result = Artifact("commission/commission.json");
  for (const json& l : result["comparison"]["luminaires"]) {
    if (l["id"] == "B") {
      EXPECT_EQ(l["faults"], json::array({"dimmed or weak"}));
    } else {
      EXPECT_TRUE(l["faults"].empty()) << l;
    }
  }
  EXPECT_GE(result["levels"]["targets"][0]["assured95_lx"].get<double>(), 200 - 1e-3);
  office_->Replace("design.toml", "illuminance_lx = 200", "illuminance_lx = 2000");
  const support::ProgramRun much = Command("commission", "--design " + office_->Path("design.toml"));
  EXPECT_EQ(much.status, 1);
  EXPECT_THAT(much.output, HasSubstr("E at L1: lacks"));
}

TEST_F(RoomCommands, ADropAtTheEyeIsKept) {
  const support::ProgramRun run = Command("dim", "--person 1.0,1.2,1.2,-1,0,0 --drop-percent 10");
  ASSERT_EQ(run.status, 0) << run.output;
  const json result = Artifact("dim/dim.json");
  EXPECT_LE(result["persons"][0]["drop"].get<double>(), 0.1 + 1e-6);
  EXPECT_LT(result["power_w"].get<double>(), result["power_before_w"].get<double>());
  EXPECT_EQ(Command("dim", "--person 1,2").status, 2);
  EXPECT_EQ(Command("dim", "--person 90,1.2,1.2,-1,0,0").status, 2);
}

TEST_F(RoomCommands, ExportsAreWhatOthersRead) {
  const support::ProgramRun run = Command("export", "--only luminaires,patches,radiance,csv,cameras");
  ASSERT_EQ(run.status, 0) << run.output;
  const Scene room = ReadScene(office_->Path("office/room.obj"));
  const Scene ply = ReadScene(office_->Path("out/export/patches/patches.ply"));
  EXPECT_NEAR((ply.Bounds().sizes() - room.Bounds().sizes()).norm(), 0, 1e-6);
  EXPECT_THAT(office_->Read("out/export/csv/luminaires.csv"), HasSubstr("flux_lm,flux_sigma_lm"));
  EXPECT_THAT(office_->Read("out/export/cameras/colmap/images.txt"), HasSubstr("v00_"));
  EXPECT_EQ(Command("export", "--only nothing").status, 2);
}

// Downlight C has no body that stands in the light, so that both models are of the same room.
TEST_F(RoomCommands, RadianceAgrees) {
  if (std::system("command -v oconv > /dev/null 2>&1 && command -v rtrace > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "Radiance (oconv, rtrace) is not installed";
  ASSERT_EQ(Command("export", "--only radiance").status, 0);
  const std::string scene = office_->Path("out/export/radiance");
  const std::string command = "cd " + scene +
                              " && oconv materials.rad room.rad state_C.rad > scene.oct && rtrace -h -I -ab "
                              "8 -ad 512 -as 128 -aa 0.15 "
                              "-ar 64 -dj 0 -ds 0.1 -w scene.oct < luxmeter.pts > lux.txt";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream rendered(scene + "/lux.txt"), predicted(scene + "/luxmeter_points.csv");
  std::string header, line;
  std::getline(predicted, header);
  while (std::getline(predicted, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; i < 4; ++i) std::getline(cells, cell, ',');
    double red = 0, green = 0, blue = 0;
    ASSERT_TRUE(rendered >> red >> green >> blue);
    const double lux = 179 * (0.265 * red + 0.670 * green + 0.065 * blue);
    EXPECT_NEAR(std::stod(cell), lux, 0.015 * lux) << line;
  }
}

}  // namespace
}  // namespace luxfit
