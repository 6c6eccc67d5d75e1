// Counts which 95 % intervals of a fit hold the truth.
//
//   held    |error| <= 1.96 sigma
//   rms z   sqrt(mean (error / sigma)^2), over the intervals that the fit gives
//
// Intervals are those that users read: sigmas by fit.covariance, and of a reading its interval95_lx
// (hypot(sigma by the parameters, relative model error * prediction)). Fluxes and their ratios are compared
// as logarithms. An interval that is missing counts as a miss, and so does every interval of a fit that
// failed or refused. A quantity that the fit named as undetermined is not judged; it is counted apart. A
// reading is named where the flux of the luminaire that lights it is.
//
// Assumes that state s has luminaire s on alone, as Setup does. Units: m, lx; shares 0..1.
// Source: own.
#ifndef LUXFIT_TESTS_VALIDATION_COVERAGE_COVERAGE_SCORE_H_
#define LUXFIT_TESTS_VALIDATION_COVERAGE_COVERAGE_SCORE_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/light_state.h"

namespace luxfit::coverage {

enum Quantity : size_t { kPosition, kFlux, kFluxRatio, kAlbedo, kReading, kReadingByParameters };
constexpr size_t kQuantities = 6, kGated = 5;  // the gate judges the first five
constexpr std::array<const char*, kQuantities> kNames{"position", "flux",    "flux ratio",
                                                      "albedo",   "reading", "reading by parameters"};

struct Tally {
  int judged = 0, held = 0;
  int with_z = 0;  // of those judged, how many had an interval
  int named = 0;   // undetermined by the fit's own word
  double squared_z = 0;

  void Count(double error, double sigma);
  double Share() const;  // NaN: none was judged
  double RmsZ() const;   // NaN: none had an interval
  bool IsInGate() const;
};

struct Score {
  std::array<Tally, kQuantities> tallies;
  int failed_fits = 0;
};

struct Truth {
  LightState light;            // with the reflectances of the real room
  Eigen::VectorXd reading_lx;  // by reading of the data
};

// Adds the intervals of one fit to the score. Readings that were fitted are left out.
void AddFit(const LuminaireFit& fit, const LightData& data, const Truth& truth, Score& score);

}  // namespace luxfit::coverage

#endif  // LUXFIT_TESTS_VALIDATION_COVERAGE_COVERAGE_SCORE_H_
