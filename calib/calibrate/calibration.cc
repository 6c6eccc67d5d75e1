#include "calib/calibrate/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "calib/calibrate/internal/calibration_covariance.h"
#include "calib/calibrate/internal/calibration_coverage.h"
#include "calib/calibrate/internal/calibration_seed.h"
#include "calib/calibrate/internal/calibration_state.h"
#include "calib/calibrate/internal/lens_choice.h"
#include "calib/calibrate/internal/uncertain_places.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

constexpr std::size_t kLeastCornersOfImage = 6;
constexpr int kSetsOfBend = 4;  // fewer views of a board cannot tell its bend from the lens
constexpr char kRejectedRemedy[] =
    "check that it shows this board, sharp and unmirrored; leave it out otherwise";
constexpr double kWideFieldDeg = 90;  // beyond it a fisheye lens is a candidate

void CheckOptions(const CalibrateCamerasOptions& options) {
  if (options.folds < 2 || !(options.outlier_sigmas > 0) || !(options.focal_start_px >= 0))
    throw std::invalid_argument(
        "calibration: expected at least 2 folds, outlier_sigmas > 0 and focal_start_px >= 0");
}

// Returns the field of view across the widest camera, by its seed.
double FieldOfViewDeg(const CalibrationInput& input, const CalibrationSeed& seed) {
  double widest_deg = 0;
  constexpr double kDegPerRad = 180 / M_PI;
  const CalibrationState& state = seed.is_wide ? seed.wide : seed.pinhole;
  for (std::size_t c = 0; c < input.cameras.size(); ++c) {
    const double half = input.cameras[c].width_px / 2.0 / state.intrinsics[c][0];
    widest_deg =
        std::max(widest_deg, kDegPerRad * (seed.is_wide ? 4 * std::atan(half / 2) : 2 * std::atan(half)));
  }
  return widest_deg;
}

std::vector<LensKind> CandidatesOf(const CalibrationInput& input, const CalibrationSeed& seed,
                                   const CalibrateCamerasOptions& options) {
  if (!options.lenses.empty()) return options.lenses;
  const bool is_wide = FieldOfViewDeg(input, seed) > kWideFieldDeg;
  std::vector<LensKind> kinds;
  for (const LensOps& ops : Lenses()) {
    if (ops.is_tried_on_wide_fields_only && !is_wide) continue;
    if (options.back_end == CalibrationBackEnd::kOpenCv && !ops.is_in_opencv) continue;
    for (const int size : ops.tried_sizes) kinds.push_back(KindOfSize(ops.lens, size));
  }
  const CalibrationCamera& camera = input.cameras.front();
  const double aspect = static_cast<double>(camera.height_px) / camera.width_px;
  std::stable_sort(kinds.begin(), kinds.end(), [aspect](const LensKind& a, const LensKind& b) {
    return ParameterCount(a, aspect) < ParameterCount(b, aspect);
  });
  return kinds;
}

