#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/stages/linearize/linearize.h"
#include "apps/stages/linearize/photo_store.h"
#include "apps/stages/stages.h"
#include "calib/luminance/bracket.h"

namespace luxfit {
namespace {

Photo ReadCounts(const SessionCamera& settings, const std::string& file) {
  Photo counts = ReadPhoto(file);
  if (counts.bits_per_channel == 8 && settings.response == "linear") {
    throw std::runtime_error(fmt::format(
        "{}: expected linear counts (camera \"{}\" has response = \"linear\"), got an 8-bit "
        "photo: 8-bit files are "
        "gamma-encoded (sRGB); give 16-bit PNG/TIFF or EXR developed linearly from RAW, or response = "
        "\"estimate\" with brackets of three exposures or more",
        file, settings.id));
  }
  if (counts.is_black_subtracted && settings.black_level_counts > 0) {
    throw std::runtime_error(
        fmt::format("{}: expected black_level = 0 for RAW, which states its own, got {:g} (camera \"{}\"); "
                    "remove the key",
                    file, settings.black_level_counts, settings.id));
  }
  if (settings.response_curve && counts.full_scale_counts != settings.full_scale_counts) {
    throw std::runtime_error(
        fmt::format("{}: expected the bit depth of the camera's other photos, for which its response holds, "
                    "got full scale {:g} "
                    "against {:g}; convert them alike",
                    file, counts.full_scale_counts, settings.full_scale_counts));
  }
  return counts;
}

LuminanceOptions OptionsOf(const SessionCamera& settings) {
  LuminanceOptions options;
  options.weights = settings.luminance_weights;
  options.black_level_counts = settings.black_level_counts;
  options.response = settings.response_curve;
  return options;
}

void ExpectSize(const Photo& counts, const std::string& file, const SessionCamera& settings,
                const Camera& camera) {
  if (counts.width_px() == camera.width_px && counts.height_px() == camera.height_px) return;
  throw std::runtime_error(fmt::format(
      "{}: expected {} x {} pixels as in {}, got {} x {}; give the intrinsics of this "
      "resolution",
      file, camera.width_px, camera.height_px, settings.intrinsics, counts.width_px(), counts.height_px()));
}

size_t FilesOf(const Session& session) {
  size_t files = 0;
  for (const SessionPhoto& photo : session.photos) files += photo.bracket.size();
  return files;
}

}  // namespace

LuminanceImage ReadExposure(const Session& session, size_t camera, const SessionExposure& exposure) {
  const SessionCamera& settings = session.cameras[camera];
  return ToRelativeLuminance(ReadCounts(settings, exposure.file), exposure.relative_exposure_s,
                             OptionsOf(settings));
}

LuminanceImage ReadLuminance(const Session& session, const SessionPhoto& photo, const Camera& camera) {
  const SessionCamera& settings = session.cameras[static_cast<size_t>(photo.camera)];
  LuminanceImage image;
  if (photo.bracket.size() > 1) {
    BracketMerger merger(OptionsOf(settings));
    for (const SessionExposure& exposure : photo.bracket) {
      const Photo counts = ReadCounts(settings, exposure.file);
      ExpectSize(counts, exposure.file, settings, camera);
      merger.Add(counts, exposure.relative_exposure_s);
    }
    image = merger.Merged();
  } else {
    const Photo counts = ReadCounts(settings, photo.file);
    ExpectSize(counts, photo.file, settings, camera);
    image = ToRelativeLuminance(counts, photo.bracket.at(0).relative_exposure_s, OptionsOf(settings));
  }
  if (settings.vignetting_model) image = WithoutVignetting(std::move(image), *settings.vignetting_model);
  return image;
}

std::shared_ptr<const LuminanceImage> ReadKept(const Session& session, const SessionPhoto& photo,
                                               const Camera& camera, const RunContext& context) {
  const auto decode = [&] { return ReadLuminance(session, photo, camera); };
  return context.photos ? context.photos->Get(photo.file, decode)
                        : std::make_shared<const LuminanceImage>(decode());
}

LuminanceImage ReadCorrected(const Session& session, const SessionPhoto& photo, const Camera& camera,
                             const PhotoCorrections& corrections) {
  return WithCorrection(ReadLuminance(session, photo, camera), corrections.Of(session, photo),
                        photo.bracket.front().relative_exposure_s);
}

Session LinearizePhotos(Session session, RunContext& context) {
  const size_t warnings_before = context.warnings.size();
  nlohmann::json artifact = ProvenanceJson("luxfit-linearize-1", context.provenance);
  session = WithBrackets(WithMetadata(std::move(session), context), context);
  const StageTimer timer(
      context, "linearize",
      fmt::format("{} photos of {} views and states", FilesOf(session), session.photos.size()));
  session = WithResponses(std::move(session), context, artifact);
  session = WithCorrectedExposures(std::move(session), context, artifact);
  session = WithFlatFields(std::move(session), context, artifact);
  artifact["photos"] = nlohmann::json::array();
  for (const SessionPhoto& photo : session.photos) {
    nlohmann::json exposures = nlohmann::json::array();
    for (const SessionExposure& exposure : photo.bracket)
      exposures.push_back({{"file", exposure.file}, {"relative_exposure_s", exposure.relative_exposure_s}});
    artifact["photos"].push_back({{"view", photo.view},
                                  {"state", photo.state},
                                  {"camera", session.cameras[static_cast<size_t>(photo.camera)].id},
                                  {"exposures", exposures}});
  }
  artifact["warnings"] = nlohmann::json::array();
  for (size_t i = warnings_before; i < context.warnings.size(); ++i) {
    const Warning& w = context.warnings[i];
    artifact["warnings"].push_back({{"code", w.code}, {"message", w.message}, {"remedy", w.remedy}});
  }
  artifact["choices"] = ChoicesJson(context);
  // Callers that read an earlier run (the report) have no folder of their own.
  if (!context.out.empty()) WriteJson(context.out + "/stages/linearize.json", artifact);
  return session;
}

Session LinearizeSession(Session session, RunContext& context) {
  session = WithoutAmbientReadings(std::move(session), context);
  return session.photos.empty() ? session : LinearizePhotos(std::move(session), context);
}

}  // namespace luxfit
