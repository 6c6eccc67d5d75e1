// Estimates exposures, vignetting, response and the gains of cameras from surfaces that several photos show.
//
//   (1 + q_c) ln Y + q_c ln t = ln R_es + h_c + g_p + a_c1 r^2 + a_c2 r^4 + ...,     R_es = sum_l d_sl B_el
//
// Y: relative luminance of element e in photo p (camera c, state s) of exposure t; Y t is the share of full
// scale that was counted. h: ln of the camera's gain, its Y for a light over that of the reference camera. g:
// ln (true exposure / stated), beyond its camera's gain. a: logarithm of vignetting (as in
// calib/luminance/vignetting.h). Counts go with light to the power 1 / (1 + q). Elements are assumed diffuse:
// the luminance R is the same in all photos of a state. d: dimming; the light of several luminaires adds up.
// Where one state shows together what others show one by one, their exposures are tied to each other, and a
// response that is not a straight line becomes visible.
//
//   min over q, h, g, a, B of sum ln(1 + (residual / (c s sigma))^2) + prior of g
//
// Gauss-Newton solves it with the B of each element eliminated (inverse/observe/camera/internal/radiometry/photo_equations.h).
// s: the residuals' own scale. The prior of g has heavy tails: shutters err by `gain_sigma`, some photos by
// far more. h has none: a camera's gain is the robust mean of its photos'.
//
// Cameras' gains are decided first, on the elements that several cameras see. The photos' gains are held
// there, and their scatter is noise. Where the rule below asks for cameras' gains, all of them are free, and
// then in every combination. One camera is held in each group of cameras that share surfaces in a state: the
// first whose gain is stated, else the first. The others whose gains are stated are held as well. A
// contradiction is reported where it exceeds three sigmas, which contain the exposures' own (`gain_sigma` for
// each photo). Elements that only cameras without a common reference see together are left out.
//
// A gain's sigma enters the fit of the light through `covariance`, as that of an exposure does: by the
// variance of every observation (inverse/observe/camera/calibrated_observations.h).
//
// Data left out choose the free parameters. Every combination of gains, vignetting of order 0 to 3 and a
// response exponent is fitted without a fifth of the patches in turn. It is scored on these, their B fitted
// alike: the mean of min(z^2, 9). The combination of fewest parameters within one standard error (paired,
// over facets) of the best is chosen. Combinations whose parameters the photos do not determine are not
// eligible.
//
// Undetermined:
// - the gain of a camera that shares no surfaces with the reference (`is_tied`);
// - a factor common to all photos, always; it belongs to the camera's scale, and the prior holds the gains
//   about zero;
// - an exponent, where every element is seen at one level only;
// - a factor common to all photos of a state that shares no luminaire with another state; `state_sigma` says
//   how well it is known.
//
// Sources: Goldman (2010), "Vignette and exposure calibration and compensation", sec. 3; Mitsunaga and Nayar
// (1999), "Radiometric self calibration"; Golub and Pereyra (1973) (elimination).
#ifndef LUXFIT_INVERSE_OBSERVE_CAMERA_SELF_CALIBRATION_H_
#define LUXFIT_INVERSE_OBSERVE_CAMERA_SELF_CALIBRATION_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/luminance/luminance.h"
#include "forward/room/patches.h"

namespace luxfit {

// Holds one element in one photo.
struct PhotoSample {
  int element = 0;
  int state = 0;
  int photo = 0;  // from 0
  int camera = 0;
  double radius2 = 0;    // squared distance of its pixel from the image's centre over half the diagonal
  double log_value = 0;  // ln Y
  double log_share = 0;  // ln (Y t), relative to full scale
  double relative_sigma = 0;
};

// Says which parameters are open. What calib fixed is held.
struct OpenRadiometry {
  bool gains = true;
  std::vector<bool> vignetting, response;  // one for each camera
  std::vector<bool> gain_is_stated = {};   // one for each camera; empty: of none
};

struct SelfCalibrationOptions {
  double gain_sigma = 0.05;         // prior, of ln exposure
  int max_order = 3;                // order of vignetting
  int max_elements = 300;           // taken evenly from the informative ones
  double max_camera_sigma = 0.03;   // sigma of h above which a camera's gain is not determined
  double max_corner_sigma = 0.03;   // sigma of ln V at r = 1 above which vignetting is not determined
  double max_exponent_sigma = 0.1;  // sigma of q above which the exponent is not determined
};

struct RadiometryCandidate {
  bool camera_gains = false;  // the same in all candidates of a result, and not in their names
  bool gains = false;
  int order = 0;
  bool exponent = false;
  std::string name;  // "as recorded", "gains + vignetting of order 2 + exponent"
  int parameters = 0;
  double score = 0;           // on data left out
  double standard_error = 0;  // standard error of the difference from the best
  bool is_determined = true;
};

struct CameraGain {
  double log_gain = 0;  // h; 0 where held
  double sigma = 0;     // of h; 0 where held
  int reference = 0;    // camera that it is relative to; the camera itself where it is held
  bool is_tied = true;  // false: the photos do not tell its gain against the first, or a stated one
};

// Holds two cameras whose stated gains the photos contradict.
struct GainContradiction {
  int camera = 0, reference = 0;
  double log_ratio = 0, sigma = 0;  // h of the camera beyond what is stated
};

struct SelfCalibration {
  bool is_possible = false;  // false: nothing was estimated
  std::string message;       // the reason where it is not possible
  std::vector<RadiometryCandidate> candidates;
  int chosen = 0;
  std::vector<CameraGain> camera_gains;  // by camera
  // Scores of elements left out that several cameras see, with cameras' gains held and free. 0: one camera.
  double score_of_equal_cameras = 0, score_of_camera_gains = 0;
  std::vector<GainContradiction> contradictions;
  Eigen::VectorXd log_gain;    // g, by photo; 0 where held
  Eigen::MatrixXd vignetting;  // coefficients x cameras; 0 where held
  Eigen::VectorXd exponent;    // q, by camera; 0 where held
  double corner_sigma = 0;     // sigma of ln V at r = 1, the largest of any camera, where vignetting is free
  double exponent_sigma = 0;   // sigma of q, likewise
  double residual_sigma = 0;   // robust, of ln Y: remaining difference between views
  // Sigma of each state's mean gain against that of all photos, and the same by the prior alone.
  Eigen::VectorXd state_sigma, state_prior_sigma;
  Eigen::MatrixXd covariance;  // covariance of h + g, photos x photos; 0 where both are held

  const RadiometryCandidate& Chosen() const { return candidates[static_cast<size_t>(chosen)]; }
  PhotoCorrection CorrectionOf(int photo, int camera) const;  // of h and g together
  double CornerShare(int camera) const;                       // light at r = 1 over that at the centre
  double ResponsePower(int camera) const;                     // counts go with this power of light
};

// Samples of cameras whose gains are stated are in one unit: what is stated is divided out of ln Y.
// `dimming`: one vector per state, by luminaire. `patches`: facets and patches define what is left out
// together. Throws std::invalid_argument for samples out of range, and for values or sigmas that are not
// finite and > 0.
SelfCalibration SelfCalibrate(const Patches& patches, const std::vector<Eigen::VectorXd>& dimming,
                              const std::vector<PhotoSample>& samples, const OpenRadiometry& open,
                              const SelfCalibrationOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_CAMERA_SELF_CALIBRATION_H_
