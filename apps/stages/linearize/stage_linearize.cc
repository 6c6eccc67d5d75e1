#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/stages/linearize/linearize.h"
#include "apps/stages/linearize/photo_store.h"
#include "apps/stages/stages.h"
#include "calib/luminance/bracket.h"
#include "calib/photo_files/lens_shading.h"
#include "calib/photo_files/tone_mapped.h"

namespace luxfit {
namespace {

Photo ReadCounts(const LinearizedCamera& camera, const PhotoExposure& exposure) {
  const SessionCamera& settings = camera.given;
  const std::string& file = exposure.file;
  Photo counts = ReadPhoto(file);
  if (exposure.cut_off_counts) counts.saturation_counts = *exposure.cut_off_counts;
  if (counts.bits_per_channel == 8 && settings.response == "linear") {
    throw std::runtime_error(fmt::format(
        "{}: expected linear counts (camera \"{}\" has response = \"linear\"), got an 8-bit "
        "photo: 8-bit files are "
        "gamma-encoded (sRGB); give 16-bit PNG/TIFF or EXR developed linearly from RAW, or response = "
        "\"estimate\" with brackets of two exposures or more, or response = \"srgb\", which is less "
        "accurate",
        file, settings.id));
  }
  if (counts.is_black_subtracted && settings.black_level_counts > 0) {
    throw std::runtime_error(
        fmt::format("{}: expected black_level = 0 for RAW, which states its own, got {:g} (camera \"{}\"); "
                    "remove the key",
                    file, settings.black_level_counts, settings.id));
  }
  if (camera.response && counts.full_scale_counts != camera.full_scale_counts) {
    throw std::runtime_error(
        fmt::format("{}: expected the bit depth of the camera's other photos, for which its response holds, "
                    "got full scale {:g} "
                    "against {:g}; convert them alike",
                    file, counts.full_scale_counts, camera.full_scale_counts));
  }
  return counts;
}

// Phones correct their lens's shading by a map that raw readers leave out.
void WarnOfLensShading(const LinearizedPhotos& photos, RunContext& context) {
  for (size_t c = 0; c < photos.cameras.size(); ++c) {
    const SessionCamera& camera = photos.cameras[c].given;
    const auto first =
        std::find_if(photos.photos.begin(), photos.photos.end(),
                     [&](const LinearizedPhoto& photo) { return static_cast<size_t>(photo.camera) == c; });
    if (camera.vignetting != "none" || first == photos.photos.end() || !HasLensShadingMap(first->file))
      continue;
    context.warnings.push_back({"lens_shading_left_out",
                                fmt::format("{} brings a map of its lens's shading (GainMap of the DNG), "
                                            "which is not applied: corners of camera "
                                            "{} are too dark",
                                            first->file, camera.id),
                                "set vignetting = \"estimate\" for this camera, or give a flat field"});
  }
}

size_t FilesOf(const LinearizedPhotos& photos) {
  size_t files = 0;
  for (const LinearizedPhoto& photo : photos.photos) files += photo.bracket.size();
  return files;
}

// Counts that were mapped otherwise in each part of a photo do not tell light.
void ExpectNoToneMapping(const LinearizedPhotos& photos) {
  std::vector<std::string> files;
  for (const LinearizedPhoto& photo : photos.photos) {
    for (const PhotoExposure& exposure : photo.bracket) files.push_back(exposure.file);
  }
  const ToneMappedFiles found = FindToneMapped(files);
  if (found.mapped == 0) return;
  throw std::runtime_error(fmt::format("{}: expected counts that tell light, got {}; {}", found.Names(),
                                       ToneMappingInWords(found.sign), kToneMappingRemedy));
}

void ExpectSize(const Photo& counts, const std::string& file, const SessionCamera& settings,
                const Camera& camera) {
  if (counts.width_px() == camera.width_px && counts.height_px() == camera.height_px) return;
  throw std::runtime_error(fmt::format(
      "{}: expected {} x {} pixels as in {}, got {} x {}; give the intrinsics of this "
      "resolution",
      file, camera.width_px, camera.height_px, settings.intrinsics, counts.width_px(), counts.height_px()));
}

void WriteArtifact(const LinearizedPhotos& photos, size_t first_warning, nlohmann::json artifact,
                   const RunContext& context) {
  artifact["photos"] = nlohmann::json::array();
  for (const LinearizedPhoto& photo : photos.photos) {
    nlohmann::json exposures = nlohmann::json::array();
    for (const PhotoExposure& exposure : photo.bracket) {
      exposures.push_back({{"file", exposure.file}, {"relative_exposure_s", exposure.relative_exposure_s}});
      if (exposure.cut_off_counts) exposures.back()["cut_off_counts"] = *exposure.cut_off_counts;
    }
    artifact["photos"].push_back({{"view", photo.view},
                                  {"state", photo.state},
                                  {"camera", photos.cameras[static_cast<size_t>(photo.camera)].given.id},
                                  {"exposures", exposures}});
  }
  artifact["warnings"] = nlohmann::json::array();
  for (size_t i = first_warning; i < context.warnings.size(); ++i) {
    const Warning& w = context.warnings[i];
    artifact["warnings"].push_back({{"code", w.code}, {"message", w.message}, {"remedy", w.remedy}});
  }
  artifact["choices"] = ChoicesJson(context);
  WriteJson(context.out + "/stages/linearize.json", artifact);
}

}  // namespace

LuminanceOptions LuminanceOptionsOf(const LinearizedCamera& camera) {
  LuminanceOptions options;
  options.weights = camera.given.luminance_weights;
  options.black_level_counts = camera.given.black_level_counts;
  options.response = camera.response;
  return options;
}

LuminanceImage ReadExposure(const LinearizedCamera& camera, const PhotoExposure& exposure) {
  return ToRelativeLuminance(ReadCounts(camera, exposure), exposure.relative_exposure_s,
                             LuminanceOptionsOf(camera));
}

LuminanceImage ReadLuminance(const LinearizedPhotos& photos, const LinearizedPhoto& photo,
                             const Camera& camera, NoiseNeed noise) {
  const LinearizedCamera& own = photos.cameras[static_cast<size_t>(photo.camera)];
  LuminanceOptions options = LuminanceOptionsOf(own);
  LuminanceImage image;
  if (photo.bracket.size() > 1) {
    BracketMerger merger(options);
    for (const PhotoExposure& exposure : photo.bracket) {
      const Photo counts = ReadCounts(own, exposure);
      ExpectSize(counts, exposure.file, own.given, camera);
      merger.Add(counts, exposure.relative_exposure_s);
    }
    image = merger.Merged();
  } else {
    const Photo counts = ReadCounts(own, photo.bracket.at(0));
    ExpectSize(counts, photo.file, own.given, camera);
    if (noise == NoiseNeed::kOfAll) options.noise = DefaultNoise(counts.bits_per_channel);
    image = ToRelativeLuminance(counts, photo.bracket.at(0).relative_exposure_s, options);
  }
  if (own.vignetting) image = WithoutVignetting(std::move(image), *own.vignetting);
  return image;
}

std::shared_ptr<const LuminanceImage> ReadKept(const LinearizedPhotos& photos, const LinearizedPhoto& photo,
                                               const Camera& camera, const RunContext& context) {
  const auto decode = [&] { return ReadLuminance(photos, photo, camera); };
  return context.photos ? context.photos->Get(photo.file, decode)
                        : std::make_shared<const LuminanceImage>(decode());
}

LuminanceImage ReadCorrected(const LinearizedPhotos& photos, const LinearizedPhoto& photo,
                             const Camera& camera, const PhotoCorrections& corrections, NoiseNeed noise) {
  const std::string& id = photos.cameras[static_cast<size_t>(photo.camera)].given.id;
  return WithCorrection(ReadLuminance(photos, photo, camera, noise), corrections.Of(id, photo.file),
                        photo.bracket.front().relative_exposure_s);
}

LinearizedPhotos LinearizePhotos(const Session& session, RunContext& context) {
  if (session.photos.empty()) return MakeBrackets(session, {}, context);
  const size_t first_warning = context.warnings.size();
  nlohmann::json artifact = ProvenanceJson("luxfit-linearize-1", context.provenance);
  LinearizedPhotos photos = MakeBrackets(session, RowsWithMetadata(session, context), context);
  const StageTimer timer(
      context, "linearize",
      fmt::format("{} photos of {} views and states", FilesOf(photos), photos.photos.size()));
  ExpectNoToneMapping(photos);
  photos = WithCutOffs(std::move(photos), session, context);
  photos = WithResponses(std::move(photos), session, context, artifact);
  photos = WithCorrectedExposures(std::move(photos), session, context, artifact);
  photos = WithFlatFields(std::move(photos), context, artifact);
  WarnOfLensShading(photos, context);
  // Callers that read an earlier run (the report) have no folder of their own.
  if (!context.out.empty()) WriteArtifact(photos, first_warning, std::move(artifact), context);
  return photos;
}

LinearizedSession LinearizeSession(const Session& session, RunContext& context) {
  std::vector<LuminaireReading> readings = ReadingsWithoutAmbient(session, context);
  return {LinearizePhotos(session, context), std::move(readings)};
}

}  // namespace luxfit
