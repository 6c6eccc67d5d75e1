// Adds the commands on the results that a run left in its folder.
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cli/cli.h"
#include "apps/commands/commands.h"
#include "apps/commands/result/report_command.h"

namespace luxfit {
namespace {

void AddCheck(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("check", "measured against predicted luxmeter readings of an earlier run");
  const auto options = std::make_shared<CheckCommandOptions>();
  AddRunFolder(*command, options->out);
  command->add_option("--subset", options->subset,
                      "a row for the readings of this pattern too: id or id@state, * for any text");
  AddJson(*command, options->json);
  AddThreads(*command, invocation);
  command->final_callback(
      [&invocation, options] { invocation.run = [options] { return CheckCommand(*options); }; });
  AddExample(*command, "luxfit check out --subset '*@all'",
             "of           readings  mean lx   mean error %   mean |error| lx   % of mean   largest %\n"
             "L1                  6    135.3          +0.85              1.17        0.87        2.92\n"
             "...\n"
             "*@all               7    319.1          +0.67              2.49        0.78        1.47\n"
             "no reading disagrees: |z| stays below 3.27, the limit for so many readings");
}

void AddReport(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("report", "one self-contained HTML page of an earlier run or calibration");
  const auto options = std::make_shared<ReportCommandOptions>();
  AddRunFolder(*command, options->out);
  command->add_option("--session", options->session, "the session file, if it has moved since the run");
  command->add_option("--targets", options->targets, "areas and observers with their requirements (TOML)");
  command->add_option("--state", options->state, "the state shown first (default: the brightest)");
  AddJson(*command, options->json);
  AddThreads(*command, invocation);
  command->final_callback([&invocation, options] {
    options->command_line = invocation.command_line;
    invocation.run = [options] { return ReportCommand(*options); };
  });
  AddExample(
      *command, "luxfit report out",
      "Work plane, state all: 40 points, mean 346.4 ± 14 lx, least 248.6 ± 9.9 lx, U0 0.7178 ± 0.0044\n"
      "done      3.0 s, out/report.html, 3.3 MB");
}

}  // namespace

void AddResultCommands(CLI::App& app, Invocation& invocation) {
  AddCheck(app, invocation);
  AddReport(app, invocation);
}

}  // namespace luxfit
