// Factors the interreflection between diffuse patches (radiosity) once, for any number of luminaires.
//
//   E = E_direct + F M,   M = rho E            (lx = lm/m2; M is luminous exitance)
//   (I - rho F) M = rho E_direct               solved as  S x = sqrt(A rho) E_direct,  M = sqrt(rho / A) x,
//   S = I - sqrt(rho) K sqrt(rho),  K = sqrt(A) F / sqrt(A) made symmetric (reciprocity A_i F_ij = A_j F_ji)
//
// S is symmetric positive definite whenever rho < 1, so one Cholesky factorisation serves all right-hand
// sides; rho = 0 is no special case. Everything is linear in the direct light and never depends on the
// luminaire that it came from. Columns of the matrices are independent light sources (or derivatives of
// them); rows are patches.
//
// Single patches may depart from their material: rho_i = rho_m(i) f_i, at most kMostReflectance.
//
// Throws std::invalid_argument for reflectances outside [0, 1), factors below 0 or not one for each patch, or
// when S is not positive definite (a closed room that absorbs nothing has no solution). Source: Goral et al.
// (1984), "Modeling the interaction of light between diffuse surfaces"; symmetrised form: Neumann and Neumann
// (1990).
#ifndef LUXFIT_FORWARD_RADIOSITY_TRANSPORT_H_
#define LUXFIT_FORWARD_RADIOSITY_TRANSPORT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/factors/form_factors.h"
#include "forward/room/patches.h"

namespace luxfit {

// Holds the quantities that depend on geometry alone.
struct TransportGeometry {
  Eigen::VectorXf patch_area_m2;
  std::vector<int> patch_material;
  FormFactorMatrix coupling;  // K, patches x patches, symmetric
};
TransportGeometry MakeTransportGeometry(const Patches& patches, const FormFactors& form_factors);

class Transport {
 public:
  static constexpr double kMostReflectance = 0.98;

  // Factors S; `albedo` by material; `patch_factor`: f, empty for 1. `geometry` must outlive it.
  Transport(const TransportGeometry& geometry, const Eigen::VectorXd& albedo,
            const Eigen::VectorXd& patch_factor = {});

  // Returns the exitance of every patch (patches x columns, lm/m2) for its direct illuminance (lx).
  Eigen::MatrixXf Exitance(const Eigen::MatrixXf& direct_lx) const;
  // Returns F M, the illuminance that an exitance gives back to the patches.
  Eigen::MatrixXf Irradiance(const Eigen::MatrixXf& exitance) const;
  // Returns d(exitance)/d(albedo of each material), for the illuminance E = direct + Irradiance(exitance) of
  // the same light: patches x (columns of E, each with its materials).
  //   dM = f 1_m E + rho F dM   =>   dM = f 1_m E + Exitance(F f 1_m E)
  Eigen::MatrixXf ExitanceDerivatives(const std::vector<int>& materials,
                                      const Eigen::MatrixXf& illuminance_lx) const;

  const Eigen::VectorXd& albedo() const { return albedo_; }
  const Eigen::VectorXd& patch_factor() const { return patch_factor_; }  // as given

 private:
  const TransportGeometry& geometry_;
  Eigen::VectorXd albedo_, patch_factor_;
  Eigen::VectorXf root_albedo_, root_area_;
  Eigen::MatrixXf factor_;  // lower Cholesky factor of S
};

// Returns the area means over each patch of a quantity given at the elements (elements x columns).
Eigen::MatrixXf PatchMean(const Patches& patches, const Eigen::MatrixXf& at_elements);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_TRANSPORT_H_
