#include "tests/validation/coverage/coverage_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "inverse/fit/fit_room.h"
#include "inverse/model/fit_uncertainty.h"

namespace luxfit::coverage {
namespace {

constexpr double kNormal = 1.96, kNoInterval = std::numeric_limits<double>::quiet_NaN();

bool IsNamed(const LuminaireFit& fit, const ParameterId& parameter) {
  return std::find(fit.undetermined.begin(), fit.undetermined.end(), parameter) != fit.undetermined.end();
}

ParameterId FluxOf(const Truth& truth, size_t luminaire) {
  return {ParameterKind::kLogFlux, truth.light.luminaires[luminaire].id};
}

void CountOrName(bool is_named, double error, double sigma, Tally& tally) {
  if (is_named)
    ++tally.named;
  else
    tally.Count(error, sigma);
}

// Returns the tally of a parameter; null where the camera's scale has none.
Tally* TallyOf(ParameterKind kind, Score& score) {
  switch (kind) {
    case ParameterKind::kLuminaire:
      return &score.tallies[kPosition];
    case ParameterKind::kLogFlux:
      return &score.tallies[kFlux];
    case ParameterKind::kAlbedo:
      return &score.tallies[kAlbedo];
    default:
      return nullptr;
  }
}

void AddParameters(const LuminaireFit& fit, const FitUncertainty& known, const Truth& truth, Score& score) {
  const Eigen::VectorXd error = known.values - PackParameters(truth.light, fit.parameters);
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    Tally* const tally = TallyOf(fit.parameters[i].kind, score);
    if (tally == nullptr) continue;
    const ParameterId id = fit.parameters[i].id();
    const double sigma = fit.IsUsable() ? known.Sigma(id) : kNoInterval;
    CountOrName(IsNamed(fit, id), error[static_cast<Eigen::Index>(i)], sigma, *tally);
  }
}

void AddFluxRatios(const LuminaireFit& fit, const FitUncertainty& known, const Truth& truth, Score& score) {
  const std::vector<Luminaire>&found = fit.state.luminaires, &real = truth.light.luminaires;
  const Eigen::MatrixXd covariance = FluxCovariance(known, real);
  for (size_t a = 0; a < real.size(); ++a) {
    for (size_t b = 0; b < a; ++b) {
      const double error =
          std::log(found[a].flux_lm / found[b].flux_lm) - std::log(real[a].flux_lm / real[b].flux_lm);
      const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
      const double sigma = fit.IsUsable()
                               ? std::sqrt(covariance(i, i) + covariance(j, j) - 2 * covariance(i, j))
                               : kNoInterval;
      const bool is_named = IsNamed(fit, FluxOf(truth, a)) || IsNamed(fit, FluxOf(truth, b));
      CountOrName(is_named, error, sigma, score.tallies[kFluxRatio]);
    }
  }
}

// Returns the predictions as users read them; empty where nothing was fitted.
std::vector<PredictedReading> Predicted(const LuminaireFit& fit, const LightData& data) {
  RoomFit room_fit;
  room_fit.fit = fit;
  room_fit.data = data;
  room_fit.luminaire_found.assign(fit.state.luminaires.size(), true);
  room_fit.absolute = true;
  return PredictedReadings(room_fit);
}

void AddReadings(const LuminaireFit& fit, const LightData& data, const Truth& truth, Score& score) {
  const std::vector<PredictedReading> predicted = Predicted(fit, data);
  for (size_t r = 0; r < data.readings.size(); ++r) {
    if (data.readings[r].used) continue;
    const bool is_named = IsNamed(fit, FluxOf(truth, static_cast<size_t>(data.readings[r].state)));
    const PredictedReading reading = r < predicted.size() ? predicted[r] : PredictedReading{};
    const double error = reading.illuminance_lx - truth.reading_lx[static_cast<Eigen::Index>(r)];
    const double sigma = reading.is_known ? reading.sigma_lx : kNoInterval,
                 parameter_sigma = reading.is_known ? reading.parameter_sigma_lx : kNoInterval;
    CountOrName(is_named, error, sigma, score.tallies[kReading]);
    CountOrName(is_named, error, parameter_sigma, score.tallies[kReadingByParameters]);
  }
}

}  // namespace

void Tally::Count(double error, double sigma) {
  ++judged;
  const double z = error / sigma;
  if (!(sigma > 0) || !std::isfinite(z)) return;
  ++with_z;
  squared_z += z * z;
  held += std::abs(z) <= kNormal ? 1 : 0;
}

double Tally::Share() const {
  return judged > 0 ? static_cast<double>(held) / judged : std::numeric_limits<double>::quiet_NaN();
}

double Tally::RmsZ() const {
  return with_z > 0 ? std::sqrt(squared_z / with_z) : std::numeric_limits<double>::quiet_NaN();
}

bool Tally::IsInGate() const { return Share() >= 0.90 && Share() <= 0.98 && RmsZ() >= 0.8 && RmsZ() <= 1.2; }

void AddFit(const LuminaireFit& fit, const LightData& data, const Truth& truth, Score& score) {
  score.failed_fits += fit.IsUsable() ? 0 : 1;
  const FitUncertainty known = UncertaintyOf(fit);
  AddParameters(fit, known, truth, score);
  AddFluxRatios(fit, known, truth, score);
  AddReadings(fit, data, truth, score);
}

}  // namespace luxfit::coverage
