// Distributions written as .ies and .ldt: read back by our own readers, and held against the formats' rules.
//
//   LUXFIT_REAL_DATA=FOLDER forward_photometry_writer_test      also makers' files in FOLDER/photometry
#include "forward/luminaire/photometry_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "forward/luminaire/internal/ies_file.h"
#include "forward/luminaire/internal/ldt_file.h"
#include "tests/paths.h"
#include "tests/support/closed_forms.h"
#include "tests/support/forward/test_lamps.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;
using support::kPi;

constexpr double kFluxLm = 1234.56;
constexpr double kTolerance = 0.005;  // of the peak

const PhotometryLabels kLabels{"office", "luxfit", "a room", "A", "luminaire A", "2026-01-31", {"flux 1 lm"}};

Luminaire Lamp(Distribution distribution, double exponent = 1) {
  Luminaire lamp;
  lamp.id = "A";
  lamp.distribution = distribution;
  lamp.cosine_exponent = exponent;
  lamp.flux_lm = kFluxLm;
  if (distribution == Distribution::kMeasured) lamp.table = support::LopsidedTable();
  return lamp;
}

std::vector<Luminaire> AllLamps() {
  std::vector<Luminaire> lamps = {Lamp(Distribution::kIsotropic), Lamp(Distribution::kLambertian),
                                  Lamp(Distribution::kMeasured)};
  for (const double exponent : {0.2, 0.5, 1.0, 1.7, 8.0, 30.0, 100.0, 3000.0, 1e4})
    lamps.push_back(Lamp(Distribution::kCosinePower, exponent));
  return lamps;
}

std::string NameOf(const Luminaire& lamp) {
  return ToString(lamp.distribution) + " " + std::to_string(lamp.cosine_exponent);
}

// Of the luminaire itself, in its own frame.
double TrueCd(const Luminaire& lamp, const Eigen::Vector3d& direction) {
  Luminaire hung = lamp;
  hung.aim = {0, 0, -1};
  hung.heading = {1, 0, 0};
  return lamp.flux_lm * IntensityPerLumen(hung, AxesOf(hung), direction).cd_per_lm;
}

Eigen::Vector3d Direction(double c_deg, double gamma_deg) {
  const double c = c_deg * kPi / 180, g = gamma_deg * kPi / 180;
  return {std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), -std::cos(g)};
}

// Gammas that no table has, dense about the aim; up to what falls as a step.
std::vector<double> Gammas() {
  std::vector<double> gammas;
  for (double g = 0.0013; g < 6; g *= 1.07) gammas.push_back(g);
  for (double g = 6.0123; g < 180; g += 0.37) gammas.push_back(g);
  for (const double below : {1.0, 0.3, 0.1, 0.03, 0.021}) gammas.push_back(90 - below);
  return gammas;
}

void ExpectSameLight(const Luminaire& lamp, const PhotometryFile& read, const std::string& what) {
  // Scaled exactly; what is left is the rounding of the intensities: five or seven digits.
  EXPECT_NEAR(read.luminaire_flux_lm / lamp.flux_lm, 1, read.format == "EULUMDAT" ? 1e-4 : 1e-5) << what;
  double peak = 0, worst = 0;
  for (const double c : {0.0, 7.0, 45.0, 123.4, 270.0, 359.0}) {
    for (const double gamma : Gammas()) {
      const Eigen::Vector3d direction = Direction(c, gamma);
      const double expected = TrueCd(lamp, direction);
      const double got = read.luminaire_flux_lm * IntensityTowards(read.table, direction).cd_per_lm;
      peak = std::max(peak, expected);
      worst = std::max(worst, std::abs(got - expected));
    }
  }
  EXPECT_LE(worst, kTolerance * peak) << what;
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  size_t from = 0, to = 0;
  for (; (to = text.find("\r\n", from)) != std::string::npos; from = to + 2)
    lines.push_back(text.substr(from, to - from));
  EXPECT_EQ(from, text.size());  // the last line ends too
  return lines;
}

TEST(PhotometryWriter, ReadsBackAsTheSameLight) {
  for (const Luminaire& lamp : AllLamps()) {
    const PhotometryTexts texts = WritePhotometry(lamp, kLabels);
    ExpectSameLight(lamp, ParsePhotometry(texts.ies, "a.ies"), NameOf(lamp) + " .ies");
    ExpectSameLight(lamp, ParsePhotometry(texts.ldt, "a.ldt"), NameOf(lamp) + " .ldt");
    EXPECT_TRUE(ParsePhotometry(texts.ies, "a.ies").notes.empty()) << NameOf(lamp);
    EXPECT_TRUE(ParsePhotometry(texts.ldt, "a.ldt").notes.empty()) << NameOf(lamp);
  }
}

