#include "calib/luminance/vignetting.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "calib/luminance/luminance.h"
#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr int kFolds = 5;
constexpr int kVignettingRounds = 12;
constexpr double kHuber = 2.5;
constexpr size_t kMinSamples = 30;
constexpr int kGrid = 32;

// Holds a sample with its r^2 and ln value; rows are kept in the order of surfaces.
struct Row {
  int photo, surface, fold;
  double r2, log_value, sigma;
};

std::vector<Row> RowsOf(const std::vector<VignettingSample>& samples, int photos, const Vignetting& none) {
  std::map<int, int> surfaces;  // renumbered without gaps
  std::vector<Row> rows;
  rows.reserve(samples.size());
  for (const VignettingSample& sample : samples) {
    if (sample.photo < 0 || sample.photo >= photos || !(sample.value > 0) || !std::isfinite(sample.value) ||
        !(sample.relative_sigma > 0) || !sample.pixel.allFinite())
      throw std::invalid_argument(
          "EstimateVignetting: expected samples of known photos, values and sigmas > 0");
    const int surface = surfaces.emplace(sample.surface, static_cast<int>(surfaces.size())).first->second;
    rows.push_back({sample.photo, surface, 0, none.Radius2At(sample.pixel), std::log(sample.value),
                    sample.relative_sigma});
  }
  // Whole surfaces are held out, unless there are too few of them: a flat field is only one.
  const bool by_surface = static_cast<int>(surfaces.size()) >= 2 * kFolds;
  for (size_t i = 0; i < rows.size(); ++i)
    rows[i].fold = (by_surface ? rows[i].surface : static_cast<int>(i)) % kFolds;
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.surface < b.surface; });
  return rows;
}

struct Solution {
  Eigen::VectorXd x;  // coefficients, then gains
  Eigen::MatrixXd normal;
  Eigen::VectorXd weight;  // robust, one for each row
};

class Problem {
 public:
  Problem(const std::vector<Row>& rows, int photos, int order, double gain_prior)
      : rows_(rows), photos_(gain_prior > 0 ? photos : 0), order_(order), gain_prior_(gain_prior) {
    for (const Row& row : rows) surfaces_ = std::max(surfaces_, row.surface + 1);
  }

  int surfaces() const { return surfaces_; }

