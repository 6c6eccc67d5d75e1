#include "calib/calibrate/internal/calibration_seed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "calib/calibrate/internal/target_pose.h"

namespace luxfit {
namespace {

constexpr double kFocalStep = 1.25;
constexpr double kSeedGateOfDiagonal = 0.02;  // the most that distortion may amount to while it is not fitted
constexpr double kScaleOfDiagonal = 0.005;    // scale of the loss
constexpr std::size_t kImagesOfScan = 8;
constexpr int kStepsOfScan = 8, kStepsOfPose = 30;
constexpr int kLeastCorners = 6;
// A wide lens is chosen only where its cost is below this share of a pinhole's.
constexpr double kWideGain = 0.8;

// Holds the corners of one image in the form that the pose estimate takes.
struct SeenImage {
  int image = 0, camera = 0, set = 0;
  std::vector<SeenPoint> points;
};

std::vector<SeenImage> CornersByImage(const CalibrationProblem& problem) {
  std::vector<SeenImage> images;
  for (const CornerObservation& corner : problem.corners) {
    if (images.empty() || images.back().image != corner.image)
      images.push_back({corner.image, corner.camera, corner.set, {}});
    SeenPoint seen;
    seen.point = TargetPoint(problem.input->target, corner.point, Eigen::Vector2d::Zero());
    seen.pixel = corner.pixel;
    seen.weight = corner.weight;
    images.back().points.push_back(seen);
  }
  return images;
}

LensKind KindOf(bool is_wide) {
  return is_wide ? LensKind{LensModel::kSplined, 0, 0} : LensKind{LensModel::kOpenCv, 4, 0};
}

// Holds one camera with a guessed focal length.
struct GuessedCamera {
  Camera camera;
  LensFunction lens;
  std::vector<double> parameters;
  double gate_px = 0, scale_px = 0;
};

GuessedCamera Guess(const CalibrationCamera& size, bool is_wide, double focal_px) {
  GuessedCamera guess;
  guess.camera.width_px = size.width_px;
  guess.camera.height_px = size.height_px;
  guess.camera.fx_px = guess.camera.fy_px = focal_px;
  guess.camera.cx_px = (size.width_px - 1) / 2.0;
  guess.camera.cy_px = (size.height_px - 1) / 2.0;
  guess.camera.lens = KindOf(is_wide).lens;
  guess.lens = MakeLensFunction(KindOf(is_wide), guess.camera);
  guess.parameters = ParametersOf(guess.lens, guess.camera);
  const double diagonal_px = std::hypot(size.width_px, size.height_px);
  guess.gate_px = kSeedGateOfDiagonal * diagonal_px;
  guess.scale_px = kScaleOfDiagonal * diagonal_px;
  return guess;
}

struct PlacedImage {
  Eigen::Isometry3d cam_from_target = Eigen::Isometry3d::Identity();
  double cost_px2 = std::numeric_limits<double>::infinity();
};

PlacedImage Place(const GuessedCamera& guess, std::vector<SeenPoint> points, int steps) {
  for (SeenPoint& seen : points) seen.parameters = &guess.parameters;
  PlacedImage best;
  for (const Eigen::Isometry3d& start : PoseStarts(guess.camera, points, guess.gate_px)) {
    const Eigen::Isometry3d pose = RefinePose(guess.lens, points, start, guess.scale_px, steps);
    const double cost_px2 = CappedCost(guess.lens, points, pose, guess.gate_px);
    if (cost_px2 < best.cost_px2) best = {pose, cost_px2};
  }
  // Finding no pose costs as much as a pose with all corners wrong.
  best.cost_px2 = std::min(best.cost_px2, guess.gate_px * guess.gate_px * static_cast<double>(points.size()));
  return best;
}

// Returns some of a camera's images, spread evenly over all of them.
std::vector<const SeenImage*> ScanImages(const std::vector<SeenImage>& images, int camera) {
  std::vector<const SeenImage*> own;
  for (const SeenImage& image : images) {
    if (image.camera == camera && image.points.size() >= kLeastCorners) own.push_back(&image);
  }
  std::vector<const SeenImage*> some;
  const std::size_t count = std::min(own.size(), kImagesOfScan);
  for (std::size_t i = 0; i < count; ++i) some.push_back(own[i * own.size() / count]);
  return some;
}

struct ScannedFocal {
  double focal_px = 0;
  double cost_px2 = std::numeric_limits<double>::infinity();
};

ScannedFocal ScanFocal(const CalibrationCamera& size, const std::vector<const SeenImage*>& images,
                       bool is_wide, double focal_start_px) {
  const double widest = is_wide ? 0.12 : 0.2, longest = is_wide ? 1.5 : 8;
  const double from = focal_start_px > 0 ? focal_start_px / 2 : widest * size.width_px;
  const double to = focal_start_px > 0 ? focal_start_px * 2 : longest * size.width_px;
  ScannedFocal best;
  for (double focal_px = from; focal_px <= to; focal_px *= kFocalStep) {
    const GuessedCamera guess = Guess(size, is_wide, focal_px);
    double cost_px2 = 0;
    for (const SeenImage* image : images) {
      cost_px2 += Place(guess, image->points, kStepsOfScan).cost_px2;
      if (cost_px2 >= best.cost_px2) break;
    }
    if (cost_px2 < best.cost_px2) best = {focal_px, cost_px2};
  }
  return best;
}

// Holds the poses of a camera relative to one that is placed, from the sets that both share.
struct SharedSets {
  std::vector<std::pair<const SeenImage*, Eigen::Isometry3d>> images;  // the camera's; pose of the other
  std::vector<Eigen::Isometry3d> candidates;                           // camera from the other
};

Eigen::Isometry3d BestCandidate(const GuessedCamera& guess, const SharedSets& shared) {
  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  double best_px2 = std::numeric_limits<double>::infinity();
  for (const Eigen::Isometry3d& candidate : shared.candidates) {
    double cost_px2 = 0;
    for (const auto& [image, other_from_target] : shared.images) {
      std::vector<SeenPoint> points = image->points;
      for (SeenPoint& seen : points) seen.parameters = &guess.parameters;
      cost_px2 += CappedCost(guess.lens, points, candidate * other_from_target, guess.gate_px);
    }
    if (cost_px2 < best_px2) {
      best_px2 = cost_px2;
      best = candidate;
    }
  }
  return best;
}

class RigJoiner {
 public:
  RigJoiner(const std::vector<SeenImage>& images, const std::vector<PlacedImage>& placed,
            const std::vector<GuessedCamera>& guesses, std::vector<bool> found)
      : images_(images), placed_(placed), guesses_(guesses), found_(std::move(found)) {
    cam_from_rig_.resize(guesses.size());
    cam_from_rig_[0] = Eigen::Isometry3d::Identity();
  }

