// What a change in a session's files redoes: the office of fixtures/, one thing changed at a time.
#include "apps/stages/stage_inputs.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "apps/stages/stage_cache.h"
#include "tests/paths.h"
#include "tests/support/apps/office_copy.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class StageInputsTest : public ::testing::Test {
 protected:
  SessionInputs Now() const { return InputsOfStages(ReadSession(office_.Session()), ""); }

  support::OfficeCopy office_;
  SessionInputs before_ = Now();
};

TEST_F(StageInputsTest, NothingChangedIsNothing) {
  office_.Replace("office/session.toml", "name =", "# a comment more\nname =");
  const SessionInputs now = Now();
  EXPECT_THAT(ChangedInputs(before_.linearize, now.linearize), IsEmpty());
  EXPECT_THAT(ChangedInputs(before_.registration, now.registration), IsEmpty());
  EXPECT_THAT(ChangedInputs(before_.observe, now.observe), IsEmpty());
  EXPECT_THAT(ChangedInputs(before_.result, now.result), IsEmpty());
}

TEST_F(StageInputsTest, AnOutlineTouchesRegistrationAndWhatFollows) {
  office_.Replace("office/session.toml", "mesh = \"room.obj\"", "size = [6, 4, 2.8]");
  const SessionInputs by_size = Now();
  EXPECT_THAT(ChangedInputs(before_.linearize, by_size.linearize), IsEmpty());
  EXPECT_THAT(ChangedInputs(before_.registration, by_size.registration),
              ElementsAre("[scene]", "mesh room.obj"));
  office_.Replace("office/session.toml", "size = [6, 4, 2.8]", "size = [6, 4, 2.9]");
  EXPECT_THAT(ChangedInputs(by_size.registration, Now().registration), ElementsAre("[scene]"));
  EXPECT_THAT(ChangedInputs(by_size.result, Now().result), ElementsAre("[scene]"));
  office_.Replace("office/session.toml", "size = [6, 4, 2.9]", "size = [6, 4, 2.8]  # measured");
  EXPECT_THAT(ChangedInputs(by_size.result, Now().result), IsEmpty());
  office_.Replace("office/session.toml", "[tags]",
                  "[[scene.box]]\nname = \"a\"\nmin = [1, 1, 0]\nmax = [2, 2, 1]\n[tags]");
  EXPECT_THAT(ChangedInputs(by_size.result, Now().result), ElementsAre("[scene]"));
}

TEST_F(StageInputsTest, ABufferBesideAGltfIsAPartOfTheMesh) {
  office_.Write("office/my room.bin", "0123");
  office_.Write("office/room.gltf",
                R"({"buffers": [{"uri": "my%20room.bin", "byteLength": 4}, {"uri": "data:;base64,AA=="}]})");
  office_.Replace("office/session.toml", "mesh = \"room.obj\"", "mesh = \"room.gltf\"");
  const SessionInputs before = Now();
  office_.Write("office/my room.bin", "0124");
  EXPECT_THAT(ChangedInputs(before.registration, Now().registration), ElementsAre("mesh room.gltf"));
  EXPECT_THAT(ReadSession(office_.Session()).input_files, Contains(office_.Path("office/my room.bin")));
}

TEST_F(StageInputsTest, AReadingTouchesTheFitAlone) {
  office_.Replace("office/luxmeter.csv", "341.73", "342");
  const SessionInputs now = Now();
  EXPECT_THAT(ChangedInputs(before_.observe, now.observe), IsEmpty());
  EXPECT_THAT(ChangedInputs(before_.result, now.result), ElementsAre("readings"));
}

TEST_F(StageInputsTest, ALuminaireTouchesTheFitAlone) {
  office_.Write("office/session.toml",
                office_.Read("office/session.toml") +
                    "\n[[luminaire]]\nid = \"A\"\nflux_lm = 3600\nflux_sigma_lm = 100\n");
  const SessionInputs now = Now();
  EXPECT_THAT(ChangedInputs(before_.observe, now.observe), IsEmpty());
  EXPECT_FALSE(ChangedInputs(before_.result, now.result).empty());
}

TEST_F(StageInputsTest, APhotoTouchesAllThatLooksAtIt) {
  fs::copy_file(office_.Path("office/photos/v00_A.png"), office_.Path("office/photos/v00_B.png"),
                fs::copy_options::overwrite_existing);
  const SessionInputs now = Now();
  for (const auto& [earlier, later] : {std::pair(before_.linearize, now.linearize),
                                       {before_.registration, now.registration},
                                       {before_.observe, now.observe},
                                       {before_.result, now.result}})
    EXPECT_THAT(ChangedInputs(earlier, later), ElementsAre("photo v00_B.png"));
}

TEST_F(StageInputsTest, TheTagMapLeavesLuminanceAlone) {
  office_.Write("office/tags.json", office_.Read("office/tags.json") + "\n");
  const SessionInputs now = Now();
  EXPECT_THAT(ChangedInputs(before_.linearize, now.linearize), IsEmpty());
  EXPECT_THAT(ChangedInputs(before_.registration, now.registration), ElementsAre("[tags]"));
}

TEST(StageCacheTest, RepeatsProductAndSayings) {
  const TempFolder folder;
  const StageInputs inputs = {{"photo a", "1"}};
  folder.Write("stages/register.json", "{}");
  int computed = 0;
  const auto run = [&](const StageInputs& with) {
    RunContext context;
    context.out = folder.Path("");
    context.is_quiet = true;
    const auto kept = KeptProduct("register", with, context);
    if (kept) {
      EXPECT_EQ(kept->at("value"), 0.1);
    } else {
      ++computed;
      const StageMark mark(context);
      context.AddUndetermined({"code", "message", "remedy"});
      context.choices.push_back({"what", "a", {"a", "b"}, "because"});
      KeepProduct("register", with, context, mark, {{"value", 0.1}});
    }
    EXPECT_TRUE(context.IsUndetermined());
    EXPECT_EQ(context.warnings.at(0).remedy, "remedy");
    EXPECT_THAT(context.choices.at(0).among, ElementsAre("a", "b"));
  };
  run(inputs);
  run(inputs);
  EXPECT_EQ(computed, 1);
  run({{"photo a", "2"}});
  EXPECT_EQ(computed, 2);
  folder.Write("stages/register.cbor", "not CBOR at all");
  run({{"photo a", "2"}});
  EXPECT_EQ(computed, 3) << "a broken file counts as none";
  // One bit of 0.1's double: still CBOR, but another number.
  std::string bytes = folder.Read("stages/register.cbor");
  const size_t value = bytes.rfind("value");
  ASSERT_NE(value, std::string::npos);
  bytes.at(value + 8) = static_cast<char>(bytes.at(value + 8) ^ 1);
  folder.Write("stages/register.cbor", bytes);
  run({{"photo a", "2"}});
  EXPECT_EQ(computed, 4) << "a damaged file counts as none";
  run({{"photo a", "2"}});
  EXPECT_EQ(computed, 4);
}

}  // namespace
}  // namespace luxfit
