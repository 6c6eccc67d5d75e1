#include "calib/register/feature_model.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace luxfit {
namespace {

// Points count as lying on a line where their second extent is below this part of the first.
constexpr double kLine = 1e-3;

bool SpansAPlane(const Eigen::Matrix3Xd& centred) {
  const Eigen::Matrix3d scatter = centred * centred.transpose();
  const Eigen::Vector3d squared =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  return squared.allFinite() && squared[2] > 0 && squared[1] > kLine * kLine * squared[2];
}

// Returns the image id of each view: the image with most points.
std::map<std::string, ColmapId> ImageOfView(const ColmapModel& model,
                                            const std::map<std::string, std::string>& view_of_image) {
  std::map<ColmapId, int> points;
  for (const auto& [id, point] : model.points) {
    for (const ColmapTrackElement& element : point.track) ++points[element.image];
  }
  std::map<std::string, ColmapId> image_of_view;
  for (const auto& [id, image] : model.images) {
    const auto view = view_of_image.find(image.name);
    if (view == view_of_image.end()) continue;
    const auto [at, is_new] = image_of_view.emplace(view->second, id);
    if (!is_new && points[id] > points[at->second]) at->second = id;
  }
  return image_of_view;
}

}  // namespace

Similarity Similarity::Inverse() const {
  Similarity inverse;
  inverse.scale = 1 / scale;
  inverse.rotation = rotation.transpose();
  inverse.translation = -(inverse.scale * (inverse.rotation * translation));
  return inverse;
}

std::optional<Similarity> FitSimilarity(const Eigen::Matrix3Xd& points_in_a,
                                        const Eigen::Matrix3Xd& points_in_b, std::optional<double> scale) {
  if (points_in_a.cols() != points_in_b.cols() || points_in_a.cols() < 3) return std::nullopt;
  const Eigen::Vector3d middle_a = points_in_a.rowwise().mean(), middle_b = points_in_b.rowwise().mean();
  const Eigen::Matrix3Xd a = points_in_a.colwise() - middle_a, b = points_in_b.colwise() - middle_b;
  if (!SpansAPlane(a) || !SpansAPlane(b)) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(b * a.transpose(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  sign[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  Similarity fit;
  fit.rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  fit.scale = scale.value_or(svd.singularValues().dot(sign) / a.squaredNorm());
  fit.translation = middle_b - fit.scale * (fit.rotation * middle_a);
  if (!(fit.scale > 0) || !std::isfinite(fit.scale)) return std::nullopt;
  return fit;
}

Eigen::Isometry3d PoseUnder(const Similarity& b_from_a, const Eigen::Isometry3d& cam_from_a) {
  Eigen::Isometry3d cam_from_b = Eigen::Isometry3d::Identity();
  cam_from_b.linear() = cam_from_a.linear() * b_from_a.rotation.transpose();
  cam_from_b.translation() =
      b_from_a.scale * cam_from_a.translation() - cam_from_b.linear() * b_from_a.translation;
  return cam_from_b;
}

FeatureModel FeaturesOf(const ColmapModel& model, const std::map<std::string, std::string>& view_of_image) {
  FeatureModel features;
  std::map<ColmapId, int> view_of_id;
  for (const auto& [view, id] : ImageOfView(model, view_of_image)) {
    view_of_id[id] = static_cast<int>(features.views.size());
    features.views.push_back({view, model.images.at(id).cam_from_model});
  }
  for (const auto& [id, point] : model.points) {
    FeatureTrack track;
    track.p_in_model = point.p_in_model;
    std::set<int> seen;
    for (const ColmapTrackElement& element : point.track) {
      const auto view = view_of_id.find(element.image);
      if (view == view_of_id.end() || !seen.insert(view->second).second) continue;
      track.seen.push_back(
          {view->second,
           model.images.at(element.image).keypoints_px[static_cast<std::size_t>(element.keypoint)]});
    }
    if (track.seen.size() >= 2) features.tracks.push_back(std::move(track));
  }
  return features;
}

FeatureModel Moved(const FeatureModel& features, const Similarity& b_from_model) {
  FeatureModel moved = features;
  for (FeatureView& view : moved.views) view.cam_from_model = PoseUnder(b_from_model, view.cam_from_model);
  for (FeatureTrack& track : moved.tracks) {
    if (track.surface) throw std::invalid_argument("Moved: a track lies on a surface already");
    track.p_in_model = b_from_model * track.p_in_model;
  }
  return moved;
}

}  // namespace luxfit
