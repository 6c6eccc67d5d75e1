// `luxfit simulate` as a user runs it: what it writes, refuses and warns of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr char kSession[] = R"(name = "box"

[scene]
mesh = "room.obj"

[scene.albedo]
wall = 0.5
floor = [0.6, 0.3, 0.1]

[states]
one = { A = 1.0 }
both = { A = 0.5, B = 1.0 }

[[luminaire]]
id = "A"
photometry = "isotropic"
shape = "point"
position_m = [1, 1, 1.5]
flux_lm = 1000

[[luminaire]]
id = "B"
photometry = "lamp.ies"
position_m = [2, 1, 1.9]

[luxmeter]
readings = "luxmeter.csv"
)";

// A room of 3 x 2 x 2 m; a Lambertian lamp of 100 pi lm as measured, a disc of 0.1 m.
class Simulate : public testing::Test {
 protected:
  Simulate() {
    folder_.Write("session.toml", kSession);
    folder_.Write(
        "room.obj",
        "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nv 0 0 2\nv 3 0 2\nv 3 2 2\nv 0 2 2\n"
        "usemtl floor\nf 1 2 3 4\nusemtl wall\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    std::string angles, candela;
    for (int deg = 0; deg <= 90; ++deg) {
      angles += std::to_string(deg) + " ";
      candela += std::to_string(100 * std::abs(std::cos(deg * 3.14159265358979323846 / 180))) + " ";
    }
    folder_.Write("lamp.ies",
                  "IESNA:LM-63-2002\n[MANUFAC] M\xfcller\nTILT=NONE\n1 -1 1 91 1 1 2 -0.1 -0.1 0\n1 1 9\n" +
                      angles + "\n0\n" + candela + "\n");
    folder_.Write("luxmeter.csv",
                  "id,x_m,y_m,z_m,nx,ny,nz,state,lux\n"
                  "P1,2,1,0.01,0,0,1,one,\nP1,2,1,0.01,0,0,1,both,150\nP2,0.5,0.5,1,1,0,0,both,\n");
  }

  support::ProgramRun Run(const std::string& flags = "") const {
    return support::RunProgram("simulate '" + folder_.Path("session.toml") + "' -o '" + folder_.Path("out") +
                               "' " + flags);
  }

  nlohmann::json Artifact() const { return nlohmann::json::parse(folder_.Read("out/stages/simulate.json")); }

  // Exit status 2, nothing written, and the message.
  std::string Refusal(const std::string& from, const std::string& to) const {
    folder_.Write("session.toml", kSession);
    folder_.Replace("session.toml", from, to);
    const support::ProgramRun run = Run();
    EXPECT_EQ(run.status, 2) << run.output;
    EXPECT_FALSE(std::filesystem::exists(folder_.Path("out"))) << "results of a session that was refused";
    return run.output;
  }

  TempFolder folder_;
};

TEST_F(Simulate, WritesIlluminanceOfEveryReading) {
  const support::ProgramRun run = Run();
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("session box: simulated"), HasSubstr("compared with 1 readings")));
  std::istringstream csv(folder_.Read("out/illuminance.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "id,state,illuminance_lx,direct_lx,indirect_lx");
  std::vector<double> lux, direct;
  for (const char* expected : {"P1,one,", "P1,both,", "P2,both,"}) {
    std::getline(csv, line);
    EXPECT_THAT(line, testing::StartsWith(expected));
    double total = 0, first = 0, rest = 0;
    ASSERT_EQ(std::sscanf(line.c_str() + std::string(expected).size(), "%lf,%lf,%lf", &total, &first, &rest),
              3);
    EXPECT_NEAR(first + rest, total, 1e-3);  // six digits written
    EXPECT_GT(rest, 0);
    lux.push_back(total);
    direct.push_back(first);
  }
  EXPECT_FALSE(std::getline(csv, line));
  // Direct light by hand: A at (1, 1, 1.49) from P1, B 1.89 m above it.
  const double pi = 3.14159265358979323846, r2 = 1 + 1.49 * 1.49;
  const double a = 1000 / (4 * pi) * 1.49 / (r2 * std::sqrt(r2));
  EXPECT_NEAR(direct[0], a, 1e-3 * a);  // quadrature of the disc, 1 degree table
  const double b = 100 / (1.89 * 1.89 + 0.05 * 0.05);
  EXPECT_NEAR(direct[1], 0.5 * a + b, 2e-3 * b);
  EXPECT_GT(lux[1], lux[0] / 2);
}

TEST_F(Simulate, ThreeLengthsGiveTheLightOfTheirMesh) {
  const auto predicted_lx = [&](const std::string& room) {
    folder_.Write("session.toml", kSession);
    folder_.Replace("session.toml", "mesh = \"room.obj\"", room);
    folder_.Replace("session.toml", "wall = 0.5",
                    "ceiling = 0.8\n\"wall 1\" = 0.5\n\"wall 2\" = 0.4\n\"wall 3\" = 0.5\n\"wall 4\" = 0.6");
    const support::ProgramRun run = Run();
    EXPECT_EQ(run.status, 0) << run.output;
    std::vector<double> lx;
    const nlohmann::json artifact = Artifact();
    for (const nlohmann::json& reading : artifact["luxmeter"]) lx.push_back(reading.at("predicted_lx"));
    return lx;
  };
  folder_.Write("room.obj",
                "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nv 0 0 2\nv 3 0 2\nv 3 2 2\nv 0 2 2\n"
                "usemtl floor\nf 1 2 3 4\nusemtl ceiling\nf 8 7 6 5\nusemtl wall 1\nf 5 6 2 1\n"
                "usemtl wall 2\nf 6 7 3 2\nusemtl wall 3\nf 7 8 4 3\nusemtl wall 4\nf 8 5 1 4\n");
  const std::vector<double> by_mesh = predicted_lx("mesh = \"room.obj\""),
                            by_size = predicted_lx("size = [300, 200, 200]\nunit = \"cm\"");
  ASSERT_EQ(by_size.size(), 3U);
  for (size_t i = 0; i < by_size.size(); ++i) EXPECT_NEAR(by_size[i], by_mesh[i], 1e-6);
}

TEST_F(Simulate, ComparesNothingWithPlacesThatNobodyMeasured) {
  folder_.Replace("luxmeter.csv", "both,150", "both,");
  const support::ProgramRun run = Run();
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, testing::Not(HasSubstr("compared with")));
  const nlohmann::json summary = Artifact()["summary"];
  EXPECT_EQ(summary["readings_checked"], 0);
  EXPECT_TRUE(summary["mean_abs_error_lx"].is_null() && summary["max_abs_error_percent"].is_null())
      << summary;
}

