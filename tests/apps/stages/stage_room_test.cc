// The warnings and errors that a user gets for the mesh of a session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/session/session_scene.h"
#include "apps/stages/check/session_check.h"
#include "apps/stages/stages.h"
#include "forward/mesh/planes.h"
#include "forward/room/patches.h"
#include "tests/paths.h"
#include "tests/support/forward/scan_of.h"
#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A room of 2 x 2 x 2 m that faces inwards; its floor is the first face, its ceiling the last.
constexpr char kVertices[] =
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\nusemtl wall\n";
constexpr char kFloor[] = "f 1 2 3 4\n", kCeiling[] = "f 5 8 7 6\n";
constexpr char kWalls[] = "f 1 4 8 5\nf 2 6 7 3\nf 1 5 6 2\nf 4 3 7 8\n";

SessionScene MeshScene(const std::string& path, double metres_per_unit = 1) {
  SessionScene scene;
  scene.mesh = path;
  scene.metres_per_unit = metres_per_unit;
  return scene;
}

class StageRoomTest : public testing::Test {
 protected:
  std::vector<Warning> WarningsOf(const std::string& faces, double metres_per_unit = 1) {
    folder_.Write("room.obj", kVertices + faces);
    Session session;
    session.path = "session.toml";
    session.scene = MeshScene(folder_.Path("room.obj"), metres_per_unit);
    RunContext context;
    LoadRoom(session, context);
    return context.warnings;
  }

  std::vector<std::string> CodesOf(const std::string& faces) {
    std::vector<std::string> codes;
    for (const Warning& warning : WarningsOf(faces)) codes.push_back(warning.code);
    return codes;
  }

  const TempFolder folder_;
};

const std::string kRoom = std::string(kFloor) + kWalls + kCeiling;

TEST_F(StageRoomTest, ACleanRoomHasNoWarnings) { EXPECT_THAT(CodesOf(kRoom), IsEmpty()); }

TEST_F(StageRoomTest, EachDefectIsWarnedOfOnce) {
  EXPECT_THAT(CodesOf(std::string(kFloor) + kWalls), ElementsAre("open_mesh"));
  EXPECT_THAT(CodesOf(std::string("f 4 3 2 1\n") + kWalls + kCeiling), ElementsAre("flipped_facets"));
  EXPECT_THAT(CodesOf(kRoom + "f 3 4 1 2\n"), ElementsAre("duplicate_facets"));
  EXPECT_THAT(CodesOf(kRoom + "v 1 0.5 0\nv 1.5 0.5 0\nv 1.5 1 0\nusemtl rug\nf 9 10 11\n"),
              ElementsAre("coplanar_overlap"));
  EXPECT_THAT(CodesOf(kRoom + "f 1 2 2\n"), ElementsAre("facets_dropped"));
  EXPECT_THAT(CodesOf("f 4 3 2 1\nf 6 7 8 5\nf 5 8 4 1\nf 3 7 6 2\nf 2 6 5 1\nf 8 7 3 4\n"),
              ElementsAre("inside_out"));
}

TEST_F(StageRoomTest, AReflectanceOfNoMaterialIsNamed) {
  folder_.Write("room.obj", kVertices + kRoom);
  Session session;
  session.path = "session.toml";
  session.scene = MeshScene(folder_.Path("room.obj"));
  session.scene->known_albedo_rgb["wal"] = Eigen::Vector3d::Constant(0.5);
  RunContext context;
  LoadRoom(session, context);
  ASSERT_EQ(context.warnings.size(), 1U);
  EXPECT_EQ(context.warnings[0].code, "unknown_material");
  EXPECT_THAT(context.warnings[0].remedy, HasSubstr("did you mean \"wall\"?"));
}

TEST_F(StageRoomTest, NamesOfAMeshStayOnOneLine) {
  folder_.Write("room.obj",
                std::string(kVertices).replace(std::string(kVertices).find("wall"), 4, "w\033[31m") + kRoom);
  EXPECT_THAT(LoadMesh([&] {
                Session session;
                session.path = "session.toml";
                session.scene = MeshScene(folder_.Path("room.obj"));
                return session;
              }())
                  .scene.materials,
              ElementsAre("w [31m"));
}

