#include "calib/lens/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "tests/support/calib/office_camera.h"

namespace luxfit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ReadCameraTest : public testing::Test {
 protected:
  std::string Write(const std::string& text, const std::string& ending = ".yaml") {
    path_ = testing::TempDir() + "luxfit_camera_" +
            testing::UnitTest::GetInstance()->current_test_info()->name() + ending;
    std::ofstream(path_, std::ios::binary) << text;
    return path_;
  }
  std::string MessageOf(const std::string& text, const std::string& ending = ".yaml") {
    try {
      ReadCameraFile(Write(text, ending));
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }
  void TearDown() override {
    if (!path_.empty()) std::remove(path_.c_str());
  }
  std::string path_;
};

std::string Yaml(const std::string& size, const std::string& matrix, const std::string& distortion) {
  return "%YAML:1.0\n---\n" + size + matrix + distortion;
}
const char* const kSize = "image_width: 960\nimage_height: 720\n";
const char* const kMatrix =
    "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 742., 0., 483.1, 0., 741.2, 356.4, 0., 0., 1. ]\n";
const char* const kDistortion =
    "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
    "   data: [ -0.112, 0.061, 4e-4, -7e-4, 0.01 ]\n";

TEST_F(ReadCameraTest, ReadsWhatOpenCvWrites) {
  const Camera camera = ReadCamera(Write(Yaml(kSize, kMatrix, kDistortion)));
  EXPECT_EQ(camera.width_px, 960);
  EXPECT_EQ(camera.height_px, 720);
  EXPECT_EQ(camera.fx_px, 742);
  EXPECT_EQ(camera.fy_px, 741.2);
  EXPECT_EQ(camera.cx_px, 483.1);
  EXPECT_EQ(camera.cy_px, 356.4);
  EXPECT_THAT(camera.distortion, testing::ElementsAre(-0.112, 0.061, 4e-4, -7e-4, 0.01, 0, 0, 0, 0, 0, 0, 0));
}

TEST_F(ReadCameraTest, NamesFileKeyAndWhatWasExpected) {
  const std::string no_width = MessageOf(Yaml("image_height: 720\n", kMatrix, kDistortion));
  EXPECT_THAT(no_width, StartsWith(path_ + ": image_width: expected a number of pixels, got nothing"));
  EXPECT_THAT(MessageOf(Yaml("image_width: -5\nimage_height: 720\n", kMatrix, kDistortion)),
              HasSubstr("image_width: expected a whole number of pixels, 1 to 1000000, got -5"));
  EXPECT_THAT(MessageOf(Yaml("image_width: wide\nimage_height: 720\n", kMatrix, kDistortion)),
              HasSubstr("image_width: expected a number"));
  EXPECT_THAT(MessageOf(Yaml(kSize, "", kDistortion)),
              HasSubstr("camera_matrix: expected an !!opencv-matrix"));
  EXPECT_THAT(MessageOf(Yaml(kSize, "camera_matrix: 3\n", kDistortion)),
              HasSubstr("camera_matrix: expected an !!opencv-matrix"));
  EXPECT_THAT(
      MessageOf(
          Yaml(kSize,
               "camera_matrix: !!opencv-matrix\n   rows: 2000000000\n   cols: 3\n   dt: d\n   data: [ 1. ]\n",
               kDistortion)),
      HasSubstr("camera_matrix: expected 1 to 16 rows, got 2000000000"));
  const std::string two_by_two =
      "camera_matrix: !!opencv-matrix\n   rows: 2\n   cols: 2\n   dt: d\n   data: [ 1., 0., 0., 1. ]\n";
  EXPECT_THAT(MessageOf(Yaml(kSize, two_by_two, kDistortion)), HasSubstr("expected 3 x 3, got 2 x 2"));
  const std::string negative =
      "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ -742., 0., 483., 0., 741., 356., 0., 0., 1. ]\n";
  EXPECT_THAT(MessageOf(Yaml(kSize, negative, kDistortion)), HasSubstr("expected focal lengths > 0 px"));
  const std::string six =
      "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 6\n   dt: d\n"
      "   data: [ 0., 0., 0., 0., 0., 0. ]\n";
  EXPECT_THAT(MessageOf(Yaml(kSize, kMatrix, six)),
              HasSubstr("distortion_coefficients: expected 4, 5, 8 or 12 in one row or column, got 1 x 6"));
}

TEST_F(ReadCameraTest, FilesThatAreNoCalibrationAreNamed) {
  const std::string garbage = MessageOf("not yaml at all\n");
  EXPECT_THAT(garbage, StartsWith(path_ + ": cannot read the calibration"));
  EXPECT_THAT(MessageOf("%YAML:1.0\n---\nimage_width: [ 1, 2\n"), StartsWith(path_ + ": "));
  EXPECT_THAT(MessageOf(""), StartsWith(path_ + ": "));
  EXPECT_THROW(ReadCamera("no/such.yaml"), std::runtime_error);
}

void ExpectSame(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.width_px, b.width_px);
  EXPECT_EQ(a.height_px, b.height_px);
  EXPECT_EQ(static_cast<int>(a.lens), static_cast<int>(b.lens));
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.1, 0.2, 1), Eigen::Vector3d(-0.5, 0.3, 1)}) {
    // Files have 16 digits or more.
    EXPECT_LT((Project(a, p) - Project(b, p)).norm(), 1e-9);
  }
}