TEST_F(Simulate, LeavesAnArtifactThatCanBeUnderstoodAlone) {
  const support::ProgramRun run = Run("--json 2>/dev/null");
  ASSERT_EQ(run.status, 0);
  const nlohmann::json artifact = Artifact();
  EXPECT_EQ(nlohmann::json::parse(run.output), artifact);
  EXPECT_EQ(artifact["format"], "luxfit-simulate-1");
  for (const char* key : {"luxfit_version", "command", "session", "luminaires", "materials", "luxmeter",
                          "summary", "choices", "warnings", "timing_s", "model"})
    EXPECT_TRUE(artifact.contains(key)) << key;
  EXPECT_TRUE(artifact["inputs"].contains(folder_.Path("lamp.ies")));
  EXPECT_EQ(artifact["model"]["channels"], 3);
  // Shape, size and flux of B are its file's.
  const nlohmann::json& b = artifact["luminaires"][1];
  EXPECT_EQ(b["shape"], "disc");
  EXPECT_EQ(b["flux_source"], "file");
  EXPECT_NEAR(b["size_m"][0].get<double>(), 0.1, 1e-12);
  EXPECT_NEAR(b["flux_lm"].get<double>(), 314.16, 0.05);
  EXPECT_TRUE(artifact["warnings"].empty()) << artifact["warnings"];
  for (const auto& choice : artifact["choices"]) EXPECT_FALSE(choice["because"].get<std::string>().empty());
}

TEST_F(Simulate, WarnsOfWhatChangesTheLightOfAPhotometricFileAsDoctorDoes) {
  folder_.Replace("lamp.ies", " 2 -0.1 -0.1 0\n", " 2 -0.1 -0.1 0.05\n");
  const auto doctor = [&] {
    return support::RunProgram("doctor '" + folder_.Path("session.toml") + "'").output;
  };
  const char* const sides = "lamp.ies: the luminous sides of the opening were left out";
  const support::ProgramRun run = Run();
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr(sides));
  EXPECT_EQ(Artifact()["warnings"].at(0)["code"], "photometry_changed");
  EXPECT_THAT(doctor(), HasSubstr(sides));
  folder_.Replace("session.toml", "position_m = [2, 1, 1.9]",
                  "position_m = [2, 1, 1.9]\nshape = \"disc\"\nsize_m = [0.1]");
  EXPECT_THAT(Run().output, Not(HasSubstr(sides)));
  EXPECT_THAT(doctor(), Not(HasSubstr(sides)));
}

