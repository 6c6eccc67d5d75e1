// Photometric stereo's own synthetic pictures: a sphere and a smaller one that shades it, seen from far away,
// drawn by intersecting every pixel's ray in closed form. It shares nothing with inverse/.
//
//   value = strength * ((1 - gloss) * albedo * max(0, n.l) + gloss * max(0, r.z)^shininess) * lit + noise
//
// r: l mirrored at n (Phong's highlight, not the half-vector one); lit: no sphere in the way of the light.
// Frame: x right, y up, z towards the camera; the large sphere has radius 1 at the origin.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_STEREO_SCENE_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_STEREO_SCENE_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace luxfit::support {

struct StereoScene {
  int pixels_across = 64;
  double gloss = 0.15, shininess = 40;
  double exponent = 1;  // of max(0, n.l): surfaces that are not Lambert's
  bool has_second_sphere = true;
  double noise_sigma = 0.005;  // of the brightest
  std::vector<double> strength;
};

struct StereoPicture {
  Eigen::MatrixXd value;  // images x pixels of the large sphere
  Eigen::Matrix3Xd to_light, normal;
  Eigen::VectorXd albedo;
  std::vector<Eigen::Vector2i> places;  // (u, v) of the pixels
};

// Lights on a cone about the view and some nearer to it.
inline Eigen::Matrix3Xd LightsAround(int count, double cone_rad = 0.7) {
  Eigen::Matrix3Xd lights(3, count);
  for (int k = 0; k < count; ++k) {
    const double tilt = k % 3 == 2 ? 0.45 * cone_rad : cone_rad;
    const double turn = 2 * 3.14159265358979323846 * k / count;
    lights.col(k) << std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt);
  }
  return lights;
}

// Two tones in stripes.
inline double StripedAlbedo(const Eigen::Vector3d& point) {
  return std::sin(9 * point.x() + 4 * point.y()) > 0 ? 0.7 : 0.35;
}

inline bool HitsSphere(const Eigen::Vector3d& from, const Eigen::Vector3d& along,
                       const Eigen::Vector3d& center, double radius) {
  const Eigen::Vector3d d = from - center;
  const double b = d.dot(along);
  const double root = b * b - d.squaredNorm() + radius * radius;
  return root > 0 && -b + std::sqrt(root) > 1e-9;
}

inline StereoPicture RenderStereo(const StereoScene& scene, const Eigen::Matrix3Xd& to_light,
                                  std::mt19937_64& rng) {
  const Eigen::Vector3d second(-0.75, 0.8, 1.1);
  constexpr double kSecondRadius = 0.3;
  std::vector<Eigen::Vector3d> normals;
  StereoPicture picture;
  for (int v = 0; v < scene.pixels_across; ++v) {
    for (int u = 0; u < scene.pixels_across; ++u) {
      const double x = 2 * (u + 0.5) / scene.pixels_across - 1;
      const double y = 1 - 2 * (v + 0.5) / scene.pixels_across;
      if (x * x + y * y > 0.95 * 0.95) continue;
      const Eigen::Vector3d point(x, y, std::sqrt(1 - x * x - y * y));
      if (scene.has_second_sphere && HitsSphere(point, Eigen::Vector3d::UnitZ(), second, kSecondRadius))
        continue;
      normals.push_back(point);
      picture.places.emplace_back(u, v);
    }
  }
  picture.to_light = to_light;
  picture.normal.resize(3, static_cast<Eigen::Index>(normals.size()));
  picture.albedo.resize(picture.normal.cols());
  picture.value.resize(to_light.cols(), picture.normal.cols());
  std::normal_distribution<double> noise(0, scene.noise_sigma);
  for (Eigen::Index i = 0; i < picture.normal.cols(); ++i) {
    const Eigen::Vector3d n = normals[static_cast<size_t>(i)];
    picture.normal.col(i) = n;
    picture.albedo[i] = StripedAlbedo(n);
    for (Eigen::Index k = 0; k < to_light.cols(); ++k) {
      const Eigen::Vector3d l = to_light.col(k);
      const double strength = scene.strength.empty() ? 1 : scene.strength[static_cast<size_t>(k)];
      const double mu = n.dot(l);
      const bool lit = mu > 0 && !(scene.has_second_sphere && HitsSphere(n, l, second, kSecondRadius));
      const double mirrored = std::max(0.0, 2 * mu * n.z() - l.z());
      const double radiance =
          (1 - scene.gloss) * picture.albedo[i] * std::pow(std::max(mu, 0.0), scene.exponent) +
          scene.gloss * std::pow(mirrored, scene.shininess);
      picture.value(k, i) = std::max(0.0, (lit ? strength * radiance : 0) + noise(rng));
    }
  }
  picture.albedo *= 1 - scene.gloss;
  return picture;
}

// A mirror sphere at a pixel: bright where the mirrored view meets a lamp of some angular radius.
inline double MirrorValue(const Eigen::Vector2d& offset_in_radii, const Eigen::Vector3d& to_light,
                          double lamp_radius_rad) {
  if (offset_in_radii.squaredNorm() >= 1) return 3;
  const Eigen::Vector3d n(offset_in_radii.x(), -offset_in_radii.y(),
                          std::sqrt(1 - offset_in_radii.squaredNorm()));
  const Eigen::Vector3d seen = 2 * n.z() * n - Eigen::Vector3d::UnitZ();
  return seen.dot(to_light) > std::cos(lamp_radius_rad) ? 255 : 20;
}

// Degrees; NaN where a normal is not solved.
inline double MeanAngleDeg(const Eigen::Matrix3Xd& normals, const Eigen::Matrix3Xd& truth) {
  double sum = 0;
  for (Eigen::Index i = 0; i < truth.cols(); ++i)
    sum += std::acos(std::clamp(normals.col(i).dot(truth.col(i)), -1.0, 1.0));
  return sum / static_cast<double>(truth.cols()) * 180 / 3.14159265358979323846;
}

// Mean |ratio to the truth - its mean|, percent: albedo is known up to a factor.
inline double AlbedoErrorPercent(const Eigen::VectorXd& albedo, const Eigen::VectorXd& truth) {
  const Eigen::ArrayXd ratio = albedo.array() / truth.array();
  return 100 * (ratio / ratio.mean() - 1).abs().mean();
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_STEREO_SCENE_H_
