// A room of tags and feature points seen by many views: pictures by OpenCV's projectPoints, not by ours.
//
// Walls of 6 m x 4 m x 2.8 m; cameras stand inside and look across. What a view sees: tags that face it and
// lie wholly in the picture, points in front of it and in the picture.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_FEATURE_ROOM_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_FEATURE_ROOM_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>
#include <string>
#include <vector>

#include "calib/register/feature_model.h"
#include "calib/register/registration.h"
#include "calib/targets/tags.h"
#include "tests/support/calib/look_at.h"
#include "tests/support/calib/office_camera.h"

namespace luxfit::support {

inline constexpr double kRoomSize[3] = {6, 4, 2.8};

struct FeatureRoom {
  Camera camera;
  std::vector<SurveyedTag> tags;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Isometry3d> poses;  // cam_from_world
};

inline Eigen::Vector2d ProjectByOpenCv(const Camera& camera, const Eigen::Isometry3d& cam_from_world,
                                       const Eigen::Vector3d& p) {
  const Eigen::AngleAxisd turn(cam_from_world.linear());
  const Eigen::Vector3d r = turn.angle() * turn.axis(), t = cam_from_world.translation();
  const cv::Matx33d matrix(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(r.x(), r.y(), r.z()),
                    cv::Vec3d(t.x(), t.y(), t.z()), matrix, distortion, pixels);
  return {pixels[0].x, pixels[0].y};
}

// A place on one of the four walls (0..3) and the wall's normal into the room.
struct WallPlace {
  Eigen::Vector3d p, normal;
};
inline WallPlace OnWall(int wall, double along, double height) {
  const int axis = wall / 2, other = 1 - axis;
  WallPlace place{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  place.p[axis] = wall % 2 == 0 ? 0 : kRoomSize[axis];
  place.p[other] = along * kRoomSize[other];
  place.p[2] = height * kRoomSize[2];
  place.normal[axis] = wall % 2 == 0 ? 1 : -1;
  return place;
}

inline FeatureRoom MakeFeatureRoom(int views, int tags, int points, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> uniform(0, 1);
  FeatureRoom room;
  room.camera = OfficeCamera({-0.112, 0.061, 4e-4, -7e-4, 0, 0, 0, 0});
  for (int i = 0; i < tags; ++i) {
    const WallPlace place = OnWall(i % 4, 0.15 + 0.7 * uniform(rng), 0.3 + 0.5 * uniform(rng));
    room.tags.push_back({i, 0.2, place.p, place.normal, Eigen::Vector3d::UnitZ()});
  }
  for (int i = 0; i < points; ++i) room.points.push_back(OnWall(i % 4, uniform(rng), uniform(rng)).p);
  for (int i = 0; i < views; ++i) {
    const double turn = 2 * M_PI * (i + 0.3 * uniform(rng)) / views;
    const Eigen::Vector3d middle(3, 2, 1.4), out(std::cos(turn), std::sin(turn), 0);
    const Eigen::Vector3d from =
        middle + Eigen::Vector3d(2.4 * out.x(), 1.5 * out.y(), 0.5 * (uniform(rng) - 0.5));
    room.poses.push_back(
        LookAt(from, middle - 1.5 * out + Eigen::Vector3d(0, 0, 0.6 * (uniform(rng) - 0.5))));
  }
  return room;
}

inline bool IsInPicture(const Camera& camera, const Eigen::Vector2d& pixel) {
  return pixel.allFinite() && pixel.minCoeff() > 0 && pixel.x() < camera.width_px - 1 &&
         pixel.y() < camera.height_px - 1;
}

inline std::string ViewName(std::size_t view) { return "v" + std::to_string(view); }

// Tags that really hang as `truth` says.
inline ViewDetections DetectTagsOf(const FeatureRoom& room, const std::vector<SurveyedTag>& truth,
                                   std::size_t view, double noise_px, std::mt19937_64& rng) {
  std::normal_distribution<double> normal(0, 1);
  const Eigen::Isometry3d& pose = room.poses[view];
  ViewDetections seen;
  seen.view = ViewName(view);
  for (const SurveyedTag& tag : truth) {
    const Eigen::Vector3d from = pose.inverse().translation() - tag.center_in_world;
    bool visible = from.normalized().dot(tag.normal_in_world) > 0.2;
    TagDetection detection;
    detection.id = tag.id;
    detection.side_px = room.camera.fx_px * tag.size_m / from.norm();
    detection.corner_sigma_px = std::max(noise_px, 0.03);
    for (std::size_t i = 0; i < 4 && visible; ++i) {
      const Eigen::Vector3d corner = TagCornersInWorld(tag)[i];
      const Eigen::Vector2d pixel = ProjectByOpenCv(room.camera, pose, corner);
      visible = (pose * corner).z() > 0.2 && IsInPicture(room.camera, pixel);
      detection.corners_px[i] = pixel + noise_px * Eigen::Vector2d(normal(rng), normal(rng));
    }
    if (visible) seen.tags.push_back(detection);
  }
  return seen;
}

struct FeatureNoise {
  double pixel_px = 0;
  double outliers = 0;  // part of the observations that are anywhere within 100 px
  double point_m = 0;   // of the reconstruction's points and centres, before the similarity
};

// What a structure from motion program would hand over: everything under an arbitrary similarity.
inline FeatureModel FeaturesOfRoom(const FeatureRoom& room, const FeatureNoise& noise,
                                   const Similarity& model_from_world, std::mt19937_64& rng) {
  std::normal_distribution<double> normal(0, 1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto shift = [&](double sigma) -> Eigen::Vector3d {
    return sigma * Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
  };
  FeatureModel features;
  for (std::size_t v = 0; v < room.poses.size(); ++v) {
    Eigen::Isometry3d pose = room.poses[v];
    pose.translation() += shift(noise.point_m);
    features.views.push_back({ViewName(v), PoseUnder(model_from_world, pose)});
  }
  for (const Eigen::Vector3d& point : room.points) {
    FeatureTrack track;
    track.p_in_model = model_from_world * (point + shift(noise.point_m));
    for (std::size_t v = 0; v < room.poses.size(); ++v) {
      if ((room.poses[v] * point).z() < 0.2) continue;
      const Eigen::Vector2d pixel = ProjectByOpenCv(room.camera, room.poses[v], point);
      if (!IsInPicture(room.camera, pixel)) continue;
      const double error_px = uniform(rng) < noise.outliers ? 100 * uniform(rng) : noise.pixel_px;
      track.seen.push_back(
          {static_cast<int>(v), pixel + error_px * Eigen::Vector2d(normal(rng), normal(rng))});
    }
    if (track.seen.size() >= 2) features.tracks.push_back(track);
  }
  return features;
}

inline Similarity AnySimilarity() {
  Similarity similarity;
  similarity.scale = 3.7;
  similarity.rotation =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
  similarity.translation = {4, -7, 2};
  return similarity;
}

// (rotation vector in world axes, camera centre), estimate against truth.
inline Eigen::Matrix<double, 6, 1> PoseError(const RegisteredView& view, const Eigen::Isometry3d& truth) {
  const Eigen::Isometry3d estimated = view.cam_from_world.inverse(), true_pose = truth.inverse();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(estimated.linear() * true_pose.linear().transpose()));
  Eigen::Matrix<double, 6, 1> error;
  error << turn.angle() * turn.axis(), estimated.translation() - true_pose.translation();
  return error;
}

inline double NormalisedError(const RegisteredView& view, const Eigen::Isometry3d& truth) {
  const Eigen::Matrix<double, 6, 1> error = PoseError(view, truth);
  return error.dot(view.covariance.ldlt().solve(error));
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_FEATURE_ROOM_H_
