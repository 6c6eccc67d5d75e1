#include "calib/targets/tags.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "calib/luminance/median.h"
#include "calib/targets/internal/boards/homography.h"
#include "calib/targets/internal/boards/solve_symmetric.h"
#include "calib/targets/internal/tags/tag_family.h"
#include "calib/targets/internal/tags/tag_image_model.h"
#include "calib/targets/internal/tags/tag_pixels.h"

namespace luxfit {
namespace {

constexpr int kHomography = 8, kShading = 6, kUnknowns = kHomography + kShading + 1;
constexpr int kBlur = kHomography + kShading;
constexpr int kFullSteps = 5;
constexpr double kConvergedPx = 3e-3;
constexpr double kLeastContrast = 0.1;  // relative to white: less is a wall, not ink on paper
constexpr double kMaxBlurPx2 = 4;       // variance: 2 px of blur erases a small tag
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Normal = Eigen::Matrix<double, kUnknowns, kUnknowns>;

// Holds the frame of undistorted image coordinates about one tag, shifted and scaled to about [-1, 1] over it
// so that the equations are well conditioned.
struct LocalFrame {
  Eigen::Vector2d origin;
  double unit = 1;

  Eigen::Vector2d FromRay(const Eigen::Vector3d& ray) const { return (ray.hnormalized() - origin) / unit; }
  Eigen::Vector3d ToRay(const Eigen::Vector2d& xy) const { return (origin + unit * xy).homogeneous(); }
};

// Returns H with H(2, 2) = 1 from four correspondences xy -> st.
std::optional<Eigen::Matrix3d> HomographyFrom(const std::array<Eigen::Vector2d, 4>& xy,
                                              const std::array<Eigen::Vector2d, 4>& st) {
  const auto homography = FitHomography({xy.begin(), xy.end()}, {st.begin(), st.end()});
  if (!homography || (*homography)(2, 2) == 0) return std::nullopt;
  return *homography / (*homography)(2, 2);
}

struct MappedPoint {
  Eigen::Vector2d st;
  Eigen::Matrix2d d_xy;
  double inverse_w = 0;
};

MappedPoint Map(const Eigen::Matrix3d& h, const Eigen::Vector2d& xy) {
  MappedPoint mapped;
  const Eigen::Vector3d p = h * xy.homogeneous();
  mapped.inverse_w = 1 / p.z();
  mapped.st = p.head<2>() * mapped.inverse_w;
  mapped.d_xy = (h.topLeftCorner<2, 2>() - mapped.st * h.bottomLeftCorner<1, 2>()) * mapped.inverse_w;
  return mapped;
}

struct TagPixel {
  double grey = 0;
  Eigen::Vector2d xy;       // middle of the pixel, in the local frame
  Eigen::Matrix2d d_pixel;  // d xy / d (u, v)
};

struct Fit {
  Eigen::Matrix3d homography;  // undistorted local coordinates to cells
  Eigen::Matrix<double, kShading, 1> shading = Eigen::Matrix<double, kShading, 1>::Zero();
  double blur_px2 = 0.05;           // not 0: at 0 the derivative of a box that ends on an edge jumps
  double residual = 0;              // robust sigma of the grey values about the model
  Normal normal = Normal::Zero();   // sum of w J^T J
  Normal scatter = Normal::Zero();  // sum of (w r)^2 J^T J
};

// Holds a pixel's area blurred by a Gaussian, as three boxes each way: side `step_px`, that far apart,
// weights w, 1 - 2 w, w. With V = 1/12 + blur (variances, px^2), x = step^2 and w = (V - x / 12) / (2 x) the
// variance is that of pixel and blur together. So is the fourth cumulant (the pixel's -1/120, since the
// Gaussian has none) where
//   27/240 x^2 - 3/2 V x + 3 V^2 - 1/120 = 0
// Without blur these are the pixel's thirds, exactly. One box of the same variance would let corners shrink
// inwards by 0.05 px at a blur of 1.2 px.
struct PixelTaps {
  double step_px = 0, d_step = 0;  // d_step: by the blur's variance
  std::array<double, 3> weights{}, d_weights{};
};

PixelTaps TapsFor(double blur_px2) {
  const double v = 1.0 / 12 + blur_px2, root = std::sqrt(0.9 * v * v + 0.00375);
  const double x = (1.5 * v - root) / 0.225, d_x = (1.5 - 0.9 * v / root) / 0.225;
  const double w = (v - x / 12) / (2 * x), d_w = (1 - d_x / 12) / (2 * x) - w * d_x / x;
  PixelTaps taps;
  taps.step_px = std::sqrt(x);
  taps.d_step = d_x / (2 * taps.step_px);
  taps.weights = {w, 1 - 2 * w, w};
  taps.d_weights = {d_w, -2 * d_w, d_w};
  return taps;
}

class TagFitter {
 public:
  TagFitter(const TagPicture& picture, std::vector<TagPixel> pixels)
      : model_(picture), half_(picture.total_cells() / 2.0), pixels_(std::move(pixels)) {}

