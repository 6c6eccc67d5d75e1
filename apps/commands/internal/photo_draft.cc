#include "apps/commands/internal/photo_draft.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "apps/commands/internal/photo_files.h"
#include "apps/session/photos/photo_groups.h"
#include "apps/session/photos/photo_look.h"
#include "calib/photo_files/image.h"
#include "calib/targets/tags.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

constexpr size_t kPhotosForTags = 8;  // number searched for tags

std::string PathIn(const std::string& folder, const std::string& file) {
  return (fs::path(folder) / file).string();
}

// Sets the family of which tags are seen, the most usual first, and the tags.
void FindFamily(const std::vector<std::string>& paths, SessionDraft& draft) {
  std::set<int> seen;
  draft.family = "tag36h11";
  draft.family_because = "what `luxfit board tags` prints";
  for (const std::string family : {"tag36h11", "tagStandard41h12", "tag25h9", "tag16h5"}) {
    for (const std::string& path : paths) {
      DetectTagsOptions detect;
      detect.family = family;
      for (const TagDetection& tag : DetectTags(ReadPhoto(path).rgb_counts[1], detect)) seen.insert(tag.id);
    }
    if (seen.empty()) continue;
    draft.family = family;
    draft.family_because =
        fmt::format("{} of them are seen in {} photos that were looked at", seen.size(), paths.size());
    break;
  }
  draft.seen_tags.assign(seen.begin(), seen.end());
}

// Photos of one size are of one camera.
void DraftByNames(const std::string& folder, const PhotoNames& names, SessionDraft& draft) {
  draft.names_because = names.because;
  draft.photos.resize(names.photos.size());
  std::vector<PhotoLook> looks(names.photos.size());
  tbb::parallel_for(size_t{0}, names.photos.size(), [&](size_t i) {
    looks[i] = LookAtLight(folder, names.photos[i].file);
    const PhotoLook& look = looks[i];
    draft.photos[i] = {names.photos[i], look.exposure,         look.width_px,
                       look.height_px,  look.bits_per_channel, 0};
  });
  draft.states = StatesByNamesAndLight(names, looks);
  std::vector<std::pair<int, int>> sizes;
  for (DraftPhoto& photo : draft.photos) {
    const std::pair<int, int> size(photo.width_px, photo.height_px);
    const auto known = std::find(sizes.begin(), sizes.end(), size);
    photo.camera = static_cast<int>(known - sizes.begin());
    if (known == sizes.end()) sizes.push_back(size);
  }
  std::vector<std::string> paths;
  std::set<std::string> views;
  for (const DraftPhoto& photo : draft.photos) {
    if (paths.size() < kPhotosForTags && views.insert(photo.name.view).second)
      paths.push_back(PathIn(folder, photo.name.file));
  }
  FindFamily(paths, draft);
}

// Looks for tags in photos from all over the list, since neighbours may be of one view.
std::vector<std::string> SomePaths(const std::string& folder, const std::vector<std::string>& files) {
  const size_t count = std::min(kPhotosForTags, files.size());
  std::vector<std::string> paths;
  for (size_t k = 0; k < count; ++k) paths.push_back(PathIn(folder, files[k * files.size() / count]));
  return paths;
}

void DraftByContent(const std::string& folder, const std::vector<std::string>& files, SessionDraft& draft) {
  FindFamily(SomePaths(folder, files), draft);
  std::vector<PhotoLook> looks(files.size());
  tbb::parallel_for(size_t{0}, files.size(),
                    [&](size_t i) { looks[i] = LookAtPhoto(folder, files[i], draft.family); });
  const GroupedPhotos grouped = GroupPhotos(looks);
  draft.names_because = grouped.names.because;
  draft.states = grouped.states;
  std::set<int> seen;
  for (size_t i = 0; i < looks.size(); ++i) {
    const PhotoLook& look = looks[i];
    draft.photos.push_back({grouped.names.photos[i], look.exposure, look.width_px, look.height_px,
                            look.bits_per_channel, grouped.camera[i]});
    for (const TagDetection& tag : look.tags) seen.insert(tag.id);
  }
  draft.seen_tags.assign(seen.begin(), seen.end());
  std::stable_sort(draft.photos.begin(), draft.photos.end(), [](const DraftPhoto& a, const DraftPhoto& b) {
    return std::pair(a.name.view, a.name.state) < std::pair(b.name.view, b.name.state);
  });
}

}  // namespace

void DraftPhotos(const std::string& photos, const std::string& out, SessionDraft& draft) {
  const std::vector<std::string> files = PhotoFilesIn(photos, "--photos");
  const PhotoNames names = GuessViewsAndStates(files);
  if (names.do_names_tell || files.size() == 1) {
    DraftByNames(photos, names, draft);
  } else {
    DraftByContent(photos, files, draft);
  }
  NameMixByReadings(draft);
  std::vector<std::string> paths;
  for (const DraftPhoto& photo : draft.photos) paths.push_back(PathIn(photos, photo.name.file));
  draft.tone_mapped = FindToneMapped(paths);
  if (draft.tone_mapped.mapped > 0)
    draft.tone_mapped.first = fs::relative(draft.tone_mapped.first, out).string();
  int last = 0;
  for (DraftPhoto& photo : draft.photos) {
    photo.name.file = fs::relative(PathIn(photos, photo.name.file), out).string();
    last = std::max(last, photo.camera);
  }
  draft.cameras = last + 1;
}

}  // namespace luxfit
