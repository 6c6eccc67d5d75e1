// Returns [v]x, the matrix of the cross product: [v]x w = v x w.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_CROSS_MATRIX_H_
#define LUXFIT_CALIB_LENS_INTERNAL_CROSS_MATRIX_H_

#include <Eigen/Core>

namespace luxfit {

inline Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d cross;
  cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return cross;
}

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_CROSS_MATRIX_H_
