// Finds where surveyed tags cover a photo: no surface of the room is seen there.
#ifndef LUXFIT_INVERSE_OBSERVE_TAG_QUADS_H_
#define LUXFIT_INVERSE_OBSERVE_TAG_QUADS_H_

#include <Eigen/Geometry>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/targets/tags.h"
#include "inverse/observe/observe.h"

namespace luxfit {

// Of the tags in front of the camera, with their paper.
std::vector<PixelQuad> TagQuads(const std::vector<SurveyedTag>& survey, const Camera& camera,
                                const Eigen::Isometry3d& cam_from_world);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_TAG_QUADS_H_
