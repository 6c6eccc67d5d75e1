#include "inverse/furniture/internal/view_rays.h"

#include <algorithm>

namespace luxfit {

std::vector<ViewRay> ViewRays(const std::vector<SignatureView>& views, const std::vector<MeshAgreement>& mesh,
                              const Eigen::Matrix3d& axes_from_world) {
  constexpr int kStep = 3;
  std::vector<ViewRay> rays;
  for (size_t v = 0; v < views.size(); ++v) {
    const Eigen::Vector3d eye = views[v].Eye();
    for (int row = 0; row < mesh[v].height; row += kStep) {
      for (int column = 0; column < mesh[v].width; column += kStep) {
        const auto at =
            static_cast<size_t>(row) * static_cast<size_t>(mesh[v].width) + static_cast<size_t>(column);
        if (!mesh[v].is_compared[at]) continue;
        rays.push_back({axes_from_world * eye,
                        axes_from_world * (eye + mesh[v].distance_m[at] * RayOf(views[v], column, row)),
                        mesh[v].is_explained[at] != 0});
      }
    }
  }
  return rays;
}

bool Meets(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (box.isEmpty()) return false;
  const Eigen::Array3d d = (b - a).array();
  const Eigen::Array3d t0 = (box.min() - a).array() / d, t1 = (box.max() - a).array() / d;
  return std::max(0.0, t0.min(t1).maxCoeff()) <= std::min(1.0, t0.max(t1).minCoeff());
}

RayCount CountRays(const std::vector<ViewRay>& rays, const Eigen::AlignedBox3d& box,
                   const Eigen::AlignedBox3d& before) {
  RayCount count;
  for (const ViewRay& ray : rays) {
    if (!Meets(box, ray.from, ray.to) || Meets(before, ray.from, ray.to)) continue;
    ++count.all;
    count.free += ray.is_free ? 1 : 0;
  }
  return count;
}

}  // namespace luxfit
