// Groups luminaires whose dimming is in one proportion in all states: no sum of states tells them apart.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_DIMMING_GROUPS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_DIMMING_GROUPS_H_

#include <Eigen/Core>
#include <vector>

namespace luxfit {

struct LuminaireGroup {
  std::vector<int> luminaires;
  std::vector<double> share;  // one for each: its dimming over the group's
};

struct DimmingGroups {
  std::vector<LuminaireGroup> groups;  // without luminaires that are never on
  Eigen::MatrixXd dimming;             // states x groups, largest value 1
};

// `dimming`: states x luminaires, or the luminaires' dimming of each state.
DimmingGroups GroupByDimming(const Eigen::MatrixXd& dimming);
DimmingGroups GroupByDimming(const std::vector<Eigen::VectorXd>& dimming);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_DIMMING_GROUPS_H_
