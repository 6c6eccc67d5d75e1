#include "inverse/fit/internal/judge/superfluous_luminaires.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "inverse/fit/internal/judge/odd_luminaires.h"
#include "inverse/fit/internal/name_in_order.h"

namespace luxfit {
namespace {

// A luminaire that lowers the squares by less makes up for what the models lack.
constexpr double kAsWell = 1.1;

// A fit that departs from the data by less is as good as mesh and paint let it be: what more luminaires explain is theirs.
constexpr double kGoodSigma = 0.01;

// A fit that departs by more is astray: what it leaves over may be luminaires that it has lost.
constexpr double kAstraySigma = 0.05;

bool IsUndetermined(const LuminaireFit& fit, const std::string& luminaire) {
  return std::any_of(fit.undetermined.begin(), fit.undetermined.end(), [&](const ParameterId& id) {
    return (id.kind == ParameterKind::kLuminaire || id.kind == ParameterKind::kLogFlux) &&
           id.owner == luminaire;
  });
}

bool IsLeftOver(const RoomFit& fit, const std::vector<OddLuminaire>& odd, size_t k) {
  const bool is_odd = std::any_of(odd.begin(), odd.end(), [&](const OddLuminaire& one) {
    return one.is_left_over && one.luminaire == static_cast<int>(k);
  });
  return is_odd || !fit.luminaire_found[k] || IsUndetermined(fit.fit, fit.fit.state.luminaires[k].id) ||
         (fit.fit.IsUsable() && !IsFluxKnown(fit, k));
}

RoomObservations WithoutLuminaire(RoomObservations given, size_t k) {
  given.luminaires.erase(given.luminaires.begin() + static_cast<std::ptrdiff_t>(k));
  for (Eigen::VectorXd& dimming : given.dimming) {
    const auto after = dimming.size() - 1 - static_cast<Eigen::Index>(k);
    dimming.segment(static_cast<Eigen::Index>(k), after) = dimming.tail(after).eval();
    dimming.conservativeResize(dimming.size() - 1);
  }
  return given;
}

}  // namespace

std::optional<RoomObservations> WithoutSuperfluous(const RoomObservations& given, const RoomFit& fit) {
  if (given.luminaires_are_named || given.luminaires.size() < 2 || fit.stopped ||
      fit.fit.relative_sigma > kAstraySigma)
    return {};
  const std::vector<OddLuminaire> odd = FindOddLuminaires(fit.fit, fit.data);
  std::optional<size_t> last;
  bool is_any = false;
  for (size_t k = 0; k < given.luminaires.size(); ++k) {
    if (!IsNothingKnownOf(given.luminaires[k])) continue;
    last = k;
    is_any = is_any || IsLeftOver(fit, odd, k);
  }
  if (!is_any) return {};
  return WithoutLuminaire(given, *last);
}

bool ExplainsAsWell(const RoomFit& fewer, double sigma) {
  return fewer.IsUsable() && !fewer.stopped &&
         std::pow(fewer.fit.relative_sigma, 2) <= kAsWell * std::pow(std::max(sigma, kGoodSigma), 2);
}

void RecordSuperfluous(size_t counted, double sigma, RoomFit& fewer) {
  const size_t count = fewer.fit.state.luminaires.size();
  fewer.findings.choices.push_back(
      {"number of luminaires of the fit",
       std::to_string(count),
       {std::to_string(count), std::to_string(counted)},
       fmt::format("of {} counted, the fit left {} over: without, it departs from the data by {:.2f} %, with "
                   "by {:.2f} %",
                   counted, counted - count, 100 * fewer.fit.relative_sigma, 100 * sigma)});
}

}  // namespace luxfit
