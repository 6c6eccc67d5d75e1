// A HEIC file written by libheif, with EXIF and a turn if wanted.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_TEST_HEIC_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_TEST_HEIC_H_

#include <gtest/gtest.h>
#include <libheif/heif.h>

#include <cstdint>
#include <exiv2/exiv2.hpp>
#include <string>
#include <vector>

namespace luxfit::support {

struct TestHeic {
  int width_px = 0, height_px = 0;
  int bits = 8;                       // or 10
  std::vector<std::uint16_t> counts;  // red, green, blue of each pixel, row by row
  Exiv2::ExifData exif;               // empty: none
  bool is_turned = false;             // the file says that it is shown turned by 90 degrees
  int transfer = 0;                   // transfer characteristics that the file states; 0: libheif's own
  bool has_auxiliary = false;         // a picture of opacity belongs to it
};

namespace internal {

inline heif_image* HeicPixels(const TestHeic& heic) {
  heif_image* image = nullptr;
  const bool is_deep = heic.bits > 8;
  const heif_chroma chroma = is_deep              ? heif_chroma_interleaved_RRGGBB_LE
                             : heic.has_auxiliary ? heif_chroma_interleaved_RGBA
                                                  : heif_chroma_interleaved_RGB;
  heif_image_create(heic.width_px, heic.height_px, heif_colorspace_RGB, chroma, &image);
  heif_image_add_plane(image, heif_channel_interleaved, heic.width_px, heic.height_px, heic.bits);
  int stride = 0;
  std::uint8_t* const bytes = heif_image_get_plane(image, heif_channel_interleaved, &stride);
  const int values = 3 * heic.width_px, channels = chroma == heif_chroma_interleaved_RGBA ? 4 : 3;
  for (int v = 0; v < heic.height_px; ++v) {
    for (int i = 0; i < values; ++i) {
      const std::uint16_t count = heic.counts[static_cast<size_t>(v * values + i)];
      if (is_deep) {
        reinterpret_cast<std::uint16_t*>(bytes + v * stride)[i] = count;
      } else {
        bytes[v * stride + i / 3 * channels + i % 3] = static_cast<std::uint8_t>(count);
      }
    }
  }
  return image;
}

}  // namespace internal

// Returns whether this machine's libheif can write HEIC.
inline bool WriteHeic(const std::string& path, const TestHeic& heic) {
  heif_context* const context = heif_context_alloc();
  heif_encoder* encoder = nullptr;
  if (heif_context_get_encoder_for_format(context, heif_compression_HEVC, &encoder).code != heif_error_Ok) {
    heif_context_free(context);
    return false;
  }
  heif_encoder_set_lossy_quality(encoder, 95);
  heif_image* const image = internal::HeicPixels(heic);
  heif_encoding_options* const options = heif_encoding_options_alloc();
  if (heic.is_turned) options->image_orientation = heif_orientation_rotate_90_cw;
  heif_color_profile_nclx* const profile = heif_nclx_color_profile_alloc();
  profile->transfer_characteristics = static_cast<heif_transfer_characteristics>(heic.transfer);
  if (heic.transfer > 0) {
    heif_image_set_nclx_color_profile(image, profile);
    options->output_nclx_profile = profile;
    options->macOS_compatibility_workaround_no_nclx_profile = 0;
  }
  heif_image_handle* handle = nullptr;
  EXPECT_EQ(heif_context_encode_image(context, image, encoder, options, &handle).code, heif_error_Ok);
  Exiv2::Blob blob;
  Exiv2::ExifParser::encode(blob, Exiv2::littleEndian, heic.exif);
  if (!heic.exif.empty())
    heif_context_add_exif_metadata(context, handle, blob.data(), static_cast<int>(blob.size()));
  EXPECT_EQ(heif_context_write_to_file(context, path.c_str()).code, heif_error_Ok);
  heif_image_handle_release(handle);
  heif_encoding_options_free(options);
  heif_nclx_color_profile_free(profile);
  heif_image_release(image);
  heif_encoder_release(encoder);
  heif_context_free(context);
  return true;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_TEST_HEIC_H_
