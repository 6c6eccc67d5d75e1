// Registers views: estimates a camera pose for every view, in the frame of the tag survey.
//
// Each view gets a pose by PnP from the surveyed tags that it sees. One bundle adjustment over all views
// follows:
//   min over { cam_from_world_v, tag displacements d_t, size error e, points p_i } of
//     sum rho( |Project(cam_from_world_v * p_corner(d_t, e)) - corner_px|^2 / corner_sigma^2 )
//       + sum |d_t|^2 / survey_sigma^2 + e^2 / size_sigma^2
//       + sum rho( |Project(cam_from_world_v * p_i) - pixel|^2 / point_sigma^2 )
// rho is Huber's loss at 2.5 sigma. All tags are (1 + e) times their surveyed size: they come from one
// printer of unknown scaling, and a view of one tag has no other measure of its distance. Poses are se(3):
// rotation on its manifold, translation in metres.
//
// The last sum is there where features (of COLMAP, say) are given beside the tags. A similarity puts them
// into the survey's frame. Views without tags are placed by the points that they share with others.
// point_sigma is estimated from the residuals; corners are then weighted by their own residuals, too.
//
// Without a survey (`tag_size_m` given) the tags' places are estimated with the poses. The frame is that of
// one tag, and the scale comes from its size. Features whose points lie on surfaces of the scene
// (calib/register/mesh_alignment.h) need no tags at all.
//
// Tags that hang further off their places than survey_sigma allows show their own sigma:
//   sigma^2 = sum |d_t|^2 / (3 T - tr(Cov_d) / sigma^2)   (calib/register/internal/bundle/survey_scale.h)
// It takes the place of the given one, unless one moved tag explains all.
//
// Such tags are laid on the surfaces of the scene that they hang on, where `surface` has them. The tape was
// wrong, but a sticker lies on its wall: along the surface's normal n the given sigma holds, in the plane the
// larger one,
//   |d_t|^2 / survey_sigma^2  becomes  |(I - n n^T) d_t|^2 / survey_sigma^2 + (n . d_t)^2 / given_sigma^2
// (calib/register/internal/survey/survey_on_surfaces.h). So the frame is held by the scene, not by the survey.
//
// Focal lengths that surveyed tags contradict (4 sigma and a thousandth) are replaced by those that the tags
// show: `focal_scale`, calib/register/internal/focal_check.h. The poses' covariance then holds their
// uncertainty.
//
// A view without a usable tag or features is left out and named in `notes`. So is a view whose pose is
// ambiguous, too uncertain or disagrees with the rest.
// Source: Triggs et al. (2000), "Bundle adjustment: a modern synthesis"; Collins and Bartoli (2014),
// "Infinitesimal plane-based pose estimation" (IPPE) for the start.
#ifndef LUXFIT_CALIB_REGISTER_REGISTRATION_H_
#define LUXFIT_CALIB_REGISTER_REGISTRATION_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/feature_model.h"
#include "calib/targets/tags.h"

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
  Eigen::Vector3d position_sigma_m = Eigen::Vector3d::Zero();  // camera centre, world axes, 1 sigma
  Eigen::Matrix<double, 6, 6> covariance;  // (rotation vector in world axes rad, camera centre in world m)
  double reprojection_rms_px = 0;          // sqrt(mean squared 2-D corner error)
  int tags_used = 0;
  int corners_rejected = 0;  // corners more than 4 sigma off
  int points_used = 0;       // features
};

struct RegistrationNote {
  std::string view;  // empty where it concerns a tag
  int tag_id = -1;   // -1 where it concerns a view
  // no_tags | pose_ambiguous | pose_uncertain | view_disagrees | tag_disagrees | tag_unknown | tag_duplicated
  // | tag_sizes_wrong | map_mirrored | map_turned | features_unaligned | features_disagree | tag_unplaced
  // | survey_less_accurate
  std::string code;
  std::string message;  // a sentence for the user
  std::string remedy;
};

