#include "inverse/choose/internal/needless_parameters.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "inverse/observe/internal/angle.h"

namespace luxfit {
namespace {

constexpr std::array<double, 3> kChi2Of95{0, 3.841, 5.991};  // by degrees of freedom

bool IsOneOf(const Parameter& p, int luminaire, const std::vector<LuminaireQuantity>& quantities) {
  return p.kind == ParameterKind::kLuminaire && p.index == luminaire &&
         std::count(quantities.begin(), quantities.end(), p.quantity) > 0;
}

struct Distance {
  bool is_needless = false;
  double sigma = 0;  // the largest
};

// Compares a fit with a simpler state in some quantities of one luminaire.
Distance DistanceTo(const LightState& simpler, const LuminaireFit& fit, int luminaire,
                    const std::vector<LuminaireQuantity>& quantities) {
  const Eigen::VectorXd x = PackParameters(fit.state, fit.parameters);
  const Eigen::VectorXd x0 = PackParameters(simpler, fit.parameters);
  std::vector<Eigen::Index> own;
  for (size_t i = 0; i < fit.parameters.size(); ++i)
    if (IsOneOf(fit.parameters[i], luminaire, quantities)) own.push_back(static_cast<Eigen::Index>(i));
  const auto n = static_cast<Eigen::Index>(own.size());
  if (n == 0 || static_cast<size_t>(n) >= kChi2Of95.size()) return {};
  Eigen::VectorXd difference(n);
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index row = own[static_cast<size_t>(i)];
    difference[i] = x[row] - x0[row];
    for (Eigen::Index j = 0; j < n; ++j) covariance(i, j) = fit.covariance(row, own[static_cast<size_t>(j)]);
  }
  const Eigen::LDLT<Eigen::MatrixXd> factor(covariance);
  if (!factor.isPositive() || !(covariance.diagonal().minCoeff() > 0)) return {};
  return {difference.dot(factor.solve(difference)) <= kChi2Of95[static_cast<size_t>(n)],
          std::sqrt(covariance.diagonal().maxCoeff())};
}

// Holds the exponent at 1 where the fit does not tell it from that.
std::optional<NeedlessParameter> HoldExponent(const LuminaireFit& fit, int luminaire, LightState& state) {
  const size_t k = static_cast<size_t>(luminaire);
  if (fit.state.luminaires[k].distribution != Distribution::kCosinePower) return std::nullopt;
  LightState simpler = fit.state;
  simpler.luminaires[k].cosine_exponent = 1;
  const Distance distance = DistanceTo(simpler, fit, luminaire, {LuminaireQuantity::kExponent});
  if (!distance.is_needless) return std::nullopt;
  const double exponent = fit.state.luminaires[k].cosine_exponent;
  state.luminaires[k].distribution = Distribution::kLambertian;
  state.luminaires[k].cosine_exponent = 1;
  state.free[k].exponent = false;
  return NeedlessParameter{luminaire, NeedlessKind::kExponent, exponent, exponent * distance.sigma};
}

std::optional<NeedlessParameter> HoldAim(const LuminaireFit& fit, int luminaire, const Eigen::Vector3d& aim,
                                         LightState& state) {
  const size_t k = static_cast<size_t>(luminaire);
  const Eigen::Vector3d& fitted = fit.state.luminaires[k].aim;
  // Beyond a right angle there is no tilt to compare.
  if (!fit.state.free[k].tilt || !(fitted.dot(aim) > 0)) return std::nullopt;
  LightState simpler = fit.state;
  simpler.luminaires[k].aim = aim;
  const Distance distance =
      DistanceTo(simpler, fit, luminaire, {LuminaireQuantity::kTiltAlong, LuminaireQuantity::kTiltAcross});
  if (!distance.is_needless) return std::nullopt;
  state.luminaires[k].aim = aim;
  state.free[k].tilt = false;
  return NeedlessParameter{luminaire, NeedlessKind::kTilt, AngleBetween(fitted, aim), distance.sigma};
}

std::optional<NeedlessParameter> HoldHeading(const LuminaireFit& fit, int luminaire,
                                             const Eigen::Vector3d& heading, LightState& state) {
  const size_t k = static_cast<size_t>(luminaire);
  const Luminaire& fitted = fit.state.luminaires[k];
  if (!fit.state.free[k].heading || fitted.shape != LuminaireShape::kRectangle) return std::nullopt;
  Luminaire straight = fitted;
  straight.heading = heading;
  const LuminaireAxes axes = AxesOf(straight);
  const Eigen::Vector3d along = AxesOf(fitted).along;
  const double angle = std::atan2(along.dot(axes.across), along.dot(axes.along));
  const double turn = M_PI / 2 * std::round(angle / (M_PI / 2));
  LightState simpler = fit.state;
  simpler.luminaires[k].heading = std::cos(turn) * axes.along + std::sin(turn) * axes.across;
  const Distance distance = DistanceTo(simpler, fit, luminaire, {LuminaireQuantity::kHeading});
  if (!distance.is_needless) return std::nullopt;
  state.luminaires[k].heading = simpler.luminaires[k].heading;
  state.free[k].heading = false;
  return NeedlessParameter{luminaire, NeedlessKind::kHeading, std::abs(angle - turn), distance.sigma};
}

// Turns a disc or rectangle into a point where the fit does not tell its sides from nothing.
std::optional<NeedlessParameter> HoldSize(const LuminaireFit& fit, int luminaire, LightState& state) {
  const size_t k = static_cast<size_t>(luminaire);
  const Luminaire& fitted = fit.state.luminaires[k];
  if (!fit.state.free[k].size || fitted.emission.size() > 0) return std::nullopt;
  LightState simpler = fit.state;
  simpler.luminaires[k].size_m.setZero();
  const Distance distance =
      DistanceTo(simpler, fit, luminaire, {LuminaireQuantity::kSizeAlong, LuminaireQuantity::kSizeAcross});
  if (!distance.is_needless) return std::nullopt;
  state.luminaires[k].shape = LuminaireShape::kPoint;
  state.luminaires[k].size_m.setZero();
  state.free[k].size = state.free[k].heading = false;
  return NeedlessParameter{luminaire, NeedlessKind::kSize, fitted.size_m.maxCoeff(), distance.sigma};
}

}  // namespace

SimplifiedState WithoutNeedlessParameters(const LuminaireFit& fit, const std::vector<OpenChoice>& open,
                                          const std::vector<HeldDirections>& held) {
  SimplifiedState result{fit.state, {}};
  if (!fit.IsUsable() || fit.covariance.size() == 0) return result;
  for (size_t k = 0; k < open.size(); ++k) {
    const auto luminaire = static_cast<int>(k);
    if (open[k].distribution) {
      if (const auto found = HoldExponent(fit, luminaire, result.state)) result.needless.push_back(*found);
    }
    if (open[k].shape) {
      if (const auto found = HoldSize(fit, luminaire, result.state)) {
        result.needless.push_back(*found);
        continue;  // the rest was estimated with the size
      }
    }
    if (open[k].aim) {
      if (const auto found = HoldAim(fit, luminaire, held[k].aim, result.state))
        result.needless.push_back(*found);
    }
    if (open[k].heading) {
      if (const auto found = HoldHeading(fit, luminaire, held[k].heading, result.state))
        result.needless.push_back(*found);
    }
  }
  result.state = WithLikeTypes(std::move(result.state));
  return result;
}

}  // namespace luxfit