TEST_F(Simulate, WhatTheSessionSaysOverridesTheFile) {
  folder_.Replace("session.toml", "position_m = [2, 1, 1.9]",
                  "position_m = [2, 1, 1.9]\nshape = \"point\"\nflux_lm = 7");
  ASSERT_EQ(Run().status, 0);
  const nlohmann::json b = Artifact()["luminaires"][1];
  EXPECT_EQ(b["shape"], "point");
  EXPECT_EQ(b["flux_lm"], 7);
  EXPECT_EQ(b["flux_source"], "session");
}

TEST_F(Simulate, RefusesWhatItWouldHaveToEstimate) {
  EXPECT_THAT(Refusal("position_m = [1, 1, 1.5]\n", ""),
              HasSubstr("session.toml:14: luminaire[0].position_m: expected"));
  EXPECT_THAT(Refusal("\"isotropic\"", "\"auto\""),
              HasSubstr("session.toml:14: luminaire[0].photometry: expected"));
  EXPECT_THAT(Refusal("photometry = \"isotropic\"\n", ""), HasSubstr("luminaire[0].photometry: expected"));
  EXPECT_THAT(Refusal("\"isotropic\"", "\"cosine_power\""),
              HasSubstr("luminaire[0].cosine_exponent: expected"));
  EXPECT_THAT(Refusal("flux_lm = 1000\n", ""), HasSubstr("luminaire[0].flux_lm: expected a flux"));
  EXPECT_THAT(Refusal("shape = \"point\"", "shape = \"disc\""),
              HasSubstr("luminaire[0].size_m: expected the size"));
  EXPECT_THAT(Refusal("B = 1.0", "C = 1.0"), HasSubstr("expected a [[luminaire]] with id = \"C\""));
  EXPECT_THAT(Refusal("wall = 0.5\n", ""),
              AllOf(HasSubstr("session.toml:6: scene.albedo: expected a reflectance for every material"),
                    HasSubstr("got none for \"wall\"")));
  EXPECT_THAT(Refusal("[luxmeter]\nreadings = \"luxmeter.csv\"\n", ""),
              HasSubstr("luxmeter.readings: expected"));
}

TEST_F(Simulate, RefusesReflectancesOfOneAndMore) {
  for (const char* value : {"1", "1.0", "[0.5, 1, 0.5]"})
    EXPECT_THAT(Refusal("wall = 0.5", std::string("wall = ") + value),
                AllOf(HasSubstr("session.toml:7: scene.albedo.wall: expected a reflectance below 1"),
                      HasSubstr("absorbs nothing")));
  EXPECT_THAT(Refusal("wall = 0.5", "wall = 1.2"), HasSubstr("session.toml:7: scene.albedo.wall: expected"));
  EXPECT_THAT(Refusal("wall = 0.5", "wall = -0.1"), HasSubstr("session.toml:7: scene.albedo.wall: expected"));
}

TEST_F(Simulate, RefusesABrokenPhotometricFileWithItsLine) {
  folder_.Replace("lamp.ies", "1 -1 1 91", "1 -1 1 -91");
  const support::ProgramRun run = Run();
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("lamp.ies:4: number of vertical angles: expected a whole number"));
  EXPECT_THAT(Refusal("\"lamp.ies\"", "\"lump.ies\""), HasSubstr("did you mean \"lamp.ies\"?"));
}

// Nothing is predicted there, and doctor says the same words.
TEST_F(Simulate, AReadingOutsideTheRoomIsNamedAndHasNoNumber) {
  const std::string table = folder_.Read("luxmeter.csv");
  folder_.Replace("luxmeter.csv", "P1,2,1,0.01,0,0,1,one", "P1,2,1,-0.05,0,0,1,one");
  const support::ProgramRun run = Run();
  EXPECT_EQ(run.status, 1);
  const std::string words =
      "1 of 2 meter places lie outside the room, inside a solid or on the back of a surface, and "
      "their readings are left out: P1 at (2, 1, -0.05) m, 50 mm behind a surface\n";
  EXPECT_THAT(run.output, HasSubstr("undetermined: " + words));
  EXPECT_THAT(folder_.Read("out/illuminance.csv"), HasSubstr("\nP1,one,,,\nP1,both,"));
  EXPECT_TRUE(Artifact()["luxmeter"][0]["predicted_lx"].is_null());
  EXPECT_EQ(Artifact()["status_because"], nlohmann::json::array({"reading_outside"}));
  const support::ProgramRun doctor = support::RunProgram("doctor '" + folder_.Path("session.toml") + "'");
  EXPECT_EQ(doctor.status, 1);
  EXPECT_THAT(doctor.output, HasSubstr("bad   " + words));
  folder_.Write("luxmeter.csv", table);
  EXPECT_EQ(Run().status, 0);
}

