// Photometric files as programs write them beside the standards: each is its plain file, or refused by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "forward/luminaire/internal/ies_file.h"
#include "forward/luminaire/internal/ldt_file.h"
#include "tests/support/forward/photometry_text.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using support::kIes;
using support::kLdt;
using support::PhotometryError;
using support::Replaced;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::string kPlain = Replaced(kIes, "0.9 1.7 36", "1 1 36");

std::string WithoutBallastLine() { return Replaced(kPlain, "1 1 36\n", ""); }

void ExpectSameTable(const IesFile& file, const IesFile& expected) {
  EXPECT_EQ(file.vertical_deg, expected.vertical_deg);
  EXPECT_EQ(file.horizontal_deg, expected.horizontal_deg);
  EXPECT_EQ(file.candela, expected.candela);
  const PhotometryFile light = PhotometryOf(file), expected_light = PhotometryOf(expected);
  EXPECT_EQ(light.table.cd_per_lm, expected_light.table.cd_per_lm);
  EXPECT_EQ(light.luminaire_flux_lm, expected_light.luminaire_flux_lm);
  EXPECT_EQ(light.size_m, expected_light.size_m);
}

TEST(IesDialects, TheBallastLineMayBeMissing) {
  const IesFile expected = ParseIes(kPlain, "a.ies");
  for (const std::string& text :
       {WithoutBallastLine(), WithoutBallastLine() + "\r\n \x1a", WithoutBallastLine() + "made by hand\n"}) {
    const IesFile file = ParseIes(text, "a.ies");
    ExpectSameTable(file, expected);
    ASSERT_FALSE(file.notes.empty());
    EXPECT_THAT(file.notes[0], HasSubstr("ballast factor and watts is missing"));
    // Written, it has the line.
    ExpectSameTable(ParseIes(IesText(file), "b.ies"), expected);
    EXPECT_TRUE(ParseIes(IesText(file), "b.ies").notes.empty());
  }
}

TEST(IesDialects, TheBallastLineMayBeMissingAfterTiltDataAndInEveryType) {
  const auto check = [](std::string text) {
    const IesFile expected = ParseIes(text, "a.ies");
    ExpectSameTable(ParseIes(Replaced(text, "1 1 36\n", ""), "a.ies"), expected);
  };
  check(Replaced(kPlain, "TILT=NONE", "TILT=INCLUDE\n1\n2\n0 90\n1 0.9"));
  check(Replaced(kPlain, "\n0 45 90\n0 45 90", "\n90 135 180\n0 45 90"));  // an uplight begins at 90
  check(Replaced(Replaced(kPlain, "3 3 1 2", "3 3 3 2"), "0 45 90\n0 45 90", "-90 -45 0\n-90 0 90"));
  check(Replaced(Replaced(kPlain, "3 3 1 2", "3 3 2 2"), "0 45 90\n0 45 90", "-90 0 90\n-45 0 45"));
}

// Three numbers less, as without the line, but its ballast factor is no first angle.
TEST(IesDialects, AFileThatIsCutShortByThreeNumbersLacksNoLine) {
  for (const char* line : {"0.9 1.7 36", "1 2 36"}) {
    const std::string cut = Replaced(Replaced(kIes, "0.9 1.7 36", line), "300 240 140\n", "");
    EXPECT_THAT(PhotometryError(cut, "a.ies"), AllOf(HasSubstr("candela values"), HasSubstr("cut short")));
  }
}

TEST(IesDialects, ALackingLineAndAWrongCountAreRefused) {
  const std::string text = WithoutBallastLine();
  EXPECT_THAT(PhotometryError(Replaced(text, "300 240 140", "300 240"), "a.ies"),
              HasSubstr("a.ies:7: ballast factor: expected a number from"));
  EXPECT_THAT(PhotometryError(Replaced(text, "300 240 140", "300 240 140 5"), "a.ies"),
              HasSubstr("a.ies:7: ballast factor: expected a number from"));
}

