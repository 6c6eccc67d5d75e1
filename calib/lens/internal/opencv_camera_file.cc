#include <opencv2/core.hpp>
#include <stdexcept>

#include "calib/lens/internal/camera_formats.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

[[noreturn]] void Fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what);
}

int ReadPixels(const cv::FileStorage& file, const std::string& path, const std::string& key) {
  const cv::FileNode node = file[key];
  if (!node.isInt() && !node.isReal()) {
    Fail(path, key + ": expected a number of pixels, got " + (node.empty() ? "nothing" : "something else"));
  }
  return ImagePixels(static_cast<double>(node), path + ": " + key);
}

cv::Mat ReadMatrix(const cv::FileStorage& file, const std::string& path, const std::string& key) {
  const cv::FileNode node = file[key];
  if (node.empty()) {
    Fail(path, key + ": expected an !!opencv-matrix, got nothing; is this a calibration written by OpenCV?");
  }
  // OpenCV makes room for as many numbers as the file claims, whatever follows.
  constexpr int kMost = 16;
  for (const char* count : {"rows", "cols"}) {
    if (!node.isMap() || !node[count].isInt()) Fail(path, key + ": expected an !!opencv-matrix of numbers");
    const int given = static_cast<int>(node[count]);
    if (given < 1 || given > kMost)
      Fail(path, key + ": expected 1 to 16 " + count + ", got " + std::to_string(given));
  }
  cv::Mat matrix;
  node >> matrix;
  if (matrix.empty() || matrix.channels() != 1) Fail(path, key + ": expected an !!opencv-matrix of numbers");
  matrix.convertTo(matrix, CV_64F);
  for (int row = 0; row < matrix.rows; ++row) {
    for (int col = 0; col < matrix.cols; ++col) {
      if (!std::isfinite(matrix.at<double>(row, col))) Fail(path, key + ": expected finite numbers");
    }
  }
  return matrix;
}

void ReadIntrinsics(const cv::FileStorage& file, const std::string& path, Camera& camera) {
  const std::string key = "camera_matrix";
  const cv::Mat k = ReadMatrix(file, path, key);
  if (k.rows != 3 || k.cols != 3) {
    Fail(path, key + ": expected 3 x 3, got " + std::to_string(k.rows) + " x " + std::to_string(k.cols));
  }
  camera.fx_px = k.at<double>(0, 0);
  camera.fy_px = k.at<double>(1, 1);
  camera.cx_px = k.at<double>(0, 2);
  camera.cy_px = k.at<double>(1, 2);
  if (!(camera.fx_px > 0 && camera.fy_px > 0)) {
    Fail(path, key + ": expected focal lengths > 0 px, got " + std::to_string(camera.fx_px) + " and " +
                   std::to_string(camera.fy_px));
  }
  if (k.at<double>(0, 1) != 0 || k.at<double>(1, 0) != 0 || k.at<double>(2, 0) != 0 ||
      k.at<double>(2, 1) != 0 || k.at<double>(2, 2) != 1) {
    Fail(path, key + ": expected [fx 0 cx; 0 fy cy; 0 0 1] without skew");
  }
}

void ReadDistortion(const cv::FileStorage& file, const std::string& path, Camera& camera) {
  const std::string key = "distortion_coefficients";
  const cv::Mat k = ReadMatrix(file, path, key);
  const int count = static_cast<int>(k.total());
  std::string model;
  if (!file["distortion_model"].empty()) file["distortion_model"] >> model;
  camera.lens = LensOfDistortion(model == "fisheye" ? "equidistant" : model);
  if ((k.rows != 1 && k.cols != 1) || (count != 4 && count != 5 && count != 8 && count != 12)) {
    Fail(path, key + ": expected 4, 5, 8 or 12 in one row or column, got " + std::to_string(k.rows) + " x " +
                   std::to_string(k.cols));
  }
  const LensOps& ops = OpsOf(camera.lens);
  if (ops.size == nullptr && count != ops.coefficients)
    Fail(path, key + ": expected " + std::to_string(ops.coefficients) + " for a " + ops.key +
                   " (distortion_model " + model + "), got " + std::to_string(count));
  for (int i = 0; i < count; ++i) {
    camera.distortion[static_cast<std::size_t>(i)] = k.rows == 1 ? k.at<double>(0, i) : k.at<double>(i, 0);
  }
}

}  // namespace

FiledCamera ReadOpenCvCamera(const std::string& path) {
  try {
    const cv::FileStorage file(path, cv::FileStorage::READ);
    if (!file.isOpened()) Fail(path, "cannot read the calibration, expected an OpenCV YAML or XML file");
    FiledCamera filed;
    Camera& camera = filed.camera;
    camera.width_px = ReadPixels(file, path, "image_width");
    camera.height_px = ReadPixels(file, path, "image_height");
    ReadIntrinsics(file, path, camera);
    ReadDistortion(file, path, camera);
    return filed;
  } catch (const cv::Exception& e) {
    Fail(path, "cannot read the calibration, expected OpenCV YAML (first line %YAML:1.0) or XML: " + e.err);
  } catch (const std::logic_error&) {  // of OpenCV's parser, where a name in the file is broken
    Fail(path, "cannot read the calibration, expected OpenCV YAML (first line %YAML:1.0) or XML");
  }
}

std::string OpenCvCameraYaml(const Camera& camera) {
  const LensOps& ops = OpsOf(camera.lens);
  if (ops.has_control_points)
    throw std::invalid_argument("OpenCV's calibration files cannot hold a splined lens");
  const cv::Mat k =
      (cv::Mat_<double>(3, 3) << camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const bool has_sizes = ops.size != nullptr;
  int used = ops.coefficients;
  while (has_sizes && used > 4 && camera.distortion[static_cast<std::size_t>(used - 1)] == 0) --used;
  const int count = used > 8 ? 12 : used > 5 ? 8 : used;
  cv::Mat distortion(1, count, CV_64F);
  for (int i = 0; i < count; ++i)
    distortion.at<double>(0, i) = camera.distortion[static_cast<std::size_t>(i)];
  cv::FileStorage file(".yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  file << "image_width" << camera.width_px << "image_height" << camera.height_px << "camera_matrix" << k
       << "distortion_model"
       << (!has_sizes  ? ops.distortion_model
           : count > 5 ? "rational_polynomial"
                       : "plumb_bob")
       << "distortion_coefficients" << distortion;
  return file.releaseAndGetString();
}

}  // namespace luxfit
