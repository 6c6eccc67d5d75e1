#include "inverse/model/internal/search/sparse_luminaires.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "inverse/model/internal/search/alike_places.h"
#include "inverse/model/internal/search/group_equations.h"
#include "inverse/model/internal/search/group_search.h"
#include "inverse/model/internal/search/lobe_trials.h"

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

// The same of simple lobes, at any place, below which aimed ones need no trial: 2 %. A lobe along an axis at a wrong place may
// explain a beam to 4 %. Aimed ones that reach it are right where simple ones do not even reach the former.
constexpr double kWellExplained = 0.04;

Luminaire LuminaireOf(const Tried& tried) {
  Luminaire luminaire;
  luminaire.position = tried.position;
  luminaire.aim = tried.lobe.aim;
  luminaire.distribution = tried.lobe.distribution;
  luminaire.cosine_exponent = tried.lobe.exponent;
  return luminaire;
}

SparseLuminaires Result(const GroupSearch& search, const GroupEquations& equations, LobeSet lobes) {
  SparseLuminaires found;
  found.is_aimed = lobes == LobeSet::kAimed;
  const GroupEquations::Solution solution = search.Solve();
  found.mean_square = solution.cost / static_cast<double>(equations.rows().size());
  for (size_t j = 0; j < search.sources().size(); ++j) {
    SparseSource source;
    source.luminaire = LuminaireOf(search.sources()[j]);
    source.lobe = search.sources()[j].lobe;
    source.half_length = search.sources()[j].half_length;
    source.strength = solution.strength[static_cast<Eigen::Index>(j)];
    source.is_held = search.is_held(j);
    source.is_seen = search.is_seen(j);
    found.sources.push_back(source);
  }
  for (size_t m = 0; m < equations.materials().size(); ++m) {
    const double q = solution.other[static_cast<Eigen::Index>(m)];
    if (equations.materials()[m] >= 0 && q > 0) found.albedo[equations.materials()[m]] = 1 / q;
  }
  return found;
}

// Holds one search of a group with one set of lobes.
struct SparseRun {
  std::unique_ptr<GroupEquations> equations;  // reweighed
  std::unique_ptr<GroupSearch> search;
  SparseLuminaires found;
  double mean_square_of_all = 0;             // with no row's weight lowered
  std::vector<SparseSource> of_other_lobes;  // of the lobes that explain less, if not by much
};

