#include "apps/stages/register/image_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace luxfit {
namespace {

// Returns the names of folders and file, the file's without its ending.
std::vector<std::string> PartsOf(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '/' || c == '\\') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  const size_t ending = parts.back().rfind('.');
  if (ending != std::string::npos && ending > 0) parts.back().erase(ending);
  return parts;
}

// Returns how many parts the two have in common, from the last one on.
size_t CommonEnd(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const auto differ = std::mismatch(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  return static_cast<size_t>(differ.first - a.rbegin());
}

std::string ViewOfImage(const std::string& image, const std::vector<PhotoOfView>& photos,
                        const std::string& model) {
  const std::vector<std::string> parts = PartsOf(image);
  size_t longest = 0;
  const PhotoOfView* found = nullptr;
  const PhotoOfView* other = nullptr;  // of another view, that fits as well
  for (const PhotoOfView& photo : photos) {
    const size_t common = CommonEnd(parts, PartsOf(photo.file));
    if (common == 0 || common < longest) continue;
    if (common > longest) {
      longest = common;
      found = &photo;
      other = nullptr;
    } else if (photo.view != found->view) {
      other = &photo;
    }
  }
  if (other != nullptr)
    throw std::runtime_error(
        fmt::format("{}: image {}: expected a name that one view's photos end in, got one that {} and {} end "
                    "in; run COLMAP on a "
                    "folder that holds both, so that names say which is meant",
                    model, image, found->file, other->file));
  if (found != nullptr) return found->view;
  const auto named = std::find_if(photos.begin(), photos.end(),
                                  [&](const PhotoOfView& photo) { return photo.view == parts.back(); });
  return named == photos.end() ? "" : named->view;
}

}  // namespace

std::map<std::string, std::string> ViewsOfImages(const std::vector<std::string>& images,
                                                 const std::vector<PhotoOfView>& photos,
                                                 const std::string& model) {
  std::map<std::string, std::string> views;
  for (const std::string& image : images) {
    const std::string view = ViewOfImage(image, photos, model);
    if (!view.empty()) views[image] = view;
  }
  return views;
}

}  // namespace luxfit
