#include "apps/session/tag_map.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr char kGood[] = R"([
  {"id": 3, "size_m": 0.2, "center_m": [0, 1, 1.5], "normal": [1, 0, 0], "up": [0, 0, 1]},
  {"id": 7, "size_m": 0.1, "center_m": [2, 0, 1],
   "normal": [0, 1, 0], "up": [0, 0, -1], "note": "[{,"}
])";

class TagMapTest : public ::testing::Test {
 protected:
  TagMapTest() { folder_.Write("tags.json", kGood); }

  std::vector<SurveyedTag> Read() const { return ReadTagMap(folder_.Path("tags.json")); }

  std::string ErrorAfter(const std::string& from, const std::string& to) const {
    folder_.Write("tags.json", kGood);
    folder_.Replace("tags.json", from, to);
    return Error();
  }

  std::string Error() const {
    try {
      Read();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  TempFolder folder_;
};

TEST_F(TagMapTest, ReadsEntries) {
  const std::vector<SurveyedTag> survey = Read();
  ASSERT_EQ(survey.size(), 2u);
  EXPECT_EQ(survey[1].id, 7);
  EXPECT_EQ(survey[1].size_m, 0.1);
  EXPECT_EQ(survey[0].center_in_world, Eigen::Vector3d(0, 1, 1.5));
  EXPECT_EQ(survey[1].normal_in_world, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(survey[1].up_in_world, Eigen::Vector3d(0, 0, -1));
}

TEST_F(TagMapTest, RoundedDirectionsAreMadeUnitAndPerpendicular) {
  folder_.Replace("tags.json", "[1, 0, 0]", "[0.707, 0.707, 0]");
  folder_.Replace("tags.json", "[0, 0, 1]", "[0.01, 0, 1.0]");
  const SurveyedTag tag = Read()[0];
  EXPECT_NEAR(tag.normal_in_world.norm(), 1, 1e-15);
  EXPECT_NEAR(tag.normal_in_world.x(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(tag.up_in_world.norm(), 1, 1e-15);
  EXPECT_NEAR(tag.up_in_world.dot(tag.normal_in_world), 0, 1e-15);
}

TEST_F(TagMapTest, TwoEntriesOfOneIdAreBothNamed) {
  EXPECT_THAT(
      ErrorAfter("\"id\": 7", "\"id\": 3"),
      AllOf(HasSubstr("tags.json:3: tag[1].id: expected every id once, got 3"), HasSubstr("tag[0] (line 2)"),
            HasSubstr("tag[1] (line 3)"), HasSubstr("correct or remove one")));
}

TEST_F(TagMapTest, MalformedValuesAreReported) {
  EXPECT_THAT(ErrorAfter("0.1,", "-0.1,"),
              AllOf(HasSubstr("tags.json:3: tag[1].size_m: expected > 0, got -0.1"), HasSubstr("in metres")));
  EXPECT_THAT(
      ErrorAfter("[1, 0, 0]", "[2, 0, 0]"),
      HasSubstr("tags.json:2: tag[0].normal: expected a unit vector, got one of length 2; divide it"));
  EXPECT_THAT(ErrorAfter("[0, 0, 1]", "[0, 0, 0]"),
              HasSubstr("tag[0].up: expected a unit vector, got one of length 0"));
  EXPECT_THAT(
      ErrorAfter("[0, 0, 1]", "[0.6, 0, 0.8]"),
      HasSubstr(
          "tag[0].up: expected a vector perpendicular to normal, got one at 53.13 degrees to it; both"));
  EXPECT_THAT(
      ErrorAfter("[0, 1, 1.5]", "[0, 1]"),
      HasSubstr("tag[0].center_m: expected the tag's centre in metres [x, y, z], got [0,1]; write three"));
  EXPECT_THAT(ErrorAfter("\"id\": 3", "\"id\": 3.5"),
              HasSubstr("tag[0].id: expected a whole number >= 0, got 3.5"));
  EXPECT_THAT(ErrorAfter("\"id\": 3", "\"id\": -3"),
              HasSubstr("tag[0].id: expected a whole number >= 0, got -3"));
  EXPECT_THAT(ErrorAfter("0.2", "\"20 cm\""),
              HasSubstr("tag[0].size_m: expected the side of the tag's square"));
}

TEST_F(TagMapTest, MissingKeysNameTheMisspeltOne) {
  EXPECT_THAT(ErrorAfter("center_m", "centre_m"),
              HasSubstr("tag[0].center_m: expected the tag's centre in metres [x, y, z], got nothing; rename "
                        "\"centre_m\" to \"center_m\""));
  EXPECT_THAT(ErrorAfter(", \"up\": [0, 0, 1]", ""), HasSubstr("got nothing; add \"up\" to the entry"));
}

// The parser's own words end amid a character.
TEST_F(TagMapTest, AnErrorShowsWholeCharacters) {
  folder_.Write("tags.json", "[\n  \u00e4 7]");
  EXPECT_THAT(Error(), HasSubstr("tags.json:2: expected valid JSON, got \"\u00e4 7]\"; fix the line"));
  folder_.Write("tags.json", "[{\"id\": \u00e4}]");
  EXPECT_THAT(Error(), HasSubstr("\u00e4}]\""));
  std::string many;
  for (int i = 0; i < 40; ++i) many += "\u20ac";
  folder_.Write("tags.json", "[" + many + "]");
  EXPECT_THAT(Error(), HasSubstr("got \"[" + many.substr(0, size_t{19} * 3) + "\""));
}

TEST_F(TagMapTest, ANumberBeyondAllIsReported) {
  EXPECT_THAT(ErrorAfter("0.2", "1e999"), HasSubstr("expected numbers of up to 1e308"));
}

TEST_F(TagMapTest, OtherThanAListOfTagsIsReported) {
  folder_.Write("tags.json", "[]");
  EXPECT_THAT(Error(),
              HasSubstr("tags.json:1: expected a list of at least one tag, got an empty one; write ["));
  folder_.Write("tags.json", "{\"tags\": []}");
  EXPECT_THAT(Error(), HasSubstr("tags.json:1: expected a list of at least one tag, got object"));
  folder_.Write("tags.json", "[\n7]");
  EXPECT_THAT(Error(), HasSubstr("tags.json:2: tag[0]: expected {\"id\", \"size_m\""));
  EXPECT_THAT(ErrorAfter("[0, 1, 0],", "[0, 1, 0]"), AllOf(HasSubstr("tags.json:4: expected valid JSON, got"),
                                                           HasSubstr("fix the line, or the comma")));
}

}  // namespace
}  // namespace luxfit
