#include "inverse/internal/sparse_luminaires.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "forward/direct_light.h"
#include "inverse/internal/group_equations.h"

namespace luxfit {
namespace {

struct Lobe {
  Distribution distribution;
  double exponent;
  Eigen::Vector3d aim;
};
const std::vector<Lobe>& Lobes() {
  using D = Distribution;
  static const std::vector<Lobe> lobes = {
      {D::kIsotropic, 1, {0, 0, -1}},   {D::kCosinePower, 1, {0, 0, -1}}, {D::kCosinePower, 3, {0, 0, -1}},
      {D::kCosinePower, 8, {0, 0, -1}}, {D::kCosinePower, 1, {0, 0, 1}},  {D::kCosinePower, 1, {1, 0, 0}},
      {D::kCosinePower, 1, {-1, 0, 0}}, {D::kCosinePower, 1, {0, 1, 0}},  {D::kCosinePower, 1, {0, -1, 0}}};
  return lobes;
}

// Direct illuminance per lumen at the places (rows) of every lobe (columns) at one position.
Eigen::MatrixXf LobeColumns(const Room& room, const std::vector<Sensor>& places,
                            const Eigen::Vector3d& position) {
  const auto rows = static_cast<Eigen::Index>(places.size());
  const auto lobes = static_cast<Eigen::Index>(Lobes().size());
  Eigen::MatrixXf columns = Eigen::MatrixXf::Zero(rows, lobes);
  Luminaire lamp;
  lamp.position = position;
  lamp.distribution = Distribution::kIsotropic;
  constexpr double kIsotropicCdPerLm = 0.25 / 3.14159265358979323846;
  // A candidate close to a surface must not win by one enormous value.
  constexpr double kNearestM = 0.1;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Sensor& place = places[static_cast<size_t>(i)];
    const Eigen::Vector3d ray = place.position - position;
    const double distance = ray.norm();
    if (distance < kNearestM || VisibleFraction(room.rays, lamp, place.position, place.normal, 1) == 0)
      continue;
    const double isotropic = SensorIlluminancePerLumen(lamp, place).lx_per_lm;
    for (Eigen::Index l = 0; l < lobes; ++l) {
      const Lobe& lobe = Lobes()[static_cast<size_t>(l)];
      const double cosine = lobe.aim.dot(ray) / distance;
      lamp.distribution = lobe.distribution;
      lamp.cosine_exponent = lobe.exponent;
      columns(i, l) =
          static_cast<float>(isotropic / kIsotropicCdPerLm * IntensityPerLumen(lamp, cosine).cd_per_lm);
    }
    lamp.distribution = Distribution::kIsotropic;
  }
  return columns;
}

// Cell centres of a grid through the box, so that none lies on a wall.
std::vector<Eigen::Vector3d> GridThrough(const Eigen::AlignedBox3d& box, double step) {
  const Eigen::Array3i n = (box.sizes().array() / step).ceil().cast<int>().max(1);
  std::vector<Eigen::Vector3d> places;
  places.reserve(static_cast<size_t>(n.cast<double>().prod()));
  for (int i = 0; i < n[0]; ++i) {
    for (int j = 0; j < n[1]; ++j) {
      for (int k = 0; k < n[2]; ++k) {
        const Eigen::Array3d at = (Eigen::Array3d(i, j, k) + 0.5) / n.cast<double>();
        places.push_back(box.min() + (at * box.sizes().array()).matrix());
      }
    }
  }
  return places;
}

// The room; without a mesh, the box of the sensors, as far again to every side.
Eigen::AlignedBox3d SearchBox(const Room& room, const std::vector<Sensor>& places) {
  Eigen::AlignedBox3d box = room.scene.Bounds();
  if (!box.isEmpty()) return box;
  for (const Sensor& place : places) box.extend(place.position);
  if (box.isEmpty()) return box;
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(box.sizes().maxCoeff());
  return {box.min() - margin, box.max() + margin};
}

}  // namespace

struct SparseSearch::Grid {
  Eigen::AlignedBox3d box;
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::MatrixXf> columns;  // of each place: rows x lobes
};

