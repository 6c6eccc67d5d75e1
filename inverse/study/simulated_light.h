// What photos and luxmeter would read of given luminaires and reflectances, by the unbiased light tracer:
// data for a fit that share no patch, no form factor and no solution with the model that is fitted to them.
//
//   Y = c rho E / pi * (1 + a g_fs) (1 + b g)       E: mean over four points of the element, traced
//
// g_fs: standard normal, common to all elements of one facet in one state, as errors of a model are; g: of
// each observation. The means of an element stand for its pixels; the fit takes its centre. Readings have
// their own relative sigma. Assumes diffuse surfaces; readings are cosine-corrected (the tracer's own limit).
//
// lx, relative luminance in units of light.camera_scale. Throws as TraceIlluminance does.
// Source: forward/light/light_tracer.h.
#ifndef LUXFIT_INVERSE_STUDY_SIMULATED_LIGHT_H_
#define LUXFIT_INVERSE_STUDY_SIMULATED_LIGHT_H_

#include <random>
#include <vector>

#include "inverse/model/light_model.h"

namespace luxfit {

struct SimulatedLightOptions {
  int paths_per_point = 128;     // four points an element: 1 to 2 % of the indirect light
  double facet_sigma = 0.01;     // a: what forward models and real rooms differ by
  double observation_sigma = 0;  // b; the tracer's own noise comes on top
};

// One luminaire's light at one place, before reflectance, camera and noise: what is traced once and used for
// any number of noisy copies. Rows: elements asked for, then readings.
struct TracedLight {
  std::vector<int> elements;
  Eigen::MatrixXd illuminance_lx;  // rows x luminaires, fluxes included
};
TracedLight TraceLight(const Room& room, const std::vector<int>& elements,
                       const std::vector<Reading>& readings, const LightState& light,
                       const SimulatedLightOptions& options = {});

// One observation an element and state (view 0, as many pixels as a noise-free mean), and the readings with
// new values.
LightData SimulateLight(const Room& room, const TracedLight& traced, const LightState& light,
                        const std::vector<Eigen::VectorXd>& dimming, std::vector<Reading> readings,
                        std::mt19937_64& rng, const SimulatedLightOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_STUDY_SIMULATED_LIGHT_H_
