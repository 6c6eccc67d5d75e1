#include "inverse/observe/surface_labels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "inverse/observe/internal/adjacent_elements.h"
#include "inverse/observe/internal/label_posterior.h"
#include "inverse/observe/internal/pair_scatter.h"
#include "inverse/observe/internal/photo_offsets.h"
#include "inverse/observe/internal/view_difference.h"
#include "inverse/observe/internal/view_table.h"

namespace luxfit {
namespace {

constexpr size_t kLeastPairs = 30;        // fewer tell no scatter
constexpr int kRounds = 4, kSweeps = 10;  // bound the work; surface_labels_test shows that they suffice there
constexpr double kAgreement = 1;          // b

struct ViewPair {
  int a = 0, b = 0;  // columns of one element, a < b
  ViewDifference difference;
};

// Holds by how much a view of something else differs. It starts as another paint, lit a little differently.
struct OtherSurface {
  double common_variance = 0.25, state_variance = 0.04;
  double share = 0.05;
};

// Runs expectation-maximisation. It is a class because each step reads what the others found.
class Labeller {
 public:
  Labeller(const Room& room, const ViewTable& table)
      : table_(table), neighbours_(AdjacentColumns(room, table)), pairs_(PairsOf(table)) {
    own_ = Eigen::VectorXd::Ones(table.columns());
    other_of_pair_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(pairs_.size()));
    Eigen::Index pair = 0;
    for (int e = 0; e < table.elements(); ++e) {
      first_pair_.push_back(pair);
      const Eigen::Index n = table.first[static_cast<size_t>(e) + 1] - table.first[static_cast<size_t>(e)];
      pair += n * (n - 1) / 2;
    }
  }

  bool HasEnough() const { return pairs_.size() >= kLeastPairs; }

  void Run() {
    FindScatter();
    for (int round = 0; round < kRounds; ++round) {
      if (round == 0) own_.setConstant(1 - other_.share);
      FindDensities();
      for (int sweep = 0; sweep < kSweeps; ++sweep) Sweep();
      Maximise();
    }
  }

  SurfaceLabels Labels() const {
    SurfaceLabels labels;
    labels.is_estimated = HasEnough();
    labels.common_sigma = std::sqrt(common_variance_);
    labels.state_sigma = std::sqrt(state_variance_);
    labels.other_share = 1 - own_.mean();
    for (int c = 0; c < table_.columns(); ++c) {
      const auto i = static_cast<size_t>(c);
      labels.views.push_back({table_.element[i], table_.view[i], own_[c]});
    }
    return labels;
  }

 private:
  // Pairs stand by element, in the order of a, then b.
  static std::vector<ViewPair> PairsOf(const ViewTable& table) {
    std::vector<ViewPair> pairs;
    for (int e = 0; e < table.elements(); ++e) {
      const int end = table.first[static_cast<size_t>(e) + 1];
      for (int a = table.first[static_cast<size_t>(e)]; a < end; ++a) {
        for (int b = a + 1; b < end; ++b) pairs.push_back({a, b, {}});
      }
    }
    tbb::parallel_for(size_t{0}, pairs.size(),
                      [&](size_t i) { pairs[i].difference = DifferenceOf(table, pairs[i].a, pairs[i].b); });
    return pairs;
  }

  // Estimates c and r from all pairs.
  void FindScatter() {
    std::vector<ScatterPair> common, by_state;
    for (const ViewPair& pair : pairs_) {
      const ViewDifference& d = pair.difference;
      if (d.states == 0) continue;
      const double weight = 2.0 / ViewsOfElement(pair.a);
      common.push_back({d.common * d.common, d.common_noise, weight});
      if (d.states < 2) continue;
      // A deviation from the mean over n states has 1 - 1/n of the variance.
      const double share = 1 - 1.0 / d.states;
      for (int s = 0; s < d.states; ++s)
        by_state.push_back({std::pow(d.value[s] - d.common, 2) / share, d.noise[s], weight});
    }
    const double state = by_state.empty() ? 0 : ComponentOf(by_state);
    common_variance_ = std::pow(std::max(kLeastBetweenViews, ComponentOf(common)), 2);
    state_variance_ = std::pow(std::max(kLeastBetweenViews, state), 2);
  }

  int ViewsOfElement(int column) const {
    const auto next = std::upper_bound(table_.first.begin(), table_.first.end(), column);
    return *next - *(next - 1);
  }

  void FindDensities() {
    log_own_.resize(static_cast<Eigen::Index>(pairs_.size()));
    log_other_.resize(log_own_.size());
    tbb::parallel_for(size_t{0}, pairs_.size(), [&](size_t i) {
      const ViewDifference& d = pairs_[i].difference;
      const double common = 2 * common_variance_, state = 2 * state_variance_;
      log_own_[static_cast<Eigen::Index>(i)] = LogDensity(d, common, state);
      log_other_[static_cast<Eigen::Index>(i)] =
          LogDensity(d, common + other_.common_variance, state + other_.state_variance);
    });
  }

