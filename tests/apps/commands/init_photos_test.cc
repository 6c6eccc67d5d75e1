// `luxfit init` on folders as phones and people leave them.
#include <gmock/gmock.h>

#include <set>

#include "apps/session/session.h"
#include "tests/support/apps/phone_photos.h"
#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

support::ProgramRun Init(const std::string& photos, const std::string& out) {
  return support::RunProgram("init --photos " + photos + " --size 6 4 2.8 --tags " + LUXFIT_FIXTURES +
                             "/office/tags.json -o " + out);
}

// Writes 13 photos of three views in six states, named as a phone names them.
void WriteThreeViews(const TempFolder& folder) {
  size_t count = 0;
  for (const support::OfficePhoto& photo : support::OfficePhotos()) {
    if (photo.view != "v00" && photo.view != "v04" && photo.view != "v08") continue;
    support::WritePhoneShot(folder.Path("photos/" + support::PhoneName(count)),
                            {photo, 0, static_cast<int>(20 * count)});
    ++count;
  }
  ASSERT_EQ(count, 13U);
}

TEST(InitPhotosTest, PhoneNamesBecomeViewsAndStates) {
  const TempFolder folder;
  WriteThreeViews(folder);
  const support::ProgramRun init = Init(folder.Path("photos"), folder.Path("mine"));
  ASSERT_EQ(init.status, 0) << init.output;
  EXPECT_THAT(init.output, AllOf(HasSubstr("13 photos, 6 states"), HasSubstr("whose notes begin with CHECK"),
                                 Not(HasSubstr("exposure_s of"))));
  const Session session = ReadSession(folder.Path("mine/session.toml"));
  std::set<std::string> views;
  for (const SessionPhoto& photo : session.photos) views.insert(photo.view);
  EXPECT_EQ(views, (std::set<std::string>{"v00", "v01", "v02"}));
  const std::string text = folder.Read("mine/session.toml");
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("table = \"photos.csv\"   # GUESS: views and states, by what the photos show"),
            HasSubstr("# Doubtful, see their notes in photos.csv: "),
            HasSubstr("\"mix1\" = { \"A\" = 0.30, \"C\" = 1.0, \"D\" = 1.0 }   # GUESS: its light is")));
  const std::string table = folder.Read("mine/photos.csv");
  EXPECT_THAT(table, AllOf(HasSubstr("file,camera,view,state,exposure_s,aperture,iso,note\n"),
                           HasSubstr("cam0,v00,all,0.0848,1.8,100,")));
}

// Light says that the last state is a mix; who measured it gave it a name. A second such name would leave it open which.
TEST(InitPhotosTest, AMixTakesTheNameThatOnlyReadingsHave) {
  const TempFolder folder;
  WriteThreeViews(folder);
  const std::string header = "id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx\n";
  const std::string readings =
      header + "L1,2,2,0.75,0,0,1,all,300\nL1,2,2,0.75,0,0,1,A,100\nL2,3,2,0.75,0,0,1,evening,200\n";
  folder.Write("mine/luxmeter.csv", readings);
  ASSERT_EQ(Init(folder.Path("photos"), folder.Path("mine")).status, 0);
  const std::string text = folder.Read("mine/session.toml");
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("\"evening\" = { \"A\" = 0.30, \"C\" = 1.0, \"D\" = 1.0 }   # GUESS: its light is"),
            HasSubstr("\n[luxmeter]\nreadings = "), Not(HasSubstr("mix1"))));
  EXPECT_THAT(folder.Read("mine/photos.csv"), AllOf(HasSubstr(",evening,"), Not(HasSubstr("mix1"))));
  EXPECT_EQ(ReadSession(folder.Path("mine/session.toml")).luxmeter.readings.size(), 3U);
  folder.Write("two/luxmeter.csv", readings + "L2,3,2,0.75,0,0,1,night,20\n");
  ASSERT_EQ(Init(folder.Path("photos"), folder.Path("two")).status, 0);
  EXPECT_THAT(folder.Read("two/session.toml"),
              AllOf(HasSubstr("\"mix1\" = "), HasSubstr("photo has (evening or night)")));
}

