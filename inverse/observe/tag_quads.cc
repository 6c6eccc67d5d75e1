#include "inverse/observe/tag_quads.h"

namespace luxfit {
namespace {

// A tag's paper reaches beyond its black square: one cell of white border at least, mounts often more.
constexpr double kTagMargin = 1.5;

}  // namespace

std::vector<PixelQuad> TagQuads(const std::vector<SurveyedTag>& survey, const Camera& camera,
                                const Eigen::Isometry3d& cam_from_world) {
  std::vector<PixelQuad> quads;
  for (SurveyedTag tag : survey) {
    tag.size_m *= kTagMargin;
    PixelQuad quad;
    bool in_front = true;
    const auto corners = TagCornersInWorld(tag);
    for (size_t i = 0; i < 4; ++i) {
      quad[i] = Project(camera, cam_from_world * corners[i]);
      in_front = in_front && quad[i].allFinite();
    }
    if (in_front) quads.push_back(quad);
  }
  return quads;
}

}  // namespace luxfit
