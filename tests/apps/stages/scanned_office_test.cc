// `luxfit run` on the photos of fixtures/office with a scan in place of its mesh, as a user runs it, against the truth.
//
// The scan: triangles of 9 cm, bumps of 5 mm, jitter of 2 mm, 3 % holes, no materials. Limits are 1.5 times what was
// measured (docs/accuracy.md).
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "forward/room/scene.h"
#include "tests/paths.h"
#include "tests/support/apps/program.h"
#include "tests/support/forward/scan_of.h"
#include "tests/support/temp_folder.h"
#include "tests/support/truth_comparison.h"

namespace luxfit {
namespace {

using nlohmann::json;

TEST(ScannedOffice, LuminairesAreFound) {
  const std::string fixture = std::string(LUXFIT_FIXTURES) + "/office";
  const TempFolder folder;
  std::filesystem::copy(fixture, folder.Path("office"), std::filesystem::copy_options::recursive);
  std::mt19937_64 rng(1);
  support::WriteTriangles(support::ScanOf(ReadScene(fixture + "/room.obj"), {}, rng),
                          folder.Path("office/scan.obj"));
  folder.Replace("office/session.toml", "room.obj", "scan.obj");
  const support::ProgramRun run = support::RunProgram("run " + folder.Path("office/session.toml") +
                                                      " --budget 900 -o " + folder.Path("out"));
  ASSERT_EQ(run.status, 0) << run.output;
  const json result = json::parse(folder.Read("out/result.json"));
  EXPECT_EQ(result["status"], "done");
  // The scan's surfaces have names of their own: only luminaires and readings are compared.
  json truth = json::parse(std::ifstream(fixture + "/truth.json"));
  truth["materials"].clear();
  const TruthComparison errors = CompareWithTruth(result, truth);
  const double readings_percent = result["summary"]["mean_abs_error_percent"];
  std::printf("worst position %.2f mm, worst flux %.2f %%, readings %.2f %%\n", errors.worst_position_mm,
              errors.worst_flux_percent, readings_percent);
  EXPECT_EQ(errors.luminaires_missing, 0);
  EXPECT_LT(errors.worst_position_mm, 9.9);   // 6.6 mm
  EXPECT_LT(errors.worst_flux_percent, 1.3);  // 0.85 %
  EXPECT_LT(readings_percent, 1.5);           // 1.01 %
}

}  // namespace
}  // namespace luxfit