  // Solves without the rows of fold `left_out` (-1: with all rows).
  Solution Solve(int left_out) const {
    Solution solution;
    solution.weight = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(rows_.size()));
    solution.x = Eigen::VectorXd::Zero(order_ + photos_);
    for (int round = 0; round < kVignettingRounds; ++round) {
      Step(left_out, solution);
      const Eigen::VectorXd residual = Residuals(solution, left_out, false);
      for (Eigen::Index i = 0; i < residual.size(); ++i)
        solution.weight[i] = std::min(1.0, kHuber / std::max(1e-12, std::abs(residual[i])));
    }
    return solution;
  }

  // Returns residuals in sigmas, about the weighted mean of each surface over the rows of the fold (or of all
  // others).
  Eigen::VectorXd Residuals(const Solution& solution, int fold, bool inside) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(surfaces_), weights = sum;
    Eigen::VectorXd residual(static_cast<Eigen::Index>(rows_.size()));
    for (size_t i = 0; i < rows_.size(); ++i) {
      const Eigen::Index at = static_cast<Eigen::Index>(i);
      residual[at] = rows_[i].log_value - Modelled(rows_[i], solution.x);
      if ((rows_[i].fold == fold) != inside) continue;
      const double weight = solution.weight[at] / (rows_[i].sigma * rows_[i].sigma);
      sum[rows_[i].surface] += weight * residual[at];
      weights[rows_[i].surface] += weight;
    }
    for (size_t i = 0; i < rows_.size(); ++i) {
      const Eigen::Index at = static_cast<Eigen::Index>(i);
      const int s = rows_[i].surface;
      residual[at] = weights[s] > 0 ? (residual[at] - sum[s] / weights[s]) / rows_[i].sigma : 0;
    }
    return residual;
  }

  // Returns the mean Huber loss of the rows held out.
  double HeldOutLoss(int fold) const {
    const Solution solution = Solve(fold);
    const Eigen::VectorXd residual = Residuals(solution, fold, true);
    double loss = 0, count = 0;
    for (size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].fold != fold) continue;
      const double z = std::abs(residual[static_cast<Eigen::Index>(i)]);
      loss += z < kHuber ? z * z : kHuber * (2 * z - kHuber);
      count += 1;
    }
    return count > 0 ? loss / count : 0;
  }

 private:
  double Modelled(const Row& row, const Eigen::VectorXd& x) const {
    double power = 1, sum = photos_ > 0 ? x[order_ + row.photo] : 0;
    for (int k = 0; k < order_; ++k) sum += x[k] * (power *= row.r2);
    return sum;
  }

  // Returns the unknowns that a row involves: every coefficient, and its photo's gain.
  std::vector<Eigen::Index> UnknownsOf(const Row& row) const {
    std::vector<Eigen::Index> unknowns;
    unknowns.reserve(static_cast<size_t>(order_) + 1);
    for (Eigen::Index k = 0; k < order_; ++k) unknowns.push_back(k);
    if (photos_ > 0) unknowns.push_back(order_ + row.photo);
    return unknowns;
  }

  // Returns d model / d unknown, in the order of UnknownsOf.
  std::vector<double> DerivativesOf(const Row& row) const {
    std::vector<double> derivatives;
    derivatives.reserve(static_cast<size_t>(order_) + 1);
    double power = 1;
    for (int k = 0; k < order_; ++k) derivatives.push_back(power *= row.r2);
    if (photos_ > 0) derivatives.push_back(1);
    return derivatives;
  }

  void Step(int left_out, Solution& solution) const {
    const Eigen::Index unknowns = order_ + photos_;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    solution.normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
    for (size_t first = 0; first < rows_.size();) {
      size_t last = first;
      while (last < rows_.size() && rows_[last].surface == rows_[first].surface) ++last;
      AddSurface(first, last, left_out, solution, right);
      first = last;
    }
    for (Eigen::Index g = order_; g < unknowns; ++g) solution.normal(g, g) += 1 / (gain_prior_ * gain_prior_);
    // The small diagonal keeps a direction without any information where it is.
    solution.normal.diagonal().array() += 1e-6;
    if (unknowns > 0) solution.x = solution.normal.ldlt().solve(right);
  }

  // Adds the rows [first, last) of one surface, with its luminance eliminated.
  void AddSurface(size_t first, size_t last, int left_out, Solution& solution, Eigen::VectorXd& right) const {
    std::map<Eigen::Index, double> mean;
    double mean_value = 0, weights = 0;
    for (size_t i = first; i < last; ++i) {
      const Row& row = rows_[i];
      if (row.fold == left_out) continue;
      const double weight = solution.weight[static_cast<Eigen::Index>(i)] / (row.sigma * row.sigma);
      const std::vector<Eigen::Index> at = UnknownsOf(row);
      const std::vector<double> d = DerivativesOf(row);
      for (size_t a = 0; a < at.size(); ++a) {
        mean[at[a]] += weight * d[a];
        right[at[a]] += weight * row.log_value * d[a];
        for (size_t b = 0; b < at.size(); ++b) solution.normal(at[a], at[b]) += weight * d[a] * d[b];
      }
      mean_value += weight * row.log_value;
      weights += weight;
    }
    if (!(weights > 0)) return;
    for (const auto& [a, of_a] : mean) {
      right[a] -= of_a * mean_value / weights;
      for (const auto& [b, of_b] : mean) solution.normal(a, b) -= of_a * of_b / weights;
    }
  }

  const std::vector<Row>& rows_;
  int photos_, order_, surfaces_ = 0;
  double gain_prior_;
};

Eigen::VectorXd HeldOutLosses(const Problem& problem) {
  Eigen::VectorXd loss(kFolds);
  for (int fold = 0; fold < kFolds; ++fold) loss[fold] = problem.HeldOutLoss(fold);
  return loss;
}

// Returns the first order that is worse than the best by no more than that difference's standard error over
// the folds.
int SimplestWithinOneStandardError(const std::vector<Eigen::VectorXd>& losses) {
  const auto best = std::min_element(
      losses.begin(), losses.end(),
      [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return a.mean() < b.mean(); });
  for (size_t i = 0; i < losses.size(); ++i) {
    const Eigen::ArrayXd worse = losses[i] - *best;
    const double standard_error = std::sqrt((worse - worse.mean()).square().sum() / (kFolds - 1) / kFolds);
    if (worse.mean() <= standard_error) return static_cast<int>(i);
  }
  return static_cast<int>(best - losses.begin());
}

