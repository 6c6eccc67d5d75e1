// `luxfit explain`: a warning's code, a key of the session file, or a whole result, in words.
//
// What it says is docs/warnings.md and docs/session-format.md themselves, which are part of the program.
//
// Throws std::runtime_error with the nearest known topic for a word that neither knows.
#ifndef LUXFIT_APPS_COMMANDS_EXPLAIN_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_EXPLAIN_COMMAND_H_

#include <string>
#include <vector>

namespace luxfit {

struct ExplainCommandOptions {
  std::string topic;  // a code, a key such as camera.response, or OUT; empty: what there is
  bool json = false;
};
int ExplainCommand(const ExplainCommandOptions& options);

// Codes of docs/warnings.md, in its order.
std::vector<std::string> ExplainedWarnings();

// Keys of docs/session-format.md with their sections: "camera.response".
std::vector<std::string> ExplainedKeys();

// The text on one; empty where there is none.
std::string ExplanationOf(const std::string& topic);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_EXPLAIN_COMMAND_H_
