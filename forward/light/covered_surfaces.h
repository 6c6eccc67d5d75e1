// Finds the surfaces that luminaires cover, and the light that goes through those surfaces.
//
//   E_is' = E_is - sum_k c_k (rho_k - rho_body) G_ik E_ks      receiver i, light s, luminaires k that are there
//
// A luminaire that hangs close below a ceiling hides a part of it: that part reflects as the luminaire's body
// does. E: illuminance without any body, E_ks: its mean over the covered part, G_ik: illuminance at i, with
// all reflections, per exitance of the covered part. c_k: share of the covered part's light that meets the
// body, which is the form factor between two equal coaxial discs of its area. The covered parts are small, so
// that terms of second order in them are left out.
//
// A luminaire covers the surface behind it (against its aim) where c_k is above a tenth: facets of one
// material within 1 cm of one plane. A point covers nothing. Units: m, lx per lm, lx per lm/m2. Source: Howell, Mengüç, Daun, Siegel (2021), "Thermal Radiation
// Heat Transfer", configuration C-41 (coaxial discs).
#ifndef LUXFIT_FORWARD_LIGHT_COVERED_SURFACES_H_
#define LUXFIT_FORWARD_LIGHT_COVERED_SURFACES_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"
#include "forward/radiosity/transport.h"

namespace luxfit {

struct CoveredSurface {
  int luminaire = 0;
  int material = 0;
  double share = 0;                              // c_k
  std::vector<std::pair<int, double>> elements;  // of the room, and how much of each is covered, m2
};

// Returns the surfaces that the luminaires cover, at most one for each luminaire.
std::vector<CoveredSurface> FindCoveredSurfaces(const Room& room, const std::vector<Luminaire>& luminaires);

struct CoveredLight {
  Eigen::MatrixXd response;  // G, receivers x surfaces
  Eigen::MatrixXd incident;  // E_ks, surfaces x luminaires, per lumen of each luminaire
};

// Returns what the bodies take from the light of each luminaire alone: receivers x luminaires, lx per lm. Where
// bodies are always there, all of them take from each luminaire; otherwise its own body does.
Eigen::MatrixXd HiddenLight(const std::vector<CoveredSurface>& surfaces, const CoveredLight& light,
                            const Eigen::VectorXd& albedo, double body_albedo, bool always_there);

// Throws as ComputeIlluminance does.
CoveredLight ComputeCoveredLight(const Room& room, const Receivers& receivers,
                                 const LuminaireVisibility& visibility,
                                 const std::vector<Luminaire>& luminaires, const Transport& transport,
                                 const std::vector<CoveredSurface>& surfaces);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_COVERED_SURFACES_H_
