// Eliminates albedo and normal of every pixel from the equations of the shared unknowns.
//
//   b_i(x) = argmin over b  sum_k w_ik (m_k(b, x) - v_ik)^2
//   A_i = sum_k w d_b d_b^T,   C_i = sum_k w d_b d_x^T,   g_i = sum_k w (m - v) d_b
//   H = P + sum_i (sum_k w d_x d_x^T - C_i^T A_i^-1 C_i)
//   g = P p + sum_i (sum_k w (m - v) d_x - C_i^T A_i^-1 g_i)
//
// b_i: albedo * normal of pixel i, x: the shared unknowns as steps from a state (stereo_terms.h), m_k: the
// model of image k, w: weights that stand still, P, p: priors of x. b_i is a closed form for Lambert's curve
// and a few damped steps for the others; what these leave, g_i still takes out to first order. This is
// variable projection.
//
// No b has a prior, and its effects change with x. RowWhitening (inverse/model/internal/weights/row_whitening.h)
// eliminates errors of known size from rows that are all kept. Here pixels are summed one by one, and only H,
// g and b are stored.
//
// Sources: Golub and Pereyra (1973); Triggs et al. (2000), sec. 6.
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_PIXEL_ELIMINATION_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_PIXEL_ELIMINATION_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "inverse/albedo/internal/stereo_adjustment.h"
#include "inverse/albedo/internal/stereo_terms.h"
#include "inverse/model/internal/condensed_problem.h"

namespace luxfit {

// Holds the used observations of one pixel, linearized at its b. `weight`: images x pixels.
class PixelRows {
 public:
  PixelRows(const StereoProblem& problem, const Eigen::MatrixXd& weight, const StereoState& state,
            Eigen::Index pixel);

  double squares() const { return squares_; }
  // Returns the change of b that lowers the squares most, with a share of A's diagonal added.
  Eigen::Vector3d Step(double damping) const;
  // Returns by how much an undamped step lowers the squares of the linearized rows.
  double Decrement() const { return gradient_.dot(covariance_ * gradient_); }
  // Returns A^-1, the covariance of b while the shared unknowns are held.
  const Eigen::Matrix3d& Covariance() const { return covariance_; }
  // Returns C, 3 x shared.
  Eigen::Matrix3Xd Coupling(const SharedUnknowns& shared) const;
  // Adds the pixel's part of H and g, and its squares.
  void AddReduced(const SharedUnknowns& shared, NormalEquations& equations) const;
  // Adds to each image's column the gradient of its observation by the shared unknowns, b eliminated.
  void AddScores(const SharedUnknowns& shared, Eigen::MatrixXd& scores) const;

 private:
  struct Row {
    Eigen::Index image = 0;
    double weight = 0, residual = 0;
    StereoTerm term;
  };
  std::vector<Row> rows_;
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient_ = Eigen::Vector3d::Zero();
  double squares_ = 0;
};

class PixelElimination {
 public:
  // Keeps references. Pixels whose b is 0 take no part.
  PixelElimination(const StereoProblem& problem, const Eigen::MatrixXd& weight, const StereoState& state);

  const SharedUnknowns& shared() const { return shared_; }
  // Returns the reduced equations at x.
  NormalEquations EquationsAt(const Eigen::VectorXd& x);
  // Returns the state at x, with every pixel's b at its best.
  StereoState StateAt(const Eigen::VectorXd& x);

 private:
  const StereoProblem& problem_;
  const Eigen::MatrixXd& weight_;
  const StereoState& state_;
  SharedUnknowns shared_;
  std::optional<Eigen::VectorXd> known_at_;  // x of the last equations
  StereoState known_;
};

// Returns the reduced equations at a state whose b stand, and each image's scores (shared x images).
struct StereoEquations {
  NormalEquations reduced;
  Eigen::MatrixXd scores;
};
StereoEquations ReducedEquations(const StereoProblem& problem, const Eigen::MatrixXd& weight,
                                 const StereoState& state);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_PIXEL_ELIMINATION_H_