TEST_F(StageRoomTest, AWarningTellsWhereHowMuchAndWhatToDo) {
  const Warning open = WarningsOf(std::string(kFloor) + kWalls).at(0);
  EXPECT_THAT(open.message, HasSubstr("4 edges (8 m)"));
  EXPECT_THAT(open.message, HasSubstr("% of the rays"));
  EXPECT_THAT(open.message, HasSubstr("2.000)"));
  EXPECT_THAT(open.remedy, HasSubstr("close the mesh"));
}

TEST_F(StageRoomTest, AMeshInMillimetresReadAsMetresIsRefused) {
  try {
    WarningsOf(kRoom, 1000);
    FAIL() << "expected an error";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("session.toml: scene.unit: expected a room"));
    EXPECT_THAT(error.what(), HasSubstr("2000 m x 2000 m x 2000 m"));
  }
}

// Returns what is said of the office's tags beside that room of theirs; empty where they fit.
std::string ComplaintOf(const std::string& office, const SessionScene& room) {
  Session session = ReadSession(office + "/session.toml");
  session.path = "session.toml";
  session.scene = room;
  return SurveyComplaint(session, SceneOf(*session.scene));
}

TEST_F(StageRoomTest, AMeshWithYUpIsNamed) {
  const std::string office = std::string(LUXFIT_FIXTURES) + "/office";
  std::ifstream mesh(office + "/room.obj");
  std::ostringstream turned;
  for (std::string line; std::getline(mesh, line);) {
    double x = 0, y = 0, z = 0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3) {
      turned << "v " << x << " " << z << " " << -y << "\n";
    } else {
      turned << line << "\n";
    }
  }
  folder_.Write("y_up.obj", turned.str());
  EXPECT_EQ(ComplaintOf(office, MeshScene(office + "/room.obj")), "");
  EXPECT_THAT(ComplaintOf(office, MeshScene(folder_.Path("y_up.obj"))),
              testing::AllOf(
                  HasSubstr("session.toml: scene.unit: expected the surveyed tags to lie on the mesh"),
                  HasSubstr("the tags lie on it where the mesh's y axis is up: export the mesh with z up")));
}

TEST_F(StageRoomTest, ARoomOfOtherLengthsIsNamed) {
  const std::string office = std::string(LUXFIT_FIXTURES) + "/office";
  SessionScene room;
  room.outline = OutlineOfBox({6, 4, 2.8});
  EXPECT_EQ(ComplaintOf(office, room), "");
  room.outline = OutlineOfBox({5, 5, 2.8});
  EXPECT_THAT(ComplaintOf(office, room),
              testing::AllOf(HasSubstr("session.toml: scene.outline: expected the surveyed tags"),
                             HasSubstr("measure the room's lengths again")));
}

// Its area is small, but a triangle is cut as finely across as along: more elements than memory holds.
TEST_F(StageRoomTest, ACornerFarOffIsRefused) {
  try {
    WarningsOf(kRoom + "v 3500 1 1\nf 1 2 9\n");
    FAIL() << "expected an error";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("3500 m x 2 m x 2 m"));
    EXPECT_THAT(error.what(), HasSubstr("a corner lies far off"));
  }
}

// Long triangles are cut as finely across as along; those of one plane are merged, and only then counted.
TEST_F(StageRoomTest, AHallOfStripsIsAHall) {
  constexpr int kStrips = 34;
  constexpr double kLengthM = 20, kDepthM = 12, kHeightM = 4;
  std::ostringstream hall;
  int vertices = 0;
  const auto quad = [&](const std::vector<Eigen::Vector3d>& corners) {
    for (const Eigen::Vector3d& p : corners) hall << "v " << p.x() << " " << p.y() << " " << p.z() << "\n";
    hall << "f " << vertices + 1 << " " << vertices + 2 << " " << vertices + 3 << "\n";
    hall << "f " << vertices + 1 << " " << vertices + 3 << " " << vertices + 4 << "\n";
    vertices += 4;
  };
  for (int i = 0; i < kStrips; ++i) {
    const double x = kLengthM * i / kStrips, to = kLengthM * (i + 1) / kStrips;
    quad({{x, 0, 0}, {to, 0, 0}, {to, kDepthM, 0}, {x, kDepthM, 0}});
    quad({{x, 0, kHeightM}, {x, kDepthM, kHeightM}, {to, kDepthM, kHeightM}, {to, 0, kHeightM}});
    quad({{x, 0, 0}, {x, 0, kHeightM}, {to, 0, kHeightM}, {to, 0, 0}});
    quad({{x, kDepthM, 0}, {to, kDepthM, 0}, {to, kDepthM, kHeightM}, {x, kDepthM, kHeightM}});
  }
  quad({{0, 0, 0}, {0, kDepthM, 0}, {0, kDepthM, kHeightM}, {0, 0, kHeightM}});
  quad({{kLengthM, 0, 0}, {kLengthM, 0, kHeightM}, {kLengthM, kDepthM, kHeightM}, {kLengthM, kDepthM, 0}});
  folder_.Write("room.obj", hall.str());
  Session session;
  session.path = "session.toml";
  session.scene = MeshScene(folder_.Path("room.obj"));
  const LoadedMesh mesh = LoadMesh(session);
  EXPECT_GT(CountPatches(mesh.scene, {}).elements, 1e6);
  const Scene merged = WithTrianglesMerged(mesh.scene);
  EXPECT_EQ(merged.facets.size(), 6U);
  double area_m2 = 0;
  for (const Facet& facet : merged.facets) area_m2 += facet.AreaM2();
  EXPECT_NEAR(area_m2, 2 * (kLengthM * kDepthM + kDepthM * kHeightM + kHeightM * kLengthM), 0.01);
}

