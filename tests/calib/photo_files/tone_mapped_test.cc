#include "calib/photo_files/tone_mapped.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <exiv2/exiv2.hpp>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/support/calib/test_heic.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::HasSubstr;

std::string SignOfJpeg(const std::function<void(Exiv2::Image&)>& set, const std::string& name = "photo.JPG") {
  const TempFolder folder;
  const std::string path = folder.Path(name);
  EXPECT_TRUE(cv::imwrite(path, cv::Mat(8, 8, CV_8UC3, cv::Scalar(9, 9, 9))));
  const auto image = Exiv2::ImageFactory::open(path);
  image->readMetadata();
  set(*image);
  image->writeMetadata();
  return SignOfToneMapping(path);
}

std::string SignOfExif(const std::string& make, const std::string& key, const std::string& value) {
  return SignOfJpeg([&](Exiv2::Image& image) {
    image.exifData()["Exif.Image.Make"] = make;
    Exiv2::Exifdatum& datum = image.exifData()[key];
    datum.setValue(value);
  });
}

TEST(ToneMapped, NothingIsSaidOfPlainPhotos) {
  EXPECT_EQ(SignOfJpeg([](Exiv2::Image&) {}), "");
  EXPECT_EQ(SignOfExif("Apple", "Exif.Photo.CustomRendered", "0"), "");
  EXPECT_EQ(SignOfExif("Apple", "Exif.Photo.CustomRendered", "4"), "");  // the original beside a mapped one
  EXPECT_EQ(SignOfExif("NIKON", "Exif.Photo.CustomRendered", "3"), "");  // the standard knows 0 and 1 only
  EXPECT_EQ(SignOfExif("Maker", "Exif.Image.Software", "HDR view 2"), "");
  EXPECT_EQ(SignOfToneMapping("/nowhere.jpg"), "");
}

TEST(ToneMapped, PhonesThatSaySo) {
  EXPECT_THAT(SignOfExif("Apple", "Exif.Photo.CustomRendered", "3"), HasSubstr("CustomRendered"));
  EXPECT_THAT(SignOfExif("Google", "Exif.Image.Software", "HDR+ 1.0.540104767zd"), HasSubstr("HDR+"));
}

// A picture that was developed from RAW may carry its metadata on.
TEST(ToneMapped, OnlyFilesThatCamerasEncodeAreAsked) {
  const auto set = [](Exiv2::Image& image) {
    image.exifData()["Exif.Image.Make"] = "Apple";
    image.exifData()["Exif.Photo.CustomRendered"] = static_cast<std::uint16_t>(3);
  };
  EXPECT_NE(SignOfJpeg(set), "");
  EXPECT_EQ(SignOfJpeg(set, "photo.tif"), "");
}

// Notes of two entries of 4 bytes: tag, type 9, count 1, value.
std::vector<std::uint8_t> AppleNotes(std::uint8_t tag, std::uint8_t value) {
  const std::string opening("Apple iOS\0\0\1MM\0\2", 16);
  std::vector<std::uint8_t> notes(16 + 2 * 12, 0);
  std::copy(opening.begin(), opening.end(), notes.begin());
  const std::uint8_t tags[] = {1, tag}, values[] = {14, value};
  for (size_t i = 0; i < 2; ++i) {
    std::uint8_t* const entry = &notes[16 + 12 * i];
    entry[1] = tags[i], entry[3] = 9, entry[7] = 1, entry[11] = values[i];
  }
  return notes;
}

std::string SignOfNotes(const std::vector<std::uint8_t>& notes) {
  return SignOfJpeg([&](Exiv2::Image& image) {
    image.exifData()["Exif.Image.Make"] = "Apple";
    image.exifData().add(Exiv2::ExifKey("Exif.Photo.MakerNote"),
                         std::make_unique<Exiv2::DataValue>(notes.data(), notes.size()).get());
  });
}

TEST(ToneMapped, ApplesNotesOnHdr) {
  EXPECT_EQ(SignOfNotes(AppleNotes(0x0a, 4)), "");  // the original
  EXPECT_THAT(SignOfNotes(AppleNotes(0x0a, 3)), HasSubstr("maker's notes"));
  EXPECT_THAT(SignOfNotes(AppleNotes(0x21, 0)), HasSubstr("maker's notes"));
  std::vector<std::uint8_t> cut_short = AppleNotes(0x21, 0);
  cut_short.resize(30);
  EXPECT_EQ(SignOfNotes(cut_short), "");
}

TEST(ToneMapped, GainMapOfAJpeg) {
  const std::string packet =
      R"(<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">)"
      R"(<rdf:Description rdf:about="" xmlns:hdrgm="http://ns.adobe.com/hdr-gain-map/1.0/" hdrgm:Version="1.0"/>)"
      R"(</rdf:RDF></x:xmpmeta>)";
  EXPECT_THAT(SignOfJpeg([&](Exiv2::Image& image) {
                image.writeXmpFromPacket(true);
                image.setXmpPacket(packet);
              }),
              HasSubstr("gains"));
}

support::TestHeic GreyHeic() {
  support::TestHeic heic;
  heic.width_px = heic.height_px = 64;
  heic.counts.assign(3 * 64 * 64, 90);
  heic.has_auxiliary = true;
  return heic;
}

TEST(ToneMapped, GainMapOfAHeic) {
  const TempFolder folder;
  if (!support::WriteHeic(folder.Path("a.heic"), GreyHeic()))
    GTEST_SKIP() << "libheif cannot write HEIC here";
  EXPECT_EQ(SignOfToneMapping(folder.Path("a.heic")), "") << "opacity is no map of gains";
  std::string bytes = folder.Read("a.heic");
  // Takes a type as long as that of opacity, so that no box moves. Apple writes "urn:com:apple:photo:2020:aux:hdrgainmap".
  const std::string opacity = "urn:mpeg:hevc:2015:auxid:1", gains = "urn:x:photo:aux:hdrgainmap";
  const size_t at = bytes.find(opacity);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(opacity.size(), gains.size());
  folder.Write("a.heic", bytes.replace(at, gains.size(), gains));
  EXPECT_THAT(SignOfToneMapping(folder.Path("a.heic")), HasSubstr("gains"));
}

}  // namespace
}  // namespace luxfit