SparseSearch::SparseSearch(const Room& room, const GroupedLight& light, double grid_m, int refinements)
    : room_(room), light_(light), refinements_(refinements), grid_(std::make_unique<Grid>()) {
  grid_->box = SearchBox(room, light.places);
  if (grid_->box.isEmpty()) {
    step_m_ = grid_m;
    return;
  }
  step_m_ = std::min(grid_m, grid_->box.sizes().maxCoeff() / 8);
  grid_->places = GridThrough(grid_->box, step_m_);
  grid_->columns.resize(grid_->places.size());
  tbb::parallel_for(size_t{0}, grid_->places.size(), [&](size_t i) {
    grid_->columns[i] = LobeColumns(room_, light_.places, grid_->places[i]);
  });
}

SparseSearch::~SparseSearch() = default;

namespace {

struct Tried {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  size_t lobe = 0;
  Eigen::VectorXd column;  // weighted
  double cost = std::numeric_limits<double>::infinity();
};

bool IsBetter(const Tried& a, const Tried& b) { return a.cost < b.cost; }

// The best place of every lobe.
std::vector<Tried> BestOfLobes(const GroupEquations& equations, const Eigen::MatrixXd& others,
                               const std::vector<Eigen::Vector3d>& places,
                               const std::vector<Eigen::MatrixXf>& columns) {
  const GroupEquations::Base base = equations.Solve(others);
  const size_t lobes = Lobes().size();
  const auto column_of = [&](size_t place, size_t lobe) {
    return equations.Weighted(columns[place].col(static_cast<Eigen::Index>(lobe)));
  };
  std::vector<std::vector<std::pair<double, size_t>>> gains(lobes);  // gain, place
  for (std::vector<std::pair<double, size_t>>& of_lobe : gains) of_lobe.resize(places.size());
  tbb::parallel_for(size_t{0}, places.size(), [&](size_t i) {
    for (size_t l = 0; l < lobes; ++l) gains[l][i] = {GroupEquations::Gain(base, column_of(i, l)), i};
  });
  constexpr size_t kExact = 6;  // of each lobe, the most promising
  std::vector<Tried> best(lobes);
  tbb::parallel_for(size_t{0}, lobes, [&](size_t l) {
    const auto end = gains[l].begin() + static_cast<std::ptrdiff_t>(std::min(kExact, places.size()));
    std::partial_sort(gains[l].begin(), end, gains[l].end(), std::greater<>());
    best[l].lobe = l;
    for (auto promising = gains[l].begin(); promising != end; ++promising) {
      if (!(promising->first > 0)) continue;
      const Eigen::VectorXd column = column_of(promising->second, l);
      const GroupEquations::Solution solution = equations.SolveWith(base, column);
      if (!(solution.strength[solution.strength.size() - 1] > 0) || solution.cost >= best[l].cost) continue;
      best[l] = {places[promising->second], l, column, solution.cost};
    }
  });
  return best;
}

// The cell about a place, in half steps.
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

// One group's search: sources so far, each with its column.
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
    const Eigen::MatrixXf columns = LobeColumns(room_, places_, source.luminaire.position);
    Tried tried;
    tried.position = source.luminaire.position;
    tried.lobe = source.lobe;
    if (source.is_held) {
      const std::vector<Tried> lobes =
          BestOfLobes(equations_, Others(sources_.size()), {tried.position}, {columns});
      const Tried& best = *std::min_element(lobes.begin(), lobes.end(), IsBetter);
      if (std::isfinite(best.cost)) tried.lobe = best.lobe;
    }
    tried.column = equations_.Weighted(columns.col(static_cast<Eigen::Index>(tried.lobe)));
    sources_.push_back(tried);
    is_held_.push_back(source.is_held);
  }

  // False where one more explains nothing more.
  bool AddOne(const std::vector<Eigen::Vector3d>& grid, const std::vector<Eigen::MatrixXf>& columns) {
    const Eigen::MatrixXd rest = Others(sources_.size());
    const double before = equations_.Solve(rest).solution.cost;
    std::vector<Tried> lobes = BestOfLobes(equations_, rest, grid, columns);
    // Each lobe by itself: on the coarse grid a wrong one may win, with the height wrong to match.
    for (Tried& lobe : lobes) {
      if (!std::isfinite(lobe.cost)) continue;
      for (int r = 1; r <= refinements_; ++r) lobe = Refined(lobe, r, rest, false);
    }
    const Tried& best = *std::min_element(lobes.begin(), lobes.end(), IsBetter);
    if (!(best.cost < before)) return false;
    sources_.push_back(best);
    is_held_.push_back(false);
    return true;
  }

  // Those that were there before give way to the new one, and it to them: coarsely as often as it helps, then
  // finely once.
  void MoveAll() {
    if (sources_.size() < 2) return;
    constexpr int kSweeps = 5, kCoarse = 2;
    for (int sweep = 0; sweep < kSweeps && MoveEach(0, std::min(kCoarse, refinements_)); ++sweep) {
    }
    MoveEach(std::min(kCoarse, refinements_), refinements_);
  }

  Eigen::MatrixXd Columns() const { return Others(sources_.size()); }
  GroupEquations::Solution Solve() const { return equations_.Solve(Columns()).solution; }
  const std::vector<Tried>& sources() const { return sources_; }
  bool is_held(size_t source) const { return is_held_[source]; }

 private:
  // Columns of all sources but one.
  Eigen::MatrixXd Others(size_t without) const {
    Eigen::MatrixXd columns(static_cast<Eigen::Index>(equations_.rows().size()), 0);
    for (size_t j = 0; j < sources_.size(); ++j) {
      if (j == without) continue;
      columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
      columns.col(columns.cols() - 1) = sources_[j].column;
    }
    return columns;
  }

  // About its place at a step halved `halvings` times, with its own lobe or with any.
  Tried Refined(const Tried& source, int halvings, const Eigen::MatrixXd& rest, bool any_lobe) const {
    const std::vector<Eigen::Vector3d> near =
        Neighbours(source.position, std::ldexp(step_m_, -halvings), box_);
    std::vector<Eigen::MatrixXf> columns(near.size());
    tbb::parallel_for(size_t{0}, near.size(),
                      [&](size_t i) { columns[i] = LobeColumns(room_, places_, near[i]); });
    const std::vector<Tried> lobes = BestOfLobes(equations_, rest, near, columns);
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

}  // namespace

