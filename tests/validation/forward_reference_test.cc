// `luxfit simulate` on the rooms of fixtures/forward_reference, against an independent renderer.
//
// Limits are those set for the engine: rms 1 % and no point worse than 4 % for each luminaire. The renderer's
// own error is some tenths of a percent (its sampling, and perhaps a limit of its bounces).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/paths.h"
#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

std::vector<std::vector<std::string>> ReadTable(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

class ForwardReference : public testing::TestWithParam<const char*> {};

TEST_P(ForwardReference, AgreesWithTheRenderer) {
  const std::string room = std::string(LUXFIT_FIXTURES) + "/forward_reference/" + GetParam();
  const TempFolder folder;
  const support::ProgramRun run =
      support::RunProgram("simulate '" + room + "/session.toml' -o '" + folder.Path("out") + "'");
  ASSERT_EQ(run.status, 0) << run.output;
  std::map<std::string, double> predicted_lx;  // by id and state, which is named after its only luminaire
  for (const std::vector<std::string>& row : ReadTable(folder.Path("out/illuminance.csv"))) {
    if (row.at(0) != "id") predicted_lx[row.at(0) + "@" + row.at(1)] = std::stod(row.at(2));
  }
  const std::vector<std::vector<std::string>> truth = ReadTable(room + "/expected_lux_per_lamp.csv");
  ASSERT_GT(truth.size(), 1u);
  for (size_t lamp = 1; lamp < truth.size(); ++lamp) {
    double squares = 0, worst = 0;
    const size_t points = truth[0].size() - 1;
    ASSERT_GE(points, 18u);
    for (size_t p = 1; p <= points; ++p) {
      const double percent =
          100 * (predicted_lx.at(truth[0][p] + "@" + truth[lamp][0]) / std::stod(truth[lamp].at(p)) - 1);
      squares += percent * percent;
      if (std::abs(percent) > std::abs(worst)) worst = percent;
    }
    const double rms = std::sqrt(squares / static_cast<double>(points));
    std::printf("%-10s luminaire %s: %zu points, rms %.2f %%, worst %+.2f %%\n", GetParam(),
                truth[lamp][0].c_str(), points, rms, worst);
    EXPECT_LE(rms, 1) << truth[lamp][0];
    EXPECT_LE(std::abs(worst), 4) << truth[lamp][0];
  }
}

INSTANTIATE_TEST_SUITE_P(Rooms, ForwardReference, testing::Values("cube", "partition", "spots"),
                         [](const auto& room) { return std::string(room.param); });

// The other way round: from the renderer's lux to the luminaires, their distributions given as files.
TEST(MeasuredLuminaires, AreFittedFromReadings) {
  const std::string room = std::string(LUXFIT_FIXTURES) + "/forward_reference/spots/";
  const TempFolder folder;
  for (const auto& entry : std::filesystem::directory_iterator(room))
    std::filesystem::copy_file(entry.path(), folder.Path(entry.path().filename().string()));
  const std::vector<std::vector<std::string>> truth = ReadTable(room + "expected_lux_per_lamp.csv");
  std::string readings = "id,x_m,y_m,z_m,nx,ny,nz,state,lux\n";
  for (const std::vector<std::string>& row : ReadTable(room + "luxmeter.csv")) {
    if (row.at(0) == "id") continue;
    const auto column = std::find(truth[0].begin(), truth[0].end(), row.at(0)) - truth[0].begin();
    const size_t lamp = row.at(7) == "A" ? 1 : 2;
    for (size_t i = 0; i < 8; ++i) readings += row.at(i) + ",";
    readings += truth[lamp].at(static_cast<size_t>(column)) + "\n";
  }
  folder.Write("luxmeter.csv", readings);
  folder.Replace("session.toml", "flux_lm = 900\nflux_sigma_lm = 0\n", "");
  folder.Replace("session.toml", "flux_lm = 1500\nflux_sigma_lm = 0\n", "");
  folder.Replace("session.toml", "position_m = [0.5, 0.5, 2.8]\nposition_sigma_m = 0",
                 "position_m = [0.6, 0.4, 2.7]\nposition_sigma_m = 0.3");
  folder.Replace("session.toml", "\"luxmeter.csv\"", "\"luxmeter.csv\"\nfit = [\"*\"]\nclass = \"L\"");
  const support::ProgramRun run =
      support::RunProgram("fit '" + folder.Path("session.toml") + "' -o '" + folder.Path("out") + "'");
  ASSERT_EQ(run.status, 0) << run.output;
  const nlohmann::json luminaires = nlohmann::json::parse(folder.Read("out/result.json"))["luminaires"];
  // The engine's own error is below 0.3 % (above): fluxes to 0.5 %, the place of the tilted spot to 1 cm.
  EXPECT_EQ(luminaires[0]["photometry"], "spot.ies");
  EXPECT_NEAR(luminaires[0]["flux_lm"].get<double>(), 900, 4.5);
  const double at_m[] = {0.5, 0.5, 2.8};
  for (size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(luminaires[0]["position_m"][axis].get<double>(), at_m[axis], 0.01);
  EXPECT_NEAR(luminaires[1]["flux_lm"].get<double>(), 1500, 7.5);
}

}  // namespace
}  // namespace luxfit