TEST(PhotometryWriter, TheIntegralBeforeScalingIsTheFluxAlready) {
  for (const Luminaire& lamp : AllLamps()) {
    const IntensityTable table = TabulatedPhotometry(lamp).table;
    EXPECT_NEAR(FluxIntegral(table), 1, 1e-12);
    // What scaling changed stands at the aim, where the chords meet the curve.
    const double at_aim = IntensityTowards(table, {0, 0, -1}).cd_per_lm;
    EXPECT_NEAR(at_aim * lamp.flux_lm / TrueCd(lamp, {0, 0, -1}), 1, 1e-3) << NameOf(lamp);
  }
}

TEST(PhotometryWriter, OpeningsReadBack) {
  struct Case {
    LuminaireShape shape;
    Eigen::Vector2d size_m;
  };
  for (const Case& one :
       {Case{LuminaireShape::kPoint, {0.3, 0.3}}, Case{LuminaireShape::kRectangle, {0.6034, 1.2001}},
        Case{LuminaireShape::kRectangle, {0.0004, 1.5}}, Case{LuminaireShape::kDisc, {0.251, 0.251}},
        Case{LuminaireShape::kSphere, {0.4, 0}}}) {
    Luminaire lamp = Lamp(Distribution::kLambertian);
    lamp.shape = one.shape;
    lamp.size_m = one.size_m;
    const PhotometryTexts texts = WritePhotometry(lamp, kLabels);
    const PhotometryFile ies = ParsePhotometry(texts.ies, "a.ies"), ldt = ParsePhotometry(texts.ldt, "a.ldt");
    EXPECT_EQ(ies.shape, one.shape);
    EXPECT_EQ(ldt.shape, one.shape == LuminaireShape::kSphere ? LuminaireShape::kDisc : one.shape);
    Eigen::Vector2d expected(0, 0);
    if (one.shape != LuminaireShape::kPoint) expected[0] = one.size_m[0];
    // Widths below a millimetre are one.
    if (one.shape == LuminaireShape::kRectangle) expected = one.size_m.cwiseMax(1e-3);
    EXPECT_LE((ies.size_m - expected).cwiseAbs().maxCoeff(), 0.51e-4);
    EXPECT_LE((ldt.size_m - expected).cwiseAbs().maxCoeff(), 0.51e-3);
  }
}

// LM-63-2002 round openings: both measures negative; a sphere's height too.
TEST(PhotometryWriter, IesMeasuresFollowTheStandard) {
  Luminaire lamp = Lamp(Distribution::kLambertian);
  lamp.size_m = {0.6, 0.3};
  const auto measures = [&lamp](LuminaireShape shape) {
    lamp.shape = shape;
    const IesFile file = ParseIes(WritePhotometry(lamp, kLabels).ies, "a.ies");
    EXPECT_FALSE(file.in_feet);
    return std::vector<double>{file.width, file.length, file.height};
  };
  EXPECT_THAT(measures(LuminaireShape::kPoint), testing::ElementsAre(0, 0, 0));
  EXPECT_THAT(measures(LuminaireShape::kRectangle), testing::ElementsAre(0.3, 0.6, 0));
  EXPECT_THAT(measures(LuminaireShape::kDisc), testing::ElementsAre(-0.6, -0.6, 0));
  EXPECT_THAT(measures(LuminaireShape::kSphere), testing::ElementsAre(-0.6, -0.6, -0.6));
}

// Line by line, without our reader: label, TILT, the two records of counts, then exactly so many numbers.
TEST(PhotometryWriter, IesIsWhatLm63AsksFor) {
  for (const Luminaire& lamp : AllLamps()) {
    const std::vector<std::string> lines = Lines(WritePhotometry(lamp, kLabels).ies);
    ASSERT_GT(lines.size(), 10u);
    EXPECT_EQ(lines[0], "IESNA:LM-63-2002");
    const auto tilt = std::find(lines.begin(), lines.end(), "TILT=NONE");
    ASSERT_NE(tilt, lines.end());
    for (const char* keyword : {"[TEST] office", "[TESTLAB] luxfit", "[ISSUEDATE] 2026-01-31",
                                "[MANUFAC] a room", "[LUMCAT] A", "[LUMINAIRE] luminaire A"})
      EXPECT_EQ(std::count(lines.begin(), tilt, keyword), 1) << keyword;
    for (const std::string& line : lines) {
      EXPECT_LE(line.size(), 132u);
      for (const char c : line) EXPECT_TRUE(c >= ' ' && c <= '~') << static_cast<int>(c);
    }
    std::string numbers;
    for (auto line = tilt + 1; line != lines.end(); ++line) {
      EXPECT_EQ(line->find_first_not_of("0123456789.- "), std::string::npos) << *line;
      numbers += *line + " ";
    }
    std::istringstream stream(numbers);
    const std::vector<double> values{std::istream_iterator<double>(stream), {}};
    ASSERT_GT(values.size(), 13u);
    EXPECT_THAT(std::vector<double>(values.begin(), values.begin() + 3), testing::ElementsAre(1, -1, 1));
    const auto vertical = static_cast<size_t>(values[3]), horizontal = static_cast<size_t>(values[4]);
    EXPECT_EQ(values[5], 1);  // type C
    EXPECT_EQ(values[6], 2);  // metres
    EXPECT_THAT(std::vector<double>(values.begin() + 10, values.begin() + 13), testing::ElementsAre(1, 1, 0));
    ASSERT_EQ(values.size(), 13 + vertical + horizontal + vertical * horizontal) << NameOf(lamp);
    EXPECT_EQ(values[13], 0);
    const double last = values[12 + vertical];
    EXPECT_EQ(last,
              lamp.distribution == Distribution::kIsotropic || lamp.distribution == Distribution::kMeasured
                  ? 180
                  : 90);
    EXPECT_EQ(values[13 + vertical], 0);
    EXPECT_EQ(values[12 + vertical + horizontal], lamp.distribution == Distribution::kMeasured ? 360 : 0);
  }
}

