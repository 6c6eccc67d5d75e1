// Tries lobes at places: how far a group's squares fall with one more source there.
//
// Sets of lobes that are tried (inverse/model/internal/search/lobes.h):
// - simple ones, the same at every place, or those of known places;
// - aimed ones, towards the brightest places whose light is unexplained, or of the aims over the sphere whose
//   half-peak cone contains such a place. All other aims are contradicted: the brightest place lies in a beam.
//
// Lobes that photos would show and do not (inverse/model/internal/search/watched_places.h) are left out at places whose views are known.
//
// Lobes are sorted into bins: one for each simple lobe, or one for each width and bright place. Gains rank all, and
// the most promising of each bin are solved exactly. So no bin hides another, whose better lobe the coarse grid
// misses.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LOBE_TRIALS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LOBE_TRIALS_H_

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <vector>

#include "inverse/model/internal/search/group_equations.h"
#include "inverse/model/internal/search/lit_places.h"

namespace luxfit {

enum class LobeSet { kSimple, kOfKnownPlaces, kAimed };

struct Tried {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Lobe lobe;
  Eigen::Vector3d half_length = Eigen::Vector3d::Zero();  // as LitPlace has it
  Eigen::VectorXd column;                                 // weighted
  double cost = std::numeric_limits<double>::infinity();
};
inline bool IsBetter(const Tried& a, const Tried& b) { return a.cost < b.cost; }

// Returns the better ones first.
std::vector<Tried> Sorted(std::vector<Tried> tried);

using AllowedPlaces = std::function<bool(const Eigen::Vector3d&)>;

class LobeTrials {
 public:
  // Keeps references. `apart_m`: least distance of two bright places. `counts`: by view, whether it has a photo of the group's light.
  LobeTrials(const GroupEquations& equations, const std::vector<Sensor>& sensors, double apart_m,
             const std::vector<bool>& counts)
      : equations_(equations), sensors_(sensors), apart_m_(apart_m), counts_(counts) {}

  // Returns the best of the allowed places for every bin that has any, in the order of bins. `others`: the columns of
  // all other sources.
  std::vector<Tried> BestOfBins(LobeSet set, const Eigen::MatrixXd& others, const LitPlaces& places,
                                const AllowedPlaces& allowed = {}) const;

  // Returns the best of one list of lobes at any of the places; an infinite cost where none helps.
  Tried Best(const std::vector<Lobe>& lobes, const Eigen::MatrixXd& others, const LitPlaces& places) const;

 private:
  struct BinnedLobes {
    std::vector<Lobe> lobes;
    std::vector<size_t> bin;  // one for each
  };
  using LobesAt = std::function<BinnedLobes(const LitPlace&)>;

  std::vector<Tried> BestOf(const LobesAt& lobes_at, size_t bins, const GroupEquations::Base& base,
                            const LitPlaces& places, const AllowedPlaces& allowed) const;
  std::vector<Eigen::Index> BrightSensors(const GroupEquations::Base& base) const;
  static BinnedLobes AimedLobes(const LitPlace& place, const std::vector<Eigen::Index>& bright);

  const GroupEquations& equations_;
  const std::vector<Sensor>& sensors_;
  double apart_m_;
  const std::vector<bool>& counts_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LOBE_TRIALS_H_
