#include "calib/targets/board.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace luxfit {
namespace {

constexpr double kSigmaOfLevel0Px = 0.3;  // the sigma that mrcal expects of its corners
constexpr int kMostLevels = 10;

std::vector<std::string> Words(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

struct Columns {
  int file = -1, x = -1, y = -1, level = -1;
};

class Reader {
 public:
  Reader(const std::string& path, int count) : path_(path), count_(count) {}

  std::vector<ImageCorners> Read() {
    std::ifstream file(path_);
    if (!file) throw std::runtime_error(path_ + ": cannot read the corners, expected an existing file");
    for (std::string line; std::getline(file, line);) {
      ++line_;
      if (line.compare(0, 2, "##") == 0 || line.compare(0, 2, "#!") == 0) continue;
      if (line.compare(0, 1, "#") == 0 && columns_.file < 0) {
        ReadHeader(Words(line.substr(1)));
        continue;
      }
      const std::vector<std::string> words = Words(line.substr(0, line.find('#')));
      if (!words.empty()) ReadRow(words);
    }
    Finish();
    if (images_.empty()) throw Error("at least one row \"filename x y level\"", "none");
    return std::move(images_);
  }

 private:
  std::runtime_error Error(const std::string& expected, const std::string& got) const {
    return std::runtime_error(
        fmt::format("{}:{}: corners: expected {}, got {}", path_, std::max(line_, 1), expected, got));
  }

  void ReadHeader(const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const int column = static_cast<int>(i);
      if (names[i] == "filename") columns_.file = column;
      if (names[i] == "x") columns_.x = column;
      if (names[i] == "y") columns_.y = column;
      if (names[i] == "level" || names[i] == "weight") columns_.level = column;
      is_weight_ = is_weight_ || names[i] == "weight";
    }
    if (columns_.file < 0 || columns_.x < 0 || columns_.y < 0)
      throw Error("a header \"# filename x y level\"",
                  "\"" + fmt::format("{}", fmt::join(names, " ")) + "\"");
  }

  double Number(const std::string& text) const {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0' || !std::isfinite(value))
      throw Error("a number or -", "\"" + text + "\"");
    return value;
  }

  void ReadRow(const std::vector<std::string>& words) {
    const auto last = static_cast<std::size_t>(std::max({columns_.file, columns_.x, columns_.y}));
    if (columns_.file < 0) throw Error("the header \"# filename x y level\" before the rows", "none");
    if (words.size() <= last) throw Error("filename, x and y", fmt::format("{} words", words.size()));
    const std::string& name = words[static_cast<std::size_t>(columns_.file)];
    if (images_.empty() || images_.back().file != name) {
      Finish();
      images_.push_back({name, {}});
    }
    const std::string& x = words[static_cast<std::size_t>(columns_.x)];
    const std::string& y = words[static_cast<std::size_t>(columns_.y)];
    const std::string level = columns_.level >= 0 && words.size() > static_cast<std::size_t>(columns_.level)
                                  ? words[static_cast<std::size_t>(columns_.level)]
                                  : "0";
    const int index = rows_++;
    if (index >= count_) throw Error(fmt::format("{} rows an image, one per corner", count_), "more");
    if (x == "-" || y == "-") return;
    double sigma_px = kSigmaOfLevel0Px;
    if (level != "-") sigma_px = SigmaPx(Number(level));
    if (sigma_px > 0) images_.back().corners.push_back({index, {Number(x), Number(y)}, sigma_px});
  }

  // Returns the sigma of a level or weight; 0: not to be used.
  double SigmaPx(double value) const {
    if (!is_weight_)
      return value < 0 ? 0 : kSigmaOfLevel0Px * std::exp2(std::min<double>(value, kMostLevels));
    return value > 0 ? kSigmaOfLevel0Px / value : 0;
  }

  // A single row of "-" stands for an image where nothing was found.
  void Finish() {
    const bool is_nothing = rows_ == 1 && images_.back().corners.empty();
    if (!images_.empty() && rows_ != count_ && !is_nothing)
      throw Error(fmt::format("{} rows for {}, one per corner of the board", count_, images_.back().file),
                  std::to_string(rows_));
    rows_ = 0;
  }

  std::string path_;
  int count_ = 0, line_ = 0, rows_ = 0;
  bool is_weight_ = false;
  Columns columns_;
  std::vector<ImageCorners> images_;
};

}  // namespace

std::vector<ImageCorners> ReadCornersFile(const std::string& path, int count) {
  return Reader(path, count).Read();
}

std::string CornersFile(const std::vector<ImageCorners>& images, int count) {
  double least_px = std::numeric_limits<double>::infinity();
  for (const ImageCorners& image : images) {
    for (const BoardCorner& corner : image.corners)
      if (corner.sigma_px > 0) least_px = std::min(least_px, corner.sigma_px);
  }
  std::string text = "# filename x y level\n";
  for (const ImageCorners& image : images) {
    auto corner = image.corners.begin();
    for (int index = 0; index < count; ++index) {
      if (corner == image.corners.end() || corner->index != index) {
        text += image.file + " - - -\n";
        continue;
      }
      const double octaves = corner->sigma_px > 0 ? std::log2(corner->sigma_px / least_px) : 0;
      text += fmt::format("{} {:.6f} {:.6f} {}\n", image.file, corner->pixel.x(), corner->pixel.y(),
                          std::min<long>(std::lround(octaves), kMostLevels));
      ++corner;
    }
  }
  return text;
}

}  // namespace luxfit
