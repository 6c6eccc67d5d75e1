// Finds the nearest point on a set of triangles, by Eigen's tree of boxes.
//
// Source: Ericson (2005), "Real-time collision detection", 5.1.5 (point and triangle).
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_TRIANGLE_TREE_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_TRIANGLE_TREE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

namespace luxfit {

struct NearestPoint {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  int triangle = -1;
  double squared_distance = 0;
};

class TriangleTree {
 public:
  // A column of `triangles` has the indices of three columns of `vertices`. At least one triangle is needed.
  TriangleTree(const Eigen::Matrix3Xd& vertices, const Eigen::Matrix3Xi& triangles);
  NearestPoint Nearest(const Eigen::Vector3d& p) const;
  Eigen::Vector3d Normal(int triangle) const;  // unit; zero for a triangle without area

 private:
  Eigen::Vector3d Corner(int triangle, int corner) const {
    return vertices_.col(triangles_(corner, triangle));
  }
  Eigen::Vector3d NearestOn(int triangle, const Eigen::Vector3d& p) const;

  Eigen::Matrix3Xd vertices_;
  Eigen::Matrix3Xi triangles_;
  Eigen::KdBVH<double, 3, int> tree_;  // of the triangles' indices
};

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_TRIANGLE_TREE_H_
