// A luminaire as a sum of parts, each with a share of its flux.
//
//   E = sum_j f_j E_j,   sum_j f_j = 1        E_j: per lm of part j alone
//
// Gamma nodes, of a rotationally symmetric table of intensities: part j is the lobe that is 1 at node j, 0 at
// its neighbours and linear in gamma between, normalised to 1 lm; f_j = I_j w_j, with w_j the flux of that
// lobe at 1 cd.
// Sides, of a rotationally symmetric table that reaches above the horizontal: part 0 is the light of the nodes up to
// 90 degrees from the aim, part 1 that of the others, each normalised to 1 lm.
// Cells, of a rectangle with uneven emission: part j is the cell alone, numbered along the heading first.
//
// Light is linear in the shares, so that the derivative of E by f_j is E_j, direct and interreflected.
// Throws std::invalid_argument for parts that the luminaire does not have. Source: house.
#ifndef LUXFIT_FORWARD_LUMINAIRE_LUMINAIRE_PARTS_H_
#define LUXFIT_FORWARD_LUMINAIRE_LUMINAIRE_PARTS_H_

#include <Eigen/Core>
#include <vector>

#include "forward/luminaire/luminaire.h"
#include "forward/luminaire/photometry.h"

namespace luxfit {

enum class PartKind { kGammaNode, kCell, kSide };

// Whether the luminaire is a rectangle whose cells do not share its flux evenly.
bool HasUnevenEmission(const Luminaire& luminaire);

// Shares of the flux by part; empty for a luminaire that has no such parts.
Eigen::VectorXd PartShares(const Luminaire& luminaire, PartKind kind);

// The luminaire with other shares, >= 0; they are scaled to sum to 1. A side without light has no shape: it stays
// dark whatever its share.
Luminaire WithPartShares(const Luminaire& luminaire, PartKind kind, const Eigen::VectorXd& shares);

// One part alone, with the flux of the whole; it is sampled as finely as the whole.
Luminaire PartOf(const Luminaire& luminaire, PartKind kind, int part);

// w_j in lm per cd, one a node. gamma in rad.
Eigen::VectorXd NodeFlux(const std::vector<double>& gamma_rad);

// Shares of the flux of each side by node, sides x nodes: each row sums to 1, or is 0 for a dark side. Throws as
// PartOf for a luminaire without sides.
Eigen::MatrixXd NodesOfSides(const Luminaire& luminaire);

// A Lambertian emitter on both sides, every 2.5 degrees: cos(gamma) (1 - share_up) / pi up to 90 degrees from the
// aim, -cos(gamma) share_up / pi above. Throws std::invalid_argument for a share outside [0, 1].
IntensityTable TwoSidedTable(double share_up);

// The same intensity all round the aim, any unit, normalised to 1 lm. Throws as ExpandPlanes and Normalized.
IntensityTable RotationalTable(const std::vector<double>& gamma_rad, const std::vector<double>& intensity);

// The cells of a rectangle as luminaires of their own, each with its share in flux_lm, and their centres in
// units of the rectangle's sides. The luminaire itself where its emission is even.
struct LuminaireCell {
  Luminaire luminaire;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
};
std::vector<LuminaireCell> CellsOf(const Luminaire& luminaire);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_LUMINAIRE_PARTS_H_