// Tells whether surveyed tags were laid on the surfaces of the scene.
struct TagsOnSurfaces {
  int used = 0;        // tags that lie on a surface; 0: their surveyed places alone count
  int candidates = 0;  // tags that hang near a surface
  int seen = 0;        // surveyed tags in the photos
  std::string reason;  // of the decision; empty: not tried
};

struct Registration {
  std::vector<RegisteredView> views;  // those registered, in input order
  // 6V x 6V, six for each view in their order, as RegisteredView::covariance, which is its diagonal block. All
  // poses share the errors of the tags: differences of poses are better known than poses.
  Eigen::MatrixXd pose_covariance;
  std::vector<RegistrationNote> notes;
  // Sigma of each surveyed tag's place per axis (in the plane, for tags on surfaces): as given, or larger where
  // the tags show it; 0 without a survey.
  double survey_sigma_m = 0;
  TagsOnSurfaces tags_on_surfaces;
  double reprojection_rms_px = 0;   // over every corner of every view
  double tag_size_error = 0;        // e: tags are (1 + e) times as large as surveyed
  double tag_size_error_sigma = 0;  // 0 if it was held
  double point_sigma_px = 0;        // sigma of features, per axis; 0: there were none
  int points = 0;                   // features that at least two registered views use
  // Factor on fx and fy of each camera whose focal length the tags contradicted, else 1; sigma 0: as given.
  std::vector<double> focal_scale, focal_scale_sigma;
  std::string frame = "survey";          // survey | tag N | surface: frame of the poses
  std::vector<SurveyedTag> placed_tags;  // without a survey: places of the tags in that frame
  bool converged = false;
  std::string message;
  bool IsUsable() const { return converged && !views.empty(); }
};

// Holds the surfaces of a scene as triangles.
struct TriangleSurface {
  Eigen::Matrix3Xd vertices_m;  // in world
  Eigen::Matrix3Xi triangles;   // indices of vertices, one triangle for each column
};

struct RegisterViewsOptions {
  // Side of every tag's black square where there is no survey, so that places are estimated. 0: there is a
  // survey.
  double tag_size_m = 0;
  // Sigma of each surveyed tag's place per axis: a careful laser measure, the thickness of a sticker. The
  // tags may show a larger one. 0: exact.
  double survey_sigma_m = 0.001;
  // Surfaces of the scene that surveyed tags may hang on, in the frame of the survey. Tried where the survey is
  // less accurate than given. Empty: not tried.
  TriangleSurface surface;
  double tag_size_sigma =
      0.005;                  // relative, common to all tags: printers scale by as much; 0: sizes are exact
  double huber_sigmas = 2.5;  // loss switches from squared to linear here
  double max_view_rms_sigmas =
      6;  // a view whose corners disagree by more is left out; sigma is the corner's own,
          // times the ratio that the residuals of all views show where that exceeds 1
  double max_rotation_sigma_rad =
      0.005;  // a view turned by more would move every patch by pixels: it is left out
};

// Registers views by tags alone. Throws std::invalid_argument for options out of range, ids that the survey
// has twice and sizes that are not positive.
Registration RegisterViews(const std::vector<Camera>& cameras, const std::vector<SurveyedTag>& survey,
                           const std::vector<ViewDetections>& detections,
                           const RegisterViewsOptions& options = {});

// Registers views by tags and features. Views of `features` are among `detections` by name (without tags
// where they show none); others do not count. Throws as the function above.
Registration RegisterViews(const std::vector<Camera>& cameras, const std::vector<SurveyedTag>& survey,
                           const std::vector<ViewDetections>& detections, const FeatureModel& features,
                           const RegisterViewsOptions& options = {});

// Leaves out the views whose flag is false, with their rows of the covariance. Throws std::invalid_argument
// unless there is one flag for each view.
void KeepViews(const std::vector<bool>& is_kept, Registration& registration);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_REGISTRATION_H_