double RobustRms(const Eigen::VectorXd& absolute) {
  return kSigmaPerMad * Quantile({absolute.begin(), absolute.end()}, 0.5);
}

}  // namespace

VignettingEstimate EstimateVignetting(const std::vector<VignettingSample>& samples, int photos,
                                      const Vignetting& none, const VignettingOptions& options) {
  VignettingEstimate estimate;
  estimate.vignetting = none;
  estimate.log_gain = Eigen::VectorXd::Zero(photos);
  const std::vector<Row> rows = RowsOf(samples, photos, none);
  if (rows.size() < kMinSamples) {
    estimate.message = "fewer than 30 samples";
    return estimate;
  }
  std::vector<Eigen::VectorXd> losses;
  losses.reserve(static_cast<size_t>(options.max_order) + 1);
  for (int order = 0; order <= options.max_order; ++order)
    losses.push_back(HeldOutLosses(Problem(rows, photos, order, options.gain_prior)));
  const int order = SimplestWithinOneStandardError(losses);
  const Problem problem(rows, photos, order, options.gain_prior);
  const Solution solution = problem.Solve(-1);
  Eigen::VectorXd residual = problem.Residuals(solution, -1, false);
  for (size_t i = 0; i < rows.size(); ++i) residual[static_cast<Eigen::Index>(i)] *= rows[i].sigma;
  // Residuals about fitted means are smaller than the noise.
  const double count = static_cast<double>(rows.size());
  const double fitted = static_cast<double>(problem.surfaces() + solution.x.size());
  estimate.residual_rms = RobustRms(residual.cwiseAbs()) * std::sqrt(count / std::max(1.0, count - fitted));
  estimate.vignetting.coefficients = solution.x.head(order);
  if (options.gain_prior > 0) estimate.log_gain = solution.x.tail(photos);
  // Where the order is 0, the first term of order 1 tells whether the samples could determine V at all.
  const Solution asked = order > 0 ? solution : Problem(rows, photos, 1, options.gain_prior).Solve(-1);
  Eigen::VectorXd corner = Eigen::VectorXd::Zero(asked.x.size());
  corner.head(std::max(1, order)).setOnes();
  estimate.corner_sigma = std::sqrt(corner.dot(asked.normal.ldlt().solve(corner)));
  if (!(estimate.corner_sigma < options.max_corner_sigma)) {
    estimate.message = "too few surfaces are seen both near the centre and near the border of photos";
    estimate.vignetting = none;
    estimate.log_gain.setZero();
    return estimate;
  }
  estimate.is_determined = true;
  return estimate;
}

VignettingEstimate VignettingOfFlatField(const LuminanceImage& flat_field, const VignettingOptions& options) {
  const Eigen::Index height = flat_field.valid.rows(), width = flat_field.valid.cols();
  std::vector<VignettingSample> samples;
  samples.reserve(static_cast<size_t>(kGrid) * kGrid);
  for (Eigen::Index row = 0; row < kGrid; ++row) {
    for (Eigen::Index column = 0; column < kGrid; ++column) {
      const Eigen::Index top = row * height / kGrid, bottom = (row + 1) * height / kGrid;
      const Eigen::Index left = column * width / kGrid, right = (column + 1) * width / kGrid;
      double sum = 0, count = 0;
      for (Eigen::Index v = top; v < bottom; ++v) {
        for (Eigen::Index u = left; u < right; ++u) {
          if (!flat_field.valid(v, u)) continue;
          sum += static_cast<double>(flat_field.relative_luminance(v, u));
          count += 1;
        }
      }
      if (count < 0.5 * static_cast<double>((bottom - top) * (right - left)) || !(sum > 0)) continue;
      samples.push_back(
          {0,
           {static_cast<double>(left + right - 1) / 2, static_cast<double>(top + bottom - 1) / 2},
           0,
           sum / count,
           0.005});
    }
  }
  VignettingOptions one_photo = options;
  one_photo.gain_prior = 0;
  return EstimateVignetting(samples, 1, NoVignetting(static_cast<int>(width), static_cast<int>(height)),
                            one_photo);
}

}  // namespace luxfit
