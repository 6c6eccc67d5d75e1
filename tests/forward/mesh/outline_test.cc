#include "forward/mesh/outline.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "forward/mesh/mesh_check.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kRounding = 1e-9;

std::map<std::string, double> Areas(const Scene& scene) {
  std::map<std::string, double> area_m2;
  for (const Facet& facet : scene.facets)
    area_m2[scene.materials[static_cast<size_t>(facet.material)]] += facet.AreaM2();
  return area_m2;
}

size_t Count(const Scene& scene, FacetKind kind) {
  return static_cast<size_t>(std::count_if(scene.facets.begin(), scene.facets.end(),
                                           [&](const Facet& f) { return f.kind == kind; }));
}

// Closed, not inside out, nothing drawn twice. T-junctions, which split walls have, change nothing.
void ExpectSound(const Scene& scene) {
  for (const MeshFinding& finding : CheckMesh(scene)) {
    EXPECT_TRUE(finding.defect == MeshDefect::kTJunctions || finding.defect == MeshDefect::kNonManifoldEdges)
        << ToString(finding.defect) << ": " << finding.message;
  }
}

RoomOutline OutlinedRoom(std::vector<Eigen::Vector2d> corners, std::vector<double> heights) {
  return {std::move(corners), std::move(heights), {}, {}};
}

const std::vector<Eigen::Vector2d> kL = {{0, 0}, {7.2, 0}, {7.2, 3}, {4, 3}, {4, 5}, {0, 5}};  // 29.6 m2

TEST(Outline, ABoxIsTheRoomOfItsLengths) {
  const Scene scene = SceneFrom(OutlineOfBox({6, 4, 2.8}));
  EXPECT_EQ(scene.facets.size(), 6U);
  EXPECT_EQ(Count(scene, FacetKind::kParallelogram), 6U);
  EXPECT_THAT(scene.materials, ElementsAre("floor", "ceiling", "wall 1", "wall 2", "wall 3", "wall 4"));
  EXPECT_NEAR(scene.VolumeM3(), 67.2, kRounding);
  const std::map<std::string, double> area = Areas(scene);
  EXPECT_NEAR(area.at("floor"), 24, kRounding);
  EXPECT_NEAR(area.at("ceiling"), 24, kRounding);
  EXPECT_NEAR(area.at("wall 1"), 16.8, kRounding);
  EXPECT_NEAR(area.at("wall 2"), 11.2, kRounding);
  ExpectSound(scene);
  for (const Facet& facet : scene.facets)
    EXPECT_GT(facet.Normal().dot(Eigen::Vector3d(3, 2, 1.4) - facet.PointAt(0.5, 0.5)), 0);
  const Facet& first = scene.facets[1 + 1];  // after floor and ceiling
  EXPECT_NEAR(first.PointAt(0.5, 0.5).y(), 0, kRounding) << "wall 1 runs along x";
}

TEST(Outline, AConcaveRoomIsCutIntoRectangles) {
  for (const bool is_clockwise : {false, true}) {
    std::vector<Eigen::Vector2d> corners = kL;
    if (is_clockwise) std::reverse(corners.begin(), corners.end());
    const Scene scene = SceneFrom(OutlinedRoom(corners, {2.5}));
    EXPECT_EQ(scene.facets.size(), 2U + 2U + 6U);
    EXPECT_EQ(Count(scene, FacetKind::kTriangle), 0U);
    EXPECT_NEAR(scene.VolumeM3(), 29.6 * 2.5, kRounding);
    EXPECT_NEAR(Areas(scene).at("floor"), 29.6, kRounding);
    EXPECT_NEAR(Areas(scene).at("ceiling"), 29.6, kRounding);
    ExpectSound(scene);
  }
}

TEST(Outline, RoomsAreTurnedAndSkewed) {
  std::mt19937_64 rng = support::TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    const double turn = std::uniform_real_distribution<>(-3, 3)(rng);
    const double shear = trial % 2 == 0 ? 0 : std::uniform_real_distribution<>(0.2, 0.5)(rng);
    Eigen::Matrix2d map;
    map << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
    map = map * (Eigen::Matrix2d() << 1, shear, 0, 1).finished();
    std::vector<Eigen::Vector2d> corners;
    for (const Eigen::Vector2d& p : kL) corners.emplace_back(map * p + Eigen::Vector2d(-3, 8));
    const Scene scene = SceneFrom(OutlinedRoom(corners, {2.5}));
    EXPECT_NEAR(scene.VolumeM3(), 29.6 * 2.5, 1e-6);
    if (shear == 0) {
      EXPECT_EQ(Count(scene, FacetKind::kTriangle), 0U);
    } else {
      EXPECT_EQ(Count(scene, FacetKind::kTriangle), 8U) << "floor and ceiling of six corners";
    }
    ExpectSound(scene);
  }
}

