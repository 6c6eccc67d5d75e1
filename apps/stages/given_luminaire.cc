#include "apps/stages/given_luminaire.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "forward/luminaire/luminaire_parts.h"

namespace luxfit {
namespace {

// Ratios and fluxes in files are rounded to a percent; beyond this one of them is wrong.
constexpr double kFluxTolerance = 0.03;

Distribution DistributionFrom(const std::string& photometry) {
  if (photometry == "isotropic") return Distribution::kIsotropic;
  if (photometry == "lambertian") return Distribution::kLambertian;
  if (photometry == "table") return Distribution::kMeasured;
  return Distribution::kCosinePower;
}

LuminaireShape ShapeFrom(const std::string& shape) {
  if (shape == "disc") return LuminaireShape::kDisc;
  if (shape == "rectangle") return LuminaireShape::kRectangle;
  if (shape == "sphere") return LuminaireShape::kSphere;
  return LuminaireShape::kPoint;
}

// A table to be estimated starts as Lambertian, every 7.5 degrees.
std::shared_ptr<const IntensityTable> GivenTable(const SessionLuminaire& given) {
  constexpr double kRadPerDeg = M_PI / 180;
  std::vector<double> gamma_rad, intensity = given.cd_per_klm;
  for (const double gamma_deg : given.gamma_deg) gamma_rad.push_back(kRadPerDeg * gamma_deg);
  for (int j = 0; given.gamma_deg.empty() && j <= 12; ++j) {
    gamma_rad.push_back(kRadPerDeg * 7.5 * j);
    intensity.push_back(std::max(std::cos(gamma_rad.back()), 1e-3));
  }
  return std::make_shared<IntensityTable>(RotationalTable(gamma_rad, intensity));
}

}  // namespace

GivenLuminaire ReadGivenLuminaire(const SessionLuminaire& given) {
  GivenLuminaire result;
  Luminaire& luminaire = result.luminaire;
  luminaire.id = given.id;
  luminaire.flux_lm = 0;
  luminaire.distribution = DistributionFrom(given.photometry);
  if (!given.photometry_path.empty()) {
    result.file = ReadPhotometry(given.photometry_path);
    luminaire.distribution = Distribution::kMeasured;
    luminaire.table = std::make_shared<IntensityTable>(result.file->table);
    luminaire.shape = result.file->shape;
    luminaire.size_m = result.file->size_m;
    luminaire.flux_lm = result.file->luminaire_flux_lm;
  }
  if (given.photometry == "table") luminaire.table = GivenTable(given);
  if (given.shape) {
    const LuminaireShape shape = ShapeFrom(*given.shape);
    // The file's size belongs to the file's shape.
    if (shape != luminaire.shape) luminaire.size_m.setZero();
    luminaire.shape = shape;
  }
  if (!given.size_m.empty()) luminaire.size_m = {given.size_m.front(), given.size_m.back()};
  luminaire.emission = given.emission;
  if (given.cosine_exponent) luminaire.cosine_exponent = *given.cosine_exponent;
  if (given.position_m) luminaire.position = *given.position_m;
  if (given.aim) luminaire.aim = *given.aim;
  if (given.heading) luminaire.heading = *given.heading;
  if (given.flux_lm) luminaire.flux_lm = *given.flux_lm;
  return result;
}

void RecordGivenPhotometry(const GivenLuminaire& given, RunContext& context) {
  if (!given.file) return;
  const PhotometryFile& file = *given.file;
  std::string because = fmt::format("the file's intensities integrate to {:.6g} lm", file.luminaire_flux_lm);
  for (const std::string& note : file.notes) because += "; " + note;
  context.choices.push_back(
      {"photometry of " + given.luminaire.id, file.format + ", C0 along the heading", {}, because});
  const bool differs =
      file.stated_flux_lm > 0 && std::abs(file.luminaire_flux_lm / file.stated_flux_lm - 1) > kFluxTolerance;
  if (differs) {
    context.warnings.push_back(
        {"photometry_flux",
         fmt::format("the photometry of {} states {:.6g} lm, but its intensities integrate to {:.6g} lm",
                     given.luminaire.id, file.stated_flux_lm, file.luminaire_flux_lm),
         "the intensities were believed; give flux_lm, or ask the maker for a consistent file"});
  }
}

}  // namespace luxfit
