// The program on broken copies of a small part of fixtures/office: exit status 2, a message that names the
// place and the remedy, and nothing half-written.
#include <gmock/gmock.h>

#include <exiv2/exiv2.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/paths.h"
#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class CliBadInputTest : public ::testing::Test {
 protected:
  CliBadInputTest() {
    const fs::path office = fs::path(LUXFIT_FIXTURES) / "office";
    for (const char* name :
         {"session.toml", "cam0.yaml", "tags.json", "room.obj", "room.mtl", "luxmeter.csv"})
      fs::copy_file(office / name, folder_.Path(name));
    WritePhotoTable({"v00", "v02", "v06"});
    fs::create_directories(folder_.Path("photos"));
    for (const auto& photo : fs::directory_iterator(office / "photos"))
      fs::create_symlink(fs::absolute(photo.path()),
                         folder_.Path("photos/" + photo.path().filename().string()));
  }

  // The photos of state `all` only: enough to get as far as the error.
  void WritePhotoTable(const std::vector<std::string>& views) const {
    std::string table = "file,camera,view,state,exposure_s\n";
    for (const std::string& view : views) table += "photos/" + view + "_all.png,cam0," + view + ",all,0.08\n";
    folder_.Write("photos.csv", table);
  }

  // Runs the program; expects exit status 2 and that what it left, if anything, is whole.
  std::string RefusalOf(const std::string& session = "session.toml") const {
    const support::ProgramRun run =
        support::RunProgram("run '" + folder_.Path(session) + "' -o '" + folder_.Path("out") + "'");
    EXPECT_EQ(run.status, 2) << run.output;
    ExpectNothingHalfWritten();
    return run.output;
  }

  void ExpectNothingHalfWritten() const {
    EXPECT_FALSE(fs::exists(folder_.Path("out/result.json"))) << "a result of a session that was refused";
    if (!fs::exists(folder_.Path("out"))) return;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.Path("out"))) {
      if (!entry.is_regular_file()) continue;
      const std::string name = fs::relative(entry.path(), folder_.Path("")).string();
      const std::string text = folder_.Read(name);
      EXPECT_FALSE(text.empty()) << name;
      const std::string extension = entry.path().extension().string();
      EXPECT_TRUE(extension == ".json" || extension == ".csv" || extension == ".html" || extension == ".cbor")
          << name << ": a temporary file?";
      if (extension == ".json") {
        EXPECT_TRUE(nlohmann::json::accept(text)) << name;
      } else if (extension == ".cbor") {
        EXPECT_FALSE(nlohmann::json::from_cbor(text, true, false).is_discarded()) << name;
      } else {
        EXPECT_EQ(text.back(), '\n') << name;
      }
    }
  }

  TempFolder folder_;
};

TEST_F(CliBadInputTest, PhotoMissing) {
  folder_.Replace("photos.csv", "v02_all.png", "v20_all.png");
  EXPECT_THAT(RefusalOf(),
              AllOf(HasSubstr("photos.csv:3: file: expected an existing file, got \"photos/v20_all.png\""),
                    HasSubstr("did you mean")));
}

TEST_F(CliBadInputTest, UnknownCamera) {
  folder_.Replace("photos.csv", "v02_all.png,cam0", "v02_all.png,cam1");
  EXPECT_THAT(RefusalOf(),
              AllOf(HasSubstr("photos.csv:3: camera: expected a known camera (cam0), got \"cam1\""),
                    HasSubstr("did you mean \"cam0\"?")));
}

TEST_F(CliBadInputTest, WrongHeaderOfTheReadings) {
  folder_.Replace("luxmeter.csv", "id,x_m,y_m,z_m", "name,x,y,z");
  EXPECT_THAT(RefusalOf(), AllOf(HasSubstr("luxmeter.csv:1: header: expected "
                                           "\"id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx[,sensor]\", got "
                                           "\"name,x,y,z,nx,ny,nz,state,illuminance_lx\""),
                                 HasSubstr("rename, reorder or add it")));
}

TEST_F(CliBadInputTest, DecimalComma) {
  folder_.Replace("luxmeter.csv", "257.6", "257,6");
  EXPECT_THAT(RefusalOf(), AllOf(HasSubstr("luxmeter.csv:2: expected 9 fields"), HasSubstr("decimal comma"),
                                 HasSubstr("decimal points")));
}

