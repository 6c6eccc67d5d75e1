#include "inverse/advise/internal/photo_view.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "inverse/model/internal/blocks/outline_block.h"
#include "inverse/observe/observe.h"

namespace luxfit {
namespace {

// Returns whether the pixel lies in the picture, `margin_px` from its edge.
bool IsInPicture(const Camera& camera, const Eigen::Vector2d& pixel, double margin_px) {
  return pixel.allFinite() && pixel.x() >= margin_px && pixel.y() >= margin_px &&
         pixel.x() <= camera.width_px - 1 - margin_px && pixel.y() <= camera.height_px - 1 - margin_px;
}

// Returns the pixels of an element's image.
double PixelsOf(const Element& element, const Camera& camera, const Eigen::Isometry3d& cam_from_world) {
  const auto j = ProjectWithJacobian(camera, cam_from_world * element.center).d_pixel_d_point;
  const Eigen::Vector2d u = j * (cam_from_world.linear() * element.edge_u),
                        v = j * (cam_from_world.linear() * element.edge_v);
  const double whole_m2 = element.edge_u.cross(element.edge_v).norm();
  return std::abs(u.x() * v.y() - u.y() * v.x()) * element.area_m2 / whole_m2;
}

// Returns points on the outline, in world.
std::vector<Eigen::Vector3d> OutlineOf(const Luminaire& luminaire) {
  const LuminaireAxes axes = AxesOf(luminaire);
  std::vector<Eigen::Vector3d> points;
  points.reserve(kOutlinePoints);
  for (int i = 0; i < kOutlinePoints; ++i) {
    const double angle = 2 * M_PI * (i + 0.5) / kOutlinePoints;
    Eigen::Vector2d at(std::cos(angle), std::sin(angle));
    if (luminaire.shape == LuminaireShape::kRectangle) at /= at.cwiseAbs().maxCoeff();
    const double along_m = luminaire.size_m[0];
    const double across_m =
        luminaire.shape == LuminaireShape::kRectangle ? luminaire.size_m[1] : luminaire.size_m[0];
    points.push_back(luminaire.position + 0.5 * along_m * at.x() * axes.along +
                     0.5 * across_m * at.y() * axes.across);
  }
  return points;
}

bool HasOutline(const Luminaire& luminaire) {
  const bool is_flat =
      luminaire.shape == LuminaireShape::kRectangle || luminaire.shape == LuminaireShape::kDisc;
  return is_flat && luminaire.size_m[0] > 0;
}

// Returns the pixels per radian at a direction: the mean of both axes, as areas have it.
double PxPerRad(const Camera& camera, const Eigen::Vector3d& direction_in_cam) {
  const auto j = ProjectWithJacobian(camera, direction_in_cam).d_pixel_d_point;
  return std::pow((j * j.transpose()).determinant(), 0.25);
}

}  // namespace

std::vector<int> VisibleElements(const Room& room, const std::vector<int>& elements, const Camera& camera,
                                 const Eigen::Isometry3d& cam_from_world) {
  const PixelMapOptions needed;
  const Eigen::Vector3d eye = cam_from_world.inverse().translation();
  std::vector<int> visible;
  for (size_t i = 0; i < elements.size(); ++i) {
    const Element& element = room.patches.elements[static_cast<size_t>(elements[i])];
    if (!((eye - element.center).dot(element.normal) > 0)) continue;
    if (!IsInPicture(camera, Project(camera, cam_from_world * element.center), needed.guard_px)) continue;
    if (PixelsOf(element, camera, cam_from_world) < needed.min_pixels) continue;
    if (room.rays.Occluded(eye, LiftedOff(element.center, element.normal))) continue;
    visible.push_back(static_cast<int>(i));
  }
  return visible;
}

int VisibleTags(const Room& room, const std::vector<SurveyedTag>& tags, const Camera& camera,
                const Eigen::Isometry3d& cam_from_world, double least_side_px) {
  const Eigen::Vector3d eye = cam_from_world.inverse().translation();
  int visible = 0;
  for (const SurveyedTag& tag : tags) {
    const Eigen::Vector3d front = LiftedOff(tag.center_in_world, tag.normal_in_world);
    if (!((eye - front).dot(tag.normal_in_world) > 0) || room.rays.Occluded(eye, front)) continue;
    const auto corners = TagCornersInWorld(tag);
    std::array<Eigen::Vector2d, 4> pixels;
    for (size_t i = 0; i < 4; ++i) pixels[i] = Project(camera, cam_from_world * corners[i]);
    if (!std::all_of(pixels.begin(), pixels.end(),
                     [&](const Eigen::Vector2d& p) { return IsInPicture(camera, p, 1); }))
      continue;
    double around_px = 0;
    for (size_t i = 0; i < 4; ++i) around_px += (pixels[i] - pixels[(i + 1) % 4]).norm();
    visible += around_px / 4 >= least_side_px ? 1 : 0;
  }
  return visible;
}

Eigen::MatrixXd OutlineInformation(const Room& room, const LightState& state,
                                   const std::vector<Parameter>& parameters, int luminaire,
                                   const Camera& camera, const Eigen::Isometry3d& cam_from_world) {
  const Luminaire& shining = state.luminaires[static_cast<size_t>(luminaire)];
  const Eigen::Vector3d eye = cam_from_world.inverse().translation();
  if (!HasOutline(shining) || !((eye - shining.position).dot(shining.aim) > 0)) return {};
  LightData data;
  data.dimming.emplace_back(Eigen::VectorXd::Ones(static_cast<Eigen::Index>(state.luminaires.size())));
  LuminaireOutline& outline = data.outlines.emplace_back();
  outline.luminaire = luminaire;
  outline.seen.eye = eye;
  for (const Eigen::Vector3d& point : OutlineOf(shining)) {
    const Eigen::Vector3d in_cam = cam_from_world * point;
    if (!IsInPicture(camera, Project(camera, in_cam), 1)) return {};
    if (room.rays.Occluded(eye, LiftedOff(point, shining.aim))) return {};
    outline.seen.rays.push_back({(point - eye).normalized(), PxPerRad(camera, in_cam.normalized())});
  }
  const OutlineBlock block(data);
  Eigen::MatrixXd rows(kOutlinePoints, static_cast<Eigen::Index>(parameters.size()));
  for (int i = 0; i < kOutlinePoints; ++i) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(rows.cols());
    block.AddOwnDerivatives(state, parameters, 0, i, row);
    rows.row(i) = row / kOutlineSigmaPx;
  }
  const Eigen::VectorXd sum = rows.colwise().sum();
  const double grown = std::pow(kOutlineSigmaPx / kOutlineGrowthPx, 2) + kOutlinePoints;
  return rows.transpose() * rows - sum * sum.transpose() / grown;
}

}  // namespace luxfit
