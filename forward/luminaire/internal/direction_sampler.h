// Draws directions by a luminaire's intensity, with a density that is known exactly.
//
//   q(w) = P_ij / (d cos(gamma)_i dC),  P_ij = I(centre of cell ij) d cos(gamma)_i dC / sum of all      per sr
//
// Cells are bands of 0.5 degrees of gamma, the angle from the aim: all round where the intensity depends on gamma alone,
// else in sectors of 5 degrees. The density is constant within a cell, so that an estimate that divides by it has no bias,
// however coarse the cells. It is 0 in cells whose centre is dark: there another way of sampling has to serve.
//
// Even points of the unit square stay even: the first coordinate tells gamma, the second C. World frame, unit vectors.
// Source: Pharr, Jakob, Humphreys (2023), "Physically based rendering", 4th ed., A.5 (piecewise-constant densities).
#ifndef LUXFIT_FORWARD_LUMINAIRE_INTERNAL_DIRECTION_SAMPLER_H_
#define LUXFIT_FORWARD_LUMINAIRE_INTERNAL_DIRECTION_SAMPLER_H_

#include <Eigen/Core>
#include <vector>

#include "forward/luminaire/luminaire.h"

namespace luxfit {

class DirectionSampler {
 public:
  // A luminaire that is dark at the centre of every cell has a density of 0 throughout.
  explicit DirectionSampler(const Luminaire& luminaire);

  Eigen::Vector3d DirectionAt(const Eigen::Vector2d& unit) const;
  double Density(const Eigen::Vector3d& direction) const;

 private:
  Eigen::Vector3d aim_;
  LuminaireAxes axes_;
  size_t sectors_;
  std::vector<double> edge_cosine_;  // of the bands, from 1 to -1
  std::vector<double> density_;      // by cell, sectors running fastest
  std::vector<double> band_share_;   // sum of P up to and with each band
  std::vector<double>
      share_within_band_;  // by cell: sum of P of the band's cells up to and with it, over the band's
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_INTERNAL_DIRECTION_SAMPLER_H_
