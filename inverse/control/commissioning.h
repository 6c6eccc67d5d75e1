// What was fitted against what was designed, luminaire by luminaire.
//
// A pair is what hangs nearest to each other (nearest pairs first, up to `match_m`); a designed luminaire
// without one is off or missing. Of a pair:
//
//   moved        |dp|                             m
//   turned       angle between the aims, and between the headings where both depend on one     rad
//   flux         Phi_fitted / Phi_designed
//   distribution 1/2 int |I_f - I_d| dOmega       share of the flux that goes elsewhere, own axes, 0..1
//   swapped      the ids of two pairs are exchanged
//
// A difference is a fault where its 95 % interval lies beyond the tolerance: |x| - 1.96 sigma > tolerance.
// Where the fit held an aim, the data asked for no tilt; its sigma is then that of what it would have missed.
//
// m, rad, lm; world frame. Throws std::invalid_argument for fluxes that are not above 0.
// Source: intervals as docs/accuracy.md; total variation distance of the distributions.
#ifndef LUXFIT_INVERSE_CONTROL_COMMISSIONING_H_
#define LUXFIT_INVERSE_CONTROL_COMMISSIONING_H_

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "forward/luminaire/luminaire.h"

namespace luxfit {

struct MeasuredLuminaire {
  Luminaire luminaire;
  Eigen::Vector3d position_sigma_m = Eigen::Vector3d::Zero();
  double relative_flux_sigma = 0;
  double aim_sigma_rad = 0.0175;      // 1 degree: a tilt that no fit would have asked for
  double heading_sigma_rad = 0.0349;  // 2 degrees
  double distribution_sigma = 0;      // of the share that goes elsewhere
};

enum class CommissioningFault {
  kOff,
  kMoved,
  kAimTurned,
  kHeadingTurned,
  kWeak,
  kStrong,
  kPhotometry,
  kSwapped
};
std::string ToString(CommissioningFault fault);

struct ToleranceInterval {
  double value = 0, half_width = 0;  // of 95 %
  double tolerance = 0;
  bool is_determined = true;
  bool IsBeyond() const { return is_determined && std::abs(value) - half_width > tolerance; }
};

struct CommissionedLuminaire {
  int designed = -1, measured = -1;  // indices; measured -1: nothing hangs there
  ToleranceInterval moved_m, aim_rad, heading_rad;
  ToleranceInterval flux_ratio_less_1, distribution;
  std::vector<CommissioningFault> faults;  // none: as designed
  int swapped_with = -1;                   // of the designed
};

struct CommissioningOptions {
  double match_m = 1.0;             // farther is another luminaire
  double position_m = 0.05;         // as drawings and ceilings go
  double angle_rad = 0.0524;        // 3 degrees
  double relative_flux = 0.05;      // beside the fit's own interval
  double distribution_share = 0.1;  // maker's tables and lobes differ by as much
  double off_share = 0.02;          // of the designed flux: below it is off
};

struct Commissioning {
  std::vector<CommissionedLuminaire> luminaires;  // one a designed
  std::vector<int> undesigned;                    // measured that no design has
  double common_flux_ratio = 1;  // median over the pairs: what all share is maintenance, or the scale
};
Commissioning CompareWithDesign(const std::vector<Luminaire>& designed,
                                const std::vector<MeasuredLuminaire>& measured,
                                const CommissioningOptions& options = {});

// Half the integral of the difference of two distributions of 1 lm, each in its own axes.
double DistributionDistance(const Luminaire& a, const Luminaire& b);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CONTROL_COMMISSIONING_H_
