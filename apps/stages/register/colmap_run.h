// Runs COLMAP as a program on one picture of every view, without a display and with given intrinsics.
//
//   feature_extractor -> matches of features and of tag corners -> matches_importer -> mapper
//
// calib/register/colmap_files.h makes the matches.
//
// Where at least two views already have a pose, COLMAP starts from those instead of a pair of its own
// (point_triangulator, then the mapper for the others): rooms of few features have no such pair.
//
// It runs on one thread with one seed, so that the same pictures give the same model. All files lie in
// `folder`, which is emptied first: images/, database.db, sparse/, colmap.log.
//
// Throws MissingProgram where colmap is not installed, and ColmapFailed naming the log where a step fails.
// Source: COLMAP 3.8 documentation, "Command-line interface".
#ifndef LUXFIT_APPS_STAGES_INTERNAL_COLMAP_RUN_H_
#define LUXFIT_APPS_STAGES_INTERNAL_COLMAP_RUN_H_

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/photo_files/image.h"
#include "calib/targets/tags.h"

namespace luxfit {

class ColmapFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ColmapPicture {
  std::string view;
  int camera = 0;
  ImagePlane luminance;  // any scale
  std::vector<TagDetection> tags;
  std::optional<Eigen::Isometry3d> cam_from_world;  // where it is known
};

struct ColmapRunOptions {
  double time_limit_s = 0;  // for every step; 0: ten times the expected time for the number of pictures
};

struct ColmapRun {
  std::string model_folder;  // empty where COLMAP found no model (too few matches), which is not an error
  std::map<std::string, std::string> view_of_image;  // by the image's name in the model
};

ColmapRun RunColmap(const std::vector<ColmapPicture>& pictures, const std::vector<Camera>& cameras,
                    const std::string& folder, const ColmapRunOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_COLMAP_RUN_H_
