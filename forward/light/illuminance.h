// Returns the illuminance of any receiver from any luminaire, direct and interreflected, with derivatives.
//
//   E_ek = V_ek D_ek + sum_j F_ej M_jk,     M_k = Exitance(patch mean of V D_k)        element e
//   E_sk = V_sk D_sk + sum_e G_se rho_e E_ek                                           sensor s
//   E = E_direct + sum_c w_c E_indirect(rho_c) / sum_c w_c                             channels c: R, G, B
//
// E is in lx per lm of luminaire k. D: direct illuminance, V: visible share, F and G: form factors, M:
// exitance. Columns of d_luminaire are in the order of `parameters`, those of d_albedo luminaire-major: k *
// materials + m. What a caller will add up anyway (luminaires that are dimmed alike, parameters that they share) is
// added up here, before it is reflected: that is where each column costs. Reflected light takes on the surfaces' colours, so each channel has its own interreflection.
//
// Light is linear in the direct light of the luminaires. Derivatives with respect to a luminaire's parameter
// take the same path with dD in place of D: one more column each and no further factorisation. Derivatives
// with respect to a material's reflectance are Transport::ExitanceDerivatives. All are exact for frozen
// visibility; the motion of shadow edges is added where `moving_shadows` asks for it.
//
// Throws std::invalid_argument for luminaires that are not valid and reflectances outside [0, 1).
#ifndef LUXFIT_FORWARD_LIGHT_ILLUMINANCE_H_
#define LUXFIT_FORWARD_LIGHT_ILLUMINANCE_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"
#include "forward/radiosity/solvers.h"

namespace luxfit {

enum class LuminaireQuantity {
  kPositionX,
  kPositionY,
  kPositionZ,  // m, world axes
  kExponent,   // m of cosine-power
  kSizeAlong,
  kSizeAcross,  // m
  kTiltAlong,
  kTiltAcross,  // rad: aim + t1 along + t2 across, at t = 0
  kHeading,     // rad: turned about the aim, along towards across (clockwise seen from above)
  kGammaNode,   // share of the flux of one node of its table (forward/luminaire/luminaire_parts.h)
  kCell,        // share of the flux of one cell
  kSide,        // share of the flux of one side of its table, towards the aim or against it
};

struct LuminaireParameter {
  int luminaire = 0;
  LuminaireQuantity quantity = LuminaireQuantity::kPositionX;
  int part = 0;  // for kGammaNode, kCell and kSide
};

struct Illuminance {
  Eigen::MatrixXf total;        // receivers x luminaires, lx per lm
  Eigen::MatrixXf direct;       // its direct part
  Eigen::MatrixXf d_luminaire;  // receivers x parameters, or columns of `parameter_sum`
  Eigen::MatrixXf
      d_albedo;  // receivers x (luminaires * materials), or columns of `luminaire_sum` for luminaires
};

struct DerivativeRequest {
  std::vector<LuminaireParameter> parameters;
  std::vector<int> materials;
  // Follows the edges of shadows too, where places see a part of a disc or rectangle
  // (forward/direct/internal/shadowed_light.h). It costs some hundred rays per place. Fits that update
  // visibility between their steps do without.
  bool moving_shadows = false;
  // Whether d_luminaire contains reflected light. Without it, derivatives cost the receivers' direct light alone: near
  // enough for the steps of a fit, not for its covariance. d_albedo is exact either way.
  bool reflected = true;
  // Sums, one a column, with the lumens of each term. Empty: each luminaire and parameter by itself, per lumen.
  Eigen::SparseMatrix<float> luminaire_sum;  // luminaires x sums, for d_albedo
  Eigen::SparseMatrix<float> parameter_sum;  // parameters x sums, for d_luminaire
};

// Computes the illuminance; `albedo` by material of the scene.
Illuminance ComputeIlluminance(const Room& room, const Receivers& receivers,
                               const LuminaireVisibility& visibility,
                               const std::vector<Luminaire>& luminaires, const Eigen::VectorXd& albedo,
                               const DerivativeRequest& derivatives = {});

// Computes the same with the room's transport already factored for its reflectances. The factorisation costs
// more than all else where a few luminaires move and no surface changes.
Illuminance ComputeIlluminance(const Room& room, const Receivers& receivers,
                               const LuminaireVisibility& visibility,
                               const std::vector<Luminaire>& luminaires, const Transport& transport,
                               const DerivativeRequest& derivatives = {});

// Returns the total for each transport, per lumen (receivers x luminaires). The direct light is computed once: it
// serves channels of colour, which differ in their reflectances only.
std::vector<Eigen::MatrixXf> ComputeTotals(const Room& room, const Receivers& receivers,
                                           const LuminaireVisibility& visibility,
                                           const std::vector<Luminaire>& luminaires,
                                           const std::vector<const Transport*>& transports);

// Computes the direct part alone at the receivers, in both `total` and `direct`, with its derivatives except
// those by reflectances. It serves callers that know the indirect light already. `visibility` needs only the
// receivers' part (ComputeReceiverVisibility).
Illuminance ComputeDirectIlluminance(const Room& room, const Receivers& receivers,
                                     const LuminaireVisibility& visibility,
                                     const std::vector<Luminaire>& luminaires,
                                     const DerivativeRequest& derivatives = {});

// Returns F M, the illuminance of every element by the exitance of the patches (patches x columns to elements
// x columns). In a sparse room it is the same all over a patch.
Eigen::MatrixXf IndirectAtElements(const Room& room, const Eigen::MatrixXf& patch_exitance);

// Holds the illuminance in a room whose surfaces have colours.
struct ColourIlluminance {
  Eigen::MatrixXf total;             // receivers x luminaires, lx per lm
  Eigen::MatrixXf direct;            // its direct part
  Eigen::MatrixXf element_indirect;  // elements of the room x luminaires, lx per lm
  int solved_channels = 0;
  RadiositySolver solver = RadiositySolver::kAuto;  // the one used
  int iterations = 0;                               // those of the slowest channel
  double error_percent = 0;  // bound of forward/radiosity/solvers.h; the worst channel's
};

// Computes the illuminance by luminaires of neutral light in a room whose surfaces have colours. Channels of
// equal reflectances are solved once. Throws std::invalid_argument for reflectances outside [0, 1), a number
// of columns that is not the number of materials, or weights that are negative or all zero. `albedo_rgb` is
// 3 x materials of the scene; `weights` are those of R, G, B in luminance.
ColourIlluminance ComputeColourIlluminance(
    const Room& room, const Receivers& receivers, const LuminaireVisibility& visibility,
    const std::vector<Luminaire>& luminaires, const Eigen::Matrix3Xd& albedo_rgb,
    const Eigen::Vector3d& weights, const RadiositySolverOptions& solver = {RadiositySolver::kCholesky});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_ILLUMINANCE_H_
