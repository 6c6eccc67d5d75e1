// Selects the simplest candidate that data left out do not reject: the one-standard-error rule.
//
//   chosen = argmin complexity over { c : score_c - score_best <= max(k SE(c, best), m score_best) }
//
// Among candidates of equal complexity the better one is chosen, among equal ones the first. luxfit chooses
// every model by this rule. SE is the standard error of the difference of two candidates' scores:
//
//   d = (1 / n) sum_g (a_g - b_g)
//   SE^2 = G / (G - 1) * (G - 1) / (G - 3) * sum_g (a_g - b_g - n_g d)^2 / n^2
//
// a_g, b_g: sums of scores over the n_g rows of group g (such as a block of neighbouring places), n rows and G groups in all.
// Residuals of one group share their error and are not independent, so differences are paired by groups. The
// factor (G - 1) / (G - 3) is the variance of Student's t. The standard error is infinite for G <= 3.
//
// Throws std::invalid_argument where no candidate is eligible.
// Source: Breiman, Friedman, Olshen, Stone (1984), "Classification and Regression Trees", sec. 3.4.
#ifndef LUXFIT_INVERSE_SELECT_ONE_STANDARD_ERROR_H_
#define LUXFIT_INVERSE_SELECT_ONE_STANDARD_ERROR_H_

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace luxfit {

struct GroupScore {
  double sum = 0;
  int count = 0;

  // Adds min(z^2, 9) of one row left out; z is its residual over its sigma.
  void Add(double z) {
    sum += std::min(z * z, 9.0);
    ++count;
  }
};
using GroupScores = std::map<int, GroupScore>;  // by group

// Returns the mean score over all rows.
double Mean(const GroupScores& scores);

struct PairedDifference {
  double mean = 0;
  double standard_error = 0;  // infinite for three groups or fewer
};

// Returns the paired difference a - b. Both must have the same groups with the same counts.
PairedDifference Difference(const GroupScores& a, const GroupScores& b);

struct SelectionCandidate {
  GroupScores scores;       // on data left out
  double complexity = 0;    // number of parameters, effective parameters, or rank
  bool is_eligible = true;  // false: listed with its score, never chosen
};

// Share of the best score, for parameters that can absorb errors of others: gains, tables, cells of an emission.
constexpr double kWorthHaving = 0.25;

struct SelectionOptions {
  double standard_errors = 1;  // k
  // m: what a better candidate must gain, as a share of the best score. Errors that repeat from group to
  // group (a pose's, the mesh's) are no evidence, however significant they seem. A share of the score bounds
  // them.
  double worth_having = 0;
  bool keeps_first = false;  // true: keeps the first candidate within the margin, whatever its complexity
};

struct Selection {
  std::size_t best = 0, chosen = 0;  // indices of candidates
  std::vector<double> score,
      standard_error;  // one for each candidate; the error is that of its difference from the best
};

Selection SimplestWithinOneStandardError(const std::vector<SelectionCandidate>& candidates,
                                         const SelectionOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_SELECT_ONE_STANDARD_ERROR_H_
