#include "calib/register/colmap_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

#include "tests/support/calib/colmap_installed.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::HasSubstr;

constexpr char kCameras[] = "# cameras\n1 PINHOLE 640 480 500 501 320.5 240.5\n";
// 90 degrees about x; an image without keypoints.
constexpr char kImages[] =
    "# images\n"
    "3 0.70710678118654752 0.70710678118654752 0 0 0.1 0.2 0.3 1 a_b.png\n"
    "10.5 20.5 7 30 40 -1\n"
    "5 1 0 0 0 -1 0 2 1 c.png\n"
    "\n"
    "9 1 0 0 0 0 0 0 1 d.png\n"
    "1 2 7\n";
constexpr char kPoints[] = "# points\n7 1.5 -2.5 3.5 255 0 0 0.25 3 0 9 0\n";

class ColmapModelTest : public testing::Test {
 protected:
  void WriteText(const std::string& cameras, const std::string& images, const std::string& points) {
    folder_.Write("m/cameras.txt", cameras);
    folder_.Write("m/images.txt", images);
    folder_.Write("m/points3D.txt", points);
  }
  std::string MessageOf(const std::string& folder) const {
    try {
      ReadColmapModel(folder);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }
  void ExpectTheModel(const ColmapModel& model) const {
    ASSERT_EQ(model.images.size(), 3u);
    EXPECT_EQ(model.cameras.at(1).fx_px, 500);
    EXPECT_EQ(model.cameras.at(1).cx_px, 320);  // half a pixel less than COLMAP's
    const ColmapImage& first = model.images.at(3);
    EXPECT_EQ(first.name, "a_b.png");
    // Turned by 90 degrees about x, (x, y, z) becomes (x, -z, y).
    EXPECT_TRUE(
        (first.cam_from_model * Eigen::Vector3d(1, 2, 3)).isApprox(Eigen::Vector3d(1.1, -2.8, 2.3), 1e-12));
    ASSERT_EQ(first.keypoints_px.size(), 2u);
    EXPECT_EQ(first.keypoints_px[0], Eigen::Vector2d(10, 20));
    EXPECT_TRUE(model.images.at(5).keypoints_px.empty());
    ASSERT_EQ(model.points.size(), 1u);
    EXPECT_EQ(model.points.at(7).p_in_model, Eigen::Vector3d(1.5, -2.5, 3.5));
    ASSERT_EQ(model.points.at(7).track.size(), 2u);
    EXPECT_EQ(model.points.at(7).track[1].image, 9);
    EXPECT_EQ(model.points.at(7).track[1].keypoint, 0);
  }
  TempFolder folder_;
};

template <typename T>
void Append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

TEST_F(ColmapModelTest, ReadsText) {
  WriteText(kCameras, kImages, kPoints);
  ExpectTheModel(ReadColmapModel(folder_.Path("m")));
}

TEST_F(ColmapModelTest, ReadsBinary) {
  std::string cameras, images, points;
  Append<std::uint64_t>(cameras, 1);
  Append<std::uint32_t>(cameras, 1);
  Append<std::int32_t>(cameras, 1);
  Append<std::uint64_t>(cameras, 640);
  Append<std::uint64_t>(cameras, 480);
  for (const double value : {500., 501., 320.5, 240.5}) Append(cameras, value);
  Append<std::uint64_t>(images, 3);
  const auto add_image = [&images](std::uint32_t id, const std::vector<double>& pose, const std::string& name,
                                   const std::vector<double>& xy, const std::vector<std::uint64_t>& ids) {
    Append(images, id);
    for (const double value : pose) Append(images, value);
    Append<std::uint32_t>(images, 1);
    images += name + '\0';
    Append<std::uint64_t>(images, ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      Append(images, xy[2 * i]);
      Append(images, xy[2 * i + 1]);
      Append(images, ids[i]);
    }
  };
  add_image(3, {0.70710678118654752, 0.70710678118654752, 0, 0, 0.1, 0.2, 0.3}, "a_b.png",
            {10.5, 20.5, 30, 40}, {7, UINT64_MAX});
  add_image(5, {1, 0, 0, 0, -1, 0, 2}, "c.png", {}, {});
  add_image(9, {1, 0, 0, 0, 0, 0, 0}, "d.png", {1, 2}, {7});
  Append<std::uint64_t>(points, 1);
  Append<std::uint64_t>(points, 7);
  for (const double value : {1.5, -2.5, 3.5}) Append(points, value);
  points += "\xff";
  points += std::string(2, '\0');
  Append(points, 0.25);
  Append<std::uint64_t>(points, 2);
  for (const std::uint32_t value : {3, 0, 9, 0}) Append(points, value);
  folder_.Write("b/cameras.bin", cameras);
  folder_.Write("b/images.bin", images);
  folder_.Write("b/points3D.bin", points);
  ExpectTheModel(ReadColmapModel(folder_.Path("b")));
  for (std::size_t cut : {std::size_t{0}, std::size_t{9}, images.size() - 1}) {
    folder_.Write("b/images.bin", images.substr(0, cut));
    EXPECT_THAT(MessageOf(folder_.Path("b")),
                HasSubstr("images.bin: expected more data, got the end of the file"));
  }
}

TEST_F(ColmapModelTest, WritesWhatItReads) {
  WriteText(kCameras, kImages, kPoints);
  const ColmapModel model = ReadColmapModel(folder_.Path("m"));
  folder_.Write("w/cameras.txt", kCameras);
  folder_.Write("w/images.txt", ColmapImagesText(model));
  folder_.Write("w/points3D.txt", ColmapPointsText(model));
  ExpectTheModel(ReadColmapModel(folder_.Path("w")));
}

TEST_F(ColmapModelTest, NamesThatWouldBreakALineAreRefused) {
  WriteText(kCameras, kImages, kPoints);
  ColmapModel model = ReadColmapModel(folder_.Path("m"));
  model.images.begin()->second.name = "a\n1 1 0 0 0 0 0 0 1 b";
  EXPECT_THROW(ColmapImagesText(model), std::invalid_argument);
}

TEST_F(ColmapModelTest, ColmapReadsItAndItsBinaryIsRead) {
  LUXFIT_SKIP_WITHOUT_COLMAP();
  WriteText(kCameras, kImages, kPoints);
  folder_.Write("c/none", "");
  const std::string command = "colmap model_converter --input_path " + folder_.Path("m") + " --output_path " +
                              folder_.Path("c") + " --output_type BIN > /dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  ExpectTheModel(ReadColmapModel(folder_.Path("c")));
}

TEST_F(ColmapModelTest, MalformedFilesAreNamed) {
  const auto message = [&](const std::string& cameras, const std::string& images, const std::string& points) {
    WriteText(cameras, images, points);
    return MessageOf(folder_.Path("m"));
  };
  EXPECT_THAT(message(kCameras, "3 1 0 0 0 0 0 0 1\n", ""),
              HasSubstr("images.txt:1: expected IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME"));
  EXPECT_THAT(message(kCameras, "3 1 1 0 0 0 0 0 1 a\n\n", ""),
              HasSubstr("images.txt:1: expected a unit quaternion"));
  EXPECT_THAT(message(kCameras, "3 1 0 0 0 0 0 0 1 a\n1 2\n", ""),
              HasSubstr("images.txt:2: expected triples"));
  EXPECT_THAT(message(kCameras, "3 1 0 0 0 0 0 0 2 a\n\n", ""),
              HasSubstr("expected a camera of the model, got 2"));
  EXPECT_THAT(message(kCameras, "3 1 0 0 0 0 0 0 1 a\n\n3 1 0 0 0 0 0 0 1 a\n\n", ""),
              HasSubstr("images.txt:4: expected every image once, got 3 again"));
  EXPECT_THAT(message(kCameras, kImages, "7 1 2\n"), HasSubstr("points3D.txt:1: expected POINT3D_ID X Y Z"));
  EXPECT_THAT(message(kCameras, kImages, "7 1 2 3 0 0 0 1 3\n"), HasSubstr("expected a track of pairs"));
  EXPECT_THAT(message(kCameras, kImages, "7 1 2 3 0 0 0 1 4 0\n"), HasSubstr("got image 4"));
  EXPECT_THAT(message(kCameras, kImages, "7 1 2 3 0 0 0 1 3 2\n"), HasSubstr("(it has 2), got 2"));
  EXPECT_THAT(message(kCameras, kImages, "7 nan 2 3 0 0 0 1 3 1\n"), HasSubstr("points3D.txt:1"));
}

TEST_F(ColmapModelTest, AFolderWithoutAModelIsNamed) {
  WriteText(kCameras, kImages, kPoints);
  EXPECT_THAT(MessageOf(folder_.Path("none")), HasSubstr("expected a COLMAP model"));
  folder_.Write("sparse/0/cameras.txt", kCameras);
  EXPECT_THAT(MessageOf(folder_.Path("sparse")), HasSubstr("did you mean"));
}

// COLMAP counts to 2^32 - 1.
TEST_F(ColmapModelTest, LargeIdsAreRead) {
  WriteText(
      "4294967295 PINHOLE 640 480 500 501 320.5 240.5\n",
      "3000000000 1 0 0 0 0 0 0 4294967295 a.png\n1 2 7\n3000000001 1 0 0 0 1 0 0 4294967295 b.png\n1 2 7\n",
      "7 1 2 3 0 0 0 0 3000000000 0 3000000001 0\n");
  const ColmapModel model = ReadColmapModel(folder_.Path("m"));
  EXPECT_EQ(model.images.at(3000000001).name, "b.png");
  EXPECT_EQ(model.images.at(3000000000).camera, 4294967295);
  EXPECT_EQ(model.points.at(7).track[1].image, 3000000001);
}

TEST_F(ColmapModelTest, ANewerCameraModelIsRefusedWithARemedy) {
  WriteText("1 SIMPLE_DIVISION 640 480 500 320 240 0.1\n", kImages, kPoints);
  EXPECT_THAT(MessageOf(folder_.Path("m")),
              testing::AllOf(
                  HasSubstr("cameras.txt:1: expected a camera model of COLMAP 3.8, got \"SIMPLE_DIVISION\""),
                  HasSubstr("--ImageReader.camera_model FULL_OPENCV")));
}

}  // namespace
}  // namespace luxfit
