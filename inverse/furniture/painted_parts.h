// Finds rectangles on walls that are painted otherwise than the wall around them: windows at night, doors, boards and posters
// that the mesh lacks.
//
//   cells of a part  = neighbours joined where |step| < kSmoothStep              step, apart: internal/facet_picture.h
//   part             = cells that fill kLeastFill of the rectangle about them, kLeastPartM2 and more, and that differ from the wall by a
//                      step of one sign, kLeastStep and more, at each side that views show, two and more
//   the same in all views: apart < |step| / 2 in kLeastFill of the rectangle
//
// A side lies where the luminance passes the middle between the part's and the wall's. Shadows whose edges are as sharp in all states may
// be found, too: the light explains them, and their reflectance comes out as the wall's.
//
// Only rectangular facets of upright planes of the hull (internal/hull_planes.h) are looked at, 1 m2 and more. Metres, world frame.
// Source: Land and McCann (1971), "Lightness and retinex theory": paint changes in steps, light gradually.
#ifndef LUXFIT_INVERSE_FURNITURE_PAINTED_PARTS_H_
#define LUXFIT_INVERSE_FURNITURE_PAINTED_PARTS_H_

#include <string>
#include <vector>

#include "forward/changes/painted_rectangles.h"
#include "forward/room/scene.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {

struct PaintedPart {
  PaintedRectangle rectangle;  // named "part 1" and so on, the largest first
  std::string material;        // of the wall
  double luminance_ratio = 1;  // over that of the wall beside it
  int sides = 0;               // at which the step shows
};

// Views have the same states. `room`: with the furniture that photos show.
std::vector<PaintedPart> FindPaintedParts(const Scene& room, const std::vector<SignatureView>& views);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_PAINTED_PARTS_H_