TEST(Outline, ASlopedCeilingIsAPlane) {
  const Scene scene = SceneFrom(OutlinedRoom({{0, 0}, {6, 0}, {6, 4}, {0, 4}}, {2, 3.5, 3.5, 2}));
  EXPECT_NEAR(scene.VolumeM3(), 6 * 4 * 2.75, kRounding);
  EXPECT_NEAR(Areas(scene).at("ceiling"), 4 * std::hypot(6, 1.5), kRounding);
  EXPECT_NEAR(Areas(scene).at("wall 1"), 6 * 2.75, kRounding);
  EXPECT_NEAR(Areas(scene).at("wall 2"), 4 * 3.5, kRounding);
  EXPECT_EQ(Count(scene, FacetKind::kTriangle), 2U) << "above walls 1 and 3";
  ExpectSound(scene);
}

TEST(Outline, TwoGablesMakeARidge) {
  const Scene scene =
      SceneFrom(OutlinedRoom({{0, 0}, {3, 0}, {6, 0}, {6, 4}, {3, 4}, {0, 4}}, {2.4, 4, 2.4, 2.4, 4, 2.4}));
  EXPECT_NEAR(scene.VolumeM3(), 6 * 4 * 3.2, kRounding);
  EXPECT_NEAR(Areas(scene).at("ceiling"), 2 * 4 * std::hypot(3, 1.6), kRounding);
  ExpectSound(scene);
  const Scene valley =
      SceneFrom(OutlinedRoom({{0, 0}, {3, 0}, {6, 0}, {6, 4}, {3, 4}, {0, 4}}, {4, 2.4, 4, 4, 2.4, 4}));
  EXPECT_NEAR(valley.VolumeM3(), 6 * 4 * 3.2, kRounding);
}

TEST(Outline, HeightsInNoPlaneStillClose) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<> height(2, 4);
  for (int trial = 0; trial < 20; ++trial) {
    RoomOutline room = OutlinedRoom(kL, {});
    for (size_t i = 0; i < kL.size(); ++i) room.heights_m.push_back(height(rng));
    const Scene scene = SceneFrom(room);
    EXPECT_GT(scene.VolumeM3(), 2 * 29.6);
    EXPECT_LT(scene.VolumeM3(), 4 * 29.6);
    ExpectSound(scene);
  }
}

TEST(Outline, RectanglesAreCutOutOfTheirWall) {
  RoomOutline room = OutlineOfBox({6, 4, 2.8});
  room.rectangles = {{"door", 0, 1, 2, 0, 2.1}, {"window", 0, 3, 5.5, 0.9, 2.2}, {"glass", 1, 0, 4, 0, 2.8}};
  const Scene scene = SceneFrom(room);
  const std::map<std::string, double> area = Areas(scene);
  EXPECT_NEAR(area.at("door"), 2.1, kRounding);
  EXPECT_NEAR(area.at("window"), 2.5 * 1.3, kRounding);
  EXPECT_NEAR(area.at("wall 1"), 16.8 - 2.1 - 3.25, kRounding);
  EXPECT_NEAR(area.at("glass"), 11.2, kRounding);
  EXPECT_EQ(area.count("wall 2"), 0U) << "all of it is glass";
  EXPECT_EQ(Count(scene, FacetKind::kTriangle), 0U);
  EXPECT_NEAR(scene.VolumeM3(), 67.2, kRounding);
  ExpectSound(scene);
  for (const Facet& facet : scene.facets) {
    if (scene.materials[static_cast<size_t>(facet.material)] != "door") continue;
    EXPECT_NEAR((facet.PointAt(0.5, 0.5) - Eigen::Vector3d(1.5, 0, 1.05)).norm(), 0, kRounding);
    EXPECT_GT(facet.Normal().y(), 0.99);
  }
}

