// Chooses patches, form factors, rays and bounces for a wanted error, at little extra cost.
//
//   sensors   The rays of sensors are quadrupled until that changes their illuminance by less than a part of
//             the error. With errors of N^-1/2 (random; even cells do better, N^-3/4) the error is half the
//             change.
//   rays      On coarse patches, rays are doubled until form factors by cosine-weighted rays
//             (malley_stratified) differ by less than a part of the error, in the sensors' illuminance, from
//             closed forms with rays for shadows (hybrid). Finer patches cast more rays in all. The
//             difference is one draw, and sensors share the patches that light them, so it is doubled. Where
//             256 rays do not suffice, hybrid is chosen and its rays are doubled until that changes less.
//   patches   Elements are halved, and with them the bound above which patches are split (AdaptivePatches,
//             from the light of the coarser ones), until that changes the illuminance by less than a part of
//             the error. With errors C h^p the error at h is  change(2 h -> h) / (2^p - 1).  p is 1 (shadow
//             edges, solids). Smooth light has 2, and the estimate is three times the error; 1.3 was measured
//             in a furnished office. p is less where the last two changes say so, but no less than 0.74. The
//             coarser patches are chosen where the change and that error together are small enough for them.
//   bounces   The fewest are chosen whose truncation bound (forward/radiosity/solvers.h) is below a twentieth
//             of the error, where they take fewer products than to iterate to that bound; else all.
//
// Patches may use the error that rays and sensors leave, as a root of squares. Changes are root mean squares
// over luminaires and a hundred sensors, evenly taken from the list (RelativeRmsPercent): what a sensor costs
// is paid once for all others. The choice is deterministic: it reads no clock.
//
// The result has been computed on the way and is not computed again, but for the other sensors. A halving
// costs at least 4 times what went before, so all coarser ones together stay below the finest.
//
// Limits of memory end the halving: `reached` is false, and the estimate says how far it came (infinity:
// there was nothing to compare with). In scenes of so many facets that even the coarsest patches have no
// dense form factors (RoomOptions::max_matrix_bytes), the light is solved on the pairs that rays find.
//
// Throws std::invalid_argument for an error that is not > 0, and as ComputeSceneLight does. Source:
// Richardson (1911), "The approximate arithmetical solution by finite differences"; Roache (1994),
// "Perspective: a method for uniform reporting of grid refinement studies" (error from successive grids).
#ifndef LUXFIT_FORWARD_LIGHT_CHOOSE_ACCURACY_H_
#define LUXFIT_FORWARD_LIGHT_CHOOSE_ACCURACY_H_

#include <string>
#include <vector>

#include "forward/light/scene_light.h"

namespace luxfit {

struct AccuracyOptions {
  double error_percent = 1;       // rms over sensors and luminaires, of the illuminance
  double coarsest_patch_m = 0.8;  // a dozen patches per wall, quick to solve; also the largest
  int max_patches = 20000;        // 1.6 GB of coupling
  double max_matrix_bytes = 2e9;  // form factors: elements x patches
  int max_rays = 1024;
  int max_rays_per_sensor = 1 << 20;
};

struct TriedAccuracy {
  double patch_size_m = 0, element_size_m = 0;  // largest patch, smallest element
  int rays_per_element = 0, rays_per_sensor = 0;
  FormFactorMethod method = FormFactorMethod::kHybrid;
  int patches = 0, elements = 0;
  double change_percent = 0;  // from the one compared with; 0: the first
};

struct AccuracyChoice {
  SceneLightOptions options;
  bool all_bounces = true;
  double patches_error_percent = 0, rays_error_percent = 0, sensors_error_percent = 0,
         bounces_error_percent = 0;
  double estimated_error_percent = 0;  // all together
  bool reached = true;
  std::vector<TriedAccuracy> tried;  // in order
  std::string patches_because, rays_because, sensors_because, bounces_because;
};

struct AccurateSceneLight {
  AccuracyChoice choice;
  SceneLight light;  // by choice.options
};
AccurateSceneLight ChooseAccuracy(const LitScene& lit, const AccuracyOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_CHOOSE_ACCURACY_H_
