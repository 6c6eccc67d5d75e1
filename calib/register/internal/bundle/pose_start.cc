#include "calib/register/internal/bundle/pose_start.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <utility>

#include "calib/lens/internal/rotation_vector.h"
#include "calib/register/internal/bundle/pose_refine.h"

namespace luxfit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Returns the sigma of a corner: its own error, the survey's seen from here, and the lens model's.
double CornerSigmaPx(const TagObservation& tag, const PoseStartOptions& options) {
  const double survey_px = options.survey_sigma_m / tag.size_m * tag.side_px;
  return std::sqrt(tag.sigma_px * tag.sigma_px + survey_px * survey_px +
                   options.model_sigma_px * options.model_sigma_px);
}

double Chi2(const Camera& camera, const Eigen::Isometry3d& cam_from_world,
            const std::vector<TagObservation>& tags, const PoseStartOptions& options) {
  double chi2 = 0;
  for (const TagObservation& tag : tags) {
    chi2 += 4 * std::pow(TagRmsPx(camera, cam_from_world, tag) / CornerSigmaPx(tag, options), 2);
  }
  return chi2;
}

// Returns the directions of least to most extent (columns) of points about their centroid, and the mean
// squares along them.
Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> PrincipalAxes(const std::vector<cv::Point3d>& points) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const cv::Point3d& p : points)
    scatter += Eigen::Vector3d(p.x, p.y, p.z) * Eigen::RowVector3d(p.x, p.y, p.z);
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter);
}

// Returns the points moved to their best plane: OpenCV's IPPE refuses points that a survey put a millimetre
// off.
std::vector<cv::Point3d> Flattened(std::vector<cv::Point3d> points) {
  const Eigen::Vector3d normal = PrincipalAxes(points).eigenvectors().col(0);
  for (cv::Point3d& p : points) {
    const Eigen::Vector3d at(p.x, p.y, p.z), flat = at - normal.dot(at) * normal;
    p = {flat.x(), flat.y(), flat.z()};
  }
  return points;
}

// Returns the methods that suit points of this flatness. Closer to a plane than 1/200 of their extent, they
// carry no more information across it than noise does. Up to 1/20 the two poses of the plane are tried, too.
std::vector<cv::SolvePnPMethod> MethodsFor(const std::vector<cv::Point3d>& points) {
  const Eigen::Vector3d spread = PrincipalAxes(points).eigenvalues();
  const double flatness = std::sqrt(std::max(0.0, spread[0]) / spread[2]);
  if (flatness < 0.005) return {cv::SOLVEPNP_IPPE};
  if (flatness < 0.05) return {cv::SOLVEPNP_SQPNP, cv::SOLVEPNP_IPPE};
  return {cv::SOLVEPNP_SQPNP};
}

bool IsSamePose(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  constexpr double kSameAngle = 0.01;  // rad; the two solutions of a plane lie several degrees apart or merge
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle() < kSameAngle;
}

// Returns the method's solutions, each refined. `centroid` is the shift that was taken from the points.
std::vector<Eigen::Isometry3d> Solve(const std::vector<cv::Point3d>& points,
                                     const std::vector<cv::Point2d>& rays, const Eigen::Vector3d& centroid,
                                     cv::SolvePnPMethod method) {
  const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
  std::vector<cv::Mat> rotations, translations;
  std::vector<Eigen::Isometry3d> poses;
  try {
    cv::solvePnPGeneric(method == cv::SOLVEPNP_IPPE ? Flattened(points) : points, rays, identity,
                        cv::noArray(), rotations, translations, false, method);
    for (std::size_t i = 0; i < rotations.size(); ++i) {
      poses.push_back(
          RefinePose(points, rays, PoseOf(rotations[i].ptr<double>(), translations[i].ptr<double>())));
      poses.back().translation() -= poses.back().linear() * centroid;
    }
  } catch (const cv::Exception&) {
    return {};  // degenerate points (all on a line): no solution rather than a wrong one
  }
  return poses;
}

double TolerancePx(const TagObservation& tag, const PoseStartOptions& options) {
  return 6 * CornerSigmaPx(tag, options) + options.agreement_fraction * tag.side_px;
}

struct Consensus {
  std::vector<bool> agrees;
  int count = 0;
  double cost = kInfinity;  // sum of squared errors in units of the tolerance, capped at 1 a tag
};

Consensus CountAgreeing(const Camera& camera, const Eigen::Isometry3d& cam_from_world,
                        const std::vector<TagObservation>& tags, const PoseStartOptions& options) {
  Consensus consensus;
  consensus.cost = 0;
  for (const TagObservation& tag : tags) {
    const double error = TagRmsPx(camera, cam_from_world, tag) / TolerancePx(tag, options);
    consensus.agrees.push_back(error <= 1);
    consensus.count += error <= 1 ? 1 : 0;
    consensus.cost += std::min(1.0, error * error);
  }
  return consensus;
}

