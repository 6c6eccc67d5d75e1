#include "apps/cli/describe.h"

#include <CLI/CLI.hpp>

namespace luxfit {
namespace {

OptionDescription Describe(const CLI::Option& option) {
  OptionDescription described;
  for (const std::string& name : option.get_snames()) described.flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) described.flags.push_back("--" + name);
  if (described.flags.empty()) {
    described.is_positional = true;
    described.flags.push_back(option.get_name(true));
  }
  described.takes_value = option.get_items_expected_max() > 0 && option.get_type_size_max() > 0;
  described.is_required = option.get_required();
  described.help = option.get_description();
  return described;
}

}  // namespace

std::vector<CommandDescription> DescribeCommands(const CLI::App& app) {
  std::vector<CommandDescription> commands;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
    CommandDescription described{command->get_name(), command->get_description(), command->get_footer(), {}};
    for (const CLI::Option* const option : command->get_options())
      described.options.push_back(Describe(*option));
    commands.push_back(described);
  }
  return commands;
}

}  // namespace luxfit
