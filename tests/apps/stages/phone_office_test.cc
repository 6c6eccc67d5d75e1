// `luxfit run` on the office's photos as a phone saves them, 8-bit JPEG with the curve of sRGB, one exposure each: what a
// user without RAW and brackets gets. Limits are 1.5 times what was measured (docs/accuracy.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/paths.h"
#include "tests/support/apps/phone_photos.h"
#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"
#include "tests/support/truth_comparison.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct PhoneRun {
  std::vector<std::string> codes;
  TruthComparison errors;
  double readings_percent = 0;
};

// Returns how the program ends with the office's photos as `shot` has them, its photo aside.
support::ProgramRun RunPhone(const TempFolder& folder, support::PhoneShot shot) {
  const fs::path fixture = fs::path(LUXFIT_FIXTURES) / "office";
  fs::create_directories(folder.Path("office"));
  for (const char* name : {"cam0.yaml", "tags.json", "room.obj", "luxmeter.csv", "session.toml"})
    fs::copy_file(fixture / name, folder.Path(std::string("office/") + name));
  std::string table = "file,camera,view,state,exposure_s\n";
  for (const support::OfficePhoto& photo : support::OfficePhotos()) {
    const std::string file = "photos/" + fs::path(photo.png).stem().string() + ".jpg";
    shot.of = photo;
    support::WritePhoneShot(folder.Path("office/" + file), shot);
    table += file + ",cam0," + photo.view + "," + photo.state + ",\n";
  }
  folder.Write("office/photos.csv", table);
  folder.Replace("office/session.toml", "response = \"linear\"", "response = \"srgb\"");
  return support::RunProgram("run " + folder.Path("office/session.toml") + " --budget 900 -o " +
                             folder.Path("out"));
}

std::vector<std::string> CodesOf(const json& result) {
  std::vector<std::string> codes;
  for (const json& warning : result["warnings"]) codes.push_back(warning["code"]);
  return codes;
}

// Runs the office of JPEGs whose light was raised to that power before the curve of sRGB.
PhoneRun RunPhoneOffice(double bend) {
  const TempFolder folder;
  support::PhoneShot shot;
  shot.bend = bend;
  const support::ProgramRun run = RunPhone(folder, shot);
  EXPECT_EQ(run.status, 0) << run.output;
  const json result = json::parse(folder.Read("out/result.json"));
  PhoneRun phone;
  phone.codes = CodesOf(result);
  phone.errors = CompareWithTruth(
      result, json::parse(std::ifstream(std::string(LUXFIT_FIXTURES) + "/office/truth.json")));
  phone.readings_percent = result["summary"]["mean_abs_error_percent"];
  std::printf("worst position %.2f mm, worst flux %.2f %%, readings %.2f %%\n",
              phone.errors.worst_position_mm, phone.errors.worst_flux_percent, phone.readings_percent);
  EXPECT_EQ(phone.errors.luminaires_missing, 0);
  EXPECT_THAT(phone.codes, testing::Contains("response_assumed"));
  return phone;
}

TEST(PhoneOffice, JpegsWithTheCurveOfSrgbAreEnough) {
  const PhoneRun phone = RunPhoneOffice(1);
  EXPECT_LT(phone.errors.worst_position_mm, 3.8);   // 2.51 mm
  EXPECT_LT(phone.errors.worst_flux_percent, 1.6);  // 1.04 %
  EXPECT_LT(phone.readings_percent, 1.5);           // 0.99 %
}

TEST(PhoneOffice, ABentCurveIsFoundAndCorrected) {
  const PhoneRun phone = RunPhoneOffice(1.1);
  EXPECT_THAT(phone.codes, testing::Contains("response_not_linear"));
  EXPECT_LT(phone.errors.worst_position_mm, 6.5);  // 4.33 mm
  EXPECT_LT(phone.errors.worst_flux_percent, 2);   // 1.29 %
  EXPECT_LT(phone.readings_percent, 1.6);          // 1.05 %
}

// Fluxes are then up to 20 % off. Exposures and states are right, and not blamed.
TEST(PhoneOffice, LocalToneMappingIsNamedAndNothingElseIsBlamed) {
  const TempFolder folder;
  support::PhoneShot shot;
  shot.maps_tones = true;
  const support::ProgramRun run = RunPhone(folder, shot);
  EXPECT_EQ(run.status, 1) << run.output;
  const json result = json::parse(folder.Read("out/result.json"));
  EXPECT_EQ(result["status"], "undetermined");
  const std::vector<std::string> codes = CodesOf(result);
  ASSERT_FALSE(codes.empty());
  EXPECT_EQ(codes.front(), "local_tone_mapping");
  for (const char* code : {"exposure_metadata", "states_as_if", "photos_as_if"})
    EXPECT_THAT(codes, testing::Not(testing::Contains(code)));
}

}  // namespace
}  // namespace luxfit