  // Updates the probabilities once from those of the neighbours.
  void Sweep() {
    const double logit = std::log(1 / other_.share - 1);
    Eigen::VectorXd prior(table_.columns());
    for (int c = 0; c < table_.columns(); ++c) {
      double votes = 0;
      for (const int n : neighbours_[static_cast<size_t>(c)]) votes += 2 * own_[n] - 1;
      prior[c] = 1 / (1 + std::exp(-(logit + kAgreement * votes)));
    }
    prior = prior.cwiseMax(1e-9).cwiseMin(1 - 1e-9);
    Eigen::VectorXd own = prior;
    tbb::parallel_for(0, table_.elements(), [&](int e) { Update(e, prior, own); });
    own_ = 0.5 * (own_ + own);  // all views change at once: half a step does not swing
  }

  // Finds the posterior of the views of one element.
  void Update(int e, const Eigen::VectorXd& prior, Eigen::VectorXd& own) {
    const int first = table_.first[static_cast<size_t>(e)];
    const int n = table_.first[static_cast<size_t>(e) + 1] - first;
    if (n < 2) return;
    Eigen::MatrixXd log_own = Eigen::MatrixXd::Zero(n, n), log_other = log_own;
    Eigen::Index pair = first_pair_[static_cast<size_t>(e)];
    for (int a = 0; a < n; ++a) {
      for (int b = a + 1; b < n; ++b, ++pair) {
        log_own(a, b) = log_own(b, a) = log_own_[pair];
        log_other(a, b) = log_other(b, a) = log_other_[pair];
      }
    }
    const LabelPosterior posterior = PosteriorOf(log_own, log_other, prior.segment(first, n));
    own.segment(first, n) = posterior.own;
    pair = first_pair_[static_cast<size_t>(e)];
    for (int a = 0; a < n; ++a) {
      for (int b = a + 1; b < n; ++b, ++pair)
        other_of_pair_[pair] = posterior.other(a, b) + posterior.other(b, a);
    }
  }

  // Estimates how other surfaces differ, and how many there are.
  void Maximise() {
    other_.share = std::clamp(1 - own_.mean(), 1e-4, 0.5);
    double weight = 0, common = 0, state_weight = 0, state = 0;
    for (size_t i = 0; i < pairs_.size(); ++i) {
      const ViewDifference& d = pairs_[i].difference;
      const double w = other_of_pair_[static_cast<Eigen::Index>(i)];
      if (d.states == 0) continue;
      weight += w;
      common += w * (d.common * d.common - d.common_noise - 2 * common_variance_);
      if (d.states < 2) continue;
      state_weight += w;
      state +=
          w * ((d.value - d.common).square().sum() / (d.states - 1) - d.noise.mean() - 2 * state_variance_);
    }
    if (weight < kLeastPairs) return;
    // At least the scatter of one surface: else the two kinds are one.
    other_.common_variance = std::max(common / weight, 9 * common_variance_);
    if (state_weight >= kLeastPairs) other_.state_variance = std::max(state / state_weight, state_variance_);
  }

  const ViewTable& table_;
  const std::vector<std::vector<int>> neighbours_;
  const std::vector<ViewPair> pairs_;
  std::vector<Eigen::Index> first_pair_;  // of each element
  double common_variance_ = 0, state_variance_ = 0;
  OtherSurface other_;
  Eigen::VectorXd own_;                  // by column
  Eigen::VectorXd log_own_, log_other_;  // by pair
  Eigen::VectorXd other_of_pair_;        // probability that just one of both shows the element
};

// Returns the table without the photos' own errors: what is wrong with a whole photo says nothing of its elements.
ViewTable WithoutOffsets(ViewTable table) {
  const Eigen::ArrayXXd offset = PhotoOffsets(table);
  for (int c = 0; c < table.columns(); ++c)
    table.log_luminance.col(c) -= offset.col(table.view[static_cast<size_t>(c)]);
  return table;
}

}  // namespace

SurfaceLabels LabelSurfaces(const Room& room, const std::vector<Observation>& observations) {
  const ViewTable table = WithoutOffsets(TableOfViews(observations));
  if (table.columns() == 0) return {};
  Labeller labeller(room, table);
  if (labeller.HasEnough()) labeller.Run();
  return labeller.Labels();
}

std::vector<Observation> OfOwnSurface(const std::vector<Observation>& observations,
                                      const SurfaceLabels& labels) {
  std::set<std::pair<int, int>> others;  // element, view
  for (const ElementView& v : labels.views) {
    if (v.own_probability <= 0.5) others.insert({v.element, v.view});
  }
  std::vector<Observation> own;
  own.reserve(observations.size());
  for (const Observation& o : observations) {
    if (others.count({o.element, o.view}) == 0) own.push_back(o);
  }
  return own;
}

}  // namespace luxfit
