#include "calib/photo_files/internal/radiance_header.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace luxfit {
namespace {

// Returns the text behind "KEY="; empty where the line has another key.
std::optional<std::string> ValueOf(const std::string& line, const std::string& key) {
  if (line.rfind(key + "=", 0) != 0) return std::nullopt;
  return line.substr(key.size() + 1);
}

double ReadMultiplier(const std::string& path, const std::string& line, std::istringstream& text) {
  double value = 0;
  if (!(text >> value) || !std::isfinite(value) || value <= 0) {
    throw std::runtime_error(path + ": cannot read the photo, expected numbers > 0 in its header, got \"" +
                             line + "\"");
  }
  return value;
}

}  // namespace

std::optional<RadianceHeader> ReadRadianceHeader(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line) || line.rfind("#?", 0) != 0) return std::nullopt;
  RadianceHeader header;
  while (std::getline(file, line) && !line.empty()) {
    if (const auto format = ValueOf(line, "FORMAT")) {
      if (format->find("xyze") != std::string::npos) {
        throw std::runtime_error(
            path +
            ": cannot read the photo, expected red, green and blue (32-bit_rle_rgbe), got "
            "CIE XYZ; convert it with ra_xyze -r");
      }
    } else if (const auto exposure = ValueOf(line, "EXPOSURE")) {
      std::istringstream text(*exposure);
      const double value = ReadMultiplier(path, line, text);
      for (double& multiplier : header.multiplier) multiplier *= value;
    } else if (const auto correction = ValueOf(line, "COLORCORR")) {
      std::istringstream text(*correction);
      for (double& multiplier : header.multiplier) multiplier *= ReadMultiplier(path, line, text);
    }
  }
  return header;
}

}  // namespace luxfit
