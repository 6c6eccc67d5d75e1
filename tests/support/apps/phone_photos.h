// The office's photos as a phone would have taken them: 8-bit JPEG with the sRGB curve, and EXIF of camera, time and
// exposure.
#ifndef LUXFIT_TESTS_SUPPORT_APPS_PHONE_PHOTOS_H_
#define LUXFIT_TESTS_SUPPORT_APPS_PHONE_PHOTOS_H_

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <exiv2/exiv2.hpp>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/paths.h"
#include "tests/support/local_tones.h"

namespace luxfit::support {

struct OfficePhoto {
  std::string png, view, state;
  double exposure_s = 0;
};

// Returns the rows of the office's photo table.
inline std::vector<OfficePhoto> OfficePhotos() {
  const std::string folder = std::string(LUXFIT_FIXTURES) + "/office/";
  std::ifstream table(folder + "photos.csv");
  std::vector<OfficePhoto> photos;
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    OfficePhoto photo;
    std::string camera, exposure_s;
    std::getline(fields, photo.png, ',');
    std::getline(fields, camera, ',');
    std::getline(fields, photo.view, ',');
    std::getline(fields, photo.state, ',');
    std::getline(fields, exposure_s, ',');
    photo.png = folder + photo.png;
    photo.exposure_s = std::stod(exposure_s);
    photos.push_back(photo);
  }
  EXPECT_EQ(photos.size(), 49U);
  return photos;
}

struct PhoneShot {
  OfficePhoto of;
  double stops = 0;  // of exposure, more than the office's photo has
  int taken_s = 0;   // after ten o'clock
  bool has_exif = true;
  double bend = 1;          // power of the light before the curve of sRGB, as makers bend theirs
  bool maps_tones = false;  // locally, WithLocalTones
};

// Names files in the ways of four makers. Each counts on with the number.
inline std::string PhoneName(size_t number) {
  char name[64];
  const int n = static_cast<int>(number);
  switch (number % 4) {
    case 0:
      std::snprintf(name, sizeof name, "IMG_%04d.jpg", 8970 + n);
      break;
    case 1:
      std::snprintf(name, sizeof name, "DSC_%04d.JPG", 95 + n);
      break;
    case 2:
      std::snprintf(name, sizeof name, "PXL_20240501_1000%02d123.jpg", n);
      break;
    default:
      std::snprintf(name, sizeof name, "20240501_1000%02d.jpeg", n);
  }
  return name;
}

inline cv::Mat WithSrgbCurve(const cv::Mat& counts, double stops, double bend) {
  cv::Mat bytes(counts.rows, counts.cols, CV_8UC3);
  const double scale = std::exp2(stops) / 65535;
  for (int v = 0; v < counts.rows; ++v) {
    for (int u = 0; u < counts.cols; ++u) {
      for (int c = 0; c < 3; ++c) {
        const double x = std::pow(std::min(1.0, scale * counts.at<cv::Vec3w>(v, u)[c]), bend);
        const double y = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
        bytes.at<cv::Vec3b>(v, u)[c] = static_cast<unsigned char>(std::lround(255 * y));
      }
    }
  }
  return bytes;
}

inline void WritePhoneShot(const std::string& path, const PhoneShot& shot) {
  cv::Mat counts = cv::imread(shot.of.png, cv::IMREAD_UNCHANGED);
  if (shot.maps_tones) WithLocalTones(counts).convertTo(counts, CV_16UC3, 65535);
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  ASSERT_TRUE(
      cv::imwrite(path, WithSrgbCurve(counts, shot.stops, shot.bend), {cv::IMWRITE_JPEG_QUALITY, 92}));
  if (!shot.has_exif) return;
  const auto image = Exiv2::ImageFactory::open(path);
  Exiv2::ExifData& exif = image->exifData();
  char time[32];
  std::snprintf(time, sizeof time, "2024:05:01 %02d:%02d:%02d", 10 + shot.taken_s / 3600,
                shot.taken_s / 60 % 60, shot.taken_s % 60);
  exif["Exif.Image.Make"] = "Maker";
  exif["Exif.Image.Model"] = "Phone 7";
  exif["Exif.Photo.DateTimeOriginal"] = time;
  exif["Exif.Photo.ExposureTime"] = Exiv2::Rational(
      static_cast<int>(std::lround(shot.of.exposure_s * std::exp2(shot.stops) * 1e6)), 1000000);
  exif["Exif.Photo.FNumber"] = Exiv2::Rational(18, 10);
  exif["Exif.Photo.ISOSpeedRatings"] = static_cast<uint16_t>(100);
  image->writeMetadata();
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_APPS_PHONE_PHOTOS_H_
