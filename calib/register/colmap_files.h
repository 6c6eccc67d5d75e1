// Reads and writes COLMAP's models, and matches the pictures of its database.
//
//   p_in_cam = cam_from_model * p_in_model,   pixel = Project(camera, p_in_cam)
//
// A model has the poses of its images, its points and which image sees which, as text or binary. Its frame
// and its scale are arbitrary (no metres). Pixels are the project's: (0, 0) is the centre of the top-left
// pixel (calib/lens/camera_file.h). Ids are COLMAP's own.
//
// White walls have no texture, so the corners of tags serve as features beside those that COLMAP extracted.
// Each image's corners are appended to its keypoints, with descriptors of zeros, which match nothing. Corners
// of one tag seen in two images are matches beside those of the features (internal/descriptor_matches.h), of which
// a pair of images has 15 or none.
// All are returned as text for `colmap matches_importer --match_type raw`, which verifies them together.
//
// Models: throws std::runtime_error("FILE[:LINE]: expected ..., got ...") for missing and malformed files,
// and where an image or a track names something that the model does not have. Database: throws
// std::runtime_error, naming it, where it cannot be read or written or is not COLMAP's.
// Source: COLMAP 3.8 documentation, "Output format", "Database format".
#ifndef LUXFIT_CALIB_REGISTER_COLMAP_FILES_H_
#define LUXFIT_CALIB_REGISTER_COLMAP_FILES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/lens/camera_file.h"
#include "calib/targets/tags.h"

namespace luxfit {

struct ColmapImage {
  std::string name;  // file name relative to COLMAP's image folder
  ColmapId camera = 0;
  Eigen::Isometry3d cam_from_model = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector2d> keypoints_px;
};

struct ColmapTrackElement {
  ColmapId image = 0;
  int keypoint = 0;  // index into that image's keypoints_px
};

struct ColmapPoint {
  Eigen::Vector3d p_in_model = Eigen::Vector3d::Zero();
  std::vector<ColmapTrackElement> track;
};

struct ColmapModel {
  std::map<ColmapId, Camera> cameras;
  std::map<ColmapId, ColmapImage> images;
  std::map<std::int64_t, ColmapPoint> points;
};

// Reads cameras, images and points3D from a folder: the .bin file where there is one, else .txt.
ColmapModel ReadColmapModel(const std::string& folder);

// Return the content of images.txt and points3D.txt; that of cameras.txt is ColmapCamerasText(model.cameras).
std::string ColmapImagesText(const ColmapModel& model);
std::string ColmapPointsText(const ColmapModel& model);

// Matches every pair of images, and adds the corners of `tags_of_image`, keyed by
// the image's name in the database. A tag that an image shows twice is left out there. Returns the match
// list: "NAME NAME", a line of two keypoint indices per match, an empty line.
std::string MatchColmapImages(const std::string& path,
                              const std::map<std::string, std::vector<TagDetection>>& tags_of_image);

// Numbers the images in the order of their names. COLMAP numbers them as its threads finish them, and its
// results depend on the numbers. Call this before there are matches.
void NumberColmapImagesByName(const std::string& path);

// Holds COLMAP's numbers of an image and its camera, by the image's name: models of known poses need both.
struct ColmapImageIds {
  ColmapId image = 0, camera = 0;
};
std::map<std::string, ColmapImageIds> ReadColmapImageIds(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_COLMAP_FILES_H_
