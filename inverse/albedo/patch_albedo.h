// Albedo of a room's surfaces from the radiosity that the photos measured, with no solve.
//
//   rho = pi Y_es / (c E_es),   E_es = D_es + sum_j F_ej M_js,   M_js = pi / c * mean of Y over patch j
//
// Y: relative luminance of element e in state s, c: camera scale, D: direct illuminance of the given
// luminaires (lx, their distribution and visibility included), F: form factors. What no photo shows gives
// M = rho E of the radiosity solution with its material's albedo. Interreflection is so included without
// asking what the albedo is: surfaces that the model has no material for (a poster) reflect what they were
// seen to.
//
// Detail, material by material: one albedo for all of it, one a patch, or one an element: the coarsest that
// the residuals support. Observations are left out in turn and predicted from the unit's others (an element's
// from other states; where it has none, its patch's, then its material's). The finer one is taken where the
// mean of min(z^2, 9) on what was left out falls by more than its standard error, residuals of one facet and
// state being no independent evidence, and where its albedos vary by more than the forward model's own error
// at single places.
//
// Robust: Cauchy weights; elements that a shadow edge crosses are left out. Sigmas contain noise, model error
// by facet and state, and what the caller says all share.
// Throws std::invalid_argument for a room without dense form factors and for sizes that do not match.
// Sources: Goral et al. (1984) (E = D + F M); Yu, Debevec, Malik, Hawkins (1999), "Inverse global
// illumination", sec. 4.1 (albedo from measured radiosities); Breiman et al. (1984), sec. 3.4
// (one-standard-error rule).
#ifndef LUXFIT_INVERSE_ALBEDO_PATCH_ALBEDO_H_
#define LUXFIT_INVERSE_ALBEDO_PATCH_ALBEDO_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "inverse/model/light_model.h"

namespace luxfit {

enum class AlbedoDetail { kMaterial, kPatch, kElement };
std::string ToString(AlbedoDetail detail);

struct PatchAlbedoOptions {
  bool interreflection = true;    // false: E = D, to compare
  double robust_sigmas = 3.0;     // where a residual has half its weight's pull
  double min_model_error = 2e-3;  // relative, of one observation
  double least_texture = 0.03;    // relative spread below which the forward model is as likely the cause
  int folds = 5;                  // parts left out in turn
  Eigen::VectorXd common_sigma;   // relative, by material: of fluxes and camera scale; empty: none
};

struct DetailScore {
  AlbedoDetail detail = AlbedoDetail::kMaterial;
  double score = 0;           // on what was left out
  double standard_error = 0;  // of its difference from the material's
  double texture = 0;         // relative spread of its albedos beyond their noise
};

struct MaterialAlbedo {
  double albedo = 0;  // NaN: not observed
  double sigma = 0;
  int observations = 0;
  int unlike_elements = 0;  // of those observed: more than 4 sigma and 10 % from the material's albedo
  int elements = 0;         // observed
  AlbedoDetail detail = AlbedoDetail::kMaterial;
  std::vector<DetailScore> scores;
  std::string because;
};

// One albedo at the detail chosen for its material.
struct AlbedoUnit {
  int material = 0;
  int patch = -1;    // -1: all of the material
  int element = -1;  // -1: all of the patch
  double albedo = 0;
  double sigma = 0;
  int observations = 0;
};

struct PatchAlbedo {
  std::vector<MaterialAlbedo> materials;
  std::vector<AlbedoUnit> units;  // by material, then patch, then element
  double model_error = 0;         // relative, of one observation about its element's albedo
};

// `light`: luminaires, camera scale and the albedo by material that unseen surfaces take.
PatchAlbedo EstimatePatchAlbedo(const Room& room, const LightData& data, const LightState& light,
                                const PatchAlbedoOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_PATCH_ALBEDO_H_
