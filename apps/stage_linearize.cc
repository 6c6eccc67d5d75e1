#include <fmt/format.h>

#include <stdexcept>

#include "apps/stages.h"

namespace luxfit {

LuminanceImage ReadLuminance(const Session& session, const SessionPhoto& photo, const Camera& camera) {
  const Photo counts = ReadPhoto(photo.file);
  const SessionCamera& settings = session.cameras[static_cast<size_t>(photo.camera)];
  if (counts.bits_per_channel == 8 && settings.response == "linear") {
    throw std::runtime_error(
        fmt::format("{}: expected linear counts (camera \"{}\" has response = \"linear\"), got an 8-bit "
                    "photo: 8-bit files are "
                    "gamma-encoded (sRGB); give 16-bit PNG/TIFF or EXR developed linearly from RAW",
                    photo.file, settings.id));
  }
  if (counts.width_px() != camera.width_px || counts.height_px() != camera.height_px) {
    throw std::runtime_error(
        fmt::format("{}: expected {} x {} pixels as in {}, got {} x {}; give the intrinsics of this "
                    "resolution",
                    photo.file, camera.width_px, camera.height_px, settings.intrinsics, counts.width_px(),
                    counts.height_px()));
  }
  LuminanceOptions options;
  options.weights = settings.luminance_weights;
  options.black_level_counts = settings.black_level_counts;
  return ToRelativeLuminance(counts, photo.exposure_s, options);
}

}  // namespace luxfit
