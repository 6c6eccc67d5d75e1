// Predicts the light of a fitted room at any place: the one prediction of report, maps, dimming, exports and checks.
//
//   E_i(d) = sum_k d_k E_ik - sum_(j: d_j > 0) B_ij sum_(k != j) H_jk d_k                     lx, d: dimming
//   E_ik   = D_ik + sum_c v_c sum_e G_ie rho_ec E_ekc - (what its own body hides)             luminaire k alone, fully on
//   E_ekc  : illuminance of element e, light exchanged by reflectances rho_c = tint_c rho      (forward/light/illuminance.h)
//
// D: direct light. G: form factors of the place to elements. v: weight of channel c; surfaces without a tint have one
// channel. B_ij H_jk is what the body of luminaire j takes from the light of k (forward/light/covered_surfaces.h): H, the
// light on the surface that the body covers, times what that surface reflects more than the body; B, what the place gets
// of it. Where bodies are always there, E_ik holds what all of them take, and B is empty. Where bodies are there as long
// as their luminaires are on, light adds as long as the same luminaires are on: PlaceLight::While.
//
// Units: lx for fluxes in lm; of fits without a scale, the unit of their fluxes. Arrays are places x luminaires.
//
// Cov(E) = J Sigma J^T ~ S S^T. Rows of S (`factor`) are (place, luminaire), the luminaire fastest. Its columns are the
// directions in which the predictions vary most; those left out hold less than a thousandth of the variance. Any
// weighted sum of predictions (a state, a mean over places) therefore has the sigma |sum of rows|. J is that of the
// fitted model (internal/light_model.h), what bodies and colours do held. Parameters on which no prediction depends (the
// camera's scale) are ignored. Parameters that matter but belong to none of these luminaires and materials are listed
// in `left_out`; sigmas are then too small.
//
// Throws std::invalid_argument as ComputeTotals does, for rooms so large that their transport is sparse, and where a
// covariance is not as large as its list of parameters. Source: JCGM 102:2011, sec. 6 (propagation for several outputs).
#ifndef LUXFIT_INVERSE_MODEL_FITTED_LIGHT_H_
#define LUXFIT_INVERSE_MODEL_FITTED_LIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/light/covered_surfaces.h"
#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"
#include "inverse/model/fit_uncertainty.h"
#include "inverse/model/light_state.h"

namespace luxfit {

// Holds all of a fit that its light depends on, but for the room.
struct FittedScene {
  std::vector<Luminaire> luminaires;
  Eigen::VectorXd albedo;  // by material
  BodyPresence bodies = BodyPresence::kNone;
  Eigen::Matrix3Xd tint = {};         // LightState::tint; empty: grey
  Eigen::VectorXd patch_factor = {};  // LuminaireFit::patch_factor; empty: 1
  Eigen::Vector3d luminance_weights = LightData().luminance_weights;
};
FittedScene FittedSceneOf(const LuminaireFit& fit, const LightData& data);

struct PlaceLight {
  Eigen::MatrixXd total_lx, direct_lx;  // E_ik and its direct part
  Eigen::MatrixXd body_response;        // B, places x luminaires; empty: light adds
  Eigen::MatrixXd body_incident;        // H, luminaires x luminaires, 0 where j = k; lx
  Eigen::MatrixXd factor = {};          // S; empty: unknown
  std::vector<ParameterId> left_out = {};

  // Returns the columns whose sum by dimming is the light, as long as the luminaires that `dimming` has on are on.
  Eigen::MatrixXd While(const Eigen::VectorXd& dimming) const;
  // Returns the light at the places under that dimming, lx.
  Eigen::VectorXd Under(const Eigen::VectorXd& dimming) const;
};

class FittedLight {
 public:
  // Solves the light of every element. `room` must outlive it.
  FittedLight(const Room& room, FittedScene scene);

  // Indirect light takes `rays_per_sensor` rays for each place, kSensorRays with a covariance. S is empty where `known`
  // is.
  PlaceLight LightAt(const std::vector<Sensor>& places, const ParameterCovariance& known = {},
                     int rays_per_sensor = kSensorRays) const;
  // Returns the light at the centre of each element of the room.
  const PlaceLight& AtElements() const { return at_elements_; }
  const FittedScene& scene() const { return scene_; }

 private:
  // Finds the surfaces that bodies cover. Returns what elements get of an exitance of 1 of these.
  Eigen::MatrixXd FindBodies(const Receivers& elements);
  PlaceLight LightOf(const Eigen::MatrixXf& total, const Eigen::MatrixXf& direct,
                     const Eigen::MatrixXd& body_response) const;
  PlaceLight LightAt(const Receivers& sensors) const;
  PlaceLight WithFactor(const std::vector<Sensor>& places, const ParameterCovariance& given) const;

  const Room& room_;
  FittedScene scene_;
  LuminaireVisibility visibility_;  // of elements
  Eigen::MatrixXf exitance_;        // elements x luminaires, lm/m2 per lm
  std::vector<CoveredSurface> covered_;
  Eigen::MatrixXd on_covered_;     // covered surfaces x luminaires: their light, lx per lm
  Eigen::MatrixXf body_exitance_;  // elements x covered surfaces, by an exitance of 1 of these
  PlaceLight at_elements_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_FITTED_LIGHT_H_
