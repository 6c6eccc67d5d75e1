#include "apps/stages/calibrate/calibration_images.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <stdexcept>

#include "apps/stages/calibrate/calibration_sets.h"
#include "apps/text/file_stem.h"
#include "calib/calibrate/rig_strain.h"
#include "calib/photo_files/image.h"
#include "calib/targets/board.h"
#include "calib/targets/tags.h"

namespace luxfit {
namespace fs = std::filesystem;
namespace {

constexpr int kGammaBits = 8;  // photos of 8 bits are encoded for displays

// Holds one camera's images with their corners.
struct CameraImages {
  std::vector<std::string> files;
  std::vector<BoardDetection> found;
  Eigen::Array2i size_px{0, 0};
  Eigen::MatrixXd brightest;  // CalibrationCamera
};

bool IsOfTags(const SessionCamera& camera) { return !camera.board; }

CalibrationTarget TargetFor(const Session& session, const SessionCamera& camera) {
  return IsOfTags(camera) ? TargetOf(session.tags.survey) : TargetOf(*camera.board);
}

std::vector<std::string> FilesOf(const OwnPhotos& photos, int camera) {
  std::vector<std::string> files;
  files.reserve(photos.size());
  for (const auto& [of, file] : photos) {
    if (of.first == camera) files.push_back(file);
  }
  return files;
}

// Returns the tags of an image as corners of the survey. A tag seen twice is left out as ambiguous.
BoardDetection SurveyedCorners(const std::vector<TagDetection>& detections, const SessionTags& tags) {
  BoardDetection out;
  for (const TagDetection& tag : detections) {
    const auto same = [&](const TagDetection& other) { return other.id == tag.id; };
    if (std::count_if(detections.begin(), detections.end(), same) > 1) continue;
    for (std::size_t t = 0; t < tags.survey.size(); ++t) {
      if (tags.survey[t].id != tag.id) continue;
      for (std::size_t k = 0; k < 4; ++k)
        out.corners.push_back({static_cast<int>(4 * t + k), tag.corners_px[k], tag.corner_sigma_px});
    }
  }
  std::sort(out.corners.begin(), out.corners.end(),
            [](const BoardCorner& a, const BoardCorner& b) { return a.index < b.index; });
  if (out.corners.empty()) out.message = "no surveyed tag was found";
  return out;
}

std::vector<TagDetection> DetectTagsOf(const ImagePlane& grey, const SessionTags& tags) {
  DetectTagsOptions options;
  options.family = tags.family;
  return DetectTags(grey, options);
}

BoardDetection DetectRefined(const Photo& photo, const SessionCamera& camera, const SessionTags& tags,
                             const Camera& lens) {
  const ImagePlane grey = GreyOf(photo, camera.luminance_weights);
  // Saturated pixels do not locate an edge.
  ImagePlane unsaturated = grey;
  for (const ImagePlane& plane : photo.rgb_counts)
    unsaturated = (plane >= static_cast<float>(photo.saturation_counts))
                      .select(std::numeric_limits<float>::quiet_NaN(), unsaturated);
  RefineTagCornersOptions options;
  options.family = tags.family;
  return SurveyedCorners(RefineTagCorners(unsaturated, lens, DetectTagsOf(grey, tags), options), tags);
}

CameraImages Detect(const Session& session, const SessionCamera& camera, std::vector<std::string> files) {
  CameraImages images;
  images.files = std::move(files);
  images.found.resize(images.files.size());
  std::vector<Eigen::Array2i> sizes(images.files.size());
  std::vector<Eigen::MatrixXd> values(images.files.size());
  tbb::parallel_for(std::size_t{0}, images.files.size(), [&](std::size_t i) {
    const Photo photo = ReadPhoto(images.files[i]);
    sizes[i] = {photo.width_px(), photo.height_px()};
    const ImagePlane grey = GreyOf(photo, camera.luminance_weights);
    values[i] = DisplayValues(grey, photo.full_scale_counts, photo.bits_per_channel > kGammaBits);
    images.found[i] = IsOfTags(camera) ? SurveyedCorners(DetectTagsOf(grey, session.tags), session.tags)
                                       : DetectBoard(grey, *camera.board);
  });
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if ((sizes[i] != sizes.front()).any())
      throw std::runtime_error(
          fmt::format("{}: expected an image of {} x {} pixels as {}, got {} x {}; images of "
                      "one camera are of one size",
                      images.files[i], sizes.front().x(), sizes.front().y(), images.files.front(),
                      sizes[i].x(), sizes[i].y()));
  }
  if (!sizes.empty()) images.size_px = sizes.front();
  for (const Eigen::MatrixXd& of_photo : values)
    images.brightest = images.brightest.size() == 0 ? of_photo : images.brightest.cwiseMax(of_photo).eval();
  return images;
}

// Returns the rows of the table that belong to the camera: all, or those of its calibration images.
CameraImages ReadCorners(const Session& session, const SessionCamera& camera) {
  const auto count = static_cast<int>(BoardCorners(*camera.board).size());
  CameraImages images;
  for (const ImageCorners& image : ReadCornersFile(camera.calibration_corners, count)) {
    const auto is_named = [&](const std::string& file) { return FileName(file) == FileName(image.file); };
    const std::vector<std::string>& own = camera.calibration_images;
    if (!own.empty() && std::none_of(own.begin(), own.end(), is_named)) continue;
    images.files.push_back(image.file);
    images.found.push_back({image.corners, image.corners.empty() ? "no corners in the table" : ""});
  }
  if (images.files.empty())
    throw std::runtime_error(
        fmt::format("{}: expected rows for the calibration images of camera \"{}\", got none; "
                    "compare the names",
                    camera.calibration_corners, camera.id));
  if (camera.image_size_px) {
    images.size_px = *camera.image_size_px;
  } else if (!camera.calibration_images.empty()) {
    const Photo photo = ReadPhoto(camera.calibration_images.front());
    images.size_px = {photo.width_px(), photo.height_px()};
  } else {
    throw std::runtime_error(
        fmt::format("{}: camera \"{}\": expected the image's size beside calibration_corners, got "
                    "none; add image_size = [width, height] or calibration_images",
                    session.path, camera.id));
  }
  return images;
}

CameraImages ImagesOf(const Session& session, const OwnPhotos& photos, int index) {
  const SessionCamera& camera = session.cameras[static_cast<std::size_t>(index)];
  if (!camera.calibration_corners.empty()) return ReadCorners(session, camera);
  if (!camera.calibration_images.empty()) return Detect(session, camera, camera.calibration_images);
  return Detect(session, camera, FilesOf(photos, index));
}

bool IsSameBoard(const std::optional<Board>& a, const std::optional<Board>& b) {
  if (!a || !b) return false;  // cameras in rooms move
  return a->type == b->type && a->columns == b->columns && a->rows == b->rows &&
         a->tag_size_m == b->tag_size_m && a->spacing == b->spacing && a->square_size_m == b->square_size_m &&
         a->first_id == b->first_id && a->family == b->family && a->dictionary == b->dictionary;
}

// Tells whether so few corners were found that another photo would be better. Boards that hide some corners, or reach
// out of the photo, are as good as whole ones.
bool IsPoor(const BoardDetection& found, std::size_t corners_of_board) {
  return !found.message.empty() && 2 * found.corners.size() < corners_of_board;
}

CalibrationGroup GroupOf(const Session& session, const std::vector<int>& cameras,
                         const std::vector<CameraImages>& images, const ImageSets& sets) {
  CalibrationGroup group;
  group.cameras = cameras;
  group.is_rig = sets.is_rig;
  group.pairing = sets.rule;
  const SessionCamera& first = session.cameras[static_cast<std::size_t>(cameras.front())];
  group.board = first.board;
  group.input.target = TargetFor(session, first);
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const SessionCamera& camera = session.cameras[static_cast<std::size_t>(cameras[c])];
    group.input.cameras.push_back(
        {camera.id, images[c].size_px.x(), images[c].size_px.y(), images[c].brightest});
    for (std::size_t i = 0; i < images[c].files.size(); ++i) {
      const BoardDetection& found = images[c].found[i];
      if (IsPoor(found, group.input.target.points.size()))
        group.messages[static_cast<int>(group.input.images.size())] = found.message;
      group.input.images.push_back({images[c].files[i], static_cast<int>(c), sets.sets[c][i], found.corners});
    }
  }
  return group;
}

