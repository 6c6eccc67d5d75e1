// Similarities: what maps a reconstruction's own frame and scale onto the world.
//
//   p_in_b = scale * rotation * p_in_a + translation
//
// Source: Umeyama (1991), "Least-squares estimation of transformation parameters between two point patterns".
#ifndef LUXFIT_CALIB_REGISTER_SIMILARITY_H_
#define LUXFIT_CALIB_REGISTER_SIMILARITY_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

namespace luxfit {

struct Similarity {
  double scale = 1;  // > 0
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return scale * (rotation * p) + translation; }
  Similarity Inverse() const;
};

// The similarity with the least sum of |b_from_a * a_i - b_i|^2. Nothing where the points (3 x n) do not
// determine it: fewer than three, or all near one line. With `scale` given, the best of that scale.
std::optional<Similarity> FitSimilarity(const Eigen::Matrix3Xd& points_in_a,
                                        const Eigen::Matrix3Xd& points_in_b,
                                        std::optional<double> scale = std::nullopt);

// The pose of a camera in b that takes the same picture as `cam_from_a` in a: its camera frame is in b's
// unit.
Eigen::Isometry3d PoseUnder(const Similarity& b_from_a, const Eigen::Isometry3d& cam_from_a);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_SIMILARITY_H_
