// Tests tables of dimming by light that adds: no room, no reflectance and no light model is needed.
//
//   Y_s = sum_k d_sk B_k                            an element in one view; B_k: what luminaire k gives there, free
//   z^2 = min_B sum_s ((Y_s - sum_k d_sk B_k) / sigma_s)^2 / (states - rank d)
//   sigma_s^2 = noise + (e Y_s)^2                   e: error of a photo's exposure
//
// It is exact for every surface, gloss and mirrors included, because the view is the same in all states. e comes from the
// scatter of the photos' offsets (photo_offsets.h), at least 1 %; of fewer than three views it is 5 %.
// Source: superposition; the photos' own scatter is the house's.
#ifndef LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_SUPERPOSED_COLUMNS_H_
#define LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_SUPERPOSED_COLUMNS_H_

#include <Eigen/Core>
#include <vector>

#include "forward/room/patches.h"
#include "inverse/observe/observe.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {

// Holds the elements of each view that show in all photographed states.
struct SuperposedColumns {
  std::vector<int> states;           // those photographed, in their order: one for each row
  Eigen::MatrixXd luminance, sigma;  // states x columns
  std::vector<int> patch;            // by column
};

SuperposedColumns ColumnsOf(const Patches& patches, const std::vector<Observation>& observations);

int RankOf(const Eigen::MatrixXd& dimming);

struct SuperpositionScore {
  GroupScores scores;              // by patch
  double relative_difference = 0;  // rms over columns and states, of (Y_s - sum_k d_sk B_k) / Y_s
};
// `dimming`: rows as the columns' states, by luminaire; its rank is below their number.
SuperpositionScore ScoreOf(const SuperposedColumns& columns, const Eigen::MatrixXd& dimming);

// Returns B of all columns by all states but `left_out`, luminaires x columns. `dimming` has full rank without that row.
Eigen::MatrixXd LightWithout(const SuperposedColumns& columns, const Eigen::MatrixXd& dimming,
                             Eigen::Index left_out);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_SUPERPOSED_COLUMNS_H_
