// Computes form factors from receivers to patches by a method of choice, and lists the methods.
//
//   F_ej = (1 / A_e) int_e int_j cos(theta) cos(theta') / (pi r^2) V dA' dA
//
// Rows are elements, columns patches; in a closed room a row adds up to 1, and A_e F_ej is the same from
// either side (closure and reciprocity). Both are measured before they are enforced: closure here where the
// room is closed and the method weighs pairs one by one, reciprocity in MakeTransportGeometry.
//
// The methods, each a row of FormFactorMethods():
//   hybrid             closed form or Gauss quadrature where nothing stands between (proved by shaft
//                      culling), rays between the pairs where something does; more of them where these
//                      disagree. The default.
//   analytic           double contour integration of every pair, rays as above where something stands between
//   malley             cosine-weighted rays of a low-discrepancy sequence, shifted per receiver
//                      (Cranley-Patterson)
//   malley_stratified  cosine-weighted rays, one at random in each of a grid of equal-area cells of the disc
//   isocell            cosine-weighted rays through the centres of equal cells of the disc (Masset et al.)
//   montecarlo         rays uniform over the hemisphere, weighted by 2 cos(theta)
//   hemicube           rays through the pixels of half a cube over the receiver's centre, with their delta
//                      form factors
//   single_plane       rays through the proxels of one plane over the receiver's centre; the horizon is left
//                      out
//   wallace            disc approximation from the receiver's centre to pieces of every patch, a shadow ray
//                      each
//
// Ray methods report rays that leave the scene (they carry no light) and rays that meet the back of a facet
// (they started inside a solid and do not count). Equal input gives equal results on any number of cores.
//
// Sources: Lambert (1760); Schroeder and Hanrahan (1993); Malley (1988), "A shading method for computer
// generated images"; Cranley and Patterson (1976); Masset, Bruls, Kerschen (2011), "Partition of the circle
// in cells of equal area and shape"; Cohen and Greenberg (1985), "The hemi-cube"; Sillion and Puech (1989),
// "A general two-pass method"; Wallace, Elmquist, Haines (1989), "A ray tracing algorithm for progressive
// radiosity"; Haines and Wallace (1991), "Shaft culling".
#ifndef LUXFIT_FORWARD_FACTORS_FORM_FACTORS_H_
#define LUXFIT_FORWARD_FACTORS_FORM_FACTORS_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "forward/mesh/mesh_check.h"
#include "forward/room/patches.h"
#include "forward/room/visibility.h"

namespace luxfit {

// Holds receivers x patches.
using FormFactorMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

enum class FormFactorMethod {
  kHybrid,
  kAnalytic,
  kMalley,
  kMalleyStratified,
  kIsocell,
  kMonteCarlo,
  kHemicube,
  kSinglePlane,
  kWallace,
};
std::string ToString(FormFactorMethod method);
// Returns the method of that name; nothing where the name is none of these.
std::optional<FormFactorMethod> FormFactorMethodFrom(const std::string& name);

struct FormFactorOptions {
  // Rays over the whole hemisphere of an element. Those with a grid take the nearest number that theirs
  // allows; between partly hidden pairs, hybrid and analytic spend rays as densely, and at least one a pair.
  int rays_per_element = 64;
  FormFactorMethod method = FormFactorMethod::kHybrid;
};

struct FormFactors {
  FormFactorMatrix element_to_patch;                    // elements x patches
  FormFactorMethod method = FormFactorMethod::kHybrid;  // the one that was used
  std::string because;                                  // why, where it is not the one asked for
  double escaped_fraction = 0;                          // of the rays: left the scene
  double back_fraction = 0;                             // of the rays: met the back of a facet
  double closure_error = 0;  // root mean square of 1 - row sum before it is enforced; 0: open room
  int64_t rays = 0;          // cast
};

// Throws std::invalid_argument if rays_per_element < 1.
FormFactors ComputeFormFactors(const RayScene& rays, const Patches& patches,
                               const FormFactorOptions& options = {});

// Returns what rays lost, by which WithRayShares judges findings. Elements that see nothing of the room do
// not count.
RayShares RaySharesOf(const FormFactors& form_factors);

// Returns the error of reciprocity: root mean square of A_i F_ij - A_j F_ji over that of A_i F_ij, patches as
// the area means of their elements.
double ReciprocityError(const Patches& patches, const FormFactors& form_factors);

// Returns the product of a form-factor matrix with columns of light: C = A B, float, on all cores.
Eigen::MatrixXf Product(const FormFactorMatrix& a, const Eigen::MatrixXf& b);

// Holds directions over a hemisphere with the form factor that each stands for. They are in the receiver's
// frame: z along its normal. Weights add up to the share of the hemisphere that a set covers: 1, but for the
// single plane, which leaves out the horizon, and the hemicube's small quadrature error. Equal arguments give
// equal sets.
struct Directions {
  Eigen::Matrix3Xf unit;
  Eigen::VectorXf weight;
};

// Describes one method by its functions and properties: a row of FormFactorMethods(). Other files name a
// method only where they choose it; they tell methods apart by these properties.
//   by rays over the hemisphere   F_ej = sum of w_k over the rays k from e that meet j
//   pair by pair                  F_ej from e and j themselves, with rays where something may stand between
// A new method is a value of FormFactorMethod, one file that makes its row (such as internal/isocell.cc) and
// the row's line in form_factor_ops.cc.
struct FormFactorOps {
  FormFactorMethod method = FormFactorMethod::kHybrid;
  const char* name = "";        // in options, artifacts and legends
  bool is_from_center = false;  // sees from the receiver's centre alone, not from points spread over it

  // A method has one of these two functions. `directions` makes about `count` of them; `variant` seeds the
  // random ones. `by_pairs` makes all rows; its time grows with the pairs more than with their rays.
  Directions (*directions)(int count, uint64_t variant) = nullptr;
  FormFactors (*by_pairs)(const RayScene& rays, const Patches& patches, int rays_per_element) = nullptr;

  // So many sets of directions are made; every receiver picks one. 0: it has a set made for itself.
  int direction_sets = 1;
};

// Returns all methods, in the order in which programs list them.
const std::vector<FormFactorOps>& FormFactorMethods();

// Returns the row of a method. Throws std::invalid_argument for a value that has no row.
const FormFactorOps& OpsOf(FormFactorMethod method);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_FORM_FACTORS_H_
