// Commands on what a run left in its folder.
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cli/cli.h"
#include "apps/commands.h"

namespace luxfit {
namespace {

void AddCheck(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("check", "measured against predicted luxmeter readings of an earlier run");
  const auto options = std::make_shared<CommandOptions>();
  command->add_option("OUT", options->out, "folder of an earlier run")->required();
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

}  // namespace

void AddResultCommands(CLI::App& app, Invocation& invocation) { AddCheck(app, invocation); }

}  // namespace luxfit