TEST_F(CliBadInputTest, MillimetresDeclaredAsMetres) {
  std::istringstream metres(folder_.Read("room.obj"));
  std::ostringstream millimetres;
  for (std::string line; std::getline(metres, line);) {
    std::istringstream words(line);
    std::string kind;
    double x_m = 0, y_m = 0, z_m = 0;
    if (words >> kind >> x_m >> y_m >> z_m && kind == "v") {
      millimetres << "v " << 1000 * x_m << ' ' << 1000 * y_m << ' ' << 1000 * z_m << '\n';
    } else {
      millimetres << line << '\n';
    }
  }
  folder_.Write("room.obj", millimetres.str());
  EXPECT_THAT(RefusalOf(), AllOf(HasSubstr("session.toml"), HasSubstr("unit"), HasSubstr("unit = \"mm\"")));
}

TEST_F(CliBadInputTest, EightBitPhotoDeclaredLinear) {
  const std::string name = folder_.Path("photos/v02_all.png");
  cv::Mat linear;
  cv::imread(name, cv::IMREAD_UNCHANGED).convertTo(linear, CV_32F, 1 / 65535.0);
  cv::Mat gamma_encoded, eight_bit;
  cv::pow(linear, 1 / 2.2, gamma_encoded);  // sRGB's curve to a few per cent, which is as good here
  gamma_encoded.convertTo(eight_bit, CV_8U, 255.0);
  fs::remove(name);  // the link, not the fixture's photo
  ASSERT_TRUE(cv::imwrite(name, eight_bit));
  EXPECT_THAT(RefusalOf(), AllOf(HasSubstr("v02_all.png"), HasSubstr("8-bit"), HasSubstr("response"),
                                 HasSubstr("linear")));
}

TEST_F(CliBadInputTest, PhotosWhoseFilesSayThatTonesWereMapped) {
  std::string table = "file,camera,view,state,exposure_s\n";
  for (const char* view : {"v00", "v02"}) {
    const std::string name = std::string("photos/") + view + ".jpg";
    ASSERT_TRUE(cv::imwrite(folder_.Path(name), cv::Mat(480, 640, CV_8UC3, cv::Scalar(90, 90, 90))));
    const auto image = Exiv2::ImageFactory::open(folder_.Path(name));
    image->exifData()["Exif.Image.Software"] = "HDR+ 1.0";
    image->writeMetadata();
    table += name + ",cam0," + view + ",all,0.08\n";
  }
  folder_.Write("photos.csv", table);
  folder_.Replace("session.toml", "response = \"linear\"", "response = \"srgb\"");
  EXPECT_THAT(RefusalOf(), AllOf(HasSubstr("v00.jpg and 1 more of 2 files"), HasSubstr("local tone mapping"),
                                 HasSubstr("HDR+"), HasSubstr("RAW")));
}

TEST_F(CliBadInputTest, TagIdTwice) {
  folder_.Replace("tags.json", "\"id\": 1,", "\"id\": 0,");
  EXPECT_THAT(RefusalOf(),
              AllOf(HasSubstr("tags.json:"), HasSubstr("tag[1].id: expected every id once, got 0"),
                    HasSubstr("tag[0] (line 2)"), HasSubstr("correct or remove one")));
}

TEST_F(CliBadInputTest, NoTagInAnyPhoto) {
  WritePhotoTable({"v08"});
  EXPECT_THAT(RefusalOf(), AllOf(HasSubstr("tag"), HasSubstr("expected"), HasSubstr("check")));
}

TEST_F(CliBadInputTest, MisspeltKey) {
  folder_.Replace("session.toml", "black_level", "black_levl");
  EXPECT_THAT(RefusalOf(), AllOf(HasSubstr("session.toml:15: camera[0].black_levl: expected a known key"),
                                 HasSubstr("did you mean \"black_level\"?")));
}

TEST_F(CliBadInputTest, SessionMissingOrAFolder) {
  EXPECT_THAT(RefusalOf("sesion.toml"), AllOf(HasSubstr("sesion.toml: session: expected an existing file"),
                                              HasSubstr("did you mean \"session.toml\"?")));
  EXPECT_THAT(RefusalOf(""), AllOf(HasSubstr("got a folder"), HasSubstr("did you mean")));
}

}  // namespace
}  // namespace luxfit
