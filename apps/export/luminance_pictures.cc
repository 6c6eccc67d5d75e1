#include "apps/export/luminance_pictures.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/export/exr_channels.h"
#include "apps/export/lux_photos.h"
#include "apps/stages/linearize/photo_store.h"
#include "apps/text/file_stem.h"
#include "apps/version.h"
#include "calib/photo_files/radiance_picture.h"
#include "forward/room/one_line.h"

namespace luxfit {
namespace {

constexpr double kDegreesPerRadian = 180 / M_PI;

std::string VectorText(const Eigen::Vector3d& v) {
  return fmt::format("{:.9g} {:.9g} {:.9g}", v.x(), v.y(), v.z());
}

// Returns colours whose brightness is `per_unit` times the photo's relative luminance.
std::array<ImagePlane, 3> PictureColours(const LuminanceImage& image, double per_unit) {
  std::array<ImagePlane, 3> rgb;
  for (size_t c = 0; c < 3; ++c) rgb[c] = image.relative_rgb[c].max(0.0f);
  const ImagePlane brightness = RadianceBrightness(rgb);
  const ImagePlane wanted = static_cast<float>(per_unit) * image.relative_luminance.max(0.0f);
  // A pixel without colour, such as one in the dark, is grey.
  for (ImagePlane& plane : rgb) plane = (brightness > 0.0f).select(plane * wanted / brightness, wanted);
  return rgb;
}

const RegisteredView* ViewOfPhoto(const LinearizedPhoto& photo, const Registration& registration) {
  const auto view = std::find_if(registration.views.begin(), registration.views.end(),
                                 [&](const RegisteredView& v) { return v.view == photo.view; });
  return view == registration.views.end() ? nullptr : &*view;
}

std::shared_ptr<const LuminanceImage> ReadPicture(const LinearizedPhotos& photos,
                                                  const LinearizedPhoto& photo, const Camera& camera,
                                                  const LuminancePictureOptions& options) {
  const auto decode = [&] { return ReadCorrected(photos, photo, camera, options.corrections); };
  return options.decoded ? options.decoded->Get(photo.file, decode)
                         : std::make_shared<const LuminanceImage>(decode());
}

// Says in words what the values are.
std::string UnitLine(const LuminancePicture& written) {
  return written.is_absolute ? "LUMINANCE= 179*(0.265*R+0.670*G+0.065*B) cd/m2"
                             : "LUMINANCE= RELATIVE, not cd/m2: the camera's scale is unknown; "
                               "0.265*R+0.670*G+0.065*B is the share "
                               "of full scale per second of exposure";
}

std::vector<std::string> HeaderOf(const LuminancePicture& written, const LinearizedPhoto& photo,
                                  const std::optional<Eigen::Isometry3d>& cam_from_world,
                                  const std::string& command_line) {
  std::vector<std::string> lines{
      OneLine(command_line),
      fmt::format("SOFTWARE= luxfit {}", kVersion),
      RadianceView(written.picture, cam_from_world),
      "PRIMARIES= 0.6400 0.3300 0.2900 0.6000 0.1500 0.0600 0.3333 0.3333",
      "EXPOSURE= 1",
      UnitLine(written),
      fmt::format("PHOTO= {}, view {}, state {}, camera {}", OneLine(FileName(photo.file)),
                  OneLine(written.view), OneLine(written.state), OneLine(written.camera)),
      fmt::format("SATURATED= {:.6f} of the photo's pixels; their luminance is at least the one written",
                  written.saturated_share)};
  if (!written.has_pose) lines.emplace_back("POSE= unknown: VIEW has no place and no direction");
  return lines;
}

void WriteExrPicture(const LuminancePicture& written, const std::array<ImagePlane, 3>& rgb,
                     const std::vector<std::string>& header) {
  const float per_brightness = written.is_absolute ? static_cast<float>(kRadianceEfficacy) : 1.0f;
  WriteExrChannels(
      written.stem + ".exr", {{"Y", per_brightness * RadianceBrightness(rgb)}},
      {{"luxfit", std::string("luxfit ") + kVersion},
       {"Y", written.is_absolute ? "luminance, cd/m2; NaN where the photo shows nothing"
                                 : "relative luminance, not cd/m2: the camera's scale is unknown"},
       {"radiance_header", fmt::format("{}", fmt::join(header, "\n"))}});
}

}  // namespace

std::string RadianceView(const PictureView& picture, const std::optional<Eigen::Isometry3d>& cam_from_world) {
  std::string line = picture.projection == PictureProjection::kPerspective ? "VIEW= -vtv" : "VIEW= -vta";
  if (cam_from_world) {
    const Eigen::Isometry3d world_from_cam = cam_from_world->inverse();
    line +=
        fmt::format(" -vp {} -vd {} -vu {}", VectorText(world_from_cam.translation()),
                    VectorText(world_from_cam.linear().col(2)), VectorText(-world_from_cam.linear().col(1)));
  }
  return line + fmt::format(" -vh {:.9g} -vv {:.9g}",
                            kDegreesPerRadian * AngleAcross(picture, picture.width_px),
                            kDegreesPerRadian * AngleAcross(picture, picture.height_px));
}

std::vector<LuminancePicture> WriteLuminancePictures(const LinearizedPhotos& photos,
                                                     const RegisteredSession& registered,
                                                     const LuminancePictureOptions& options) {
  std::vector<PictureView> views;
  std::vector<PhotoPlaces> places;
  for (const Camera& camera : registered.cameras) {
    views.push_back(PictureViewOf(camera));
    places.push_back(PlacesInPhoto(views.back(), camera));
  }
  const std::vector<std::string> stems = PhotoStems(photos);
  std::vector<LuminancePicture> pictures(photos.photos.size());
  tbb::parallel_for(size_t{0}, pictures.size(), [&](size_t i) {
    const LinearizedPhoto& photo = photos.photos[i];
    const auto c = static_cast<size_t>(photo.camera);
    const std::optional<double>& cdm2_per_unit = options.cdm2_per_unit.at(c);
    const RegisteredView* const view = ViewOfPhoto(photo, registered.registration);
    std::optional<Eigen::Isometry3d> cam_from_world;
    if (view) cam_from_world = view->cam_from_world;
    const std::shared_ptr<const LuminanceImage> kept =
        ReadPicture(photos, photo, registered.cameras[c], options);
    const LuminanceImage& image = *kept;
    const double per_unit = cdm2_per_unit ? *cdm2_per_unit / kRadianceEfficacy : 1;
    std::array<ImagePlane, 3> rgb = PictureColours(image, per_unit);
    for (ImagePlane& plane : rgb) plane = Resampled(plane, places[c], views[c]);
    pictures[i] = {
        options.folder + "/" + stems[i],
        photo.view,
        photo.state,
        photos.cameras[c].given.id,
        views[c],
        cdm2_per_unit.has_value(),
        view != nullptr,
        static_cast<double>(image.saturated.count()) / static_cast<double>(image.saturated.size())};
    const std::vector<std::string> header =
        HeaderOf(pictures[i], photo, cam_from_world, options.command_line);
    WriteRadiancePicture(pictures[i].stem + ".hdr", rgb, header);
    WriteExrPicture(pictures[i], rgb, header);
  });
  return pictures;
}

}  // namespace luxfit
