#include "inverse/observe/ambient_light.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include "inverse/select/internal/robust_rows.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

// Elements that are compared, taken evenly: a few hundred tell shares to a percent.
constexpr size_t kMostElements = 3000;

// Returns by column the sums of states that are no light at all: states x sums.
Eigen::MatrixXd SumsOfNoLight(const std::vector<Eigen::VectorXd>& dimming) {
  Eigen::MatrixXd all(dimming.front().size(), static_cast<Eigen::Index>(dimming.size()));
  for (size_t s = 0; s < dimming.size(); ++s) all.col(static_cast<Eigen::Index>(s)) = dimming[s];
  Eigen::FullPivLU<Eigen::MatrixXd> lu(all);
  lu.setThreshold(1e-9);
  return lu.dimensionOfKernel() > 0 ? Eigen::MatrixXd(lu.kernel())
                                    : Eigen::MatrixXd(static_cast<Eigen::Index>(dimming.size()), 0);
}

// Numbers views, and holds what each shows of an element in a state.
class AmbientEstimator {
 public:
  AmbientEstimator(const Patches& patches, const std::vector<Observation>& observations,
                   const std::vector<Eigen::VectorXd>& dimming)
      : patches_(patches), dimming_(dimming) {
    for (const Observation& o : observations) {
      if (!(o.relative_luminance > 0)) continue;
      views_ = std::max(views_, o.view + 1);
      if (IsDark(o.state)) {
        off_[o.element].emplace(o.view, o);
        has_off_.insert(o.view);
      } else {
        lit_[o.state][o.element].emplace(o.view, o.relative_luminance);
      }
    }
  }

  AmbientLight Run() {
    const Eigen::VectorXd log_off = RowsOfOff().Solve(0, kShareSigma, views_, -1);
    FillOff(log_off);
    size_t number = 0;
    const size_t stride = (off_.size() + kMostElements - 1) / kMostElements;
    for (const auto& [element, of_view] : off_)
      if (number++ % stride == 0) compared_.insert(element);
    AmbientLight light = WithShares(log_off);
    light.spread = SpreadOf(log_off, light.share);
    for (const auto& [element, of_view] : off_)
      for (const auto& [view, o] : of_view) light.off.emplace(std::pair(view, element), o);
    return light;
  }

 private:
  using ByElement = std::map<int, std::map<int, double>>;  // by element and view

  int PatchOf(int element) const { return patches_.elements[static_cast<size_t>(element)].patch; }

  // Returns what off photos of two views differ by, of ln O. Unknowns: by view.
  RobustRows RowsOfOff() const {
    RobustRows rows;
    for (const auto& [element, of_view] : off_)
      for (auto a = of_view.begin(); a != of_view.end(); ++a)
        for (auto b = std::next(a); b != of_view.end(); ++b)
          rows.Add({{a->first, 1}, {b->first, -1}},
                   std::log(a->second.relative_luminance / b->second.relative_luminance), 1,
                   PatchOf(element));
    return rows;
  }

  // Gives views without an off photo the mean of the others' at the elements that they show.
  void FillOff(const Eigen::VectorXd& log_off) {
    for (auto& [element, of_view] : off_) {
      const Observation mean = MeanOf(of_view, log_off);
      for (const auto& [state, elements] : lit_) {
        const auto lit = elements.find(element);
        if (lit == elements.end()) continue;
        for (const auto& [view, value] : lit->second) {
          if (has_off_.count(view) > 0) continue;
          Observation own = mean;
          own.view = view;
          of_view.emplace(view, own);
        }
      }
    }
  }

  static Observation MeanOf(const std::map<int, Observation>& of_view, const Eigen::VectorXd& log_off) {
    Observation mean = of_view.begin()->second;
    mean.relative_luminance = mean.variance = 0;
    mean.relative_rgb.setZero();
    const auto count = static_cast<double>(of_view.size());
    for (const auto& [view, o] : of_view) {
      const double factor = std::exp(-log_off[view]) / count;
      mean.relative_luminance += factor * o.relative_luminance;
      mean.relative_rgb += factor * o.relative_rgb;
      mean.variance += factor * factor * o.variance;
    }
    mean.variance += std::pow(kLeastBetweenViews * mean.relative_luminance, 2);
    return mean;
  }

  int UnknownOf(int view, int state) const { return state * views_ + view; }

  AmbientLight WithShares(const Eigen::VectorXd& log_off) const {
    AmbientLight light;
    RobustRows rows;
    for (const auto& [state, elements] : lit_) AddPairs(state, elements, rows);
    AddSums(rows);
    if (rows.count() == 0) return light;
    const Eigen::MatrixXd untold = UntoldShares(log_off);
    const Eigen::VectorXd x = SharesOf(rows, untold, -1);
    std::map<std::pair<int, int>, double> share;
    for (const auto& [state, elements] : lit_)
      for (const auto& [element, of_view] : elements)
        for (const auto& [view, value] : of_view) share[{view, state}] = x[UnknownOf(view, state)];
    const double noise = rows.NoiseAt(x);
    const GroupScores ones = ScoresOf(rows, noise, std::nullopt), shares = ScoresOf(rows, noise, untold);
    SelectionOptions options;
    options.worth_having = kWorthHaving;
    const Selection selection = SimplestWithinOneStandardError(
        {{ones, 0, true}, {shares, static_cast<double>(share.size()), true}}, options);
    light.score_of_ones = selection.score[0];
    light.score_of_shares = selection.score[1];
    // The light of a view without an off photo may differ from the mean of the others by any share.
    if (selection.chosen == 1 || has_off_.size() < static_cast<size_t>(views_))
      light.share = std::move(share);
    return light;
  }

