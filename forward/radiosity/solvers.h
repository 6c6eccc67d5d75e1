// Solves radiosity by any of the field's solvers, behind one function.
//
//   (I - rho F) M = rho D,     E = D + F M
//   M: exitance, lm/m2; D, E: direct and total illuminance, lx
//
//   lu                   dense factorisation of I - rho F; n^2 floats more
//   cholesky             of the symmetrised S of transport.h; n^2 floats more; best for many columns
//   jacobi               M_i <- rho_i (D_i + sum_{j != i} F_ij M_j) / (1 - rho_i F_ii), all at once
//   gauss_seidel         the same, one after the other
//   neumann              M = sum_{k < bounces} (rho F)^k rho D: so E has exactly `bounces` reflections.
//                        0: direct light only; 1: D + F rho D, one reflection; ...
//   shooting             progressive refinement: the patch with the most unshot flux shoots; at the end what
//                        is left unshot is spread as the ambient term rho_i mean(dM) / (1 - mean rho), area
//                        means
//   conjugate_gradient   on the symmetrised S
//   bicgstab             on I - rho F, for couplings that are not quite symmetric
//   auto                 cholesky or conjugate_gradient by the number of patches and columns
//
// All but neumann end with one gathering step M = rho (D + F M~). It also measures the residual r. A row sum
// q = max_i (F rho)_i < 1 bounds the error of the illuminance at every patch:
//   r = rho (D + F M~) - M~
//   max |dE| <= max_i (F 1)_i max |r| / (1 - q)
// Where sampled form factors make q >= 1, max rho takes its place. Iteration stops when this bound is below
// the tolerance; neumann reports by it how much light its truncation leaves out.
//
// Shapes: albedo by material, in [0, 1); direct_lx patches x columns, columns independent.
//
// Throws std::invalid_argument for shapes, NaN or reflectances outside [0, 1) (a closed room that absorbs
// nothing has no solution), and for a dense solver on a transport without a matrix. A solver that has not
// converged within max_iterations returns `converged` false; `message` says how far it came. Sources: Cohen
// and Wallace (1993), "Radiosity and Realistic Image Synthesis", ch. 5; Cohen, Chen, Wallace, Greenberg
// (1988), "A progressive refinement approach to fast radiosity image generation" (ambient term); Hestenes and
// Stiefel (1952); van der Vorst (1992), "Bi-CGSTAB".
#ifndef LUXFIT_FORWARD_RADIOSITY_SOLVERS_H_
#define LUXFIT_FORWARD_RADIOSITY_SOLVERS_H_

#include <Eigen/Core>
#include <string>

#include "forward/radiosity/transport.h"

namespace luxfit {

enum class RadiositySolver {
  kAuto,
  kLu,
  kCholesky,
  kJacobi,
  kGaussSeidel,
  kNeumann,
  kShooting,
  kConjugateGradient,
  kBicgstab,
};
std::string ToString(RadiositySolver solver);

struct RadiositySolverOptions {
  RadiositySolver solver = RadiositySolver::kAuto;
  // Bound on the error at every patch, in percent of the area mean of the column's |direct illuminance|: ten
  // times below the accuracy of form factors and reflectances.
  double tolerance_percent = 0.1;
  // Passes over all patches; for shooting, shots of one patch. 0: 1000 passes, 100 shots a patch.
  int max_iterations = 0;
  int bounces = 5;  // neumann only
};

struct RadiositySolution {
  Eigen::MatrixXf exitance;                         // patches x columns, lm/m2
  RadiositySolver solver = RadiositySolver::kAuto;  // the one used
  std::string reason;                               // why that one
  int iterations = 0;
  double residual = 0;       // max |r| over the area mean of |E|; the worst column's
  double error_percent = 0;  // bound on |dE| over the area mean of |E|; the worst column's
  bool converged = false;    // error_percent <= tolerance_percent; neumann: always
  std::string message;
};

// Solves with a dense coupling, by any solver. forward/radiosity/internal/linear_transport.h has the one for
// couplings that are no matrix.
RadiositySolution SolveRadiosity(const TransportGeometry& geometry, const Eigen::VectorXd& albedo,
                                 const Eigen::MatrixXf& direct_lx,
                                 const RadiositySolverOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_SOLVERS_H_
