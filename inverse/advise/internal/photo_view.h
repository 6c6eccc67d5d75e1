// Tells what a photo from a pose would show: elements, outlines of luminaires, tags.
//
// An element shows where its centre lies in the picture with nothing between, its front faces the camera and its
// image has as many pixels as an observation needs (inverse/observe/observe.h). An outline shows where the whole of a
// shining luminaire does. A photo of a luminaire's outline has kOutlinePoints points on it, each with the sigma of
// inverse/model/internal/blocks/outline_block.h, and a growth that all of them share.
//
// Poses are taken as exact.
#ifndef LUXFIT_INVERSE_ADVISE_INTERNAL_PHOTO_VIEW_H_
#define LUXFIT_INVERSE_ADVISE_INTERNAL_PHOTO_VIEW_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/targets/tags.h"
#include "forward/light/room.h"
#include "inverse/model/light_state.h"

namespace luxfit {

constexpr int kOutlinePoints = 32;

// Returns the places in `elements` (indices into room.patches.elements) of those that show.
std::vector<int> VisibleElements(const Room& room, const std::vector<int>& elements, const Camera& camera,
                                 const Eigen::Isometry3d& cam_from_world);

// Counts the tags that show with sides of `least_side_px`.
int VisibleTags(const Room& room, const std::vector<SurveyedTag>& tags, const Camera& camera,
                const Eigen::Isometry3d& cam_from_world, double least_side_px);

// Returns the information on the parameters that the luminaire's outline gives; empty where it does not show.
Eigen::MatrixXd OutlineInformation(const Room& room, const LightState& state,
                                   const std::vector<Parameter>& parameters, int luminaire,
                                   const Camera& camera, const Eigen::Isometry3d& cam_from_world);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ADVISE_INTERNAL_PHOTO_VIEW_H_
