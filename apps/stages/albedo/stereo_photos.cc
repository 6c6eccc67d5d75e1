#include "apps/stages/albedo/stereo_photos.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/stages/linearize/linearize.h"
#include "inverse/albedo/photometric_stereo.h"

namespace luxfit {
namespace {

constexpr double kRadPerDeg = M_PI / 180;

PixelMask ReadMask(const std::string& path, const LuminanceImage& like, const std::string& photo) {
  const Photo picture = ReadPhoto(path);
  const auto& size = like.relative_luminance;
  if (picture.height_px() != size.rows() || picture.width_px() != size.cols()) {
    throw std::runtime_error(
        fmt::format("{}: expected {} x {} pixels as in {}, got {} x {}; draw the mask on a photo", path,
                    size.cols(), size.rows(), photo, picture.width_px(), picture.height_px()));
  }
  const double half = 0.5 * picture.full_scale_counts;
  PixelMask mask(size.rows(), size.cols());
  for (Eigen::Index i = 0; i < mask.size(); ++i) {
    double brightest = 0;
    for (const ImagePlane& plane : picture.rgb_counts)
      brightest = std::max<double>(brightest, plane.data()[i]);
    mask.data()[i] = brightest > half;
  }
  return mask;
}

const LinearizedPhoto* PhotoOf(const LinearizedPhotos& linearized, const std::string& view,
                               const std::string& state) {
  const auto& photos = linearized.photos;
  const auto photo = std::find_if(photos.begin(), photos.end(), [&](const LinearizedPhoto& p) {
    return p.view == view && p.state == state;
  });
  return photo == photos.end() ? nullptr : &*photo;
}

// Without a lens, the camera has the photo's own size.
LuminanceImage ReadImage(const LinearizedPhotos& linearized, const LinearizedPhoto& photo) {
  const Photo first = ReadPhoto(photo.file);
  Camera camera;
  camera.width_px = first.width_px();
  camera.height_px = first.height_px();
  return ReadLuminance(linearized, photo, camera);
}

LuminanceImage ReadLight(const SessionLights& lights, const LinearizedPhotos& linearized,
                         const std::string& state) {
  LuminanceImage image = ReadImage(linearized, *PhotoOf(linearized, lights.view, state));
  const LinearizedPhoto* const ambient =
      lights.ambient_state.empty() ? nullptr : PhotoOf(linearized, lights.view, lights.ambient_state);
  if (ambient == nullptr) return image;
  // Dark pixels are valid too; only saturated ones are not.
  const PixelMask saturated = image.saturated;
  image = WithoutAmbient(std::move(image), ReadImage(linearized, *ambient));
  image.saturated = saturated;
  return image;
}

void FillDirections(const SessionLights& lights, const LinearizedPhotos& linearized,
                    const StereoPhotos& photos, StereoData& data) {
  const Eigen::Index images = static_cast<Eigen::Index>(photos.states.size());
  data.to_light.resize(3, images);
  data.strength.setOnes(images);
  data.direction_sigma_rad = Eigen::VectorXd::Constant(images, lights.direction_sigma_deg * kRadPerDeg);
  SphereCircle circle;
  for (Eigen::Index k = 0; k < images; ++k) {
    const std::string& state = photos.states[static_cast<size_t>(k)];
    if (!lights.directions_path.empty()) {
      data.to_light.col(k) = lights.light_of_state.at(state).to_light;
      data.strength[k] = lights.light_of_state.at(state).strength;
      continue;
    }
    // Saturated pixels are the highlight.
    const LinearizedPhoto& photo = *PhotoOf(linearized, lights.mirror_view, state);
    const LuminanceImage image = ReadImage(linearized, photo);
    if (k == 0) circle = CircleOfMask(ReadMask(lights.mirror_mask, image, photo.file));
    if (!circle.IsUsable()) {
      throw std::runtime_error(
          fmt::format("{}: expected one whole circle, got something else: {}; mask the mirror "
                      "sphere alone",
                      lights.mirror_mask, circle.message));
    }
    const MirrorDirection direction = LightOnMirrorSphere(image.relative_luminance, circle);
    if (!direction.IsUsable()) {
      throw std::runtime_error(
          fmt::format("{}: expected the light's highlight on the mirror sphere, got none: {}; "
                      "take the photo again, or give directions",
                      photo.file, direction.message));
    }
    data.to_light.col(k) = direction.to_light;
    data.direction_sigma_rad[k] = direction.sigma_rad;
  }
}

// Returns the pixels of the object and of the reference.
void FillPlaces(const SessionLights& lights, const LuminanceImage& image, const std::string& file,
                StereoPhotos& photos) {
  const PixelMask object = ReadMask(lights.mask, image, file);
  const PixelMask reference = lights.reference_mask.empty()
                                  ? PixelMask(PixelMask::Constant(object.rows(), object.cols(), false))
                                  : ReadMask(lights.reference_mask, image, file);
  photos.width_px = static_cast<int>(object.cols());
  photos.height_px = static_cast<int>(object.rows());
  for (int v = 0; v < photos.height_px; ++v) {
    for (int u = 0; u < photos.width_px; ++u) {
      if (!object(v, u) && !reference(v, u)) continue;
      photos.places.emplace_back(u, v);
      photos.regions.is_object.push_back(object(v, u));
      photos.regions.is_reference.push_back(reference(v, u));
    }
  }
}

void FillPixels(const SessionLights& lights, const LinearizedPhotos& linearized, StereoPhotos& photos) {
  for (size_t k = 0; k < photos.states.size(); ++k) {
    const LuminanceImage image = ReadLight(lights, linearized, photos.states[k]);
    const std::string& file = PhotoOf(linearized, lights.view, photos.states[k])->file;
    if (k == 0) {
      FillPlaces(lights, image, file, photos);
      photos.data.value.resize(static_cast<Eigen::Index>(photos.states.size()),
                               static_cast<Eigen::Index>(photos.places.size()));
    }
    if (image.valid.cols() != photos.width_px || image.valid.rows() != photos.height_px)
      throw std::runtime_error(
          fmt::format("{}: expected {} x {} pixels as in the view's other photos, got {} x {}", file,
                      photos.width_px, photos.height_px, image.valid.cols(), image.valid.rows()));
    for (size_t i = 0; i < photos.places.size(); ++i) {
      const Eigen::Index u = photos.places[i].x(), v = photos.places[i].y();
      photos.data.value(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
          image.saturated(v, u) ? NAN : image.relative_luminance(v, u);
    }
  }
}

}  // namespace

StereoPhotos ReadStereoPhotos(const Session& session, const LinearizedPhotos& linearized) {
  const SessionLights& lights = *session.lights;
  StereoPhotos photos;
  photos.regions.reference_albedo = session.lights->reference_albedo;
  for (const SessionState& state : session.states) {
    if (state.id != lights.ambient_state && PhotoOf(linearized, lights.view, state.id) != nullptr)
      photos.states.push_back(state.id);
  }
  if (photos.states.size() < 3) {
    throw std::runtime_error(
        fmt::format("{}:{}: lights: expected three lights or more, got {}; photograph the object "
                    "under more lights",
                    session.path, lights.line, photos.states.size()));
  }
  FillPixels(lights, linearized, photos);
  FillDirections(lights, linearized, photos, photos.data);
  return photos;
}

}  // namespace luxfit
