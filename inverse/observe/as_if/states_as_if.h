// Finds what a table of states gets wrong, where the photos of some states do not add up to those of others.
//
//   Y_s = sum_k d_sk B_k        as given, and with one mistake undone (inverse/observe/as_if/internal/table_mistake.h):
//                               one dimming value is another one; two states, or two luminaires of a state, are exchanged;
//                               all of a state is off by a factor
//   score = mean min(z^2, 9), by patch      inverse/observe/as_if/internal/superposed_columns.h
//
// No light is fitted: what each luminaire gives to an element in a view is free. A mistake holds where it contradicts the
// table as given (inverse/select/contradicted.h), its own score is below 3, and a value that it frees differs by a tenth.
// Those that the best one does not contradict, or whose score is what chance gives, are returned beside it: they explain
// the photos equally.
//
// A state all of whose photos are off by one factor may be dimmed otherwise, or its exposures are wrong. Where that alone
// explains the photos, nothing is returned: self-calibration takes it out, and either way the fluxes are right.
//
// Photos may still not add up once their exposures are corrected (by 5 %, score above 3), and no mistake explains it. The cause
// is then one that the table cannot state: a luminaire of several on one switch was off in a state, or lamps warmed up.
// Each state then stands by itself.
//
// A tone curve looks like states that do not add up. Where the photos, decoded from sRGB, add up by the table as given, and with a
// lower score than any mistake has, nothing is returned: self-calibration finds the curve (`response_not_linear`).
//
// Tells nothing where the table has as many independent states as states. Another tone curve in the photos hides mistakes.
// Source: superposition of light; the rule's.
#ifndef LUXFIT_INVERSE_OBSERVE_AS_IF_STATES_AS_IF_H_
#define LUXFIT_INVERSE_OBSERVE_AS_IF_STATES_AS_IF_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "forward/room/patches.h"
#include "inverse/observe/observe.h"

namespace luxfit {

struct StateTable {
  std::vector<std::string> states, luminaires;
  std::vector<Eigen::VectorXd> dimming;  // one vector for each state, by luminaire
};

struct StateExplanation {
  std::string as_if;                     // completes "the photos look as if ..."
  std::string remedy;                    // a clause without a full stop
  std::vector<Eigen::VectorXd> dimming;  // as it would be; of states by themselves a column for each state
  // By how much the photos differ from what adds up, relative, rms: by the table as given, and so read. States by
  // themselves differ from nothing: 0.
  double difference_as_given = 0, difference = 0;

  bool IsOfTable() const { return difference > 0; }  // another table; false: states by themselves
};

// Returns the explanations that hold, the best first. `decoded`: the same observations as they are where their photos are
// encoded in sRGB; empty: they are not. Throws std::invalid_argument for names and dimming of different numbers, and for
// a state out of range.
std::vector<StateExplanation> FindStatesAsIf(const Patches& patches,
                                             const std::vector<Observation>& observations,
                                             const StateTable& table,
                                             const std::vector<Observation>& decoded = {});

// Returns that each state stands by itself where the photos do not add up, else nothing. `observations`: with exposures
// and response corrected by the table, which no mistake explains. Throws as FindStatesAsIf.
std::optional<StateExplanation> StatesByThemselves(const Patches& patches,
                                                   const std::vector<Observation>& corrected,
                                                   const StateTable& table);

// Says in one sentence, without a full stop, what explains the photos. `explanations`: one or more.
std::string InWords(const std::vector<StateExplanation>& explanations);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_AS_IF_STATES_AS_IF_H_
