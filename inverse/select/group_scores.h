// Compares predictions by their errors on data left out, group by group.
//
//   d = (1 / n) sum_g (a_g - b_g),   SE^2 = G / (G - 1) * (G - 1) / (G - 3) * sum_g (a_g - b_g - n_g d)^2 / n^2
//
// a_g, b_g: sums of scores over the n_g rows of group g (a facet, or a reading), n rows and G groups in all. Residuals of
// one group share their error and are no independent evidence: differences are therefore paired by groups. The factor
// (G - 1) / (G - 3) is the variance of Student's t.
#ifndef LUXFIT_INVERSE_SELECT_GROUP_SCORES_H_
#define LUXFIT_INVERSE_SELECT_GROUP_SCORES_H_

#include <map>

namespace luxfit {

struct GroupScore {
  double sum = 0;
  int count = 0;
};
using GroupScores = std::map<int, GroupScore>;  // by group

// Over all rows.
double Mean(const GroupScores& scores);

struct PairedDifference {
  double mean = 0;
  double standard_error = 0;  // infinite for three groups and fewer
};

// Of a - b. Both have the same groups with the same counts.
PairedDifference Difference(const GroupScores& a, const GroupScores& b);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_SELECT_GROUP_SCORES_H_
