// Places what cameras saw on a picture of their image: its frame, with the pixels along it.
//
//   drawn = origin + scale (pixel + (0.5, 0.5)),   scale = drawn width / width of the image
//
// Pixel (0, 0) is the centre of the top-left pixel.
#ifndef LUXFIT_APPS_CHARTS_IMAGE_FRAME_H_
#define LUXFIT_APPS_CHARTS_IMAGE_FRAME_H_

#include <Eigen/Core>
#include <string>

namespace luxfit {

struct ImageFrame {
  int width_px = 0, height_px = 0;  // of the image
  double ScaleOfDrawing() const;
  Eigen::Vector2d At(const Eigen::Vector2d& pixel) const;
  double BottomPx() const;  // where the drawn image ends

  // Returns the frame with round numbers of pixels to its left and below it.
  std::string Axes() const;
  // Returns the picture of a body: the image, its axes and `legend_px` below them.
  std::string Document(const std::string& body, double legend_px = 0) const;
};

inline constexpr double kFrameLeftPx = 38, kFrameTopPx = 10, kFrameWidthPx = 430, kFrameAxisPx = 24;

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_IMAGE_FRAME_H_
