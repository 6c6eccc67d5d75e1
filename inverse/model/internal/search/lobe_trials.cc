#include "inverse/model/internal/search/lobe_trials.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace luxfit {
namespace {

constexpr size_t kBrightPlaces = 6;

struct Promising {
  float gain = 0;
  size_t place = 0;
  Lobe lobe;
};

}  // namespace

std::vector<Tried> Sorted(std::vector<Tried> tried) {
  std::stable_sort(tried.begin(), tried.end(), IsBetter);
  return tried;
}

std::vector<Tried> LobeTrials::BestOfBins(LobeSet set, const Eigen::MatrixXd& others, const LitPlaces& places,
                                          const AllowedPlaces& allowed) const {
  const GroupEquations::Base base = equations_.Solve(others);
  if (set != LobeSet::kAimed) {
    const std::vector<Lobe>& lobes = set == LobeSet::kSimple ? SimpleLobes() : LobesOfKnownPlaces();
    BinnedLobes simple{lobes, std::vector<size_t>(lobes.size())};
    std::iota(simple.bin.begin(), simple.bin.end(), size_t{0});
    return BestOf([&](const LitPlace&) { return simple; }, simple.bin.size(), base, places, allowed);
  }
  const std::vector<Eigen::Index> bright = BrightSensors(base);
  const size_t bins = 1 + kAimedExponents.size() * bright.size();
  return BestOf([&](const LitPlace& place) { return AimedLobes(place, bright); }, bins, base, places,
                allowed);
}

Tried LobeTrials::Best(const std::vector<Lobe>& lobes, const Eigen::MatrixXd& others,
                       const LitPlaces& places) const {
  BinnedLobes one_bin{lobes, std::vector<size_t>(lobes.size(), 0)};
  const std::vector<Tried> best =
      BestOf([&](const LitPlace&) { return one_bin; }, 1, equations_.Solve(others), places, {});
  return best.empty() ? Tried{} : best.front();
}

std::vector<Tried> LobeTrials::BestOf(const LobesAt& lobes_at, size_t bins, const GroupEquations::Base& base,
                                      const LitPlaces& places, const AllowedPlaces& allowed) const {
  const size_t count = places.positions.size();
  std::vector<std::vector<Promising>> gains(bins, std::vector<Promising>(count));  // the best of each place
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    if (allowed && !allowed(places.positions[i])) return;
    const BinnedLobes tried = lobes_at(places.light[i]);
    const Eigen::VectorXf gain =
        GroupEquations::Gains(base, LobeColumns(equations_.Weighted(places.light[i]), tried.lobes));
    for (size_t l = 0; l < tried.lobes.size(); ++l) {
      Promising& best = gains[tried.bin[l]][i];
      if (gain[static_cast<Eigen::Index>(l)] > best.gain &&
          !IsRefuted(tried.lobes[l], places.light[i].watching, counts_))
        best = {gain[static_cast<Eigen::Index>(l)], i, tried.lobes[l]};
    }
  });
  constexpr size_t kExact = 6;  // places of each bin, the most promising
  std::vector<Tried> best(bins);
  tbb::parallel_for(size_t{0}, bins, [&](size_t bin) {
    std::vector<Promising>& promising = gains[bin];
    const auto end = promising.begin() + static_cast<std::ptrdiff_t>(std::min(kExact, count));
    std::partial_sort(promising.begin(), end, promising.end(), [](const Promising& a, const Promising& b) {
      return std::tie(b.gain, b.place) < std::tie(a.gain, a.place);
    });
    for (auto next = promising.begin(); next != end && next->gain > 0; ++next) {
      const Eigen::VectorXd column =
          LobeColumns(equations_.Weighted(places.light[next->place]), {next->lobe}).cast<double>();
      const GroupEquations::Solution solution = equations_.SolveWith(base, column);
      if (!(solution.strength[solution.strength.size() - 1] > 0) || solution.cost >= best[bin].cost) continue;
      best[bin] = {places.positions[next->place], next->lobe, places.light[next->place].half_length, column,
                   solution.cost};
    }
  });
  best.erase(
      std::remove_if(best.begin(), best.end(), [](const Tried& tried) { return !std::isfinite(tried.cost); }),
      best.end());
  return best;
}

// Returns the sensors of the brightest light that nothing explains yet, apart from one another.
std::vector<Eigen::Index> LobeTrials::BrightSensors(const GroupEquations::Base& base) const {
  const Eigen::VectorXd unexplained = equations_.Unexplained(base);
  std::vector<Eigen::Index> order(static_cast<size_t>(unexplained.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return unexplained[a] > unexplained[b]; });
  std::vector<Eigen::Index> bright;
  const auto place_of = [&](Eigen::Index sensor) { return sensors_[static_cast<size_t>(sensor)].position; };
  for (const Eigen::Index row : order) {
    if (bright.size() == kBrightPlaces || !(unexplained[row] > 0)) break;
    const Eigen::Index sensor = equations_.rows()[static_cast<size_t>(row)];
    if (std::all_of(bright.begin(), bright.end(), [&](Eigen::Index other) {
          return (place_of(other) - place_of(sensor)).norm() > apart_m_;
        }))
      bright.push_back(sensor);
  }
  return bright;
}

LobeTrials::BinnedLobes LobeTrials::AimedLobes(const LitPlace& place,
                                               const std::vector<Eigen::Index>& bright) {
  BinnedLobes aimed{{SimpleLobes().front()}, {0}};  // the isotropic one has no aim
  const auto add = [&](size_t width, size_t target, const Eigen::Vector3d& aim) {
    aimed.lobes.push_back({Distribution::kCosinePower, kAimedExponents[width], aim});
    aimed.bin.push_back(1 + width * bright.size() + target);
  };
  const auto is_lit = [&](size_t target) { return place.lx_per_cd[bright[target]] > 0; };
  const auto towards = [&](size_t target) -> Eigen::Vector3d {
    return place.rays.row(bright[target]).transpose().cast<double>().normalized();
  };
  for (size_t target = 0; target < bright.size(); ++target) {
    for (size_t width = 0; is_lit(target) && width < kAimedExponents.size(); ++width)
      add(width, target, towards(target));
  }
  for (const Eigen::Vector3d& aim : AimsOverSphere()) {
    size_t nearest = bright.size();
    double cosine = 0;
    for (size_t target = 0; target < bright.size(); ++target) {
      if (!is_lit(target) || !(aim.dot(towards(target)) > cosine)) continue;
      nearest = target;
      cosine = aim.dot(towards(target));
    }
    for (size_t width = 0; nearest < bright.size() && width < kAimedExponents.size(); ++width)
      if (cosine > HalfPeakCosine(kAimedExponents[width])) add(width, nearest, aim);
  }
  return aimed;
}

}  // namespace luxfit
