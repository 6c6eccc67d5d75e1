#include "inverse/observe/seen_luminaires.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "inverse/observe/internal/angle.h"

namespace luxfit {
namespace {

constexpr size_t kFewestPoints = 6;
constexpr double kPlaceErrorM = 0.05;

// Returns the pixels per radian at a direction: the mean of both axes, as areas have it.
double PxPerRad(const Camera& camera, const Eigen::Vector3d& direction_in_cam) {
  const auto j = ProjectWithJacobian(camera, direction_in_cam).d_pixel_d_point;
  return std::pow((j * j.transpose()).determinant(), 0.25);
}

SeenOutline OutlineOf(const Camera& camera, const RegisteredView& view, const PhotoBlobs& photo,
                      const BrightBlob& blob) {
  const Eigen::Isometry3d world_from_cam = view.cam_from_world.inverse();
  SeenOutline outline{photo.view, view.camera, photo.state, world_from_cam.translation(), {}};
  outline.rays.reserve(blob.contour_px.size());
  for (const Eigen::Vector2d& pixel : blob.contour_px) {
    const Eigen::Vector3d in_cam = Unproject(camera, pixel);
    if (!in_cam.allFinite()) continue;
    outline.rays.push_back({world_from_cam.linear() * in_cam, PxPerRad(camera, in_cam)});
  }
  return outline;
}

Eigen::Vector3d CentreOf(const SeenOutline& outline) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const OutlineRay& ray : outline.rays) sum += ray.direction;
  return sum.normalized();
}

// Returns the angle from the outline's centre to the luminaire where it may be its own, else infinity.
double AngleToCentre(const SeenOutline& outline, const Luminaire& luminaire) {
  const Eigen::Vector3d to = luminaire.position - outline.eye;
  const Eigen::Vector3d centre = CentreOf(outline);
  double radius = 0;
  for (const OutlineRay& ray : outline.rays) radius = std::max(radius, AngleBetween(centre, ray.direction));
  const double angle = AngleBetween(centre, to);
  return angle < radius + kPlaceErrorM / std::max(to.norm(), kPlaceErrorM)
             ? angle
             : std::numeric_limits<double>::infinity();
}

struct Match {
  size_t outline = 0;
  int luminaires_on = 0;
  double angle = 0;
};
bool operator<(const Match& a, const Match& b) {
  return std::make_pair(a.luminaires_on, a.angle) < std::make_pair(b.luminaires_on, b.angle);
}

}  // namespace

std::vector<SeenOutline> FindSeenOutlines(const std::vector<Camera>& cameras,
                                          const std::vector<RegisteredView>& views,
                                          const std::vector<PhotoBlobs>& photos) {
  std::vector<SeenOutline> outlines;
  for (const PhotoBlobs& photo : photos) {
    if (photo.view < 0 || static_cast<size_t>(photo.view) >= views.size())
      throw std::invalid_argument("FindSeenOutlines: view: expected one of the registered ones");
    const RegisteredView& view = views[static_cast<size_t>(photo.view)];
    for (const BrightBlob& blob : photo.blobs) {
      SeenOutline outline = OutlineOf(cameras[static_cast<size_t>(view.camera)], view, photo, blob);
      if (outline.rays.size() >= kFewestPoints) outlines.push_back(std::move(outline));
    }
  }
  return outlines;
}

std::vector<LuminaireOutline> MatchOutlines(const std::vector<SeenOutline>& outlines,
                                            const std::vector<Luminaire>& luminaires,
                                            const std::vector<Eigen::VectorXd>& dimming) {
  std::map<std::pair<int, int>, Match> best;  // by luminaire and view
  for (size_t i = 0; i < outlines.size(); ++i) {
    const Eigen::VectorXd& on = dimming[static_cast<size_t>(outlines[i].state)];
    int owner = -1, owners = 0;
    double angle = 0;
    for (size_t k = 0; k < luminaires.size(); ++k) {
      if (!(on[static_cast<Eigen::Index>(k)] > 0)) continue;
      const double found = AngleToCentre(outlines[i], luminaires[k]);
      if (!std::isfinite(found)) continue;
      ++owners, owner = static_cast<int>(k), angle = found;
    }
    if (owners != 1) continue;
    const Match match{i, static_cast<int>((on.array() > 0).count()), angle};
    const auto [known, is_new] = best.try_emplace({owner, outlines[i].view}, match);
    if (!is_new && match < known->second) known->second = match;
  }
  std::vector<LuminaireOutline> matched;
  matched.reserve(best.size());
  for (const auto& [key, match] : best) matched.push_back({key.first, outlines[match.outline]});
  return matched;
}

}  // namespace luxfit
