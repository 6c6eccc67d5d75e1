// Converts rotation vectors (axis times angle, rad) to rotations and back.
//
//   R = exp([w]x),   [v]x w = v x w
#ifndef LUXFIT_CALIB_LENS_INTERNAL_ROTATION_VECTOR_H_
#define LUXFIT_CALIB_LENS_INTERNAL_ROTATION_VECTOR_H_

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace luxfit {

// Returns [v]x, the matrix of the cross product.
inline Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d cross;
  cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return cross;
}

inline Eigen::Matrix3d RotationBy(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (!(angle > 0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

inline Eigen::Vector3d RotationVectorOf(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

// Returns the pose of a rotation vector and a translation of three numbers each: OpenCV's and libmrcal's form.
inline Eigen::Isometry3d PoseOf(const double* rotation_vector, const double* translation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = RotationBy(Eigen::Map<const Eigen::Vector3d>(rotation_vector));
  pose.translation() = Eigen::Map<const Eigen::Vector3d>(translation);
  return pose;
}

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_ROTATION_VECTOR_H_
