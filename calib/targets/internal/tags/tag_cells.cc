#include "calib/targets/internal/tags/tag_cells.h"

#include <algorithm>
#include <cmath>

#include "calib/luminance/internal/plane_sample.h"
#include "calib/targets/internal/boards/homography.h"
#include "calib/targets/internal/tags/tag_family.h"

namespace luxfit {
namespace {

constexpr double kLeastCorrelation = 0.7;
constexpr double kLeastBorder = 0.85;  // least share of the border's cells that are dark
constexpr double kLeastSeen = 0.5;     // least share of the cells that lie in the photo

struct Moments {
  double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;

  void Add(double a, double b) {
    n += 1;
    x += a;
    y += b;
    xx += a * a;
    yy += b * b;
    xy += a * b;
  }
  double Correlation() const {
    const double variances = (xx - x * x / n) * (yy - y * y / n);
    return variances > 0 ? (xy - x * y / n) / std::sqrt(variances) : 0;
  }
};

}  // namespace

TagCells CellsOf(const apriltag_family_t& family, int id, int border_bits) {
  const TagPicture picture = DrawTag(family, id, border_bits);
  const int begin = picture.border_begin, width = picture.border_end - begin, more = border_bits - 1;
  Eigen::ArrayXXi is_bit = Eigen::ArrayXXi::Zero(picture.total_cells(), picture.total_cells());
  for (uint32_t bit = 0; bit < family.nbits; ++bit)
    is_bit(static_cast<int>(family.bit_y[bit]) + begin + more,
           static_cast<int>(family.bit_x[bit]) + begin + more) = 1;
  TagCells cells;
  cells.border = static_cast<double>(border_bits) / width;
  for (int row = 0; row < picture.total_cells(); ++row) {
    for (int column = 0; column < picture.total_cells(); ++column) {
      const bool is_white = picture.cells(row, column) > 0.5, is_of_code = is_bit(row, column) != 0;
      const bool is_in_square = std::min(row, column) >= begin && std::max(row, column) < begin + width;
      if (!is_of_code && (is_white || !is_in_square)) continue;
      cells.cells.push_back(
          {{(column - begin + 0.5) / width, (row - begin + 0.5) / width}, is_white, is_of_code});
    }
  }
  return cells;
}

TagCells CellsOf(const cv::aruco::Dictionary& dictionary, int id) {
  const cv::Mat bits = cv::aruco::Dictionary::getBitsFromByteList(dictionary.bytesList.rowRange(id, id + 1),
                                                                  dictionary.markerSize);
  const int width = dictionary.markerSize + 2;
  TagCells cells;
  cells.border = 1.0 / width;
  for (int row = 0; row < width; ++row) {
    for (int column = 0; column < width; ++column) {
      const bool is_bit = std::min(row, column) > 0 && std::max(row, column) < width - 1;
      const bool is_white = is_bit && bits.at<uchar>(row - 1, column - 1) != 0;
      cells.cells.push_back({{(column + 0.5) / width, (row + 0.5) / width}, is_white, is_bit});
    }
  }
  return cells;
}

bool ShowsTag(const ImagePlane& grey, const Eigen::Matrix3d& pixel_from_tag, const TagCells& cells) {
  Moments code;
  std::vector<double> border;
  double white = 0, whites = 0, black = 0, blacks = 0;
  for (const TagCell& cell : cells.cells) {
    const double value = SampleBilinear(grey, MapPoint(pixel_from_tag, cell.middle));
    if (!std::isfinite(value)) continue;
    if (cell.is_bit) code.Add(value, cell.is_white ? 1 : 0);
    (cell.is_white ? white : black) += value;
    (cell.is_white ? whites : blacks) += 1;
    if (!cell.is_bit) border.push_back(value);
  }
  if (code.n + static_cast<double>(border.size()) < kLeastSeen * static_cast<double>(cells.cells.size()))
    return false;
  if (!(whites > 0) || !(blacks > 0) || !(code.Correlation() > kLeastCorrelation)) return false;
  const double middle = (white / whites + black / blacks) / 2;
  double dark = 0;
  for (const double value : border) dark += value < middle ? 1 : 0;
  return dark >= kLeastBorder * static_cast<double>(border.size());
}

}  // namespace luxfit
