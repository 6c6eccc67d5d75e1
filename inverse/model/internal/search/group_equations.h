// Solves the light of a group of luminaires as linear equations in 1 / albedo and fluxes at given places.
//
//   sum_j g_j D_ij - q_m(i) Y_i = -I_i     photos: q = 1 / albedo of the place's material
//   sum_j g_j D_ij + b          = E_i      readings alone: b, light from other surfaces, taken as even
//   g, b >= 0, q >= 1 / 0.95
//
// The unknowns are g, b and q - 1 / 0.95: all are bounded by 0.
// Symbols are those of sparse_luminaires.h. Rows are weighted by a relative error of 10 %, with a floor where
// there is little light. Weighted() weights the light of sources likewise.
// Source: Lawson and Hanson (1974), ch. 23 (NNLS).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_GROUP_EQUATIONS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_GROUP_EQUATIONS_H_

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "inverse/model/internal/search/grouped_light.h"
#include "inverse/model/internal/search/lit_places.h"

namespace luxfit {

class GroupEquations {
 public:
  GroupEquations(const GroupedLight& light, int group);

  // The places that show the group's light, and the materials whose q is unknown; -1 stands for b.
  const std::vector<Eigen::Index>& rows() const { return rows_; }
  const std::vector<int>& materials() const { return materials_; }

  // Returns the light of a place on the group's rows, weighted: its LobeColumns are weighted columns of D.
  LitPlace Weighted(const LitPlace& place) const;

  // Lowers the weight of rows that a solution with these sources does not explain, until the solution settles. There the mesh is
  // wrong about the surface: dark things stand on a floor. Errors are relative to the larger of what is measured and what is modelled.
  // Against the measured alone, a thing of a fifth of the floor's reflectance errs by 400 %, and no light at all explains it best. With
  // photos, the strengths are first tried at several scales, and the one of least median residual is where it starts.
  // Sources: Geman and McClure (1987), "Statistical methods for tomographic image reconstruction" (rows that are darker than
  // modelled: weights 1 / (1 + r^2)^2, r in twice the median residual's sigma. Brighter ones and readings have Cauchy's, at
  // three times: they may be a beam that no source explains yet); Rousseeuw (1984), "Least median of squares regression".
  void Reweigh(const Eigen::MatrixXd& sources);

  struct Solution {
    Eigen::VectorXd strength, other;  // g; q or b by material
    double cost = std::numeric_limits<double>::infinity();
  };
  // Holds the solution for the present sources: what one more source does not change is computed once.
  struct Base {
    Eigen::MatrixXd columns, gram;
    Eigen::VectorXd moment, residual;
    Eigen::MatrixXf positive;  // orthonormal columns that span those of the unknowns above 0
    Solution solution;
  };
  Base Solve(const Eigen::MatrixXd& sources) const;
  // Returns the light of each row that the solution leaves unexplained: lx, or radiosity over reflectance.
  Eigen::VectorXd Unexplained(const Base& base) const { return base.residual.cwiseQuotient(root_weight_); }
  // Returns the mean square of a solution's residuals: over all rows, or over those that direct light fills by half and
  // more where that is larger and there are enough of them. A narrow beam falls on few rows; the others are explained
  // whatever the source.
  double MeanSquare(const Eigen::VectorXd& residual) const;
  // Solves with one more source, whose strength comes last.
  Solution SolveWith(const Base& base, const Eigen::VectorXd& source) const;
  // Returns by how much each of `sources`, as one more, lowers the squares while no unknown meets its bound; 0
  // where it does not help. One takes a thousandth of the work of SolveWith. Single precision ranks them.
  static Eigen::VectorXf Gains(const Base& base, const Eigen::MatrixXf& sources);

 private:
  void SetUp(const std::vector<int>& material);
  void MultiplyWeights(const Eigen::VectorXd& by);
  bool AreReadings() const { return materials_.front() < 0; }
  // Residuals by row, and the sigmas they are divided by.
  struct Residuals {
    Eigen::VectorXd value, sigma;  // positive: brighter than modelled
  };
  Residuals ResidualsOf(const Eigen::VectorXd& direct, const Eigen::VectorXd& other) const;
  // Returns root weights by row.
  Eigen::VectorXd RobustWeights(const Residuals& left) const;
  // Returns the solution at the scale of its strengths that leaves the least median residual. Each material has the
  // median of what its rows say.
  Solution BestScaled(const Eigen::MatrixXd& light, Solution best) const;
  // Reads the solution from the unknowns, `other` first.
  Solution SolutionOf(const Eigen::VectorXd& x, const Eigen::MatrixXd& gram,
                      const Eigen::VectorXd& moment) const;

  std::vector<Eigen::Index> rows_;
  std::vector<int> materials_;
  std::vector<Eigen::Index> column_;  // of materials_, by row
  Eigen::VectorXd value_, indirect_;  // Y or E, I
  Eigen::VectorXd root_weight_, target_;
  std::vector<Eigen::Index> lit_;  // of the rows, those that direct light fills
  Eigen::MatrixXd others_;         // columns of q and b
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_GROUP_EQUATIONS_H_
