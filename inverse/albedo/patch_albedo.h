// Estimates the albedo of a room's surfaces from the radiosity that the photos measured, without a solve.
//
//   rho = pi Y_es / (c E_es),   E_es = D_es + sum_j F_ej M_js,   M_js = pi / c * mean of Y over patch j
//
// Y: relative luminance of element e in state s, c: camera scale, D: direct illuminance of the given
// luminaires (lx, with their distribution and visibility), F: form factors. Surfaces that no photo shows have
// M = rho E of the radiosity solution with their material's albedo. Interreflection is thus included without
// knowing the albedo: a surface without a material of its own in the model (a poster) reflects what the
// photos show.
//
// Detail: each material has one albedo, one for each patch, or one for each element, the coarsest that the
// residuals support. Observations are left out in turn and predicted from the others of the unit. An element
// uses its other states; where it has none, its patch, then its material. The finer detail is chosen under
// two conditions:
// - the mean of min(z^2, 9) on data left out falls by more than its standard error, for which residuals of
//   one facet and state are not independent, and the states of a facet are replicates: a poster on one wall is
//   no chance, though the other walls have none;
// - its albedos vary by more than the forward model's own error at single places.
//
// Cauchy weights make the estimate robust. Elements that a shadow edge crosses are left out. Sigmas contain
// noise, model error by facet and state, and the uncertainty that the caller states as common.
//
// Throws std::invalid_argument for a room without dense form factors and for sizes that do not match.
// Sources: Goral et al. (1984) (E = D + F M); Yu, Debevec, Malik, Hawkins (1999), "Inverse global
// illumination", sec. 4.1 (albedo from measured radiosities); Breiman et al. (1984), sec. 3.4
// (one-standard-error rule).
#ifndef LUXFIT_INVERSE_ALBEDO_PATCH_ALBEDO_H_
#define LUXFIT_INVERSE_ALBEDO_PATCH_ALBEDO_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/light_state.h"

namespace luxfit {

enum class AlbedoDetail { kMaterial, kPatch, kElement };
std::string ToString(AlbedoDetail detail);

struct PatchAlbedoOptions {
  bool interreflection = true;    // false: E = D, for comparison
  double robust_sigmas = 3.0;     // residual at which the robust weight is one half
  double min_model_error = 2e-3;  // relative, of one observation
  double least_texture = 0.03;    // relative spread below which the forward model may as well be the cause
  int folds = 5;                  // parts left out in turn
  Eigen::VectorXd common_sigma;   // relative, by material, from fluxes and camera scale; empty: none
};

struct DetailScore {
  AlbedoDetail detail = AlbedoDetail::kMaterial;
  double score = 0;           // on data left out
  double standard_error = 0;  // standard error of the difference from one albedo per material
  double texture = 0;         // relative spread of its albedos beyond their noise
};

struct MaterialAlbedo {
  double albedo = 0;  // NaN: not observed
  double sigma = 0;
  int observations = 0;
  int unlike_elements = 0;  // observed, and more than 4 sigma and 10 % from the material's albedo
  int elements = 0;         // observed
  AlbedoDetail detail = AlbedoDetail::kMaterial;
  std::vector<DetailScore> scores;
  std::string because;

  // Returns whether more than 2 % of the elements are unlike the rest. A smaller share is the material's border
  // and its stains.
  bool IsUneven() const { return unlike_elements > 0.02 * elements; }
};

// Holds one albedo at the detail chosen for its material.
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

// `light`: luminaires, camera scale, and the albedo by material for unseen surfaces.
PatchAlbedo EstimatePatchAlbedo(const Room& room, const LightData& data, const LightState& light,
                                const PatchAlbedoOptions& options = {});

// Does the same by the light of a fit. An empty `common_sigma` is that of the fit's reflectances, which contains
// the uncertainty of fluxes and camera scale.
PatchAlbedo EstimatePatchAlbedo(const Room& room, const LightData& data, const LuminaireFit& fit,
                                PatchAlbedoOptions options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_PATCH_ALBEDO_H_
