// Illuminance of any receiver from any luminaire, direct and interreflected, with derivatives.
//
//   E_ek = V_ek D_ek + sum_j F_ej M_jk,     M_k = Exitance(patch mean of V D_k)        element e
//   E_sk = V_sk D_sk + sum_e G_se rho_e E_ek                                           sensor s
//
// lx per lm of luminaire k. D: direct illuminance, V: visible share, F and G: form factors, M: exitance.
// Derivatives with respect to a
// luminaire's parameter take the same path with dD in place of D (light is linear in what the luminaires put
// in), one more column each and no further factorisation; those with respect to a material's reflectance are
// Transport::ExitanceDerivatives. All are exact for frozen visibility; the motion of shadow edges is added
// where asked for.
//
// Columns of d_luminaire are in the order of `parameters`, those of d_albedo luminaire-major: k * materials +
// m.
#ifndef LUXFIT_FORWARD_LIGHT_ILLUMINANCE_H_
#define LUXFIT_FORWARD_LIGHT_ILLUMINANCE_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"

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
};

struct LuminaireParameter {
  int luminaire = 0;
  LuminaireQuantity quantity = LuminaireQuantity::kPositionX;
  int part = 0;  // of kGammaNode and kCell
};

struct Illuminance {
  Eigen::MatrixXf total;        // receivers x luminaires, lx per lm
  Eigen::MatrixXf direct;       // its direct part
  Eigen::MatrixXf d_luminaire;  // receivers x parameters
  Eigen::MatrixXf d_albedo;     // receivers x (luminaires * materials)
};

struct DerivativeRequest {
  std::vector<LuminaireParameter> parameters;
  std::vector<int> materials;
  // Follow the edges of shadows too, where places see a part of a disc or rectangle
  // (forward/direct/internal/shadowed_light.h). Costs some hundred rays a place; fits that update visibility between their
  // steps do without.
  bool moving_shadows = false;
};

// `albedo` by material of the scene.
Illuminance ComputeIlluminance(const Room& room, const Receivers& receivers,
                               const LuminaireVisibility& visibility,
                               const std::vector<Luminaire>& luminaires, const Eigen::VectorXd& albedo,
                               const DerivativeRequest& derivatives = {});

// The same with the room's transport already factored for its reflectances, which costs more than all else
// where a few luminaires move and no surface changes.
Illuminance ComputeIlluminance(const Room& room, const Receivers& receivers,
                               const LuminaireVisibility& visibility,
                               const std::vector<Luminaire>& luminaires, const Transport& transport,
                               const DerivativeRequest& derivatives = {});

// The direct part alone, of the receivers and in both `total` and `direct`, with its derivatives but those by
// reflectances; for those who know the indirect light from elsewhere. Of `visibility` only the receivers'
// part is needed (ComputeReceiverVisibility).
Illuminance ComputeDirectIlluminance(const Room& room, const Receivers& receivers,
                                     const LuminaireVisibility& visibility,
                                     const std::vector<Luminaire>& luminaires,
                                     const DerivativeRequest& derivatives = {});

// F M: illuminance of every element by the exitance of the patches (patches x columns to elements x columns).
// Of a sparse room the same all over a patch.
Eigen::MatrixXf IndirectAtElements(const Room& room, const Eigen::MatrixXf& patch_exitance);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_ILLUMINANCE_H_
