// The light of one group of luminaires as linear equations in the fluxes at given places and in 1 / albedo.
//
//   sum_j g_j D_ij - q_m(i) Y_i = -I_i     photos: q = 1 / albedo of the place's material
//   sum_j g_j D_ij + b          = E_i      readings alone: b, light from other surfaces, taken as even
//   g, q, b >= 0
//
// Symbols as in sparse_luminaires.h. Rows weigh by a relative error of 10 %, with a floor where there is
// little light; columns of sources are weighted likewise (Weighted). Source: Lawson and Hanson (1974), ch. 23
// (NNLS).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_GROUP_EQUATIONS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_GROUP_EQUATIONS_H_

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "inverse/model/internal/grouped_light.h"

namespace luxfit {

class GroupEquations {
 public:
  GroupEquations(const GroupedLight& light, int group);

  // Places that show the group's light, and the materials whose q (or, -1, whose b) are unknown.
  const std::vector<Eigen::Index>& rows() const { return rows_; }
  const std::vector<int>& materials() const { return materials_; }

  // Of a column of D over all places: the group's rows, weighted.
  Eigen::VectorXd Weighted(const Eigen::VectorXf& column) const {
    return column(rows_).cast<double>().cwiseProduct(root_weight_);
  }

  // Weighs down the rows that a solution with these sources does not explain (Cauchy, at three times the
  // median residual's sigma): surfaces that are not what the mesh says.
  void Reweigh(const Eigen::MatrixXd& sources);

  struct Solution {
    Eigen::VectorXd strength, other;  // g; q or b by material
    double cost = std::numeric_limits<double>::infinity();
  };
  // Sources that are there already, solved: what one more source does not change is computed once.
  struct Base {
    Eigen::MatrixXd columns, gram;
    Eigen::VectorXd moment, residual;
    Eigen::MatrixXd positive;             // columns of the unknowns that are not 0
    Eigen::LDLT<Eigen::MatrixXd> factor;  // of their normal equations
    Solution solution;
  };
  Base Solve(const Eigen::MatrixXd& sources) const;
  // With one more source, whose strength comes last.
  Solution SolveWith(const Base& base, const Eigen::VectorXd& source) const;
  // By how much one more source lowers the squares where no unknown meets its bound for it; 0 where it is of
  // no use. A hundredth of the work of SolveWith.
  static double Gain(const Base& base, const Eigen::VectorXd& source);

 private:
  void SetUp(const std::vector<int>& material, const Eigen::VectorXd& value, const Eigen::VectorXd& indirect);
  // From the unknowns, `other` first.
  Solution SolutionOf(const Eigen::VectorXd& x, const Eigen::MatrixXd& gram,
                      const Eigen::VectorXd& moment) const;

  std::vector<Eigen::Index> rows_;
  std::vector<int> materials_;
  Eigen::VectorXd root_weight_, target_;
  Eigen::MatrixXd others_;  // columns of q and b
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_GROUP_EQUATIONS_H_