  // Returns nothing where a camera shares no set with the others.
  std::optional<std::vector<Eigen::Isometry3d>> Join() {
    for (std::size_t joined = 1; joined < guesses_.size(); ++joined) {
      std::size_t next = 0;
      SharedSets best;
      int reference = -1;
      for (std::size_t c = 1; c < guesses_.size(); ++c) {
        for (std::size_t other = 0; other < guesses_.size() && !cam_from_rig_[c]; ++other) {
          if (!cam_from_rig_[other]) continue;
          SharedSets shared = Shared(static_cast<int>(c), static_cast<int>(other));
          if (shared.images.size() <= best.images.size()) continue;
          best = std::move(shared);
          next = c;
          reference = static_cast<int>(other);
        }
      }
      if (reference < 0) return std::nullopt;
      cam_from_rig_[next] =
          BestCandidate(guesses_[next], best) * *cam_from_rig_[static_cast<std::size_t>(reference)];
    }
    std::vector<Eigen::Isometry3d> poses;
    for (const std::optional<Eigen::Isometry3d>& pose : cam_from_rig_) poses.push_back(*pose);
    return poses;
  }

 private:
  SharedSets Shared(int camera, int other) const {
    std::map<int, std::size_t> image_of_set;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      if (images_[i].camera == other && found_[i]) image_of_set[images_[i].set] = i;
    }
    SharedSets shared;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      const auto match = image_of_set.find(images_[i].set);
      if (images_[i].camera != camera || !found_[i] || match == image_of_set.end()) continue;
      const Eigen::Isometry3d& other_from_target = placed_[match->second].cam_from_target;
      shared.images.push_back({&images_[i], other_from_target});
      shared.candidates.push_back(placed_[i].cam_from_target * other_from_target.inverse());
    }
    return shared;
  }

  const std::vector<SeenImage>& images_;
  const std::vector<PlacedImage>& placed_;
  const std::vector<GuessedCamera>& guesses_;
  std::vector<bool> found_;
  std::vector<std::optional<Eigen::Isometry3d>> cam_from_rig_;
};

// Counts the corners of an image that a pose explains.
std::size_t CornersNear(const GuessedCamera& guess, const SeenImage& image, const Eigen::Isometry3d& pose) {
  std::size_t near = 0;
  for (const SeenPoint& seen : image.points) {
    const Eigen::Vector2d pixel =
        ProjectByLens(guess.lens, guess.parameters.data(), pose * seen.point, false).pixel;
    near += (pixel - seen.pixel).norm() < guess.gate_px ? 1 : 0;
  }
  return near;
}

