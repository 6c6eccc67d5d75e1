#include "inverse/observe/camera/internal/radiometry/photo_equations.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <set>

#include "calib/luminance/median.h"
#include "inverse/select/internal/robust_weight.h"

namespace luxfit {
namespace {

constexpr double kCauchy = 2.5;   // in units of the residuals' scale
constexpr size_t kFewFacets = 5;  // up to this many, residuals are grouped by patch
constexpr double kRankLimit = 1e-6;
constexpr int kLightSteps = 6;
constexpr double kLightConverged = 1e-6;

Eigen::VectorXd LeastSquares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(kRankLimit);
  return qr.compute(matrix).solve(right);
}

Eigen::MatrixXd BaseOfStates(const std::vector<Eigen::VectorXd>& dimming) {
  Eigen::MatrixXd all(static_cast<Eigen::Index>(dimming.size()), dimming.front().size());
  for (size_t s = 0; s < dimming.size(); ++s) all.row(static_cast<Eigen::Index>(s)) = dimming[s].transpose();
  // Luminaires that are always dimmed alike share one column.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(all, Eigen::ComputeThinU);
  const Eigen::Index rank = (svd.singularValues().array() > kRankLimit * svd.singularValues()[0]).count();
  return svd.matrixU().leftCols(rank) * svd.singularValues().head(rank).asDiagonal();
}

// Damps the normal equations: light that no row sees stays where it is.
Eigen::MatrixXd Damped(Eigen::MatrixXd normal) {
  normal.diagonal().array() += 1e-10 * normal.trace();
  return normal;
}

// Minimises sum w (y - ln(U B))^2 over B, from `light`. It shortens steps that would leave a state without
// light.
void FitLight(const Eigen::MatrixXd& base, const Eigen::VectorXd& y, const Eigen::VectorXd& weight,
              Eigen::Ref<Eigen::VectorXd> light) {
  Eigen::VectorXd modelled = base * light;
  for (int round = 0; round < kLightSteps; ++round) {
    const Eigen::MatrixXd of_light = modelled.cwiseInverse().asDiagonal() * base;
    const Eigen::MatrixXd weighted = weight.asDiagonal() * of_light;
    const Eigen::VectorXd residual = y.array() - modelled.array().log();
    const Eigen::VectorXd step =
        Damped(weighted.transpose() * of_light).ldlt().solve(weighted.transpose() * residual);
    const Eigen::VectorXd change = base * step;
    const double most = -change.cwiseQuotient(modelled).minCoeff();
    const double length = most > 0.8 ? 0.8 / most : 1;
    light += length * step;
    modelled += length * change;
    if (change.cwiseQuotient(modelled).cwiseAbs().maxCoeff() < kLightConverged) return;
  }
}

int FacetOf(const Patches& patches, int element) {
  const int patch = patches.elements[static_cast<size_t>(element)].patch;
  return patches.patches[static_cast<size_t>(patch)].facet;
}

std::set<int> CamerasOf(const std::vector<PhotoSample>& samples) {
  std::set<int> cameras;
  for (const PhotoSample& sample : samples) cameras.insert(sample.camera);
  return cameras;
}

// Returns the samples of the elements that have more of them than unknowns of their own light.
std::map<int, std::vector<PhotoSample>> InformativeElements(const std::vector<PhotoSample>& samples,
                                                            const Eigen::MatrixXd& base) {
  std::map<int, std::vector<PhotoSample>> by_element;
  for (const PhotoSample& sample : samples) {
    // Light that remains with everything off does not add up with the luminaires'.
    if (base.row(sample.state).squaredNorm() > 0) by_element[sample.element].push_back(sample);
  }
  for (auto at = by_element.begin(); at != by_element.end();) {
    std::set<int> states;
    for (const PhotoSample& sample : at->second) states.insert(sample.state);
    const size_t own = std::min(states.size(), static_cast<size_t>(base.cols()));
    at = at->second.size() > own ? std::next(at) : by_element.erase(at);
  }
  return by_element;
}

}  // namespace

