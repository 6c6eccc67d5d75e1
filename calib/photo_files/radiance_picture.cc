#include "calib/photo_files/radiance_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace luxfit {
namespace {

using Rgbe = std::array<uint8_t, 4>;

Rgbe RgbeOf(float red, float green, float blue) {
  constexpr float kLeast = 1e-32f;
  const auto held = [](float value) { return value > 0 ? value : 0; };  // NaN, too, becomes 0
  const float largest = std::max({held(red), held(green), held(blue)});
  if (!(largest > kLeast)) return {0, 0, 0, 0};
  int exponent = 0;
  const float scale = std::frexp(largest, &exponent) * 256 / largest;
  // Radiance's readers take a mantissa as the middle of its step: it is cut off, not rounded.
  const auto mantissa = [&](float value) {
    return static_cast<uint8_t>(std::min(255.0f, held(value) * scale));
  };
  return {mantissa(red), mantissa(green), mantissa(blue), static_cast<uint8_t>(exponent + 128)};
}

// Appends one channel of a scanline: runs of equal bytes as 128 + length and the byte, others as length and
// bytes.
void AppendRuns(const std::vector<Rgbe>& line, size_t channel, std::string& bytes) {
  constexpr size_t kShortestRun = 4, kLongestRun = 127, kLongestLiteral = 128;
  const auto run_at = [&](size_t at) {
    size_t end = at + 1;
    while (end < line.size() && end - at < kLongestRun && line[end][channel] == line[at][channel]) ++end;
    return end - at;
  };
  size_t at = 0;
  while (at < line.size()) {
    const size_t run = run_at(at);
    if (run >= kShortestRun) {
      bytes += static_cast<char>(128 + run);
      bytes += static_cast<char>(line[at][channel]);
      at += run;
      continue;
    }
    size_t end = at + run;
    while (end < line.size() && end - at < kLongestLiteral && run_at(end) < kShortestRun) ++end;
    bytes += static_cast<char>(end - at);
    for (; at < end; ++at) bytes += static_cast<char>(line[at][channel]);
  }
}

std::string LineBytes(const std::vector<Rgbe>& line) {
  constexpr size_t kLeastEncoded = 8, kMostEncoded = 32767;
  std::string bytes;
  if (line.size() < kLeastEncoded || line.size() > kMostEncoded) {
    for (const Rgbe& pixel : line)
      for (const uint8_t byte : pixel) bytes += static_cast<char>(byte);
    return bytes;
  }
  bytes = {2, 2, static_cast<char>(line.size() >> 8), static_cast<char>(line.size() & 0xFF)};
  for (size_t channel = 0; channel < 4; ++channel) AppendRuns(line, channel, bytes);
  return bytes;
}

void ExpectPicture(const std::array<ImagePlane, 3>& rgb, const std::vector<std::string>& header) {
  for (const ImagePlane& plane : rgb) {
    if (plane.rows() != rgb[0].rows() || plane.cols() != rgb[0].cols() || plane.size() == 0)
      throw std::invalid_argument("WriteRadiancePicture: expected three planes of one size");
  }
  for (const std::string& line : header) {
    if (line.find('\n') != std::string::npos || line.empty())
      throw std::invalid_argument("WriteRadiancePicture: expected header lines of one line each");
  }
}

bool WritePicture(const std::string& path, const std::array<ImagePlane, 3>& rgb,
                  const std::vector<std::string>& header) {
  std::ofstream file(path, std::ios::binary);
  file << "#?RADIANCE\n";
  // OpenCV 4.6 reads a header in pieces of 127 bytes, and takes a piece that is a newline alone for its end.
  constexpr size_t kPiece = 127;
  for (const std::string& line : header) file << line << (line.size() % kPiece == 0 ? " \n" : "\n");
  file << "FORMAT=32-bit_rle_rgbe\n\n-Y " << rgb[0].rows() << " +X " << rgb[0].cols() << '\n';
  std::vector<Rgbe> line(static_cast<size_t>(rgb[0].cols()));
  for (Eigen::Index v = 0; v < rgb[0].rows(); ++v) {
    for (Eigen::Index u = 0; u < rgb[0].cols(); ++u)
      line[static_cast<size_t>(u)] = RgbeOf(rgb[0](v, u), rgb[1](v, u), rgb[2](v, u));
    file << LineBytes(line);
  }
  file.close();
  return static_cast<bool>(file);
}

}  // namespace

ImagePlane RadianceBrightness(const std::array<ImagePlane, 3>& rgb) {
  return 0.265f * rgb[0] + 0.670f * rgb[1] + 0.065f * rgb[2];
}

void WriteRadiancePicture(const std::string& path, const std::array<ImagePlane, 3>& rgb,
                          const std::vector<std::string>& header) {
  ExpectPicture(rgb, header);
  const std::string temporary = path + ".part";
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
  const bool is_written = WritePicture(temporary, rgb, header);
  if (is_written) std::filesystem::rename(temporary, path, error);
  if (is_written && !error) return;
  std::filesystem::remove(temporary, error);
  throw std::runtime_error(path + ": expected a writable place; check the folder and the free space");
}

}  // namespace luxfit