// Names that tell keep their meaning: no note, no column for it.
TEST(InitPhotosTest, GoodNamesHaveNoNotes) {
  const TempFolder folder;
  for (const support::OfficePhoto& photo : support::OfficePhotos()) {
    if (photo.view == "v00" || photo.view == "v04")
      support::WritePhoneShot(folder.Path("photos/" + photo.view + "_" + photo.state + ".jpg"), {photo});
  }
  ASSERT_EQ(Init(folder.Path("photos"), folder.Path("mine")).status, 0);
  EXPECT_THAT(folder.Read("mine/photos.csv"),
              AllOf(HasSubstr("aperture,iso\n"), HasSubstr("cam0,v04,evening,")));
  EXPECT_THAT(
      folder.Read("mine/session.toml"),
      AllOf(HasSubstr("names are VIEW_STATE\n"),
            HasSubstr("\"A\" = { \"A\" = 1.0 }   # GUESS: by its name\n"),
            HasSubstr("\"evening\" = { \"A\" = 0.30, \"C\" = 1.0, \"D\" = 1.0 }   # GUESS: its light")));
}

// `run` refuses such photos. They are named before.
TEST(InitPhotosTest, PhotosThatSayThatTonesWereMappedAreWarnedOf) {
  const TempFolder folder;
  for (const support::OfficePhoto& photo : support::OfficePhotos()) {
    if (photo.view != "v00" && photo.view != "v04") continue;
    const std::string path = folder.Path("photos/" + photo.view + "_" + photo.state + ".jpg");
    support::WritePhoneShot(path, {photo});
    if (photo.state != "A" && photo.state != "B") continue;
    const auto image = Exiv2::ImageFactory::open(path);
    image->readMetadata();
    image->exifData()["Exif.Image.Software"] = "HDR+ 1.0";
    image->writeMetadata();
  }
  const support::ProgramRun init = Init(folder.Path("photos"), folder.Path("mine"));
  EXPECT_EQ(init.status, 0) << init.output;
  const std::string said = "photos/v00_A.jpg and 3 more of 12 files do not tell light: local tone mapping (";
  EXPECT_THAT(init.output, AllOf(HasSubstr("\nwarning: ../" + said), HasSubstr("the file has \"HDR+\""),
                                 HasSubstr("remedy: photograph RAW (DNG, ProRAW) with automatic HDR off\n"),
                                 HasSubstr("- photos: take 4 of 12 again, in RAW")));
  EXPECT_THAT(folder.Read("mine/session.toml"),
              AllOf(HasSubstr("\n# ../" + said), HasSubstr("\n# Remedy: photograph RAW (DNG, ProRAW)")));
  const support::ProgramRun doctor = support::RunProgram("doctor " + folder.Path("mine/session.toml"));
  EXPECT_EQ(doctor.status, 1);
  EXPECT_THAT(doctor.output,
              AllOf(HasSubstr("8 of 12 photos can be used"), HasSubstr("v00_A.jpg, v00_B.jpg, v04_A.jpg"),
                    HasSubstr(": local tone mapping (the camera"), Not(HasSubstr("more of 12 files"))));
}

support::ProgramRun InitOfficeIn(const TempFolder& folder) {
  return Init(std::string(LUXFIT_FIXTURES) + "/office/photos", folder.Path(""));
}

const std::string kReadings =
    "id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx\nL1,1.9,2.55,0.741,0,0,1,A,201.4\n"
    "L1,1.9,2.55,0.741,0,0,1,all,341.7\nL2,1.0,1.0,0.021,0,0,1,all,212.0\n";

