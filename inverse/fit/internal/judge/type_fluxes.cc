#include "inverse/fit/internal/judge/type_fluxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/SpecialFunctions>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr size_t kFewestForSpread = 3;
constexpr double kMakersSpread = 0.1 / 3, kMakersFreedom = 4;
constexpr double kEfficiencyOfMad = 0.37;
constexpr double kOnceIn = 0.01;

// Returns the column of the luminaire's log flux; -1: its flux is given.
Eigen::Index ColumnOf(const LuminaireFit& fit, int luminaire) {
  for (size_t i = 0; i < fit.parameters.size(); ++i)
    if (fit.parameters[i].Is(ParameterKind::kLogFlux, luminaire, {})) return static_cast<Eigen::Index>(i);
  return -1;
}

// Returns the variance of each log flux less the mean of all.
Eigen::VectorXd VariancesAboutMean(const LuminaireFit& fit, const std::vector<int>& luminaires) {
  const auto n = static_cast<Eigen::Index>(luminaires.size());
  std::vector<Eigen::Index> columns;
  columns.reserve(luminaires.size());
  for (const int k : luminaires) columns.push_back(ColumnOf(fit, k));
  if (fit.covariance.size() == 0) return Eigen::VectorXd::Zero(n);
  const Eigen::MatrixXd contrast =
      Eigen::MatrixXd::Identity(n, n) - Eigen::MatrixXd::Constant(n, n, 1.0 / static_cast<double>(n));
  const Eigen::MatrixXd covariance = fit.covariance(columns, columns);
  return (contrast * covariance * contrast.transpose()).diagonal().cwiseMax(0);
}

// Holds a variance that was estimated, with its degrees of freedom.
struct EstimatedVariance {
  double value = 0, freedom = 1;
};

// Returns the variance of log fluxes of a type, from their robust spread and what makers allow.
EstimatedVariance WithMakersSpread(double relative_spread, size_t luminaires) {
  const double freedom = kEfficiencyOfMad * (static_cast<double>(luminaires) - 1);
  const double sum = kMakersFreedom * kMakersSpread * kMakersSpread + freedom * std::pow(relative_spread, 2);
  return {sum / (kMakersFreedom + freedom), kMakersFreedom + freedom};
}

// Returns how often |t| or more comes by chance: Student's distribution, both tails.
double ChanceOf(double t, double freedom) {
  return Eigen::numext::betainc(freedom / 2, 0.5, freedom / (freedom + t * t));
}

LuminaireType Compared(const LuminaireFit& fit, const std::vector<int>& luminaires) {
  LuminaireType type{luminaires, 0, std::numeric_limits<double>::quiet_NaN(), {}};
  std::vector<double> log_flux;
  log_flux.reserve(luminaires.size());
  for (const int k : luminaires)
    log_flux.push_back(std::log(fit.state.luminaires[static_cast<size_t>(k)].flux_lm));
  const double median = Median(log_flux);
  type.flux = std::exp(median);
  if (luminaires.size() < kFewestForSpread) return type;
  std::vector<double> distance;
  distance.reserve(log_flux.size());
  for (const double value : log_flux) distance.push_back(std::abs(value - median));
  type.relative_spread = kSigmaPerMad * Median(distance);
  const EstimatedVariance between = WithMakersSpread(type.relative_spread, luminaires.size());
  const Eigen::VectorXd own = VariancesAboutMean(fit, luminaires);
  for (size_t m = 0; m < luminaires.size(); ++m) {
    const double variance = between.value + own[static_cast<Eigen::Index>(m)];
    const double z = (log_flux[m] - median) / std::sqrt(variance);
    const double freedom = between.freedom * std::pow(variance / between.value, 2);
    if (static_cast<double>(luminaires.size()) * ChanceOf(z, freedom) < kOnceIn)
      type.deviating.push_back({luminaires[m], std::exp(log_flux[m] - median), z});
  }
  return type;
}

}  // namespace

std::vector<LuminaireType> CompareTypeFluxes(const LuminaireFit& fit) {
  std::vector<LuminaireType> types;
  if (!fit.IsUsable()) return types;
  for (std::vector<int> luminaires : TypesOf(fit.state)) {
    luminaires.erase(
        std::remove_if(luminaires.begin(), luminaires.end(), [&](int k) { return ColumnOf(fit, k) < 0; }),
        luminaires.end());
    if (luminaires.size() > 1) types.push_back(Compared(fit, luminaires));
  }
  return types;
}

}  // namespace luxfit