// Returns whether the rig explains the corners that each image's own pose explains. Where two cameras share a
// set, one of them gave the set's pose, so half of the corners prove nothing.
bool IsBorneOut(const std::vector<GuessedCamera>& guesses, const std::vector<SeenImage>& images,
                const std::vector<PlacedImage>& placed, const CalibrationState& state) {
  constexpr double kLeastShare = 0.8;
  std::size_t own = 0, by_rig = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto camera = static_cast<std::size_t>(images[i].camera),
               set = static_cast<std::size_t>(images[i].set);
    own += CornersNear(guesses[camera], images[i], placed[i].cam_from_target);
    by_rig +=
        CornersNear(guesses[camera], images[i], state.cam_from_rig[camera] * state.rig_from_target[set]);
  }
  return static_cast<double>(by_rig) >= kLeastShare * static_cast<double>(own);
}

struct FamilySeed {
  CalibrationState state;
  double cost_px2 = 0;
  std::vector<bool> found;  // by CornersByImage
  bool is_joined = false;
};

FamilySeed SeedFamily(const CalibrationProblem& problem, const std::vector<SeenImage>& images,
                      const std::vector<double>& focal_px, bool is_wide) {
  FamilySeed seed;
  std::vector<GuessedCamera> guesses;
  for (std::size_t c = 0; c < focal_px.size(); ++c) {
    guesses.push_back(Guess(problem.input->cameras[c], is_wide, focal_px[c]));
    seed.state.intrinsics.push_back(guesses.back().parameters);
  }
  seed.state.lens = guesses.front().lens;
  std::vector<PlacedImage> placed;
  placed.reserve(images.size());
  for (const SeenImage& image : images) {
    const GuessedCamera& guess = guesses[static_cast<std::size_t>(image.camera)];
    placed.push_back(Place(guess, image.points, kStepsOfPose));
    const double most_px2 = guess.gate_px * guess.gate_px * static_cast<double>(image.points.size());
    seed.cost_px2 += placed.back().cost_px2;
    seed.found.push_back(image.points.size() >= kLeastCorners && placed.back().cost_px2 < 0.6 * most_px2);
  }
  const auto poses = RigJoiner(images, placed, guesses, seed.found).Join();
  seed.is_joined = poses.has_value();
  if (!seed.is_joined) return seed;
  seed.state.cam_from_rig = *poses;
  seed.state.rig_from_target.assign(static_cast<std::size_t>(problem.sets), Eigen::Isometry3d::Identity());
  std::vector<std::size_t> most(static_cast<std::size_t>(problem.sets), 0);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto set = static_cast<std::size_t>(images[i].set),
               camera = static_cast<std::size_t>(images[i].camera);
    if (!seed.found[i] || images[i].points.size() <= most[set]) continue;
    most[set] = images[i].points.size();
    seed.state.rig_from_target[set] = (*poses)[camera].inverse() * placed[i].cam_from_target;
  }
  seed.is_joined = IsBorneOut(guesses, images, placed, seed.state);
  return seed;
}

}  // namespace

CalibrationSeed SeedCalibration(const CalibrationProblem& problem, double focal_start_px) {
  const std::vector<SeenImage> images = CornersByImage(problem);
  const CalibrationInput& input = *problem.input;
  CalibrationSeed seed;
  seed.image_found.assign(input.images.size(), false);
  std::vector<double> pinhole_px, wide_px;
  for (std::size_t c = 0; c < input.cameras.size(); ++c) {
    const std::vector<const SeenImage*> some = ScanImages(images, static_cast<int>(c));
    if (some.empty()) {
      seed.message = "camera " + input.cameras[c].id + " has no image with " + std::to_string(kLeastCorners) +
                     " corners or more";
      seed.remedy = "check the board's type, columns and rows, and that photos are sharp and show it whole";
      return seed;
    }
    pinhole_px.push_back(ScanFocal(input.cameras[c], some, false, focal_start_px).focal_px);
    wide_px.push_back(ScanFocal(input.cameras[c], some, true, focal_start_px).focal_px);
  }
  const FamilySeed pinhole = SeedFamily(problem, images, pinhole_px, false);
  const FamilySeed wide = SeedFamily(problem, images, wide_px, true);
  if (!pinhole.is_joined && !wide.is_joined) {
    seed.message = "the cameras share no sets of images, or do not stand still against each other";
    seed.remedy = "photograph the board where two cameras see it at once, and check how images are paired";
    return seed;
  }
  seed.is_wide = !pinhole.is_joined || (wide.is_joined && wide.cost_px2 < kWideGain * pinhole.cost_px2);
  const FamilySeed& better = seed.is_wide ? wide : pinhole;
  for (std::size_t i = 0; i < images.size(); ++i)
    seed.image_found[static_cast<std::size_t>(images[i].image)] = better.found[i];
  seed.pinhole = pinhole.state;
  seed.wide = wide.state;
  CalibrationState& worse = seed.is_wide ? seed.pinhole : seed.wide;
  if (!(seed.is_wide ? pinhole : wide).is_joined) {
    worse.cam_from_rig = better.state.cam_from_rig;
    worse.rig_from_target = better.state.rig_from_target;
  }
  seed.ok = true;
  return seed;
}

}  // namespace luxfit
