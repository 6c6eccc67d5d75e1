#include "apps/session/session.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "apps/session/session_scene.h"
#include "tests/paths.h"
#include "tests/support/apps/tiny_session.h"

namespace luxfit {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using SessionTest = TinySessionTest;

TEST_F(SessionTest, ReadsScene) {
  const Session session = Read();
  EXPECT_EQ(session.name, "tiny");
  EXPECT_EQ(session.path, folder_.Path("session.toml"));
  ASSERT_TRUE(session.scene);
  EXPECT_EQ(session.scene->mesh, folder_.Path("room.obj"));
  EXPECT_EQ(session.scene->metres_per_unit, 0.01);
  EXPECT_EQ(session.scene->known_albedo_rgb.at("floor"), Eigen::Vector3d(0.25, 0.25, 0.25));
  EXPECT_EQ(session.scene->known_albedo_rgb.at("wall"), Eigen::Vector3d(0.7, 0.6, 0.5));
  EXPECT_EQ(session.tags.family, "tag36h11");
  EXPECT_EQ(session.tags.survey.size(), 1u);
  EXPECT_EQ(session.registration.method, "tags");
}

TEST_F(SessionTest, ReadsCamerasAndPhotos) {
  const Session session = Read();
  ASSERT_EQ(session.cameras.size(), 1u);
  EXPECT_EQ(session.cameras[0].id, "cam0");
  EXPECT_EQ(session.cameras[0].black_level_counts, 64);
  EXPECT_EQ(session.cameras[0].cdm2_per_count_s, 0.5);
  EXPECT_EQ(session.cameras[0].luminance_weights, Eigen::Vector3d(0.265, 0.670, 0.065));
  ASSERT_EQ(session.photos.size(), 2u);
  EXPECT_EQ(session.photos[1].file, folder_.Path("photos/v0_all.png"));
  EXPECT_EQ(session.photos[1].camera, 0);
  EXPECT_EQ(session.photos[1].view, "v0");
  EXPECT_EQ(session.photos[1].state, "all");
  EXPECT_EQ(session.photos[1].exposure_s, 0.05);
  EXPECT_EQ(session.photos[1].line, 3);
}

TEST_F(SessionTest, CalibrationImagesAndTheirBoard) {
  folder_.Write("board/b.png", "");
  folder_.Write("board/a.png", "");
  folder_.Write("board/notes.txt", "");
  folder_.Replace(
      "session.toml", "intrinsics = \"cam0.yaml\"",
      "calibration_images = \"board/*.png\"\nboard = { type = \"aprilgrid\", columns = 6, rows = 5, "
      "tag_size_m = 0.088, spacing = 0.3, first_id = 7 }");
  const Session session = Read();
  const SessionCamera& camera = session.cameras[0];
  EXPECT_EQ(camera.intrinsics, "");
  EXPECT_EQ(camera.calibration_images,
            (std::vector<std::string>{folder_.Path("board/a.png"), folder_.Path("board/b.png")}));
  EXPECT_THAT(session.input_files, Contains(EndsWith("board/b.png")));
  ASSERT_TRUE(camera.board);
  EXPECT_EQ(camera.board->type, BoardType::kAprilGrid);
  EXPECT_EQ(camera.board->columns, 6);
  EXPECT_EQ(camera.board->rows, 5);
  EXPECT_EQ(camera.board->tag_size_m, 0.088);
  EXPECT_EQ(camera.board->spacing, 0.3);
  EXPECT_EQ(camera.board->first_id, 7);
  EXPECT_EQ(camera.board->family, "tag36h11");
}

TEST_F(SessionTest, CharucoBoards) {
  folder_.Replace("session.toml", "intrinsics = \"cam0.yaml\"",
                  "intrinsics = \"cam0.yaml\"\nboard = { type = \"charuco\", columns = 8, rows = 6, "
                  "square_size_m = 0.03, marker_size_m = 0.022, dictionary = \"DICT_5X5_100\" }");
  const Session session = Read();
  ASSERT_TRUE(session.cameras[0].board);
  EXPECT_EQ(session.cameras[0].board->type, BoardType::kCharuco);
  EXPECT_EQ(session.cameras[0].board->square_size_m, 0.03);
  EXPECT_EQ(session.cameras[0].board->tag_size_m, 0.022);
  EXPECT_EQ(session.cameras[0].board->dictionary, "DICT_5X5_100");
}

TEST_F(SessionTest, StatesAndLuminairesKeepTheOrderOfTheFile) {
  const Session session = Read();
  ASSERT_EQ(session.states.size(), 2u);
  EXPECT_EQ(session.states[0].id, "Z");
  EXPECT_EQ(session.states[1].id, "all");
  EXPECT_EQ(session.states[1].dimming.at("A"), 0.5);
  ASSERT_EQ(session.luminaires.size(), 3u);
  EXPECT_EQ(session.luminaires[0].id, "B");
  EXPECT_EQ(session.luminaires[1].id, "Z");
  EXPECT_EQ(session.luminaires[2].id, "A");
  EXPECT_EQ(session.luminaires[2].photometry, "auto");
  EXPECT_FALSE(session.luminaires[2].position_m);
  const SessionLuminaire& known = session.luminaires[0];
  EXPECT_EQ(known.shape, "rectangle");
  EXPECT_EQ(known.size_m, (std::vector<double>{0.6, 0.3}));
  EXPECT_EQ(*known.position_m, Eigen::Vector3d(1.5, 2.0, 2.8));
  EXPECT_EQ(*known.position_sigma_m, 0.5);
  EXPECT_EQ(*known.aim, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(*known.flux_lm, 3600);
  EXPECT_EQ(*known.flux_sigma_lm, 500);
}

TEST_F(SessionTest, ReadingsHaveOneRoleEach) {
  const SessionLuxmeter luxmeter = Read().luxmeter;
  ASSERT_EQ(luxmeter.readings.size(), 3u);
  EXPECT_EQ(luxmeter.readings[0].role, ReadingRole::kScale);
  EXPECT_EQ(luxmeter.readings[0].normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(luxmeter.readings[0].illuminance_lx, 320.5);
  EXPECT_EQ(luxmeter.readings[1].role, ReadingRole::kFit);
  EXPECT_EQ(luxmeter.readings[2].role, ReadingRole::kCheck);
  EXPECT_TRUE(luxmeter.readings[1].is_measured);
  EXPECT_FALSE(luxmeter.readings[2].is_measured);
  EXPECT_EQ(luxmeter.meter_class, "B");
  EXPECT_DOUBLE_EQ(luxmeter.common_sigma, 0.05);
}

TEST_F(SessionTest, ClassIsHalvedToAStandardUncertainty) {
  for (const auto& [name, sigma] : std::map<std::string, double>{{"L", 0.015}, {"A", 0.025}, {"C", 0.1}}) {
    Reset();
    folder_.Replace("session.toml", "class = \"B\"", "class = \"" + name + "\"");
    EXPECT_DOUBLE_EQ(Read().luxmeter.common_sigma, sigma);
  }
  Reset();
  folder_.Replace("session.toml", "class = \"B\"", "");
  EXPECT_EQ(Read().luxmeter.common_sigma, 0);
}

TEST_F(SessionTest, ListsEveryInputFileOnce) {
  const std::vector<std::string> files = Read().input_files;
  EXPECT_EQ(files.size(), 8u);
  for (const char* name :
       {"session.toml", "room.obj", "tags.json", "cam0.yaml", "photos.csv", "v0_all.png", "luxmeter.csv"})
    EXPECT_THAT(files, Contains(EndsWith(name)));
}

TEST_F(SessionTest, SectionsMayBeAbsent) {
  folder_.Write("session.toml", "[scene]\nmesh = \"room.obj\"\n[[luminaire]]\nid = \"A\"\n");
  const Session session = Read();
  EXPECT_EQ(session.name, std::filesystem::path(folder_.Path("x")).parent_path().filename().string());
  EXPECT_THAT(session.photos, IsEmpty());
  EXPECT_THAT(session.luxmeter.readings, IsEmpty());
  ASSERT_EQ(session.states.size(), 1u);
  EXPECT_EQ(session.states[0].id, "all");
  EXPECT_EQ(session.states[0].dimming.at("A"), 1);
}

TEST_F(SessionTest, WithoutStatesTheTablesNameOne) {
  folder_.Replace("session.toml", "[states]\nZ = { Z = 1.0 }\nall = { A = 0.5, Z = 1 }\n", "");
  folder_.Replace("session.toml", "count = 3", "count = 1");
  EXPECT_THAT(Error(), AllOf(HasSubstr("photos.csv:3: state: expected \"Z\" as in "),
                             HasSubstr("photos.csv:2, got \"all\""), HasSubstr("name both in [states]")));
  folder_.Replace("photos.csv", "v0,all", "v0,Z");
  folder_.Replace("luxmeter.csv", "2,all", "2,Z");
  folder_.Replace("session.toml", "L1@all", "L1");
  const Session session = Read();
  ASSERT_EQ(session.states.size(), 1u);
  EXPECT_EQ(session.states[0].id, "Z");
  EXPECT_EQ(session.states[0].dimming, (std::map<std::string, double>{{"B", 1.0}}));
  EXPECT_FALSE(session.count_is_estimated);
}

TEST_F(SessionTest, LuminairesThatNobodyNamesAreCountedOrToBeCounted) {
  folder_.Replace("session.toml", "[states]\nZ = { Z = 1.0 }\nall = { A = 0.5, Z = 1 }\n", "");
  folder_.Replace("photos.csv", "v0,all", "v0,Z");
  folder_.Replace("luxmeter.csv", "2,all", "2,Z");
  folder_.Replace("session.toml", "L1@all", "L1");
  const Session given = Read();
  ASSERT_EQ(given.luminaires.size(), 3u);  // count = 3
  EXPECT_EQ(given.luminaires[0].id, "B");
  EXPECT_EQ(given.luminaires[2].id, "lamp2");
  EXPECT_EQ(given.states[0].dimming.at("lamp2"), 1);
  EXPECT_FALSE(given.count_is_estimated);
  folder_.Replace("session.toml", "count = 3", "count = \"estimate\"");
  const Session open = Read();
  EXPECT_TRUE(open.count_is_estimated);
  EXPECT_EQ(open.max_luminaires, 12);
  EXPECT_EQ(open.luminaires.size(), 1u);
}

TEST_F(SessionTest, ByteOrderMarksAndCrlfAreTolerated) {
  for (const char* name : {"session.toml", "photos.csv", "luxmeter.csv"}) {
    std::string text;
    for (const char c : folder_.Read(name)) text += c == '\n' ? "\r\n" : std::string(1, c);
    folder_.Write(name, "\xEF\xBB\xBF" + text);
  }
  EXPECT_EQ(Error(), "");
  EXPECT_EQ(Read().photos[0].state, "Z");
}

TEST_F(SessionTest, ARoomIsReadWithoutAMesh) {
  const std::string mesh = "mesh = \"room.obj\"\n";
  folder_.Replace("session.toml", mesh, "size = [600, 400, 280]\n");
  const Session by_size = Read();
  EXPECT_EQ(by_size.scene->mesh, "");
  EXPECT_NEAR(SceneOf(*by_size.scene).VolumeM3(), 67.2, 1e-9) << "in centimetres";
  EXPECT_EQ(std::count(by_size.input_files.begin(), by_size.input_files.end(), ""), 0);
  folder_.Replace("session.toml", "size = [600, 400, 280]\n",
                  "outline = [[0, 0], [600, 0], [600, 400], [0, 400]]\nheight = [200, 300, 300, 200]\n");
  folder_.Replace("session.toml", "[tags]", R"([[scene.box]]
name = "cabinet"
min = [100, 100, 0]
max = [200, 150, 200]
turn_deg = 90

[[scene.opening]]
name = "door"
wall = 2
from = 50
to = 140
high = 210

[tags])");
  const Session session = Read();
  const RoomOutline& outline = *session.scene->outline;
  EXPECT_NEAR(outline.boxes.at(0).turn_rad, 1.5707963267948966, 1e-12);
  EXPECT_EQ(outline.rectangles.at(0).wall, 1);
  EXPECT_EQ(outline.rectangles.at(0).low_m, 0);
  EXPECT_EQ(outline.rectangles.at(0).high_m, 2.1);
  EXPECT_NEAR(SceneOf(*session.scene).VolumeM3(), 6 * 4 * 2.5 - 1, 1e-9);
  EXPECT_EQ(SceneOf(*session.scene).materials.back(), "cabinet");
  EXPECT_EQ(session.scene->known_albedo_rgb.count("floor"), 1U);
}

TEST(SessionFixture, OfficeIsRead) {
  const Session session = ReadSession(std::string(LUXFIT_FIXTURES) + "/office/session.toml");
  EXPECT_EQ(session.photos.size(), 49u);
  EXPECT_EQ(session.states.size(), 6u);
  EXPECT_EQ(session.luminaires.size(), 4u);
  EXPECT_EQ(session.luxmeter.readings.size(), 48u);
  EXPECT_EQ(std::count_if(session.luxmeter.readings.begin(), session.luxmeter.readings.end(),
                          [](const SessionReading& reading) { return reading.role == ReadingRole::kScale; }),
            1);
}

}  // namespace
}  // namespace luxfit