  std::size_t pixel_count() const { return pixels_.size(); }

  // Returns the grey of one pixel, and its derivatives with respect to the unknowns.
  double Predict(const Fit& fit, const TagPixel& pixel, Unknowns& jacobian) const {
    const PixelTaps taps = TapsFor(fit.blur_px2);
    double mean = 0, d_blur = 0;
    Eigen::Vector2d st_mean = Eigen::Vector2d::Zero();
    Eigen::Matrix<double, kHomography, 1> d_h = Eigen::Matrix<double, kHomography, 1>::Zero();
    for (int i = 0; i < 9; ++i) {
      const int u = i % 3, v = i / 3;
      const Eigen::Vector2d steps(u - 1, v - 1);
      const Eigen::Vector2d xy = pixel.xy + taps.step_px * pixel.d_pixel * steps;
      const MappedPoint mapped = Map(fit.homography, xy);
      const Eigen::Matrix2d d_pixel = mapped.d_xy * pixel.d_pixel;
      // A box with the variance of the tap's parallelogram, whose sides are step_px long.
      const Eigen::Vector2d extent = d_pixel.rowwise().norm();
      const Eigen::Vector2d width = taps.step_px * extent;
      const TagImageModel::Sample sample = model_.Mean(mapped.st.x(), mapped.st.y(), width.x(), width.y());
      const double weight = taps.weights[u] * taps.weights[v];
      const double d_weight = taps.d_weights[u] * taps.weights[v] + taps.weights[u] * taps.d_weights[v];
      mean += weight * sample.mean;
      st_mean += weight * mapped.st;
      const Eigen::Vector2d d_st = taps.d_step * d_pixel * steps, d_width = taps.d_step * extent;
      d_blur +=
          d_weight * sample.mean + weight * (sample.d_s * d_st.x() + sample.d_t * d_st.y() +
                                             sample.d_width_s * d_width.x() + sample.d_width_t * d_width.y());
      const double ds = weight * sample.d_s * mapped.inverse_w, dt = weight * sample.d_t * mapped.inverse_w;
      const double along = -(ds * mapped.st.x() + dt * mapped.st.y());
      const double x = xy.x(), y = xy.y();
      Eigen::Matrix<double, kHomography, 1> term;
      term << ds * x, ds * y, ds, dt * x, dt * y, dt, along * x, along * y;
      d_h += term;
    }
    const double s = st_mean.x() / half_ - 1, t = st_mean.y() / half_ - 1;
    const double black = fit.shading[0] + fit.shading[1] * s + fit.shading[2] * t;
    const double contrast = fit.shading[3] + fit.shading[4] * s + fit.shading[5] * t;
    jacobian << contrast * d_h, 1, s, t, mean, mean * s, mean * t, contrast * d_blur;
    return black + contrast * mean;
  }

  // Fits the shading alone, which is linear; the homography and the blur stay.
  bool FitShading(Fit& fit) const {
    Eigen::Matrix<double, kShading, kShading> a = Eigen::Matrix<double, kShading, kShading>::Zero();
    Eigen::Matrix<double, kShading, 1> b = Eigen::Matrix<double, kShading, 1>::Zero();
    for (const TagPixel& pixel : pixels_) {
      Unknowns jacobian;
      Predict(fit, pixel, jacobian);
      const auto row = jacobian.segment<kShading>(kHomography);
      a += row * row.transpose();
      b += row * pixel.grey;
    }
    fit.shading = SolveSymmetric(a, b);
    return fit.shading.allFinite() && fit.shading[3] > 0;
  }

