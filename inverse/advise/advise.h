// Advises which photo or reading to take next: the one that shrinks the uncertainty of what is asked for most.
//
//   gain = max over kinds of (1 - rms sigma' / rms sigma),   sigma'^2 = q^T (C^-1 + I)^-1 q
//
// C: covariance of the fit, I: information of a candidate (information.h), q: what a quantity is of the parameters.
// Candidates are taken one by one, each given those before (greedy A-optimality). The rms of a kind (fluxes,
// positions, readings) is that of what is asked for. No further one is advised where no candidate lowers any sigma
// by more than `least_gain`: what there is, is enough.
//
// A parameter that the fit did not determine counts as unknown by itself, with a sigma of a metre, of a factor e, or
// of 0.3 (reflectance). So candidates that determine it come first: photos of luminaires of unknown place from a
// first or second stand (internal/placed_luminaires.h), then what determines most, then what gains most. Without an
// absolute scale, fluxes in lm are unknown by one common factor, which a reading tells.
//
// A photo of two luminaires whose places are unknown does not say which is which, unless they are on alike in every
// state. It is advised only where no other candidate helps.
//
// Photos have errors that their rows share, outlines of luminaires and exact poses (information.h,
// internal/photo_view.h), and tell as much less than that as the photos of the fit did. Noise of dark pixels, texture
// and bodies of luminaires do not count. A reading has a relative
// sigma, and the model's; places with less than 2 % of their state's brightest reading are no candidates.
//
// Throws std::invalid_argument for a room so large that its transport is sparse, and for a covariance that is not as
// large as the list of parameters. Source: Fedorov (1972), "Theory of optimal experiments".
#ifndef LUXFIT_INVERSE_ADVISE_ADVISE_H_
#define LUXFIT_INVERSE_ADVISE_ADVISE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/light/room.h"
#include "inverse/advise/candidates.h"
#include "inverse/model/fit_uncertainty.h"

namespace luxfit {

struct AdviceGiven {
  std::vector<Luminaire> luminaires;
  Eigen::VectorXd albedo;   // by material
  double camera_scale = 1;  // relative luminance per cd/m2
  bool is_absolute = true;  // false: fluxes are relative
  FitUncertainty fit;
  std::vector<Eigen::VectorXd> dimming;  // one vector for each state, by luminaire
  std::vector<AdviceView> views;         // of photos taken and of candidates
  std::vector<PhotoCandidate> taken, photos;
  std::vector<ReadingCandidate> readings;   // candidates
  std::vector<ReadingCandidate> predicted;  // readings whose predictions are a quantity
  double meter_common_sigma = 0;            // relative, of the meter's calibration; 0: its class is not known
  double assumed_inflation = 1;  // of the variance by photos, where none were taken (information.h)
};

enum class AdviceKind { kFlux, kPosition, kReading };

// Names a quantity: the flux of a luminaire (relative sigma), its position (m, the root of the sum of three
// variances) or a predicted reading (relative sigma).
struct AdviceQuantity {
  AdviceKind kind = AdviceKind::kFlux;
  std::string owner;  // luminaire, or id of the reading
};

struct SigmaChange {
  AdviceQuantity of;
  double before = 0, after = 0;
  bool was_determined = true, is_determined = true;
};

struct AdviceStep {
  bool is_photo = false;
  size_t candidate = 0;  // index into photos or readings
  double gain = 0;
  SigmaChange helped;                // what becomes determined, or else is helped most
  std::vector<SigmaChange> changes;  // of all that is asked for, since the step before
};

struct AdviceOptions {
  std::vector<AdviceKind> kinds = {AdviceKind::kFlux, AdviceKind::kPosition};
  std::string owner;  // the luminaire or reading that is asked for; empty: all
  int count = 5;
  double least_gain = 0.1;
};

struct AdvicePlan {
  std::vector<SigmaChange> now;  // before and after are equal
  std::vector<AdviceStep> steps;
  bool is_enough = false;            // no further candidate helps
  std::vector<ParameterId> ignored;  // parameters of the fit that change light and that the room lacks

  // Returns what is not determined after all steps.
  std::vector<AdviceQuantity> Undetermined() const;
};
AdvicePlan Advise(const Room& room, const AdviceGiven& given, const AdviceOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ADVISE_ADVISE_H_
