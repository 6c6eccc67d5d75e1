// Returns how bright the surroundings of each pixel of a photo are: what local tone mapping goes by.
//
//   b_j = G_j * ln max(Y, least)    G_j: Gaussian, sigma kSurroundSigmas[j] of the diagonal; least: 1e-3 of the mean
//
// Y is averaged over cells first, about 200 along the diagonal. b is needed up to a constant. Gaussians of two sizes stand
// for what phones do, which nobody publishes: their filters keep edges, and look near or far.
// Source: Reinhard et al. (2010), "High dynamic range imaging", 2nd ed., sec. 8.1 (surround of a local operator).
#ifndef LUXFIT_CALIB_LUMINANCE_SURROUND_H_
#define LUXFIT_CALIB_LUMINANCE_SURROUND_H_

#include <array>

#include "calib/luminance/luminance.h"

namespace luxfit {

constexpr std::array<double, 2> kSurroundSigmas{0.05, 0.15};

class Surround {
 public:
  using Values = Eigen::Array<float, kSurroundSigmas.size(), 1>;

  // Throws std::invalid_argument for an empty image.
  explicit Surround(const LuminanceImage& image);

  // Returns b around the pixel in row v and column u.
  Values LogLuminance(Eigen::Index v, Eigen::Index u) const {
    Values values;
    for (size_t j = 0; j < cells_.size(); ++j)
      values[static_cast<Eigen::Index>(j)] = cells_[j](v / pixels_, u / pixels_);
    return values;
  }

 private:
  Eigen::Index pixels_ = 1;  // along each side of a cell
  std::array<ImagePlane, kSurroundSigmas.size()> cells_;
};

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_SURROUND_H_
