#include "calib/photo_files/internal/heif_photo.h"

#include <libheif/heif.h>

#include <memory>
#include <set>
#include <stdexcept>

#include "calib/photo_files/internal/file_ending.h"

namespace luxfit {
namespace {

template <typename T, void (*kFree)(T*)>
struct HeifDeleter {
  void operator()(T* item) const { kFree(item); }
};
template <typename T, void (*kFree)(T*)>
using HeifPointer = std::unique_ptr<T, HeifDeleter<T, kFree>>;

void FreeHandle(heif_image_handle* handle) { heif_image_handle_release(handle); }
void FreeImage(heif_image* image) { heif_image_release(image); }

using ContextPointer = HeifPointer<heif_context, heif_context_free>;
using HandlePointer = HeifPointer<heif_image_handle, FreeHandle>;
using ImagePointer = HeifPointer<heif_image, FreeImage>;
using OptionsPointer = HeifPointer<heif_decoding_options, heif_decoding_options_free>;

void ExpectDecoded(const std::string& path, const heif_error& error) {
  if (error.code == heif_error_Ok) return;
  throw std::runtime_error(path + ": cannot read the photo, expected HEIC or HEIF (" + error.message +
                           "); convert it: heif-convert PHOTO.heic PHOTO.jpg");
}

// The handle keeps the context alive.
HandlePointer PrimaryPicture(const std::string& path) {
  const ContextPointer context(heif_context_alloc());
  ExpectDecoded(path, heif_context_read_from_file(context.get(), path.c_str(), nullptr));
  heif_image_handle* handle = nullptr;
  ExpectDecoded(path, heif_context_get_primary_image_handle(context.get(), &handle));
  return HandlePointer(handle);
}

// Copies rows of interleaved red, green, blue.
template <typename T>
void CopyCounts(const std::uint8_t* bytes, int stride, float scale, Photo& photo) {
  for (int v = 0; v < photo.height_px(); ++v) {
    const T* const row = reinterpret_cast<const T*>(bytes + static_cast<std::ptrdiff_t>(v) * stride);
    for (int u = 0; u < photo.width_px(); ++u) {
      for (int c = 0; c < 3; ++c)
        photo.rgb_counts[static_cast<size_t>(c)](v, u) = scale * static_cast<float>(row[3 * u + c]);
    }
  }
}

}  // namespace

bool IsHeifName(const std::string& path) {
  static const std::set<std::string> endings{".heic", ".heif", ".hif"};
  return endings.count(FileEnding(path)) > 0;
}

Photo ReadHeifPhoto(const std::string& path) {
  const HandlePointer handle = PrimaryPicture(path);
  const bool is_deep = heif_image_handle_get_luma_bits_per_pixel(handle.get()) > 8;
  const OptionsPointer options(heif_decoding_options_alloc());
  options->ignore_transformations = 1;
  heif_image* decoded = nullptr;
  ExpectDecoded(path,
                heif_decode_image(handle.get(), &decoded, heif_colorspace_RGB,
                                  is_deep ? heif_chroma_interleaved_RRGGBB_LE : heif_chroma_interleaved_RGB,
                                  options.get()));
  const ImagePointer image(decoded);
  int stride = 0;
  const std::uint8_t* const bytes =
      heif_image_get_plane_readonly(image.get(), heif_channel_interleaved, &stride);
  Photo photo;
  for (ImagePlane& plane : photo.rgb_counts)
    plane.resize(heif_image_get_height(image.get(), heif_channel_interleaved),
                 heif_image_get_width(image.get(), heif_channel_interleaved));
  photo.bits_per_channel = 8;
  photo.full_scale_counts = photo.saturation_counts = 255.0;
  if (is_deep) {
    const int bits = heif_image_get_bits_per_pixel_range(image.get(), heif_channel_interleaved);
    CopyCounts<std::uint16_t>(bytes, stride, 255.0f / static_cast<float>((1 << bits) - 1), photo);
  } else {
    CopyCounts<std::uint8_t>(bytes, stride, 1.0f, photo);
  }
  return photo;
}

std::vector<std::uint8_t> ReadHeifExifBytes(const std::string& path) {
  constexpr size_t kOffsetBytes = 4;  // the block opens with where the TIFF header begins
  HandlePointer handle;
  try {
    handle = PrimaryPicture(path);
  } catch (const std::runtime_error&) {
    return {};  // a photo that cannot be read states nothing; reading its counts says why
  }
  heif_item_id id = 0;
  if (heif_image_handle_get_list_of_metadata_block_IDs(handle.get(), "Exif", &id, 1) != 1) return {};
  std::vector<std::uint8_t> block(heif_image_handle_get_metadata_size(handle.get(), id));
  if (block.size() <= kOffsetBytes ||
      heif_image_handle_get_metadata(handle.get(), id, block.data()).code != heif_error_Ok)
    return {};
  const size_t offset = size_t{block[0]} << 24 | size_t{block[1]} << 16 | size_t{block[2]} << 8 | block[3];
  if (offset >= block.size() - kOffsetBytes) return {};
  block.erase(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(kOffsetBytes + offset));
  return block;
}

std::vector<std::string> ReadHeifAuxiliaryTypes(const std::string& path) {
  HandlePointer primary;
  try {
    primary = PrimaryPicture(path);
  } catch (const std::runtime_error&) {
    return {};
  }
  std::vector<heif_item_id> ids(
      static_cast<size_t>(heif_image_handle_get_number_of_auxiliary_images(primary.get(), 0)));
  heif_image_handle_get_list_of_auxiliary_image_IDs(primary.get(), 0, ids.data(),
                                                    static_cast<int>(ids.size()));
  std::vector<std::string> types;
  for (const heif_item_id id : ids) {
    heif_image_handle* auxiliary = nullptr;
    if (heif_image_handle_get_auxiliary_image_handle(primary.get(), id, &auxiliary).code != heif_error_Ok)
      continue;
    const HandlePointer handle(auxiliary);
    const char* type = nullptr;
    if (heif_image_handle_get_auxiliary_type(auxiliary, &type).code != heif_error_Ok) continue;
    types.emplace_back(type);
    heif_image_handle_free_auxiliary_types(auxiliary, &type);
  }
  return types;
}

HeifProfile ReadHeifProfile(const std::string& path) {
  HandlePointer primary;
  try {
    primary = PrimaryPicture(path);
  } catch (const std::runtime_error&) {
    return {};
  }
  HeifProfile profile;
  profile.icc.resize(heif_image_handle_get_raw_color_profile_size(primary.get()));
  if (!profile.icc.empty() &&
      heif_image_handle_get_raw_color_profile(primary.get(), profile.icc.data()).code != heif_error_Ok)
    profile.icc.clear();
  heif_color_profile_nclx* nclx = nullptr;
  if (heif_image_handle_get_nclx_color_profile(primary.get(), &nclx).code != heif_error_Ok) return profile;
  profile.transfer = nclx->transfer_characteristics;
  heif_nclx_color_profile_free(nclx);
  return profile;
}

}  // namespace luxfit