PhotoEquations::PhotoEquations(const Patches& patches, const std::vector<Eigen::VectorXd>& dimming,
                               const std::vector<PhotoSample>& samples, int max_elements)
    : base_(BaseOfStates(dimming)) {
  const std::map<int, std::vector<PhotoSample>> by_element = InformativeElements(samples, base_);
  std::map<std::set<int>, std::vector<int>> by_cameras;
  std::set<int> facets;
  for (const auto& [index, of_element] : by_element) {
    by_cameras[CamerasOf(of_element)].push_back(index);
    facets.insert(FacetOf(patches, index));
  }
  const int sets = static_cast<int>(by_cameras.size());
  for (const auto& [cameras, elements] : by_cameras) {
    const size_t most = static_cast<size_t>(std::max(1, (max_elements + sets - 1) / sets));
    const size_t stride = (elements.size() + most - 1) / most;
    for (size_t i = 0; i < elements.size(); i += stride) {
      const int patch = patches.elements[static_cast<size_t>(elements[i])].patch;
      const int group = facets.size() < kFewFacets ? patch : FacetOf(patches, elements[i]);
      AddRows(by_element.at(elements[i]), cameras, patch % kFolds, group);
    }
  }
}

void PhotoEquations::AddRows(const std::vector<PhotoSample>& of_element, const std::set<int>& cameras,
                             int fold, int group) {
  ElementRows element;
  element.first = rows();
  element.count = static_cast<int>(of_element.size());
  element.fold = fold;
  element.group = group;
  element.base.resize(element.count, base_.cols());
  for (int i = 0; i < element.count; ++i)
    element.base.row(i) = base_.row(of_element[static_cast<size_t>(i)].state);
  element.cameras.assign(cameras.begin(), cameras.end());
  rows_.insert(rows_.end(), of_element.begin(), of_element.end());
  elements_.push_back(std::move(element));
}

const PhotoSample& PhotoEquations::RowOf(const ElementRows& element, int i) const {
  return rows_[static_cast<size_t>(element.first) + static_cast<size_t>(i)];
}

Eigen::VectorXd PhotoEquations::Corrected(const RadiometryUnknowns& unknowns, const Eigen::VectorXd& x,
                                          const ElementRows& element) const {
  Eigen::VectorXd y(element.count);
  for (int i = 0; i < element.count; ++i) {
    const PhotoSample& sample = RowOf(element, i);
    const size_t camera = static_cast<size_t>(sample.camera);
    y[i] = sample.log_value;
    if (unknowns.exponent[camera] >= 0) y[i] += x[unknowns.exponent[camera]] * sample.log_share;
    if (unknowns.camera[camera] >= 0) y[i] -= x[unknowns.camera[camera]];
    if (unknowns.first_gain >= 0) y[i] -= x[unknowns.first_gain + sample.photo];
    double power = 1;
    for (int k = 0; unknowns.vignetting[camera] >= 0 && k < unknowns.order; ++k)
      y[i] -= x[unknowns.vignetting[camera] + k] * (power *= sample.radius2);
  }
  return y;
}

Eigen::VectorXd PhotoEquations::Power(const RadiometryUnknowns& unknowns, const Eigen::VectorXd& x,
                                      const ElementRows& element) const {
  Eigen::VectorXd power = Eigen::VectorXd::Ones(element.count);
  for (int i = 0; i < element.count; ++i) {
    const int at = unknowns.exponent[static_cast<size_t>(RowOf(element, i).camera)];
    if (at >= 0) power[i] = 1 / (1 + x[at]);
  }
  return power;
}

Eigen::VectorXd PhotoEquations::Weights(const Fit& fit, const ElementRows& element) const {
  Eigen::VectorXd weight(element.count);
  for (int i = 0; i < element.count; ++i) {
    const double sigma = RowOf(element, i).relative_sigma;
    weight[i] = fit.weight[element.first + i] / (sigma * sigma + common_sigma_ * common_sigma_);
  }
  return weight;
}

PhotoEquations::Fit PhotoEquations::Start(const RadiometryUnknowns& unknowns) const {
  Fit fit;
  fit.x = Eigen::VectorXd::Zero(unknowns.count);
  fit.weight = Eigen::VectorXd::Ones(rows());
  fit.light.resize(base_.cols(), elements());
  for (int e = 0; e < elements(); ++e) {
    const ElementRows& element = elements_[static_cast<size_t>(e)];
    const Eigen::VectorXd value = Corrected(unknowns, fit.x, element).array().exp();
    // Relative residuals are linear in the light.
    const Eigen::MatrixXd& base = element.base;
    const Eigen::VectorXd light =
        LeastSquares(value.cwiseInverse().asDiagonal() * base, Eigen::VectorXd::Ones(element.count));
    fit.light.col(e) = light;
    // Exposures that are far off can lead to negative light: then all that is on gives the same.
    if (!((base * light).array() > 0.2 * value.array()).all())
      fit.light.col(e) =
          LeastSquares(base_, Eigen::VectorXd::Constant(base_.rows(), std::exp(value.array().log().mean())));
    if (!((base * fit.light.col(e)).array() > 0).all()) fit.light.col(e).setConstant(std::nan(""));
  }
  return fit;
}