std::vector<Camera> SomeCameras() {
  std::vector<Camera> cameras = {OfficeCamera({}), OfficeCamera({-0.112, 0.061, 4e-4, -7e-4}),
                                 OfficeCamera({-0.1, 0.06, 4e-4, -7e-4, 0.01}),
                                 OfficeCamera({-0.1, 0.06, 4e-4, -7e-4, 0.01, 0.02, 0.03, 0.04}),
                                 OfficeCamera({0.02, -0.01, 3e-3, -4e-4})};
  cameras.back().lens = LensModel::kFisheye;
  return cameras;
}

TEST_F(ReadCameraTest, EveryCameraComesBackFromOpenCvsYaml) {
  std::vector<Camera> cameras = SomeCameras();
  cameras.push_back(OfficeCamera({-0.1, 0.06, 4e-4, -7e-4, 0.01, 0, 0, 0, 1e-4, 0, 2e-4, 0}));
  for (const Camera& camera : cameras) ExpectSame(ReadCamera(Write(OpenCvCameraYaml(camera))), camera);
}

TEST_F(ReadCameraTest, EveryCameraComesBackFromColmap) {
  std::map<ColmapId, Camera> by_id;
  for (const Camera& camera : SomeCameras()) by_id[static_cast<int>(by_id.size()) + 3] = camera;
  const std::string path = Write(ColmapCamerasText(by_id), ".txt");
  const std::map<ColmapId, Camera> read = ReadColmapCameras(path);
  ASSERT_EQ(read.size(), by_id.size());
  for (const auto& [id, camera] : by_id) {
    ExpectSame(read.at(id), camera);
    ExpectSame(ReadCamera(path, std::to_string(id)), camera);
  }
  EXPECT_THROW(ReadCamera(path, "cam0"), std::runtime_error);
}

// As COLMAP's documentation gives it; its principal point is half a pixel from the house's.
TEST_F(ReadCameraTest, ColmapsPixelsAreHalfAPixelOff) {
  const std::string text = "# Camera list\n1 SIMPLE_PINHOLE 3072 2304 2559.81 1536 1152\n";
  const Camera camera = ReadCamera(Write(text, ".txt"));
  EXPECT_EQ(camera.fx_px, 2559.81);
  EXPECT_EQ(camera.fy_px, 2559.81);
  EXPECT_EQ(camera.cx_px, 1535.5);
  EXPECT_EQ(camera.cy_px, 1151.5);
}

