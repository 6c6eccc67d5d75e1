// exr_channels.h and false_colours.h: what is written is read by others as it was.
#include "apps/export/exr_channels.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "apps/export/false_colours.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

ImagePlane Ramp(Eigen::Index rows, Eigen::Index cols, float factor) {
  ImagePlane plane(rows, cols);
  for (Eigen::Index v = 0; v < rows; ++v) {
    for (Eigen::Index u = 0; u < cols; ++u) plane(v, u) = factor * static_cast<float>(10 * v + u);
  }
  return plane;
}

// Returns all float channels of a file whose window begins at (0, 0), by name.
std::map<std::string, ImagePlane> ReadChannels(const std::string& path) {
  Imf::InputFile file(path.c_str());
  const Imath::Box2i window = file.header().dataWindow();
  std::map<std::string, ImagePlane> planes;
  Imf::FrameBuffer buffer;
  const Imf::ChannelList& channels = file.header().channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    ImagePlane& plane = planes[channel.name()];
    plane.resize(window.max.y + 1, window.max.x + 1);
    buffer.insert(channel.name(), {Imf::FLOAT, reinterpret_cast<char*>(plane.data()), sizeof(float),
                                   sizeof(float) * static_cast<size_t>(plane.cols())});
  }
  file.setFrameBuffer(buffer);
  file.readPixels(0, window.max.y);
  return planes;
}

TEST(ExrChannels, NamedPlanesComeBackBitForBit) {
  const TempFolder folder;
  ImagePlane lux = Ramp(3, 5, 123.456F);
  lux(1, 2) = std::numeric_limits<float>::quiet_NaN();
  WriteExrChannels(folder.Path("a.exr"), {{"illuminance_lx", lux}, {"gap", Ramp(3, 5, 1)}}, {{"note", "x"}});
  const auto planes = ReadChannels(folder.Path("a.exr"));
  ASSERT_EQ(planes.size(), 2U);
  EXPECT_TRUE(std::isnan(planes.at("illuminance_lx")(1, 2)));
  EXPECT_EQ(planes.at("illuminance_lx")(2, 4), lux(2, 4));
  EXPECT_TRUE((planes.at("gap") == Ramp(3, 5, 1)).all());
}

TEST(ExrChannels, AnotherReaderFindsTheSamePixels) {
  const TempFolder folder;
  const ImagePlane red = Ramp(4, 6, 1.5F), green = Ramp(4, 6, -2), blue = Ramp(4, 6, 0.001F);
  WriteExrChannels(folder.Path("rgb.exr"), {{"R", red}, {"G", green}, {"B", blue}});
  const cv::Mat image = cv::imread(folder.Path("rgb.exr"), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(image.type(), CV_32FC3);
  for (int v = 0; v < 4; ++v) {
    for (int u = 0; u < 6; ++u)
      EXPECT_EQ(image.at<cv::Vec3f>(v, u), cv::Vec3f(blue(v, u), green(v, u), red(v, u)));
  }
}

TEST(ExrChannels, WrongPlanesAndPlacesAreRefused) {
  const TempFolder folder;
  EXPECT_THROW(WriteExrChannels(folder.Path("a.exr"), {{"a", Ramp(2, 2, 1)}, {"b", Ramp(2, 3, 1)}}),
               std::invalid_argument);
  EXPECT_THROW(WriteExrChannels(folder.Path("a.exr"), {{"a", Ramp(2, 2, 1)}, {"a", Ramp(2, 2, 1)}}),
               std::invalid_argument);
  EXPECT_THROW(WriteExrChannels("/proc/nowhere/a.exr", {{"a", Ramp(2, 2, 1)}}), std::runtime_error);
}

TEST(FalseColours, APixelHasTheColourOfItsValue) {
  const TempFolder folder;
  ImagePlane values = Ramp(20, 200, 1);
  values(0, 1) = std::numeric_limits<float>::quiet_NaN();
  const ColourScale scale{0, 400, "lx"};
  WriteFalseColourPng(folder.Path("a.png"), values, scale);
  const cv::Mat image = cv::imread(folder.Path("a.png"), cv::IMREAD_COLOR);
  ASSERT_EQ(image.cols, 200);
  ASSERT_GT(image.rows, 20);  // and the scale below
  for (int v = 0; v < 20; ++v) {
    for (int u = 0; u < 200; ++u) {
      const Eigen::Vector3i colour = v == 0 && u == 1 ? UnknownColour() : FalseColour(values(v, u) / 400.0);
      EXPECT_EQ(image.at<cv::Vec3b>(v, u),
                cv::Vec3b(static_cast<unsigned char>(colour[2]), static_cast<unsigned char>(colour[1]),
                          static_cast<unsigned char>(colour[0])));
    }
  }
}

TEST(FalseColours, LightnessRisesWithTheValue) {
  double last = -1;
  for (int i = 0; i <= 64; ++i) {
    const Eigen::Vector3d rgb = FalseColour(i / 64.0).cast<double>();
    const double luma = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    EXPECT_GT(luma, last);
    last = luma;
  }
}

TEST(FalseColours, ScaleEndsAtARoundNumberAboveTheValues) {
  EXPECT_EQ(ScaleOf(ImagePlane::Constant(3, 3, 183), "").upper, 200);
  EXPECT_NEAR(ScaleOf(ImagePlane::Constant(3, 3, 0.7F), "").upper, 0.7, 1e-12);  // 7 x 0.1
  EXPECT_EQ(ScaleOf(ImagePlane::Constant(3, 3, std::numeric_limits<float>::quiet_NaN()), "").upper, 1);
}

}  // namespace
}  // namespace luxfit