TEST(PhotometryWriter, LdtIsWhatEulumdatAsksFor) {
  for (const Luminaire& lamp : AllLamps()) {
    const std::vector<std::string> lines = Lines(WritePhotometry(lamp, kLabels).ldt);
    ASSERT_GT(lines.size(), 42u);
    const auto number = [&lines](size_t line) { return std::stod(lines[line - 1]); };  // lines count from 1
    const bool is_measured = lamp.distribution == Distribution::kMeasured;
    EXPECT_EQ(number(2), is_measured ? 3 : 1);
    EXPECT_EQ(number(3), is_measured ? 0 : 1);
    const auto planes = static_cast<size_t>(number(4)), gammas = static_cast<size_t>(number(6));
    EXPECT_EQ(planes, is_measured ? 12u : 1u);
    const size_t first_c = 42, first_gamma = first_c + planes, first_cd = first_gamma + gammas;
    EXPECT_EQ(lines.size(), first_cd + (is_measured ? planes : 1) * gammas);
    EXPECT_EQ(std::stod(lines[first_gamma]), 0);
    if (number(7) > 0) {
      for (size_t i = 0; i < gammas; ++i)
        EXPECT_NEAR(std::stod(lines[first_gamma + i]), static_cast<double>(i) * number(7), 1e-9);
    }
    EXPECT_NEAR(number(22),
                lamp.distribution == Distribution::kIsotropic ? 50
                : is_measured                                 ? number(22)
                                                              : 100,
                0.05);
    EXPECT_EQ(number(23), 100);
    EXPECT_EQ(number(24), 1);
    EXPECT_EQ(number(26), 1);
    EXPECT_EQ(number(27), -1);  // absolute photometry
    EXPECT_NEAR(number(29), kFluxLm, 1e-9);
    for (size_t k = 34; k <= 42; ++k)
      EXPECT_GE(number(k), number(k - 1));  // direct ratios rise with the room
    EXPECT_LE(number(42), 1);
    for (size_t i = 0; i < lines.size(); ++i) {
      EXPECT_LE(lines[i].size(), i < 12 ? 78u : 24u);
      if (i < first_gamma) continue;
      // Beyond 1e6 cd per 1000 lm, six characters cannot hold the peak.
      EXPECT_LE(lines[i].size(), lamp.cosine_exponent > 5000 ? 8u : 6u) << lines[i];
      EXPECT_EQ(lines[i].find_first_not_of("0123456789."), std::string::npos) << lines[i];
    }
  }
}

TEST(PhotometryWriter, StepsAreEvenWhereTheyCanBe) {
  const auto angles = [](const Luminaire& lamp) { return TabulatedPhotometry(lamp).table.gamma_rad.size(); };
  EXPECT_EQ(angles(Lamp(Distribution::kIsotropic)), 73u);
  EXPECT_EQ(angles(Lamp(Distribution::kLambertian)), 37u);
  EXPECT_EQ(angles(Lamp(Distribution::kCosinePower, 8)), 91u);
  EXPECT_EQ(angles(Lamp(Distribution::kCosinePower, 100)), 181u);
  EXPECT_LT(angles(Lamp(Distribution::kCosinePower, 1e4)), 500u);
}