bool IsBetter(const Consensus& a, const Consensus& b) {
  return a.count > b.count || (a.count == b.count && a.cost < b.cost);
}

Consensus BestPair(const Camera& camera, const std::vector<TagObservation>& tags,
                   const PoseStartOptions& options) {
  Consensus best;
  // Where all agree, no other pair can do better; the pose is fitted again to all of them anyway.
  const auto all = static_cast<int>(tags.size());
  for (std::size_t i = 0; i < tags.size() && best.count < all; ++i) {
    for (std::size_t j = i + 1; j < tags.size() && best.count < all; ++j) {
      for (const PoseCandidate& candidate : PoseCandidates(camera, {tags[i], tags[j]}, options)) {
        const Consensus consensus = CountAgreeing(camera, candidate.cam_from_world, tags, options);
        if (IsBetter(consensus, best)) best = consensus;
      }
    }
  }
  return best;
}

std::vector<TagObservation> Selected(const std::vector<TagObservation>& tags,
                                     const std::vector<bool>& agrees) {
  std::vector<TagObservation> selected;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (agrees[i]) selected.push_back(tags[i]);
  }
  return selected;
}

}  // namespace

std::vector<PoseCandidate> PoseCandidates(const Camera& camera, const std::vector<TagObservation>& tags,
                                          const PoseStartOptions& options) {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const TagObservation& tag : tags) {
    for (const Eigen::Vector3d& p : tag.corners_in_world)
      centroid += p / (4.0 * static_cast<double>(tags.size()));
  }
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> rays;
  for (const TagObservation& tag : tags) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d p = tag.corners_in_world[i] - centroid;
      const Eigen::Vector3d ray = Unproject(camera, tag.corners_px[i]);
      if (!ray.allFinite() || !(ray.z() > 0)) return {};
      points.emplace_back(p.x(), p.y(), p.z());
      rays.emplace_back(ray.x() / ray.z(), ray.y() / ray.z());
    }
  }
  std::vector<PoseCandidate> candidates;
  for (const cv::SolvePnPMethod method : MethodsFor(points)) {
    for (const Eigen::Isometry3d& pose : Solve(points, rays, centroid, method)) {
      const bool seen =
          std::any_of(candidates.begin(), candidates.end(),
                      [&pose](const PoseCandidate& other) { return IsSamePose(other.cam_from_world, pose); });
      const double chi2 = seen ? kInfinity : Chi2(camera, pose, tags, options);
      if (std::isfinite(chi2)) candidates.push_back({pose, chi2});
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const PoseCandidate& a, const PoseCandidate& b) { return a.chi2 < b.chi2; });
  return candidates;
}

Eigen::Vector3d TagCenter(const TagObservation& tag) {
  const std::array<Eigen::Vector3d, 4>& p = tag.corners_in_world;
  return (p[0] + p[1] + p[2] + p[3]) / 4;
}

double TagRmsPx(const Camera& camera, const Eigen::Isometry3d& cam_from_world, const TagObservation& tag) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d pixel = Project(camera, cam_from_world * tag.corners_in_world[i]);
    if (!pixel.allFinite()) return kInfinity;
    sum += (pixel - tag.corners_px[i]).squaredNorm();
  }
  return std::sqrt(sum / 4);
}

PoseStart EstimatePoseStart(const Camera& camera, const std::vector<TagObservation>& tags,
                            const PoseStartOptions& options) {
  PoseStart start;
  start.agrees.assign(tags.size(), false);
  if (tags.empty()) return start;

  Consensus consensus;
  if (tags.size() == 1) {
    consensus.agrees = {true};
    consensus.count = 1;
  } else {
    consensus = BestPair(camera, tags, options);
  }
  start.status = PoseStartStatus::kConflict;
  if (consensus.count < std::min<int>(2, static_cast<int>(tags.size()))) return start;

  // The pose of a pair is too rough far from it: fit to all that agree, then find again which agree.
  std::vector<PoseCandidate> candidates;
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    candidates = PoseCandidates(camera, Selected(tags, consensus.agrees), options);
    if (candidates.empty()) return start;
    const Consensus next = CountAgreeing(camera, candidates.front().cam_from_world, tags, options);
    if (round > 0 && !IsBetter(next, consensus)) break;
    consensus = next;
    if (consensus.count < std::min<int>(2, static_cast<int>(tags.size()))) return start;
  }
  start.rival_chi2 = candidates.size() > 1 ? candidates[1].chi2 - candidates[0].chi2 : kInfinity;
  start.cam_from_world = candidates.front().cam_from_world;
  if (start.rival_chi2 < options.ambiguity_chi2) {
    start.status = PoseStartStatus::kAmbiguous;
    return start;
  }
  start.status = PoseStartStatus::kOk;
  start.agrees = consensus.agrees;
  return start;
}

}  // namespace luxfit
