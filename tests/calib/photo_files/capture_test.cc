#include "calib/photo_files/capture.h"

#include <gtest/gtest.h>

#include <exiv2/exiv2.hpp>
#include <functional>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

// Returns what is read of a JPEG with the EXIF that `set` sets.
CaptureMetadata Read(const std::function<void(Exiv2::ExifData&)>& set) {
  const TempFolder folder;
  const std::string path = folder.Path("photo.jpg");
  EXPECT_TRUE(cv::imwrite(path, cv::Mat(8, 8, CV_8UC3, cv::Scalar(9, 9, 9))));
  const auto image = Exiv2::ImageFactory::open(path);
  set(image->exifData());
  image->writeMetadata();
  return ReadCaptureMetadata(path);
}

TEST(CaptureTest, CameraAndTime) {
  const CaptureMetadata capture = Read([](Exiv2::ExifData& exif) {
    exif["Exif.Image.Make"] = "Maker ";
    exif["Exif.Image.Model"] = "Phone 7";
    exif["Exif.Photo.DateTimeOriginal"] = "2024:02:29 12:34:56";
    exif["Exif.Photo.SubSecTimeOriginal"] = "25";
  });
  EXPECT_EQ(capture.camera, "Maker Phone 7");
  // date -u -d "2024-02-29 12:34:56" +%s
  EXPECT_DOUBLE_EQ(capture.taken_s.value_or(0), 1709210096.25);
}

TEST(CaptureTest, TheFilesOwnTimeWhereTheShotsIsMissing) {
  const CaptureMetadata capture =
      Read([](Exiv2::ExifData& exif) { exif["Exif.Image.DateTime"] = "1970:01:02 00:00:01"; });
  EXPECT_DOUBLE_EQ(capture.taken_s.value_or(0), 86401);
  EXPECT_EQ(capture.camera, "");
}

TEST(CaptureTest, NoTimeIsMadeUp) {
  for (const char* time : {"0000:00:00 00:00:00", "    :  :     :  :  ", "yesterday", "2024:00:01 00:00:00"})
    EXPECT_FALSE(Read([&](Exiv2::ExifData& exif) { exif["Exif.Photo.DateTimeOriginal"] = time; }).taken_s)
        << time;
  EXPECT_FALSE(ReadCaptureMetadata("/nowhere.jpg").taken_s);
}

}  // namespace
}  // namespace luxfit
