#include "forward/luminaire/photometry_file.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/internal/ies_file.h"
#include "forward/luminaire/internal/ldt_file.h"
#include "forward/luminaire/internal/photometry_planes.h"
#include "forward/room/one_line.h"

namespace luxfit {
namespace {

constexpr double kIntensityTolerance = 0.004;  // of the peak; the rest of 0.5 % is for scaling to the flux
constexpr double kFluxTolerance = 0.001;
constexpr double kRefinedTolerance = 0.00015;  // of the peak: chords all on one side hold the flux too
constexpr double kFinestStepDeg = 0.01;        // beyond what any goniophotometer resolves
constexpr size_t kLongestLabel = 66;           // with its keyword less than the 80 of the older LM-63
constexpr size_t kLongestFileName = 8;         // of EULUMDAT

double CdPerLm(const Luminaire& luminaire, double gamma_deg) {
  // The cosine of 90 deg is not 0 in floating point.
  return IntensityPerLumen(luminaire, gamma_deg == 90 ? 0 : std::cos(gamma_deg * M_PI / 180)).cd_per_lm;
}

// How far the chord over a cell is from the curve.
double ChordError(const Luminaire& luminaire, double from_deg, double to_deg) {
  const double low = CdPerLm(luminaire, from_deg), high = CdPerLm(luminaire, to_deg);
  double worst = 0;
  for (const double share : {0.25, 0.5, 0.75}) {
    const double on_curve = CdPerLm(luminaire, from_deg + share * (to_deg - from_deg));
    worst = std::max(worst, std::abs(low + share * (high - low) - on_curve));
  }
  return worst;
}

std::vector<double> EvenAngles(double step_deg, double last_deg) {
  std::vector<double> angles;
  for (int i = 0; i * step_deg <= last_deg; ++i) angles.push_back(i * step_deg);
  return angles;
}

IntensityTable TableAt(const Luminaire& luminaire, const std::vector<double>& gamma_deg) {
  std::vector<double> intensity;
  intensity.reserve(gamma_deg.size());
  for (const double gamma : gamma_deg) intensity.push_back(CdPerLm(luminaire, gamma));
  return ExpandPlanes({0}, RadFromDeg(gamma_deg), intensity, PlaneSymmetry::kRotational);
}

bool IsFineEnough(const Luminaire& luminaire, const std::vector<double>& gamma_deg) {
  const double peak = CdPerLm(luminaire, 0);
  for (size_t i = 1; i < gamma_deg.size(); ++i) {
    if (ChordError(luminaire, gamma_deg[i - 1], gamma_deg[i]) > kIntensityTolerance * peak) return false;
  }
  return std::abs(FluxIntegral(TableAt(luminaire, gamma_deg)) - 1) <= kFluxTolerance;
}

// Cells halved, at hundredths of a degree, until their chords follow the curve.
std::vector<double> RefinedAngles(const Luminaire& luminaire, double last_deg) {
  const double peak = CdPerLm(luminaire, 0);
  std::vector<double> angles{0}, ends = EvenAngles(1, last_deg);
  std::reverse(ends.begin(), ends.end());  // the next one is the last of the list
  ends.pop_back();
  while (!ends.empty()) {
    const double from = angles.back(), to = ends.back();
    const double middle = std::round((from + to) / 2 / kFinestStepDeg) * kFinestStepDeg;
    if (to - from > 1.5 * kFinestStepDeg && ChordError(luminaire, from, to) > kRefinedTolerance * peak) {
      ends.push_back(middle);
    } else {
      angles.push_back(to);
      ends.pop_back();
    }
  }
  return angles;
}

std::vector<double> GammaAngles(const Luminaire& luminaire) {
  const double last_deg = OpsOf(luminaire.distribution).last_gamma_deg;
  for (const double step_deg : {2.5, 1.0, 0.5}) {
    std::vector<double> angles = EvenAngles(step_deg, last_deg);
    if (IsFineEnough(luminaire, angles)) return angles;
  }
  return RefinedAngles(luminaire, last_deg);
}

// LM-63 begins at 0 and ends at 90 or 180 deg; a table is dark beyond its own angles.
IntensityTable WithWholeGamma(const IntensityTable& table) {
  const double step = kFinestStepDeg * M_PI / 180;
  const double first = table.gamma_rad.front(), last = table.gamma_rad.back();
  const double end = last <= M_PI / 2 + 1e-9 ? M_PI / 2 : M_PI;
  std::vector<double> before, after;
  if (first > 1e-9) before = {0};
  if (first > 2 * step) before.push_back(first - step);
  if (last < end - 2 * step) after.push_back(last + step);
  if (last < end - 1e-9) after.push_back(end);
  IntensityTable whole = table;
  whole.gamma_rad.insert(whole.gamma_rad.begin(), before.begin(), before.end());
  whole.gamma_rad.insert(whole.gamma_rad.end(), after.begin(), after.end());
  const size_t n = table.gamma_rad.size();
  whole.cd_per_lm.clear();
  for (size_t plane = 0; plane < table.c_rad.size(); ++plane) {
    const auto row = table.cd_per_lm.begin() + static_cast<std::ptrdiff_t>(plane * n);
    whole.cd_per_lm.insert(whole.cd_per_lm.end(), before.size(), 0);
    whole.cd_per_lm.insert(whole.cd_per_lm.end(), row, row + static_cast<std::ptrdiff_t>(n));
    whole.cd_per_lm.insert(whole.cd_per_lm.end(), after.size(), 0);
  }
  return whole;
}

// To so many digits of the largest value. EULUMDAT has six characters, which five digits and a point fill.
void RoundToDigits(int digits, std::vector<double>& values) {
  const double largest = *std::max_element(values.begin(), values.end());
  const int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(largest)));
  // Scaled by whole powers of ten, the results are the doubles nearest to decimal numbers.
  const double scale = std::pow(10, std::abs(decimals));
  for (double& v : values) v = decimals >= 0 ? std::round(v * scale) / scale : std::round(v / scale) * scale;
}

double Rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

// One line of printable ASCII.
std::string Label(const std::string& text, size_t longest = kLongestLabel) {
  std::string label;
  for (const char c : OneLine(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) == 0x80U) continue;  // a further byte of a UTF-8 character
    label += byte < 0x80 ? c : '?';
  }
  return label.substr(0, longest);
}

std::string IesOf(const PhotometryFile& photometry, const PhotometryLabels& labels) {
  IesFile file = MakeIes(photometry);
  // The first four are required in 2002.
  file.keywords = {{"TEST", Label(labels.test)},
                   {"TESTLAB", Label(labels.laboratory)},
                   {"ISSUEDATE", Label(labels.issue_date)},
                   {"MANUFAC", Label(labels.manufacturer)},
                   {"LUMCAT", Label(labels.catalogue_number)},
                   {"LUMINAIRE", Label(labels.luminaire)}};
  for (const std::string& remark : labels.remarks) file.keywords.push_back({"OTHER", Label(remark)});
  for (double* length : {&file.width, &file.length, &file.height}) *length = Rounded(*length, 1e4);
  RoundToDigits(7, file.candela);
  return IesText(file);
}

std::string LdtOf(const PhotometryFile& photometry, const PhotometryLabels& labels) {
  LdtFile file = MakeLdt(photometry);
  file.company = Label(labels.manufacturer);
  file.report = Label(labels.test);
  file.luminaire = Label(labels.luminaire);
  file.number = Label(labels.catalogue_number);
  file.file = Label(labels.catalogue_number, kLongestFileName);
  file.date = Label(labels.issue_date + " / " + labels.laboratory);
  file.lamps.front().type = "unknown";
  file.lamps.front().power = "0";  // as in .ies: not known, but a number where programs read one
  // A width of 0 would be a disc.
  for (double* length : {&file.length_mm, &file.width_mm, &file.area_length_mm, &file.area_width_mm})
    *length = *length > 0 ? std::max(1.0, std::round(*length)) : 0;
  file.downward_percent = Rounded(file.downward_percent, 10);
  for (double& ratio : file.direct_ratio) ratio = Rounded(ratio, 1000);
  RoundToDigits(5, file.cd_per_klm);
  return LdtText(file);
}

}  // namespace

PhotometryFile TabulatedPhotometry(const Luminaire& luminaire) {
  if (!(luminaire.flux_lm > 0) || !std::isfinite(luminaire.flux_lm))
    throw std::invalid_argument("TabulatedPhotometry: expected a flux above 0 lm");
  const DistributionOps& ops = OpsOf(luminaire.distribution);
  if (ops.has_exponent && ops.missing(luminaire) != nullptr)
    throw std::invalid_argument("TabulatedPhotometry: expected an exponent above 0");
  if (ops.has_table && !luminaire.table)
    throw std::invalid_argument("TabulatedPhotometry: expected a table, got none");
  PhotometryFile photometry;
  photometry.format = "IESNA:LM-63-2002";
  photometry.table = Normalized(ops.has_table ? WithWholeGamma(InLuminaireFrame(*luminaire.table))
                                              : TableAt(luminaire, GammaAngles(luminaire)));
  photometry.luminaire_flux_lm = luminaire.flux_lm;
  photometry.shape = luminaire.shape;
  const bool has_two = luminaire.shape == LuminaireShape::kRectangle;
  if (luminaire.shape != LuminaireShape::kPoint)
    photometry.size_m = {luminaire.size_m[0], has_two ? luminaire.size_m[1] : 0};
  return photometry;
}

PhotometryTexts WritePhotometry(const Luminaire& luminaire, const PhotometryLabels& labels) {
  const PhotometryFile photometry = TabulatedPhotometry(luminaire);
  return {IesOf(photometry, labels), LdtOf(photometry, labels)};
}

}  // namespace luxfit
