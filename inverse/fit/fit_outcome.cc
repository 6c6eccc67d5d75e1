#include "inverse/fit/fit_room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "inverse/model/internal/blocks/row_block.h"
#include "inverse/model/internal/weights/indirect_error.h"

namespace luxfit {
namespace {

constexpr double kNotDetermined = std::numeric_limits<double>::quiet_NaN();
// In m, rad or a logarithm: of a parameter that a luminaire without light leaves free, whatever direction is named.
constexpr double kSigmaOfNoMeaning = 1e6;
constexpr double kLeastKnownFlux = 1;  // sigma of its logarithm: a factor of e says nothing

// Returns how far a rival is from the luminaire, in the parameter's unit; 0 for what the two have in common.
double Distance(const Luminaire& luminaire, const AmbiguousPlace& place, const Luminaire& rival,
                ParameterKind kind, LuminaireQuantity quantity) {
  if (kind == ParameterKind::kLogFlux) return std::abs(std::log(rival.flux_lm / place.kept.flux_lm));
  switch (quantity) {
    case LuminaireQuantity::kPositionX:
    case LuminaireQuantity::kPositionY:
    case LuminaireQuantity::kPositionZ: {
      const int axis = static_cast<int>(quantity);
      return std::abs(rival.position[axis] - luminaire.position[axis]);
    }
    case LuminaireQuantity::kTiltAlong:
    case LuminaireQuantity::kTiltAcross:
      return std::acos(std::clamp(rival.aim.dot(place.kept.aim), -1.0, 1.0));
    default:
      return 0;
  }
}

}  // namespace

bool Findings::IsUndetermined() const {
  return std::any_of(warnings.begin(), warnings.end(), [](const Warning& w) { return w.is_of_outcome; });
}

void Findings::AddUndetermined(Warning warning) {
  warning.is_of_outcome = true;
  warnings.push_back(std::move(warning));
}

double SigmaOf(const LuminaireFit& fit, ParameterKind kind, int index, LuminaireQuantity quantity) {
  for (size_t i = 0; i < fit.parameters.size() && fit.covariance.size() > 0; ++i) {
    const Parameter& p = fit.parameters[i];
    if (p.kind != kind || !p.Concerns(index)) continue;
    if (kind == ParameterKind::kLuminaire && p.quantity != quantity) continue;
    const bool known = std::count(fit.undetermined.begin(), fit.undetermined.end(), p.id()) == 0;
    const auto row = static_cast<Eigen::Index>(i);
    const double sigma = std::sqrt(fit.covariance(row, row));
    return known && sigma < kSigmaOfNoMeaning ? sigma : kNotDetermined;
  }
  return 0;
}

double SigmaOf(const RoomFit& fit, ParameterKind kind, int index, LuminaireQuantity quantity) {
  double spread = 0;
  for (const AmbiguousPlace& place : fit.ambiguous) {
    const bool concerns = kind == ParameterKind::kLuminaire || kind == ParameterKind::kLogFlux;
    if (!concerns || place.luminaire != index) continue;
    const Luminaire& luminaire = fit.fit.state.luminaires[static_cast<size_t>(index)];
    for (const Luminaire& rival : place.rivals)
      spread = std::max(spread, Distance(luminaire, place, rival, kind, quantity));
  }
  return std::hypot(SigmaOf(fit.fit, kind, index, quantity), spread);
}

bool IsLit(const RoomFit& fit, int state) {
  const Eigen::VectorXd& dimming = fit.data.dimming[static_cast<size_t>(state)];
  for (size_t k = 0; k < fit.luminaire_found.size(); ++k)
    if (dimming[static_cast<Eigen::Index>(k)] > 0 && !fit.luminaire_found[k]) return false;
  return true;
}

bool IsFluxKnown(const RoomFit& fit, size_t luminaire) {
  if (!fit.absolute || (!fit.TellsDirectLight() && fit.fit.state.free[luminaire].flux)) return false;
  const int index = static_cast<int>(luminaire);
  const bool is_at_bound =
      std::any_of(fit.fit.at_bound.begin(), fit.fit.at_bound.end(), [&](const ParameterId& id) {
        return id.kind == ParameterKind::kLogFlux && id.owner == fit.fit.state.luminaires[luminaire].id;
      });
  return !is_at_bound && SigmaOf(fit, ParameterKind::kLogFlux, index) < kLeastKnownFlux;
}

std::vector<bool> ToldByIndirectLight(const Room& room, const RoomFit& fit) {
  std::vector<bool> told = MaterialsWithoutPhotos(room, fit.data, fit.fit.weight);
  for (size_t m = 0; m < told.size(); ++m) told[m] = told[m] && fit.fit.state.albedo_free[m];
  return told;
}

std::vector<EstimatedLuminaire> EstimatedLuminaires(const RoomFit& fit) {
  std::vector<EstimatedLuminaire> found;
  for (size_t k = 0; k < fit.fit.state.luminaires.size(); ++k) {
    if (!fit.luminaire_found[k]) continue;
    const Luminaire& luminaire = fit.fit.state.luminaires[k];
    const int index = static_cast<int>(k);
    EstimatedLuminaire estimated;
    estimated.id = luminaire.id;
    estimated.position = luminaire.position;
    for (int axis = 0; axis < 3; ++axis)
      estimated.position_sigma_m[axis] =
          SigmaOf(fit, ParameterKind::kLuminaire, index, static_cast<LuminaireQuantity>(axis));
    const bool has_flux = !fit.absolute || IsFluxKnown(fit, k);
    estimated.flux = has_flux ? luminaire.flux_lm : kNotDetermined;
    estimated.flux_sigma =
        has_flux ? luminaire.flux_lm * SigmaOf(fit, ParameterKind::kLogFlux, index) : kNotDetermined;
    found.push_back(estimated);
  }
  return found;
}

std::vector<PredictedReading> PredictedReadings(const RoomFit& fit) {
  std::vector<PredictedReading> readings;
  if (fit.fit.predicted.size() == 0) return readings;
  const Eigen::Index first = FirstReadingRow(fit.data);
  for (size_t i = 0; i < fit.data.readings.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    PredictedReading reading;
    reading.is_known = fit.absolute && fit.IsUsable() && IsLit(fit, fit.data.readings[i].state);
    reading.illuminance_lx = fit.fit.predicted[first + row];
    reading.direct_lx = fit.fit.reading_direct_lx.row(row);
    reading.parameter_sigma_lx = fit.fit.reading_sigma_lx.size() > row ? fit.fit.reading_sigma_lx[row] : 0;
    // A value that may be nothing says nothing.
    reading.is_known = reading.is_known && !(reading.parameter_sigma_lx >= reading.illuminance_lx);
    reading.sigma_lx =
        std::hypot(reading.parameter_sigma_lx, fit.fit.shared_relative_sigma * reading.illuminance_lx);
    readings.push_back(reading);
  }
  return readings;
}

}  // namespace luxfit
