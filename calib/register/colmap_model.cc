#include "calib/register/colmap_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "calib/lens/camera_file.h"
#include "calib/lens/internal/colmap_binary.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

std::string FileOf(const std::string& folder, const std::string& name) {
  for (const char* ending : {".bin", ".txt"}) {
    const fs::path path = fs::path(folder) / (name + ending);
    if (fs::is_regular_file(path)) return path.string();
  }
  std::string remedy = "name the folder that COLMAP's mapper wrote, such as sparse/0";
  if (fs::is_directory(fs::path(folder) / "0"))
    remedy = "did you mean " + (fs::path(folder) / "0").string() + "?";
  throw std::runtime_error(
      folder + ": expected a COLMAP model (cameras, images and points3D as .bin or .txt), got no " + name +
      " file; " + remedy);
}

bool IsBinary(const std::string& path) { return fs::path(path).extension() == ".bin"; }

Eigen::Isometry3d ToIsometry(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation,
                             const std::string& place) {
  if (!(std::abs(rotation.norm() - 1) < 1e-3) || !translation.allFinite())
    throw std::runtime_error(
        place + ": expected a unit quaternion QW QX QY QZ and finite TX TY TZ, got one of length " +
        std::to_string(rotation.norm()));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

// Reads the lines of a text file with their numbers.
struct TextFile {
  explicit TextFile(const std::string& text_path) : path(text_path), file(text_path) {
    if (!file) throw std::runtime_error(path + ": expected a readable file, got none");
  }
  bool Next() {
    ++number;
    return static_cast<bool>(std::getline(file, line));
  }
  bool NextEntry() {
    while (Next()) {
      if (line.find_first_not_of(" \t\r") != std::string::npos && line[0] != '#') return true;
    }
    return false;
  }
  std::string Place() const { return path + ":" + std::to_string(number); }

  std::string path, line;
  std::ifstream file;
  int number = 0;
};

std::runtime_error LineError(const TextFile& text, const std::string& expected) {
  return std::runtime_error(text.Place() + ": expected " + expected + ", got \"" + text.line.substr(0, 80) +
                            "\"");
}

void AddImage(std::map<ColmapId, ColmapImage>& images, ColmapId id, ColmapImage image,
              const std::string& place) {
  if (!images.emplace(id, std::move(image)).second)
    throw std::runtime_error(place + ": expected every image once, got " + std::to_string(id) + " again");
}

// Reads the images without their keypoints' points: the tracks state these too, and the two must agree.
std::map<ColmapId, ColmapImage> ReadImagesText(const std::string& path) {
  TextFile text(path);
  std::map<ColmapId, ColmapImage> images;
  while (text.NextEntry()) {
    std::istringstream words(text.line);
    ColmapId id = 0;
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    Eigen::Vector3d t;
    ColmapImage image;
    if (!(words >> id >> q.w() >> q.x() >> q.y() >> q.z() >> t.x() >> t.y() >> t.z() >> image.camera >>
          std::ws) ||
        !std::getline(words, image.name))
      throw LineError(text, "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME");
    while (!image.name.empty() && (image.name.back() == '\r' || image.name.back() == ' '))
      image.name.pop_back();
    image.cam_from_model = ToIsometry(q, t, text.Place());
    // An image without keypoints has an empty line, which a file's end may have lost.
    if (text.Next()) {
      std::istringstream points(text.line);
      double x = 0, y = 0;
      std::int64_t point = 0;
      while (points >> x) {
        if (!(points >> y >> point)) throw LineError(text, "triples X Y POINT3D_ID");
        image.keypoints_px.push_back(FromColmapPixel({x, y}));
      }
      if (!points.eof()) throw LineError(text, "triples X Y POINT3D_ID");
    }
    AddImage(images, id, std::move(image), text.Place());
  }
  return images;
}

std::map<ColmapId, ColmapImage> ReadImagesBinary(const std::string& path) {
  ColmapBinary file(path);
  std::map<ColmapId, ColmapImage> images;
  const auto count = file.Read<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    const ColmapId id = file.Read<std::uint32_t>();
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    for (double* value : {&q.w(), &q.x(), &q.y(), &q.z()}) *value = file.Read<double>();
    Eigen::Vector3d t;
    for (double& value : t) value = file.Read<double>();
    ColmapImage image;
    image.cam_from_model = ToIsometry(q, t, path + ": image " + std::to_string(id));
    image.camera = file.Read<std::uint32_t>();
    image.name = file.ReadText();
    const auto keypoints = file.Read<std::uint64_t>();
    for (std::uint64_t k = 0; k < keypoints; ++k) {
      const auto x = file.Read<double>();
      const auto y = file.Read<double>();
      file.Read<std::uint64_t>();
      image.keypoints_px.push_back(FromColmapPixel({x, y}));
    }
    AddImage(images, id, std::move(image), path);
  }
  return images;
}

std::map<std::int64_t, ColmapPoint> ReadPointsText(const std::string& path) {
  TextFile text(path);
  std::map<std::int64_t, ColmapPoint> points;
  while (text.NextEntry()) {
    std::istringstream words(text.line);
    std::int64_t id = 0;
    ColmapPoint point;
    double red = 0, green = 0, blue = 0, error_px = 0;
    if (!(words >> id >> point.p_in_model.x() >> point.p_in_model.y() >> point.p_in_model.z() >> red >>
          green >> blue >> error_px))
      throw LineError(text, "POINT3D_ID X Y Z R G B ERROR TRACK");
    ColmapTrackElement element;
    while (words >> element.image) {
      if (!(words >> element.keypoint)) throw LineError(text, "a track of pairs IMAGE_ID POINT2D_IDX");
      point.track.push_back(element);
    }
    if (!words.eof()) throw LineError(text, "a track of pairs IMAGE_ID POINT2D_IDX");
    if (!points.emplace(id, std::move(point)).second)
      throw std::runtime_error(text.Place() + ": expected every point once, got " + std::to_string(id) +
                               " again");
  }
  return points;
}