std::string ShortName(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

// Returns the input without the images that the seed could not place, and notes each of them.
CalibrationInput WithoutLost(CalibrationInput input, const CalibrationSeed& seed,
                             std::vector<CalibrationNote>& notes) {
  for (std::size_t i = 0; i < input.images.size(); ++i) {
    CalibrationImage& image = input.images[i];
    if (image.corners.empty() || seed.image_found[i]) continue;
    const bool is_poor = image.corners.size() < kLeastCornersOfImage;
    notes.push_back({"image_rejected", false,
                     fmt::format("{}: its {} corners {}", ShortName(image.name), image.corners.size(),
                                 is_poor ? "are too few for a pose" : "fit no view of the target"),
                     is_poor ? "come nearer, or leave it out" : kRejectedRemedy});
    image.corners.clear();
  }
  return input;
}

// Notes the images of the sets that the fit left out whole.
void NoteLeftOut(const CalibrationInput& input, Calibration& out) {
  const auto set_of = [&](const ImageCalibration& image) {
    return input.images[static_cast<std::size_t>(image.image)].set;
  };
  std::set<int> in_use;
  for (const ImageCalibration& image : out.images) {
    if (image.outliers < image.corners) in_use.insert(set_of(image));
  }
  for (const ImageCalibration& image : out.images) {
    if (in_use.count(set_of(image)) > 0) continue;
    const std::string& name = input.images[static_cast<std::size_t>(image.image)].name;
    out.notes.push_back(
        {"image_rejected", false,
         fmt::format("{}: too few of its {} corners fit for a pose", ShortName(name), image.corners),
         kRejectedRemedy});
  }
}

std::vector<Eigen::Vector2d> PixelsOf(const std::vector<CoveringImage>& images) {
  std::vector<Eigen::Vector2d> pixels;
  for (const CoveringImage& image : images) {
    for (const BoardCorner& corner : image.corners) pixels.push_back(corner.pixel);
  }
  return pixels;
}

class ResultWriter {
 public:
  ResultWriter(const CalibrationProblem& problem, const LensCandidate& chosen, bool warp,
               const CalibrateCamerasOptions& options)
      : problem_(problem), fit_(chosen.fit), options_(options), warp_(warp) {
    for (std::size_t k = 0; k < problem_.corners.size(); ++k) problem_.corners[k].used = fit_.used[k];
  }

  void Write(Calibration& out) const {
    WriteResiduals(out);
    const CalibrationCovariance covariance = CovarianceOf(
        problem_, fit_.state, LinearizeCalibration(problem_, fit_.state, {true, warp_}), fit_.noise_px);
    out.board_bend_m = fit_.state.warp_m;
    out.board_bend_sigma_m = covariance.warp_sigma_m;
    for (std::size_t c = 0; c < problem_.input->cameras.size(); ++c) WriteCamera(c, covariance, out);
  }

 private:
  Eigen::Isometry3d CamFromTarget(int camera, int set) const {
    return fit_.state.cam_from_rig[static_cast<std::size_t>(camera)] *
           fit_.state.rig_from_target[static_cast<std::size_t>(set)];
  }

  void WriteResiduals(Calibration& out) const {
    double sum = 0;
    int used = 0;
    for (std::size_t k = 0; k < problem_.corners.size(); ++k) {
      const CornerObservation& corner = problem_.corners[k];
      const Eigen::Vector2d residual = fit_.residuals.col(static_cast<Eigen::Index>(k));
      if (out.images.empty() || out.images.back().image != corner.image) {
        out.images.push_back({});
        out.images.back().image = corner.image;
        out.images.back().cam_from_target = CamFromTarget(corner.camera, corner.set);
      }
      ImageCalibration& image = out.images.back();
      out.corners.push_back({corner.image, corner.point, residual, !corner.used});
      ++image.corners;
      if (!corner.used) {
        ++image.outliers;
        continue;
      }
      image.rms_px += residual.squaredNorm();
      sum += residual.squaredNorm();
      ++used;
    }
    for (ImageCalibration& image : out.images) {
      const int in_use = image.corners - image.outliers;
      image.rms_px = in_use > 0 ? std::sqrt(image.rms_px / (2 * in_use)) : 0;
    }
    out.rms_px = used > 0 ? std::sqrt(sum / (2 * used)) : 0;
    out.rms_2d_px = std::sqrt(2.0) * out.rms_px;
    out.noise_px = fit_.noise_px;
    out.outlier_share = 1 - static_cast<double>(used) / static_cast<double>(problem_.corners.size());
  }

  void WriteCamera(std::size_t c, const CalibrationCovariance& covariance, Calibration& out) const {
    const CalibrationCamera& given = problem_.input->cameras[c];
    CalibratedCamera camera;
    camera.id = given.id;
    camera.camera = CameraOf(fit_.state.lens, fit_.state.intrinsics[c], given.width_px, given.height_px);
    camera.cam_from_rig = fit_.state.cam_from_rig[c];
    camera.cam_from_rig_covariance = covariance.cam_from_rig[c];
    camera.uncertainty = covariance.cameras[c];
    const std::vector<CoveringImage> images = CoveringImages(static_cast<int>(c));
    camera.circle = CircleOf(camera.camera, PixelsOf(images), given.brightest);
    camera.coverage = CoverageOf(problem_.input->target, given, camera.circle, images);
    WriteUncertainPlaces(options_.gates.max_sigma_px, camera);
    out.cameras.push_back(std::move(camera));
  }

  std::vector<CoveringImage> CoveringImages(int camera) const {
    std::vector<CoveringImage> images;
    int image = -1;
    for (const CornerObservation& corner : problem_.corners) {
      if (corner.camera != camera || !corner.used) continue;
      if (corner.image != image) images.push_back({{}, CamFromTarget(camera, corner.set)});
      image = corner.image;
      images.back().corners.push_back({corner.point, corner.pixel, 0});
    }
    return images;
  }

  CalibrationProblem problem_;
  const LensFit& fit_;
  const CalibrateCamerasOptions& options_;
  bool warp_;
};

// Returns whether the fitted bend is more than its own uncertainty explains (three sigma).
bool IsBent(const Calibration& result) {
  return (result.board_bend_m.array().abs() > 3 * result.board_bend_sigma_m.array()).any();
}

std::vector<LensScore> ScoresOf(const LensChoice& choice) {
  std::vector<LensScore> scores;
  for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
    const LensCandidate& candidate = choice.candidates[i];
    LensScore score;
    score.kind = candidate.kind;
    score.is_fitted = candidate.fit.ok;
    score.verdict =
        candidate.fit.ok ? (static_cast<int>(i) == choice.chosen ? "chosen" : "") : candidate.fit.message;
    score.held_out_px = candidate.score.PerAxisPx();
    double sum = 0;
    int used = 0;
    for (std::size_t k = 0; candidate.fit.ok && k < candidate.fit.used.size(); ++k) {
      if (candidate.fit.used[k])
        sum += candidate.fit.residuals.col(static_cast<Eigen::Index>(k)).squaredNorm();
      used += candidate.fit.used[k] ? 1 : 0;
    }
    score.rms_px = used > 0 ? std::sqrt(sum / (2 * used)) : 0;
    score.outliers = static_cast<int>(candidate.fit.used.size()) - used;
    scores.push_back(score);
  }
  return scores;
}

