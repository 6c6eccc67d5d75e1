// Features as the files of a COLMAP text model.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_COLMAP_FILES_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_COLMAP_FILES_H_

#include <filesystem>
#include <fstream>
#include <string>

#include "calib/lens/camera_file.h"
#include "calib/register/colmap_files.h"
#include "calib/register/feature_model.h"

namespace luxfit::support {

// cameras.txt, images.txt (an image is named as its view, with `suffix`) and points3D.txt in `folder`.
inline void WriteColmapModel(const std::string& folder, const Camera& camera, const FeatureModel& features,
                             const std::string& suffix = "") {
  ColmapModel model;
  model.cameras[1] = camera;
  for (std::size_t v = 0; v < features.views.size(); ++v) {
    model.images[static_cast<int>(v) + 1] = {
        features.views[v].view + suffix, 1, features.views[v].cam_from_model, {}};
  }
  for (const FeatureTrack& track : features.tracks) {
    ColmapPoint point;
    point.p_in_model = track.p_in_model;
    for (const FeatureObservation& seen : track.seen) {
      std::vector<Eigen::Vector2d>& keypoints = model.images[seen.view + 1].keypoints_px;
      point.track.push_back({seen.view + 1, static_cast<int>(keypoints.size())});
      keypoints.push_back(seen.pixel);
    }
    model.points[static_cast<std::int64_t>(model.points.size()) + 1] = point;
  }
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/cameras.txt") << ColmapCamerasText(model.cameras);
  std::ofstream(folder + "/images.txt") << ColmapImagesText(model);
  std::ofstream(folder + "/points3D.txt") << ColmapPointsText(model);
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_COLMAP_FILES_H_
