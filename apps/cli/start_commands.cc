// Commands for the beginning, before there is a session.
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/board_command.h"
#include "apps/cli/cli.h"
#include "apps/explain_command.h"

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
  size("--tag-size", options.tag_size_m, "aprilgrid, tags: side of a black square, m (default: what fits)");
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
      "Photos alone give fluxes up to one common factor. Positions, distributions and reflectances stand; "
      "lumens and lux do not.\n"
      "Mend: name one luxmeter reading in `luxmeter.scale`, or ...");
}

}  // namespace

void AddStartCommands(CLI::App& app, Invocation& invocation) {
  AddBoard(app, invocation);
  AddExplain(app, invocation);
}

}  // namespace luxfit
