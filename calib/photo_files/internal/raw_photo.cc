#include "calib/photo_files/internal/raw_photo.h"

#include <libraw/libraw.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>

#include "calib/photo_files/internal/file_ending.h"

namespace luxfit {
namespace {

// The value of LibRaw's `filters` for Fuji's mosaic.
constexpr unsigned kXTrans = 9;

std::runtime_error RawError(const std::string& path, const std::string& detail) {
  return std::runtime_error(path +
                            ": cannot read the photo, expected RAW of one sensor with a colour mosaic, or a "
                            "linear DNG of three colours (" +
                            detail + "); develop it linearly to 16-bit TIFF instead");
}

void ExpectDone(const std::string& path, int status) {
  if (status != LIBRAW_SUCCESS) throw RawError(path, libraw_strerror(status));
}

// Returns the black level of a site: common, per colour, and per place in a repeating pattern.
class BlackLevels {
 public:
  explicit BlackLevels(const libraw_colordata_t& color) : color_(color) {}

  double At(int row, int column, int colour) const {
    const unsigned rows = color_.cblack[4], columns = color_.cblack[5];
    unsigned black = color_.black + color_.cblack[colour];
    if (rows > 0 && columns > 0) {
      const unsigned place =
          static_cast<unsigned>(row) % rows * columns + static_cast<unsigned>(column) % columns;
      black += color_.cblack[6 + place];
    }
    return black;
  }

  double Largest() const {
    const size_t places = size_t{color_.cblack[4]} * color_.cblack[5];
    const unsigned* const pattern = color_.cblack + 6;
    const unsigned of_colour = *std::max_element(color_.cblack, color_.cblack + 4);
    return color_.black + of_colour + (places > 0 ? *std::max_element(pattern, pattern + places) : 0);
  }

