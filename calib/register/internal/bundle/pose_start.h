// Estimates a first pose of one view from its surveyed tags, robust to single wrong tags.
//
// Every pair of tags proposes a pose (SQPNP, or both IPPE solutions where the pair is coplanar). The pose
// with which most tags agree is fitted again to those. A single tag proposes both IPPE solutions. Two
// solutions are distinct only if their sums of squared normalised residuals differ by `ambiguity_chi2`.
//
//   sigma^2 = corner's own^2 + survey's, as seen in pixels^2 + model_sigma_px^2
// A tag agrees if the rms of its corners is within 6 sigma + agreement_fraction * side_px.
//
// Source: Terzakis and Lourakis (2020), "A consistently fast and globally optimal solution to the PnP
// problem" (SQPNP); Collins and Bartoli (2014), "Infinitesimal plane-based pose estimation" (IPPE); Fischler
// and Bolles (1981), RANSAC.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_POSE_START_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_POSE_START_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "calib/lens/camera.h"

namespace luxfit {

struct TagObservation {
  int id = 0;
  double size_m = 0;
  double side_px = 0;
  double sigma_px = 0;
  std::array<Eigen::Vector3d, 4> corners_in_world;
  std::array<Eigen::Vector2d, 4> corners_px;
};

enum class PoseStartStatus { kOk, kNoTags, kAmbiguous, kConflict };

struct PoseStart {
  PoseStartStatus status = PoseStartStatus::kNoTags;
  Eigen::Isometry3d cam_from_world = Eigen::Isometry3d::Identity();
  std::vector<bool> agrees;  // by tag; all false unless kOk
  double rival_chi2 = 0;     // how much worse the second solution fits; infinity if there is none
};

struct PoseStartOptions {
  double survey_sigma_m = 0;
  double model_sigma_px = 0.05;      // lens model; refined corners are better than it
  double agreement_fraction = 0.05;  // in tag sides: 1 cm for a 0.2 m tag
  double ambiguity_chi2 = 16;        // 4 sigma
};

struct PoseCandidate {
  Eigen::Isometry3d cam_from_world = Eigen::Isometry3d::Identity();
  double chi2 = 0;
};

// Returns every distinct local solution for these tags, best first: two where one plane allows two.
std::vector<PoseCandidate> PoseCandidates(const Camera& camera, const std::vector<TagObservation>& tags,
                                          const PoseStartOptions& options);

// Estimates the pose; `status` says why there is none.
PoseStart EstimatePoseStart(const Camera& camera, const std::vector<TagObservation>& tags,
                            const PoseStartOptions& options);

Eigen::Vector3d TagCenter(const TagObservation& tag);  // in world

// Returns the rms over the corners of |Project(pose * corner) - corner_px|, px; infinity if one is behind the
// camera.
double TagRmsPx(const Camera& camera, const Eigen::Isometry3d& cam_from_world, const TagObservation& tag);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_POSE_START_H_