TEST(IesDialects, TiltMayHaveBlanksAndSmallLetters) {
  const IesFile expected = ParseIes(kIes, "a.ies");
  for (const char* line : {"TILT = NONE", "tilt=none", " Tilt\t= None ", "TILT =NONE"}) {
    const IesFile file = ParseIes(Replaced(kIes, "TILT=NONE", line), "a.ies");
    EXPECT_EQ(file.tilt.source, "NONE") << line;
    EXPECT_EQ(file.keywords.size(), expected.keywords.size()) << line;
    ExpectSameTable(file, expected);
  }
  const IesFile tilted = ParseIes(Replaced(kIes, "TILT=NONE", "tilt = include\n1\n2\n0 90\n1 0.9"), "a.ies");
  EXPECT_EQ(tilted.tilt.factor, (std::vector<double>{1, 0.9}));
  // Words are none.
  EXPECT_THAT(PhotometryError(Replaced(kIes, "TILT=NONE", "TILTED 5 degrees = yes"), "a.ies"),
              HasSubstr("expected a line TILT=NONE"));
}

TEST(IesDialects, DecimalCommasAreRefusedByName) {
  const auto error = [](const std::string& from, const std::string& to) {
    return PhotometryError(Replaced(kIes, from, to), "a.ies");
  };
  EXPECT_THAT(error("300 220 120", "300 220,5 120,25"),
              HasSubstr("a.ies:11: numbers: expected decimal points, got decimal commas, such as \"220,5\"; "
                        "replace them by points"));
  EXPECT_THAT(error("2 1000 1.5", "2 1000 1,5"),
              AllOf(HasSubstr("a.ies:6: numbers"), HasSubstr("decimal commas, such as \"1,5\"")));
  EXPECT_THAT(error("0.9 1.7 36", "0,9 1,7 36"), HasSubstr("a.ies:7: numbers"));
  EXPECT_THAT(error("0 45 90\n0 45 90", "0,0 45,0 90,0\n0,0 45,0 90,0"), HasSubstr("a.ies:8: numbers"));
  // Between numbers a comma may stand besides.
  EXPECT_THAT(error("300 220 120", "300,1, 220,5, 120,25"), HasSubstr("a.ies:11: numbers"));
  // Without the line of the ballast three commas make up for it.
  EXPECT_THAT(PhotometryError(Replaced(WithoutBallastLine(), "300 220 120", "300,5 220,5 120,5"), "a.ies"),
              HasSubstr("a.ies:10: numbers: expected decimal points, got decimal commas"));
}

// 90 is the first angle of an uplight or, hardly, a ballast factor.
TEST(IesDialects, CommasThatMayBeEitherAreRefused) {
  const std::string up = Replaced(WithoutBallastLine(), "0 45 90\n0", "90 135 180\n0");
  EXPECT_THAT(PhotometryError(Replaced(up, "300 220 120", "300,5 220,5 120,5"), "a.ies"),
              HasSubstr("a.ies:10: numbers: expected decimal points, got \"300,5\", one number or two"));
}

TEST(IesDialects, CommasThatSeparateAreReadWithANote) {
  const IesFile expected = ParseIes(kIes, "a.ies");
  for (const auto& [from, to] :
       {std::pair("300 220 120", "300,220,120"), std::pair("2 1000 1.5", "2,1000,1.5"),
        std::pair("0.9 1.7 36", "0.9,1.7 36")}) {
    const IesFile file = ParseIes(Replaced(kIes, from, to), "a.ies");
    ExpectSameTable(file, expected);
    EXPECT_THAT(file.notes, ElementsAre(HasSubstr("commas were read as separators"))) << to;
  }
  // With a blank none is unclear.
  EXPECT_TRUE(ParseIes(Replaced(kIes, "300 220 120", "300, 220 ,120,"), "a.ies").notes.empty());
}

TEST(IesDialects, CommasThatFitNeitherWayAreNamedBesideTheFault) {
  EXPECT_THAT(PhotometryError(Replaced(kIes, "300 220 120\n300 240 140", "300,5 220"), "a.ies"),
              AllOf(HasSubstr("candela values"), HasSubstr("if they are decimal ones, write points")));
  EXPECT_THAT(PhotometryError(Replaced(kIes, "300 220 120", "300 -220 120"), "a.ies"),
              Not(HasSubstr("comma")));
}

