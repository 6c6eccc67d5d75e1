// Any bytes as a camera file of COLMAP, Kalibr or mrcal, or as COLMAP's images and points: the readers must
// answer with cameras and poses of finite numbers or with a std::runtime_error. The first byte says which
// reader. (OpenCV's own files: session_fuzz.)
//
// Run by .ci/fuzz.sh. Source: LLVM, "libFuzzer".
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "calib/lens/camera_file.h"
#include "calib/register/colmap_files.h"

namespace {

using namespace luxfit;

// One folder a process; the readers want files.
const std::string& Folder() {
  static const std::string folder = [] {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("luxfit_fuzz_" + std::to_string(getpid()))).string();
    std::filesystem::create_directories(path);
    return path + "/";
  }();
  return folder;
}

void Write(const std::string& name, const char* data, size_t size) {
  std::ofstream(Folder() + name, std::ios::binary).write(data, static_cast<std::streamsize>(size));
}

void UseCameras(const std::string& name) {
  for (const FiledCamera& filed : ReadCameraFile(Folder() + name)) {
    const Camera& camera = filed.camera;
    if (!std::isfinite(camera.fx_px + camera.cx_px) || camera.width_px < 1) std::abort();
    // Whatever the lens: a pixel or NaN, a ray or NaN.
    Project(camera, {0.1, -0.2, 1});
    Unproject(camera, {camera.cx_px + 10, camera.cy_px - 20});
  }
}

void UseModel(const std::string& images, const std::string& points) {
  const std::string cameras = "1 PINHOLE 640 480 500 500 320 240\n";
  Write("cameras.txt", cameras.data(), cameras.size());
  for (const char* name : {"images.bin", "points3D.bin", "cameras.bin"})
    std::filesystem::remove(Folder() + name);
  Write("images.txt", images.data(), images.size());
  Write("points3D.txt", points.data(), points.size());
  const ColmapModel model = ReadColmapModel(Folder());
  for (const auto& [id, image] : model.images) {
    if (!image.cam_from_model.matrix().allFinite()) std::abort();
  }
  for (const auto& [id, point] : model.points) {
    for (const ColmapTrackElement& element : point.track) {
      const ColmapImage& image = model.images.at(element.image);
      if (element.keypoint < 0 || element.keypoint >= static_cast<int>(image.keypoints_px.size()))
        std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 1) return 0;
  const char* const text = reinterpret_cast<const char*>(data) + 1;
  try {
    switch (data[0] % 5) {
      case 0:
        Write("c.txt", text, size - 1);
        UseCameras("c.txt");
        break;
      case 1:
        Write("c.bin", text, size - 1);
        UseCameras("c.bin");
        break;
      case 2:
        Write("c.yaml", "cam0:", 5);
        std::ofstream(Folder() + "c.yaml", std::ios::binary | std::ios::app)
            .write(text, static_cast<std::streamsize>(size - 1));
        UseCameras("c.yaml");
        break;
      case 3:
        Write("c.cameramodel", text, size - 1);
        UseCameras("c.cameramodel");
        break;
      default: {
        // Both files in one input, parted by a line "===".
        const std::string both(text, size - 1);
        const size_t cut = both.find("===");
        UseModel(both.substr(0, cut), cut == std::string::npos ? "" : both.substr(cut + 3));
      }
    }
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}
