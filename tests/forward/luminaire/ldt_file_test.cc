#include "forward/luminaire/internal/ldt_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "forward/luminaire/internal/ies_file.h"
#include "tests/support/closed_forms.h"
#include "tests/support/forward/photometry_text.h"

namespace luxfit {
namespace {

using support::kLdt;
using support::kPi;
using support::PhotometryError;
using support::Replaced;
using testing::AllOf;
using testing::HasSubstr;

double CdInPlane(const PhotometryFile& photometry, double c_deg, double gamma_deg) {
  const double c = c_deg * kPi / 180, g = gamma_deg * kPi / 180;
  const Eigen::Vector3d d(std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), -std::cos(g));
  return photometry.luminaire_flux_lm * IntensityTowards(photometry.table, d).cd_per_lm;
}

PhotometryFile ParseEulumdat(const std::string& text) { return ParsePhotometry(text, "a.ldt"); }

// All planes alike in gamma; their intensity at gamma = 90 is their place in the file.
std::string WithPlanes(int isym, int stored) {
  std::string text = Replaced(kLdt, "\n4\n8\n", "\n" + std::to_string(isym) + "\n8\n");
  text.resize(text.find("300\n200\n"));
  for (int i = 0; i < stored; ++i) text += "500\n400\n" + std::to_string(100 + i) + "\n";
  return text;
}

TEST(LdtFile, IsReadAsItStands) {
  const LdtFile file = ParseLdt(kLdt, "a.ldt");
  EXPECT_EQ(file.company, "Maker");
  EXPECT_EQ(file.symmetry, 4);
  EXPECT_EQ(file.planes, 8);
  EXPECT_EQ(file.luminaire, "Name");
  EXPECT_EQ(file.light_output_percent, 80);
  ASSERT_EQ(file.lamps.size(), 1u);
  EXPECT_EQ(file.lamps[0].count, 2);
  EXPECT_EQ(file.lamps[0].colour, "4000K");
  EXPECT_EQ(file.direct_ratio[9], 10);
  EXPECT_EQ(file.cd_per_klm.size(), 9u);
  EXPECT_TRUE(file.notes.empty());
}

TEST(LdtFile, IsPer1000LumensOfTheLamps) {
  const PhotometryFile photometry = ParseEulumdat(kLdt);
  EXPECT_NEAR(CdInPlane(photometry, 45, 45), 220 * 1.5 * 2, 1e-9);  // conversion factor, 2000 lm
  EXPECT_EQ(photometry.lamp_flux_lm, 2000);
  EXPECT_EQ(photometry.stated_flux_lm, 1600);
}

TEST(LdtFile, ANegativeNumberOfLampsIsAbsolute) {
  const PhotometryFile photometry = ParseEulumdat(Replaced(kLdt, "\n2\nlamp", "\n-1\nlamp"));
  EXPECT_EQ(photometry.lamp_flux_lm, 0);
  EXPECT_NEAR(CdInPlane(photometry, 45, 45), 220 * 1.5 * 2, 1e-9);
}

TEST(LdtFile, TheFirstLampSetCounts) {
  const PhotometryFile photometry =
      ParseEulumdat(Replaced(kLdt, "\n1\n2\nlamp", "\n2\n2\nlamp\n4000\nwarm\n90\n72\n2\nlamp"));
  EXPECT_NEAR(CdInPlane(photometry, 0, 0), 300 * 1.5 * 4, 1e-9);
  EXPECT_THAT(photometry.notes, testing::ElementsAre(HasSubstr("first of 2 lamp sets")));
}

TEST(LdtFile, LengthRunsAlongC90) {
  const PhotometryFile photometry = ParseEulumdat(kLdt);
  EXPECT_EQ(photometry.shape, LuminaireShape::kRectangle);
  EXPECT_NEAR(photometry.size_m[0], 0.18, 1e-12);
  EXPECT_NEAR(photometry.size_m[1], 1.1, 1e-12);
  const PhotometryFile disc = ParseEulumdat(Replaced(kLdt, "\n1100\n180\n", "\n300\n0\n"));
  EXPECT_EQ(disc.shape, LuminaireShape::kDisc);
  EXPECT_NEAR(disc.size_m[0], 0.3, 1e-12);
  EXPECT_EQ(ParseEulumdat(Replaced(kLdt, "\n1100\n180\n", "\n0\n0\n")).shape, LuminaireShape::kPoint);
}

TEST(LdtFile, EverySymmetryFillsTheCircle) {
  // Intensity at gamma = 90 of C0, C45, ..., C315: the place of the plane that stands for it.
  const std::vector<std::vector<int>> expected = {
      {0, 1, 2, 3, 4, 5, 6, 7},
      {0, 0, 0, 0, 0, 0, 0, 0},
      {0, 1, 2, 3, 4, 3, 2, 1},
      {2, 3, 4, 3, 2, 1, 0, 1},  // stored from C270 through C0 to C90
      {0, 1, 2, 1, 0, 1, 2, 1}};
  const int stored[] = {8, 1, 5, 5, 3};
  for (int isym = 0; isym <= 4; ++isym) {
    const PhotometryFile photometry = ParseEulumdat(WithPlanes(isym, stored[isym]));
    for (int plane = 0; plane < 8; ++plane) {
      EXPECT_NEAR(CdInPlane(photometry, 45 * plane, 90),
                  3 * (100 + expected[static_cast<size_t>(isym)][static_cast<size_t>(plane)]), 1e-9)
          << "Isym " << isym << ", C" << 45 * plane;
    }
  }
}

TEST(LdtFile, DecimalCommasAreReadWithANote) {
  const LdtFile file = ParseLdt(Replaced(kLdt, "\n220\n", "\n220,5\n"), "a.ldt");
  EXPECT_EQ(file.cd_per_klm[4], 220.5);
  EXPECT_THAT(file.notes, testing::ElementsAre(HasSubstr("1 decimal commas")));
}

TEST(LdtFile, Latin1BecomesUtf8AndStaysIt) {
  const std::string text = Replaced(kLdt, "Maker", "Stra\xdf\x65nleuchte \xb0 M\xfcller");
  EXPECT_EQ(ParseLdt(LdtText(ParseLdt(text, "a.ldt")), "b.ldt").company,
            u8"Stra\u00dfenleuchte \u00b0 M\u00fcller");
}

TEST(LdtFile, IsRefusedWithItsLine) {
  const auto error = [](const std::string& from, const std::string& to) {
    return PhotometryError(Replaced(kLdt, from, to), "a.ldt");
  };
  EXPECT_THAT(PhotometryError("", "a.ldt"), HasSubstr("a.ldt:1: file: expected an EULUMDAT file"));
  EXPECT_THAT(error("Maker\n2\n4", "Maker\n2\n5"), HasSubstr("a.ldt:3: Isym: expected a whole number"));
  EXPECT_THAT(error("Maker\n2\n4", "Maker\nIESNA\n4"), HasSubstr("a.ldt:2: Ityp: expected a number"));
  EXPECT_THAT(error("\n4\n8\n", "\n4\n6\n"),
              HasSubstr("a.ldt:4: Mc, number of C planes: expected a multiple"));
  EXPECT_THAT(error("\n4\n8\n", "\n4\n-8\n"), HasSubstr("a.ldt:4: Mc"));
  EXPECT_THAT(error("\n4\n8\n", "\n4\n800000\n"),
              AllOf(HasSubstr("C angles: expected 800000 numbers"), HasSubstr("cut short")));
  EXPECT_THAT(error("\n4\n8\n", "\n4\n9e99\n"), HasSubstr("a.ldt:4: Mc"));
  EXPECT_THAT(error("\n45\n3\n45\n", "\n45\n1\n45\n"), HasSubstr("a.ldt:6: Ng"));
  EXPECT_THAT(error("\n1100\n180\n", "\n1100\n-180\n"), HasSubstr("a.ldt:17: luminous area"));
  EXPECT_THAT(error("\n80\n1.5\n", "\n80\n0\n"), HasSubstr("a.ldt:24: conversion factor: expected > 0"));
  EXPECT_THAT(error("\n2000\n", "\n0\n"), HasSubstr("a.ldt:29: total flux of the lamps: expected > 0"));
  EXPECT_THAT(error("\n1\n2\nlamp", "\n0\n2\nlamp"), HasSubstr("a.ldt:26: number of lamp sets"));
  EXPECT_THAT(error("\n1\n2\nlamp", "\n99999\n2\nlamp"), HasSubstr("number of lamps"));
  EXPECT_THAT(error("0\n45\n90\n135", "0\n90\n45\n135"),
              HasSubstr("a.ldt:45: C angles: expected rising angles, got 45 after 90"));
  EXPECT_THAT(error("0\n45\n90\n135", "0\n45\n91\n135"), HasSubstr("C angles: expected planes for Isym 4"));
  EXPECT_THAT(error("\n220\n", "\nabc\n"), HasSubstr("luminous intensities: expected a number, got \"abc\""));
  EXPECT_THAT(error("\n220\n", "\n-220\n"), HasSubstr("luminous intensities: expected a number from 0"));
  EXPECT_THAT(error("\n240\n140\n", "\n240\n"), HasSubstr("end of the file"));
}

TEST(LdtFile, EveryBeginningOfAFileIsRefused) {
  const std::string text = kLdt;
  for (size_t length = 0; length + 4 < text.size(); ++length)
    EXPECT_THAT(PhotometryError(text.substr(0, length), "a.ldt"), HasSubstr("a.ldt:")) << length;
}

TEST(LdtFile, ReadsBackEqual) {
  const LdtFile file = ParseLdt(Replaced(kLdt, "\n220\n", "\n220.333333333\n"), "a.ldt");
  const LdtFile again = ParseLdt(LdtText(file), "b.ldt");
  EXPECT_EQ(again.symmetry, file.symmetry);
  EXPECT_EQ(again.area_length_mm, file.area_length_mm);
  EXPECT_EQ(again.lamps[0].power, file.lamps[0].power);
  EXPECT_EQ(again.direct_ratio, file.direct_ratio);
  EXPECT_EQ(again.c_deg, file.c_deg);
  EXPECT_EQ(again.cd_per_klm, file.cd_per_klm);  // bit for bit
  EXPECT_EQ(LdtText(again), LdtText(file));
}

// From one format to the other and back the light is the same.
TEST(LdtFile, TurnsIntoIesAndBack) {
  for (const std::string& text : {std::string(kLdt), WithPlanes(0, 8), WithPlanes(1, 1), WithPlanes(3, 5)}) {
    const PhotometryFile photometry = ParseEulumdat(text);
    const PhotometryFile ies = PhotometryOf(ParseIes(IesText(MakeIes(photometry)), "a.ies"));
    const PhotometryFile ldt = PhotometryOf(ParseLdt(LdtText(MakeLdt(ies)), "a.ldt"));
    EXPECT_NEAR(ldt.luminaire_flux_lm, photometry.luminaire_flux_lm, 1e-9 * photometry.luminaire_flux_lm);
    EXPECT_EQ(ldt.shape, photometry.shape);
    EXPECT_NEAR((ldt.size_m - photometry.size_m).norm(), 0, 1e-12);
    for (double c = 0; c < 360; c += 22.5) {
      for (const double gamma : {0.0, 30.0, 90.0}) {
        EXPECT_NEAR(CdInPlane(ldt, c, gamma), CdInPlane(photometry, c, gamma), 1e-6);
        EXPECT_NEAR(CdInPlane(ies, c, gamma), CdInPlane(photometry, c, gamma), 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace luxfit
