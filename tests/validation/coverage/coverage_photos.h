// Takes the photos and readings of a real room of study_coverage, by light that shares no patch, form factor
// or solution with the model that is fitted.
//
//   Y_ves = c rho_f texture_e (mean_p D_s(q_vp) + I_es) / pi * exposure_vs * noise_ves
//   q_vp  = where the pixel that is taken for point p of the model's element meets the real facet
//   D     = Phi (m + 1) cos^m(gamma) cos(theta) / (2 pi r^2)
//   I_es  = mean of the traced indirect light at the element's place on the real facet
//
// p runs over four points of the element; s counts states, each with one luminaire on. Facets do not shade
// each other: the room is a convex box. All views take the same I, because indirect light varies little over
// a shift of millimetres. Texture is not in I: it averages out over a facet. The tracer's noise, 0.5 to 1 %
// of I, comes on top. An observation exists within 45 degrees of the view's axis and 81 degrees of the
// facet's normal.
//
// Units: lx, relative luminance, m. Throws as TraceIlluminance does.
// Source: forward/light/light_tracer.h for I; inverse-square cosine law for D.
#ifndef LUXFIT_TESTS_VALIDATION_COVERAGE_COVERAGE_PHOTOS_H_
#define LUXFIT_TESTS_VALIDATION_COVERAGE_COVERAGE_PHOTOS_H_

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "inverse/model/light_state.h"
#include "inverse/observe/observe.h"
#include "tests/validation/coverage/coverage_room.h"

namespace luxfit::coverage {

struct RealData {
  std::vector<Observation> observations;  // of each view
  std::vector<Reading> readings;
  Eigen::VectorXd reading_lx;  // truth of each reading, at its real place
};

// `seed`: of the tracer. `rng`: of exposure errors and noise.
RealData TakePhotos(const Setup& setup, const RealRoom& real, const ErrorSizes& sizes, uint64_t seed,
                    std::mt19937_64& rng);

// Returns the data of the fit, with the views of one element merged. Observations of facet f in state s carry
// the model error 1 + facet_sigma * facet_states(f, s).
LightData DataWithModelError(const Setup& setup, const RealRoom& real, const RealData& taken,
                             double facet_sigma);

}  // namespace luxfit::coverage

#endif  // LUXFIT_TESTS_VALIDATION_COVERAGE_COVERAGE_PHOTOS_H_
