#include "inverse/model/internal/search/sparse_luminaires.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "inverse/model/internal/search/group_equations.h"
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
// explain a beam to 4 %.
constexpr double kWellExplained = 0.04;

// Ratio of squares up to which a place explains the light nearly as well as the best. Neighbouring rows share
// their errors, so the few facets do not tell such places apart.
constexpr double kRival = 1.5;

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

// Leaves out lobes that are not aimed down and leave no less than two thirds of the squares of the best that is: at a place
// that is known, most luminaires shine down, and what the mesh lacks may favour any other axis by a little.
std::vector<Tried> MostlyDown(std::vector<Tried> tried) {
  const auto is_down = [](const Tried& t) {
    return t.lobe.distribution == Distribution::kIsotropic || t.lobe.aim.z() < -0.99;
  };
  double down = std::numeric_limits<double>::infinity();
  for (const Tried& t : tried)
    if (is_down(t)) down = std::min(down, t.cost);
  tried.erase(std::remove_if(tried.begin(), tried.end(),
                             [&](const Tried& t) { return !is_down(t) && kRival * t.cost >= down; }),
              tried.end());
  return tried;
}

// Searches the sources of one group with one set of lobes. It holds the sources so far, each with its column.
class GroupSearch {
 public:
  GroupSearch(const Room& room, const std::vector<Sensor>& places, const Eigen::AlignedBox3d& box,
              const GroupEquations& equations, LobeSet lobes, double step_m, int refinements)
      : room_(room),
        places_(places),
        box_(box),
        equations_(equations),
        trials_(equations, places, step_m),
        lobes_(lobes),
        step_m_(step_m),
        refinements_(refinements) {}

  void Start(const SparseSource& source) {
    const LitPlaces here = Lit(room_, places_, {source.luminaire.position});
    Tried tried;
    tried.position = source.luminaire.position;
    tried.lobe = source.is_held ? SimpleLobes().front() : source.lobe;
    if (source.is_held) {
      const std::vector<Tried> lobes =
          Sorted(MostlyDown(trials_.BestOfBins(AtKnownPlace(), Others(sources_.size()), here)));
      if (!lobes.empty()) tried.lobe = TurnedInPlace(lobes.front(), Others(sources_.size())).lobe;
    }
    tried.column = LobeColumns(equations_.Weighted(here.light[0]), {tried.lobe}).cast<double>();
    sources_.push_back(tried);
    kind_.push_back({source.is_held, source.is_seen});
  }

