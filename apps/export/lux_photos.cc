#include "apps/export/lux_photos.h"

#include "apps/export/exr_channels.h"
#include "apps/export/false_colours.h"
#include "apps/text/file_stem.h"
#include "apps/version.h"
#include "inverse/observe/observe.h"

namespace luxfit {

PhotoView ViewOf(const FittedRoom& fitted, int camera, const PixelDirections& directions,
                 const Eigen::Isometry3d& cam_from_world) {
  const Camera& of = fitted.registered.cameras[static_cast<size_t>(camera)];
  const std::vector<PixelQuad> tags = TagQuads(fitted.session.tags.survey, of, cam_from_world);
  return {MapPixels(of, directions, cam_from_world, fitted.room, tags, DensePixels()),
          MapPixels(of, directions, cam_from_world, fitted.room, tags)};
}

std::vector<std::string> PhotoStems(const LinearizedPhotos& photos) {
  std::vector<std::string> names;
  for (const LinearizedPhoto& photo : photos.photos) names.push_back(photo.view + "_" + photo.state);
  return DistinctFileStems(names);
}

std::vector<std::string> WriteLuxMap(const LuxMap& lux, const std::string& path_stem,
                                     const std::string& what) {
  WriteExrChannels(
      path_stem + ".exr",
      {{"illuminance_lx", lux.illuminance_lx}, {"sigma_lx", lux.sigma_lx}, {"gap", lux.gap}},
      {{"luxfit", std::string("luxfit ") + kVersion},
       {"photo", what},
       {"illuminance", "of the surface that the pixel sees, lx; NaN where unknown"},
       {"sigma", "one standard deviation, lx"},
       {"gap_codes",
        "0 known; 1 no surface, its border or a tag; 2 saturated; 3 too dark; 4 reflectance unknown"}});
  WriteFalseColourPng(path_stem + ".png", lux.illuminance_lx, ScaleOf(lux.illuminance_lx, "lx"));
  return {path_stem + ".exr", path_stem + ".png"};
}

}  // namespace luxfit
