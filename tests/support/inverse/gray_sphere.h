// The classical photometric stereo set of a grey and a chrome sphere under twelve lights (uncompressed TGA),
// where its folder is at hand: gray/gray.K.tga, chrome/chrome.K.tga, their masks, lights.txt.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_GRAY_SPHERE_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_GRAY_SPHERE_H_

#include <Eigen/Core>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "calib/luminance/luminance.h"
#include "calib/photo_files/image.h"
#include "inverse/albedo/photometric_stereo.h"

namespace luxfit::support {

// Mean of the channels of an uncompressed 24 bit TGA, top row first.
inline ImagePlane ReadTga(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(file)), {});
  if (bytes.size() < 18 || bytes[2] != 2 || bytes[16] != 24)
    throw std::runtime_error(path + ": no 24 bit TGA");
  const int width = bytes[12] + 256 * bytes[13], height = bytes[14] + 256 * bytes[15];
  const bool top_first = (bytes[17] & 0x20) != 0;
  const size_t start = 18u + bytes[0];
  if (bytes.size() < start + 3u * static_cast<size_t>(width) * static_cast<size_t>(height))
    throw std::runtime_error(path + ": too short");
  ImagePlane plane(height, width);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int row = top_first ? v : height - 1 - v;
      const size_t at =
          start + 3u * (static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(u));
      plane(v, u) = static_cast<float>(bytes[at] + bytes[at + 1] + bytes[at + 2]) / 3;
    }
  }
  return plane;
}

struct GraySphere {
  std::vector<ImagePlane> gray, chrome;
  PixelMask gray_mask, chrome_mask;
  Eigen::Matrix3Xd given_lights;
};

inline GraySphere ReadGraySphere(const std::string& folder) {
  GraySphere set;
  std::ifstream lights(folder + "/lights.txt");
  int count = 0;
  lights >> count;
  set.given_lights.resize(3, count);
  for (int k = 0; k < count; ++k) {
    for (int axis = 0; axis < 3; ++axis) lights >> set.given_lights(axis, k);
    set.given_lights.col(k).normalize();
    set.gray.push_back(ReadTga(folder + "/gray/gray." + std::to_string(k) + ".tga"));
    set.chrome.push_back(ReadTga(folder + "/chrome/chrome." + std::to_string(k) + ".tga"));
  }
  if (!lights) throw std::runtime_error(folder + "/lights.txt: expected a count and as many directions");
  set.gray_mask = ReadTga(folder + "/gray/gray.mask.tga") > 127;
  set.chrome_mask = ReadTga(folder + "/chrome/chrome.mask.tga") > 127;
  return set;
}

// Pixels of the grey sphere within `share` of its radius, with the sphere's own normals: the truth.
struct GrayPixels {
  Eigen::MatrixXd value;
  Eigen::Matrix3Xd normal;
};
inline GrayPixels PixelsOf(const GraySphere& set, double share = 0.955) {
  const SphereCircle circle = CircleOfMask(set.gray_mask);
  std::vector<Eigen::Vector3d> normals;
  std::vector<Eigen::Vector2i> places;
  for (int v = 0; v < set.gray_mask.rows(); ++v) {
    for (int u = 0; u < set.gray_mask.cols(); ++u) {
      const auto normal = SphereNormal(circle, {u, v});
      if (!set.gray_mask(v, u) || !normal || normal->head<2>().norm() >= share) continue;
      normals.push_back(*normal);
      places.emplace_back(u, v);
    }
  }
  GrayPixels pixels{
      Eigen::MatrixXd(static_cast<Eigen::Index>(set.gray.size()), static_cast<Eigen::Index>(places.size())),
      Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(places.size()))};
  for (size_t i = 0; i < places.size(); ++i) {
    const Eigen::Index column = static_cast<Eigen::Index>(i);
    pixels.normal.col(column) = normals[i];
    for (size_t k = 0; k < set.gray.size(); ++k)
      pixels.value(static_cast<Eigen::Index>(k), column) = set.gray[k](places[i].y(), places[i].x());
  }
  return pixels;
}

// Directions from the chrome sphere's highlights, with their sigma.
inline StereoData WithMirrorSphereLights(const GraySphere& set, const GrayPixels& pixels) {
  const SphereCircle circle = CircleOfMask(set.chrome_mask);
  const Eigen::Index images = pixels.value.rows();
  StereoData data{pixels.value, Eigen::Matrix3Xd(3, images), Eigen::VectorXd(images), {}};
  for (Eigen::Index k = 0; k < images; ++k) {
    const MirrorDirection light = LightOnMirrorSphere(set.chrome[static_cast<size_t>(k)], circle);
    if (!light.IsUsable()) throw std::runtime_error("chrome sphere: " + light.message);
    data.to_light.col(k) = light.to_light;
    data.direction_sigma_rad[k] = light.sigma_rad;
  }
  return data;
}

// Standard deviation over the mean.
inline double VariationPercent(const Eigen::VectorXd& albedo) {
  const double mean = albedo.mean();
  return 100 * std::sqrt((albedo.array() - mean).square().mean()) / mean;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_GRAY_SPHERE_H_