TEST_F(ReadCameraTest, ColmapsBinaryCameras) {
  std::string bytes;
  const auto put = [&bytes](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  put(std::uint64_t{1});
  put(std::uint32_t{7});
  put(std::int32_t{3});  // RADIAL
  put(std::uint64_t{960});
  put(std::uint64_t{720});
  for (const double value : {742.0, 480.5, 360.5, -0.1, 0.02}) put(value);
  const Camera camera = ReadCamera(Write(bytes, ".bin"));
  Camera expected = OfficeCamera({-0.1, 0.02});
  expected.fy_px = expected.fx_px;
  expected.cx_px = 480;
  expected.cy_px = 360;
  ExpectSame(camera, expected);
  EXPECT_THAT(MessageOf(bytes.substr(0, bytes.size() - 3), ".bin"), HasSubstr("the end of the file"));
}

TEST_F(ReadCameraTest, ColmapsBadLinesAreNamed) {
  EXPECT_THAT(MessageOf("#\n1 FOV 9 9 1 2 3 4 5\n", ".txt"), HasSubstr(":2: expected a camera model other"));
  EXPECT_THAT(MessageOf("1 PINHOLE 9 9 1 2 3\n", ".txt"),
              HasSubstr(":1: expected 4 parameters of PINHOLE, got 3"));
  EXPECT_THAT(MessageOf("1 PINHOLE 9 9 1 2 3 x\n", ".txt"), HasSubstr(":1: expected 4 parameters"));
  EXPECT_THAT(MessageOf("hello\n", ".txt"), HasSubstr(":1: expected CAMERA_ID MODEL"));
  EXPECT_THAT(MessageOf("1 PINHOLE 9 9 -1 2 3 4\n", ".txt"), HasSubstr("expected focal lengths > 0"));
}

// The text of mrcal's own test data, cam1.opencv8.cameramodel.
const char* const kCameraModel =
    "{\n 'lensmodel': 'LENSMODEL_OPENCV8',\n"
    " 'intrinsics': [ 1761, 1761, 1965, 1087, -0.02, 0.03, 0.0002, 0.0005, 0.0196, 0.01, -0.05, 0.04,],\n"
    " 'extrinsics': [ 2e-1, 1e-1, -1e-2, 2., 2, -2.5, ],\n 'imagersize': [ 4000, 2200 ]\n}\n";

TEST_F(ReadCameraTest, MrcalsCameraModel) {
  const std::vector<FiledCamera> read = ReadCameraFile(Write(kCameraModel, ".cameramodel"));
  ASSERT_EQ(read.size(), 1u);
  const Camera& camera = read[0].camera;
  EXPECT_EQ(camera.width_px, 4000);
  EXPECT_EQ(camera.cy_px, 1087);
  EXPECT_THAT(camera.distortion,
              testing::ElementsAre(-0.02, 0.03, 0.0002, 0.0005, 0.0196, 0.01, -0.05, 0.04, 0, 0, 0, 0));
  ASSERT_TRUE(read[0].cam_from_reference.has_value());
  EXPECT_LT((read[0].cam_from_reference->translation() - Eigen::Vector3d(2, 2, -2.5)).norm(), 1e-12);
  const std::vector<FiledCamera> again = ReadCameraFile(Write(MrcalCameraModel(read[0]), ".cameramodel"));
  ExpectSame(again[0].camera, camera);
  EXPECT_LT((again[0].cam_from_reference->matrix() - read[0].cam_from_reference->matrix()).norm(), 1e-12);
}

TEST_F(ReadCameraTest, ASplinedLensComesBackFromMrcalsCameraModel) {
  FiledCamera filed;
  filed.camera = OfficeCamera({});
  filed.camera.lens = LensModel::kSplined;
  filed.camera.spline = {3, 6, 5, 120, {}};
  for (int i = 0; i < 60; ++i) filed.camera.spline.control_points.push_back(0.001 * i);
  ExpectSame(ReadCamera(Write(MrcalCameraModel(filed), ".cameramodel")), filed.camera);
  EXPECT_THROW(OpenCvCameraYaml(filed.camera), std::invalid_argument);
  EXPECT_THROW(ToColmapModel(filed.camera), std::invalid_argument);
}

// Newer mrcal's key; other keys, comments, nested lists and byte strings are passed over.
TEST_F(ReadCameraTest, NewerCameraModelsAreReadToo) {
  std::string text = kCameraModel;
  text.replace(text.find("'extrinsics'"), 12, "'rt_cam_ref'");
  text.replace(text.find("'imagersize'"), 0,
               "# a comment with a ' quote\n 'valid_intrinsics_region': [ [ 622, 0 ], [ 0, 634 ] ],\n"
               " 'optimization_inputs': b'c2ZN#',\n 'icam_intrinsics': None,\n ");
  const std::vector<FiledCamera> read = ReadCameraFile(Write(text, ".cameramodel"));
  EXPECT_EQ(read[0].camera.width_px, 4000);
  EXPECT_EQ(read[0].cam_from_reference->translation().z(), -2.5);
}

TEST_F(ReadCameraTest, MrcalsBadModelsAreNamed) {
  EXPECT_THAT(MessageOf("{ 'lensmodel': 'LENSMODEL_CAHVOR', 'intrinsics': [1,1,1,1,0,0,0,0,0],"
                        " 'extrinsics': [0,0,0,0,0,0], 'imagersize': [4,4] }",
                        ".cameramodel"),
              HasSubstr("got LENSMODEL_CAHVOR"));
  EXPECT_THAT(MessageOf("nonsense", ".cameramodel"),
              HasSubstr(":1: expected a dictionary in braces, got 'n'"));
  EXPECT_THAT(MessageOf("{ 'lensmodel':\n 'LENSMODEL_OPEN", ".cameramodel"),
              HasSubstr(":2: expected the string's"));
  EXPECT_THAT(MessageOf("{ 'lensmodel': 'LENSMODEL_PINHOLE',\n 'intrinsics': [ 1, 2, 3 ] }", ".cameramodel"),
              HasSubstr(":2: intrinsics: expected a list of 4 numbers, got 3"));
  EXPECT_THAT(MessageOf("{ 'lensmodel': 'LENSMODEL_NEW' }", ".cameramodel"),
              HasSubstr("got 'LENSMODEL_NEW'"));
}

const char* const kCamchain =
    "cam0:\n  camera_model: pinhole\n  intrinsics: [742, 741.2, 483.1, 356.4]\n  distortion_model: radtan\n"
    "  distortion_coeffs: [-0.112, 0.061, 0.0004, -0.0007]\n  resolution: [960, 720]\n"
    "cam1:\n  camera_model: pinhole\n  intrinsics: [742, 741.2, 483.1, 356.4]\n"
    "  distortion_model: equidistant\n  distortion_coeffs: [0.02, -0.01, 0.003, -0.0004]\n"
    "  resolution: [960, 720]\n  T_cn_cnm1:\n  - [1, 0, 0, -0.11]\n  - [0, 1, 0, 0]\n  - [0, 0, 1, 0]\n"
    "  - [0, 0, 0, 1]\n";

TEST_F(ReadCameraTest, KalibrsCamchain) {
  const std::vector<FiledCamera> read = ReadCameraFile(Write(kCamchain));
  ASSERT_EQ(read.size(), 2u);
  ExpectSame(read[0].camera, SomeCameras()[1]);
  ExpectSame(read[1].camera, SomeCameras()[4]);
  EXPECT_EQ(read[1].name, "cam1");
  ASSERT_TRUE(read[1].cam_from_reference.has_value());
  EXPECT_EQ(read[1].cam_from_reference->translation().x(), -0.11);
  const std::vector<FiledCamera> again = ReadCameraFile(Write(KalibrCamchainYaml(read)));
  ASSERT_EQ(again.size(), 2u);
  ExpectSame(again[1].camera, read[1].camera);
  EXPECT_EQ(again[1].cam_from_reference->matrix(), read[1].cam_from_reference->matrix());
}

TEST_F(ReadCameraTest, KalibrsBadChainsAreNamedByLine) {
  EXPECT_THAT(MessageOf("cam0:\n  camera_model: omni\n"),
              HasSubstr(":2: camera_model: expected pinhole, got \"omni\""));
  EXPECT_THAT(MessageOf("cam0:\n  camera_model: pinhole\n  resolution: [960]\n"),
              HasSubstr(":3: resolution: expected a list of 2 numbers"));
  EXPECT_THAT(MessageOf("cam0:\n  camera_model: [\n"), HasSubstr("expected a Kalibr camchain"));
}

}  // namespace
}  // namespace luxfit
