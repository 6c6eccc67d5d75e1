// The office that an independent renderer photographed, its tones mapped by published operators: what maps locally is found, what
// maps the whole picture alike is not.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "forward/light/room.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "inverse/observe/observe_photos.h"
#include "tests/support/local_tones.h"
#include "tests/support/office_photos.h"
#include "tests/support/office_truth.h"

namespace luxfit {
namespace {

using support::kOfficeFolder;

struct Office {
  std::vector<Camera> cameras;
  Room room;
  RoomPhotos photos;
  Registration registration;
};

const Office& TheOffice() {
  static const Office office = [] {
    std::vector<Camera> cameras{ReadCamera(kOfficeFolder + "cam0.yaml")};
    Room room = MakeRoom(ReadScene(kOfficeFolder + "room.obj"));
    RoomPhotos photos = support::OfficePhotos();
    Registration registration =
        ObservePhotos(room, cameras, ReadTagMap(kOfficeFolder + "tags.json"), photos, support::OfficeStates())
            .registration;
    return Office{std::move(cameras), std::move(room), std::move(photos), std::move(registration)};
  }();
  return office;
}

using Operator = std::function<cv::Mat(const cv::Mat& counts)>;

LuminanceImage Mapped(const LuminanceImage& image, const Operator& map) {
  std::vector<cv::Mat> channels;
  for (const int c : {2, 1, 0}) {
    ImagePlane plane = image.relative_rgb[static_cast<size_t>(c)];
    channels.push_back(
        cv::Mat(static_cast<int>(plane.rows()), static_cast<int>(plane.cols()), CV_32F, plane.data())
            .clone());
  }
  cv::Mat light, mapped;
  cv::merge(channels, light);
  map(light).convertTo(mapped, CV_32FC3);
  cv::split(mapped, channels);
  Photo photo;
  for (size_t c = 0; c < 3; ++c)
    photo.rgb_counts[c] = Eigen::Map<ImagePlane>(channels[2 - c].ptr<float>(), mapped.rows, mapped.cols);
  photo.bits_per_channel = 32;
  photo.full_scale_counts = photo.saturation_counts = 1;
  return ToRelativeLuminance(photo, 1);
}

ToneMapping Found(const char* name, const Operator& map) {
  const Office& office = TheOffice();
  RoomPhotos photos = office.photos;
  photos.read = [&](size_t i) {
    return std::make_shared<const LuminanceImage>(Mapped(*office.photos.read(i), map));
  };
  const auto found =
      Observe(office.room, photos, office.cameras, office.registration, support::OfficeStates())
          .tone_mapping.at(0);
  EXPECT_TRUE(found);
  if (!found) return {};
  std::printf("%-32s k %7.4f +- %.4f, views differ by %.1f %%, with k %.1f %%\n", name, found->strength,
              found->sigma, 100 * found->difference, 100 * found->difference_without);
  return *found;
}

Operator Surround(double sigma, double strength) {
  return [=](const cv::Mat& counts) { return support::WithCompressedSurround(counts, sigma, strength); };
}

TEST(ToneMappedOffice, LocalOperatorsAreFound) {
  EXPECT_TRUE(Found("surround of 5 %, by 0.1", Surround(0.05, 0.1)).IsFound());
  EXPECT_TRUE(Found("surround of 2 %, by 0.4", Surround(0.02, 0.4)).IsFound());
  EXPECT_TRUE(Found("surround of 5 %, by 0.4", Surround(0.05, 0.4)).IsFound());
  EXPECT_TRUE(Found("surround of 15 %, by 0.4", Surround(0.15, 0.4)).IsFound());
  EXPECT_TRUE(Found("Reinhard, local", support::WithLocalTones).IsFound());
  EXPECT_TRUE(Found("equalised tiles", support::WithEqualisedTiles).IsFound());
  const auto bilateral = [](const cv::Mat& counts) { return support::WithBilateralBase(counts, 0.4); };
  EXPECT_TRUE(Found("bilateral base, by 0.4", bilateral).IsFound());
}

TEST(ToneMappedOffice, OneCurveForThePictureIsNot) {
  EXPECT_FALSE(Found("none", Surround(0.05, 0)).IsFound());
  EXPECT_FALSE(Found("power of 0.7", [](const cv::Mat& counts) {
                 cv::Mat mapped;
                 cv::pow(counts / cv::norm(counts, cv::NORM_INF), 0.7, mapped);
                 return mapped;
               }).IsFound());
}

}  // namespace
}  // namespace luxfit
