#include "forward/luminaire/internal/ies_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/closed_forms.h"
#include "tests/support/forward/photometry_text.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using support::kIes;
using support::kPi;
using support::PhotometryError;
using support::Replaced;
using testing::AllOf;
using testing::HasSubstr;

Eigen::Vector3d DirectionAt(double c_deg, double gamma_deg) {
  const double c = c_deg * kPi / 180, g = gamma_deg * kPi / 180;
  return {std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), -std::cos(g)};
}

double CdTowards(const PhotometryFile& photometry, double c_deg, double gamma_deg) {
  return photometry.luminaire_flux_lm *
         IntensityTowards(photometry.table, DirectionAt(c_deg, gamma_deg)).cd_per_lm;
}

PhotometryFile Parse(const std::string& text) { return ParsePhotometry(text, "a.ies"); }

TEST(IesFile, IsReadAsItStands) {
  const IesFile file = ParseIes(kIes, "a.ies");
  EXPECT_EQ(file.version, IesVersion::k2002);
  ASSERT_EQ(file.keywords.size(), 3u);
  EXPECT_EQ(file.keywords[2].name, "MORE");
  EXPECT_EQ(file.keywords[2].text, "and more");
  EXPECT_EQ(file.lamps, 2);
  EXPECT_EQ(file.lumens_per_lamp, 1000);
  EXPECT_EQ(file.horizontal_deg, (std::vector<double>{0, 45, 90}));
  EXPECT_EQ(file.candela[5], 120);
  EXPECT_TRUE(file.notes.empty());
}

TEST(IesFile, ScalesByMultiplierAndBallastFactorAndMirrors) {
  const PhotometryFile photometry = Parse(kIes);
  EXPECT_EQ(photometry.lamp_flux_lm, 2000);
  for (const double c : {45.0, 135.0, 225.0, 315.0})
    EXPECT_NEAR(CdTowards(photometry, c, 45), 220 * 1.5 * 0.9, 1e-9) << c;  // double rounding
  EXPECT_NEAR(CdTowards(photometry, 270, 90), 140 * 1.5 * 0.9, 1e-9);
  EXPECT_EQ(CdTowards(photometry, 0, 91), 0);
  EXPECT_NEAR(FluxIntegral(photometry.table), 1, 1e-12);
}

// The number after the ballast factor: a factor in 1986 and 1991, nothing later, a code in 2019.
TEST(IesFile, TheThirdFactorMultipliesInTheOldVersionsOnly) {
  const double plain = 240 * 1.5 * 0.9;
  const auto cd = [](const std::string& version) {
    return CdTowards(Parse(Replaced(kIes, "IESNA:LM-63-2002", version)), 90, 45);
  };
  EXPECT_NEAR(cd("A luminaire of 1986"), 1.7 * plain, 1e-9);
  EXPECT_NEAR(cd("IESNA91"), 1.7 * plain, 1e-9);
  EXPECT_NEAR(cd("IESNA:LM-63-1995"), plain, 1e-9);
  EXPECT_NEAR(cd("IESNA:LM-63-2002"), plain, 1e-9);
  EXPECT_NEAR(cd("IES:LM-63-2019"), plain, 1e-9);
}

TEST(IesFile, LumensOfMinusOneAreAbsolute) {
  const PhotometryFile photometry = Parse(Replaced(kIes, "2 1000 1.5", "1 -1 1"));
  EXPECT_EQ(photometry.lamp_flux_lm, 0);
  EXPECT_NEAR(CdTowards(photometry, 0, 45), 200 * 0.9, 1e-9);
}

