#include "inverse/choose/internal/profile_direct_share.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "forward/luminaire/distribution_ops.h"
#include "inverse/choose/internal/choose_model.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/part_smoothness.h"

namespace luxfit {
namespace {

using Blocks = std::vector<int>;  // block of each reading; -1: not used

// Returns blocks of a state's readings, in a grid of 4 cells along each side of their box.
Blocks BlocksOf(const LightData& data) {
  std::map<int, Eigen::AlignedBox3d> box_of_state;
  for (const Reading& r : data.readings) {
    if (r.used) box_of_state[r.state].extend(r.sensor.position);
  }
  constexpr int kSide = 4;
  Blocks blocks;
  blocks.reserve(data.readings.size());
  std::map<std::array<int, 4>, int> names;
  for (const Reading& r : data.readings) {
    if (!r.used) {
      blocks.push_back(-1);
      continue;
    }
    const Eigen::AlignedBox3d& box = box_of_state.at(r.state);
    const Eigen::Array3d at = (r.sensor.position - box.min()).array() / box.sizes().array().max(1e-9) * kSide;
    const Eigen::Array3i cell = at.cast<int>().min(kSide - 1);
    const std::array<int, 4> key{r.state, cell[0], cell[1], cell[2]};
    blocks.push_back(names.emplace(key, static_cast<int>(names.size())).first->second);
  }
  return blocks;
}

double ShareOf(const LightData& data, const Prediction& prediction) {
  const Eigen::Index first = FirstReadingRow(data);
  double direct = 0, total = 0;
  for (size_t i = 0; i < data.readings.size(); ++i) {
    if (!data.readings[i].used) continue;
    direct += prediction.direct[first + static_cast<Eigen::Index>(i)];
    total += prediction.value[first + static_cast<Eigen::Index>(i)];
  }
  return total > 0 ? direct / total : 0;
}

// Evaluates one candidate's fit: its share, the share's sigma and its residuals.
class Evaluated {
 public:
  Evaluated(const Room& room, const LightData& data, const LuminaireFit& fit,
            const std::vector<ParameterPrior>& priors, const Blocks& blocks)
      : data_(data), fit_(fit), model_(room, data), blocks_(blocks) {
    model_.FreezeVisibility(fit.state);
    prediction_ = model_.Predict(fit.state, fit.parameters, true);
    FillResiduals(fit.relative_sigma);
    FillHessian(priors);
  }

  double Share() const { return ShareOf(data_, prediction_); }

  double Sigma() const {
    const Eigen::Index n = hessian_.rows();
    if (n == 0) return 0;
    std::map<int, Eigen::VectorXd> gradient_of_block;
    for (Eigen::Index i = 0; i < residual_.size(); ++i) {
      const int block = blocks_[static_cast<size_t>(i)];
      if (block < 0) continue;
      Eigen::VectorXd& g = gradient_of_block.try_emplace(block, Eigen::VectorXd::Zero(n)).first->second;
      g += residual_[i] * jacobian_.row(i).transpose();
    }
    const Eigen::VectorXd share_gradient = ShareGradient();
    const Eigen::VectorXd back = hessian_.ldlt().solve(share_gradient);
    double variance = 0;
    for (const auto& [block, g] : gradient_of_block) variance += std::pow(g.dot(back), 2);
    // The sigma is never below that of independent readings.
    return std::sqrt(std::max(variance, share_gradient.dot(back)));
  }

  // Returns squared residuals over a model error common to all candidates, summed by block.
  std::map<int, double> SquaresByBlock(double relative_sigma) const {
    std::map<int, double> squares;
    for (size_t i = 0; i < data_.readings.size(); ++i) {
      if (blocks_[i] < 0) continue;
      const Reading& r = data_.readings[i];
      const double sigma = std::hypot(r.sigma_lx, relative_sigma * r.illuminance_lx);
      const Eigen::Index row = FirstReadingRow(data_) + static_cast<Eigen::Index>(i);
      squares[blocks_[i]] += std::pow((prediction_.value[row] - r.illuminance_lx) / sigma, 2);
    }
    return squares;
  }

 private:
  void FillResiduals(double relative_sigma) {
    const auto readings = static_cast<Eigen::Index>(data_.readings.size());
    jacobian_ = prediction_.jacobian.middleRows(FirstReadingRow(data_), readings);
    residual_.setZero(readings);
    for (Eigen::Index i = 0; i < readings; ++i) {
      const Reading& r = data_.readings[static_cast<size_t>(i)];
      const double sigma = std::hypot(r.sigma_lx, relative_sigma * r.illuminance_lx);
      const double weight = r.used && sigma > 0 ? 1 / sigma : 0;
      jacobian_.row(i) *= weight;
      residual_[i] = weight * (prediction_.value[FirstReadingRow(data_) + i] - r.illuminance_lx);
    }
  }

  void FillHessian(const std::vector<ParameterPrior>& priors) {
    hessian_ = jacobian_.transpose() * jacobian_;
    for (const ParameterPrior& prior : priors) {
      for (size_t p = 0; p < fit_.parameters.size(); ++p) {
        const auto i = static_cast<Eigen::Index>(p);
        if (fit_.parameters[p].Is(prior.kind, prior.index, prior.quantity))
          hessian_(i, i) += 1 / (prior.sigma * prior.sigma);
      }
    }
    AddSmoothness(SmoothnessRows(fit_.state, fit_.parameters), hessian_);
    hessian_.diagonal() *= 1 + 1e-9;
  }