void AddGroups(const Session& session, const std::vector<int>& alike, const std::vector<CameraImages>& images,
               std::vector<CalibrationGroup>& groups) {
  std::vector<std::vector<std::string>> files;
  files.reserve(images.size());
  for (const CameraImages& own : images) files.push_back(own.files);
  const ImageSets sets = PairImages(files, session.calibration.rig);
  if (sets.is_rig) {
    groups.push_back(GroupOf(session, alike, images, sets));
    return;
  }
  for (std::size_t c = 0; c < alike.size(); ++c)
    groups.push_back(GroupOf(session, {alike[c]}, {images[c]}, {false, {sets.sets[c]}, "none"}));
}

}  // namespace

ImagePlane GreyOf(const Photo& photo, const Eigen::Vector3d& weights) {
  const Eigen::Vector3f w = weights.cast<float>();
  return w[0] * photo.rgb_counts[0] + w[1] * photo.rgb_counts[1] + w[2] * photo.rgb_counts[2];
}

bool CanBeCalibrated(const Session& session, const SessionCamera& camera) {
  if (camera.board) return !camera.calibration_images.empty() || !camera.calibration_corners.empty();
  return !session.tags.survey.empty() && (!camera.calibration_images.empty() || camera.intrinsics.empty());
}

std::vector<CalibrationGroup> ReadCalibrationImages(const Session& session, const OwnPhotos& photos,
                                                    const std::vector<int>& cameras) {
  std::vector<CalibrationGroup> groups;
  std::vector<bool> grouped(cameras.size(), false);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (grouped[i]) continue;
    std::vector<int> alike;
    std::vector<CameraImages> images;
    const SessionCamera& first = session.cameras[static_cast<std::size_t>(cameras[i])];
    for (std::size_t k = i; k < cameras.size(); ++k) {
      const SessionCamera& other = session.cameras[static_cast<std::size_t>(cameras[k])];
      if (k != i && (grouped[k] || !IsSameBoard(first.board, other.board))) continue;
      grouped[k] = true;
      alike.push_back(cameras[k]);
      images.push_back(ImagesOf(session, photos, cameras[k]));
    }
    AddGroups(session, alike, images, groups);
  }
  return groups;
}

