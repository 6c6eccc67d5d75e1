#include "inverse/model/internal/search/sparse_luminaires.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "inverse/model/internal/search/group_equations.h"

namespace luxfit {
namespace {

// Returns the room's box; without a mesh, the sensors' box enlarged by its own size to every side.
Eigen::AlignedBox3d SearchBox(const Room& room, const std::vector<Sensor>& places) {
  Eigen::AlignedBox3d box = room.scene.Bounds();
  if (!box.isEmpty()) return box;
  for (const Sensor& place : places) box.extend(place.position);
  if (box.isEmpty()) return box;
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(box.sizes().maxCoeff());
  return {box.min() - margin, box.max() + margin};
}

// Mean square of the weighted residuals (1: 10 %) below which places seen in photos need no comparison with
// others: 5 %. Half a metre off, no lobe explains a room's light so well.
constexpr double kExplained = 0.25;

// Ratio of squares up to which a place explains the light nearly as well as the best. Neighbouring rows share
// their errors, so the few facets do not tell such places apart.
constexpr double kRival = 1.5;

struct Tried {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  size_t lobe = 0;
  Eigen::VectorXd column;  // weighted
  double cost = std::numeric_limits<double>::infinity();
};

bool IsBetter(const Tried& a, const Tried& b) { return a.cost < b.cost; }

using Allowed = std::function<bool(const Eigen::Vector3d&)>;

bool Anywhere(const Eigen::Vector3d&) { return true; }

// Returns the best of the allowed places for every lobe.
std::vector<Tried> BestOfLobes(const GroupEquations& equations, const Eigen::MatrixXd& others,
                               const LitPlaces& places, const Allowed& allowed = Anywhere) {
  const GroupEquations::Base base = equations.Solve(others);
  const size_t lobes = Lobes().size();
  const auto column_of = [&](size_t place, size_t lobe) {
    return equations.Weighted(places.columns[place].col(static_cast<Eigen::Index>(lobe)));
  };
  std::vector<std::vector<std::pair<double, size_t>>> gains(lobes);  // gain, place
  for (std::vector<std::pair<double, size_t>>& of_lobe : gains) of_lobe.resize(places.positions.size());
  tbb::parallel_for(size_t{0}, places.positions.size(), [&](size_t i) {
    const bool counts = allowed(places.positions[i]);
    for (size_t l = 0; l < lobes; ++l)
      gains[l][i] = {counts ? GroupEquations::Gain(base, column_of(i, l)) : 0, i};
  });
  constexpr size_t kExact = 6;  // places of each lobe, the most promising
  std::vector<Tried> best(lobes);
  tbb::parallel_for(size_t{0}, lobes, [&](size_t l) {
    const auto end =
        gains[l].begin() + static_cast<std::ptrdiff_t>(std::min(kExact, places.positions.size()));
    std::partial_sort(gains[l].begin(), end, gains[l].end(), std::greater<>());
    best[l].lobe = l;
    for (auto promising = gains[l].begin(); promising != end; ++promising) {
      if (!(promising->first > 0)) continue;
      const Eigen::VectorXd column = column_of(promising->second, l);
      const GroupEquations::Solution solution = equations.SolveWith(base, column);
      if (!(solution.strength[solution.strength.size() - 1] > 0) || solution.cost >= best[l].cost) continue;
      best[l] = {places.positions[promising->second], l, column, solution.cost};
    }
  });
  return best;
}

// Returns the places of the cell about a place, in half steps.
std::vector<Eigen::Vector3d> Neighbours(const Eigen::Vector3d& centre, double step,
                                        const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d inner = Eigen::Vector3d::Constant(5e-3);
  std::vector<Eigen::Vector3d> places;
  places.reserve(27);
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3d offset = Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).cast<double>();
    places.push_back((centre + step * offset).cwiseMax(box.min() + inner).cwiseMin(box.max() - inner));
  }
  return places;
}

// Searches the sources of one group. It holds the sources so far, each with its column.
class GroupSearch {
 public:
  GroupSearch(const Room& room, const std::vector<Sensor>& places, const Eigen::AlignedBox3d& box,
              const GroupEquations& equations, double step_m, int refinements)
      : room_(room),
        places_(places),
        box_(box),
        equations_(equations),
        step_m_(step_m),
        refinements_(refinements) {}

  void Start(const SparseSource& source) {
    const LitPlaces here = Lit(room_, places_, {source.luminaire.position});
    Tried tried;
    tried.position = source.luminaire.position;
    tried.lobe = source.lobe;
    if (source.is_held) {
      const std::vector<Tried> lobes = BestOfLobes(equations_, Others(sources_.size()), here);
      const Tried& best = *std::min_element(lobes.begin(), lobes.end(), IsBetter);
      if (std::isfinite(best.cost)) tried.lobe = best.lobe;
    }
    tried.column = equations_.Weighted(here.columns[0].col(static_cast<Eigen::Index>(tried.lobe)));
    sources_.push_back(tried);
    is_held_.push_back(source.is_held);
  }