TEST(Outline, WallsOfAClockwiseOutlineCountAsTheyAreGiven) {
  RoomOutline room = OutlinedRoom({{0, 0}, {0, 4}, {6, 4}, {6, 0}}, {2.8});
  room.rectangles = {{"door", 0, 0.5, 1.5, 0, 2}};
  const Scene scene = SceneFrom(room);
  ExpectSound(scene);
  for (const Facet& facet : scene.facets) {
    if (scene.materials[static_cast<size_t>(facet.material)] != "door") continue;
    EXPECT_NEAR((facet.PointAt(0.5, 0.5) - Eigen::Vector3d(0, 1, 1)).norm(), 0, kRounding);
    EXPECT_GT(facet.Normal().x(), 0.99);
  }
}

TEST(Outline, ARectangleUnderASlopeIsCutOutToo) {
  RoomOutline room = OutlinedRoom({{0, 0}, {6, 0}, {6, 4}, {0, 4}}, {2, 3.5, 3.5, 2});
  room.rectangles = {{"window", 0, 4, 5, 1, 2.9}};
  const Scene scene = SceneFrom(room);
  EXPECT_NEAR(Areas(scene).at("wall 1"), 6 * 2.75 - 1.9, kRounding);
  EXPECT_NEAR(scene.VolumeM3(), 6 * 4 * 2.75, kRounding);
  ExpectSound(scene);
}

TEST(Outline, BoxesTakeAirAndFaceOutwards) {
  RoomOutline room = OutlineOfBox({6, 4, 2.8});
  room.boxes = {{"cabinet", {0, 3.5, 0}, {1, 4, 2}, 0}, {"table", {2, 1, 0.7}, {3.6, 1.8, 0.74}, 0.5}};
  const Scene scene = SceneFrom(room);
  EXPECT_NEAR(scene.VolumeM3(), 67.2 - 1 - 1.6 * 0.8 * 0.04, kRounding);
  EXPECT_NEAR(Areas(scene).at("table"), 2 * (1.6 * 0.8 + 2.4 * 0.04), kRounding);
  ExpectSound(scene);
  Eigen::AlignedBox3d table;
  for (const Facet& facet : scene.facets) {
    if (scene.materials[static_cast<size_t>(facet.material)] != "table") continue;
    for (const double u : {0., 1.}) table.extend(facet.PointAt(u, 0)).extend(facet.PointAt(u, 1));
  }
  EXPECT_NEAR((table.center() - Eigen::Vector3d(2.8, 1.4, 0.72)).norm(), 0, kRounding)
      << "turned about its middle";
  EXPECT_NEAR(table.sizes().x(), 1.6 * std::cos(0.5) + 0.8 * std::sin(0.5), kRounding);
}

TEST(Outline, ASolidMayStandAnywhere) {
  for (const double x : {0.5, 1.0, 1.5, 2.0, 3.0}) {
    RoomOutline room = OutlinedRoom(kL, {2.5});
    room.boxes = {{"cabinet", {x, 1, 0}, {x + 1, 2, 2}, 0},
                  {"lamp", {x + 0.2, 1.2, 2}, {x + 0.4, 1.4, 2.5}, 0}};
    ExpectSound(SceneFrom(room));
  }
}

TEST(Outline, ThingsOfOneNameAreOneMaterial) {
  RoomOutline room = OutlineOfBox({6, 4, 2.8});
  room.boxes = {{"desk", {1, 1, 0.7}, {2, 2, 0.75}, 0}, {"desk", {3, 1, 0.7}, {4, 2, 0.75}, 0}};
  EXPECT_EQ(SceneFrom(room).materials.size(), 7U);
}

std::string FaultOf(const RoomOutline& room) {
  const auto fault = FindFault(room);
  if (!fault) return "";
  EXPECT_THROW(SceneFrom(room), std::invalid_argument);
  return fault->message;
}

TEST(OutlineFault, OutlinesThatEncloseNothingAreNamed) {
  EXPECT_THAT(FaultOf(OutlinedRoom({{0, 0}, {1, 0}}, {2})), HasSubstr("expected 3 to 128 corners, got 2"));
  EXPECT_THAT(FaultOf(OutlinedRoom({{0, 0}, {6, 0}, {6, 4}, {0, 4}, {0, 0}}, {2})),
              HasSubstr("got none from corner 5 to 1; name each corner once"));
  EXPECT_THAT(FaultOf(OutlinedRoom({{0, 0}, {6, 4}, {6, 0}, {0, 4}}, {2})),
              HasSubstr("got wall 1 (corners 1, 2) across wall 3 (corners 3, 4)"));
  EXPECT_THAT(FaultOf(OutlinedRoom({{0, 0}, {6, 0}, {3, 0}, {3, 4}}, {2})),
              HasSubstr("turns back at corner 2"));
  EXPECT_THAT(FaultOf(OutlinedRoom({{0, 0}, {6, 0}, {6, 4}, {3, 0}, {0, 4}}, {2})), HasSubstr("got wall 1"));
  EXPECT_THAT(FaultOf(OutlinedRoom({{0, 0}, {1e300, 0}, {6, 4}}, {2})), HasSubstr("within 100 km"));
  EXPECT_EQ(FaultOf(OutlinedRoom(kL, {2})), "");
}

