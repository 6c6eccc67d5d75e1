// Encodes bytes and numbers as text for a page: base64 (RFC 4648, sec. 4, padded).
//
// Numbers are little-endian and row by row, as a typed array of a browser reads them.
#ifndef LUXFIT_APPS_TEXT_FORMATS_BASE64_H_
#define LUXFIT_APPS_TEXT_FORMATS_BASE64_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace luxfit {

std::string Base64(const std::vector<uint8_t>& bytes);

// Encodes the numbers as 32-bit floats.
std::string Base64Floats(const Eigen::MatrixXd& values);
std::string Base64Shorts(const std::vector<uint16_t>& values);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FORMATS_BASE64_H_
