// Explains why a command line does not parse: what was expected, what was given, the nearest name, and how to
// get help.
#ifndef LUXFIT_APPS_CLI_PARSE_ERROR_H_
#define LUXFIT_APPS_CLI_PARSE_ERROR_H_

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace luxfit {

// `arguments` are as typed, without the program's name.
std::string ParseErrorText(const CLI::App& app, const CLI::ParseError& error,
                           const std::vector<std::string>& arguments);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CLI_PARSE_ERROR_H_
