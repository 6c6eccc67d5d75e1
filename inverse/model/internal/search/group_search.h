// Explains the light of one group by sources, added one at a time and moved in turn, with one set of lobes.
//
// `views` watch the places that it searches; `counts` says by view whether it has a photo of the group's light.
// It holds the sources so far, each with its column of weighted light (inverse/model/internal/search/group_equations.h). Keeps references.
// Units: m; world frame. Source: Boyd, Schiebinger, Recht (2017), "The alternating descent conditional gradient method for
// sparse inverse problems" (add, solve, move).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_GROUP_SEARCH_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_GROUP_SEARCH_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "inverse/model/internal/search/group_equations.h"
#include "inverse/model/internal/search/lobe_trials.h"
#include "inverse/model/internal/search/sparse_luminaires.h"

namespace luxfit {

// Ratio of squares up to which a place explains the light nearly as well as the best. Neighbouring rows share
// their errors, so the few facets do not tell such places apart.
constexpr double kRival = 1.5;

class GroupSearch {
 public:
  GroupSearch(const Room& room, const std::vector<Sensor>& places, const std::vector<Watcher>& views,
              const std::vector<bool>& counts, const Eigen::AlignedBox3d& box,
              const GroupEquations& equations, LobeSet lobes, double step_m, int refinements)
      : room_(room),
        places_(places),
        views_(views),
        box_(box),
        equations_(equations),
        trials_(equations, places, step_m, counts),
        lobes_(lobes),
        step_m_(step_m),
        refinements_(refinements) {}

  void Start(const SparseSource& source);

  // Adds a source about a place of the grid, or at a place seen. Returns false where it explains nothing
  // more.
  bool AddOne(const LitPlaces& grid, const LitPlaces& seen);

  // Moves the sources in turn, so that earlier ones and the new one adapt to each other: coarsely as often as
  // it helps, then finely once.
  void MoveAll();

  // Chooses the lobe of each source anew, at its place, now that the others explain their light.
  void TurnAll();

  // Chooses anew the lobe of each source that photos show, at its place: those that shine down and, in mid-air, also those to both
  // sides and to all. Turned ones would explain light of luminaires that are still missing; those that are turned stay so.
  void ReshapeSeen();

  // Returns other places for one source that explain the light nearly as well, best first.
  std::vector<Tried> RivalsOf(size_t source, const LitPlaces& grid) const;

  Eigen::MatrixXd Columns() const { return Others(sources_.size()); }
  GroupEquations::Solution Solve() const { return equations_.Solve(Columns()).solution; }
  // Returns the mean square that the sources leave of other rows, or of the same ones with other weights.
  double MeanSquareIn(const GroupEquations& others) const;
  const std::vector<Tried>& sources() const { return sources_; }
  bool is_held(size_t source) const { return kind_[source].is_held; }
  bool is_seen(size_t source) const { return kind_[source].is_seen; }
  bool stays(size_t source) const { return is_held(source) || is_seen(source); }

 private:
  LobeSet AtKnownPlace() const { return lobes_ == LobeSet::kSimple ? LobeSet::kOfKnownPlaces : lobes_; }

  LitPlaces LitFrom(const Tried& source) const {
    return LitAlong(room_, places_, source.position, source.half_length);
  }

  bool IsInMidAir(const Eigen::Vector3d& place) const;

  // Returns whether the place is off all luminaires that photos show: one place that they show is one luminaire.
  bool IsFree(const Eigen::Vector3d& place) const;

  // Returns the columns of all sources but one.
  Eigen::MatrixXd Others(size_t without) const;

  // Refines the best of each bin by itself: on the coarse grid a wrong lobe may win, with the height wrong to
  // match. Aimed lobes are many; after each step only the better half of them goes on.
  std::vector<Tried> RefinedBins(std::vector<Tried> bins, const Eigen::MatrixXd& rest) const;

  // Returns the lobes to try about a source, the step halved `halvings` times.
  std::vector<Lobe> LobesAbout(const Lobe& lobe, int halvings) const;

  // Refines a source about its place, the step halved `halvings` times: with its own lobe or, where `any_lobe`, with
  // any simple one. Aimed lobes turn and change their width beside.
  Tried Refined(const Tried& source, int halvings, const Eigen::MatrixXd& rest, bool any_lobe) const;

  // Refines aim and width of a source, and leaves it at its place.
  Tried TurnedInPlace(Tried source, const Eigen::MatrixXd& rest) const;

  bool MoveEach(int from_halvings, int to_halvings);

  const Room& room_;
  const std::vector<Sensor>& places_;
  const std::vector<Watcher>& views_;
  const Eigen::AlignedBox3d& box_;
  const GroupEquations& equations_;
  LobeTrials trials_;
  LobeSet lobes_;
  double step_m_;
  int refinements_;
  std::vector<Tried> sources_;
  struct Kind {
    bool is_held = false, is_seen = false;
  };
  std::vector<Kind> kind_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_GROUP_SEARCH_H_
