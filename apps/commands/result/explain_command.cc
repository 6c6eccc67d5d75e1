#include "apps/commands/result/explain_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "apps/docs_text.h"
#include "apps/session/earlier_result.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/suggest.h"
#include "apps/text/terminal.h"

namespace luxfit {
namespace {

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Holds a line of the format's TOML: `key = value   # what it is`.
struct KeyLine {
  std::string topic, line;
};

bool IsWord(const std::string& text) {
  return !text.empty() &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789") == std::string::npos;
}

std::vector<KeyLine> KeyLines() {
  std::vector<KeyLine> keys;
  std::string section;
  bool in_toml = false;
  for (const std::string& line : LinesOf(kSessionFormatText)) {
    if (line.rfind("```", 0) == 0) {
      in_toml = line == "```toml";
      continue;
    }
    if (!in_toml || line.empty()) continue;
    if (line[0] == '[') {
      section = line.substr(0, line.find(']'));
      section.erase(0, section.find_first_not_of('['));
      continue;
    }
    const std::string key = line.substr(0, line.find(' '));
    if (IsWord(key)) keys.push_back({section.empty() ? key : fmt::format("{}.{}", section, key), line});
  }
  return keys;
}

// Reads the rows of the format's tables, `| key | ... |`.
std::string RowsOn(const std::string& topic) {
  std::string rows;
  for (const std::string& line : LinesOf(kSessionFormatText)) {
    if (line.rfind("| ", 0) == 0 && line.find("`" + topic + "`") != std::string::npos) rows += line + "\n";
  }
  return rows;
}

std::string WarningPage(const std::string& code) {
  std::string text;
  bool is_in = false;
  for (const std::string& line : LinesOf(kWarningsText)) {
    if (line.rfind('#', 0) == 0) {
      is_in = line == "### " + code;
    } else if (is_in && !line.empty()) {
      text += line + "\n";
    }
  }
  return text;
}

std::string Topics() {
  return "luxfit explain CODE, KEY or OUT\n\nwarnings: " + ListNames(ExplainedWarnings(), 1000) +
         "\n\nkeys of the session file: " + ListNames(ExplainedKeys(), 1000) + "\n";
}

// Describes what a result reports, and what it means.
std::string ResultText(const nlohmann::json& result) {
  std::string text;
  if (result.contains("status_because"))
    text = fmt::format("undetermined because of {}\n\n",
                       fmt::join(result["status_because"].get<std::vector<std::string>>(), ", "));
  for (const nlohmann::json& w : result.at("warnings")) {
    const std::string code = w.at("code");
    text += fmt::format("{}: {}\n  here: {}\n  means: {}\n", code, w.at("message").get<std::string>(),
                        w.at("remedy").get<std::string>(), ExplanationOf(code));
  }
  if (result.at("warnings").empty()) text += "no warnings\n";
  text += "\nwhat was chosen, and why:\n";
  for (const nlohmann::json& c : result.at("choices"))
    text += fmt::format("  {}: {}\n      because {}\n", c.at("what").get<std::string>(),
                        c.at("chosen").get<std::string>(), c.at("because").get<std::string>());
  return text;
}

}  // namespace

std::vector<std::string> ExplainedWarnings() {
  std::vector<std::string> codes;
  for (const std::string& line : LinesOf(kWarningsText)) {
    if (line.rfind("### ", 0) == 0) codes.push_back(line.substr(4));
  }
  return codes;
}

std::vector<std::string> ExplainedKeys() {
  std::vector<std::string> topics;
  std::set<std::string> known;
  for (const KeyLine& key : KeyLines()) {
    if (known.insert(key.topic).second) topics.push_back(key.topic);
  }
  return topics;
}

std::string ExplanationOf(const std::string& topic) {
  std::string text = WarningPage(topic);
  for (const KeyLine& key : KeyLines()) {
    const bool is_of_section = key.topic.rfind(topic + ".", 0) == 0;
    if (key.topic == topic) text += key.line + "\n";
    if (is_of_section) text += key.topic + ": " + key.line + "\n";
  }
  return text + (topic.find('.') != std::string::npos ? RowsOn(topic) : "");
}

int ExplainCommand(const ExplainCommandOptions& options) {
  std::string text;
  if (options.topic.empty()) {
    text = Topics();
  } else if (std::filesystem::is_directory(RunFolderOf(options.topic))) {
    text = ResultText(ReadResult(ResultFileOf(options.topic)));
  } else {
    text = ExplanationOf(options.topic);
  }
  if (text.empty()) {
    std::vector<std::string> known = ExplainedWarnings();
    const std::vector<std::string> keys = ExplainedKeys();
    known.insert(known.end(), keys.begin(), keys.end());
    throw std::runtime_error(
        "explain: expected a warning's code, a key such as camera.response, or the folder of "
        "a run, got " +
        Quoted(options.topic) + DidYouMean(options.topic, known) + " (`luxfit explain` lists them)");
  }
  if (options.json) text = JsonText(nlohmann::json{{"topic", options.topic}, {"text", text}});
  PrintText(text);
  return 0;
}

}  // namespace luxfit