// A crowd of triangles in the air, far more than patches of a laptop's form factors: those of one part of space that face
// alike share a plane.
TEST_F(StageRoomTest, ACrowdOfTrianglesBecomesSomePlanes) {
  constexpr int kTriangles = 25000;
  std::ostringstream crowd;
  crowd << kVertices << kRoom;
  for (int i = 0; i < kTriangles; ++i) {
    const int column = i % 170, row = i / 170;
    const double x = 0.1 + 0.01 * column, y = 0.1 + 0.01 * row;
    for (const auto& [at_x, at_y] : {std::pair{x, y}, {x + 0.005, y}, {x, y + 0.005}})
      crowd << "v " << at_x << " " << at_y << " 1\n";
    crowd << "f -3 -2 -1\nf -3 -1 -2\n";
  }
  folder_.Write("room.obj", crowd.str());
  Session session;
  session.path = "session.toml";
  session.scene = SessionScene{};
  session.scene->mesh = folder_.Path("room.obj");
  RunContext context;
  const Room room = LoadRoom(session, context);
  ASSERT_TRUE(room.on_planes);
  EXPECT_EQ(room.on_planes->triangles, 2 * kTriangles + 6);
  EXPECT_LT(room.scene.facets.size(), 100U);
  double up_m2 = 0;
  for (const Element& element : room.patches.elements)
    up_m2 += element.normal.z() > 0.9 && element.center.z() > 0.5 ? element.area_m2 : 0;
  EXPECT_NEAR(up_m2, kTriangles * 12.5e-6, 0.05 * kTriangles * 12.5e-6);
}

// A scan errs by 5 mm: what lies a little behind its floor lies on it, and what is far behind is left to be named.
TEST_F(StageRoomTest, PlacesALittleBehindAScanAreOnIt) {
  std::mt19937_64 rng(3);
  support::ScanOptions scan;
  scan.hole_share = 0;
  support::WriteTriangles(support::ScanOf(support::ClosedRoom({4, 3, 2.5}), scan, rng),
                          folder_.Path("scan.obj"));
  Session session;
  session.path = "session.toml";
  session.scene = SessionScene{};
  session.scene->mesh = folder_.Path("scan.obj");
  session.luxmeter.readings.resize(3);
  const double heights_m[] = {-0.008, 0.3, -0.1};
  for (size_t i = 0; i < 3; ++i) {
    session.luxmeter.readings[i].position_m = {2, 1.5, heights_m[i]};
    session.luxmeter.readings[i].normal = {0, 0, 1};
  }
  RunContext context;
  const Room room = LoadRoom(session, context);
  ASSERT_TRUE(room.on_planes);
  EXPECT_NEAR(room.on_planes->rms_m, 0.0055, 0.001);
  const Session placed = OnSurfaceOf(room, session);
  EXPECT_NEAR(placed.luxmeter.readings[0].position_m.z(), 0, 0.003);
  EXPECT_EQ(FindReadingsOutside(placed, room.rays).warnings.size(), 1U);  // of the third
  EXPECT_EQ(placed.luxmeter.readings[1].position_m.z(), 0.3);
  EXPECT_EQ(placed.luxmeter.readings[2].position_m.z(), -0.1);
}

}  // namespace
}  // namespace luxfit
