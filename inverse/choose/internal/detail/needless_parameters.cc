#include "inverse/choose/internal/detail/needless_parameters.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "inverse/observe/internal/angle.h"

namespace luxfit {
namespace {

constexpr std::array<double, 7> kChi2Of95{0,     3.841,  5.991, 7.815,
                                          9.488, 11.070, 12.592};  // by degrees of freedom

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

// Simplifies one luminaire of a fit, one quantity after another.
class Simplifier {
 public:
  // Keeps references. `state`: takes the simplest values.
  Simplifier(const LuminaireFit& fit, int luminaire, LightState& state)
      : fit_(fit),
        luminaire_(luminaire),
        fitted_(fit.state.luminaires[static_cast<size_t>(luminaire)]),
        own_(state.luminaires[static_cast<size_t>(luminaire)]),
        free_(state.free[static_cast<size_t>(luminaire)]),
        state_(state) {}

  // Holds the exponent at 1 where the fit does not tell it from that.
  std::optional<NeedlessParameter> HoldExponent() {
    if (fitted_.distribution != Distribution::kCosinePower) return std::nullopt;
    const auto sigma = Set([](Luminaire& l) { l.cosine_exponent = 1; }, {LuminaireQuantity::kExponent});
    if (!sigma) return std::nullopt;
    own_.distribution = Distribution::kLambertian;
    free_.exponent = false;
    const double exponent = fitted_.cosine_exponent;
    return NeedlessParameter{luminaire_, NeedlessKind::kExponent, exponent, exponent * *sigma};
  }

  std::optional<NeedlessParameter> HoldAim(const Eigen::Vector3d& aim) {
    // Beyond a right angle there is no tilt to compare.
    if (!free_.tilt || !(fitted_.aim.dot(aim) > 0)) return std::nullopt;
    const auto sigma = Set([&](Luminaire& l) { l.aim = aim; },
                           {LuminaireQuantity::kTiltAlong, LuminaireQuantity::kTiltAcross});
    if (!sigma) return std::nullopt;
    free_.tilt = false;
    return NeedlessParameter{luminaire_, NeedlessKind::kTilt, AngleBetween(fitted_.aim, aim), *sigma};
  }

  std::optional<NeedlessParameter> HoldHeading(const Eigen::Vector3d& heading) {
    if (!free_.heading || fitted_.shape != LuminaireShape::kRectangle) return std::nullopt;
    Luminaire straight = fitted_;
    straight.heading = heading;
    const LuminaireAxes axes = AxesOf(straight);
    const Eigen::Vector3d along = AxesOf(fitted_).along;
    const double angle = std::atan2(along.dot(axes.across), along.dot(axes.along));
    const double turn = M_PI / 2 * std::round(angle / (M_PI / 2));
    const Eigen::Vector3d simplest = std::cos(turn) * axes.along + std::sin(turn) * axes.across;
    const auto sigma = Set([&](Luminaire& l) { l.heading = simplest; }, {LuminaireQuantity::kHeading});
    if (!sigma) return std::nullopt;
    free_.heading = false;
    return NeedlessParameter{luminaire_, NeedlessKind::kHeading, std::abs(angle - turn), *sigma};
  }

  // Turns a disc or rectangle into a point where the fit does not tell its sides from nothing.
  std::optional<NeedlessParameter> HoldSize() {
    if (!free_.size || fitted_.emission.size() > 0) return std::nullopt;
    const auto sigma = Set([](Luminaire& l) { l.size_m.setZero(); },
                           {LuminaireQuantity::kSizeAlong, LuminaireQuantity::kSizeAcross});
    if (!sigma) return std::nullopt;
    own_.shape = LuminaireShape::kPoint;
    free_.size = free_.heading = false;
    return NeedlessParameter{luminaire_, NeedlessKind::kSize, fitted_.size_m.maxCoeff(), *sigma};
  }

 private:
  // Sets quantities to their simplest values where the fit tells neither them, nor them and those that were set before,
  // from these. Two may be needless each by itself that are not together: a wide opening spreads light as a small
  // exponent does. Returns the largest sigma of the quantities where they were set.
  std::optional<double> Set(const std::function<void(Luminaire&)>& simplify,
                            const std::vector<LuminaireQuantity>& quantities) {
    const auto k = static_cast<size_t>(luminaire_);
    LightState alone = fit_.state;
    simplify(alone.luminaires[k]);
    const Distance distance = DistanceTo(alone, fit_, luminaire_, quantities);
    if (!distance.is_needless) return std::nullopt;
    LightState together = state_;
    simplify(together.luminaires[k]);
    std::vector<LuminaireQuantity> all = set_;
    all.insert(all.end(), quantities.begin(), quantities.end());
    if (!DistanceTo(together, fit_, luminaire_, all).is_needless) return std::nullopt;
    simplify(own_);
    set_ = std::move(all);
    return distance.sigma;
  }

  const LuminaireFit& fit_;
  const int luminaire_;
  const Luminaire& fitted_;
  Luminaire& own_;
  FreeQuantities& free_;
  LightState& state_;
  std::vector<LuminaireQuantity> set_;
};

// Returns the luminaires that become points.
std::set<int> PointsOf(const SimplifiedState& simplified) {
  std::set<int> points;
  for (const NeedlessParameter& n : simplified.needless)
    if (n.kind == NeedlessKind::kSize) points.insert(n.luminaire);
  return points;
}

}  // namespace

SimplifiedState WithoutNeedlessParameters(const LuminaireFit& fit, const std::vector<OpenChoice>& open,
                                          const std::vector<HeldDirections>& held, SimplifiedFirst first) {
  SimplifiedState result{fit.state, {}};
  if (!fit.IsUsable() || fit.covariance.size() == 0) return result;
  for (size_t k = 0; k < open.size(); ++k) {
    Simplifier simplifier(fit, static_cast<int>(k), result.state);
    const auto keep = [&](const std::optional<NeedlessParameter>& found) {
      if (found) result.needless.push_back(*found);
      return found.has_value();
    };
    const auto exponent = [&] {
      if (open[k].distribution) keep(simplifier.HoldExponent());
    };
    if (first == SimplifiedFirst::kExponent) exponent();
    if (open[k].shape && keep(simplifier.HoldSize())) continue;
    if (first == SimplifiedFirst::kSize) exponent();
    if (open[k].aim) keep(simplifier.HoldAim(held[k].aim));
    if (open[k].heading) keep(simplifier.HoldHeading(held[k].heading));
  }
  result.state = WithLikeTypes(std::move(result.state));
  return result;
}

std::optional<SimplifiedState> WithOtherPoints(const LuminaireFit& fit, const std::vector<OpenChoice>& open,
                                               const std::vector<HeldDirections>& held,
                                               const SimplifiedState& exponents_first) {
  SimplifiedState sizes_first = WithoutNeedlessParameters(fit, open, held, SimplifiedFirst::kSize);
  if (PointsOf(sizes_first) == PointsOf(exponents_first)) return {};
  return sizes_first;
}

}  // namespace luxfit