// Step 5 of the tutorial writes the readings, step 6 the session.
TEST(InitReadingsTest, ReadingsThatLieThereAreTakenUp) {
  const TempFolder folder;
  folder.Write("luxmeter.csv", kReadings);
  const support::ProgramRun init = InitOfficeIn(folder);
  ASSERT_EQ(init.status, 0) << init.output;
  EXPECT_THAT(init.output,
              HasSubstr("- [luxmeter]: name in scale the reading of luxmeter.csv (3 are there)"));
  EXPECT_EQ(folder.Read("luxmeter.csv"), kReadings);
  EXPECT_THAT(folder.Read("session.toml"),
              HasSubstr("\n[luxmeter]\nreadings = \"luxmeter.csv\"   # GUESS: "));
  EXPECT_EQ(ReadSession(folder.Path("session.toml")).luxmeter.readings.size(), 3U);
  folder.Replace("session.toml", "# scale = [\"L1@all\"]", "scale = [\"L1@all\"]");
  EXPECT_EQ(ReadSession(folder.Path("session.toml")).luxmeter.readings[1].role, ReadingRole::kScale);
}

// The session must read nevertheless.
TEST(InitReadingsTest, StatesThatNoPhotoHasAreNamed) {
  const TempFolder folder;
  folder.Write("luxmeter.csv", kReadings + "L2,1.0,1.0,0.021,0,0,1,night,2\n");
  const support::ProgramRun init = InitOfficeIn(folder);
  ASSERT_EQ(init.status, 0) << init.output;
  EXPECT_THAT(init.output, HasSubstr("- luxmeter.csv: states that no photo has (night)"));
  EXPECT_THAT(folder.Read("session.toml"), HasSubstr("# [luxmeter]\n# readings = \"luxmeter.csv\"\n"));
  EXPECT_TRUE(ReadSession(folder.Path("session.toml")).luxmeter.readings.empty());
}

TEST(InitReadingsTest, AnEmptyTemplateStays) {
  const TempFolder folder;
  folder.Write("luxmeter.csv", "id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx\r\n");
  const support::ProgramRun init = InitOfficeIn(folder);
  ASSERT_EQ(init.status, 0) << init.output;
  EXPECT_THAT(init.output, HasSubstr("- luxmeter.csv: one reading at least"));
}

TEST(InitReadingsTest, ATableThatCannotBeReadIsNamedBeforeAnythingIsWritten) {
  const TempFolder folder;
  folder.Write("luxmeter.csv", kReadings + "L3,1.0,here,0.021,0,0,1,all,212.0\n");
  const support::ProgramRun init = InitOfficeIn(folder);
  EXPECT_EQ(init.status, 2);
  EXPECT_THAT(init.output, HasSubstr("luxmeter.csv:5: y_m: expected"));
  EXPECT_EQ(folder.Read("session.toml"), "");
}

TEST(InitPhotosTest, SaysWhatLiesThereInstead) {
  const TempFolder folder;
  folder.Write("phone/IMG_1.AVIF", "x");
  folder.Write("phone/a/IMG_2.webp", "x");
  folder.Write("phone/IMG_3.MOV", "x");
  folder.Write("phone/notes.txt", "x");
  folder.Write("phone/._IMG_4.jpg", "x");
  const support::ProgramRun init = Init(folder.Path("phone"), folder.Path("mine"));
  EXPECT_EQ(init.status, 2);
  EXPECT_THAT(init.output,
              AllOf(HasSubstr("expected photos (PNG, TIFF, EXR, JPEG, HEIC, RAW"),
                    HasSubstr("found AVIF, WebP or JPEG XL: 2 (IMG_1.AVIF, ...), movies: 1 (IMG_3.MOV)"),
                    HasSubstr("other files: 1 (notes.txt)"), HasSubstr("ffmpeg -i MOVIE"),
                    HasSubstr("convert them to PNG")));
  folder.Write("empty/a/b/.keep", "");
  EXPECT_THAT(Init(folder.Path("empty"), folder.Path("mine")).output, HasSubstr("found no files at all"));
}

}  // namespace
}  // namespace luxfit
