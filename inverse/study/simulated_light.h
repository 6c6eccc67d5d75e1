// Simulates photos and luxmeter readings of given luminaires and reflectances by the unbiased light tracer.
//
//   Y = c rho E / pi * (1 + a g_fs) (1 + b g)       E: mean over four points of the element, traced
//
// g_fs: standard normal, common to all elements of one facet in one state, as a model's errors are. g:
// standard normal, one for each observation. An element's mean stands for its pixels; the fit takes its
// centre. Readings have their own relative sigma. The data share no patch, form factor or solution with the
// model that is fitted.
//
// Assumes diffuse surfaces and cosine-corrected readings (the tracer's own limits). Units: lx, relative
// luminance in units of light.camera_scale. Throws as TraceIlluminance does.
// Source: forward/light/light_tracer.h.
#ifndef LUXFIT_INVERSE_STUDY_SIMULATED_LIGHT_H_
#define LUXFIT_INVERSE_STUDY_SIMULATED_LIGHT_H_

#include <random>
#include <vector>

#include "inverse/model/light_state.h"

namespace luxfit {

struct SimulatedLightOptions {
  int paths_per_point = 128;     // four points per element: 1 to 2 % of the indirect light
  double facet_sigma = 0.01;     // a: difference between forward models and real rooms
  double observation_sigma = 0;  // b; the tracer's own noise comes on top
};

// Holds the light of each luminaire at each place, before reflectance, camera and noise. It is traced once
// and used for any number of noisy copies. Rows are the elements asked for, then the readings.
struct TracedLight {
  std::vector<int> elements;
  Eigen::MatrixXd illuminance_lx;  // rows x luminaires, fluxes included
};
TracedLight TraceLight(const Room& room, const std::vector<int>& elements,
                       const std::vector<Reading>& readings, const LightState& light,
                       const SimulatedLightOptions& options = {});

// Returns one observation for each element and state (view 0, as many pixels as a noise-free mean), and the
// readings with new values.
LightData SimulateLight(const Room& room, const TracedLight& traced, const LightState& light,
                        const std::vector<Eigen::VectorXd>& dimming, std::vector<Reading> readings,
                        std::mt19937_64& rng, const SimulatedLightOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_STUDY_SIMULATED_LIGHT_H_
