// Degrades photos, surveys and meshes, to test how much degradation a fit tolerates.
//
//   noise        Y' = Y (1 + s g / sqrt(n)),   variance + (s Y)^2 / n      s: of one pixel, n: pixels
//   exposure     Y' = Y exp(s g), one g for each photo (view and state)
//   survey       every tag's centre moves by s g along each axis
//   albedo       rho' = rho + t (0.95 - rho)
//
// g: standard normal, drawn from the generator passed in, in the order of the input. The functions are pure.
// Noise is applied to the means that the fit uses, with the statistics of independent pixel noise: nothing
// saturates and no pixel is rejected. Units: luminance in any unit, m; world frame.
//
// Throws std::invalid_argument for negative sizes, and where more is to be left out than exists.
// Source: own.
#ifndef LUXFIT_INVERSE_STUDY_DEGRADE_H_
#define LUXFIT_INVERSE_STUDY_DEGRADE_H_

#include <Eigen/Core>
#include <random>
#include <vector>

#include "calib/targets/tags.h"
#include "forward/luminaire/luminaire.h"
#include "forward/room/scene.h"
#include "inverse/observe/observe.h"

namespace luxfit {

std::vector<Observation> WithPixelNoise(std::vector<Observation> observations, double relative_sigma,
                                        std::mt19937_64& rng);
std::vector<Observation> WithExposureErrors(std::vector<Observation> observations, double log_sigma,
                                            std::mt19937_64& rng);

// Return the observations without `dropped` of the observed views (or states), drawn at random.
std::vector<Observation> WithoutViews(const std::vector<Observation>& observations, int dropped,
                                      std::mt19937_64& rng);
std::vector<Observation> WithoutStates(const std::vector<Observation>& observations, int dropped,
                                       std::mt19937_64& rng);
int CountViews(const std::vector<Observation>& observations);
int CountStates(const std::vector<Observation>& observations);

std::vector<SurveyedTag> WithMovedTags(std::vector<SurveyedTag> survey, double sigma_m, std::mt19937_64& rng);

// Returns the scene without `dropped` pieces of furniture (forward/changes/pieces.h), drawn at random, and without materials that
// then have no facet.
Scene WithoutPieces(const Scene& scene, int dropped, std::mt19937_64& rng);

// Moves the two luminaires that are nearest to each other along the line between them until they are
// `distance_m` apart. Their middle stays. Throws std::invalid_argument for fewer than two.
std::vector<Luminaire> WithLuminairesTogether(std::vector<Luminaire> luminaires, double distance_m);

Eigen::VectorXd WithRaisedAlbedo(const Eigen::VectorXd& albedo, double share);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_STUDY_DEGRADE_H_