  // Adds a source about a place of the grid, or at a place seen. Returns false where it explains nothing
  // more.
  bool AddOne(const LitPlaces& grid, const LitPlaces& seen) {
    const Eigen::MatrixXd rest = Others(sources_.size());
    const double before = equations_.Solve(rest).solution.cost;
    std::vector<Tried> lobes = BestOfLobes(equations_, rest, grid);
    // Each lobe by itself: on the coarse grid a wrong one may win, with the height wrong to match.
    for (Tried& lobe : lobes) {
      if (!std::isfinite(lobe.cost)) continue;
      for (int r = 1; r <= refinements_; ++r) lobe = Refined(lobe, r, rest, false);
    }
    const std::vector<Tried> at_seen = BestOfLobes(equations_, rest, seen);
    lobes.insert(lobes.end(), at_seen.begin(), at_seen.end());
    const Tried& best = *std::min_element(lobes.begin(), lobes.end(), IsBetter);
    if (!(best.cost < before)) return false;
    sources_.push_back(best);
    is_held_.push_back(false);
    return true;
  }

  // Moves the sources in turn, so that earlier ones and the new one adapt to each other: coarsely as often as
  // it helps, then finely once.
  void MoveAll() {
    if (sources_.size() < 2 || refinements_ == 0) return;
    constexpr int kSweeps = 5, kCoarse = 2;
    for (int sweep = 0; sweep < kSweeps && MoveEach(0, std::min(kCoarse, refinements_)); ++sweep) {
    }
    MoveEach(std::min(kCoarse, refinements_), refinements_);
  }

  // Returns other places for one source that explain the light nearly as well, best first.
  std::vector<Tried> RivalsOf(size_t source, const LitPlaces& grid) const {
    const Tried& own = sources_[source];
    const Eigen::MatrixXd rest = Others(source);
    const auto is_apart = [&](const Eigen::Vector3d& p) { return (p - own.position).norm() > step_m_; };
    const auto is_near = [&](const Eigen::Vector3d& p) { return !is_apart(p); };
    // Compares on the same coarse grid: rivals are nearly as good as the source's own surroundings.
    const std::vector<Tried> near = BestOfLobes(equations_, rest, grid, is_near);
    const double coarse = std::min_element(near.begin(), near.end(), IsBetter)->cost;
    const double fine = equations_.SolveWith(equations_.Solve(rest), own.column).cost;
    std::vector<Tried> rivals;
    for (Tried& lobe : BestOfLobes(equations_, rest, grid, is_apart)) {
      if (!(lobe.cost <= kRival * coarse)) continue;
      for (int r = 1; r <= refinements_; ++r) lobe = Refined(lobe, r, rest, false);
      if (lobe.cost <= kRival * fine && is_apart(lobe.position)) rivals.push_back(lobe);
    }
    std::sort(rivals.begin(), rivals.end(), IsBetter);
    return rivals;
  }

  Eigen::MatrixXd Columns() const { return Others(sources_.size()); }
  GroupEquations::Solution Solve() const { return equations_.Solve(Columns()).solution; }
  const std::vector<Tried>& sources() const { return sources_; }
  bool is_held(size_t source) const { return is_held_[source]; }

 private:
  // Returns the columns of all sources but one.
  Eigen::MatrixXd Others(size_t without) const {
    Eigen::MatrixXd columns(static_cast<Eigen::Index>(equations_.rows().size()), 0);
    for (size_t j = 0; j < sources_.size(); ++j) {
      if (j == without) continue;
      columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
      columns.col(columns.cols() - 1) = sources_[j].column;
    }
    return columns;
  }

  // Refines a source about its place, the step halved `halvings` times, with its own lobe or with any.
  Tried Refined(const Tried& source, int halvings, const Eigen::MatrixXd& rest, bool any_lobe) const {
    const std::vector<Eigen::Vector3d> near =
        Neighbours(source.position, std::ldexp(step_m_, -halvings), box_);
    const std::vector<Tried> lobes = BestOfLobes(equations_, rest, Lit(room_, places_, near));
    const Tried& best =
        any_lobe ? *std::min_element(lobes.begin(), lobes.end(), IsBetter) : lobes[source.lobe];
    return IsBetter(best, source) ? best : source;
  }

  bool MoveEach(int from_halvings, int to_halvings) {
    bool moved = false;
    for (size_t j = 0; j < sources_.size(); ++j) {
      if (is_held_[j]) continue;
      const Eigen::MatrixXd rest = Others(j);
      const Eigen::Vector3d from = sources_[j].position;
      sources_[j].cost = equations_.SolveWith(equations_.Solve(rest), sources_[j].column).cost;
      for (int r = from_halvings; r <= to_halvings; ++r) sources_[j] = Refined(sources_[j], r, rest, true);
      moved = moved || sources_[j].position != from;
    }
    return moved;
  }

  const Room& room_;
  const std::vector<Sensor>& places_;
  const Eigen::AlignedBox3d& box_;
  const GroupEquations& equations_;
  double step_m_;
  int refinements_;
  std::vector<Tried> sources_;
  std::vector<bool> is_held_;
};