TEST(OutlineFault, HeightsAreThoseOfTheCorners) {
  EXPECT_THAT(FaultOf(OutlinedRoom(kL, {2, 3})), HasSubstr("one for each of the 6 corners, got 2"));
  EXPECT_THAT(FaultOf(OutlinedRoom(kL, {-2})), HasSubstr("expected heights above 0 m, got -2 m"));
}

TEST(OutlineFault, BoxesStandInTheRoom) {
  const auto fault_of = [](const RoomBox& box) {
    RoomOutline room = OutlinedRoom(kL, {2.5});
    room.boxes = {box};
    return FaultOf(room);
  };
  EXPECT_EQ(fault_of({"a", {0, 0, 0}, {7.2, 3, 2.5}, 0}), "") << "flush with the walls";
  EXPECT_THAT(fault_of({"a", {1, 1, 0}, {1, 2, 1}, 0}), HasSubstr("expected min below max"));
  EXPECT_THAT(fault_of({"a", {1, 1, 0}, {2, 2, 2.6}, 0}), HasSubstr("inside the room"));
  EXPECT_THAT(fault_of({"a", {1, 1, -0.1}, {2, 2, 2}, 0}), HasSubstr("inside the room"));
  EXPECT_THAT(fault_of({"a", {3, 2, 0}, {5, 4, 2}, 0}), HasSubstr("inside the room"));
  EXPECT_THAT(fault_of({"a", {0, 0, 0}, {1, 2, 2}, 0.5}), HasSubstr("inside the room"))
      << "turned into the wall";
  // A U whose recess the box spans: all of its own corners are inside.
  RoomOutline u = OutlinedRoom({{0, 0}, {6, 0}, {6, 4}, {4, 4}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}, {2.5});
  u.boxes = {{"a", {1, 1, 0}, {5, 3, 1}, 0}};
  EXPECT_THAT(FaultOf(u), HasSubstr("inside the room"));
  RoomOutline sloped = OutlinedRoom({{0, 0}, {6, 0}, {6, 4}, {0, 4}}, {2, 3.5, 3.5, 2});
  sloped.boxes = {{"a", {4, 1, 0}, {5, 2, 2.9}, 0}};
  EXPECT_EQ(FaultOf(sloped), "");
  sloped.boxes = {{"a", {1, 1, 0}, {2, 2, 2.9}, 0}};
  EXPECT_THAT(FaultOf(sloped), HasSubstr("inside the room"));
}

TEST(OutlineFault, RectanglesLieInTheirWall) {
  const auto fault_of = [](const WallRectangle& rectangle) {
    RoomOutline room = OutlineOfBox({6, 4, 2.8});
    room.rectangles = {{"board", 2, 1, 3, 1, 2}, rectangle};
    return FaultOf(room);
  };
  EXPECT_EQ(fault_of({"door", 2, 3, 4, 0, 2.8}), "") << "touches the board";
  EXPECT_THAT(fault_of({"door", 4, 0, 1, 0, 2}), HasSubstr("expected a wall from 1 to 4, got 5"));
  EXPECT_THAT(fault_of({"door", 1, 3.5, 4.6, 0, 2}),
              HasSubstr("wall 2, which is 4 m long, got 3.5 to 4.6 m"));
  EXPECT_THAT(fault_of({"door", 1, 2, 1, 0, 2}), HasSubstr("got 2 to 1 m"));
  EXPECT_THAT(fault_of({"door", 1, 1, 2, 0, 3}),
              HasSubstr("wall 2, which is 2.8 m high there, got 0 to 3 m"));
  EXPECT_THAT(fault_of({"door", 2, 2, 4, 0, 2}),
              HasSubstr("got \"board\" and \"door\" on one place of wall 3"));
}

}  // namespace
}  // namespace luxfit
