#include "calib/photo_files/internal/write_image.h"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace luxfit {

void WriteImageFile(const std::string& path, const cv::Mat& image) {
  const std::filesystem::path target(path);
  const std::string temporary = path + ".part" + target.extension().string();
  std::error_code error;
  std::filesystem::create_directories(target.parent_path(), error);
  bool written = false;
  try {
    written = cv::imwrite(temporary, image);
  } catch (const cv::Exception&) {
    written = false;
  }
  if (written) std::filesystem::rename(temporary, path, error);
  if (!written || error) {
    std::filesystem::remove(temporary, error);
    throw std::runtime_error(path + ": expected a writable place; check the folder and the free space");
  }
}

}  // namespace luxfit
