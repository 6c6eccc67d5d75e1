// A minimal DNG: an uncompressed 16-bit Bayer mosaic (red green / green blue), or three colours a pixel, with its black
// and white levels and EXIF, written tag by tag.
//
// Source: DNG 1.4 specification, TIFF 6.0, EXIF 2.32.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_TEST_DNG_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_TEST_DNG_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace luxfit::support {

struct TestDng {
  int width_px = 0, height_px = 0;
  bool is_linear = false;                // three colours a pixel
  std::vector<std::uint16_t> counts;     // row by row; of a linear one red, green and blue of each pixel
  std::array<std::uint32_t, 4> black{};  // of the 2 x 2 places of the mosaic, or of red, green and blue
  std::uint32_t white = 65535;
  std::pair<std::uint32_t, std::uint32_t> exposure_s{1, 60}, f_number{28, 5};
  std::uint16_t iso = 200;
  std::uint32_t recommended_exposure_index = 0;  // 0: none
  std::vector<std::uint32_t> linearization;      // what each count stands for; empty: itself
  std::vector<std::uint32_t> opcode_list_3;      // its bytes; empty: none
  std::array<int, 9> color_matrix_1e4{10000, 0, 0, 0, 10000, 0, 0, 0, 10000};  // from XYZ, row by row
};

namespace internal {

enum TiffType : std::uint16_t {
  kByte = 1,
  kAscii = 2,
  kShort = 3,
  kLong = 4,
  kRational = 5,
  kSRational = 10
};

inline void Append(std::string& bytes, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

// One directory of a little-endian TIFF: values of up to 4 bytes in the entry, longer ones behind it.
class TiffDirectory {
 public:
  void Add(std::uint16_t tag, TiffType type, const std::vector<std::uint32_t>& values) {
    std::string bytes;
    const int size = type == kByte || type == kAscii ? 1 : type == kShort ? 2 : 4;
    for (const std::uint32_t value : values) Append(bytes, value, size);
    const bool is_pair = type == kRational || type == kSRational;
    entries_.push_back({tag, type, values.size() / (is_pair ? 2 : 1), bytes});
  }
  void AddText(std::uint16_t tag, const std::string& text) {
    std::vector<std::uint32_t> values(text.begin(), text.end());
    values.push_back(0);
    Add(tag, kAscii, values);
  }
  size_t Bytes() const {
    size_t bytes = 2 + 12 * entries_.size() + 4;
    for (const Entry& entry : entries_) bytes += entry.bytes.size() > 4 ? entry.bytes.size() : 0;
    return bytes;
  }
  // `offset`: of the directory in its file. Entries must have been added in the order of their tags.
  std::string At(size_t offset) const {
    std::string head, tail;
    const size_t tail_offset = offset + 2 + 12 * entries_.size() + 4;
    Append(head, entries_.size(), 2);
    for (const Entry& entry : entries_) {
      Append(head, entry.tag, 2);
      Append(head, entry.type, 2);
      Append(head, entry.count, 4);
      if (entry.bytes.size() > 4) {
        Append(head, tail_offset + tail.size(), 4);
        tail += entry.bytes;
      } else {
        head += entry.bytes + std::string(4 - entry.bytes.size(), '\0');
      }
    }
    Append(head, 0, 4);
    return head + tail;
  }

 private:
  struct Entry {
    std::uint16_t tag;
    TiffType type;
    size_t count;
    std::string bytes;
  };
  std::vector<Entry> entries_;
};

inline TiffDirectory ExifOf(const TestDng& dng) {
  TiffDirectory exif;
  exif.Add(33434, kRational, {dng.exposure_s.first, dng.exposure_s.second});
  exif.Add(33437, kRational, {dng.f_number.first, dng.f_number.second});
  exif.Add(34855, kShort, {dng.iso});
  if (dng.recommended_exposure_index > 0) exif.Add(34866, kLong, {dng.recommended_exposure_index});
  return exif;
}

inline TiffDirectory MainOf(const TestDng& dng, size_t pixels_offset, size_t exif_offset) {
  const auto number = [](auto value) { return static_cast<std::uint32_t>(value); };
  const std::uint32_t samples = dng.is_linear ? 3 : 1, places = dng.is_linear ? 1 : 2;
  TiffDirectory main;
  main.Add(254, kLong, {0});
  main.Add(256, kLong, {number(dng.width_px)});
  main.Add(257, kLong, {number(dng.height_px)});
  main.Add(258, kShort, std::vector<std::uint32_t>(samples, 16));
  main.Add(259, kShort, {1});
  main.Add(262, kShort, {dng.is_linear ? 34892U : 32803U});  // LinearRaw, or a colour filter array
  main.AddText(271, "luxfit");
  main.AddText(272, "mosaic");
  main.Add(273, kLong, {number(pixels_offset)});
  main.Add(274, kShort, {6});  // turned by a right angle: readers must not follow it
  main.Add(277, kShort, {samples});
  main.Add(278, kLong, {number(dng.height_px)});
  main.Add(279, kLong, {number(2 * dng.counts.size())});
  main.Add(284, kShort, {1});
  if (!dng.is_linear) main.Add(33421, kShort, {2, 2});
  if (!dng.is_linear) main.Add(33422, kByte, {0, 1, 1, 2});
  main.Add(34665, kLong, {number(exif_offset)});
  main.Add(50706, kByte, {1, 4, 0, 0});
  main.AddText(50708, "luxfit mosaic");
  if (!dng.linearization.empty()) main.Add(50712, kShort, dng.linearization);
  main.Add(50713, kShort, {places, places});
  main.Add(50714, kLong, {dng.black.begin(), dng.black.begin() + (dng.is_linear ? 3 : 4)});
  main.Add(50717, kLong, {dng.white});
  std::vector<std::uint32_t> matrix;
  for (const int entry : dng.color_matrix_1e4) matrix.insert(matrix.end(), {number(entry), 10000});
  main.Add(50721, kSRational, matrix);
  main.Add(50728, kRational, {1, 2, 1, 1, 2, 3});  // a white balance, which readers must leave alone
  main.Add(50778, kShort, {21});
  if (!dng.opcode_list_3.empty()) main.Add(51022, kByte, dng.opcode_list_3);
  return main;
}

}  // namespace internal

inline void WriteTestDng(const std::string& path, const TestDng& dng) {
  constexpr size_t kHeader = 8;
  const internal::TiffDirectory exif = internal::ExifOf(dng);
  const size_t main_bytes = internal::MainOf(dng, 0, 0).Bytes();
  const size_t exif_offset = kHeader + main_bytes, pixels_offset = exif_offset + exif.Bytes();
  std::string bytes = "II";
  internal::Append(bytes, 42, 2);
  internal::Append(bytes, kHeader, 4);
  bytes += internal::MainOf(dng, pixels_offset, exif_offset).At(kHeader);
  bytes += exif.At(exif_offset);
  for (const std::uint16_t count : dng.counts) internal::Append(bytes, count, 2);
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_TEST_DNG_H_
