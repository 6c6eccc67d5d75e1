// Every error of the session reader: its place, what was expected and how to fix it.
#include "apps/session/session.h"

#include <gmock/gmock.h>

#include "tests/support/apps/tiny_session.h"

namespace luxfit {
namespace {

using ::testing::HasSubstr;

using SessionErrorsTest = TinySessionTest;

// Of a message that holds every one of these parts.
template <typename... Parts>
auto Holds(const Parts&... parts) {
  return testing::AllOf(HasSubstr(parts)...);
}

TEST_F(SessionErrorsTest, AMissingSessionOrAFolderIsReported) {
  EXPECT_THAT(ErrorOf(folder_.Path("sesion.toml")),
              Holds("sesion.toml: session: expected an existing file", "mean \"session.toml\"?"));
  EXPECT_THAT(ErrorOf(folder_.Path("")), Holds("session: expected a session file (TOML), got a folder",
                                               "did you mean ", "session.toml\"?"));
  EXPECT_THAT(ErrorOf(folder_.Path("photos")), HasSubstr("got a folder; name the session file in it"));
}

TEST_F(SessionErrorsTest, ARoomIsSaidOnce) {
  const std::string mesh = "mesh = \"room.obj\"";
  EXPECT_THAT(
      ErrorAfter(mesh, mesh + "\nsize = [6, 4, 2.8]"),
      HasSubstr("scene.size: expected one of mesh, size and outline, got mesh and size; remove all but one"));
  EXPECT_THAT(ErrorAfter(mesh, mesh + "\nheight = 2.8"),
              HasSubstr("scene.height: expected no height beside mesh, got one; remove it"));
  EXPECT_THAT(ErrorAfter(mesh, mesh + "\nbox = [{ name = \"a\", min = [0, 0, 0], max = [1, 1, 1] }]"),
              HasSubstr("scene.box: expected none beside a mesh"));
}

TEST_F(SessionErrorsTest, RoomsWithoutAMeshAreChecked) {
  const std::string mesh = "mesh = \"room.obj\"";
  const auto error_of = [&](const std::string& room) { return ErrorAfter(mesh, room); };
  EXPECT_EQ(error_of("size = [600, 400, 280]"), "");
  EXPECT_THAT(error_of("size = [600, 400]"),
              Holds("session.toml:4: scene.size: expected the room's three lengths", "write three numbers"));
  EXPECT_THAT(error_of("size = [600, 400, 0]"), HasSubstr("scene.size: expected three lengths > 0, got "));
  EXPECT_THAT(error_of("outline = [[0, 0], [600, 0], [600, 400]]"),
              HasSubstr("scene.height: expected the height of the ceiling (a number, or one for each "
                        "corner), got nothing"));
  const std::string height = "\nheight = 280";
  EXPECT_THAT(error_of("outline = [[0, 0], [600, 0]]" + height),
              Holds("session.toml:4: scene.outline: expected 3 to 128 corners, got 2"));
  EXPECT_THAT(error_of("outline = [[0, 0], [600, 0, 0], [600, 400]]" + height),
              HasSubstr("scene.outline[1]: expected a corner [x, y]"));
  EXPECT_THAT(
      error_of("outline = [[0, 0], [600, 400], [600, 0], [0, 400]]" + height),
      HasSubstr("scene.outline: expected walls that do not cross, got wall 1 (corners 1, 2) across wall 3"));
  EXPECT_THAT(error_of("outline = [[0, 0], [0, 0], [600, 0], [0, 400]]" + height),
              HasSubstr("scene.outline: expected walls of 1 mm and more"));
  EXPECT_THAT(error_of("outline = [[0, 0], [600, 0], [600, 400]]\nheight = [280, 280]"),
              HasSubstr("scene.height: expected one height, or one for each of the 3 corners, got 2"));
  EXPECT_THAT(
      error_of("size = [600, 400, 280]\nbox = [{ name = \"a\", min = [0, 0, 0], max = [700, 1, 1] }]"),
      HasSubstr("scene.box[0]: expected a box inside the room, got (0, 0, 0) to (7, 0.01, 0.01) m"));
  EXPECT_THAT(error_of("size = [600, 400, 280]\nbox = [{ name = \"a\", min = [0, 0, 0] }]"),
              HasSubstr("scene.box[0].max: expected the highest corner [x, y, z], got nothing"));
  EXPECT_THAT(error_of("size = [600, 400, 280]\n"
                       "opening = [{ name = \"door\", wall = 5, from = 0, to = 90, high = 200 }]"),
              HasSubstr("scene.opening[0]: expected a wall from 1 to 4, got 5"));
  EXPECT_THAT(error_of("size = [600, 400, 280]\n"
                       "opening = [{ name = \"door\", wal = 1, from = 0, to = 90, high = 200 }]"),
              HasSubstr("did you mean \"wall\"?"));
}

TEST_F(SessionErrorsTest, BrokenTomlNamesTheLine) {
  EXPECT_THAT(ErrorAfter("unit = \"cm\"", "unit = cm"),
              Holds(At("unit"), "expected valid TOML", "fix this line"));
}

TEST_F(SessionErrorsTest, MisspeltKeysSuggestTheNearest) {
  EXPECT_THAT(ErrorAfter("black_level", "blacklevel"),
              Holds(At("black_level") + "camera[0].blacklevel: expected a known key",
                    "did you mean \"black_level\"?"));
  EXPECT_THAT(ErrorAfter("[luxmeter]", "[luxmetre]"),
              Holds(At("[luxmeter]") + "luxmetre: ", "did you mean \"luxmeter\"?"));
  EXPECT_THAT(ErrorAfter("flux_lm", "flux_lumen"),
              Holds("luminaire[0].flux_lumen: expected a known key", "did you mean \"flux_lm\"?"));
  EXPECT_THAT(ErrorAfter("unit =", "zzzz ="), HasSubstr("remove it or correct its spelling"));
  EXPECT_THAT(ErrorAfter("table =", "tabel ="), HasSubstr("photos.tabel: expected a known key (table), got"));
}

TEST_F(SessionErrorsTest, MissingFilesAreNamedWithTheNearest) {
  EXPECT_THAT(ErrorAfter("room.obj", "rom.obj"),
              Holds(At("mesh") + "scene.mesh: expected an existing file, got \"rom.obj\"",
                    "did you mean \"room.obj\"?"));
  EXPECT_THAT(ErrorAfter("cam0.yaml", "intrinsics.yaml"),
              Holds("camera[0].intrinsics: expected an existing file", "correct the name"));
  EXPECT_THAT(ErrorAfter("\"photos.csv\"", "\"photos\""),
              HasSubstr("photos.table: expected an existing file, got "
                        "\"photos\", a folder; name a file in it"));
  EXPECT_THAT(ErrorAfter("photos.csv", "v0_all.png", "v0_al.png"),
              Holds("photos.csv:3: file: expected an existing file, got \"photos/v0_al.png\"",
                    "did you mean \"v0_all.png\"?"));
}

TEST_F(SessionErrorsTest, UnknownCamerasAndStatesListTheKnown) {
  EXPECT_THAT(
      ErrorAfter("photos.csv", "all.png,cam0", "all.png,cam1"),
      Holds("photos.csv:3: camera: expected a known camera (cam0), got \"cam1\"", "did you mean \"cam0\"?"));
  EXPECT_THAT(ErrorAfter("photos.csv", "all.png,cam0", "all.png,phone"),
              HasSubstr("add [[camera]] with this id"));
  EXPECT_THAT(
      ErrorAfter("photos.csv", "v0,all", "v0,al"),
      Holds("photos.csv:3: state: expected a known state (Z or all), got \"al\"", "did you mean \"all\"?"));
  EXPECT_THAT(ErrorAfter("luxmeter.csv", "1,Z,120", "1,evening,120"),
              Holds("luxmeter.csv:3: state: expected a known state (Z or all), got \"evening\"",
                    "add it to [states]"));
  Reset();
  folder_.Write("session.toml", "[photos]\ntable = \"photos.csv\"\n[states]\nZ = {}\nall = {}\n");
  EXPECT_THAT(Error(), Holds("photos.csv:2: camera: ", "the session has none; add [[camera]]"));
}

TEST_F(SessionErrorsTest, PhotoRowsAreChecked) {
  EXPECT_THAT(ErrorAfter("photos.csv", ",0.05", ",0"),
              Holds("photos.csv:3: exposure_s: expected > 0, got \"0\"", "in seconds"));
  EXPECT_THAT(ErrorAfter("photos.csv", ",0.05", ",-1"), HasSubstr("photos.csv:3: exposure_s: expected > 0"));
  EXPECT_THAT(ErrorAfter("photos.csv", ",0.05", ",1/20"),
              HasSubstr("exposure_s: expected a finite number, got \"1/20\""));
  EXPECT_THAT(ErrorAfter("photos.csv", ",v0,all", ",,all"),
              HasSubstr("photos.csv:3: view: expected a name, got nothing"));
  EXPECT_THAT(ErrorAfter("photos.csv", "v0_all.png", "v0_Z.png"),
              Holds("photos.csv:3: file: expected every photo once", "line 2"));
  EXPECT_THAT(ErrorAfter("photos.csv", "v0,all,0.05", "v0,Z,0.1"),
              Holds("photos.csv:3: exposure_s: ", "to differ in exposure", "line 2 too"));
  EXPECT_EQ(ErrorAfter("photos.csv", "v0,all,0.05", "v0,Z,0.2"), "") << "a bracket";
}

TEST_F(SessionErrorsTest, AViewHasOneCameraAndSettingsArePositive) {
  const auto error_after_row = [&](const std::string& row) {
    Reset();
    folder_.Write("photos.csv",
                  "file,camera,view,state,exposure_s,iso\n"
                  "photos/v0_Z.png,cam0,v0,Z,0.1,100\nphotos/v0_all.png,cam0,v0,all," +
                      row + "\n");
    return Error();
  };
  folder_.Replace("session.toml", "[photos]",
                  "[[camera]]\nid = \"cam1\"\nintrinsics = \"cam0.yaml\"\n[photos]");
  folder_.Replace("photos.csv", "all.png,cam0", "all.png,cam1");
  EXPECT_THAT(Error(),
              Holds("photos.csv:3: view: expected one camera per view", "line 2", "a name of its own"));
  Reset();
  folder_.Write("photos.csv",
                "file,camera,view,state,exposure_s,iso\n"
                "photos/v0_Z.png,cam0,v0,Z,0.1,100\nphotos/v0_all.png,cam0,v0,all,0.05,200\n");
  EXPECT_EQ(Error(), "");
  EXPECT_THAT(error_after_row("0.05,-200"),
              Holds("photos.csv:3: iso: expected > 0, got \"-200\"", "leave it empty"));
  EXPECT_EQ(error_after_row("0.05,"), "");
  EXPECT_EQ(error_after_row(",100"), "");  // the photo's own metadata may say it
}

TEST_F(SessionErrorsTest, ReadingRowsAreChecked) {
  EXPECT_THAT(ErrorAfter("luxmeter.csv", "0,0,2,all", "0,0,0,all"),
              Holds("luxmeter.csv:2: nx,ny,nz: expected the direction", "got 0,0,0; 0,0,1 is"));
  EXPECT_THAT(ErrorAfter("luxmeter.csv", "320.5", "-3"),
              HasSubstr("luxmeter.csv:2: lux: expected >= 0, got \"-3\"; correct"));
  EXPECT_THAT(
      ErrorAfter("luxmeter.csv", "320.5", "1e308"),
      HasSubstr("luxmeter.csv:2: lux: expected an illuminance of up to 1e+07, got \"1e308\"; correct"));
  EXPECT_THAT(ErrorAfter("luxmeter.csv", "0,0,2,all", "1e308,0,2,all"),
              HasSubstr("luxmeter.csv:2: nx: expected a direction of up to 1e+06"));
  EXPECT_THAT(ErrorAfter("luxmeter.csv", "320.5", "nan"),
              HasSubstr("luxmeter.csv:2: lux: expected a finite number"));
  EXPECT_THAT(ErrorAfter("luxmeter.csv", "320.5", "320,5"),
              Holds("luxmeter.csv:2: expected 9 fields", "decimal comma"));
  EXPECT_THAT(ErrorAfter("luxmeter.csv", "P1", "F1"),
              Holds("luxmeter.csv:4: id: expected one reading per id and state, got \"F1@Z\" in line 3 too",
                    "another id"));
  EXPECT_THAT(
      ErrorAfter("luxmeter.csv", "z_m", "height"),
      Holds("luxmeter.csv:1: header: expected \"id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx[,sensor]\", got "
            "\"id,x_m,y_m,height,nx,ny,nz,state,lux\"",
            "column 4 must be \"z_m\""));
}

TEST_F(SessionErrorsTest, IlluminanceOfReadingsHasOneColumnUnderEitherName) {
  EXPECT_EQ(ErrorAfter("luxmeter.csv", "state,lux", "state,illuminance_lx"), "");
  EXPECT_EQ(Read().luxmeter.readings[0].illuminance_lx, 320.5);
  EXPECT_FALSE(Read().luxmeter.readings[2].is_measured);
  folder_.Replace("luxmeter.csv", "320.5", "-3");
  EXPECT_THAT(Error(), HasSubstr("luxmeter.csv:2: illuminance_lx: expected >= 0, got \"-3\"; correct"));
  EXPECT_THAT(ErrorAfter("luxmeter.csv", "state,lux", "state,E"),
              HasSubstr("column 9 must be \"illuminance_lx\" (or its alias \"illuminance_fc\", "
                        "\"illuminance_klx\" or \"lux\"): rename"));
  EXPECT_THAT(ErrorAfter("luxmeter.csv", "state,lux", "state"),
              HasSubstr("add the column \"illuminance_lx\" (or its alias \"illuminance_fc\", "
                        "\"illuminance_klx\" or \"lux\")"));
  for (const char* both : {"state,illuminance_lx,lux", "state,lux,illuminance_lx"})
    EXPECT_THAT(ErrorAfter("luxmeter.csv", "state,lux", both),
                Holds("luxmeter.csv:1: header: expected one of the columns \"illuminance_lx\" and \"lux\"",
                      "got both; keep one and remove the other"));
}

TEST_F(SessionErrorsTest, RolesAreChecked) {
  EXPECT_THAT(ErrorAfter("L1@all", "L9@all"),
              Holds(At("scale =") + "luxmeter.scale[0]: expected a pattern that matches a reading",
                    "got \"L9@all\", which matches none", "did you mean \"L1@all\"?"));
  EXPECT_THAT(ErrorAfter("F*@Z", "*@all"),
              Holds(At("fit =") + "luxmeter.fit: expected one role for each reading", "\"L1@all\"",
                    "matched by fit \"*@all\" and by scale \"L1@all\"", "narrow one"));
  EXPECT_THAT(ErrorAfter("F*@Z", "P1"),
              Holds("luxmeter.fit[0]: expected readings that were measured, got \"P1@Z\" (line 4)",
                    "fill it in or narrow"));
  EXPECT_THAT(ErrorAfter("class = \"B\"", "class = \"D\""),
              HasSubstr("luxmeter.class: expected L, A, B or C, got \"D\""));
}

TEST_F(SessionErrorsTest, StatesAreChecked) {
  EXPECT_THAT(ErrorAfter("A = 0.5", "A = 50"),
              Holds(At("all = {") + "states.all.A: expected a dimming in 0..1, got 50", "0.3"));
  EXPECT_THAT(ErrorAfter("A = 0.5", "A = -0.1"), HasSubstr("states.all.A: expected a dimming in 0..1"));
  EXPECT_THAT(
      ErrorAfter("A = 0.5, Z = 1", "A = 0.5, z = 1"),
      Holds(At("all = {") + "states.all.z: expected luminaires whose names differ by more than capitals, got "
                            "\"z\" beside \"Z\"",
            "write both alike"));
  EXPECT_THAT(ErrorAfter("A = 0.5", "A = nan"),
              HasSubstr("states.all.A: expected a dimming in 0..1, got nan; write"));
  EXPECT_THAT(ErrorAfter("Z = { Z = 1.0 }", "Z = \"on\""),
              HasSubstr("states.Z: expected a table, got \"on\""));
}

// Exporters write names into files whose lines other programs execute or parse.
TEST_F(SessionErrorsTest, NamesWithControlCharactersAreRefused) {
  const std::string expected = "without control characters";
  EXPECT_THAT(ErrorAfter("id = \"B\"", "id = \"B\\n!touch pwned\""),
              Holds(At("id = \"B\"") + "luminaire[0].id: ", expected, "remove it"));
  EXPECT_THAT(ErrorAfter("name = \"tiny\"", "name = \"ti\\u0085ny\""),
              Holds(At("name =") + "name: ", expected));
  EXPECT_THAT(ErrorAfter("Z = { Z = 1.0 }", "\"Z\\r\" = { Z = 1.0 }"),
              Holds(At("Z = { Z") + "states.Z : ", expected));
  EXPECT_THAT(ErrorAfter("all = { A", "all = { \"A\\n!touch pwned\""),
              Holds(At("all = {") + "states.all.A !touch pwned: ", expected));
  EXPECT_THAT(ErrorAfter("photos.csv", "cam0,v0,Z", "cam0,v\x1b[31m0,Z"),
              Holds("photos.csv:2: view: ", expected, "remove it"));
  EXPECT_THAT(ErrorAfter("luxmeter.csv", "L1,", "L\x1b[1m,"), Holds("luxmeter.csv:2: id: ", expected));
}

TEST_F(SessionErrorsTest, LuminairesAreChecked) {
  EXPECT_THAT(ErrorAfter("flux_lm = 3600.0", "flux_lm = -3"),
              HasSubstr(At("flux_lm") + "luminaire[0].flux_lm: expected > 0, got -3"));
  EXPECT_THAT(ErrorAfter("flux_lm = 3600.0\n", ""),
              HasSubstr("luminaire[0].flux_sigma_lm: expected flux_lm beside it"));
  EXPECT_THAT(ErrorAfter("flux_lm = 3600.0", "flux_lm = \"3600\""),
              HasSubstr("luminaire[0].flux_lm: expected a number (lm), got \"3600\"; write a finite number"));
  EXPECT_THAT(ErrorAfter("[0, 0, -2]", "[0, 0, 0]"),
              HasSubstr("luminaire[0].aim: expected a direction [x, y, z]"));
  EXPECT_THAT(ErrorAfter("[1, 0, 0]", "[0, 0, 1]"),
              HasSubstr("luminaire[0].heading: expected a direction across"));
  EXPECT_THAT(ErrorAfter("[1.5, 2.0, 2.8]", "[1.5, inf, 2.8]"),
              HasSubstr("luminaire[0].position_m[1]: expected a number, got inf; write a finite number"));
  EXPECT_THAT(ErrorAfter("[0.6, 0.3]", "[0.6]"),
              HasSubstr("luminaire[0].size_m: expected two lengths for shape "
                        "\"rectangle\", got"));
  EXPECT_THAT(ErrorAfter("\"rectangle\"", "\"rectangel\""), HasSubstr("did you mean \"rectangle\"?"));
  EXPECT_THAT(ErrorAfter("count = 3", "count = 2"),
              HasSubstr("luminaires.count: expected 3, the number of luminaires"));
  EXPECT_THAT(ErrorAfter("max = 12", "max = 2"),
              HasSubstr("luminaires.max: expected at least the 3 luminaires"));
  EXPECT_THAT(ErrorAfter("[luxmeter]", "[[luminaire]]\nid = \"B\"\n[luxmeter]"),
              Holds("luminaire[1].id: expected a name of its own, got \"B\"", "rename one"));
}

TEST_F(SessionErrorsTest, SceneTagsAndCamerasAreChecked) {
  EXPECT_THAT(ErrorAfter("\"cm\"", "\"metres\""),
              HasSubstr("scene.unit: expected m, cm, mm, in or ft, got \"metres\""));
  EXPECT_THAT(ErrorAfter("floor = 0.25", "floor = 25"),
              HasSubstr(At("floor") +
                        "scene.albedo.floor: expected a reflectance in 0..1, got 25; 25 % is written 0.25"));
  EXPECT_THAT(ErrorAfter("[0.7, 0.6, 0.5]", "[0.7, 0.6]"),
              HasSubstr("scene.albedo.wall: expected a reflectance"));
  EXPECT_THAT(ErrorAfter("tag36h11", "tag36h12"), HasSubstr("did you mean \"tag36h11\"?"));
  EXPECT_THAT(
      ErrorAfter("mesh = \"room.obj\"\n", ""),
      HasSubstr("scene.mesh: expected what the room is: mesh, size or outline, got none; add size = "));
  EXPECT_THAT(ErrorAfter("black_level = 64", "black_level = -1"),
              HasSubstr("camera[0].black_level: expected >= 0, got -1"));
  EXPECT_THAT(ErrorAfter("[photos]", "[[camera]]\nid = \"cam0\"\nintrinsics = \"cam0.yaml\"\n[photos]"),
              HasSubstr("camera[1].id: expected a name of its own, got \"cam0\""));
}

TEST_F(SessionErrorsTest, CalibrationImagesAreChecked) {
  EXPECT_EQ(ErrorAfter("intrinsics = \"cam0.yaml\"\n", ""), "") << "its own photos show the surveyed tags";
  EXPECT_THAT(
      ErrorAfter("intrinsics = \"cam0.yaml\"", "calibration_images = \"board/*.png\""),
      Holds(At("intrinsics") + "camera[0].calibration_images: expected files that match, got none for "
                               "\"board/*.png\"",
            "put the photos there"));
  EXPECT_THAT(ErrorAfter("intrinsics = \"cam0.yaml\"", "calibration_images = 3"),
              HasSubstr("camera[0].calibration_images: expected a file pattern"));
  EXPECT_EQ(ErrorAfter("intrinsics = \"cam0.yaml\"", "calibration_images = \"photos/*.png\""), "")
      << "they may show the surveyed tags";
  Reset();
  folder_.Replace("session.toml", "intrinsics = \"cam0.yaml\"", "calibration_images = \"photos/*.png\"");
  folder_.Replace("session.toml", "[tags]\nfamily = \"tag36h11\"\nmap = \"tags.json\"\n", "");
  EXPECT_THAT(Error(), HasSubstr("camera[0].board: expected what the calibration images show"));
  folder_.Replace("session.toml", "calibration_images = \"photos/*.png\"", "");
  EXPECT_THAT(Error(), Holds("camera[0].intrinsics: expected a file of intrinsics",
                             "or calibration_images, got nothing"));
  EXPECT_THAT(ErrorAfter("intrinsics = \"cam0.yaml\"", "calibration_corners = \"tags.json\""),
              HasSubstr("camera[0].board: expected what the calibration images show"));
}

TEST_F(SessionErrorsTest, CalibrationIsChecked) {
  const auto error = [&](const std::string& line) {
    return ErrorAfter("[photos]", "[calibration]\n" + line + "\n[photos]");
  };
  EXPECT_EQ(error("lens = \"opencv8\"\nback_end = \"opencv\"\nrig = \"order\"\nfocal_start_px = 800"), "");
  EXPECT_EQ(error("lens = \"splined10\""), "");
  EXPECT_THAT(error("lens = \"opencv6\""), HasSubstr("calibration.lens: expected auto, opencv4, opencv5"));
  EXPECT_THAT(error("lens = \"splined\""), HasSubstr("splinedN with N control points"));
  EXPECT_THAT(error("back_end = \"kalibr\""), HasSubstr("calibration.back_end: expected"));
  EXPECT_THAT(error("lens = \"splined8\"\nback_end = \"opencv\""),
              HasSubstr("calibration: expected back_end = \"mrcal\" with a splined lens"));
  EXPECT_THAT(error("rig = \"pairs\""), HasSubstr("calibration.rig: expected"));
  EXPECT_THAT(error("focal_start_px = 0"), HasSubstr("calibration.focal_start_px: expected > 0"));
  EXPECT_THAT(
      ErrorAfter("intrinsics = \"cam0.yaml\"", "intrinsics = \"cam0.yaml\"\nimage_size = [640.5, 480]"),
      HasSubstr("camera[0].image_size: expected [width, height] in whole pixels"));
}

TEST_F(SessionErrorsTest, BoardsAreChecked) {
  const auto error = [&](const std::string& board) {
    return ErrorAfter("intrinsics = \"cam0.yaml\"", "intrinsics = \"cam0.yaml\"\nboard = { " + board + " }");
  };
  EXPECT_THAT(error("columns = 6"),
              HasSubstr("camera[0].board.type: expected aprilgrid, chessboard or charuco"));
  EXPECT_THAT(
      error("type = \"charuco\", columns = 0.5"),
      HasSubstr("camera[0].board.columns: expected a number of columns, got 0.5; write a whole number"));
  EXPECT_THAT(error("type = \"chesboard\""), HasSubstr("did you mean \"chessboard\"?"));
  EXPECT_THAT(error("type = \"chessboard\", columns = 9, rows = 6"),
              HasSubstr("camera[0].board.square_size_m: expected the side of a square, m, got nothing"));
  EXPECT_THAT(error("type = \"chessboard\", columns = 9, rows = 6, tag_size_m = 0.1"),
              HasSubstr("camera[0].board.tag_size_m: expected a known key"));
  EXPECT_THAT(error("type = \"chessboard\", columns = 2, rows = 6, square_size_m = 0.03"),
              HasSubstr("camera[0].board: columns: expected at least 3 inner corners, got 2; correct"));
  EXPECT_THAT(error("type = \"aprilgrid\", columns = 6, rows = 0, tag_size_m = 0.1, spacing = 0.3"),
              HasSubstr("camera[0].board.rows: expected a number of rows, got 0"));
  EXPECT_THAT(error("type = \"aprilgrid\", columns = 30, rows = 30, tag_size_m = 0.1, spacing = 0.3"),
              HasSubstr("the board has 900 tags, tag36h11 587"));
  EXPECT_THAT(error("type = \"aprilgrid\", columns = 6, rows = 6, tag_size_m = 0.1, spacing = 0.3, "
                    "family = \"tag36h12\""),
              HasSubstr("tag family: expected tag36h11"));
  EXPECT_THAT(error("type = \"charuco\", columns = 6, rows = 8, square_size_m = 0.03, marker_size_m = 0.04"),
              HasSubstr("camera[0].board: tag_size_m: expected a marker smaller than its square, got 0.04"));
  EXPECT_THAT(error("type = \"charuco\", columns = 6, rows = 8, square_size_m = 0.03, marker_size_m = 0.02, "
                    "dictionary = \"DICT_4X4\""),
              HasSubstr("dictionary: expected one of DICT_4X4_50"));
}

TEST_F(SessionErrorsTest, TagMapErrorsAreThoseOfItsFile) {
  EXPECT_THAT(ErrorAfter("tags.json", "0.2", "-0.2"), HasSubstr("tags.json:1: tag[0].size_m: expected > 0"));
}

TEST_F(SessionErrorsTest, FilesOfAnotherKindAreRefusedByName) {
  EXPECT_THAT(ErrorAfter("cam0.yaml", "cam0.json"),
              HasSubstr("camera[0].intrinsics: expected a file of intrinsics (OpenCV YAML or XML, mrcal "));
  EXPECT_THAT(
      ErrorAfter("count = 3", "count = \"estimate\""),
      HasSubstr("luminaires.count: expected the number of luminaires that [states] names, or nothing, got "
                "\"estimate\"; a number is estimated only without [states]"));
}

TEST_F(SessionErrorsTest, RegistrationIsChecked) {
  EXPECT_THAT(ErrorAfter("method = \"tags\"", "method = \"sfm\""),
              Holds("registration.method: expected", "got \"sfm\""));
  EXPECT_THAT(ErrorAfter("method = \"tags\"", "colmap = \"sparse/0\""),
              Holds("registration.colmap: expected the folder of a COLMAP model", "sparse/0"));
  EXPECT_THAT(ErrorAfter("method = \"tags\"", "method = \"tags\"\ncolmap = \".\""),
              HasSubstr("registration.colmap: expected no COLMAP model beside method = \"tags\""));
  EXPECT_THAT(ErrorAfter("method = \"tags\"", "start = { v00 = [1, 2, 3] }"),
              HasSubstr("registration.start: expected the rough places of three views or more, got 1"));
  EXPECT_THAT(ErrorAfter("method = \"tags\"", "start = { a = [1, 2, 3], b = [1, 2, 3], c = [1, 2, 3] }"),
              Holds("registration.start.a: expected a view of the photo table", "got \"a\""));
  EXPECT_EQ(ErrorAfter("map = \"tags.json\"", "size_m = 0.2"), "");
  EXPECT_THAT(ErrorAfter("map = \"tags.json\"", ""),
              HasSubstr("tags.map: expected a tag map, or the tags' size"));
}

TEST_F(SessionErrorsTest, SensitivityCurvesAreChecked) {
  const auto error = [&](const std::string& table) {
    Reset();
    folder_.Write("curve.csv", "angle_deg,relative\n" + table);
    folder_.Replace("session.toml", "\"cosine\"", "\"curve.csv\"");
    return Error();
  };
  EXPECT_EQ(error("0,2\n60,0.98\n90,0\n"), "");
  const Session session = Read();
  EXPECT_EQ(session.luxmeter.response.kind, ResponseKind::kTable);
  EXPECT_EQ(session.luxmeter.response.relative, (std::vector<double>{1, 0.49, 0}));
  EXPECT_THAT(session.input_files, testing::Contains(testing::HasSubstr("curve.csv")));
  EXPECT_THAT(error("10,1\n60,0.5\n"),
              HasSubstr("curve.csv:2: angle_deg: expected angles that ascend from 0"));
  EXPECT_THAT(error("0,1\n60,0.5\n60,0.4\n"),
              HasSubstr("curve.csv:4: angle_deg: expected angles that ascend"));
  EXPECT_THAT(error("0,1\n60,0.5\n200,0\n"), HasSubstr("curve.csv:4: angle_deg: "));
  EXPECT_THAT(error("0,1\n60,-0.5\n"), HasSubstr("curve.csv:3: relative: expected the response"));
  EXPECT_THAT(error("0,0\n60,0.5\n"), HasSubstr("curve.csv:2: relative: "));
  EXPECT_THAT(error("0,1\n"), HasSubstr("expected two angles or more"));
  EXPECT_THAT(ErrorAfter("\"cosine\"", "\"nowhere.csv\""), HasSubstr("luxmeter.sensitivity: "));
}

TEST_F(SessionErrorsTest, PhotometricFilesMustBeThere) {
  EXPECT_THAT(ErrorAfter("\"lambertian\"", "\"spot.ies\""),
              HasSubstr("luminaire[0].photometry: expected an existing file, got \"spot.ies\""));
  EXPECT_THAT(ErrorAfter("\"lambertian\"", "\"spot.LDT\""),
              HasSubstr("luminaire[0].photometry: expected an existing file, got \"spot.LDT\""));
  EXPECT_THAT(ErrorAfter("\"lambertian\"", "\"lambert\""), HasSubstr("mean \"lambertian\"?"));
  EXPECT_THAT(ErrorAfter("photometry =", "cosine_exponent = 3\nphotometry ="),
              HasSubstr("luminaire[0].cosine_exponent: expected it beside photometry = \"cosine_power\""));
}

TEST_F(SessionErrorsTest, ResponseAndVignettingAreNamesOrFiles) {
  EXPECT_EQ(ErrorAfter("response = \"linear\"", "response = \"estimate\""), "");
  EXPECT_EQ(ErrorAfter("\"none\"", "\"estimate\""), "");
  EXPECT_THAT(ErrorAfter("response = \"linear\"", "response = 1"),
              HasSubstr("camera[0].response: expected \"linear\", \"srgb\", \"estimate\" or a file, got 1"));
  EXPECT_THAT(ErrorAfter("response = \"linear\"", "response = \"curve.csv\""),
              HasSubstr(At("response") + "camera[0].response: expected an existing file, got \"curve.csv\""));
  EXPECT_THAT(ErrorAfter("response = \"linear\"", "response = \"estimat\""), HasSubstr("mean \"estimate\"?"));
  EXPECT_THAT(ErrorAfter("\"none\"", "\"flat.png\""),
              HasSubstr("camera[0].vignetting: expected an existing file"));
}

}  // namespace
}  // namespace luxfit
