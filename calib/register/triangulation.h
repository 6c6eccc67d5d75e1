// Triangulates points that several views see, from rays whose correspondence is unknown.
//
//   p = argmin sum_i |(1 - d_i d_i^T) (p - o_i)|^2 / (sigma_i |p - o_i|)^2
//
// o: centre of the camera, d: unit direction of the sight, sigma: of its angle. World frame, m. This is least
// squares of the reprojection, with angles for pixels.
//
// Every two sights of different views that nearly meet propose a point. The proposal gathers from every other
// view the sight nearest to it, if that lies within `max_sigmas`. The point with the most sights (then the
// smallest squares) is solved, and its sights belong to no other.
//
// Undefined where all rays are parallel: points whose sights differ by less than `min_parallax_rad` are not
// returned. Throws std::invalid_argument for a sigma that is not positive.
// Source: Fischler and Bolles (1981), "Random sample consensus", every pair in place of random ones; Hartley
// and Zisserman (2004), ch. 12.
#ifndef LUXFIT_CALIB_REGISTER_TRIANGULATION_H_
#define LUXFIT_CALIB_REGISTER_TRIANGULATION_H_

#include <Eigen/Core>
#include <vector>

namespace luxfit {

struct Sight {
  int view = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction{0, 0, 1};  // unit
  double sigma_rad = 1e-3;
};

struct TriangulatedPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // from the sights' sigmas
  std::vector<int> sights;                                  // one for each view, in the order of views
  double rms_sigmas = 0;                                    // rms of the angles, in sigmas
  double parallax_rad = 0;                                  // largest angle between two sights
};

struct TriangulationOptions {
  int min_views = 3;  // among many rays, two meet by chance
  double max_sigmas = 3;
  double min_parallax_rad = 0.1;  // 6 degrees: a pixel's error is ten times as large along the rays
};

// Returns the points, those with most sights first.
std::vector<TriangulatedPoint> TriangulateSights(const std::vector<Sight>& sights,
                                                 const TriangulationOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_TRIANGULATION_H_
