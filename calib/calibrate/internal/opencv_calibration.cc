#include "calib/calibrate/internal/opencv_calibration.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>

#include "calib/lens/internal/rotation_vector.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

constexpr std::size_t kLeastCornersForOpenCv = 6;

struct ImagePoints {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
  std::vector<std::size_t> sets;
};

// Leaves out sets with too few corners: their poses stay as they are.
ImagePoints PointsOf(const CalibrationProblem& problem) {
  ImagePoints out;
  for (std::size_t s = 0; s < static_cast<std::size_t>(problem.sets); ++s) {
    std::vector<cv::Point3f> points;
    std::vector<cv::Point2f> pixels;
    for (const CornerObservation& corner : problem.corners) {
      if (!corner.used || corner.set != static_cast<int>(s)) continue;
      const Eigen::Vector3f p =
          problem.input->target.points[static_cast<std::size_t>(corner.point)].cast<float>();
      points.emplace_back(p.x(), p.y(), p.z());
      pixels.emplace_back(static_cast<float>(corner.pixel.x()), static_cast<float>(corner.pixel.y()));
    }
    if (points.size() < kLeastCornersForOpenCv) continue;
    out.points.push_back(std::move(points));
    out.pixels.push_back(std::move(pixels));
    out.sets.push_back(s);
  }
  return out;
}

int FlagsOf(int coefficients) {
  const int start = cv::CALIB_USE_INTRINSIC_GUESS;
  if (coefficients == 4) return start | cv::CALIB_FIX_K3;
  if (coefficients == 5) return start;
  return coefficients == 8 ? start | cv::CALIB_RATIONAL_MODEL
                           : start | cv::CALIB_RATIONAL_MODEL | cv::CALIB_THIN_PRISM_MODEL;
}

// Holds OpenCV's matrices, in doubles.
struct Estimate {
  cv::Mat matrix, distortion;
  std::vector<cv::Mat> rodrigues, translations;
};

void CalibrateFisheye(const ImagePoints& seen, const cv::Size& size, Estimate& estimate) {
  std::vector<std::vector<cv::Point3d>> points;
  std::vector<std::vector<cv::Point2d>> pixels;
  for (const auto& image : seen.points) points.emplace_back(image.begin(), image.end());
  for (const auto& image : seen.pixels) pixels.emplace_back(image.begin(), image.end());
  cv::fisheye::calibrate(points, pixels, size, estimate.matrix, estimate.distortion, estimate.rodrigues,
                         estimate.translations,
                         cv::fisheye::CALIB_USE_INTRINSIC_GUESS | cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC |
                             cv::fisheye::CALIB_FIX_SKEW,
                         {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-9});
}

CalibrationState StateOf(const ImagePoints& seen, const Estimate& estimate, CalibrationState state) {
  std::vector<double>& parameters = state.intrinsics.front();
  parameters[0] = estimate.matrix.at<double>(0, 0);
  parameters[1] = estimate.matrix.at<double>(1, 1);
  parameters[2] = estimate.matrix.at<double>(0, 2);
  parameters[3] = estimate.matrix.at<double>(1, 2);
  const std::size_t count = std::min(parameters.size() - 4, estimate.distortion.total());
  for (std::size_t i = 0; i < count; ++i)
    parameters[4 + i] = estimate.distortion.at<double>(static_cast<int>(i));
  for (std::size_t i = 0; i < seen.sets.size(); ++i) {
    state.rig_from_target[seen.sets[i]] =
        PoseOf(estimate.rodrigues[i].ptr<double>(), estimate.translations[i].ptr<double>());
  }
  return state;
}

}  // namespace

bool OpenCvCanSolve(const CalibrationProblem& problem, const LensKind& kind) {
  return problem.input->cameras.size() == 1 && OpsOf(kind.lens).is_in_opencv;
}

SolvedState SolveByOpenCv(const CalibrationProblem& problem, const CalibrationState& start) {
  const ImagePoints seen = PointsOf(problem);
  if (seen.sets.size() < 2) return {false, start, "fewer than two images with six corners"};
  const CalibrationCamera& camera = problem.input->cameras.front();
  const std::vector<double>& parameters = start.intrinsics.front();
  Estimate estimate;
  estimate.matrix =
      (cv::Mat_<double>(3, 3) << parameters[0], 0, parameters[2], 0, parameters[1], parameters[3], 0, 0, 1);
  estimate.distortion = cv::Mat(std::vector<double>(parameters.begin() + 4, parameters.end()), true);
  const cv::Size size(camera.width_px, camera.height_px);
  try {
    if (!OpsOf(start.lens.kind.lens).is_pinhole) {
      CalibrateFisheye(seen, size, estimate);
    } else {
      cv::calibrateCamera(seen.points, seen.pixels, size, estimate.matrix, estimate.distortion,
                          estimate.rodrigues, estimate.translations, FlagsOf(start.lens.kind.coefficients),
                          {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-12});
    }
  } catch (const cv::Exception&) {
    return {false, start, "OpenCV's solver finds no lens of this kind for these corners"};
  }
  SolvedState solved{true, StateOf(seen, estimate, start), ""};
  solved.state.warp_m.setZero();
  if (!IsFinite(solved.state)) return {false, start, "OpenCV's fit ran away to infinity"};
  return solved;
}

}  // namespace luxfit
