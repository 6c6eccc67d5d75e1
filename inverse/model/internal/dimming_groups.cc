#include "inverse/model/internal/dimming_groups.h"

namespace luxfit {

DimmingGroups GroupByDimming(const Eigen::MatrixXd& dimming) {
  DimmingGroups found{{}, Eigen::MatrixXd(dimming.rows(), 0)};
  for (Eigen::Index k = 0; k < dimming.cols(); ++k) {
    const double most = dimming.rows() > 0 ? dimming.col(k).maxCoeff() : 0;
    if (most == 0) continue;  // never seen
    const Eigen::VectorXd own = dimming.col(k) / most;
    Eigen::Index g = 0;
    while (g < found.dimming.cols() && !found.dimming.col(g).isApprox(own, 1e-6)) ++g;
    if (g == found.dimming.cols()) {
      found.groups.emplace_back();
      found.dimming.conservativeResize(Eigen::NoChange, g + 1);
      found.dimming.col(g) = own;
    }
    found.groups[static_cast<size_t>(g)].luminaires.push_back(static_cast<int>(k));
    found.groups[static_cast<size_t>(g)].share.push_back(most);
  }
  return found;
}

DimmingGroups GroupByDimming(const std::vector<Eigen::VectorXd>& dimming) {
  const Eigen::Index luminaires = dimming.empty() ? 0 : dimming.front().size();
  Eigen::MatrixXd table(static_cast<Eigen::Index>(dimming.size()), luminaires);
  for (Eigen::Index s = 0; s < table.rows(); ++s) table.row(s) = dimming[static_cast<size_t>(s)].transpose();
  return GroupByDimming(table);
}

}  // namespace luxfit