 private:
  const libraw_colordata_t& color_;
};

double WhiteLevel(const libraw_colordata_t& color) {
  double white = color.maximum;
  for (const long limit : color.linear_max) {
    if (limit > 0) white = std::min(white, static_cast<double>(limit));
  }
  return white;
}

// Returns the channel, red, green or blue, of LibRaw's colour index, in which 3 is the second green.
size_t ChannelOf(int colour) { return colour == 3 ? 1 : static_cast<size_t>(colour); }

// Holds the mosaic less its black, and the `channel` of every site.
struct Mosaic {
  ImagePlane counts;
  Eigen::Array<unsigned char, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> channel;
};

Mosaic ReadMosaic(LibRaw& raw) {
  const libraw_image_sizes_t& sizes = raw.imgdata.sizes;
  const libraw_rawdata_t& data = raw.imgdata.rawdata;
  const BlackLevels black(data.color);
  const size_t pitch = sizes.raw_pitch / sizeof(ushort);
  Mosaic mosaic;
  mosaic.counts.resize(sizes.height, sizes.width);
  mosaic.channel.resize(sizes.height, sizes.width);
  for (int v = 0; v < sizes.height; ++v) {
    const ushort* const line =
        data.raw_image + (size_t{sizes.top_margin} + static_cast<size_t>(v)) * pitch + sizes.left_margin;
    for (int u = 0; u < sizes.width; ++u) {
      const int colour = raw.COLOR(v, u);
      mosaic.counts(v, u) = static_cast<float>(line[u] - black.At(v, u, colour));
      mosaic.channel(v, u) = static_cast<unsigned char>(ChannelOf(colour));
    }
  }
  return mosaic;
}

void Interpolate(const Mosaic& mosaic, int radius, Photo& photo) {
  const Eigen::Index height = mosaic.counts.rows(), width = mosaic.counts.cols();
  for (ImagePlane& plane : photo.rgb_counts) plane.resize(height, width);
  for (Eigen::Index v = 0; v < height; ++v) {
    const Eigen::Index top = std::max<Eigen::Index>(0, v - radius), bottom = std::min(height - 1, v + radius);
    for (Eigen::Index u = 0; u < width; ++u) {
      const Eigen::Index left = std::max<Eigen::Index>(0, u - radius),
                         right = std::min(width - 1, u + radius);
      std::array<float, 3> sum{}, weight{};
      for (Eigen::Index y = top; y <= bottom; ++y) {
        for (Eigen::Index x = left; x <= right; ++x) {
          const float tent =
              static_cast<float>((radius + 1 - std::abs(y - v)) * (radius + 1 - std::abs(x - u)));
          sum[mosaic.channel(y, x)] += tent * mosaic.counts(y, x);
          weight[mosaic.channel(y, x)] += tent;
        }
      }
      for (size_t c = 0; c < 3; ++c) {
        photo.rgb_counts[c](v, u) =
            weight[c] > 0 ? sum[c] / weight[c] : std::numeric_limits<float>::quiet_NaN();
      }
      const size_t own = mosaic.channel(v, u);
      photo.rgb_counts[own](v, u) = mosaic.counts(v, u);
    }
  }
}

// A linear DNG has three colours a pixel, which its writer interpolated: as ProRAW and DNG converters do. The
// three-colour files of makers (sRAW) are balanced for white, so that they are not the sensor's counts.
bool IsLinearDng(const LibRaw& raw) {
  const libraw_data_t& data = raw.imgdata;
  const bool has_colours =
      data.rawdata.color4_image || data.rawdata.color3_image || data.rawdata.float3_image;
  return data.idata.dng_version > 0 && data.idata.colors == 3 && has_colours;
}

void ReadLinearColours(const std::string& path, LibRaw& raw, Photo& photo) {
  ExpectDone(path, raw.raw2image());
  const libraw_image_sizes_t& sizes = raw.imgdata.sizes;
  const BlackLevels black(raw.imgdata.rawdata.color);
  for (size_t c = 0; c < 3; ++c) {
    const int colour = static_cast<int>(c);
    ImagePlane& plane = photo.rgb_counts[c];
    plane.resize(sizes.height, sizes.width);
    for (int v = 0; v < sizes.height; ++v) {
      const ushort(*const line)[4] = raw.imgdata.image + static_cast<ptrdiff_t>(v) * sizes.iwidth;
      for (int u = 0; u < sizes.width; ++u)
        plane(v, u) = static_cast<float>(line[u][c] - black.At(v, u, colour));
    }
  }
}

}  // namespace

bool IsRawName(const std::string& path) {
  static const std::set<std::string> raw{".dng", ".cr2", ".cr3", ".nef", ".nrw", ".arw", ".sr2", ".orf",
                                         ".rw2", ".raf", ".pef", ".srw", ".crw", ".iiq", ".3fr"};
  return raw.count(FileEnding(path)) > 0;
}

Photo ReadRawPhoto(const std::string& path) {
  // LibRaw holds some hundred kilobytes: too much for the stack.
  const auto raw = std::make_unique<LibRaw>();
  ExpectDone(path, raw->open_file(path.c_str()));
  ExpectDone(path, raw->unpack());
  const bool is_linear = IsLinearDng(*raw);
  if (!is_linear && (!raw->imgdata.rawdata.raw_image || raw->imgdata.idata.colors != 3)) {
    throw RawError(path, "got " + std::to_string(raw->imgdata.idata.colors) + " colours a pixel, no mosaic");
  }
  const libraw_colordata_t& color = raw->imgdata.rawdata.color;
  const double full_scale = WhiteLevel(color) - BlackLevels(color).Largest();
  if (!(full_scale > 0)) throw RawError(path, "its white level is not above its black level");
  Photo photo;
  photo.bits_per_channel = 16;
  photo.is_black_subtracted = true;
  photo.full_scale_counts = photo.saturation_counts = full_scale;
  if (is_linear) {
    ReadLinearColours(path, *raw, photo);
  } else {
    Interpolate(ReadMosaic(*raw), raw->imgdata.idata.filters == kXTrans ? 2 : 1, photo);
  }
  return photo;
}

}  // namespace luxfit