  // Takes one robust Gauss-Newton step, or a fraction of it. Returns the largest change of a tag corner, in
  // cells, or NaN.
  double Step(Fit& fit, double fraction) const {
    std::vector<double> residuals;
    std::vector<Unknowns> jacobians(pixels_.size());
    residuals.reserve(pixels_.size());
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      residuals.push_back(pixels_[i].grey - Predict(fit, pixels_[i], jacobians[i]));
    }
    fit.residual = EdgeResidual(residuals, jacobians);
    constexpr double kHuber = 2.5;
    fit.normal.setZero();
    fit.scatter.setZero();
    Unknowns right = Unknowns::Zero();
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const double size = std::abs(residuals[i]);
      const double weight = size <= kHuber * fit.residual ? 1 : kHuber * fit.residual / size;
      fit.normal.selfadjointView<Eigen::Lower>().rankUpdate(jacobians[i], weight);
      fit.scatter.selfadjointView<Eigen::Lower>().rankUpdate(jacobians[i],
                                                             std::pow(weight * residuals[i], 2));
      right += weight * residuals[i] * jacobians[i];
    }
    fit.normal = Normal(fit.normal.selfadjointView<Eigen::Lower>());
    fit.scatter = Normal(fit.scatter.selfadjointView<Eigen::Lower>());
    // Levenberg's damping only guards against an exactly flat direction. Blur is held where it would leave
    // its range.
    Normal damped = fit.normal;
    damped.diagonal() *= 1 + 1e-6;
    Unknowns step = SolveSymmetric(damped, right);
    const double blur = fit.blur_px2 + step[kBlur];
    if (blur < kMinBlurPx2 || blur > kMaxBlurPx2) {
      const double allowed = std::clamp(blur, kMinBlurPx2, kMaxBlurPx2) - fit.blur_px2;
      const Eigen::Matrix<double, kBlur, 1> reduced =
          right.head<kBlur>() - allowed * damped.topRightCorner<kBlur, 1>();
      step.head<kBlur>() = SolveSymmetric(damped.topLeftCorner<kBlur, kBlur>(), reduced);
      step[kBlur] = allowed;
    }
    if (!step.allFinite()) return std::numeric_limits<double>::quiet_NaN();
    step *= fraction;
    const Eigen::Matrix3d before = fit.homography;
    for (int i = 0; i < kHomography; ++i) fit.homography(i / 3, i % 3) += step[i];
    fit.shading += step.segment<kShading>(kHomography);
    fit.blur_px2 += step[kBlur];
    const Eigen::Matrix3d back = before * fit.homography.inverse();
    double largest = 0;
    for (const double s : {0.0, 2 * half_}) {
      for (const double t : {0.0, 2 * half_}) {
        const Eigen::Vector2d st(s, t);
        largest = std::max(largest, (Map(back, st).st - st).norm());
      }
    }
    return largest;
  }

 private:
  static constexpr double kMinBlurPx2 = 0.002;

  // Returns the robust sigma of the residuals over the pixels that edges cross. Residuals inside cells are
  // small in any fit: with them every edge of an aliased photo would count as an outlier.
  static double EdgeResidual(const std::vector<double>& residuals, const std::vector<Unknowns>& jacobians) {
    constexpr int kAlongS = 2, kAlongT = 5;  // the translations of the homography
    constexpr double kEdge = 0.25;           // relative to the steepest pixel
    double steepest = 0;
    for (const Unknowns& j : jacobians) steepest = std::max(steepest, std::hypot(j[kAlongS], j[kAlongT]));
    std::vector<double> at_edges;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const Unknowns& j = jacobians[i];
      if (std::hypot(j[kAlongS], j[kAlongT]) >= kEdge * steepest) at_edges.push_back(std::abs(residuals[i]));
    }
    constexpr double kMedianOfNormal = 0.6745;
    return std::max(Quantile(std::move(at_edges), 0.5) / kMedianOfNormal, std::numeric_limits<double>::min());
  }

  TagImageModel model_;
  double half_;
  std::vector<TagPixel> pixels_;
};

