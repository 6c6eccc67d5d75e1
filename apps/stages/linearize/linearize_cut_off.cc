#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/stages/linearize/linearize.h"
#include "calib/luminance/cut_off.h"

namespace luxfit {
namespace {

std::vector<PhotoExposure*> FilesOf(LinearizedPhotos& photos, size_t camera) {
  std::vector<PhotoExposure*> files;
  for (LinearizedPhoto& photo : photos.photos) {
    if (static_cast<size_t>(photo.camera) != camera) continue;
    for (PhotoExposure& exposure : photo.bracket) files.push_back(&exposure);
  }
  return files;
}

// Returns nothing for a photo that cannot be read, too: who needs it refuses it. Registration by COLMAP needs none.
std::optional<TopCount> TopCountOfFile(const std::string& file) {
  try {
    return ReadTopCount(file);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

void WarnOfCutOff(const Session& session, const std::vector<PhotoExposure*>& files, double counts,
                  const std::string& camera, RunContext& context) {
  std::vector<std::string> names;
  for (const PhotoExposure* file : files)
    if (file->cut_off_counts == counts) names.push_back(PhotoName(session, *file));
  context.warnings.push_back(
      {"counts_cut_off",
       fmt::format(
           "{} photos of camera {} end at one largest count, {:g}, which many of their pixels share at "
           "several exposures: light beyond it was cut off. They were taken as saturated there; the "
           "first is {}",
           names.size(), camera, counts, names.front()),
       "develop them again with the white level of the sensor, so that clipped pixels are at full scale"});
}

}  // namespace

LinearizedPhotos WithCutOffs(LinearizedPhotos photos, const Session& session, RunContext& context) {
  for (size_t c = 0; c < photos.cameras.size(); ++c) {
    const std::vector<PhotoExposure*> files = FilesOf(photos, c);
    std::vector<ExposedTop> tops(files.size());
    tbb::parallel_for(size_t{0}, files.size(), [&](size_t i) {
      if (const auto top = TopCountOfFile(files[i]->file)) tops[i] = {*top, files[i]->relative_exposure_s};
    });
    for (const double counts : FindCutOffs(tops)) {
      for (size_t i = 0; i < files.size(); ++i)
        if (tops[i].top.counts == counts) files[i]->cut_off_counts = counts;
      WarnOfCutOff(session, files, counts, photos.cameras[c].given.id, context);
    }
  }
  return photos;
}

}  // namespace luxfit
