// Compares fitted luminaires with a design, luminaire by luminaire.
//
// A designed and a measured luminaire that hang nearest to each other are a pair (nearest pairs first, up to
// `match_m`). A designed luminaire without a partner is off or missing. A pair is compared by:
//
//   moved        |dp|                             m
//   turned       angle between the aims, and between the headings where both depend on one     rad
//   flux         Phi_fitted / Phi_designed
//   distribution 1/2 int |I_f - I_d| dOmega       share of the flux that goes elsewhere, own axes, 0..1
//   swapped      the ids of two pairs are exchanged
//
// A difference is a fault where its 95 % interval lies beyond the tolerance: |x| - 1.96 sigma > tolerance.
// Where the fit held an aim, the data supported no tilt; its sigma is then the tilt that the fit would miss.
//
// Units: m, rad, lm; world frame. Throws std::invalid_argument for fluxes that are not above 0.
// Source: docs/accuracy.md (intervals); total variation distance of the distributions.
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
  double aim_sigma_rad = 0.0175;      // 1 degree: a tilt that no fit would find
  double heading_sigma_rad = 0.0349;  // 2 degrees
  double distribution_sigma = 0;      // sigma of the share that goes elsewhere
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
  double value = 0, half_width = 0;  // half_width: of the 95 % interval
  double tolerance = 0;
  bool is_determined = true;
  bool IsBeyond() const { return is_determined && std::abs(value) - half_width > tolerance; }
};

struct CommissionedLuminaire {
  int designed = -1, measured = -1;  // indices; measured -1: no luminaire hangs there
  ToleranceInterval moved_m, aim_rad, heading_rad;
  ToleranceInterval flux_ratio_less_1, distribution;
  std::vector<CommissioningFault> faults;  // empty: as designed
  int swapped_with = -1;                   // index of the designed luminaire
};

struct CommissioningOptions {
  double match_m = 1.0;             // beyond it is another luminaire
  double position_m = 0.05;         // accuracy of drawings and ceilings
  double angle_rad = 0.0524;        // 3 degrees
  double relative_flux = 0.05;      // in addition to the fit's own interval
  double distribution_share = 0.1;  // makers' tables and lobes differ by as much
  double off_share = 0.02;          // share of the designed flux below which it is off
};

struct Commissioning {
  std::vector<CommissionedLuminaire> luminaires;  // one for each designed
  std::vector<int> undesigned;                    // measured, but not in the design
  double common_flux_ratio = 1;  // median over the pairs: maintenance or the scale, common to all
};
Commissioning CompareWithDesign(const std::vector<Luminaire>& designed,
                                const std::vector<MeasuredLuminaire>& measured,
                                const CommissioningOptions& options = {});

// Returns half the integral of the absolute difference of two distributions of 1 lm, each in its own axes.
double DistributionDistance(const Luminaire& a, const Luminaire& b);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CONTROL_COMMISSIONING_H_
