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

TEST(InitPhotosTest, PhoneNamesBecomeViewsAndStates) {
  const TempFolder folder;
  size_t count = 0;
  for (const support::OfficePhoto& photo : support::OfficePhotos()) {
    if (photo.view != "v00" && photo.view != "v04" && photo.view != "v08") continue;
    support::WritePhoneShot(folder.Path("photos/" + support::PhoneName(count)),
                            {photo, 0, static_cast<int>(20 * count)});
    ++count;
  }
  ASSERT_EQ(count, 13U);
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
  EXPECT_THAT(folder.Read("mine/session.toml"), HasSubstr("names are VIEW_STATE\n"));
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
