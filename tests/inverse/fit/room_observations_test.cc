#include "inverse/fit/room_observations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inverse/fit/fit_room.h"
#include "tests/support/forward/photometry_text.h"

namespace luxfit {
namespace {

using support::kLdt;
using support::Replaced;
using testing::AllOf;
using testing::HasSubstr;

Findings FindingsOn(const std::string& text, const std::string& name) {
  Findings findings;
  RecordPhotometryFile("A", ParsePhotometry(text, name), findings);
  return findings;
}

std::string FluxWarning(const std::string& text, const std::string& name) {
  const Findings findings = FindingsOn(text, name);
  if (findings.warnings.empty()) return "";
  EXPECT_EQ(findings.warnings.size(), 1u);
  EXPECT_EQ(findings.warnings[0].code, "photometry_flux");
  return findings.warnings[0].message;
}

// An .ies of lamps of 1000 lm whose intensities, times `factor`, integrate to `flux_lm`.
std::string Ies(double flux_lm, const std::string& lamps, const std::string& factor) {
  // The same in every direction of the lower half: 2 pi lm per cd.
  const std::string text =
      "IESNA:LM-63-2002\nTILT=NONE\n" + lamps + " " + factor + " 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n";
  const double cd = flux_lm / (2 * 3.14159265358979) / std::stod(factor);
  return text + std::to_string(cd) + " " + std::to_string(cd) + "\n";
}

TEST(RecordPhotometryFile, WarnsOfAnIesThatGivesMoreThanItsLamps) {
  EXPECT_EQ(FluxWarning(Ies(800, "1 1000", "1"), "a.ies"), "");
  EXPECT_EQ(FluxWarning(Ies(1090, "1 1000", "1"), "a.ies"), "");
  EXPECT_THAT(FluxWarning(Ies(1110, "1 1000", "1"), "a.ies"), HasSubstr("1110 lm, 1.11 times the 1000 lm"));
  EXPECT_THAT(FluxWarning(Ies(3000, "1 1000", "1"), "a.ies"),
              HasSubstr("the photometry of A integrate to 3000 lm, 3 times the 1000 lm of its lamps"));
  EXPECT_EQ(FluxWarning(Ies(3000, "4 1000", "1"), "a.ies"), "");
  EXPECT_EQ(FluxWarning(Ies(3000, "1 -1", "1"), "a.ies"), "");  // absolute
}

TEST(RecordPhotometryFile, WarnsOfAnIesThatGivesNextToNothingOfItsLamps) {
  EXPECT_EQ(FluxWarning(Ies(2200, "1 20000", "1"), "a.ies"), "");
  EXPECT_THAT(FluxWarning(Ies(800, "1 20000", "1"), "a.ies"), HasSubstr("800 lm, 0.04 times the 20000 lm"));
}

// 20 times the intensities per 1000 lm, or lamps twice as bright as stated.
TEST(RecordPhotometryFile, AMultiplierOfAnIesMayBelongToTheLampsOrNot) {
  EXPECT_EQ(FluxWarning(Ies(16000, "1 20000", "20"), "a.ies"), "");
  EXPECT_EQ(FluxWarning(Ies(1600, "1 1000", "2"), "a.ies"), "");
  EXPECT_EQ(FluxWarning(Ies(40, "1 1000", "0.05"), "a.ies"), "");
  EXPECT_EQ(FluxWarning(Ies(800, "1 1000", "0.05"), "a.ies"), "");
  EXPECT_THAT(FluxWarning(Ies(3000, "1 1000", "2"), "a.ies"), HasSubstr("1.5 times the 2000 lm"));
}

TEST(RecordPhotometryFile, WarnsOfAnLdtThatIsNotAsStated) {
  const PhotometryFile file = ParsePhotometry(kLdt, "a.ldt");
  const double percent = 100 * file.luminaire_flux_lm / file.lamp_flux_lm;
  const auto with_ratio = [](double output_percent) {
    return Replaced(kLdt, "\n80\n1.5\n", "\n" + std::to_string(output_percent) + "\n1.5\n");
  };
  EXPECT_EQ(FluxWarning(with_ratio(1.02 * percent), "a.ldt"), "");
  EXPECT_THAT(FluxWarning(with_ratio(1.05 * percent), "a.ldt"), HasSubstr("states"));
}

// Notes that change the light are warnings, once for a file. Notes on how the text was read are none.
TEST(RecordPhotometryFile, WarnsOfNotesThatChangeTheLight) {
  const auto of_notes = [](const Findings& findings) {
    std::vector<Warning> warnings;
    for (const Warning& w : findings.warnings) {
      if (w.code == "photometry_changed") warnings.push_back(w);  // the file contradicts its flux, too
    }
    return warnings;
  };
  EXPECT_THAT(of_notes(FindingsOn(Replaced(kLdt, "\n220\n", "\n220,5\n"), "a.ldt")), testing::IsEmpty());
  const PhotometryFile file = ParsePhotometry(std::string(kLdt) + "1\n2\n", "from/maker.ldt");
  Findings findings;
  for (const char* id : {"A", "B"}) RecordPhotometryFile(id, file, findings);
  const std::vector<Warning> warnings = of_notes(findings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0].message,
              testing::StartsWith("maker.ldt: 2 numbers after the last intensity not read"));
  EXPECT_FALSE(warnings[0].is_of_outcome);
}

TEST(RecordPhotometryFile, WarnsOfAMissingBallastLineAndOfAnOpeningThatWasRounded) {
  const std::string whole = Ies(800, "1 1000", "1");
  EXPECT_THAT(FindingsOn(whole, "a.ies").warnings, testing::IsEmpty());
  const std::vector<Warning> of_ballast = FindingsOn(Replaced(whole, "1 1 10\n", ""), "a.ies").warnings;
  ASSERT_EQ(of_ballast.size(), 1u);
  EXPECT_THAT(of_ballast[0].message, HasSubstr("ballast factor and watts is missing"));
  EXPECT_THAT(of_ballast[0].remedy, HasSubstr("flux_lm"));
  const std::vector<Warning> of_sides =
      FindingsOn(Replaced(whole, "2 0 0 0\n", "2 0.6 0.6 0.1\n"), "a.ies").warnings;
  ASSERT_EQ(of_sides.size(), 1u);
  EXPECT_THAT(of_sides[0].message, HasSubstr("luminous sides of the opening were left out"));
  EXPECT_THAT(of_sides[0].remedy, HasSubstr("size_m"));
}

TEST(RecordPhotometryFile, NotesOfTheReaderStandInTheChoice) {
  const Findings findings = FindingsOn(Replaced(kLdt, "\n220\n", "\n220,5\n"), "a.ldt");
  ASSERT_EQ(findings.choices.size(), 1u);
  EXPECT_THAT(findings.choices[0].because, AllOf(HasSubstr("integrate to"), HasSubstr("decimal commas")));
}

}  // namespace
}  // namespace luxfit
