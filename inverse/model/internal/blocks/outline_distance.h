// Computes how far a ray to a luminaire's seen outline passes from the outline of its model, as an angle.
//
//   q = hit - p,   u = q.a,   v = q.b           hit: ray with the luminaire's plane; a, b: its axes
//   distance = f / |t m|,   m = g - n (g.r) / (n.r)
//
// f: signed distance in the plane from the outline, positive outside; g: its gradient there; t: length of the
// ray to the hit; n: aim; r: the ray. |t m| is the derivative of f by the angle of the ray (Sampson's
// distance), so foreshortening counts. A rectangle's sides are taken one by one, which is exact along each
// side. A sphere, and a plane that is seen edge-on or from behind the eye, is judged by the angle to its
// centre less the angle of its radius. A point has radius 0.
//
// Templated on the scalar: derivatives come from ceres::Jet. Units: m in, rad out.
// Source: Sampson (1982), "Fitting conic sections to very scattered data".
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_OUTLINE_DISTANCE_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_OUTLINE_DISTANCE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "forward/luminaire/luminaire.h"

namespace luxfit {

// Holds a luminaire's outline; aim, along and across need to be unit vectors to first order only.
template <typename T>
struct Outline {
  Eigen::Matrix<T, 3, 1> position, aim, along, across;
  Eigen::Matrix<T, 2, 1> half_size;
};

namespace outline_internal {

// Returns the angle from the sphere of that radius about the centre to the ray.
template <typename T>
T AngleFromSphere(const Eigen::Matrix<T, 3, 1>& to_centre, const T& radius,
                  const Eigen::Matrix<T, 3, 1>& ray) {
  using std::atan2, std::sqrt;
  const Eigen::Matrix<T, 3, 1> beside = to_centre.cross(ray);
  const T far = to_centre.dot(ray);
  // A tiny offset keeps the root's derivative finite where the ray meets the centre.
  const T tangent2 = to_centre.squaredNorm() - radius * radius;
  // Inside the sphere, it fills half the view.
  const T half_angle = tangent2 > T(0) ? T(atan2(radius, T(sqrt(tangent2)))) : T(M_PI / 2);
  return atan2(T(sqrt(beside.squaredNorm() + 1e-18)), far) - half_angle;
}

}  // namespace outline_internal

template <typename T>
T OutlineDistanceRad(LuminaireShape shape, const Outline<T>& outline, const Eigen::Vector3d& eye,
                     const Eigen::Matrix<T, 3, 1>& r) {
  using std::abs, std::sqrt;
  using Vector = Eigen::Matrix<T, 3, 1>;
  constexpr double kEdgeOn = 0.02;
  const Vector to_centre = outline.position - eye.cast<T>();
  const T cosine = r.dot(outline.aim), far = to_centre.dot(outline.aim);
  const bool is_flat = shape == LuminaireShape::kDisc || shape == LuminaireShape::kRectangle;
  if (!is_flat || abs(cosine) < kEdgeOn || !(far / cosine > T(0))) {
    const T radius = is_flat || shape == LuminaireShape::kSphere ? outline.half_size[0] : T(0);
    return outline_internal::AngleFromSphere(to_centre, radius, r);
  }
  const T t = far / cosine;
  const Vector q = t * r - to_centre;
  const T u = q.dot(outline.along), v = q.dot(outline.across);
  const auto angle = [&](const T& f, const Vector& gradient) {
    const Vector m = gradient - outline.aim * T(gradient.dot(r) / cosine);
    return T(f / (t * m.norm()));
  };
  if (shape == LuminaireShape::kDisc) {
    const T from_centre = sqrt(u * u + v * v + 1e-18);
    const Vector gradient = outline.along * T(u / from_centre) + outline.across * T(v / from_centre);
    return angle(from_centre - outline.half_size[0], gradient);
  }
  const T along = angle(abs(u) - outline.half_size[0], outline.along);
  const T across = angle(abs(v) - outline.half_size[1], outline.across);
  if (along > T(0) && across > T(0)) return sqrt(along * along + across * across);
  return along > across ? along : across;
}

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_OUTLINE_DISTANCE_H_
