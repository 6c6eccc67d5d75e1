// `luxfit fit` on readings that `luxfit simulate` made: the photometric files of what was fitted.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "forward/luminaire/photometry_file.h"
#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kPi = 3.14159265358979323846;

// Two luminaires whose places are known; {0} and {1}: lines of their fluxes, {2}: of the roles.
constexpr char kSession[] = R"(name = "box"

[scene]
mesh = "room.obj"

[scene.albedo]
wall = 0.5

[states]
one = {{ "A/1" = 1.0 }}
two = {{ "lamp B" = 1.0 }}

[[luminaire]]
id = "A/1"
photometry = "lambertian"
shape = "rectangle"
size_m = [0.6, 0.3]
position_m = [1, 1, 1.9]
position_sigma_m = 0
{0}
[[luminaire]]
id = "lamp B"
photometry = "lamp.ies"
position_m = [2, 1, 1.9]
position_sigma_m = 0
{1}
[luxmeter]
readings = "luxmeter.csv"
{2}
)";

class LuminaireFilesOfAFit : public testing::Test {
 protected:
  LuminaireFilesOfAFit() {
    folder_.Write("room.obj",
                  "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nv 0 0 2\nv 3 0 2\nv 3 2 2\nv 0 2 2\n"
                  "usemtl wall\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    folder_.Write(
        "lamp.ies",
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 4 1 1 2 -0.1 -0.1 0\n1 1 9\n0 30 60 90\n0\n90 80 40 0\n");
    std::string places = "id,x_m,y_m,z_m,nx,ny,nz,state,lux\n";
    for (const char* state : {"one", "two"}) {
      for (const char* place : {"P1,2,1,0.01", "P2,1,0.5,0.01", "P3,0.5,1.5,0.01"})
        places += fmt::format("{},0,0,1,{},\n", place, state);
    }
    folder_.Write("luxmeter.csv", places);
    folder_.Write("session.toml", fmt::format(kSession, "flux_lm = 1000", "flux_lm = 400", ""));
    EXPECT_EQ(Run("simulate", "simulated").status, 0);
    ReadingsFromSimulation();
    folder_.Write("session.toml", fmt::format(kSession, "", "", "fit = [\"*\"]"));
  }

  support::ProgramRun Run(const std::string& command, const std::string& out) const {
    return support::RunProgram(command + " '" + folder_.Path("session.toml") + "' -o '" + folder_.Path(out) +
                               "'");
  }

  // The places with what was simulated there.
  void ReadingsFromSimulation() const {
    std::istringstream places(folder_.Read("luxmeter.csv"));
    std::istringstream simulated(folder_.Read("simulated/illuminance.csv"));
    std::string place, row, table;
    std::getline(places, place);
    std::getline(simulated, row);
    table = place + "\n";
    while (std::getline(places, place) && std::getline(simulated, row)) {
      std::string field;
      std::istringstream fields(row);
      for (int i = 0; i < 3; ++i) std::getline(fields, field, ',');
      table += place + field + "\n";
    }
    folder_.Write("luxmeter.csv", table);
  }

  json Result() const { return json::parse(folder_.Read("out/result.json")); }

  TempFolder folder_;
};

TEST_F(LuminaireFilesOfAFit, HoldTheFittedFluxAndAreListed) {
  const support::ProgramRun run = Run("fit", "out");
  ASSERT_EQ(run.status, 0) << run.output;
  const json result = Result();
  ASSERT_EQ(result["luminaires"].size(), 2u);
  EXPECT_EQ(result["luminaires"][0]["files"],
            (json{{"ies", "luminaires/A_1.ies"}, {"ldt", "luminaires/A_1.ldt"}}));
  EXPECT_EQ(result["luminaires"][1]["files"]["ies"], "luminaires/lamp_B.ies");
  const double truth_lm[] = {1000, 400};
  for (size_t k = 0; k < 2; ++k) {
    const json& luminaire = result["luminaires"][k];
    const double flux_lm = luminaire["flux_lm"].get<double>();
    EXPECT_NEAR(flux_lm / truth_lm[k], 1, 0.02);  // simulate and fit choose their own patches
    for (const char* format : {"ies", "ldt"}) {
      const std::string name = luminaire["files"][format].get<std::string>();
      const PhotometryFile file = ReadPhotometry(folder_.Path("out/" + name));
      EXPECT_NEAR(file.luminaire_flux_lm / flux_lm, 1, 1e-4) << name;
      EXPECT_EQ(ToString(file.shape), luminaire["shape"]) << name;
      const double at_60 = IntensityTowards(file.table, {std::sqrt(0.75), 0, -0.5}).cd_per_lm;
      const double at_0 = IntensityTowards(file.table, {0, 0, -1}).cd_per_lm;
      EXPECT_NEAR(at_60 / at_0, k == 0 ? 0.5 : 40.0 / 90, 1e-3) << name;
    }
  }
  const PhotometryFile a = ReadPhotometry(folder_.Path("out/luminaires/A_1.ies"));
  EXPECT_NEAR(IntensityTowards(a.table, {0, 0, -1}).cd_per_lm, 1 / kPi, 1e-3 / kPi);
  EXPECT_EQ(a.size_m, Eigen::Vector2d(0.6, 0.3));
}

// Nothing is known of B and nothing that it lit was read: no file may say what it gives, and none of an
// earlier run may stay.
TEST_F(LuminaireFilesOfAFit, AreOnlyOfWhatIsDetermined) {
  folder_.Write("out/luminaires/lamp_B.ies", "old");
  folder_.Write("out/luminaires/lamp_B.ldt", "old");
  // A's flux is given a rough start: the first guess has none where it cannot tell luminaires apart.
  folder_.Write("session.toml",
                fmt::format(kSession, "flux_lm = 800\nflux_sigma_lm = 5000", "", "fit = [\"*@one\"]"));
  folder_.Replace("session.toml", "position_m = [2, 1, 1.9]\nposition_sigma_m = 0\n", "");
  const support::ProgramRun run = Run("fit", "out");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_NEAR(ReadPhotometry(folder_.Path("out/luminaires/A_1.ies")).luminaire_flux_lm, 1000, 20);
  EXPECT_FALSE(std::filesystem::exists(folder_.Path("out/luminaires/lamp_B.ies")));
  EXPECT_FALSE(std::filesystem::exists(folder_.Path("out/luminaires/lamp_B.ldt")));
  const json result = Result();
  for (const json& luminaire : result["luminaires"])
    EXPECT_EQ(luminaire.contains("files"), luminaire["id"] == "A/1") << luminaire;
}

}  // namespace
}  // namespace luxfit