TEST(IesFile, SymmetryFollowsFromTheHorizontalAngles) {
  const auto cd = [](const std::string& angles, double c_deg) {
    return CdTowards(Parse(Replaced(kIes, "0 45 90\n300", angles + "\n300")), c_deg, 90) / 1.35;
  };
  EXPECT_NEAR(cd("0 90 180", 270), 120, 1e-9);  // C0 100, C90 120, C180 140
  EXPECT_NEAR(cd("0 90 180", 180), 140, 1e-9);
  EXPECT_NEAR(cd("90 180 270", 0), 120, 1e-9);  // C90 100, C180 120, C270 140
  EXPECT_NEAR(cd("90 180 270", 90), 100, 1e-9);
  EXPECT_NEAR(cd("0 120 240", 240), 140, 1e-9);  // the circle without its end
  EXPECT_NEAR(cd("0 120 240", 300), 120, 1e-9);
  std::string one = Replaced(Replaced(kIes, "3 3 1 2", "3 1 1 2"), "0 45 90\n300", "0\n300");
  one.resize(one.find("300 220"));
  EXPECT_NEAR(CdTowards(Parse(one), 77, 90), 100 * 1.35, 1e-9);
}

// V from the horizontal, H clockwise from above; type A: gamma = 90 + V, C = -H.
TEST(IesFile, TypeAHasItsEquatorAtTheHorizon) {
  std::string text = Replaced(kIes, "3 3 1 2", "3 3 3 2");
  text = Replaced(text, "0 45 90\n0 45 90", "-90 -45 0\n-90 0 90");
  const PhotometryFile photometry = Parse(text);
  EXPECT_NEAR(CdTowards(photometry, 90, 45), 200 * 1.35, 1e-9);   // H = -90, V = -45
  EXPECT_NEAR(CdTowards(photometry, 0, 90), 120 * 1.35, 1e-9);    // H = 0, V = 0
  EXPECT_NEAR(CdTowards(photometry, 270, 90), 140 * 1.35, 1e-9);  // H = 90
  EXPECT_EQ(CdTowards(photometry, 180, 90), 0);                   // behind: not given
}

// Planes about the axis across C0: straight down is (0, 0), along C0 (H, V) = (0, 90), H = 90 is C270.
TEST(IesFile, TypeBHasItsPolesAcross) {
  std::string text = Replaced(kIes, "3 3 1 2", "3 3 2 2");
  text = Replaced(text, "0 45 90\n0 45 90\n300 200 100\n300 220 120\n300 240 140",
                  "-90 0 90\n-45 0 45\n10 20 30\n40 50 60\n70 80 90");
  const PhotometryFile photometry = Parse(text);
  EXPECT_NEAR(CdTowards(photometry, 0, 0), 50 * 1.35, 1e-9);
  EXPECT_NEAR(CdTowards(photometry, 0, 90), 60 * 1.35, 1e-9);    // V = 90
  EXPECT_NEAR(CdTowards(photometry, 180, 90), 40 * 1.35, 1e-9);  // V = -90
  EXPECT_NEAR(CdTowards(photometry, 270, 45), 80 * 1.35, 1e-9);  // H = 45
  EXPECT_NEAR(CdTowards(photometry, 90, 45), 20 * 1.35, 1e-9);   // H = -45
  // Between them, against the definition: d = cos H (sin V x - cos V z) - sin H y.
  const double h = 0.3, v = 0.5;
  const Eigen::Vector3d d(std::cos(h) * std::sin(v), -std::sin(h), -std::cos(h) * std::cos(v));
  const double a = h / (kPi / 4), b = v / (kPi / 2);
  const double expected = (1 - a) * (50 + b * 10) + a * (80 + b * 10);
  EXPECT_NEAR(photometry.luminaire_flux_lm * IntensityTowards(photometry.table, d).cd_per_lm, expected * 1.35,
              1e-9);
}

TEST(IesFile, OneSideOfTypeBStandsForBoth) {
  std::string text = Replaced(kIes, "3 3 1 2", "3 3 2 2");
  text = Replaced(text, "0 45 90\n0 45 90", "-90 0 90\n0 45 90");
  const PhotometryFile photometry = Parse(text);
  EXPECT_NEAR(CdTowards(photometry, 90, 45), 220 * 1.35, 1e-9);
  EXPECT_NEAR(CdTowards(photometry, 270, 45), 220 * 1.35, 1e-9);
}

