// Traces illuminance at sensors by unbiased Monte Carlo: a check of radiosity that shares no patch with it.
//
//   E = E_direct + E_indirect,  E_indirect = mean over paths of  sum_k rho_k E_direct(x_k)
//
// Paths are the adjoint of light's. They leave the sensor with the cosine's density. At every diffuse surface
// point x_k they take the direct light of each luminaire (one shadow ray to a random point of its surface),
// and go on with probability rho_k. So the weight of a path is 1 throughout, no bounce is left out, and one
// path serves all luminaires. Paths of a sensor go from surface to surface together, and those that go on are drawn
// systematically: of n paths as many as the sum of their rho_k, but for one. Drawn one by one, their number would
// make up half of the variance.
//
// A pool of light that few paths meet is sampled from its luminaire as well. Each path has one direction from a
// random point s of the luminaire, drawn by its intensity. Where it meets y first, y is connected with every
// point x of the path, the sensor among them. So light that is reflected once on its way to x is drawn in two
// ways, whose densities by area are
//
//   p_a = cos cos / (pi |x - y|^2)      x's direction, which meets y
//   p_b = q(w) cos / |s - y|^2          s's direction w, q: direction_sampler.h
//
// Both draw s alike, and each light counts p_a / (p_a + p_b) of its value from p_a (balance heuristic). The
// luminaire's light has to lie densely enough for it to pay: S > 2 (1 + 3 n) / (1 + n) with n luminaires, S its mean
// density over even. So panels in a room cost what they did, and spots of 10 degrees have a thirtieth of the variance in equal time.
//
// Directions and luminaire points are additive sequences, shifted at random at every surface and in each of
// `replicates` independent runs (randomised quasi-Monte Carlo). The spread of the runs gives the standard
// errors: few long runs have smaller ones than many short runs, and tell them worse. The same seed gives the same
// numbers on any number of cores.
//
// Results are in lx (flux_lm of the luminaires included); metres, world frame. Both sides of facets block; a
// path ends on a back and where it leaves the scene. Luminaires cast no shadow and reflect nothing.
//
// Throws std::invalid_argument for reflectances outside [0, 1), fewer than 2 replicates or fewer paths than
// those. Sources: Kajiya (1986), "The rendering equation"; Arvo and Kirk (1990), "Particle transport and
// image synthesis" (Russian roulette); Kitagawa (1996), "Monte Carlo filter and smoother" (systematic sampling);
// Veach (1997), thesis, ch. 3 and 8 (adjoint, next-event estimation); Veach and Guibas (1995), "Optimally combining
// sampling techniques for Monte Carlo rendering".
#ifndef LUXFIT_FORWARD_LIGHT_LIGHT_TRACER_H_
#define LUXFIT_FORWARD_LIGHT_LIGHT_TRACER_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"
#include "forward/room/scene.h"
#include "forward/room/visibility.h"

namespace luxfit {

struct LightTracerOptions {
  int paths_per_sensor = 65536;  // 0.1 to 0.3 % of the indirect light in an office
  int replicates = 64;           // the standard error is itself known to 1 / sqrt(2 * 63), 9 %
  uint64_t seed = 1;
};

// Holds sensors x luminaires, lx. Sigmas are standard errors of the means; those of direct and indirect are
// independent.
struct TracedIlluminance {
  Eigen::MatrixXd direct, direct_sigma;
  Eigen::MatrixXd indirect, indirect_sigma;
};

// Traces the scene, whose rays `rays` are; `albedo` by material.
TracedIlluminance TraceIlluminance(const Scene& scene, const RayScene& rays,
                                   const std::vector<Luminaire>& luminaires, const Eigen::VectorXd& albedo,
                                   const std::vector<Sensor>& sensors,
                                   const LightTracerOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_LIGHT_TRACER_H_