std::array<Eigen::Vector2d, 4> CornersInCells(const TagPicture& picture) {
  const double a = picture.border_begin, b = picture.border_end;
  return {Eigen::Vector2d(a, a), Eigen::Vector2d(b, a), Eigen::Vector2d(b, b), Eigen::Vector2d(a, b)};
}

Eigen::Vector2d CornerPixel(const Camera& camera, const LocalFrame& frame, const Eigen::Matrix3d& homography,
                            const Eigen::Vector2d& st) {
  return Project(camera, frame.ToRay(Map(homography.inverse(), st).st));
}

// Returns those of the chosen pixels whose whole footprint lies on the tag's picture.
std::vector<TagPixel> CollectPixels(const ImagePlane& grey, const Camera& camera, const LocalFrame& frame,
                                    const Eigen::Matrix3d& homography, int total_cells,
                                    const std::vector<Eigen::Array2i>& chosen) {
  std::vector<TagPixel> pixels;
  pixels.reserve(chosen.size());
  for (const Eigen::Array2i& place : chosen) {
    const Eigen::Vector3d ray = Unproject(camera, place.cast<double>().matrix());
    if (!ray.allFinite()) continue;
    TagPixel pixel;
    pixel.xy = frame.FromRay(ray);
    pixel.d_pixel =
        (frame.unit *
         ProjectWithJacobian(camera, ray.hnormalized().homogeneous()).d_pixel_d_point.leftCols<2>())
            .inverse();
    const MappedPoint mapped = Map(homography, pixel.xy);
    if (!(mapped.inverse_w > 0)) continue;
    // Half a pixel for the footprint, and a fifth of a cell for the error of the detector's corners.
    const Eigen::Vector2d reach =
        0.5 * (mapped.d_xy * pixel.d_pixel).cwiseAbs().rowwise().sum().array() + 0.2;
    if ((mapped.st - reach).minCoeff() < 0 || (mapped.st + reach).maxCoeff() > total_cells) continue;
    pixel.grey = static_cast<double>(grey(place.y(), place.x()));
    pixels.push_back(pixel);
  }
  return pixels;
}

// Returns the rms of the 8 corner coordinates' standard deviations. The covariance is N^-1 S N^-1 (White,
// 1980): pixels at aliased edges err far more than those inside cells, and the plain N^-1 ignores that.
double CornerSigmaPx(const Camera& camera, const LocalFrame& frame, const TagPicture& picture,
                     const Fit& fit) {
  const Normal inverse = SolveSymmetric(fit.normal, Normal::Identity());
  const Normal covariance = inverse * fit.scatter * inverse;
  Eigen::Matrix<double, 8, kHomography> d_corners;
  const std::array<Eigen::Vector2d, 4> st = CornersInCells(picture);
  for (int i = 0; i < kHomography; ++i) {
    const double step = 1e-5 * std::max(1e-3, std::abs(fit.homography(i / 3, i % 3)));
    Eigen::Matrix3d plus = fit.homography, minus = fit.homography;
    plus(i / 3, i % 3) += step;
    minus(i / 3, i % 3) -= step;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      d_corners.block<2, 1>(static_cast<Eigen::Index>(2 * corner), i) =
          (CornerPixel(camera, frame, plus, st[corner]) - CornerPixel(camera, frame, minus, st[corner])) /
          (2 * step);
    }
  }
  const Eigen::Matrix<double, kHomography, kHomography> of_homography =
      covariance.topLeftCorner<kHomography, kHomography>();
  return std::sqrt((d_corners * of_homography * d_corners.transpose()).trace() / 8);
}

