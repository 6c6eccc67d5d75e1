// Estimates how far surfaces that no photo shows depart from even, diffuse ones, and what that does to a fit.
//
//   E_i = D_i + sum_p G_ip rho_p (1 + t_p) H_p,     t ~ N(0, tau^2 K_l),     K_l(p, q) = exp(-d_pq^2 / 2 l^2)
//   r = M (e + B t),   e ~ N(0, s^2 I),   B_ip = u_i G_ip rho_p H_p,   M = I - J H^-1 J^T
//
// A reading sees such a surface by the light that it reflects only. A fit with one reflectance for each material
// therefore puts all that the model lacks of indirect light (gloss, texture, geometry) into these reflectances.
// t_p stands for that: the relative error of the light that leaves cell p of the surfaces. H: illuminance of the
// cell, G: illuminance at row i per exitance of the cell, with all reflections, u: root weight of the row.
//
// Cells are cubes of the room's surfaces, by material and facing, about kMostCells in all; d_pq: distance of
// their centres. Cells of other materials or facings have errors of their own. The mean of t over each material,
// by area, is 0, since the reflectance is the mean.
//
// tau, l and s are not known, and few readings hardly tell them. The covariance of t is therefore the mean of
// tau^2 K_l over their restricted likelihood given r: flat in tau from 0 to 1 (a surface cannot reflect less than
// nothing), over lengths l that double from a cell to the room, and flat in ln s below the rows' own sigma.
// Restricted means that the parameters of the fit are integrated out.
//
// RootOfCellErrors returns L with Cov(t) = L L^T. The columns of B L are those for WeightedRows::biases
// (inverse/model/internal/intervals/fit_covariance.h), each at 1 sigma.
//
// Sources: Kennedy and O'Hagan (2001), "Bayesian calibration of computer models" (model discrepancy);
// Brynjarsdottir and O'Hagan (2014), "Learning about physical parameters: the importance of model discrepancy";
// Patterson and Thompson (1971) (restricted likelihood); Gelman (2006), "Prior distributions for variance
// parameters" (flat in tau).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_INDIRECT_ERROR_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_INDIRECT_ERROR_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "forward/light/covered_surfaces.h"
#include "forward/light/room.h"
#include "inverse/model/internal/intervals/fit_covariance.h"
#include "inverse/model/light_state.h"

namespace luxfit {

constexpr int kMostCells = 256;

// Returns, by material, whether no photo's row of a weight above 0 shows it. `weight`: robust weights of all rows.
std::vector<bool> MaterialsWithoutPhotos(const Room& room, const LightData& data,
                                         const Eigen::VectorXd& weight);

struct IndirectCells {
  std::vector<CoveredSurface> surfaces;        // each wholly covered
  std::vector<std::array<int, 2>> surface_of;  // by cell: material, and facing (axis and sign)
  Eigen::Matrix3Xd center;                     // m
  Eigen::VectorXd area_m2;
  double side_m = 0;
};

// Cuts the materials that `is_cut` names into cells.
IndirectCells CutIntoCells(const Room& room, const std::vector<bool>& is_cut);

// Returns the correlation of t between cells that are `length_m` long, with the mean of each material taken out.
// 0: each cell by itself.
Eigen::MatrixXd CellCorrelation(const IndirectCells& cells, double length_m);

// `effect`: weighted rows x cells, B. `prior_gradient`: half the derivative of the squares of priors and smoothness
// by the parameters. `used_rows`: rows with a weight.
Eigen::MatrixXd RootOfCellErrors(const WeightedRows& rows, const Eigen::VectorXd& prior_gradient,
                                 const Eigen::MatrixXd& effect, const IndirectCells& cells, int used_rows);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_INDIRECT_ERROR_H_