SparseLuminaires SparseSearch::Find(int group, int count, const std::vector<SparseSource>& start) const {
  SparseLuminaires found;
  GroupEquations equations(light_, group);
  constexpr size_t kFewestPlaces = 20;  // less light seen than this does not place a luminaire
  if (equations.rows().size() < kFewestPlaces || grid_->places.empty()) return found;
  // Once to see what is unlike all else, once without that.
  const auto searched = [&](int refinements) {
    GroupSearch search(room_, light_.places, grid_->box, equations, step_m_, refinements);
    for (const SparseSource& source : start) search.Start(source);
    while (static_cast<int>(search.sources().size()) < count && search.AddOne(grid_->places, grid_->columns))
      search.MoveAll();
    return search;
  };
  constexpr int kRough = 2;
  equations.Reweigh(searched(std::min(kRough, refinements_)).Columns());
  const GroupSearch search = searched(refinements_);
  const GroupEquations::Solution solution = search.Solve();
  found.mean_square = solution.cost / static_cast<double>(equations.rows().size());
  for (size_t j = 0; j < search.sources().size(); ++j) {
    const Tried& tried = search.sources()[j];
    const Lobe& lobe = Lobes()[tried.lobe];
    SparseSource source;
    source.luminaire.position = tried.position;
    source.luminaire.aim = lobe.aim;
    source.luminaire.distribution = lobe.distribution;
    source.luminaire.cosine_exponent = lobe.exponent;
    source.strength = solution.strength[static_cast<Eigen::Index>(j)];
    source.is_held = search.is_held(j);
    source.lobe = tried.lobe;
    found.sources.push_back(source);
  }
  for (size_t m = 0; m < equations.materials().size(); ++m) {
    const double q = solution.other[static_cast<Eigen::Index>(m)];
    if (equations.materials()[m] >= 0 && q > 0) found.albedo[equations.materials()[m]] = 1 / q;
  }
  return found;
}

}  // namespace luxfit