// Returns the few unknowns of an element: those of its cameras, and one gain for each row.
std::vector<int> PhotoEquations::UnknownsOf(const RadiometryUnknowns& unknowns,
                                            const ElementRows& element) const {
  std::vector<int> unknown;
  unknown.reserve(static_cast<size_t>(element.count) + 5 * element.cameras.size());
  for (const int camera : element.cameras) {
    const size_t c = static_cast<size_t>(camera);
    for (int k = 0; unknowns.vignetting[c] >= 0 && k < unknowns.order; ++k)
      unknown.push_back(unknowns.vignetting[c] + k);
    if (unknowns.exponent[c] >= 0) unknown.push_back(unknowns.exponent[c]);
    if (unknowns.camera[c] >= 0) unknown.push_back(unknowns.camera[c]);
  }
  for (int i = 0; unknowns.first_gain >= 0 && i < element.count; ++i)
    unknown.push_back(unknowns.first_gain + RowOf(element, i).photo);
  return unknown;
}

Eigen::MatrixXd PhotoEquations::Derivatives(const RadiometryUnknowns& unknowns, const ElementRows& element,
                                            const std::vector<int>& unknown,
                                            const Eigen::VectorXd& scaled_residual) const {
  const size_t gains = unknowns.first_gain >= 0 ? static_cast<size_t>(element.count) : 0;
  const size_t of_cameras = unknown.size() - gains;
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(element.count, static_cast<Eigen::Index>(unknown.size()));
  for (int i = 0; i < element.count; ++i) {
    const PhotoSample& sample = RowOf(element, i);
    const size_t camera = static_cast<size_t>(sample.camera);
    for (size_t a = 0; a < of_cameras; ++a) {
      const int k = unknown[a] - unknowns.vignetting[camera];
      double& derivative = jacobian(i, static_cast<Eigen::Index>(a));
      if (unknowns.vignetting[camera] >= 0 && k >= 0 && k < unknowns.order)
        derivative = -std::pow(sample.radius2, k + 1);
      if (unknown[a] == unknowns.exponent[camera]) derivative = sample.log_share - scaled_residual[i];
      if (unknown[a] == unknowns.camera[camera]) derivative = -1;
    }
    if (gains > 0) jacobian(i, static_cast<Eigen::Index>(of_cameras) + i) = -1;
  }
  return jacobian;
}

