#include "forward/luminaire/internal/flux_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "forward/luminaire/photometry_file.h"
#include "tests/support/closed_forms.h"

namespace luxfit {
namespace {

IntensityTable TableOf(Distribution distribution, double exponent = 1) {
  Luminaire luminaire;
  luminaire.distribution = distribution;
  luminaire.cosine_exponent = exponent;
  return TabulatedPhotometry(luminaire).table;
}

// Howell's catalogue C-11, equal squares of side x times their distance.
double OpposedSquares(double x) {
  const double root = std::sqrt(1 + x * x);
  return 2 / (support::kPi * x * x) *
         (std::log(root * root / std::sqrt(1 + 2 * x * x)) + 2 * x * root * std::atan(x / root) -
          2 * x * std::atan(x));
}

TEST(FluxShare, DownwardIsHalfOfAnIsotropicAndAllOfALambertian) {
  EXPECT_NEAR(FluxSharesOf(TableOf(Distribution::kIsotropic)).downward, 0.5, 1e-5);
  EXPECT_NEAR(FluxSharesOf(TableOf(Distribution::kLambertian)).downward, 1, 1e-12);
}

// Lambertian luminaires spread over a ceiling are a Lambertian ceiling: their direct ratio is the form factor
// between opposed squares.
TEST(FluxShare, DirectRatioOfLambertianIsTheFormFactorBetweenOpposedSquares) {
  const FluxShares shares = FluxSharesOf(TableOf(Distribution::kLambertian));
  for (size_t k = 0; k < kRoomIndices.size(); ++k) {
    EXPECT_NEAR(shares.direct_ratio[k], OpposedSquares(2 * kRoomIndices[k]), 1e-3) << kRoomIndices[k];
  }
}

TEST(FluxShare, ANarrowLobeMeetsTheFloor) {
  const FluxShares wide = FluxSharesOf(TableOf(Distribution::kLambertian));
  const FluxShares narrow = FluxSharesOf(TableOf(Distribution::kCosinePower, 1000));
  for (size_t k = 0; k < kRoomIndices.size(); ++k) EXPECT_GT(narrow.direct_ratio[k], wide.direct_ratio[k]);
  EXPECT_GT(narrow.direct_ratio[9], 0.99);
}

TEST(FluxShare, RefusesWhatHasNoAxisOfItsOwn) {
  IntensityTable turned = TableOf(Distribution::kLambertian);
  turned.table_from_luminaire << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  EXPECT_THROW(FluxSharesOf(turned), std::invalid_argument);
  EXPECT_THROW(FluxSharesOf(IntensityTable()), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
