// Finds parameters of luminaires that a whole fit does not tell from their simplest value.
//
//   (x - x0)^T C^-1 (x - x0) <= chi2_95(dof)
//
// x: the parameters of one refinement as fitted, C: their covariance, x0: the simplest value: an exponent of 1
// (a Lambertian luminaire), the aim that was held before, the heading of a rectangle that was held before or a
// quarter turn from it, no size (a point). The same holds for all parameters of a luminaire that are simplified,
// taken together. Models are chosen luminaire by luminaire on data left
// out, which shows what is repeatable. Errors that all data share (mesh, poses, reflectances) are repeatable
// too; the whole fit knows them, so it has the last word.
//
// Source: Wald (1943), "Tests of statistical hypotheses concerning several parameters".
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_NEEDLESS_PARAMETERS_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_NEEDLESS_PARAMETERS_H_

#include <optional>
#include <vector>

#include "inverse/choose/internal/choose_model.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

enum class NeedlessKind { kExponent, kTilt, kHeading, kSize };

struct NeedlessParameter {
  int luminaire = 0;
  NeedlessKind kind = NeedlessKind::kExponent;
  double fitted = 0;  // exponent, or angle to the simplest aim or heading, rad, or the longer side, m
  double sigma = 0;   // of the same; of a tilt or a size, the larger of its two axes
};

// Holds where a luminaire pointed before its aim and heading were chosen.
struct HeldDirections {
  Eigen::Vector3d aim{0, 0, -1}, heading{1, 0, 0};
};

struct SimplifiedState {
  LightState state;  // with the simplest values, held
  std::vector<NeedlessParameter> needless;
};

// Says which quantity of a luminaire is simplified first. Two may be needless each by itself, and not together.
enum class SimplifiedFirst { kExponent, kSize };

// `fit` needs its covariance. `held`: one for each luminaire. Looks only at what `open` leaves open. Where a size is
// needless, what is looked at after it stays as fitted: it was estimated with that size.
SimplifiedState WithoutNeedlessParameters(const LuminaireFit& fit, const std::vector<OpenChoice>& open,
                                          const std::vector<HeldDirections>& held,
                                          SimplifiedFirst first = SimplifiedFirst::kExponent);

// Returns the same with sizes first, where that turns other luminaires into points than with exponents first.
std::optional<SimplifiedState> WithOtherPoints(const LuminaireFit& fit, const std::vector<OpenChoice>& open,
                                               const std::vector<HeldDirections>& held,
                                               const SimplifiedState& exponents_first);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_NEEDLESS_PARAMETERS_H_