TEST(IesDialects, CommasOfATiltFileAreHeldAgainstItsCounts) {
  const TempFolder folder;
  folder.Write("lamp.ies", Replaced(kIes, "TILT=NONE", "TILT=lamp.tlt"));
  const auto error = [&folder](const std::string& tilt) -> std::string {
    folder.Write("lamp.tlt", tilt);
    try {
      ReadPhotometry(folder.Path("lamp.ies"));
    } catch (const std::runtime_error& refused) {
      return refused.what();
    }
    return "";
  };
  EXPECT_EQ(error("1\n3\n-30 0 90\n0.6 0.8 1\n"), "");
  EXPECT_EQ(error("1\n3\n-30,0,90\n0.6,0.8,1\n"), "");
  EXPECT_THAT(error("1\n3\n-30 0 90\n0,6 0,8 1\n"),
              HasSubstr("lamp.tlt:4: numbers: expected decimal points"));
  EXPECT_THAT(error("1\n3\n-30 0 90\n0.6 0.8 1\n2"), HasSubstr("lamp.tlt:5: tilt factors: expected the end"));
}

TEST(IesDialects, SurplusNumbersAreRefusedWithTheirLine) {
  EXPECT_THAT(
      PhotometryError(std::string(kIes) + "\n1 2\n3", "a.ies"),
      HasSubstr("a.ies:14: candela values: expected the end after 3 x 3 numbers, got 3 more; correct the "
                "numbers of angles"));
  EXPECT_THAT(PhotometryError(Replaced(kIes, "300 220 120", "300 220 120 5"), "a.ies"),
              HasSubstr("a.ies:12: candela values: expected the end"));
}

// Every number of each file in turn is replaced: the reader says where, or reads what it means.
TEST(PhotometryDialects, DamagedNumbersAreRefusedOrRead) {
  for (const auto& [text, name] :
       {std::pair(std::string(kIes), "a.ies"), std::pair(std::string(kLdt), "a.ldt")}) {
    for (size_t at = text.find(name[2] == 'i' ? "TILT" : "\n2"); at < text.size();) {
      const size_t end = text.find_first_of(" \n", at);
      for (const char* value :
           {"nan", "inf", "-1", "-2147483649", "1e308", "999999", "1000000000000", "1,5", "", "x"}) {
        std::string damaged = text;
        damaged.replace(at, end - at, value);
        const std::string error = PhotometryError(damaged, name);
        EXPECT_TRUE(error.empty() || error.rfind(std::string(name) + ":", 0) == 0) << value << ": " << error;
      }
      at = end + 1;
    }
  }
}

TEST(LdtDialects, DecimalCommasAreReadAsPoints) {
  const std::string points =
      Replaced(Replaced(kLdt, "\n220\n", "\n220.25\n"), "\n80\n1.5\n", "\n79.5\n1.5\n");
  const std::string commas =
      Replaced(Replaced(kLdt, "\n220\n", "\n220,25\n"), "\n80\n1.5\n", "\n79,5\n1,5\n");
  const PhotometryFile expected = ParsePhotometry(points, "a.ldt"), file = ParsePhotometry(commas, "a.ldt");
  EXPECT_EQ(file.table.cd_per_lm, expected.table.cd_per_lm);
  EXPECT_EQ(file.stated_flux_lm, expected.stated_flux_lm);
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("3 decimal commas")));
  // A point and a comma: thousands or decimals?
  EXPECT_THAT(PhotometryError(Replaced(kLdt, "\n2000\n", "\n2.000,5\n"), "a.ldt"),
              HasSubstr("a.ldt:29: total flux of the lamps: expected a number, got \"2.000,5\"; write it"));
  EXPECT_THAT(PhotometryError(Replaced(kLdt, "\n220\n", "\n220,5,1\n"), "a.ldt"), HasSubstr("\"220,5,1\""));
}

TEST(LdtDialects, SurplusNumbersAreNoted) {
  const LdtFile file = ParseLdt(std::string(kLdt) + "7\n8\n", "a.ldt");
  EXPECT_EQ(file.cd_per_klm, ParseLdt(kLdt, "a.ldt").cd_per_klm);
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("2 numbers after the last intensity")));
  EXPECT_THAT(ParseLdt(std::string(kLdt) + "the end\n", "a.ldt").notes,
              ElementsAre(HasSubstr("what follows")));
}

}  // namespace
}  // namespace luxfit