TEST_F(Simulate, APlaceInAnotherUnitOrAxisIsSaid) {
  folder_.Replace("luxmeter.csv", "P2,0.5,0.5,1,1,0,0", "P2,0.5,0.5,100,1,0,0");
  EXPECT_THAT(Run().output, HasSubstr("P2 at (0.5, 0.5, 100) m, its z_m may be in cm"));
  folder_.Replace("luxmeter.csv", "P2,0.5,0.5,100,1,0,0", "P2,500,500,1000,1,0,0");
  EXPECT_THAT(Run().output, HasSubstr("P2 at (500, 500, 1000) m, its place may be in mm"));
  folder_.Replace("luxmeter.csv", "P2,500,500,1000,1,0,0", "P2,0.5,0.5,1,1,0,0");
  folder_.Write(
      "room.obj",
      "v 0 0 0\nv 3 0 0\nv 3 0 -2\nv 0 0 -2\nv 0 2 0\nv 3 2 0\nv 3 2 -2\nv 0 2 -2\n"
      "usemtl floor\nf 1 2 3 4\nusemtl wall\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
  EXPECT_THAT(Run().output, AllOf(HasSubstr("2 of 2 meter places"), HasSubstr("export the mesh with z up")));
}

// LM-63: the lamp's flux depends on its tilt. A flux that is given was measured in place.
TEST_F(Simulate, TiltFactorsApplyByTheAim) {
  ASSERT_EQ(Run().status, 0);
  const double down_lm = Artifact()["luminaires"][1]["flux_lm"];
  folder_.Replace("lamp.ies", "TILT=NONE", "TILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8");
  ASSERT_EQ(Run().status, 0);
  EXPECT_NEAR(Artifact()["luminaires"][1]["flux_lm"].get<double>(), down_lm, 1e-9 * down_lm);
  folder_.Replace("session.toml", "position_m = [2, 1, 1.9]", "position_m = [2, 1, 1.9]\naim = [-1, 0, -1]");
  const support::ProgramRun run = Run();
  EXPECT_NEAR(Artifact()["luminaires"][1]["flux_lm"].get<double>(), 0.9 * down_lm, 1e-9 * down_lm);
  EXPECT_THAT(run.output, HasSubstr("B is aimed 45 degrees off straight down: the TILT factor 0.9"));
  folder_.Replace("session.toml", "aim = [-1, 0, -1]", "aim = [-1, 0, -1]\nflux_lm = 500");
  EXPECT_THAT(Run().output, Not(HasSubstr("TILT")));
  EXPECT_EQ(Artifact()["luminaires"][1]["flux_lm"], 500);
}

TEST_F(Simulate, WarnsOfALuminaireOutsideTheRoom) {
  folder_.Replace("session.toml", "position_m = [2, 1, 1.9]", "position_m = [2, 1, 2.01]");
  const support::ProgramRun run = Run();
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.output, AllOf(HasSubstr("warning: luminaire B at (2, 1, 2.01) m lies inside a solid"),
                                HasSubstr("2 of its 2 readings get no direct light"), HasSubstr("remedy: ")));
  EXPECT_EQ(Artifact()["warnings"][0]["code"], "luminaire_outside");
}

TEST_F(Simulate, WarnsOfALuminaireInsideASolid) {
  // A box round lamp B, seen from outside.
  folder_.Write(
      "room.obj",
      folder_.Read("room.obj") +
          "v 1.8 0.8 1.7\nv 2.2 0.8 1.7\nv 2.2 1.2 1.7\nv 1.8 1.2 1.7\nv 1.8 0.8 1.95\nv 2.2 0.8 1.95\n"
          "v 2.2 1.2 1.95\nv 1.8 1.2 1.95\nf 12 11 10 9\nf 14 15 16 13\nf 10 14 13 9\nf 11 15 14 10\n"
          "f 12 16 15 11\nf 9 13 16 12\n");
  const support::ProgramRun run = Run();
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("warning: luminaire B at (2, 1, 1.9) m lies inside a solid"));
  EXPECT_EQ(Artifact()["warnings"][0]["code"], "luminaire_outside");
}

TEST_F(Simulate, WarnsOfAMaterialThatTheMeshDoesNotHave) {
  folder_.Replace("session.toml", "wall = 0.5", "wall = 0.5\nwalls = 0.5");
  EXPECT_THAT(Run().output, AllOf(HasSubstr("scene.albedo.walls"), HasSubstr("did you mean \"wall\"?")));
}

}  // namespace
}  // namespace luxfit
