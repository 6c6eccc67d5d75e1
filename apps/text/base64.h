// Bytes and numbers as text of a page: base64 (RFC 4648, sec. 4, padded).
//
// Numbers are little-endian, row by row: what a typed array of a browser reads.
#ifndef LUXFIT_APPS_TEXT_BASE64_H_
#define LUXFIT_APPS_TEXT_BASE64_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace luxfit {

std::string Base64(const std::vector<uint8_t>& bytes);

// As 32-bit floats.
std::string Base64Floats(const Eigen::MatrixXd& values);
std::string Base64Shorts(const std::vector<uint16_t>& values);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_BASE64_H_
