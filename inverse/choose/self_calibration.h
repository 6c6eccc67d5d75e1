// What photos of a room say of the camera that took them: exposures that differ from the stated ones,
// vignetting, and a response that is no straight line, from surfaces seen by several photos.
//
//   (1 + q_c) ln Y + q_c ln t = ln R_es + g_p + a_c1 r^2 + a_c2 r^4 + ...,     R_es = sum_l d_sl B_el
//
// Y: relative luminance of element e in photo p (camera c, state s) of exposure t, so that Y t is the share
// of full scale that was counted; g: ln (true exposure / stated); a: logarithm of vignetting (as
// calib/luminance/vignetting.h); counts go with light to the power 1 / (1 + q). An element is diffuse: its luminance R
// is the same in all photos of a state. Light of several luminaires adds up, d their dimming: where a state
// shows what others show one by one, their exposures are tied to each other, and a response that is no
// straight line betrays itself.
//
//   min over q, g, a, B of sum ln(1 + (residual / (c s sigma))^2) + prior of g
//
// by Gauss-Newton with the B of each element eliminated (inverse/choose/internal/photo_equations.h), s the
// residuals' own scale. The prior of g is of heavy tails: shutters err by `gain_sigma`, some photos by far
// more.
//
// What is free is chosen: every combination of gains, vignetting of order 0 to 3 and a response exponent is
// fitted without a fifth of the patches in turn and scored on these, their B fitted alike: the mean of
// min(z^2, 9). Taken is the one of fewest parameters within one standard error (paired, over facets) of the
// best. Combinations whose parameters the photos do not determine are not taken.
//
// Not determined, ever: a factor common to all photos (it belongs to the camera's scale; the prior holds the
// gains about zero). An exponent, where every element is seen at one level only. Factors common to all photos
// of a state that shows no luminaire which another state shows, too: `state_sigma` says how well they are
// known. Source: Goldman (2010), "Vignette and exposure calibration and compensation", sec. 3; Mitsunaga and
// Nayar (1999), "Radiometric self calibration"; elimination: Golub and Pereyra (1973).
#ifndef LUXFIT_INVERSE_CHOOSE_SELF_CALIBRATION_H_
#define LUXFIT_INVERSE_CHOOSE_SELF_CALIBRATION_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/room/patches.h"

namespace luxfit {

// One element in one photo.
struct PhotoSample {
  int element = 0;
  int state = 0;
  int photo = 0;  // from 0
  int camera = 0;
  double radius2 = 0;    // of its pixel from the image's centre, over half the diagonal, squared
  double log_value = 0;  // ln Y
  double log_share = 0;  // ln (Y t), of full scale
  double relative_sigma = 0;
};

// What calib fixed is held.
struct OpenRadiometry {
  bool gains = true;
  std::vector<bool> vignetting, response;  // one a camera
};

struct SelfCalibrationOptions {
  double gain_sigma = 0.05;         // of ln exposure, beforehand
  int max_order = 3;                // of vignetting
  int max_elements = 300;           // taken evenly from those that say something
  double max_corner_sigma = 0.03;   // of ln V at r = 1: beyond it vignetting is not determined
  double max_exponent_sigma = 0.1;  // of q likewise
};

struct RadiometryCandidate {
  bool gains = false;
  int order = 0;
  bool exponent = false;
  std::string name;  // "as recorded", "gains + vignetting of order 2 + exponent"
  int parameters = 0;
  double score = 0;           // on what was left out
  double standard_error = 0;  // of its difference from the best
  bool is_determined = true;
};

struct SelfCalibration {
  bool is_possible = false;  // else nothing was estimated:
  std::string message;       // why not
  std::vector<RadiometryCandidate> candidates;
  int chosen = 0;
  Eigen::VectorXd log_gain;    // by photo; 0 where held
  Eigen::MatrixXd vignetting;  // coefficients x cameras; 0 where held
  Eigen::VectorXd exponent;    // q, by camera; 0 where held
  double corner_sigma = 0;     // of ln V at r = 1, the largest of any camera; where vignetting is open
  double exponent_sigma = 0;   // of q likewise
  double residual_sigma = 0;   // robust, of ln Y: by how much views differ for other reasons
  // Of the mean gain of each state against that of all photos, and of what the prior alone would give.
  Eigen::VectorXd state_sigma, state_prior_sigma;
  Eigen::MatrixXd covariance;  // of the gains, photos x photos; 0 where held

  const RadiometryCandidate& Chosen() const { return candidates[static_cast<size_t>(chosen)]; }
  // ln of what Y is to be multiplied by.
  double LogCorrection(const PhotoSample& sample) const;
};

// `dimming`: one a state, by luminaire. Facets and patches say what is left out together.
// Throws std::invalid_argument for samples out of range, values or sigmas that are not finite and > 0.
SelfCalibration SelfCalibrate(const Patches& patches, const std::vector<Eigen::VectorXd>& dimming,
                              const std::vector<PhotoSample>& samples, const OpenRadiometry& open,
                              const SelfCalibrationOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_SELF_CALIBRATION_H_
