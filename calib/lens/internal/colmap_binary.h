// Reads the little-endian values of COLMAP's binary files, one after the other.
//
// Throws std::runtime_error, naming the file, where it cannot be opened or ends early.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_COLMAP_BINARY_H_
#define LUXFIT_CALIB_LENS_INTERNAL_COLMAP_BINARY_H_

#include <fstream>
#include <stdexcept>
#include <string>

namespace luxfit {

class ColmapBinary {
 public:
  explicit ColmapBinary(const std::string& path) : path_(path), file_(path, std::ios::binary) {
    if (!file_) throw Error("expected a readable file, got none");
  }

  template <typename T>
  T Read() {
    T value{};
    if (!file_.read(reinterpret_cast<char*>(&value), sizeof(T)))
      throw Error("expected more data, got the end of the file; was it copied whole?");
    return value;
  }

  // Reads text up to a zero byte.
  std::string ReadText() {
    std::string text;
    while (const char c = Read<char>()) text += c;
    return text;
  }

  std::runtime_error Error(const std::string& message) const {
    return std::runtime_error(path_ + ": " + message);
  }

 private:
  std::string path_;
  std::ifstream file_;
};

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_COLMAP_BINARY_H_
