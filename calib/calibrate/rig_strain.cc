#include "calib/calibrate/rig_strain.h"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace luxfit {
namespace {

constexpr double kFreedomOfPose = 6;

// Sums residuals of calibrations, for their noise.
struct ResidualSum {
  double square_px2 = 0, freedom = 0;

  void Add(const Calibration& calibration, std::size_t poses) {
    freedom -= kFreedomOfPose * static_cast<double>(poses);
    for (const CornerResidual& corner : calibration.corners) {
      if (corner.is_outlier) continue;
      square_px2 += corner.residual_px.squaredNorm();
      freedom += 2;
    }
  }
  double NoisePx() const { return freedom > 0 ? std::sqrt(square_px2 / freedom) : 0; }
};

// Holds the rms of images by their index in the rig's input, per axis; NaN where they are not in use.
using ImageRms = std::vector<double>;

// Returns the mean square of every set's images, by set, over the images in use.
std::map<int, double> MeanSquares(const CalibrationInput& input, const ImageRms& rms_px) {
  std::map<int, double> sum, count;
  for (std::size_t i = 0; i < rms_px.size(); ++i) {
    if (std::isnan(rms_px[i])) continue;
    sum[input.images[i].set] += rms_px[i] * rms_px[i];
    count[input.images[i].set] += 1;
  }
  for (auto& [set, square] : sum) square /= count[set];
  return sum;
}

// Enters the rms of a calibration of all cameras, or of one alone.
void EnterRms(const CalibrationInput& input, const Calibration& calibration, std::optional<int> camera,
              ImageRms& rms_px) {
  std::vector<std::size_t> index_in_rig;
  for (std::size_t i = 0; i < input.images.size(); ++i) {
    if (!camera || input.images[i].camera == *camera) index_in_rig.push_back(i);
  }
  for (const ImageCalibration& image : calibration.images)
    rms_px[index_in_rig[static_cast<std::size_t>(image.image)]] = image.rms_px;
}

std::vector<int> ImagesOfWorstSet(const CalibrationInput& input, const ImageRms& together_px,
                                  const ImageRms& alone_px) {
  const std::map<int, double> alone = MeanSquares(input, alone_px);
  int worst_set = -1;
  double worst = 0;
  for (const auto& [set, square] : MeanSquares(input, together_px)) {
    const auto own = alone.find(set);
    if (own == alone.end() || square - own->second <= worst) continue;
    worst = square - own->second;
    worst_set = set;
  }
  std::vector<int> images;
  for (std::size_t i = 0; i < input.images.size(); ++i) {
    if (worst > 0 && input.images[i].set == worst_set) images.push_back(static_cast<int>(i));
  }
  return images;
}

std::size_t SetsInUse(const CalibrationInput& input, const Calibration& rig) {
  std::set<int> sets;
  for (const ImageCalibration& image : rig.images) {
    if (image.outliers < image.corners) sets.insert(input.images[static_cast<std::size_t>(image.image)].set);
  }
  return sets.size();
}

}  // namespace

bool RigStrain::IsStrained() const {
  return together_px * together_px - alone_px * alone_px > alone_px * alone_px;
}

CalibrationInput InputOfCamera(const CalibrationInput& rig, int camera) {
  CalibrationInput input;
  input.target = rig.target;
  input.cameras = {rig.cameras[static_cast<std::size_t>(camera)]};
  for (CalibrationImage image : rig.images) {
    if (image.camera != camera) continue;
    image.camera = 0;
    input.images.push_back(std::move(image));
  }
  return input;
}

RigStrain StrainOf(const CalibrationInput& input, const Calibration& rig, CalibrateCamerasOptions options) {
  options.lenses = {rig.lens};
  options.folds = 2;  // the least: nobody asks for held-out errors
  RigStrain strain;
  ResidualSum together, alone;
  ImageRms together_px(input.images.size(), std::numeric_limits<double>::quiet_NaN());
  ImageRms alone_px = together_px;
  together.Add(rig, SetsInUse(input, rig));
  EnterRms(input, rig, {}, together_px);
  strain.together_px = strain.alone_px = together.NoisePx();
  for (std::size_t c = 0; c < input.cameras.size(); ++c) {
    const CalibrationInput own = InputOfCamera(input, static_cast<int>(c));
    const Calibration calibration = CalibrateCameras(own, options);
    if (!calibration.converged) return strain;
    alone.Add(calibration, SetsInUse(own, calibration));
    EnterRms(input, calibration, static_cast<int>(c), alone_px);
  }
  strain.alone_px = alone.NoisePx();
  strain.worst_images = ImagesOfWorstSet(input, together_px, alone_px);
  return strain;
}

}  // namespace luxfit
