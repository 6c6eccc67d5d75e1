#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "tests/support/local_tones.h"
#include "tests/validation/catalogue/catalogue_case.h"
#include "tests/validation/catalogue/session_edits.h"

namespace luxfit {
namespace {

using support::OfficeCopy;

constexpr char kGroup[] = "photometry";
constexpr double kFullScale = 65535;

bool Every(const std::string&, const std::string&) { return true; }

void Scale(const OfficeCopy& office, const std::string& of_view, const std::string& of_state, double factor) {
  EditPhotos(
      office,
      [&](const std::string& view, const std::string& state) {
        return (of_view.empty() || view == of_view) && (of_state.empty() || state == of_state);
      },
      [&](cv::Mat& counts) { counts *= factor; });
}

// Counts as a file encodes them that is no linear one (IEC 61966-2-1).
void EncodeSrgb(cv::Mat& counts) {
  counts.forEach<cv::Vec3d>([](cv::Vec3d& pixel, const int*) {
    for (int c = 0; c < 3; ++c) {
      const double v = pixel[c] / kFullScale;
      pixel[c] = kFullScale * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
    }
  });
}

void Darken(cv::Mat& counts) {
  const double x = 0.5 * counts.cols, y = 0.5 * counts.rows, r2 = x * x + y * y;
  counts.forEach<cv::Vec3d>([&](cv::Vec3d& pixel, const int* at) {
    const double d2 = std::pow(at[1] - x, 2) + std::pow(at[0] - y, 2);
    pixel *= 1 - 0.3 * d2 / r2;
  });
}

// Makes the office anew with luminaire D as daylight (tests/validation/office_variants.cc).
void AddDaylight(const OfficeCopy& office, const std::string& variant) {
  const std::string command = fmt::format("'{}' '{}' {} '{}'", LUXFIT_OFFICE_VARIANTS, support::kOfficeFolder,
                                          variant, office.Path("office"));
  if (std::system(command.c_str()) != 0) throw std::runtime_error("expected to run " + command);
}

}  // namespace

std::vector<CatalogueCase> PhotometryCases() {
  return {
      {kGroup,
       "one photo's exposure wrong by 2",
       Required::kNamed,
       {"exposure_metadata"},
       [](const OfficeCopy& office) { Scale(office, "v03", "B", 0.5); }},
      {kGroup,
       "exposures of all photos of a state wrong by 2",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) { Scale(office, "", "C", 0.5); }},
      {kGroup,
       "photos of a state 4 stops under, as stated",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) {
         Scale(office, "", "C", 1.0 / 16);
         office.ChangeRows("office/photos.csv", [](Fields& row) {
           if (row[3] == "C") row[4] = fmt::format("{}", std::stod(row[4]) / 16);
           return true;
         });
       }},
      {kGroup,
       "one photo encoded in sRGB among linear ones",
       Required::kNamed,
       {"response_not_linear", "exposure_metadata", "photos_as_if"},
       [](const OfficeCopy& office) {
         EditPhotos(
             office, [](auto& view, auto& state) { return view == "v03" && state == "B"; }, EncodeSrgb);
       }},
      {kGroup,
       "all photos encoded in sRGB",
       Required::kNamed,
       {"response_not_linear"},
       [](const OfficeCopy& office) { EditPhotos(office, Every, EncodeSrgb); }},
      {kGroup,
       "tones mapped locally",
       Required::kNamed,
       {"local_tone_mapping"},
       [](const OfficeCopy& office) {
         EditPhotos(office, Every,
                    [](cv::Mat& counts) { counts = kFullScale * support::WithLocalTones(counts); });
       }},
      {kGroup,
       "flicker of 3 %, photo by photo",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) {
         int i = 0;
         EditPhotos(office, Every, [&](cv::Mat& counts) { counts *= 1 + 0.03 * std::sin(2.4 * ++i); });
       }},
      {kGroup,
       "daylight, photographed alone",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) { AddDaylight(office, "ambient"); },
       "D"},
      {kGroup,
       "daylight that falls by 30 % from view to view",
       Required::kNamed,
       {"ambient_changed"},
       [](const OfficeCopy& office) { AddDaylight(office, "dusk"); },
       "D"},
      {kGroup,
       "daylight that falls by 30 % from state to state",
       Required::kNamed,
       {"ambient_changed"},
       [](const OfficeCopy& office) { AddDaylight(office, "dusk_by_state"); },
       "D"},
      {kGroup,
       "daylight that goes up and down by 30 %",
       Required::kNamed,
       {"ambient_changed"},
       [](const OfficeCopy& office) { AddDaylight(office, "clouds"); },
       "D"},
      {kGroup,
       "corners darker by 30 %",
       Required::kNamed,
       {"vignetting_found"},
       [](const OfficeCopy& office) { EditPhotos(office, Every, Darken); }},
      {kGroup,
       "counts cut off at a third of full scale",
       Required::kNamed,
       {"counts_cut_off"},
       [](const OfficeCopy& office) {
         EditPhotos(office, Every, [](cv::Mat& counts) { cv::min(counts, kFullScale / 3, counts); });
       }},
      {kGroup,
       "noise of 30 % of each pixel",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) {
         cv::RNG rng(1);
         EditPhotos(office, Every, [&](cv::Mat& counts) {
           cv::Mat noise(counts.size(), counts.type());
           rng.fill(noise, cv::RNG::NORMAL, 1.0, 0.3);
           counts = counts.mul(noise);
         });
       }},
      {kGroup,
       "veiling glare of 2 %",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) {
         EditPhotos(office, Every, [](cv::Mat& counts) { counts += 0.02 * cv::mean(counts); });
       }},
      {kGroup,
       "two photos of a view exchanged",
       Required::kNamed,
       {"photos_as_if"},
       [](const OfficeCopy& office) {
         ExchangeFiles(office, "office/photos/v03_A.png", "office/photos/v03_B.png");
       }},
      {kGroup,
       "one photo exchanged between views",
       Required::kNamed,
       {"photo_of_other_view"},
       [](const OfficeCopy& office) {
         ExchangeFiles(office, "office/photos/v03_A.png", "office/photos/v05_A.png");
       }},
      {kGroup,
       "a dimming value wrong",
       Required::kNamed,
       {"states_as_if"},
       [](const OfficeCopy& office) { office.Replace("office/session.toml", "A = 0.3", "A = 1.0"); }},
      {kGroup,
       "a luminaire off though the table says on",
       Required::kNamed,
       {"states_as_if"},
       [](const OfficeCopy& office) {
         office.Replace("office/session.toml", "evening = { A = 0.3, C = 1.0",
                        "evening = { A = 0.3, B = 1.0, C = 1.0");
       }},
      {kGroup,
       "a luminaire on that the table leaves out",
       Required::kNamed,
       {"states_as_if"},
       [](const OfficeCopy& office) {
         office.Replace("office/session.toml", "C = 1.0, D = 1.0 }\nevening", "C = 1.0 }\nevening");
       }},
      {kGroup,
       "two states exchanged in the table",
       Required::kNamed,
       {"states_as_if"},
       [](const OfficeCopy& office) {
         office.Replace("office/session.toml", "A = { A = 1.0 }", "A = { B = 1.0 }");
         office.Replace("office/session.toml", "\nB = { B = 1.0 }", "\nB = { A = 1.0 }");
       }},
  };
}

}  // namespace luxfit