  // Adds a source about a place of the grid, or at a place seen. Returns false where it explains nothing
  // more.
  bool AddOne(const LitPlaces& grid, const LitPlaces& seen) {
    const Eigen::MatrixXd rest = Others(sources_.size());
    const double before = equations_.Solve(rest).solution.cost;
    std::vector<Tried> lobes = RefinedBins(trials_.BestOfBins(lobes_, rest, grid), rest);
    // One place that photos show is one luminaire.
    const auto is_free = [&](const Eigen::Vector3d& p) {
      return std::none_of(sources_.begin(), sources_.end(), [&](const Tried& t) { return t.position == p; });
    };
    for (Tried& at_seen : MostlyDown(trials_.BestOfBins(AtKnownPlace(), rest, seen, is_free)))
      lobes.push_back(TurnedInPlace(at_seen, rest));
    const auto best = std::min_element(lobes.begin(), lobes.end(), IsBetter);
    if (best == lobes.end() || !(best->cost < before)) return false;
    sources_.push_back(*best);
    kind_.push_back({});
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

  // Chooses the lobe of each source anew, at its place, now that the others explain their light.
  void TurnAll() {
    for (size_t j = 0; j < sources_.size() && sources_.size() > 1; ++j) {
      if (stays(j)) continue;
      const Eigen::MatrixXd rest = Others(j);
      const std::vector<Tried> lobes = Sorted(
          MostlyDown(trials_.BestOfBins(AtKnownPlace(), rest, Lit(room_, places_, {sources_[j].position}))));
      if (!lobes.empty()) sources_[j] = TurnedInPlace(lobes.front(), rest);
    }
  }

  // Returns other places for one source that explain the light nearly as well, best first.
  std::vector<Tried> RivalsOf(size_t source, const LitPlaces& grid) const {
    const Tried& own = sources_[source];
    const Eigen::MatrixXd rest = Others(source);
    const auto is_apart = [&](const Eigen::Vector3d& p) { return (p - own.position).norm() > step_m_; };
    const auto is_near = [&](const Eigen::Vector3d& p) { return !is_apart(p); };
    // Compares on the same coarse grid: rivals are nearly as good as the source's own surroundings.
    const std::vector<Tried> near = Sorted(trials_.BestOfBins(lobes_, rest, grid, is_near));
    if (near.empty()) return {};
    const double coarse = near.front().cost;
    const double fine = equations_.SolveWith(equations_.Solve(rest), own.column).cost;
    std::vector<Tried> promising, rivals;
    for (const Tried& lobe : trials_.BestOfBins(lobes_, rest, grid, is_apart))
      if (lobe.cost <= kRival * coarse) promising.push_back(lobe);
    for (const Tried& lobe : RefinedBins(std::move(promising), rest))
      if (lobe.cost <= kRival * fine && is_apart(lobe.position)) rivals.push_back(lobe);
    return Sorted(std::move(rivals));
  }

  Eigen::MatrixXd Columns() const { return Others(sources_.size()); }
  GroupEquations::Solution Solve() const { return equations_.Solve(Columns()).solution; }
  // Returns the mean square that the sources leave of other rows, or of the same ones with other weights.
  double MeanSquareIn(const GroupEquations& others) const {
    Eigen::MatrixXd columns(static_cast<Eigen::Index>(others.rows().size()),
                            static_cast<Eigen::Index>(sources_.size()));
    for (size_t j = 0; j < sources_.size(); ++j) {
      const LitPlaces here = Lit(room_, places_, {sources_[j].position});
      columns.col(static_cast<Eigen::Index>(j)) =
          LobeColumns(others.Weighted(here.light[0]), {sources_[j].lobe}).cast<double>();
    }
    return others.MeanSquare(others.Solve(columns).residual);
  }
  const std::vector<Tried>& sources() const { return sources_; }
  bool is_held(size_t source) const { return kind_[source].is_held; }
  bool is_seen(size_t source) const { return kind_[source].is_seen; }
  bool stays(size_t source) const { return is_held(source) || is_seen(source); }

 private:
  LobeSet AtKnownPlace() const { return lobes_ == LobeSet::kSimple ? LobeSet::kOfKnownPlaces : lobes_; }

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

  // Refines the best of each bin by itself: on the coarse grid a wrong lobe may win, with the height wrong to
  // match. Aimed lobes are many; after each step only the better half of them goes on.
  std::vector<Tried> RefinedBins(std::vector<Tried> bins, const Eigen::MatrixXd& rest) const {
    size_t kept = bins.size();
    constexpr size_t kMostAimed = 9, kFewestAimed = 3;
    if (lobes_ == LobeSet::kAimed) kept = std::min(kept, kMostAimed);
    for (int r = 1; r <= refinements_; ++r) {
      if (lobes_ == LobeSet::kAimed) bins = Sorted(std::move(bins));
      bins.resize(kept);
      for (Tried& lobe : bins) lobe = Refined(lobe, r, rest, false);
      if (lobes_ == LobeSet::kAimed) kept = std::min(kept, std::max(kFewestAimed, kept / 2));
    }
    return bins;
  }

  // Returns the lobes to try about a source, the step halved `halvings` times.
  std::vector<Lobe> LobesAbout(const Lobe& lobe, int halvings) const {
    if (lobes_ == LobeSet::kSimple) return {lobe};
    const double shrunk = std::ldexp(1, -halvings);
    return LobesNear(lobe, kAimStepRad * shrunk, 1 + shrunk);
  }

  // Refines a source about its place, the step halved `halvings` times: with its own lobe or, where `any_lobe`, with
  // any simple one. Aimed lobes turn and change their width beside.
  Tried Refined(const Tried& source, int halvings, const Eigen::MatrixXd& rest, bool any_lobe) const {
    const std::vector<Eigen::Vector3d> near =
        Neighbours(source.position, std::ldexp(step_m_, -halvings), box_);
    const bool is_any = any_lobe && lobes_ == LobeSet::kSimple;
    const Tried best = trials_.Best(is_any ? SimpleLobes() : LobesAbout(source.lobe, halvings), rest,
                                    Lit(room_, places_, near));
    return IsBetter(best, source) ? best : source;
  }

  // Refines aim and width of a source, and leaves it at its place.
  Tried TurnedInPlace(Tried source, const Eigen::MatrixXd& rest) const {
    if (lobes_ == LobeSet::kSimple) return source;
    const LitPlaces here = Lit(room_, places_, {source.position});
    for (int r = 1; r <= std::max(1, refinements_); ++r) {
      const Tried best = trials_.Best(LobesAbout(source.lobe, r), rest, here);
      if (IsBetter(best, source)) source = best;
    }
    return source;
  }

  bool MoveEach(int from_halvings, int to_halvings) {
    bool moved = false;
    for (size_t j = 0; j < sources_.size(); ++j) {
      if (stays(j)) continue;
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
  double mean_square_of_all = 0;  // with no row's weight lowered
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

SparseSearch::SparseSearch(const Room& room, const GroupedLight& light, double grid_m, int refinements)
    : room_(room), light_(light), refinements_(refinements), box_(SearchBox(room, light.places)) {
  step_m_ = box_.isEmpty() ? grid_m : std::min(grid_m, box_.sizes().maxCoeff() / 8);
}

SparseSearch::~SparseSearch() = default;

const LitPlaces& SparseSearch::Grid() const {
  if (!grid_) grid_ = std::make_unique<LitPlaces>(Lit(room_, light_.places, GridThrough(box_, step_m_)));
  return *grid_;
}

namespace {

// Explains the light of one group.
class GroupFinder {
 public:
  // `grid`: traces the room's grid when it is first needed.
  GroupFinder(const Room& room, const std::vector<Sensor>& sensors, const Eigen::AlignedBox3d& box,
              const GroupEquations& equations, int count, double step_m, int refinements,
              std::function<const LitPlaces&()> grid, std::function<bool()> searches_on)
      : room_(room),
        sensors_(sensors),
        box_(box),
        equations_(equations),
        count_(count),
        step_m_(step_m),
        refinements_(refinements),
        grid_(std::move(grid)),
        searches_on_(std::move(searches_on)) {}

  SparseLuminaires Run(const std::vector<SparseSource>& start, const std::vector<SeenPosition>& seen) {
    if (seen.empty())
      return SearchesOn() ? WithRivals(BestLobes(start, grid_(), refinements_)) : SparseLuminaires();
    std::vector<Eigen::Vector3d> positions;
    positions.reserve(seen.size());
    for (const SeenPosition& place : seen) positions.push_back(place.position);
    at_seen_ = Lit(room_, sensors_, positions);
    SparseRun alone = BestLobes(start, {}, 0);
    if ((IsComplete(alone) && alone.found.mean_square < kExplained) || !SearchesOn()) {
      alone.found.was_searched = false;
      return std::move(alone.found);
    }
    SparseRun searched = BestLobes(start, grid_(), refinements_);
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
  bool SearchesOn() const { return !searches_on_ || searches_on_(); }
  bool IsComplete(const SparseRun& of) const { return static_cast<int>(of.found.sources.size()) == count_; }

  std::unique_ptr<GroupSearch> Searched(const GroupEquations& in, LobeSet lobes,
                                        const std::vector<SparseSource>& start, const LitPlaces& grid,
                                        int refinements) const {
    auto search = std::make_unique<GroupSearch>(room_, sensors_, box_, in, lobes, step_m_, refinements);
    for (const SparseSource& source : start) search->Start(source);
    while (static_cast<int>(search->sources().size()) < count_ && search->AddOne(grid, at_seen_))
      search->MoveAll();
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

  // A narrow beam falls on few rows. Lowered weights would hide it, so all rows judge the lobes.
  SparseRun BestLobes(const std::vector<SparseSource>& start, const LitPlaces& grid, int refinements) const {
    SparseRun simple = RunWith(LobeSet::kSimple, start, grid, refinements);
    if (IsComplete(simple) && simple.mean_square_of_all < kWellExplained) return simple;
    SparseRun aimed = RunWith(LobeSet::kAimed, start, grid, refinements);
    const bool is_turned = aimed.found.sources.size() >= simple.found.sources.size() &&
                           kRival * aimed.mean_square_of_all < simple.mean_square_of_all;
    return is_turned ? std::move(aimed) : std::move(simple);
  }

  // Returns the start with those sources that `alone` has at sure places.
  static std::vector<SparseSource> WithSurePlaces(std::vector<SparseSource> start,
                                                  const std::vector<SeenPosition>& seen,
                                                  const SparseRun& alone) {
    for (SparseSource source : alone.found.sources) {
      if (source.is_held || !IsSure(seen, source.luminaire.position)) continue;
      source.is_seen = true;
      start.push_back(std::move(source));
    }
    return start;
  }

  static bool IsSure(const std::vector<SeenPosition>& seen, const Eigen::Vector3d& position) {
    return std::any_of(seen.begin(), seen.end(),
                       [&](const SeenPosition& s) { return s.is_sure && s.position == position; });
  }

  // Returns the sources of a search with their rivals, `others` among them.
  SparseLuminaires WithRivals(SparseRun run, const std::vector<SparseSource>& others = {}) const {
    for (size_t j = 0; j < run.found.sources.size(); ++j) {
      if (run.search->stays(j)) continue;
      for (const Tried& rival : run.search->RivalsOf(j, grid_()))
        run.found.sources[j].rivals.push_back(LuminaireOf(rival));
    }
    AddRivals(others, step_m_, run.found.sources);
    return std::move(run.found);
  }

  const Room& room_;
  const std::vector<Sensor>& sensors_;
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
                                    const std::vector<SeenPosition>& seen,
                                    const std::function<bool()>& searches_on) const {
  const GroupEquations equations(light_, group);
  constexpr size_t kFewestPlaces = 20;  // fewer places with light do not locate a luminaire
  if (equations.rows().size() < kFewestPlaces || box_.isEmpty()) return {};
  return GroupFinder(
             room_, light_.places, box_, equations, count, step_m_, refinements_,
             [this]() -> const LitPlaces& { return Grid(); }, searches_on)
      .Run(start, seen);
}

}  // namespace luxfit
