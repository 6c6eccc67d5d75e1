#include "inverse/model/internal/search/group_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "inverse/model/internal/search/places_inside.h"

namespace luxfit {
namespace {

// Returns the places of the cell about a place, in half steps.
std::vector<Eigen::Vector3d> Neighbours(const Eigen::Vector3d& centre, double step,
                                        const Eigen::AlignedBox3d& box) {
  std::vector<Eigen::Vector3d> places;
  places.reserve(27);
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3d offset = Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).cast<double>();
    places.push_back(Inside(box, centre + step * offset));
  }
  return places;
}

// Returns whether a lobe shines straight down, to both sides or to all.
bool IsDown(const Tried& tried) {
  return tried.lobe.distribution == Distribution::kIsotropic || tried.lobe.aim.z() < -0.99;
}

// Leaves out lobes that are not aimed down and leave no less than two thirds of the squares of the best that is: at a place
// that is known, most luminaires shine down, and what the mesh lacks may favour any other axis by a little.
std::vector<Tried> MostlyDown(std::vector<Tried> tried) {
  double down = std::numeric_limits<double>::infinity();
  for (const Tried& t : tried)
    if (IsDown(t)) down = std::min(down, t.cost);
  tried.erase(std::remove_if(tried.begin(), tried.end(),
                             [&](const Tried& t) { return !IsDown(t) && kRival * t.cost >= down; }),
              tried.end());
  return tried;
}

}  // namespace

void GroupSearch::Start(const SparseSource& source) {
  Tried tried;
  tried.position = source.luminaire.position;
  tried.half_length = source.half_length;
  const LitPlaces here = LitFrom(tried);
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

bool GroupSearch::AddOne(const LitPlaces& grid, const LitPlaces& seen) {
  const Eigen::MatrixXd rest = Others(sources_.size());
  const double before = equations_.Solve(rest).solution.cost;
  const auto is_free = [&](const Eigen::Vector3d& p) { return IsFree(p); };
  std::vector<Tried> lobes = RefinedBins(trials_.BestOfBins(lobes_, rest, grid, is_free), rest);
  const auto is_new = [&](const Eigen::Vector3d& p) {
    return std::none_of(sources_.begin(), sources_.end(), [&](const Tried& t) { return t.position == p; });
  };
  for (Tried& at_seen : MostlyDown(trials_.BestOfBins(AtKnownPlace(), rest, seen, is_new)))
    lobes.push_back(TurnedInPlace(at_seen, rest));
  const auto best = std::min_element(lobes.begin(), lobes.end(), IsBetter);
  if (best == lobes.end() || !(best->cost < before)) return false;
  sources_.push_back(*best);
  kind_.push_back({});
  return true;
}

void GroupSearch::MoveAll() {
  if (sources_.size() < 2 || refinements_ == 0) return;
  constexpr int kSweeps = 5, kCoarse = 2;
  for (int sweep = 0; sweep < kSweeps && MoveEach(0, std::min(kCoarse, refinements_)); ++sweep) {
  }
  MoveEach(std::min(kCoarse, refinements_), refinements_);
}

void GroupSearch::TurnAll() {
  for (size_t j = 0; j < sources_.size() && sources_.size() > 1; ++j) {
    if (stays(j)) continue;
    const Eigen::MatrixXd rest = Others(j);
    const std::vector<Tried> lobes =
        Sorted(MostlyDown(trials_.BestOfBins(AtKnownPlace(), rest, LitFrom(sources_[j]))));
    if (!lobes.empty()) sources_[j] = TurnedInPlace(lobes.front(), rest);
  }
}

void GroupSearch::ReshapeSeen() {
  constexpr int kSweeps = 2;  // each lobe depends on the others
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (size_t j = 0; j < sources_.size(); ++j) {
      const Tried& source = sources_[j];
      if (!is_seen(j) || is_held(j) || !IsDown(source)) continue;
      const Tried best = trials_.Best(IsInMidAir(source.position) ? LobesInMidAir() : LobesUnderCeiling(),
                                      Others(j), LitFrom(source));
      if (std::isfinite(best.cost)) sources_[j] = best;
    }
  }
}

bool GroupSearch::IsInMidAir(const Eigen::Vector3d& place) const {
  // Half of what a Lambertian back emits falls within this distance of a surface.
  constexpr double kBehindM = 0.1;
  return !room_.rays.Occluded(place, place + kBehindM * Eigen::Vector3d::UnitZ());
}