// Writes the chosen fit into the result, refitted with a flat board where the bend is not significant.
void WriteResult(const CalibrationProblem& problem, const LensCandidate& chosen, LensFitOptions fit_options,
                 const CalibrateCamerasOptions& options, Calibration& out) {
  Calibration bent = out;
  ResultWriter(problem, chosen, fit_options.warp, options).Write(bent);
  if (fit_options.warp && !IsBent(bent)) {
    LensCandidate flat = chosen;
    flat.fit.state.warp_m.setZero();
    fit_options.warp = false;
    flat.fit = FitFrom(problem, flat.fit.state, fit_options);
    if (flat.fit.ok) {
      ResultWriter(problem, flat, false, options).Write(out);
      out.board_bend_sigma_m = bent.board_bend_sigma_m;
      return;
    }
  }
  out = std::move(bent);
}

void JudgeCamera(const CalibratedCamera& camera, const CalibrationGates& gates,
                 std::vector<CalibrationNote>& notes) {
  // Outside its circle nothing can be seen, nor photographed.
  const std::string whole = camera.circle.IsWholePicture() ? "image" : "image circle";
  const std::string photograph = fmt::format(
      "photograph the target so that its corners reach every part of the {}, tilted and at two distances",
      whole);
  if (camera.uncertain_share > gates.max_uncertain_share) {
    notes.push_back({"uncertain_projection", true,
                     fmt::format("{}: projections are uncertain by more than {:g} px over {:.0f} % of the {} "
                                 "(median {:.2g} px), in {}",
                                 camera.id, gates.max_sigma_px, 100 * camera.uncertain_share, whole,
                                 camera.median_sigma_px, camera.uncertain_places),
                     photograph});
  } else if (camera.uncertain_share > 0) {
    notes.push_back(
        {"uncertain_corners", false,
         fmt::format("{}: projections are uncertain by more than {:g} px over {:.1f} % of the {}, in {}",
                     camera.id, gates.max_sigma_px, 100 * camera.uncertain_share, whole,
                     camera.uncertain_places),
         fmt::format("do not rely on these parts of the {} (see the uncertainty map), or {}", whole,
                     photograph)});
  }
  const bool is_covered = camera.coverage.covered_share >= gates.min_covered_share;
  const bool is_tilted = !camera.coverage.is_flat || camera.coverage.max_tilt_deg >= gates.min_tilt_deg;
  for (const std::string& lack : camera.coverage.lacks) {
    const bool is_about_tilt = lack.find("tilted") != std::string::npos;
    const bool is_about_place = lack.find("third") != std::string::npos;
    notes.push_back({"coverage", (is_about_tilt && !is_tilted) || (is_about_place && !is_covered),
                     camera.id + ": " + lack, photograph});
  }
  if (!is_covered && camera.coverage.lacks.empty())
    notes.push_back({"coverage", true,
                     fmt::format("{}: only {:.0f} % of the {}'s cells hold a corner", camera.id,
                                 100 * camera.coverage.covered_share, whole),
                     photograph});
}

