// `luxfit albedo` on fixtures/office, as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/paths.h"
#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;

json Read(const std::string& path) {
  std::ifstream file(path);
  return json::parse(file);
}

// Photos of an independent renderer; every surface of the office is of one albedo.
TEST(OfficeAlbedo, MaterialsComeOutAndStayWhole) {
  const TempFolder folder;
  const support::ProgramRun run =
      support::RunProgram("albedo '" LUXFIT_FIXTURES "/office/session.toml' -o '" + folder.Path("out") + "'");
  ASSERT_EQ(run.status, 0) << run.output;
  const json result = Read(folder.Path("out/result.json"));
  const json truth = Read(std::string(LUXFIT_FIXTURES) + "/office/truth.json");
  int compared = 0;
  double worst = 0, worst_from_radiosity = 0;
  for (const json& material : result["materials"]) {
    const std::string name = material["name"];
    const json& rgb = truth["materials"][name];
    const double expected =
        0.265 * rgb[0].get<double>() + 0.670 * rgb[1].get<double>() + 0.065 * rgb[2].get<double>();
    const double albedo = material["albedo"], from_radiosity = material["albedo_from_radiosity"];
    std::printf("%-12s %.4f, off by %+.4f; from radiosity %+.4f\n", name.c_str(), expected, albedo - expected,
                from_radiosity - expected);
    worst = std::max(worst, std::abs(albedo - expected));
    worst_from_radiosity = std::max(worst_from_radiosity, std::abs(from_radiosity - expected));
    EXPECT_NEAR(albedo, expected, 0.0044) << name;          // 1.5 times 0.0029, as run_test
    EXPECT_NEAR(from_radiosity, expected, 0.0105) << name;  // 1.5 times 0.0070, the ceiling's
    EXPECT_EQ(material["detail"], "material") << name;
    ++compared;
  }
  EXPECT_EQ(compared, 7);
  std::printf("worst of %d: %.4f, from radiosity %.4f\n", compared, worst, worst_from_radiosity);
  EXPECT_TRUE(std::filesystem::exists(folder.Path("out/albedo.csv")));
  EXPECT_EQ(Read(folder.Path("out/stages/albedo.json"))["materials"].size(), 7U);
}

}  // namespace
}  // namespace luxfit
