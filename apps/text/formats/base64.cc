#include "apps/text/formats/base64.h"

#include <cstring>

namespace luxfit {
namespace {

void AddLittleEndian(uint32_t value, int bytes, std::vector<uint8_t>& out) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<uint8_t>(value >> (8 * i) & 0xFF));
}

}  // namespace

std::string Base64(const std::vector<uint8_t>& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t j = 0; j < 3; ++j) group = group << 8 | (j < count ? bytes[i + j] : 0U);
    for (size_t j = 0; j < 4; ++j) text += j <= count ? kDigits[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

std::string Base64Floats(const Eigen::MatrixXd& values) {
  std::vector<uint8_t> bytes;
  bytes.reserve(static_cast<size_t>(values.size()) * sizeof(float));
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      const float value = static_cast<float>(values(row, column));
      uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      AddLittleEndian(bits, 4, bytes);
    }
  }
  return Base64(bytes);
}

std::string Base64Shorts(const std::vector<uint16_t>& values) {
  std::vector<uint8_t> bytes;
  bytes.reserve(2 * values.size());
  for (const uint16_t value : values) AddLittleEndian(value, 2, bytes);
  return Base64(bytes);
}

}  // namespace luxfit
