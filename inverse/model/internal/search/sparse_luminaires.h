// Finds point luminaires that explain a group's light, by sparse non-negative least squares over places.
//
//   sum_j g_j D_ij + I_i = q_m(i) Y_i     photos: g_j = c Phi_j / pi, q = 1 / albedo of the place's material
//   sum_j g_j D_ij + b   = E_i            readings alone: g_j = Phi_j
//
// The equations are those of inverse/model/internal/search/group_equations.h.
//
// D: direct illuminance per lumen. Places are the cells of a grid through the room, with lobes at each.
// Luminaires are added one at a time, each where the remaining squares fall most with all other unknowns
// solved anew. Halving the grid about the place refines it; the other places are refined in turn.
//
// Simple lobes come first. Where they leave more than 2 % rms of the light in the beam, lobes of any aim are searched too
// (inverse/model/internal/search/lobes.h), refined in place, aim and width at once. They are kept where simple ones
// leave half more squares, or explain less than half as much.
//
// For robustness the search runs twice. The second run lowers the weight of rows that the first did not
// explain (GroupEquations::Reweigh). Distances are in m.
//
// Sources: Lawson and Hanson (1974), ch. 23 (NNLS); Boyd, Schiebinger, Recht (2017), "The alternating descent
// conditional gradient method for sparse inverse problems" (add, solve, move).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_SPARSE_LUMINAIRES_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_SPARSE_LUMINAIRES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "inverse/model/internal/search/grouped_light.h"
#include "inverse/model/internal/search/lit_places.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

struct SparseSource {
  Luminaire luminaire;  // position, aim, distribution; of a lobe to both sides, that of the lower one
  Lobe lobe;
  double strength = 0;  // g
  bool is_held = false;
  bool is_seen = false;  // it stays where photos show it
  // Leads from the middle of a source that photos show to one of its ends, m. No other source lies within 0.3 m of the line between
  // the ends.
  Eigen::Vector3d half_length = Eigen::Vector3d::Zero();
  // Luminaires at other places, at least a grid step away. Those of the places seen alone come first, then
  // those that leave less than half more squares, best first, then what the same search found with the other set of lobes.
  std::vector<Luminaire> rivals;
};

struct SparseLuminaires {
  std::vector<SparseSource> sources;
  std::map<int, double> albedo;  // by material, from photos
  double mean_square = 0;        // mean square of the weighted residuals: 1 is 10 %
  bool was_searched = true;      // false: only the places seen were tried
  bool is_aimed = false;         // true: lobes of any aim
};

class SparseSearch {
 public:
  // Traces the grid's light once for all groups, when it is first needed. Keeps references. Not to be shared
  // by threads. `views`: no source is found where these would show it (watched_places.h).
  SparseSearch(const Room& room, const GroupedLight& light, std::vector<Watcher> views, double grid_m,
               int refinements);
  ~SparseSearch();
  SparseSearch(const SparseSearch&) = delete;
  SparseSearch& operator=(const SparseSearch&) = delete;

  // Explains the light of one group by `count` luminaires, `start` among them; held ones stay where they are.
  // Returns fewer sources where no more would help, and none where fewer than 20 places show the group's
  // light.
  //
  // Where the sure places `seen` in photos that are alike are as many as luminaires are to be found, these are the
  // answer (alike_places.h). So are two sure places and more that are no more than these, where luminaires that shine down
  // there leave less than half more squares than a search anywhere. Else places seen are tried first, unmoved. Where `count` sources there leave less than 5 % rms of
  // the light unexplained, nothing else is searched. Else the sources at sure places stay, and the search adds
  // what is missing: where the mesh is wrong about something, places in mid-air explain the light a little better
  // than the true ones. Sources of a search anywhere are their rivals; they are kept where they leave less than two
  // thirds of the squares. `searches_on` is asked before anything but `start` and the seen places is tried: false
  // leaves it at them.
  SparseLuminaires Find(int group, int count, const std::vector<SparseSource>& start = {},
                        const std::vector<SeenPlace>& seen = {},
                        const std::function<bool()>& searches_on = {}) const;

 private:
  const LitPlaces& Grid() const;

  const Room& room_;
  const GroupedLight& light_;
  std::vector<Watcher> views_;
  int refinements_;
  Eigen::AlignedBox3d box_;
  double step_m_;
  mutable std::unique_ptr<LitPlaces> grid_;  // traced when first needed
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_SPARSE_LUMINAIRES_H_