void PhotoEquations::AddElement(const RadiometryUnknowns& unknowns, const Fit& fit, Eigen::Index index,
                                Sums& sums) const {
  const ElementRows& element = elements_[static_cast<size_t>(index)];
  const Eigen::VectorXd power = Power(unknowns, fit.x, element);
  const Eigen::VectorXd weight = Weights(fit, element).cwiseProduct(power.cwiseAbs2());
  const Eigen::VectorXd modelled = element.base * fit.light.col(index);
  const Eigen::VectorXd residual = Corrected(unknowns, fit.x, element) - modelled.array().log().matrix();
  sums.cost += weight.dot(residual.cwiseAbs2()) / 2;
  const std::vector<int> unknown = UnknownsOf(unknowns, element);
  const Eigen::MatrixXd jacobian = Derivatives(unknowns, element, unknown, power.cwiseProduct(residual));
  const Eigen::MatrixXd of_light = modelled.cwiseInverse().asDiagonal() * element.base;
  const Eigen::MatrixXd weighted = weight.asDiagonal() * jacobian;
  const Eigen::MatrixXd mixed = of_light.transpose() * weighted;
  const Eigen::MatrixXd normal =
      jacobian.transpose() * weighted -
      mixed.transpose() * Damped(of_light.transpose() * weight.asDiagonal() * of_light).ldlt().solve(mixed);
  const Eigen::VectorXd right = -weighted.transpose() * residual;
  for (size_t a = 0; a < unknown.size(); ++a) {
    sums.right[unknown[a]] += right[static_cast<Eigen::Index>(a)];
    for (size_t b = 0; b < unknown.size(); ++b)
      sums.normal(unknown[a], unknown[b]) +=
          normal(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }
}

std::vector<PhotoEquations::Sums> PhotoEquations::Linearize(const RadiometryUnknowns& unknowns,
                                                            Fit& fit) const {
  const Sums none{Eigen::MatrixXd::Zero(unknowns.count, unknowns.count),
                  Eigen::VectorXd::Zero(unknowns.count)};
  std::vector<Sums> by_fold(kFolds, none);
  tbb::parallel_for(0, kFolds, [&](int fold) {
    for (int e = 0; e < elements(); ++e) {
      const ElementRows& element = elements_[static_cast<size_t>(e)];
      if (element.fold != fold || !fit.light.col(e).allFinite()) continue;
      FitLight(element.base, Corrected(unknowns, fit.x, element),
               Weights(fit, element).cwiseProduct(Power(unknowns, fit.x, element).cwiseAbs2()),
               fit.light.col(e));
      AddElement(unknowns, fit, e, by_fold[static_cast<size_t>(fold)]);
    }
  });
  return by_fold;
}

void PhotoEquations::Reweigh(const RadiometryUnknowns& unknowns, Fit& fit) const {
  std::vector<double> in_sigmas, absolute;
  in_sigmas.reserve(rows_.size());
  absolute.reserve(rows_.size());
  double own = unknowns.count;
  Eigen::VectorXd z = Eigen::VectorXd::Zero(rows());
  for (int e = 0; e < elements(); ++e) {
    const ElementRows& element = elements_[static_cast<size_t>(e)];
    if (!fit.light.col(e).allFinite()) continue;
    own += static_cast<double>(base_.cols());
    const Eigen::VectorXd residual =
        Power(unknowns, fit.x, element).array() *
        (Corrected(unknowns, fit.x, element).array() - (element.base * fit.light.col(e)).array().log());
    for (int i = 0; i < element.count; ++i) {
      const double sigma = RowOf(element, i).relative_sigma;
      z[element.first + i] = std::abs(residual[i]) / std::hypot(sigma, common_sigma_);
      in_sigmas.push_back(z[element.first + i]);
      absolute.push_back(std::abs(residual[i]));
    }
  }
  if (in_sigmas.empty()) return;
  // Residuals about fitted light are smaller than the noise, by the degrees of freedom.
  const double count = static_cast<double>(in_sigmas.size());
  const double freedom = std::sqrt(count / std::max(1.0, count - own));
  fit.scale = std::max(1.0, kSigmaPerMad * freedom * Median(in_sigmas));
  fit.sigma = kSigmaPerMad * freedom * Median(absolute);
  fit.weight = z.unaryExpr([&](double size) { return CauchyWeight(size, kCauchy * fit.scale); });
}

GroupScores PhotoEquations::Score(const RadiometryUnknowns& unknowns, const Fit& fit,
                                  const Eigen::VectorXd& x, int fold) const {
  GroupScores scores;
  for (int e = 0; e < elements(); ++e) {
    const ElementRows& element = elements_[static_cast<size_t>(e)];
    if (element.fold != fold || !fit.light.col(e).allFinite()) continue;
    const Eigen::VectorXd y = Corrected(unknowns, x, element), power = Power(unknowns, x, element);
    Eigen::VectorXd light = fit.light.col(e);
    FitLight(element.base, y, Weights(fit, element).cwiseProduct(power.cwiseAbs2()), light);
    const Eigen::VectorXd residual = power.array() * (y.array() - (element.base * light).array().log());
    for (int i = 0; i < element.count; ++i)
      scores[element.group].Add(residual[i] / std::hypot(RowOf(element, i).relative_sigma, common_sigma_));
  }
  return scores;
}

std::map<int, Eigen::VectorXd> PhotoEquations::GradientByGroup(const RadiometryUnknowns& unknowns,
                                                               const Fit& fit) const {
  std::map<int, Eigen::VectorXd> gradient;
  for (int e = 0; e < elements(); ++e) {
    const ElementRows& element = elements_[static_cast<size_t>(e)];
    if (!fit.light.col(e).allFinite()) continue;
    Sums sums{Eigen::MatrixXd::Zero(unknowns.count, unknowns.count), Eigen::VectorXd::Zero(unknowns.count)};
    AddElement(unknowns, fit, e, sums);
    const auto of_group = gradient.try_emplace(element.group, Eigen::VectorXd::Zero(unknowns.count)).first;
    of_group->second += sums.right;
  }
  return gradient;
}

}  // namespace luxfit
