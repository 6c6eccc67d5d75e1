#include <fmt/format.h>

#include "apps/cli/describe.h"

namespace luxfit {
namespace {

std::string Names(const std::vector<CommandDescription>& commands) {
  std::string names;
  for (const CommandDescription& command : commands) names += (names.empty() ? "" : " ") + command.name;
  return names;
}

std::string FlagsOf(const CommandDescription& command) {
  std::string flags;
  for (const OptionDescription& option : command.options) {
    for (const std::string& flag : option.flags) {
      if (!option.is_positional) flags += (flags.empty() ? "" : " ") + flag;
    }
  }
  return flags;
}

// Escapes text for the single quotes of a zsh option spec.
std::string ZshText(const std::string& help) {
  std::string text;
  for (const char c : help) {
    if (c == '\'') {
      text += "'\\''";
    } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
      text += std::string("\\") + c;
    } else {
      text += c;
    }
  }
  return text;
}

std::string ZshOption(const OptionDescription& option) {
  if (option.is_positional) return fmt::format("'*:{}:_files'", ZshText(option.help));
  const std::string value = option.takes_value ? ":value:_files" : "";
  std::string specs;
  for (const std::string& flag : option.flags)
    specs += fmt::format("{}'{}[{}]{}'", specs.empty() ? "" : " ", flag, ZshText(option.help), value);
  return specs;
}

}  // namespace

std::string BashCompletion(const std::vector<CommandDescription>& commands) {
  std::string cases;
  for (const CommandDescription& command : commands)
    cases += fmt::format("    {}) flags=\"{}\" ;;\n", command.name, FlagsOf(command));
  return fmt::format(R"(# bash completion for luxfit, made by `luxfit completion bash`
_luxfit() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" flags=""
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$word"))
    return
  fi
  case "${{COMP_WORDS[1]}}" in
{}  esac
  if [[ "$word" == -* ]]; then
    COMPREPLY=($(compgen -W "$flags" -- "$word"))
  else
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -F _luxfit luxfit
)",
                     Names(commands), cases);
}

std::string ZshCompletion(const std::vector<CommandDescription>& commands) {
  std::string list, cases;
  for (const CommandDescription& command : commands) {
    list += fmt::format("    '{}:{}'\n", command.name, ZshText(command.help));
    cases += fmt::format("    {})\n      _arguments", command.name);
    for (const OptionDescription& option : command.options) cases += " \\\n        " + ZshOption(option);
    cases += "\n      ;;\n";
  }
  return fmt::format(R"(#compdef luxfit
# zsh completion for luxfit, made by `luxfit completion zsh`
_luxfit() {{
  local -a commands
  commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command="$words[2]"
  shift words
  (( CURRENT-- ))
  case "$command" in
{}  esac
}}
_luxfit "$@"
)",
                     list, cases);
}

}  // namespace luxfit