bool IsOfTags(const Session& session, const CalibrationGroup& group) {
  return IsOfTags(session.cameras[static_cast<std::size_t>(group.cameras.front())]);
}

CalibrationGroup WithRefinedTags(const Session& session, CalibrationGroup group, const Camera& lens) {
  const SessionCamera& camera = session.cameras[static_cast<std::size_t>(group.cameras.front())];
  std::vector<CalibrationImage>& images = group.input.images;
  tbb::parallel_for(std::size_t{0}, images.size(), [&](std::size_t i) {
    const Photo photo = ReadPhoto(images[i].name);
    if (images[i].corners.empty() || photo.bits_per_channel == kGammaBits) return;
    images[i].corners = DetectRefined(photo, camera, session.tags, lens).corners;
  });
  return group;
}

std::vector<CalibrationGroup> SplitRig(const CalibrationGroup& rig) {
  std::vector<CalibrationGroup> groups;
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    CalibrationGroup group;
    group.cameras = {rig.cameras[c]};
    group.board = rig.board;
    group.input = InputOfCamera(rig.input, static_cast<int>(c));
    int own = 0;
    for (std::size_t i = 0; i < rig.input.images.size(); ++i) {
      if (rig.input.images[i].camera != static_cast<int>(c)) continue;
      const auto message = rig.messages.find(static_cast<int>(i));
      if (message != rig.messages.end()) group.messages[own] = message->second;
      ++own;
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace luxfit