std::optional<TagDetection> RefineOne(const ImagePlane& grey, const Camera& camera, const TagPicture& picture,
                                      const TagDetection& detection, const RefineTagCornersOptions& options) {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : detection.corners_px) center_px += corner / 4;
  double radius_px = 0;
  for (const Eigen::Vector2d& corner : detection.corners_px) {
    radius_px = std::max(radius_px, (corner - center_px).lpNorm<Eigen::Infinity>());
  }
  // The white border reaches past the corners; perspective may stretch it on the near side.
  radius_px = 1.5 * radius_px * picture.total_cells() / (picture.border_end - picture.border_begin) + 1;

  const Eigen::Vector3d middle = Unproject(camera, center_px);
  if (!middle.allFinite()) return std::nullopt;
  const LocalFrame frame{middle.hnormalized(), radius_px / camera.fx_px};
  std::array<Eigen::Vector2d, 4> xy;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d ray = Unproject(camera, detection.corners_px[i]);
    if (!ray.allFinite()) return std::nullopt;
    xy[i] = frame.FromRay(ray);
  }
  const std::optional<Eigen::Matrix3d> start = HomographyFrom(xy, CornersInCells(picture));
  if (!start) return std::nullopt;

  const double cells_per_px = (picture.border_end - picture.border_begin) / detection.side_px;
  const TagFitter fitter(
      picture, CollectPixels(grey, camera, frame, *start, picture.total_cells(),
                             ChooseTagPixels(grey, picture, detection.corners_px, options.max_pixels)));
  if (fitter.pixel_count() < std::size_t{5} * kUnknowns) return std::nullopt;
  Fit fit;
  fit.homography = *start;
  if (!fitter.FitShading(fit)) return std::nullopt;
  bool converged = false;
  for (int i = 0; i < options.max_iterations && !converged; ++i) {
    // The sharp picture's derivative jumps as edges pass pixel borders. Full steps then oscillate by a few
    // thousandths of a pixel; half steps settle.
    const double change_px = fitter.Step(fit, i < kFullSteps ? 1.0 : 0.5) / cells_per_px;
    if (!std::isfinite(change_px)) return std::nullopt;
    converged = change_px < kConvergedPx;
  }
  const double white = fit.shading[0] + fit.shading[3], contrast = fit.shading[3];
  if (!converged || !(fit.residual < options.max_residual * contrast)) return std::nullopt;
  if (!(contrast > kLeastContrast * white)) return std::nullopt;

  TagDetection refined = detection;
  const double max_shift_px = std::max(1.0, options.max_shift_cells / cells_per_px);
  const std::array<Eigen::Vector2d, 4> st = CornersInCells(picture);
  for (std::size_t i = 0; i < 4; ++i) {
    refined.corners_px[i] = CornerPixel(camera, frame, fit.homography, st[i]);
    if (!((refined.corners_px[i] - detection.corners_px[i]).norm() <= max_shift_px)) return std::nullopt;
  }
  refined.side_px = MeanSidePx(refined.corners_px);
  const double sigma_px = CornerSigmaPx(camera, frame, picture, fit);
  // Too few edges were left for corners better than the detector's.
  if (!(sigma_px < detection.corner_sigma_px)) return std::nullopt;
  refined.corner_sigma_px = std::max(options.min_corner_sigma_px, sigma_px);
  return refined;
}

}  // namespace

std::vector<TagDetection> RefineTagCorners(const ImagePlane& grey, const Camera& camera,
                                           const std::vector<TagDetection>& detections,
                                           const RefineTagCornersOptions& options) {
  const TagFamilyPtr family = MakeTagFamily(options.family);
  std::vector<TagDetection> refined;
  for (const TagDetection& detection : detections) {
    const TagPicture picture = DrawTag(*family, detection.id, options.border_bits);
    refined.push_back(RefineOne(grey, camera, picture, detection, options).value_or(detection));
  }
  return refined;
}

std::vector<TagDetection> FindTagCorners(const LuminanceImage& photo, const Camera& camera,
                                         const std::string& family) {
  DetectTagsOptions detect;
  detect.family = family;
  RefineTagCornersOptions refine;
  refine.family = family;
  const ImagePlane unsaturated =
      photo.saturated.select(std::numeric_limits<float>::quiet_NaN(), photo.relative_luminance);
  return RefineTagCorners(unsaturated, camera, DetectTags(photo.relative_luminance, detect), refine);
}

}  // namespace luxfit
