// Says in words what a fit decided and what it could not decide.
//
// Choices carry the candidates and the reason; warnings carry a code (docs/warnings.md), what is wrong and what would fix it.
#ifndef LUXFIT_INVERSE_FIT_FINDINGS_H_
#define LUXFIT_INVERSE_FIT_FINDINGS_H_

#include <string>
#include <vector>

namespace luxfit {

struct Warning {
  std::string code, message, remedy;
};

struct Choice {
  std::string what, chosen;
  std::vector<std::string> among;  // empty: there was no alternative
  std::string because;
};

struct Findings {
  std::vector<Warning> warnings;
  std::vector<Choice> choices;
  bool undetermined = false;  // something that was asked for is not determined by the data
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_FINDINGS_H_