  Eigen::VectorXd ShareGradient() const {
    const Eigen::VectorXd x = PackParameters(fit_.state, fit_.parameters);
    Eigen::VectorXd gradient(x.size());
    for (Eigen::Index p = 0; p < x.size(); ++p) {
      constexpr double kStep = 1e-3;  // in logarithms, metres, rad and reflectances; light is float
      const auto share_at = [&](double step) {
        return ShareOf(data_, model_.Predict(WithParameters(fit_.state, fit_.parameters,
                                                            x + step * Eigen::VectorXd::Unit(x.size(), p)),
                                             {}, false));
      };
      gradient[p] = (share_at(kStep) - share_at(-kStep)) / (2 * kStep);
    }
    return gradient;
  }

  const LightData& data_;
  const LuminaireFit& fit_;
  LightModel model_;
  const Blocks& blocks_;
  Prediction prediction_;
  Eigen::MatrixXd jacobian_, hessian_;
  Eigen::VectorXd residual_;
};

struct Variant {
  Distribution distribution;
  LuminaireShape shape;
};

// Makes every open luminaire the variant. Returns false where that changes none.
bool Apply(const Variant& variant, const std::vector<OpenChoice>& open, LightState& state) {
  bool changed = false;
  for (size_t k = 0; k < state.luminaires.size(); ++k) {
    Luminaire& luminaire = state.luminaires[k];
    FreeQuantities& free = state.free[k];
    const bool other_lobe = open[k].distribution && luminaire.distribution != variant.distribution;
    const bool other_shape = open[k].shape && luminaire.shape != variant.shape;
    changed = changed || other_lobe || other_shape;
    if (open[k].distribution) {
      luminaire.distribution = variant.distribution;
      free.exponent = OpsOf(variant.distribution).has_exponent;
      free.table_sigma = 0;
    }
    if (!open[k].shape) continue;
    if (luminaire.shape == LuminaireShape::kPoint) luminaire.size_m.setConstant(kStartSizeM);
    luminaire.shape = variant.shape;
    free.size = variant.shape != LuminaireShape::kPoint;
    free.emission_sigma = 0;
    luminaire.emission.resize(0, 0);
  }
  return changed;
}

struct Named {
  std::string name;
  LuminaireFit fit;
};

std::vector<Named> FitVariants(const Room& room, const LightData& data, const LuminaireFit& fit,
                               const std::vector<OpenChoice>& open,
                               const std::vector<ParameterPrior>& priors) {
  std::vector<Named> fits{{"as fitted", fit}};
  for (const LuminaireShape shape :
       {LuminaireShape::kPoint, LuminaireShape::kDisc, LuminaireShape::kRectangle}) {
    for (const DistributionOps& ops : Distributions()) {
      LightState start = fit.state;
      if (!ops.is_tried || !Apply({ops.distribution, shape}, open, start)) continue;
      FitLuminairesOptions quick;
      quick.covariance = false;
      fits.push_back(
          {std::string(ops.name) + " " + ToString(shape), FitLuminaires(room, data, start, priors, quick)});
    }
  }
  return fits;
}

// Returns whether b is within one standard error of a, block by block.
bool IsWithinOneError(const std::map<int, double>& a, const std::map<int, double>& b) {
  const double n = static_cast<double>(a.size());
  if (n < 2) return true;
  double mean = 0, squares = 0;
  for (const auto& [block, value] : a) mean += (b.at(block) - value) / n;
  for (const auto& [block, value] : a) squares += std::pow(b.at(block) - value - mean, 2);
  return mean <= std::sqrt(squares / (n * (n - 1)));
}

double Sum(const std::map<int, double>& squares) {
  double sum = 0;
  for (const auto& [block, value] : squares) sum += value;
  return sum;
}

}  // namespace

DirectShare ProfileDirectShare(const Room& room, const LightData& data, const LuminaireFit& fit,
                               const std::vector<OpenChoice>& open,
                               const std::vector<ParameterPrior>& priors) {
  const Blocks blocks = BlocksOf(data);
  const std::vector<Named> fits = FitVariants(room, data, fit, open, priors);
  double relative_sigma = 1;
  for (const Named& named : fits) relative_sigma = std::min(relative_sigma, named.fit.relative_sigma);
  std::vector<std::map<int, double>> squares;
  DirectShare result;
  size_t best = 0;
  for (const Named& named : fits) {
    const Evaluated evaluated(room, data, named.fit, priors, blocks);
    squares.push_back(evaluated.SquaresByBlock(relative_sigma));
    const auto used = std::count_if(blocks.begin(), blocks.end(), [](int block) { return block >= 0; });
    result.candidates.push_back({named.name, evaluated.Share(), evaluated.Sigma(),
                                 std::sqrt(Sum(squares.back()) / static_cast<double>(used)), false});
    if (Sum(squares.back()) < Sum(squares[best])) best = squares.size() - 1;
  }
  result.share = result.candidates.front().share;
  result.lower = result.upper = result.share;
  constexpr double kAsGood = 1.15, kTwoSided95 = 1.96, kMostDoubt = 0.1;
  for (size_t c = 0; c < fits.size(); ++c) {
    DirectShareCandidate& candidate = result.candidates[c];
    candidate.is_admissible = c == 0 || candidate.rms <= kAsGood * result.candidates[best].rms ||
                              IsWithinOneError(squares[best], squares[c]);
    if (!candidate.is_admissible) continue;
    result.lower = std::min(result.lower, candidate.share - kTwoSided95 * candidate.sigma);
    result.upper = std::max(result.upper, candidate.share + kTwoSided95 * candidate.sigma);
  }
  result.lower = std::max(result.lower, 0.0);
  result.upper = std::min(result.upper, 1.0);
  result.is_determined = result.upper - result.share <= kMostDoubt * result.share &&
                         result.share - result.lower <= kMostDoubt * result.share;
  return result;
}

}  // namespace luxfit
