// Makes a closed room whose ceiling is cut so that one facet is exactly what a panel covers.
//
// The reference for luminaires' bodies: that facet may have a material, and so a reflectance, of its own.
// Metres; a corner of the room lies at the origin.
#ifndef LUXFIT_TESTS_SUPPORT_FORWARD_CUT_CEILING_H_
#define LUXFIT_TESTS_SUPPORT_FORWARD_CUT_CEILING_H_

#include <array>
#include <string>

#include "forward/luminaire/luminaire.h"
#include "tests/support/scenes.h"

namespace luxfit::support {

// Materials: wall, floor, ceiling, and `behind` for the part behind the panel.
inline Scene CutCeiling(const Eigen::Vector3d& size_m, const Luminaire& panel, const std::string& behind) {
  Scene scene = ClosedRoom(size_m, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  scene.facets.pop_back();
  const Eigen::Vector2d low = panel.position.head<2>() - 0.5 * panel.size_m, high = low + panel.size_m;
  const std::array<double, 4> x{0, low.x(), high.x(), size_m.x()}, y{0, low.y(), high.y(), size_m.y()};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      AddParallelogram(scene, {x[i], y[j], size_m.z()}, {0, y[j + 1] - y[j], 0}, {x[i + 1] - x[i], 0, 0},
                       i == 1 && j == 1 ? behind : "ceiling");
    }
  }
  return scene;
}

// Returns a panel that shines down, `below_m` under a ceiling.
inline Luminaire PanelUnder(double ceiling_m, double below_m, const Eigen::Vector2d& at,
                            const Eigen::Vector2d& size_m) {
  Luminaire panel;
  panel.id = "panel";
  panel.position = {at.x(), at.y(), ceiling_m - below_m};
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = size_m;
  return panel;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_FORWARD_CUT_CEILING_H_
