#include <cstdio>
#include <iomanip>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "calib/internal/camera_formats.h"
#include "calib/internal/mrcal_lens.h"

namespace luxfit {
namespace {

struct FreeModel {
  void operator()(mrcal_cameramodel_t* model) const { mrcal_free_cameramodel(&model); }
};

// mrcal's rt: rotation vector and translation, p_in_cam = R(r) p + t.
Eigen::Isometry3d ToIsometry(const double* rt) {
  const Eigen::Vector3d r(rt[0], rt[1], rt[2]);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (r.norm() > 0) pose.linear() = Eigen::AngleAxisd(r.norm(), r.normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(rt[3], rt[4], rt[5]);
  return pose;
}

template <typename Values>
void AppendNumbers(const Values& values, std::ostringstream& out) {
  for (const double value : values) out << " " << value << ",";
}

}  // namespace

FiledCamera ReadMrcalCamera(const std::string& path) {
  const std::unique_ptr<mrcal_cameramodel_t, FreeModel> model(mrcal_read_cameramodel_file(path.c_str()));
  if (model == nullptr) {
    throw std::runtime_error(
        path +
        ": cannot read the calibration, expected a .cameramodel with lensmodel, intrinsics, extrinsics and "
        "imagersize as mrcal 2.2 and older write it (newer ones with rt_cam_ref alone: convert with "
        "mrcal-to-opencv or add extrinsics)");
  }
  MrcalLens lens{model->lensmodel, {}};
  const int count = mrcal_lensmodel_num_params(&lens.model);
  lens.intrinsics.assign(model->intrinsics, model->intrinsics + count);
  Camera size;
  size.width_px = static_cast<int>(model->imagersize[0]);
  size.height_px = static_cast<int>(model->imagersize[1]);
  try {
    return {"", FromMrcal(lens, size), ToIsometry(model->rt_cam_ref)};
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error(path + ": lensmodel: " + e.what() + "; convert it with mrcal-convert-lensmodel");
  }
}

std::string MrcalCameraModel(const FiledCamera& filed) {
  const MrcalLens lens = ToMrcal(filed.camera);
  char name[128];
  if (!mrcal_lensmodel_name(name, sizeof(name), &lens.model))
    throw std::invalid_argument("camera: mrcal has no name for the lens model");
  const Eigen::Isometry3d pose = filed.cam_from_reference.value_or(Eigen::Isometry3d::Identity());
  const Eigen::AngleAxisd rotation(pose.linear());
  const Eigen::Vector3d r = rotation.angle() * rotation.axis();
  std::ostringstream out;
  out << std::setprecision(17) << "{\n    'lensmodel':  '" << name << "',\n\n"
      << "    # intrinsics are fx,fy,cx,cy,distortion0,distortion1,....\n    'intrinsics': [";
  AppendNumbers(lens.intrinsics, out);
  out << "],\n\n    # extrinsics are rt_fromref\n    'extrinsics': [";
  AppendNumbers(std::array<double, 6>{r.x(), r.y(), r.z(), pose.translation().x(), pose.translation().y(),
                                      pose.translation().z()},
                out);
  out << "],\n\n    'imagersize': [ " << filed.camera.width_px << ", " << filed.camera.height_px << ",]\n}\n";
  return out.str();
}

}  // namespace luxfit