  // Adds what views of an element differ by in a state.
  void AddPairs(int state, const ByElement& lit, RobustRows& rows) const {
    for (const auto& [element, of_view] : lit) {
      if (compared_.count(element) == 0) continue;
      for (auto a = of_view.begin(); a != of_view.end(); ++a) {
        const Observation* const off_a = OffAt(element, a->first);
        if (off_a == nullptr) continue;
        for (auto b = std::next(a); b != of_view.end(); ++b) {
          const Observation* const off_b = OffAt(element, b->first);
          if (off_b == nullptr) continue;
          rows.Add({{UnknownOf(a->first, state), off_a->relative_luminance},
                    {UnknownOf(b->first, state), -off_b->relative_luminance}},
                   a->second - b->second, std::hypot(a->second, b->second), PatchOf(element));
        }
      }
    }
  }

  // Adds what a view shows of an element in states whose light adds up to none.
  void AddSums(RobustRows& rows) const {
    const Eigen::MatrixXd sums = SumsOfNoLight(dimming_);
    for (Eigen::Index sum = 0; sum < sums.cols(); ++sum)
      for (const int element : compared_)
        for (const auto& [view, off] : off_.at(element)) AddSum(sums.col(sum), element, off, rows);
  }

  void AddSum(const Eigen::VectorXd& by_state, int element, const Observation& off, RobustRows& rows) const {
    std::vector<RobustRows::Term> terms;
    double value = 0, squares = 0;
    for (Eigen::Index s = 0; s < by_state.size(); ++s) {
      const auto state = static_cast<int>(s);
      const double by = by_state[s];
      if (std::abs(by) < 1e-9 || IsDark(state)) continue;
      const auto elements = lit_.find(state);
      if (elements == lit_.end()) return;
      const auto of_view = elements->second.find(element);
      if (of_view == elements->second.end()) return;
      const auto seen = of_view->second.find(off.view);
      if (seen == of_view->second.end()) return;
      terms.push_back({UnknownOf(off.view, state), by * off.relative_luminance});
      value += by * seen->second;
      squares += std::pow(by * seen->second, 2);
    }
    if (squares > 0) rows.Add(terms, value, std::sqrt(squares), PatchOf(element));
  }

  const Observation* OffAt(int element, int view) const {
    const auto of_view = off_.find(element);
    if (of_view == off_.end()) return nullptr;
    const auto off = of_view->second.find(view);
    return off == of_view->second.end() ? nullptr : &off->second;
  }

  bool IsDark(int state) const { return (dimming_[static_cast<size_t>(state)].array() == 0).all(); }

  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(dimming_.size()) * views_; }

  // Returns by column how shares change, unseen by any row, where ambient light is taken for that of a luminaire.
  Eigen::MatrixXd UntoldShares(const Eigen::VectorXd& log_off) const {
    Eigen::MatrixXd untold = Eigen::MatrixXd::Zero(unknowns(), dimming_.front().size());
    for (const auto& [state, elements] : lit_)
      for (const auto& [element, of_view] : elements)
        for (const auto& [view, value] : of_view)
          untold.row(UnknownOf(view, state)) =
              dimming_[static_cast<size_t>(state)].transpose() * std::exp(-log_off[view]);
    return untold;
  }

  // Returns the shares by the rows but those of a fold. A thing that only one view shows differs by the luminaires' light, too, and
  // would move what no row tells: that is set so that shares are about 1.
  Eigen::VectorXd SharesOf(const RobustRows& rows, const Eigen::MatrixXd& untold, int without) const {
    const Eigen::VectorXd x = rows.Solve(1, kShareSigma, unknowns(), without);
    return x + untold * untold.colPivHouseholderQr().solve((1 - x.array()).matrix());
  }

  // Scores rows by fits without their fold; without `untold`, by shares of 1. `noise`: relative.
  GroupScores ScoresOf(const RobustRows& rows, double noise,
                       const std::optional<Eigen::MatrixXd>& untold) const {
    GroupScores scores;
    for (int fold = 0; fold < RobustRows::kFolds; ++fold) {
      const Eigen::VectorXd x =
          untold ? SharesOf(rows, *untold, fold) : Eigen::VectorXd(Eigen::VectorXd::Ones(unknowns()));
      for (size_t i = 0; i < rows.count(); ++i)
        if (rows.FoldOf(i) == fold) scores[rows.GroupOf(i)].Add(rows.Residual(i, x) / noise);
    }
    return scores;
  }

  // Returns by how much the ambient light of photos differs. `log_off`: ln of each off photo's, relative.
  double SpreadOf(const Eigen::VectorXd& log_off, const std::map<std::pair<int, int>, double>& shares) const {
    std::vector<double> of_photo;
    for (const int view : has_off_) of_photo.push_back(std::exp(log_off[view]));
    for (const auto& [photo, share] : shares)
      of_photo.push_back(share * std::exp(has_off_.count(photo.first) > 0 ? log_off[photo.first] : 0));
    if (of_photo.empty()) return 0;
    const Eigen::Map<const Eigen::ArrayXd> light(of_photo.data(), static_cast<Eigen::Index>(of_photo.size()));
    return std::sqrt((light / light.mean() - 1).square().mean());
  }

  const Patches& patches_;
  const std::vector<Eigen::VectorXd>& dimming_;
  int views_ = 0;
  std::set<int> has_off_;                          // views
  std::map<int, std::map<int, Observation>> off_;  // by element and view
  std::map<int, ByElement> lit_;                   // by state
  std::set<int> compared_;                         // elements
};

}  // namespace

AmbientLight EstimateAmbientLight(const Patches& patches, const std::vector<Observation>& observations,
                                  const std::vector<Eigen::VectorXd>& dimming) {
  return AmbientEstimator(patches, observations, dimming).Run();
}

}  // namespace luxfit
