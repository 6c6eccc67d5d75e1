// Lists how a table of states is mistaken: each a table that is otherwise in one place.
//
//   one dimming value x of luminaires that are always alike, chosen by the photos:
//     x = median_(e, v) (d_sk + (Y_s - sum_j d_sj B_j) / B_k), weighted by B_k / sigma_s      B: of all other states
//   two states written for each other
//   two luminaires written for each other in one state
//   all of a state by a factor f = median (Y_s / sum_j d_sj B_j): dimming or exposures
//
// A state of one luminaire has a factor alone: the list has its dimming value once, as that factor. Values are at most
// 1. The list leaves out values that change by less than a tenth: dimmers are no more exact.
#ifndef LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_TABLE_MISTAKE_H_
#define LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_TABLE_MISTAKE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "inverse/observe/as_if/internal/superposed_columns.h"
#include "inverse/observe/as_if/states_as_if.h"

namespace luxfit {

struct TableMistake {
  std::string as_if, remedy;
  Eigen::MatrixXd dimming;         // as it would be; rows as the columns' states
  bool is_of_whole_state = false;  // a factor, which exposures may have, too
};

// `dimming`: as given; rows as the columns' states.
std::vector<TableMistake> TableMistakes(const StateTable& table, const SuperposedColumns& columns,
                                        const Eigen::MatrixXd& dimming);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_TABLE_MISTAKE_H_