std::map<std::int64_t, ColmapPoint> ReadPointsBinary(const std::string& path) {
  ColmapBinary file(path);
  std::map<std::int64_t, ColmapPoint> points;
  const auto count = file.Read<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto id = static_cast<std::int64_t>(file.Read<std::uint64_t>());
    ColmapPoint point;
    for (double& value : point.p_in_model) value = file.Read<double>();
    for (int colour = 0; colour < 3; ++colour) file.Read<std::uint8_t>();
    file.Read<double>();  // mean reprojection error, which the tracks give anyway
    const auto length = file.Read<std::uint64_t>();
    for (std::uint64_t k = 0; k < length; ++k) {
      ColmapTrackElement element;
      element.image = file.Read<std::uint32_t>();
      element.keypoint = static_cast<int>(file.Read<std::uint32_t>());
      point.track.push_back(element);
    }
    if (!points.emplace(id, std::move(point)).second)
      throw file.Error("expected every point once, got " + std::to_string(id) + " again");
  }
  return points;
}

void CheckReferences(const ColmapModel& model, const std::string& images_path,
                     const std::string& points_path) {
  for (const auto& [id, image] : model.images) {
    if (model.cameras.count(image.camera) == 0)
      throw std::runtime_error(images_path + ": image " + std::to_string(id) + " (" + image.name +
                               "): expected a camera of the model, got " + std::to_string(image.camera));
  }
  for (const auto& [id, point] : model.points) {
    const std::string place = points_path + ": point " + std::to_string(id);
    if (!point.p_in_model.allFinite()) throw std::runtime_error(place + ": expected finite X Y Z");
    for (const ColmapTrackElement& element : point.track) {
      const auto image = model.images.find(element.image);
      if (image == model.images.end())
        throw std::runtime_error(place + ": expected a track of the model's images, got image " +
                                 std::to_string(element.image));
      if (element.keypoint < 0 ||
          static_cast<std::size_t>(element.keypoint) >= image->second.keypoints_px.size())
        throw std::runtime_error(place + ": expected a keypoint of image " + std::to_string(element.image) +
                                 " (it has " + std::to_string(image->second.keypoints_px.size()) + "), got " +
                                 std::to_string(element.keypoint));
    }
  }
}

}  // namespace

ColmapModel ReadColmapModel(const std::string& folder) {
  const std::string cameras = FileOf(folder, "cameras"), images = FileOf(folder, "images"),
                    points = FileOf(folder, "points3D");
  ColmapModel model;
  model.cameras = ReadColmapCameras(cameras);
  model.images = IsBinary(images) ? ReadImagesBinary(images) : ReadImagesText(images);
  model.points = IsBinary(points) ? ReadPointsBinary(points) : ReadPointsText(points);
  CheckReferences(model, images, points);
  return model;
}

std::string ColmapImagesText(const ColmapModel& model) {
  for (const auto& [id, image] : model.images) {
    const bool breaks = std::any_of(image.name.begin(), image.name.end(),
                                    [](unsigned char c) { return std::iscntrl(c) != 0; });
    if (breaks)
      throw std::invalid_argument("image " + std::to_string(id) +
                                  ": expected a name without control characters; rename the photo");
  }
  std::map<ColmapId, std::vector<std::int64_t>> point_of_keypoint;
  for (const auto& [id, image] : model.images) point_of_keypoint[id].assign(image.keypoints_px.size(), -1);
  for (const auto& [id, point] : model.points) {
    for (const ColmapTrackElement& element : point.track)
      point_of_keypoint.at(element.image).at(static_cast<std::size_t>(element.keypoint)) = id;
  }
  std::ostringstream text;
  text << std::setprecision(17) << "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
       << "# POINTS2D[] as (X, Y, POINT3D_ID)\n";
  for (const auto& [id, image] : model.images) {
    const Eigen::Quaterniond q(image.cam_from_model.linear());
    const Eigen::Vector3d t = image.cam_from_model.translation();
    text << id << " " << q.w() << " " << q.x() << " " << q.y() << " " << q.z() << " " << t.x() << " " << t.y()
         << " " << t.z() << " " << image.camera << " " << image.name << "\n";
    for (std::size_t k = 0; k < image.keypoints_px.size(); ++k) {
      const Eigen::Vector2d pixel = ToColmapPixel(image.keypoints_px[k]);
      text << (k == 0 ? "" : " ") << pixel.x() << " " << pixel.y() << " " << point_of_keypoint[id][k];
    }
    text << "\n";
  }
  return text.str();
}

std::string ColmapPointsText(const ColmapModel& model) {
  std::ostringstream text;
  text << std::setprecision(17)
       << "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  for (const auto& [id, point] : model.points) {
    const Eigen::Vector3d& p = point.p_in_model;
    text << id << " " << p.x() << " " << p.y() << " " << p.z() << " 128 128 128 0";
    for (const ColmapTrackElement& element : point.track)
      text << " " << element.image << " " << element.keypoint;
    text << "\n";
  }
  return text.str();
}

}  // namespace luxfit
