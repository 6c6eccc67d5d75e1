#include "inverse/select/contradicted.h"

namespace luxfit {

bool IsContradicted(const GroupScores& given, const GroupScores& rival) {
  SelectionOptions options;
  options.standard_errors = 2;
  options.worth_having = 1;
  return SimplestWithinOneStandardError({{given, 0, true}, {rival, 1, true}}, options).chosen == 1;
}

}  // namespace luxfit
