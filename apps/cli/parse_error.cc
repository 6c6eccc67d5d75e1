#include "apps/cli/parse_error.h"

#include <CLI/CLI.hpp>

#include "apps/text/suggest.h"

namespace luxfit {
namespace {

std::vector<std::string> CommandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> FlagsOf(const CLI::App& command) {
  std::vector<std::string> flags;
  for (const CLI::Option* const option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  }
  return flags;
}

const CLI::App* CommandOf(const CLI::App& app, const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument.rfind('-', 0) == 0) continue;
    const auto named = app.get_subcommands([&](const CLI::App* c) { return c->get_name() == argument; });
    return named.empty() ? nullptr : named.front();
  }
  return nullptr;
}

// Returns the first flag that the command does not have; "" where it has all.
std::string UnknownFlag(const CLI::App& command, const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument.rfind("--", 0) != 0 || argument == "--") continue;
    std::string flag = argument.substr(0, argument.find('='));
    if (!command.get_option_no_throw(flag)) return flag;
  }
  return "";
}

std::string FirstWord(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument.rfind('-', 0) != 0) return argument;
  }
  return "";
}

}  // namespace

std::string ParseErrorText(const CLI::App& app, const CLI::ParseError& error,
                           const std::vector<std::string>& arguments) {
  const CLI::App* const command = CommandOf(app, arguments);
  if (!command) {
    const std::string word = FirstWord(arguments);
    if (word.empty())
      return "expected a command (" + ListNames(CommandNames(app), 40) +
             "), got none; `luxfit --help` tells what they do";
    return "expected a command (" + ListNames(CommandNames(app), 40) + "), got " + Quoted(word) +
           DidYouMean(word, CommandNames(app)) + " (`luxfit --help` tells what they do)";
  }
  const std::string help = " (`luxfit " + command->get_name() + " --help` shows an example)";
  const std::string flag = UnknownFlag(*command, arguments);
  if (!flag.empty()) {
    const std::vector<std::string> known = FlagsOf(*command);
    return command->get_name() + ": expected an option (" + ListNames(known) + "), got " + Quoted(flag) +
           DidYouMean(flag, known) + help;
  }
  return command->get_name() + ": " + error.what() + help;
}

}  // namespace luxfit