// Adds each source of another search as a rival of the nearest source, before all others: one at a place that photos
// show deserves its own start even where this mesh does not explain its light, and so does one that explains more
// light than the places that photos show.
void AddRivals(const std::vector<SparseSource>& others, double apart_m, std::vector<SparseSource>& sources) {
  for (const SparseSource& place : others) {
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

SparseSearch::SparseSearch(const Room& room, const GroupedLight& light, std::vector<Watcher> views,
                           double grid_m, int refinements)
    : room_(room),
      light_(light),
      views_(std::move(views)),
      refinements_(refinements),
      box_(SearchBox(room, light.places)) {
  step_m_ = box_.isEmpty() ? grid_m : std::min(grid_m, box_.sizes().maxCoeff() / 8);
}

SparseSearch::~SparseSearch() = default;

const LitPlaces& SparseSearch::Grid() const {
  if (!grid_)
    grid_ = std::make_unique<LitPlaces>(Lit(room_, light_.places, GridThrough(box_, step_m_), views_));
  return *grid_;
}

namespace {

// Returns by view whether it has a photo of a state in which the group is on.
std::vector<bool> WithPhotoOf(const std::vector<Watcher>& views, const std::vector<bool>& is_on) {
  std::vector<bool> counts;
  counts.reserve(views.size());
  for (const Watcher& view : views)
    counts.push_back(std::any_of(view.states.begin(), view.states.end(),
                                 [&](int s) { return is_on[static_cast<size_t>(s)]; }));
  return counts;
}

// Explains the light of one group.
class GroupFinder {
 public:
  // `grid`: traces the room's grid when it is first needed.
  GroupFinder(const Room& room, const std::vector<Sensor>& sensors, const std::vector<Watcher>& views,
              const std::vector<bool>& is_on, const Eigen::AlignedBox3d& box, const GroupEquations& equations,
              int count, double step_m, int refinements, std::function<const LitPlaces&()> grid,
              std::function<bool()> searches_on)
      : room_(room),
        sensors_(sensors),
        views_(views),
        counts_(WithPhotoOf(views, is_on)),
        box_(box),
        equations_(equations),
        count_(count),
        step_m_(step_m),
        refinements_(refinements),
        grid_(std::move(grid)),
        searches_on_(std::move(searches_on)) {}

  SparseLuminaires Run(const std::vector<SparseSource>& start, const std::vector<SeenPlace>& seen) {
    if (seen.empty() && SearchesOn()) return WithRivals(BestLobes(start, grid_(), refinements_));
    const std::vector<SparseSource> alike =
        SourcesAtAlike(seen, static_cast<size_t>(count_) - std::min<size_t>(start.size(), count_));
    if (!alike.empty()) return AtAlike(start, alike, seen);
    for (const SeenPlace& place : seen) {
      LitPlaces lit = LitAlong(room_, sensors_, place.position, SourceAt(place).half_length);
      at_seen_.positions.push_back(place.position);
      at_seen_.light.push_back(std::move(lit.light.front()));
    }
    SparseRun alone = BestLobes(start, {}, 0);
    if ((IsComplete(alone) && alone.found.mean_square < kExplained) || !SearchesOn()) {
      alone.found.was_searched = false;
      return std::move(alone.found);
    }
    SparseRun searched = BestLobes(start, grid_(), refinements_);
    if (std::optional<SparseRun> as_seen = AsSeen(start, seen, searched))
      return WithRivals(std::move(*as_seen), searched.found.sources);
    const std::vector<SparseSource> with_sure = WithSurePlaces(start, seen, alone);
    // A washed wall is bright too, and seen as surely.
    if (with_sure.size() > start.size()) {
      SparseRun sure = BestLobes(with_sure, grid_(), refinements_);
      if (sure.found.mean_square <= kRival * searched.found.mean_square)
        return WithRivals(std::move(sure), searched.found.sources);
    }
    return WithRivals(std::move(searched), alone.found.sources);
  }

 private:
  // Where as many places are sure as luminaires are sought, and several: luminaires there that shine down, if each has light
  // and they explain nearly as much as a search anywhere. What the mesh lacks may favour a turned lobe at one of the places,
  // which leaves nothing for another.
  std::optional<SparseRun> AsSeen(std::vector<SparseSource> start, const std::vector<SeenPlace>& seen,
                                  const SparseRun& searched) const {
    const size_t given = start.size();
    for (const SeenPlace& place : seen)
      if (IsSure(place)) start.push_back(SourceAt(place));
    constexpr size_t kSeveral = 2;
    if (start.size() < given + kSeveral || static_cast<int>(start.size()) != count_) return {};
    SparseRun run = RunWith(LobeSet::kSimple, start, {}, 0);
    const auto is_lit = [](const SparseSource& source) { return source.is_held || source.strength > 0; };
    if (!std::all_of(run.found.sources.begin(), run.found.sources.end(), is_lit) ||
        run.mean_square_of_all > kRival * searched.mean_square_of_all)
      return {};
    return run;
  }

  // Photos show as many like luminaires as there are.
  SparseLuminaires AtAlike(std::vector<SparseSource> start, const std::vector<SparseSource>& alike,
                           const std::vector<SeenPlace>& seen) const {
    start.insert(start.end(), alike.begin(), alike.end());
    SparseLuminaires found = RunWith(LobeSet::kSimple, start, {}, 0).found;
    ShareAmongAlike(seen, found.sources);
    found.was_searched = false;
    return found;
  }

  bool SearchesOn() const { return !searches_on_ || searches_on_(); }
  bool IsComplete(const SparseRun& of) const { return static_cast<int>(of.found.sources.size()) == count_; }

  std::unique_ptr<GroupSearch> Searched(const GroupEquations& in, LobeSet lobes,
                                        const std::vector<SparseSource>& start, const LitPlaces& grid,
                                        int refinements) const {
    auto search = std::make_unique<GroupSearch>(room_, sensors_, views_, counts_, box_, in, lobes, step_m_,
                                                refinements);
    for (const SparseSource& source : start) search->Start(source);
    search->ReshapeSeen();
    while (static_cast<int>(search->sources().size()) < count_ && search->AddOne(grid, at_seen_)) {
      search->ReshapeSeen();
      search->MoveAll();
    }
    if (refinements == 0) search->TurnAll();
    return search;
  }

  // The first search finds rows that it cannot explain. The second lowers their weight.
  SparseRun RunWith(LobeSet lobes, const std::vector<SparseSource>& start, const LitPlaces& grid,
                    int refinements) const {
    constexpr int kRough = 2;
    SparseRun result;
    result.equations = std::make_unique<GroupEquations>(equations_);
    result.equations->Reweigh(
        Searched(equations_, lobes, start, grid, std::min(kRough, refinements))->Columns());
    result.search = Searched(*result.equations, lobes, start, grid, refinements);
    result.found = Result(*result.search, *result.equations, lobes);
    result.mean_square_of_all = result.search->MeanSquareIn(equations_);
    return result;
  }

  // A narrow beam falls on few rows. Lowered weights would hide it, so all rows judge the lobes, unless the rows that keep their
  // weight leave no doubt.
  SparseRun BestLobes(const std::vector<SparseSource>& start, const LitPlaces& grid, int refinements) const {
    SparseRun simple = RunWith(LobeSet::kSimple, start, grid, refinements);
    if (IsComplete(simple) && simple.mean_square_of_all < kWellExplained) return simple;
    SparseRun aimed = RunWith(LobeSet::kAimed, start, grid, refinements);
    const bool is_turned = aimed.found.sources.size() >= simple.found.sources.size() &&
                           (kRival * aimed.mean_square_of_all < simple.mean_square_of_all ||
                            IsExplainedByFirstAlone(aimed, simple) || !ExplainsHalf(simple, aimed, start));
    SparseRun &best = is_turned ? aimed : simple, &other = is_turned ? simple : aimed;
    if (other.mean_square_of_all <= kRival * best.mean_square_of_all)
      best.of_other_lobes = std::move(other.found.sources);
    return std::move(best);
  }

  static bool IsExplainedByFirstAlone(const SparseRun& first, const SparseRun& second) {
    return first.found.mean_square < kWellExplained && second.found.mean_square > kExplained;
  }

  // Returns whether lobes explain at least half of what others explain beyond the start. At the right place, simple lobes
  // may explain next to nothing of a turned beam, though reflected light makes up most of what all leave.
  bool ExplainsHalf(const SparseRun& lobes, const SparseRun& others,
                    const std::vector<SparseSource>& start) const {
    GroupSearch at_start(room_, sensors_, views_, counts_, box_, equations_, LobeSet::kSimple, step_m_, 0);
    for (const SparseSource& source : start) at_start.Start(source);
    const double left = at_start.MeanSquareIn(equations_);
    return left - lobes.mean_square_of_all >= 0.5 * (left - others.mean_square_of_all);
  }

  // Returns the start with those sources that `alone` has at sure places.
  static std::vector<SparseSource> WithSurePlaces(std::vector<SparseSource> start,
                                                  const std::vector<SeenPlace>& seen,
                                                  const SparseRun& alone) {
    for (SparseSource source : alone.found.sources) {
      const auto place = std::find_if(seen.begin(), seen.end(), [&](const SeenPlace& one) {
        return IsSure(one) && one.position == source.luminaire.position;
      });
      if (!source.is_held && place != seen.end()) start.push_back(SeenAt(std::move(source), *place));
    }
    return start;
  }

  // Returns the sources of a search with their rivals, `others` among them.
  SparseLuminaires WithRivals(SparseRun run, const std::vector<SparseSource>& others = {}) const {
    for (size_t j = 0; j < run.found.sources.size(); ++j) {
      if (run.search->stays(j)) continue;
      for (const Tried& rival : run.search->RivalsOf(j, grid_()))
        run.found.sources[j].rivals.push_back(LuminaireOf(rival));
    }
    AddRivals(others, step_m_, run.found.sources);
    for (const SparseSource& other : run.of_other_lobes) AddLastRival(other, run.found.sources);
    return std::move(run.found);
  }

  // Adds what the same search found with other lobes behind the rivals of its nearest source, if no photo shows that: what
  // the mesh lacks may outweigh a beam.
  void AddLastRival(const SparseSource& other, std::vector<SparseSource>& sources) const {
    const auto distance_m = [&](const SparseSource& source) {
      return (source.luminaire.position - other.luminaire.position).norm();
    };
    const auto nearest = std::min_element(
        sources.begin(), sources.end(),
        [&](const SparseSource& a, const SparseSource& b) { return distance_m(a) < distance_m(b); });
    if (nearest == sources.end() || nearest->is_held || nearest->is_seen || distance_m(*nearest) < step_m_)
      return;
    nearest->rivals.push_back(other.luminaire);
  }

  const Room& room_;
  const std::vector<Sensor>& sensors_;
  const std::vector<Watcher>& views_;
  std::vector<bool> counts_;  // by view
  const Eigen::AlignedBox3d& box_;
  const GroupEquations& equations_;
  int count_;
  double step_m_;
  int refinements_;
  std::function<const LitPlaces&()> grid_;
  std::function<bool()> searches_on_;
  LitPlaces at_seen_;
};

}  // namespace

SparseLuminaires SparseSearch::Find(int group, int count, const std::vector<SparseSource>& start,
                                    const std::vector<SeenPlace>& seen,
                                    const std::function<bool()>& searches_on) const {
  const GroupEquations equations(light_, group);
  constexpr size_t kFewestPlaces = 20;  // fewer places with light do not locate a luminaire
  if (equations.rows().size() < kFewestPlaces || box_.isEmpty()) return {};
  return GroupFinder(
             room_, light_.places, views_, light_.is_on[static_cast<size_t>(group)], box_, equations, count,
             step_m_, refinements_, [this]() -> const LitPlaces& { return Grid(); }, searches_on)
      .Run(start, seen);
}

}  // namespace luxfit