void Judge(const CalibrationInput& input, const CalibrationGates& gates, Calibration& out) {
  if (std::isnan(out.held_out_px)) {
    out.notes.push_back({"few_images", true, "too few images to hold any out: nothing checks the fit",
                         "photograph the target at least 8 times, tilted differently"});
  } else if (out.held_out_px > gates.max_held_out_px) {
    out.notes.push_back(
        {"held_out_error", true,
         fmt::format("images held out of the fit are off by {:.2f} px per axis, more than {:g}",
                     out.held_out_px, gates.max_held_out_px),
         "check the target's size and flatness, and the photos' sharpness; try a splined lens"});
  } else if (out.held_out_px > gates.max_held_out_ratio * out.noise_px) {
    out.notes.push_back({"held_out_error", true,
                         fmt::format("images held out of the fit are off by {:.2f} px per axis, {:.1f} times "
                                     "those of the fit: too few images for this lens",
                                     out.held_out_px, out.held_out_px / out.noise_px),
                         "add images, or ask for a lens of fewer parameters"});
  }
  for (const CalibratedCamera& camera : out.cameras) JudgeCamera(camera, gates, out.notes);
  if (out.outlier_share > gates.questioned_outliers) {
    const auto outliers_of = [](const ImageCalibration& i) {
      return static_cast<double>(i.outliers) / i.corners;
    };
    const auto worst = std::max_element(out.images.begin(), out.images.end(),
                                        [&](const ImageCalibration& a, const ImageCalibration& b) {
                                          return outliers_of(a) < outliers_of(b);
                                        });
    out.notes.push_back(
        {"outliers", out.outlier_share > gates.max_outliers,
         fmt::format(
             "{:.1f} % of the corners were left out, most in {} ({} of {}); a good set has under {:g} %",
             100 * out.outlier_share, ShortName(input.images[static_cast<std::size_t>(worst->image)].name),
             worst->outliers, worst->corners, 100 * gates.questioned_outliers),
         std::string(
             "look at the images with most outliers: blur, a bent target, reflections, a wrong target") +
             (input.cameras.size() > 1 ? ", or images paired that were not taken together" : "")});
  }
}

}  // namespace

bool Calibration::IsUsable() const {
  return converged &&
         std::none_of(notes.begin(), notes.end(), [](const CalibrationNote& n) { return n.fails; });
}

Calibration CalibrateCameras(const CalibrationInput& given, const CalibrateCamerasOptions& options) {
  CheckCalibrationInput(given);
  CheckOptions(options);
  Calibration out;
  CalibrationProblem problem = MakeProblem(given);
  CalibrationSeed seed = SeedCalibration(problem, options.focal_start_px);
  CalibrationInput input = given;
  if (seed.ok &&
      std::find(seed.image_found.begin(), seed.image_found.end(), false) != seed.image_found.end()) {
    input = WithoutLost(std::move(input), seed, out.notes);
    problem = MakeProblem(input);
    seed = SeedCalibration(problem, options.focal_start_px);
  }
  if (!seed.ok) {
    out.message = seed.message;
    out.notes.push_back({"not_determined", true, seed.message, seed.remedy});
    return out;
  }
  LensFitOptions fit_options;
  fit_options.back_end = options.back_end;
  fit_options.outlier_sigmas = options.outlier_sigmas;
  fit_options.warp = options.board_may_bend && input.target.IsGrid() && problem.sets >= kSetsOfBend &&
                     options.back_end == CalibrationBackEnd::kMrcal;
  const LensChoice choice =
      ChooseLens(problem, seed, CandidatesOf(input, seed, options), options.folds, fit_options);
  out.lenses = ScoresOf(choice);
  out.lens_because = choice.because;
  if (choice.chosen < 0) {
    out.message =
        choice.because + (choice.candidates.empty() ? "" : ": " + choice.candidates.front().fit.message);
    out.notes.push_back({"not_determined", true, out.message,
                         "photograph the target at least 8 times, all over the image and tilted"});
    return out;
  }
  const LensCandidate& chosen = choice.candidates[static_cast<std::size_t>(choice.chosen)];
  out.lens = chosen.kind;
  out.held_out_px = chosen.score.PerAxisPx();
  out.converged = true;
  WriteResult(problem, chosen, fit_options, options, out);
  NoteLeftOut(input, out);
  Judge(input, options.gates, out);
  return out;
}

}  // namespace luxfit
