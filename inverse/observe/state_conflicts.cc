#include "inverse/observe/state_conflicts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxfit {
namespace {

constexpr double kLargestSigmaM = 0.15;  // a vaguer place may be anything's
constexpr double kLeastReachM = 0.05;    // error of the fitted place

class ConflictSearch {
 public:
  ConflictSearch(const std::vector<Luminaire>& luminaires, const std::vector<Eigen::VectorXd>& dimming)
      : luminaires_(luminaires), dimming_(dimming) {}

  void Add(const SeenPlace& place, int luminaire, std::vector<StateConflict>& found) const {
    double lowest = std::numeric_limits<double>::infinity();  // at which it is bright
    for (const int s : place.states) {
      if (Factor(s, luminaire) > 0) lowest = std::min(lowest, Factor(s, luminaire));
    }
    if (!std::isfinite(lowest)) return;
    for (const int s : place.states) {
      if (!(Factor(s, luminaire) > 0) && !ShinesAnother(place, s)) found.push_back({luminaire, s, true});
    }
    for (const int s : place.dark_states) {
      if (Factor(s, luminaire) >= lowest) found.push_back({luminaire, s, false});
    }
  }

  bool IsNear(const SeenPlace& place, int luminaire) const {
    const double reach_m = std::max(kLeastReachM, 3 * place.sigma_m);
    return place.sigma_m <= kLargestSigmaM &&
           (luminaires_[static_cast<size_t>(luminaire)].position - place.position).norm() <= reach_m;
  }

 private:
  double Factor(int state, int luminaire) const { return dimming_[static_cast<size_t>(state)][luminaire]; }

  bool ShinesAnother(const SeenPlace& place, int state) const {
    for (int k = 0; k < static_cast<int>(luminaires_.size()); ++k) {
      if (Factor(state, k) > 0 && IsNear(place, k)) return true;
    }
    return false;
  }

  const std::vector<Luminaire>& luminaires_;
  const std::vector<Eigen::VectorXd>& dimming_;
};

}  // namespace

std::vector<StateConflict> FindStateConflicts(const std::vector<SeenPlace>& seen,
                                              const std::vector<Luminaire>& luminaires,
                                              const std::vector<Eigen::VectorXd>& dimming) {
  const ConflictSearch search(luminaires, dimming);
  std::vector<StateConflict> found;
  for (int k = 0; k < static_cast<int>(luminaires.size()); ++k) {
    // The place that most views saw; FindSeenLuminaires lists it first.
    const auto own = std::find_if(seen.begin(), seen.end(),
                                  [&](const SeenPlace& place) { return search.IsNear(place, k); });
    if (own != seen.end()) search.Add(*own, k, found);
  }
  return found;
}

}  // namespace luxfit