TEST(PhotometryWriter, TablesAreCompletedToTheHorizontalOrTheZenith) {
  const auto table = [](const std::vector<double>& gamma_deg) {
    std::vector<double> gamma_rad;
    for (const double g : gamma_deg) gamma_rad.push_back(g * kPi / 180);
    return std::make_shared<IntensityTable>(Normalized(ExpandPlanes(
        {0}, gamma_rad, std::vector<double>(gamma_rad.size(), 2.0), PlaneSymmetry::kRotational)));
  };
  Luminaire lamp = Lamp(Distribution::kMeasured);
  for (const std::vector<double>& gamma :
       {std::vector<double>{0, 40, 80}, std::vector<double>{95, 120, 150}, std::vector<double>{0, 89.995}}) {
    lamp.table = table(gamma);
    const IesFile file = ParseIes(WritePhotometry(lamp, kLabels).ies, "a.ies");
    EXPECT_EQ(file.vertical_deg.front(), 0);
    EXPECT_EQ(file.vertical_deg.back(), gamma.back() > 90 ? 180 : 90);
    const PhotometryFile read = PhotometryOf(file);
    EXPECT_NEAR(read.luminaire_flux_lm, kFluxLm, 1e-4 * kFluxLm);
    for (const double g : {20.0, 60.0, 85.0, 110.0, 140.0, 160.0}) {
      EXPECT_NEAR(read.luminaire_flux_lm * IntensityTowards(read.table, Direction(10, g)).cd_per_lm,
                  TrueCd(lamp, Direction(10, g)), kTolerance * lamp.table->peak_cd_per_lm * kFluxLm)
          << g;
    }
  }
}

TEST(PhotometryWriter, LabelsStayOnTheirLine) {
  PhotometryLabels labels = kLabels;
  labels.catalogue_number = "Leuchte \xc3\xbc\xe2\x82\xac\r\nTILT=INCLUDE";
  labels.luminaire = std::string(500, 'x');
  const PhotometryTexts texts = WritePhotometry(Lamp(Distribution::kLambertian), labels);
  const IesFile ies = ParseIes(texts.ies, "a.ies");
  EXPECT_EQ(ies.keywords[4].text, "Leuchte ??  TILT=INCLUDE");
  EXPECT_EQ(ies.tilt.source, "NONE");
  for (const std::string& line : Lines(texts.ies)) EXPECT_LE(line.size(), 132u);
  const LdtFile ldt = ParseLdt(texts.ldt, "a.ldt");
  EXPECT_EQ(ldt.number, "Leuchte ??  TILT=INCLUDE");
  EXPECT_EQ(ldt.file, "Leuchte ");
}

TEST(PhotometryWriter, RefusesWhatIsNoLight) {
  Luminaire lamp = Lamp(Distribution::kLambertian);
  for (const double flux : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    lamp.flux_lm = flux;
    EXPECT_THROW(WritePhotometry(lamp, kLabels), std::invalid_argument) << flux;
  }
  EXPECT_THROW(TabulatedPhotometry(Lamp(Distribution::kCosinePower, 0)), std::invalid_argument);
  lamp = Lamp(Distribution::kMeasured);
  lamp.table = nullptr;
  EXPECT_THROW(TabulatedPhotometry(lamp), std::invalid_argument);
}

// Files as they come: loaded, exported with their own flux, loaded again.
std::vector<std::string> FilesIn(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".ies" || extension == ".ldt") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void ExpectFilesKeepTheirLight(const std::string& folder) {
  const std::vector<std::string> files = FilesIn(folder);
  ASSERT_FALSE(files.empty());
  for (const std::string& path : files) {
    const PhotometryFile given = ReadPhotometry(path);
    Luminaire lamp = Lamp(Distribution::kMeasured);
    lamp.table = std::make_shared<IntensityTable>(given.table);
    lamp.flux_lm = given.luminaire_flux_lm;
    lamp.shape = given.shape;
    lamp.size_m = given.size_m;
    const PhotometryTexts texts = WritePhotometry(lamp, kLabels);
    const PhotometryFile ies = ParsePhotometry(texts.ies, "a.ies"), ldt = ParsePhotometry(texts.ldt, "a.ldt");
    ExpectSameLight(lamp, ies, path + " as .ies");
    ExpectSameLight(lamp, ldt, path + " as .ldt");
    EXPECT_EQ(ies.shape, given.shape) << path;
    EXPECT_LE((ies.size_m - given.size_m).cwiseAbs().maxCoeff(), 0.51e-4) << path;
  }
}

TEST(PhotometryWriter, MakersFilesKeepTheirLight) {
  ExpectFilesKeepTheirLight(std::string(LUXFIT_FIXTURES) + "/photometry");
}

TEST(PhotometryWriter, RealFilesKeepTheirLight) {
  const char* folder = std::getenv("LUXFIT_REAL_DATA");
  if (!folder) GTEST_SKIP() << "LUXFIT_REAL_DATA is not set";
  ExpectFilesKeepTheirLight(std::string(folder) + "/photometry");
}

}  // namespace
}  // namespace luxfit
