// Every file of fixtures/photometry: read, written, read again; its flux by our integral beside what it
// states.
//
//   forward_photometry_fixtures_test          prints the table
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "forward/luminaire/internal/ies_file.h"
#include "forward/luminaire/internal/ldt_file.h"
#include "tests/paths.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> Files(const std::string& extension) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(std::string(LUXFIT_FIXTURES) + "/photometry")) {
    if (entry.path().extension() == extension) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string NameOf(const std::string& path) {
  return fs::relative(path, std::string(LUXFIT_FIXTURES) + "/photometry").string();
}

TEST(PhotometryFixtures, AreAllRead) {
  EXPECT_EQ(Files(".ldt").size(), 26u);
  EXPECT_EQ(Files(".ies").size(), 19u);
  std::printf("%-72s %9s %9s\n", "file", "flux lm", "stated");
  for (const char* extension : {".ldt", ".ies"}) {
    for (const std::string& path : Files(extension)) {
      const PhotometryFile photometry = ReadPhotometry(path);
      EXPECT_GT(photometry.luminaire_flux_lm, 0) << path;
      EXPECT_NEAR(FluxIntegral(photometry.table), 1, 1e-12) << path;
      std::printf("%-72s %9.2f %9.2f\n", NameOf(path).c_str(), photometry.luminaire_flux_lm,
                  photometry.stated_flux_lm);
    }
  }
}

// Files of real measurements and the CIE's example: their light output ratio times the flux of their lamps.
// The ratio is rounded to 0.1 % or 0.01 %, and the makers integrate by zones. The files of photometric_viewer
// are made up to test openings: their numbers do not agree with themselves, and the minimal example has five
// angles.
TEST(PhotometryFixtures, FluxIsWhatTheFilesState) {
  int compared = 0;
  for (const std::string& path : Files(".ldt")) {
    const std::string name = NameOf(path);
    if (name.rfind("eulumdat_py_samples", 0) != 0 && name.find("CIE-2010") == std::string::npos) continue;
    const PhotometryFile photometry = ReadPhotometry(path);
    EXPECT_NEAR(photometry.luminaire_flux_lm / photometry.stated_flux_lm, 1, 1e-3) << name;
    ++compared;
  }
  EXPECT_EQ(compared, 10);
}

// Made files of one distribution and many headers: its flux by hand is that of 37 values, times the
// multiplier.
TEST(PhotometryFixtures, MultipliersMultiply) {
  const std::string folder = std::string(LUXFIT_FIXTURES) + "/photometry/photometric_viewer/";
  for (const char* kind : {"absolute", "relative"}) {
    const double plain = ReadPhotometry(folder + kind + "_photometry.ies").luminaire_flux_lm;
    const double more = ReadPhotometry(folder + kind + "_photometry_with_multiplier.ies").luminaire_flux_lm;
    EXPECT_NEAR(more / plain, 1.5, 1e-12);
  }
}

TEST(PhotometryFixtures, OpeningsAreWhatTheirNamesSay) {
  const std::string folder = std::string(LUXFIT_FIXTURES) + "/photometry/photometric_viewer/";
  const std::map<std::string, LuminaireShape> expected = {
      {"point_opening.ies", LuminaireShape::kPoint},
      {"rectangular_opening.ies", LuminaireShape::kRectangle},
      {"round_opening_with_height.ies", LuminaireShape::kDisc},
      {"sphere_opening.ies", LuminaireShape::kSphere},
      {"ellipse_opening_along_width.ies", LuminaireShape::kDisc},
      {"horizontal_cylinder_opening_along_length.ies", LuminaireShape::kRectangle},
      {"round_luminaire_rectangular_luminous_opening.ldt", LuminaireShape::kRectangle},
      {"rectangular_luminaire_round_luminous_opening.ldt", LuminaireShape::kDisc}};
  for (const auto& [name, shape] : expected) EXPECT_EQ(ReadPhotometry(folder + name).shape, shape) << name;
  const PhotometryFile cylinder = ReadPhotometry(folder + "horizontal_cylinder_opening_along_length.ies");
  EXPECT_NEAR(cylinder.size_m[0], 0.12, 1e-12);
}

TEST(PhotometryFixtures, ReadBackEqual) {
  for (const std::string& path : Files(".ies")) {
    const IesFile file = ReadIes(path), again = ParseIes(IesText(file), path);
    EXPECT_EQ(again.candela, file.candela) << path;
    EXPECT_EQ(again.vertical_deg, file.vertical_deg) << path;
    EXPECT_EQ(again.width, file.width) << path;
    EXPECT_EQ(IesText(again), IesText(file)) << path;
  }
  for (const std::string& path : Files(".ldt")) {
    const LdtFile file = ReadLdt(path), again = ParseLdt(LdtText(file), path);
    EXPECT_EQ(again.cd_per_klm, file.cd_per_klm) << path;
    EXPECT_EQ(again.c_deg, file.c_deg) << path;
    EXPECT_EQ(again.company, file.company) << path;
    EXPECT_EQ(LdtText(again), LdtText(file)) << path;
  }
}

TEST(PhotometryFixtures, TruncatedAnywhereAreRefused) {
  for (const char* name :
       {"/photometry/eulumdat_py_samples/sample5.ldt", "/photometry/photometric_viewer/imperial_units.ies"}) {
    std::ifstream file(std::string(LUXFIT_FIXTURES) + name, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (size_t length = 0; length + 8 < text.size(); length += 13)
      EXPECT_THROW(ParsePhotometry(text.substr(0, length), name), std::runtime_error)
          << name << " " << length;
  }
}

}  // namespace
}  // namespace luxfit