TEST(IesFile, TheOpeningIsTheNearestShape) {
  struct Case {
    const char *version, *measures;
    LuminaireShape shape;
    double along, across;
    const char* note;
  };
  const char *old = "IESNA:LM-63-1995", *present = "IESNA:LM-63-2002";
  for (const Case& one : {Case{present, "0 0 0", LuminaireShape::kPoint, 0, 0, ""},
                          Case{present, "0.2 0.6 0", LuminaireShape::kRectangle, 0.6, 0.2, ""},
                          Case{present, "0.2 0.6 0.1", LuminaireShape::kRectangle, 0.6, 0.2, "sides"},
                          Case{old, "-0.3 0 0", LuminaireShape::kDisc, 0.3, 0, ""},
                          Case{present, "-0.3 -0.3 0", LuminaireShape::kDisc, 0.3, 0, ""},
                          Case{present, "-0.3 -0.3 0.2", LuminaireShape::kDisc, 0.3, 0, "sides"},
                          Case{present, "-0.2 -0.8 0", LuminaireShape::kDisc, 0.4, 0, "ellipse"},
                          Case{old, "-0.2 0.8 0", LuminaireShape::kDisc, 0.4, 0, "ellipse"},
                          Case{old, "-0.3 0 -0.3", LuminaireShape::kSphere, 0.3, 0, ""},
                          Case{present, "-0.3 -0.3 -0.3", LuminaireShape::kSphere, 0.3, 0, ""},
                          Case{present, "-0.1 -0.2 -0.4", LuminaireShape::kSphere, 0.2, 0, "ellipsoid"},
                          Case{old, "0 1.2 -0.1", LuminaireShape::kRectangle, 1.2, 0.1, "cylinder"},
                          Case{present, "-0.1 1.2 -0.1", LuminaireShape::kRectangle, 1.2, 0.1, "cylinder"},
                          Case{present, "1.2 -0.1 -0.1", LuminaireShape::kRectangle, 0.1, 1.2, "cylinder"},
                          Case{present, "0 1.2 0", LuminaireShape::kRectangle, 1.2, 0.001, "1 mm"},
                          Case{present, "-0.3 0 -0.3", LuminaireShape::kSphere, 0.3, 0, "vertical disc"}}) {
    const PhotometryFile photometry = Parse(
        Replaced(Replaced(kIes, present, one.version), "0.2 0.6 0\n", std::string(one.measures) + "\n"));
    EXPECT_EQ(photometry.shape, one.shape) << one.measures;
    EXPECT_NEAR(photometry.size_m[0], one.along, 1e-9) << one.measures;
    EXPECT_NEAR(photometry.size_m[1], one.across, 1e-9) << one.measures;
    if (*one.note == '\0') {
      EXPECT_TRUE(photometry.notes.empty()) << one.measures;
    } else {
      ASSERT_EQ(photometry.notes.size(), 1u) << one.measures;
      EXPECT_THAT(photometry.notes[0], HasSubstr(one.note)) << one.measures;
    }
  }
}

TEST(IesFile, FeetAreTurnedIntoMetres) {
  const PhotometryFile photometry = Parse(Replaced(kIes, "1 2 0.2 0.6 0", "1 1 1 2 0"));
  EXPECT_NEAR(photometry.size_m[0], 0.6096, 1e-12);
  EXPECT_NEAR(photometry.size_m[1], 0.3048, 1e-12);
}

TEST(IesFile, TiltIsReadFromTheFileOrBesideIt) {
  const std::string data = "1\n3\n-30 30 90\n0.6 0.8 1\n";
  const double expected = 0.7 * 300 * 1.35;  // at 0 degrees
  EXPECT_NEAR(CdTowards(Parse(Replaced(kIes, "TILT=NONE\n", "TILT=INCLUDE\n" + data)), 0, 0), expected, 1e-9);
  const TempFolder folder;
  folder.Write("lamp.ies", Replaced(kIes, "TILT=NONE", "TILT=c:\\tilt\\lamp.tlt"));
  EXPECT_THROW(ReadPhotometry(folder.Path("lamp.ies")), std::runtime_error);
  folder.Write("lamp.tlt", data);
  const PhotometryFile photometry = ReadPhotometry(folder.Path("lamp.ies"));
  EXPECT_NEAR(CdTowards(photometry, 0, 0), expected, 1e-9);
  ASSERT_EQ(photometry.notes.size(), 1u);
  EXPECT_THAT(photometry.notes[0], HasSubstr("TILT"));
}

