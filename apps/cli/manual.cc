#include <fmt/format.h>

#include <cctype>
#include <sstream>

#include "apps/cli/describe.h"

namespace luxfit {
namespace {

// Escapes text for roff: no line becomes a request, no character an escape.
std::string Roff(const std::string& text) {
  std::string escaped;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
    at_start = c == '\n';
  }
  return escaped;
}

std::string Upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string Title(const std::string& name, const std::string& version) {
  return fmt::format(".TH \"{}\" 1 \"\" \"luxfit {}\" \"luxfit\"\n", Upper(name), version);
}

std::string OptionText(const OptionDescription& option) {
  std::string flags = fmt::format("{}", fmt::join(option.flags, ", "));
  if (option.takes_value && !option.is_positional) flags += " VALUE";
  return fmt::format(".TP\n\\fB{}\\fR\n{}{}\n", Roff(flags), Roff(option.help),
                     option.is_required ? " (required)" : "");
}

// "Example:\n  $ typed\n  output"
std::string ExampleText(const std::string& example) {
  if (example.empty()) return "";
  std::istringstream lines(example);
  std::string line, text = ".SH EXAMPLE\n.nf\n";
  std::getline(lines, line);
  while (std::getline(lines, line)) text += Roff(line) + "\n";
  return text + ".fi\n";
}

std::string Statuses() {
  return ".SH EXIT STATUS\n"
         "0: done; 1: the data do not determine what was asked (the reason is in the warnings, what is "
         "determined "
         "is written); 2: bad input; 3: a program that is needed is missing; 70: a defect of luxfit.\n";
}

}  // namespace

std::string OverviewManual(const std::vector<CommandDescription>& commands, const std::string& about,
                           const std::string& version) {
  std::string text = Title("luxfit", version) + ".SH NAME\nluxfit \\- " + Roff(about) +
                     "\n.SH SYNOPSIS\n\\fBluxfit\\fR COMMAND [OPTIONS]\n.SH COMMANDS\n";
  std::string also;
  for (const CommandDescription& command : commands) {
    text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", Roff(command.name), Roff(command.help));
    also += fmt::format("{}.BR luxfit\\-{} (1)", also.empty() ? "" : ",\n", command.name);
  }
  return text + Statuses() + ".SH SEE ALSO\n" + also + "\n";
}

std::string CommandManual(const CommandDescription& command, const std::string& version) {
  std::string text = Title("luxfit-" + command.name, version) + ".SH NAME\nluxfit\\-" + command.name +
                     " \\- " + Roff(command.help) + "\n.SH SYNOPSIS\n\\fBluxfit " + command.name + "\\fR";
  std::string options;
  for (const OptionDescription& option : command.options) {
    if (option.is_positional)
      text += option.is_required ? " " + option.flags[0] : " [" + option.flags[0] + "]";
    options += OptionText(option);
  }
  return text + " [OPTIONS]\n.SH OPTIONS\n" + options + ExampleText(command.example) + Statuses() +
         ".SH SEE ALSO\n.BR luxfit (1)\n";
}

}  // namespace luxfit
