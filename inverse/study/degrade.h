// Ways in which photos, surveys and meshes are worse than they were meant to be: pure functions, for asking
// how much of it a fit stands.
//
//   noise        Y' = Y (1 + s g / sqrt(n)),   variance + (s Y)^2 / n      s: of one pixel, n: pixels
//   exposure     Y' = Y exp(s g), one g a photo (view and state)
//   survey       every tag's centre moves by s g along each axis
//   albedo       rho' = rho + t (0.95 - rho)
//
// g: standard normal, drawn from the generator passed in, in the order of the input. Noise is applied to the
// means that the fit sees, with the statistics that independent noise of pixels would give them: nothing
// saturates and no pixel is rejected. Luminance in any unit, metres, world.
//
// Throws std::invalid_argument for negative sizes, and where more is to be left out than there is.
// Source: house.
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

// Without `dropped` of the views (of the states) that were observed, drawn at random.
std::vector<Observation> WithoutViews(const std::vector<Observation>& observations, int dropped,
                                      std::mt19937_64& rng);
std::vector<Observation> WithoutStates(const std::vector<Observation>& observations, int dropped,
                                       std::mt19937_64& rng);
int CountViews(const std::vector<Observation>& observations);
int CountStates(const std::vector<Observation>& observations);

std::vector<SurveyedTag> WithMovedTags(std::vector<SurveyedTag> survey, double sigma_m, std::mt19937_64& rng);

// Furniture: facets that do not lie on the scene's bounding box, joined where they share a corner. Indices
// into scene.facets, one list a piece.
std::vector<std::vector<int>> LoosePieces(const Scene& scene);
// Without `dropped` of them, drawn at random, and without the materials that then have no facet.
Scene WithoutPieces(const Scene& scene, int dropped, std::mt19937_64& rng);

// The two luminaires that are nearest to each other, moved along the line between them until they are that
// far apart, their middle where it was. Throws std::invalid_argument for fewer than two.
std::vector<Luminaire> WithLuminairesTogether(std::vector<Luminaire> luminaires, double distance_m);

Eigen::VectorXd WithRaisedAlbedo(const Eigen::VectorXd& albedo, double share);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_STUDY_DEGRADE_H_
