#include "calib/calibrate/internal/uncertain_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "calib/calibrate/internal/calibration_coverage.h"
#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr int kColumns = 24, kRows = 18;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void WriteUncertainPlaces(double limit_px, CalibratedCamera& camera) {
  const Eigen::MatrixXd sigma_px =
      ProjectionSigmaMap(camera.camera, camera.uncertainty, kColumns, kRows, kInfinity);
  const ImageRaster raster{camera.camera.width_px, camera.camera.height_px, kRows, kColumns};
  Eigen::Array<bool, 3, 3> marked = Eigen::Array<bool, 3, 3>::Constant(false);
  std::vector<double> sigmas;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      if (!camera.circle.Holds(raster.MiddleOf(row, column))) continue;
      const double sigma = sigma_px(row, column);
      sigmas.push_back(std::isnan(sigma) ? kInfinity : sigma);
      if (sigmas.back() > limit_px) marked(3 * row / kRows, 3 * column / kColumns) = true;
    }
  }
  if (sigmas.empty()) return;
  const auto above = std::count_if(sigmas.begin(), sigmas.end(), [&](double s) { return s > limit_px; });
  camera.uncertain_share = static_cast<double>(above) / static_cast<double>(sigmas.size());
  camera.uncertain_places = ThirdsInWords(marked);
  camera.median_sigma_px = Quantile(std::move(sigmas), 0.5);
}

}  // namespace luxfit
