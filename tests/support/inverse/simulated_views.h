// Simulates views of elements: noise of each view, a relative error between views, and elements that one view sees wrongly.
//
//   y_v = mu (1 + relative_sigma e_v + noise_v),  e_v ~ N(0, 1)
//
// noise_v: N(0, 1) times relative_noise times a factor from 0.5 to 1.5, another for each view; `variance` holds its square.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_SIMULATED_VIEWS_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_SIMULATED_VIEWS_H_

#include <cmath>
#include <random>
#include <vector>

#include "inverse/observe/observe.h"

namespace luxfit::support {

struct SimulatedViewsOptions {
  int elements = 2000;
  int min_views = 2, max_views = 8;
  double relative_sigma = 0.01;
  double relative_noise = 0;
  double outlier_share =
      0;                 // of elements; one view of each shows 0.2 to 0.6 or 1.5 to 2.5 times the luminance
  double luminance = 0;  // 0: another of each element, 0.1 to 3
};

inline std::vector<Observation> SimulatedViews(const SimulatedViewsOptions& options, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::uniform_int_distribution<int> views(options.min_views, options.max_views);
  std::vector<Observation> observations;
  observations.reserve(static_cast<size_t>(options.elements) * static_cast<size_t>(options.max_views));
  for (int e = 0; e < options.elements; ++e) {
    const double mu = options.luminance > 0 ? options.luminance : 0.1 + 2.9 * uniform(rng);
    const int count = views(rng);
    const bool is_outlier = uniform(rng) < options.outlier_share;
    for (int v = 0; v < count; ++v) {
      const double noise = options.relative_noise * (0.5 + uniform(rng));
      Observation o;
      o.element = e;
      o.view = v;
      o.pixels = 100;
      o.relative_luminance = mu * (1 + options.relative_sigma * normal(rng) + noise * normal(rng));
      if (is_outlier && v == 0)
        o.relative_luminance *= uniform(rng) < 0.5 ? 0.2 + 0.4 * uniform(rng) : 1.5 + uniform(rng);
      o.variance = std::pow(noise * mu, 2);
      observations.push_back(o);
    }
  }
  return observations;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_SIMULATED_VIEWS_H_
