// Adds the commands for the beginning, before there is a session.
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cli/cli.h"
#include "apps/commands/board_command.h"
#include "apps/commands/demo_command.h"
#include "apps/commands/doctor_command.h"
#include "apps/commands/init_command.h"
#include "apps/commands/result/explain_command.h"
#include "apps/commands/room_command.h"

namespace luxfit {
namespace {

void AddBoardOptions(CLI::App& sub, BoardCommandOptions& options) {
  const auto size = [&](const std::string& flag, double& value, const std::string& help) {
    sub.add_option(flag, value, help)->check(CLI::PositiveNumber);
  };
  sub.add_option("TYPE", options.type, "aprilgrid | chessboard | charuco | tags")->required();
  sub.add_option("-o,--out", options.file, "file to write, .pdf or .svg")->required();
  sub.add_option("--paper", options.paper, "A0 to A5, letter, legal, tabloid, or WIDTHxHEIGHT in mm")
      ->capture_default_str();
  sub.add_option("--columns", options.columns,
                 "tags, inner corners (chessboard) or squares (charuco) along a row")
      ->check(CLI::PositiveNumber);
  sub.add_option("--rows", options.rows, "the same along a column")->check(CLI::PositiveNumber);
  size("--tag-size", options.tag_size_m,
       "aprilgrid, tags: side of a tag's black square, m; of tagStandard41h12 the white one in it (default: "
       "what fits)");
  size("--spacing", options.spacing, "aprilgrid: gap between black squares, in tag sizes (default: 0.3)");
  size("--square-size", options.square_size_m,
       "chessboard, charuco: side of a square, m (default: what fits)");
  size("--marker-size", options.marker_size_m, "charuco: side of a marker, m (default: 0.7 squares)");
  sub.add_option("--first-id", options.first_id, "aprilgrid, charuco")->check(CLI::NonNegativeNumber);
  sub.add_option("--ids", options.ids, "tags: ids and ranges, 0-11,20")->capture_default_str();
  sub.add_option("--family", options.family, "aprilgrid, tags: tag family")->capture_default_str();
  sub.add_option("--dictionary", options.dictionary, "charuco: OpenCV's name")->capture_default_str();
  sub.add_flag("--corner-squares", options.has_corner_squares,
               "aprilgrid: black squares between the tags' corners, as Kalibr prints");
  sub.add_option("--border-bits", options.border_bits,
                 "aprilgrid: cells of a tag's black border; 2: Kalibr's")
      ->capture_default_str()
      ->check(CLI::Range(1, 2));
}

void AddBoard(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("board", "calibration boards and room tags to print, at true scale");
  const auto options = std::make_shared<BoardCommandOptions>();
  AddBoardOptions(*command, *options);
  command->final_callback(
      [&invocation, options] { invocation.run = [options] { return BoardCommand(*options); }; });
  AddExample(*command, "luxfit board aprilgrid -o board.pdf",
             "board = { type = \"aprilgrid\", columns = 5, rows = 7, tag_size_m = 0.03, spacing = 0.3 }");
}

void AddExplain(CLI::App& app, Invocation& invocation) {
  CLI::App* const command = app.add_subcommand(
      "explain", "a warning's code, a key of the session file, or a whole result, in words");
  const auto options = std::make_shared<ExplainCommandOptions>();
  command->add_option("TOPIC", options->topic,
                      "scale_undetermined, camera.response, OUT (default: what there is)");
  AddJson(*command, options->json);
  command->final_callback(
      [&invocation, options] { invocation.run = [options] { return ExplainCommand(*options); }; });
  AddExample(
      *command, "luxfit explain scale_undetermined",
      "Photos alone give fluxes up to one common factor. Positions, distributions and reflectances are "
      "determined; lumens and lux are not.\n"
      "Fix: name one luxmeter reading in `luxmeter.scale`, or ...");
}

void AddInit(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("init", "a draft of a session from photos and the room; every guess is marked");
  const auto options = std::make_shared<InitCommandOptions>();
  command->add_option("--photos", options->photos, "folder of the photos")->required();
  CLI::Option* const mesh = command->add_option("--mesh", options->mesh, "OBJ, PLY or glTF of the room");
  command
      ->add_option(
          "--size", options->size,
          "in place of a mesh: length along x, along y, height, m: 6 4 2.8 or 6x4x2.8 (default: guessed "
          "from the tags)")
      ->expected(1, 3)
      ->excludes(mesh);
  command->add_option("--tags", options->tags, "map of the tags (JSON)");
  command
      ->add_option("-o,--out", options->out, "folder to write session.toml, photos.csv and luxmeter.csv into")
      ->capture_default_str();
  AddJson(*command, options->json);
  AddThreads(*command, invocation);
  command->final_callback(
      [&invocation, options] { invocation.run = [options] { return InitCommand(*options); }; });
  AddExample(*command,
             "luxfit init --photos office/photos --mesh office/room.obj --tags office/tags.json -o mine",
             "mine/session.toml: 49 photos, 6 states, 7 materials, tags 0 1 2 3 4 5 7 8 9 10 11\n"
             "check the lines that end in GUESS; then:\n"
             "- photos.csv: exposure_s of 49 photos: their metadata lacks it\n"
             "...");
}

void AddRoom(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("room", "check and draw a room: size, volume, areas, what is wrong, a plan");
  const auto options = std::make_shared<RoomCommandOptions>();
  command->add_option("ROOM", options->file, "a session file (TOML), or a mesh: OBJ, PLY or glTF")
      ->required();
  command->add_option("-o,--out", options->plan, "plan to write, .svg");
  command->add_option("--unit", options->unit, "unit of a mesh: m | cm | mm | in | ft")
      ->capture_default_str();
  AddJson(*command, options->json);
  AddThreads(*command, invocation);
  command->final_callback(
      [&invocation, options] { invocation.run = [options] { return RoomCommand(*options); }; });
  AddExample(*command, "luxfit room office/session.toml -o plan.svg",
             "office: 6.00 x 4.00 x 2.80 m, 27 facets, 7 materials; office/room.obj\n"
             "volume 66.12 m3\n"
             "  wall            44.80 m2\n"
             "...\n"
             "good  the surfaces close and face the room");
}

void AddDoctor(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("doctor", "what this machine has, and what a session still lacks");
  const auto options = std::make_shared<DoctorCommandOptions>();
  command->add_option("SESSION", options->session, "the session file (TOML; default: the machine alone)");
  AddJson(*command, options->json);
  AddThreads(*command, invocation);
  command->final_callback(
      [&invocation, options] { invocation.run = [options] { return DoctorCommand(*options); }; });
  AddExample(*command, "luxfit doctor office/session.toml",
             "good  luxfit 0.1.0, 2 cores\n"
             "...\n"
             "good  8 views are placed by tags, reprojection RMS 0.031 px\n"
             "note  View v08 shows no surveyed tag that can be used; it is left out.\n"
             "...");
}

void AddDemo(CLI::App& app, Invocation& invocation) {
  CLI::App* const command = app.add_subcommand("demo", "run a room that comes with luxfit, photos to report");
  const auto options = std::make_shared<DemoCommandOptions>();
  command->add_option("room", options->room, "office: four luminaires; openplan: twenty panels in four rows")
      ->check(CLI::IsMember(DemoRooms()))
      ->capture_default_str();
  command->add_option("-o,--out", options->out, "folder for the results")->required();
  AddJson(*command, options->json);
  AddThreads(*command, invocation);
  command->final_callback([&invocation, options] {
    options->command_line = invocation.command_line;
    invocation.run = [options] { return DemoCommand(*options); };
  });
  AddExample(*command, "luxfit demo -o demo",
             "session office: done\n"
             "8 views registered, reprojection RMS 0.031 px\n"
             "...\n"
             "checked 47 readings: mean error 1.20 lx = 0.99 % of the mean reading, largest 3.13 %");
}

}  // namespace

void AddStartCommands(CLI::App& app, Invocation& invocation) {
  AddDemo(app, invocation);
  AddInit(app, invocation);
  AddRoom(app, invocation);
  AddDoctor(app, invocation);
  AddBoard(app, invocation);
  AddExplain(app, invocation);
}

}  // namespace luxfit