// By the angle between the aim and straight down, against the factor at 0, which the table's intensities hold.
TEST(IesFile, TiltAppliesByTheAim) {
  const PhotometryFile photometry =
      Parse(Replaced(kIes, "TILT=NONE\n", "TILT=INCLUDE\n1\n4\n0 45 90 180\n0.5 0.45 0.4 0.35\n"));
  EXPECT_NEAR(TiltFactor(photometry, {0, 0, -1}), 1, 1e-12);
  EXPECT_NEAR(TiltFactor(photometry, {1, 0, -1}), 0.9, 1e-12);
  EXPECT_NEAR(TiltFactor(photometry, {0, -1, -1}), 0.9, 1e-12);
  EXPECT_NEAR(TiltFactor(photometry, {1, 0, 0}), 0.8, 1e-12);
  EXPECT_NEAR(TiltFactor(photometry, {0, 0, 1}), 0.7, 1e-12);
  EXPECT_NEAR(TiltFactor(photometry, {std::tan(M_PI / 8), 0, -1}), 0.95, 1e-12);
  EXPECT_EQ(TiltFactor(Parse(kIes), {1, 0, 0}), 1);
}

TEST(IesFile, OddHabitsAreRead) {
  // DOS line ends and ^Z, commas, lines broken anywhere, a byte-order mark, +, exponents.
  std::string text = Replaced(kIes, "0 45 90\n0 45 90\n300 200 100", "0,45, +9e1\n0\n45\n90 300\n200 100");
  for (size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  text = "\xef\xbb\xbf" + text + "\x1a";
  const IesFile file = ParseIes(text, "a.ies");
  EXPECT_EQ(file.version, IesVersion::k2002);
  EXPECT_EQ(file.candela, ParseIes(kIes, "a.ies").candela);
  EXPECT_THAT(file.notes, testing::ElementsAre(HasSubstr("commas were read as separators")));
}

TEST(IesFile, WhatFollowsIsNoted) {
  EXPECT_THAT(ParseIes(std::string(kIes) + "made by hand, 1,5 h", "a.ies").notes,
              testing::ElementsAre(HasSubstr("ignored")));
}

TEST(IesFile, IsRefusedWithItsLine) {
  const auto error = [](const std::string& from, const std::string& to) {
    return PhotometryError(Replaced(kIes, from, to), "a.ies");
  };
  EXPECT_THAT(PhotometryError("", "a.ies"), HasSubstr("a.ies:0: TILT: expected a line TILT=NONE"));
  EXPECT_THAT(PhotometryError("some\nletter\n", "a.ies"), HasSubstr("a.ies:2: TILT: expected"));
  EXPECT_THAT(error("TILT=NONE", "TILT="), HasSubstr("a.ies:5: TILT: expected NONE"));
  EXPECT_THAT(error("2 1000", "two 1000"),
              HasSubstr("a.ies:6: number of lamps: expected a number, got \"two\"; write it"));
  EXPECT_THAT(error("2 1000", "2 0"), HasSubstr("a.ies:6: lumens per lamp: expected > 0, or -1"));
  EXPECT_THAT(error("2 1000", "2 nan"), HasSubstr("lumens per lamp: expected a number, got \"nan\""));
  EXPECT_THAT(error("2 1000", "2 1e400"), HasSubstr("lumens per lamp: expected a number, got \"1e400\""));
  EXPECT_THAT(error("2 1000", "2 1e12"), HasSubstr("lumens per lamp: expected a number up to 1e9"));
  EXPECT_THAT(error("1.5 3 3 1", "1.5 -3 3 1"), HasSubstr("a.ies:6: number of vertical angles: expected a"));
  EXPECT_THAT(error("1.5 3 3 1", "1.5 3.5 3 1"), HasSubstr("whole number"));
  EXPECT_THAT(error("1.5 3 3 1", "1.5 1 3 1"), HasSubstr("number of vertical angles"));
  EXPECT_THAT(error("1.5 3 3 1", "1.5 900000 3 1"),
              AllOf(HasSubstr("a.ies:7: vertical angles: expected 900000 numbers"), HasSubstr("cut short")));
  EXPECT_THAT(error("1.5 3 3 1", "1.5 3 1e30 1"),
              HasSubstr("number of horizontal angles: expected a number"));
  EXPECT_THAT(error("3 3 1 2", "3 3 4 2"), HasSubstr("photometric type"));
  EXPECT_THAT(error("3 3 1 2", "3 3 1 3"), HasSubstr("units"));
  EXPECT_THAT(error("0.9 1.7", "0 1.7"), HasSubstr("a.ies:7: ballast factor"));
  EXPECT_THAT(error("0 45 90\n0", "0 90 45\n0"),
              HasSubstr("a.ies:8: vertical angles: expected rising angles, got 45 after 90"));
  EXPECT_THAT(error("0 45 90\n0", "0 45 190\n0"), HasSubstr("a.ies:8: vertical angles: expected a number"));
  EXPECT_THAT(error("0 45 90\n300", "0 45 80\n300"),
              HasSubstr("a.ies:9: horizontal angles: expected them from 0 to 0, 90, 180 or 360"));
  EXPECT_THAT(error("300 220 120", "300 -220 120"), HasSubstr("a.ies:11: candela values: expected a number"));
  EXPECT_THAT(error("300 240 140\n", "300 240"), HasSubstr("end of the file"));
  EXPECT_THAT(error("300 200 100\n300 220 120\n300 240 140", "0 0 0 0 0 0 0 0 0"),
              HasSubstr("expected light in some direction"));
  EXPECT_THAT(error("TILT=NONE", "TILT=INCLUDE\n4"), HasSubstr("a.ies:6: lamp-to-luminaire geometry"));
  EXPECT_THAT(PhotometryError(kIes, "a.txt"), HasSubstr("expected a photometric file .ies"));
  EXPECT_THROW(ReadPhotometry("/nowhere/a.ies"), std::runtime_error);
}

TEST(IesFile, EveryBeginningOfAFileIsRefused) {
  const std::string text = kIes;
  for (size_t length = 0; length + 5 < text.size(); ++length)
    EXPECT_THAT(PhotometryError(text.substr(0, length), "a.ies"), HasSubstr("a.ies:")) << length;
}

TEST(IesFile, EveryVersionReadsBackEqual) {
  for (const char* first :
       {"Text of 1986", "IESNA91", "IESNA:LM-63-1995", "IESNA:LM-63-2002", "IES:LM-63-2019"}) {
    std::string text = Replaced(kIes, "IESNA:LM-63-2002", first);
    text = Replaced(text, "TILT=NONE\n", "TILT=INCLUDE\n2\n2\n0 90\n1 0.95\n");
    text = Replaced(text, "300 220 120", "300.125 220.3333333 1e-7");
    const IesFile file = ParseIes(text, "a.ies"), again = ParseIes(IesText(file), "b.ies");
    EXPECT_EQ(again.version, file.version);
    ASSERT_EQ(again.keywords.size(), file.keywords.size());
    for (size_t i = 0; i < file.keywords.size(); ++i) {
      EXPECT_EQ(again.keywords[i].name, file.keywords[i].name);
      EXPECT_EQ(again.keywords[i].text, file.keywords[i].text);
    }
    EXPECT_EQ(again.tilt.lamp_geometry, 2);
    EXPECT_EQ(again.tilt.factor, file.tilt.factor);
    EXPECT_EQ(again.third_factor, file.third_factor);
    EXPECT_EQ(again.width, file.width);
    EXPECT_EQ(again.vertical_deg, file.vertical_deg);
    EXPECT_EQ(again.horizontal_deg, file.horizontal_deg);
    EXPECT_EQ(again.candela, file.candela);  // bit for bit
    EXPECT_EQ(IesText(again), IesText(file));
  }
}

}  // namespace
}  // namespace luxfit
