// Finds the place and the edges of a face on cells of 2 cm, every 1 cm.
//
//   offset = mean of the offsets at which the largest rectangle has 97 % of the largest sum and more
//   edges  = that rectangle's, moved out by 1.5 px of the views: a pixel of a signature averages as much to each side
//
// Far views of one side agree over some centimetres; the middle is the best that they tell.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_REFINE_FACE_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_REFINE_FACE_H_

#include <optional>

#include "inverse/furniture/internal/faces/face.h"

namespace luxfit {

constexpr double kRefinedDepthM = 0.16;  // to each side of the given offset

// Returns none where no rectangle reaches `least_m2`.
std::optional<Face> RefineFace(const SweptViews& swept, const RoomAxes& axes, const Face& face,
                               double least_m2);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_REFINE_FACE_H_
