// Registration: a camera pose for every view, in the frame of the tag survey.
//
// For each view a pose by PnP from the surveyed tags it sees, then one bundle adjustment over all views:
//   min over { cam_from_world_v, tag displacements d_t, size error e } of
//     sum rho( |Project(cam_from_world_v * p_corner(d_t, e)) - corner_px|^2 / corner_sigma^2 )
//       + sum |d_t|^2 / survey_sigma^2 + e^2 / size_sigma^2
// rho is Huber's loss at 2.5 sigma. All tags are (1 + e) times their surveyed size: they come from one
// printer, whose scaling nobody asks about, and a view of one tag has no other measure of its distance. Poses
// are se(3): rotation on its manifold, translation in metres.
//
// A view without a usable tag, or whose pose is ambiguous, too uncertain or disagrees with the rest, is left
// out and named in `notes`.
// Source: Triggs et al. (2000), "Bundle adjustment: a modern synthesis"; Collins
// and Bartoli (2014), "Infinitesimal plane-based pose estimation" (IPPE) for the start.
#ifndef LUXFIT_CALIB_REGISTRATION_H_
#define LUXFIT_CALIB_REGISTRATION_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "calib/camera.h"
#include "calib/tags.h"

namespace luxfit {

struct ViewDetections {
  std::string view;
  int camera = 0;  // index into the cameras given to RegisterViews
  std::vector<TagDetection> tags;
};

struct RegisteredView {
  std::string view;
  int camera = 0;
  Eigen::Isometry3d cam_from_world = Eigen::Isometry3d::Identity();
  Eigen::Vector3d position_sigma_m = Eigen::Vector3d::Zero();  // of the camera centre, world axes, 1 sigma
  Eigen::Matrix<double, 6, 6> covariance;  // (rotation vector in world axes rad, camera centre in world m)
  double reprojection_rms_px = 0;          // sqrt(mean squared 2-D corner error)
  int tags_used = 0;
  int corners_rejected = 0;  // corners more than 4 sigma off
};

struct RegistrationNote {
  std::string view;  // empty where it concerns a tag
  int tag_id = -1;   // -1 where it concerns a view
  // no_tags | pose_ambiguous | pose_uncertain | view_disagrees | tag_disagrees | tag_unknown | tag_duplicated
  std::string code;
  std::string message;  // a sentence for the user
  std::string remedy;
};

struct Registration {
  std::vector<RegisteredView> views;  // those registered, in input order
  std::vector<RegistrationNote> notes;
  double reprojection_rms_px = 0;   // over every corner of every view
  double tag_size_error = 0;        // e: tags are (1 + e) times as large as surveyed
  double tag_size_error_sigma = 0;  // 0 if it was held
  bool converged = false;
  std::string message;
  bool IsUsable() const { return converged && !views.empty(); }
};

struct RegisterViewsOptions {
  // Sigma of each surveyed tag's place per axis: a careful laser measure, the thickness of a sticker. 0:
  // exact.
  double survey_sigma_m = 0.001;
  double tag_size_sigma =
      0.005;                  // relative, common to all tags: printers scale by that much; 0: sizes are exact
  double huber_sigmas = 2.5;  // loss switches from squared to linear here
  double max_view_rms_sigmas =
      6;  // a view whose corners disagree by more than this is left out; sigma there is the
          // corner's own times what the residuals of all views say, if that is more than 1
  double max_rotation_sigma_rad =
      0.005;  // a view turned by more lands every patch pixels away: it is left out
};

Registration RegisterViews(const std::vector<Camera>& cameras, const std::vector<SurveyedTag>& survey,
                           const std::vector<ViewDetections>& detections,
                           const RegisterViewsOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTRATION_H_
