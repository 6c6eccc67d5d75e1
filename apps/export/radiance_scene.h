// Writes a lit room as a scene of Radiance, an independent renderer: surfaces, reflectances, luminaires.
//
//   surfaces     polygons of `plastic` without gloss: reflectance rho, in all three channels or by colour
//   luminaires   L = Phi I(C, gamma) / (A cos gamma) / 179      W/(sr m2), one value for R, G and B
//                a rectangle or disc as a polygon or ring that faces the aim, a point as a sphere of 2 mm
//                radius (A cos gamma its pi r^2); a sphere by its size
//
// 179 lm/W is Radiance's convention: the illuminance in lx of a value of `rtrace -I` is 179 (0.265 R + 0.670
// G + 0.065 B). A lobe that is not Lambertian is a table (`brightdata`) of cd per lm over C and gamma.
// Functions that take the luminaire's own axes read it; nothing of Radiance's library of functions is needed.
// A rectangle that shines unevenly is one polygon for each cell.
//
// Surfaces reflect on both sides in Radiance, on their front only in luxfit. Both agree in rooms whose facets
// are the outsides of solids. Luminaires are opaque in Radiance (`light`). As `illum` they let light pass
// unhindered, as in a fit.
//
// Lengths are in m, world frame. The caller gives the names of materials and files, without white space.
// Throws std::invalid_argument unless there is one name per material, and as TabulatedPhotometry does.
// Source: Ward Larson and Shakespeare (1998), "Rendering with Radiance"; "The RADIANCE 5.1 Synthetic Imaging
// System" (reference manual), sec. 2.1.
#ifndef LUXFIT_APPS_EXPORT_RADIANCE_SCENE_H_
#define LUXFIT_APPS_EXPORT_RADIANCE_SCENE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/luminaire/luminaire.h"
#include "forward/room/scene.h"

namespace luxfit {

// Returns the materials; `albedo_rgb` is 3 x materials.
std::string RadianceMaterials(const std::vector<std::string>& names, const Eigen::Matrix3Xd& albedo_rgb);
std::string RadianceSurfaces(const Scene& scene, const std::vector<std::string>& names);

struct RadianceLuminaire {
  std::string scene;  // .rad
  std::string table;  // .dat, to be stored as STEM.dat; empty: Lambertian, which needs none
};
// Returns a luminaire whose materials and surfaces are called after `stem`. `dimming` 0 gives an empty scene.
RadianceLuminaire RadianceSceneOf(const Luminaire& luminaire, const std::string& stem, double dimming = 1,
                                  bool is_opaque = true);

// Returns the functions that read the tables, to be stored as luxfit.cal.
std::string RadianceFunctions();

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_RADIANCE_SCENE_H_
