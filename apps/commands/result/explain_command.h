// Runs `luxfit explain`: explains a warning's code, a key of the session file, or a whole result.
//
// Its texts are docs/warnings.md and docs/session-format.md themselves, which are part of the program.
//
// Throws std::runtime_error with the nearest known topic for a word that neither contains.
#ifndef LUXFIT_APPS_COMMANDS_RESULT_EXPLAIN_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_RESULT_EXPLAIN_COMMAND_H_

#include <string>
#include <vector>

namespace luxfit {

struct ExplainCommandOptions {
  std::string topic;  // a code, a key such as camera.response, or OUT; empty: list all
  bool json = false;
};
int ExplainCommand(const ExplainCommandOptions& options);

// Returns the codes of docs/warnings.md, in its order.
std::vector<std::string> ExplainedWarnings();

// Returns the keys of docs/session-format.md with their sections: "camera.response".
std::vector<std::string> ExplainedKeys();

// Returns the text on one of them; empty where there is none.
std::string ExplanationOf(const std::string& topic);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_RESULT_EXPLAIN_COMMAND_H_
