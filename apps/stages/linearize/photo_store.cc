#include "apps/stages/linearize/photo_store.h"

#include <utility>

namespace luxfit {
namespace {

double BytesOf(const LuminanceImage& image) {
  double numbers = static_cast<double>(image.relative_luminance.size() + image.variance.size());
  for (const ImagePlane& channel : image.relative_rgb) numbers += static_cast<double>(channel.size());
  return sizeof(float) * numbers + static_cast<double>(image.valid.size() + image.saturated.size());
}

}  // namespace

std::shared_ptr<const LuminanceImage> PhotoStore::Get(const std::string& file,
                                                      const std::function<LuminanceImage()>& decode) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto kept = kept_.find(file);
    if (kept != kept_.end()) return kept->second;
  }
  auto image = std::make_shared<const LuminanceImage>(decode());
  const double bytes = BytesOf(*image);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (bytes_ + bytes <= max_bytes_ && kept_.emplace(file, image).second) bytes_ += bytes;
  return image;
}

}  // namespace luxfit