bool GroupSearch::IsFree(const Eigen::Vector3d& place) const {
  constexpr double kOneM = 0.3;
  for (size_t j = 0; j < sources_.size(); ++j) {
    if (!is_seen(j)) continue;
    const Eigen::Vector3d& half = sources_[j].half_length;
    const Eigen::Vector3d off = place - sources_[j].position;
    const double along = half.isZero() ? 0 : std::clamp(off.dot(half) / half.squaredNorm(), -1.0, 1.0);
    if ((off - along * half).norm() < kOneM) return false;
  }
  return true;
}

std::vector<Tried> GroupSearch::RivalsOf(size_t source, const LitPlaces& grid) const {
  const Tried& own = sources_[source];
  const Eigen::MatrixXd rest = Others(source);
  const auto is_apart = [&](const Eigen::Vector3d& p) { return (p - own.position).norm() > step_m_; };
  const auto is_near = [&](const Eigen::Vector3d& p) { return !is_apart(p); };
  // Compares on the same coarse grid: rivals are nearly as good as the source's own surroundings.
  const std::vector<Tried> near = Sorted(trials_.BestOfBins(lobes_, rest, grid, is_near));
  const double fine = equations_.SolveWith(equations_.Solve(rest), own.column).cost;
  const double coarse = near.empty() ? fine : near.front().cost;
  std::vector<Tried> promising, rivals;
  for (const Tried& lobe : trials_.BestOfBins(lobes_, rest, grid, is_apart))
    if (lobe.cost <= kRival * coarse) promising.push_back(lobe);
  for (const Tried& lobe : RefinedBins(std::move(promising), rest))
    if (lobe.cost <= kRival * fine && is_apart(lobe.position)) rivals.push_back(lobe);
  return Sorted(std::move(rivals));
}

double GroupSearch::MeanSquareIn(const GroupEquations& others) const {
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(others.rows().size()),
                          static_cast<Eigen::Index>(sources_.size()));
  for (size_t j = 0; j < sources_.size(); ++j) {
    const LitPlaces here = LitFrom(sources_[j]);
    columns.col(static_cast<Eigen::Index>(j)) =
        LobeColumns(others.Weighted(here.light[0]), {sources_[j].lobe}).cast<double>();
  }
  return others.MeanSquare(others.Solve(columns).residual);
}

Eigen::MatrixXd GroupSearch::Others(size_t without) const {
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(equations_.rows().size()), 0);
  for (size_t j = 0; j < sources_.size(); ++j) {
    if (j == without) continue;
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.col(columns.cols() - 1) = sources_[j].column;
  }
  return columns;
}

std::vector<Tried> GroupSearch::RefinedBins(std::vector<Tried> bins, const Eigen::MatrixXd& rest) const {
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

std::vector<Lobe> GroupSearch::LobesAbout(const Lobe& lobe, int halvings) const {
  if (lobes_ == LobeSet::kSimple) return {lobe};
  const double shrunk = std::ldexp(1, -halvings);
  return LobesNear(lobe, kAimStepRad * shrunk, 1 + shrunk);
}

Tried GroupSearch::Refined(const Tried& source, int halvings, const Eigen::MatrixXd& rest,
                           bool any_lobe) const {
  std::vector<Eigen::Vector3d> near = Neighbours(source.position, std::ldexp(step_m_, -halvings), box_);
  near.erase(std::remove_if(near.begin(), near.end(), [&](const Eigen::Vector3d& p) { return !IsFree(p); }),
             near.end());
  const bool is_any = any_lobe && lobes_ == LobeSet::kSimple;
  const Tried best = trials_.Best(is_any ? SimpleLobes() : LobesAbout(source.lobe, halvings), rest,
                                  Lit(room_, places_, std::move(near), views_));
  return IsBetter(best, source) ? best : source;
}

Tried GroupSearch::TurnedInPlace(Tried source, const Eigen::MatrixXd& rest) const {
  if (lobes_ == LobeSet::kSimple) return source;
  const LitPlaces here = LitFrom(source);
  for (int r = 1; r <= std::max(1, refinements_); ++r) {
    const Tried best = trials_.Best(LobesAbout(source.lobe, r), rest, here);
    if (IsBetter(best, source)) source = best;
  }
  return source;
}

bool GroupSearch::MoveEach(int from_halvings, int to_halvings) {
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

}  // namespace luxfit