Luminaire LuminaireOf(const Tried& tried) {
  const Lobe& lobe = Lobes()[tried.lobe];
  Luminaire luminaire;
  luminaire.position = tried.position;
  luminaire.aim = lobe.aim;
  luminaire.distribution = lobe.distribution;
  luminaire.cosine_exponent = lobe.exponent;
  return luminaire;
}

SparseLuminaires Result(const GroupSearch& search, const GroupEquations& equations) {
  SparseLuminaires found;
  const GroupEquations::Solution solution = search.Solve();
  found.mean_square = solution.cost / static_cast<double>(equations.rows().size());
  for (size_t j = 0; j < search.sources().size(); ++j) {
    SparseSource source;
    source.luminaire = LuminaireOf(search.sources()[j]);
    source.strength = solution.strength[static_cast<Eigen::Index>(j)];
    source.is_held = search.is_held(j);
    source.lobe = search.sources()[j].lobe;
    found.sources.push_back(source);
  }
  for (size_t m = 0; m < equations.materials().size(); ++m) {
    const double q = solution.other[static_cast<Eigen::Index>(m)];
    if (equations.materials()[m] >= 0 && q > 0) found.albedo[equations.materials()[m]] = 1 / q;
  }
  return found;
}

// Adds each place that photos show as a rival of the nearest source, before all others. It deserves its own
// start even where this mesh does not explain its light.
void AddSeenRivals(const std::vector<SparseSource>& seen, double apart_m,
                   std::vector<SparseSource>& sources) {
  for (const SparseSource& place : seen) {
    if (place.is_held) continue;
    const auto distance_m = [&](const SparseSource& source) {
      return source.is_held ? std::numeric_limits<double>::infinity()
                            : (source.luminaire.position - place.luminaire.position).norm();
    };
    const auto nearest = std::min_element(
        sources.begin(), sources.end(),
        [&](const SparseSource& a, const SparseSource& b) { return distance_m(a) < distance_m(b); });
    if (nearest == sources.end() || nearest->is_held || distance_m(*nearest) < apart_m) continue;
    nearest->rivals.insert(nearest->rivals.begin(), place.luminaire);
  }
}

}  // namespace

SparseSearch::SparseSearch(const Room& room, const GroupedLight& light, double grid_m, int refinements)
    : room_(room), light_(light), refinements_(refinements), box_(SearchBox(room, light.places)) {
  step_m_ = box_.isEmpty() ? grid_m : std::min(grid_m, box_.sizes().maxCoeff() / 8);
}

SparseSearch::~SparseSearch() = default;

const LitPlaces& SparseSearch::Grid() const {
  if (!grid_) grid_ = std::make_unique<LitPlaces>(Lit(room_, light_.places, GridThrough(box_, step_m_)));
  return *grid_;
}

SparseLuminaires SparseSearch::Find(int group, int count, const std::vector<SparseSource>& start,
                                    const std::vector<Eigen::Vector3d>& seen) const {
  const GroupEquations equations(light_, group);
  constexpr size_t kFewestPlaces = 20;  // fewer places with light do not locate a luminaire
  if (equations.rows().size() < kFewestPlaces || box_.isEmpty()) return {};
  const LitPlaces at_seen = Lit(room_, light_.places, seen);
  const auto searched = [&](const GroupEquations& in, const LitPlaces& grid, int refinements) {
    GroupSearch search(room_, light_.places, box_, in, step_m_, refinements);
    for (const SparseSource& source : start) search.Start(source);
    while (static_cast<int>(search.sources().size()) < count && search.AddOne(grid, at_seen))
      search.MoveAll();
    return search;
  };
  // The first search finds rows that it cannot explain. The second lowers their weight.
  const auto reweighed_after = [&](const LitPlaces& grid, int refinements) {
    GroupEquations reweighed = equations;
    reweighed.Reweigh(searched(equations, grid, refinements).Columns());
    return reweighed;
  };
  SparseLuminaires seen_alone;
  if (!seen.empty()) {
    const GroupEquations reweighed = reweighed_after({}, 0);
    seen_alone = Result(searched(reweighed, {}, 0), reweighed);
    const bool is_complete = static_cast<int>(seen_alone.sources.size()) == count;
    if (is_complete && seen_alone.mean_square < kExplained) {
      seen_alone.was_searched = false;
      return seen_alone;
    }
  }
  constexpr int kRough = 2;
  const GroupEquations reweighed = reweighed_after(Grid(), std::min(kRough, refinements_));
  const GroupSearch search = searched(reweighed, Grid(), refinements_);
  SparseLuminaires found = Result(search, reweighed);
  for (size_t j = 0; j < found.sources.size(); ++j) {
    if (found.sources[j].is_held) continue;
    for (const Tried& rival : search.RivalsOf(j, Grid()))
      found.sources[j].rivals.push_back(LuminaireOf(rival));
  }
  AddSeenRivals(seen_alone.sources, step_m_, found.sources);
  return found;
}

}  // namespace luxfit
