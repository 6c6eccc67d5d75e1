#include "apps/stages/simulate/given_luminaire.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/luminaire_parts.h"

namespace luxfit {
namespace {

// Returns the distribution to start from: a cosine-power lobe where it is open or comes from a file.
Distribution DistributionFrom(const std::string& photometry) {
  const DistributionOps* const known = FindDistribution(photometry);
  return known != nullptr ? known->distribution : Distribution::kCosinePower;
}

LuminaireShape ShapeFrom(const std::string& shape) {
  if (shape == "disc") return LuminaireShape::kDisc;
  if (shape == "rectangle") return LuminaireShape::kRectangle;
  if (shape == "sphere") return LuminaireShape::kSphere;
  return LuminaireShape::kPoint;
}

std::shared_ptr<const IntensityTable> GivenTable(const SessionLuminaire& given) {
  std::vector<double> gamma_rad;
  for (const double gamma_deg : given.gamma_deg) gamma_rad.push_back(M_PI / 180 * gamma_deg);
  return std::make_shared<IntensityTable>(RotationalTable(gamma_rad, given.cd_per_klm));
}

// Drops the notes on what the session gives itself.
void DropNotesOnGiven(const SessionLuminaire& given, PhotometryFile& file) {
  const auto is_given = [&](const LightNote& note) {
    if (note.of == LightNote::Of::kFlux) return given.flux_lm.has_value();
    return note.of == LightNote::Of::kOpening && given.shape &&
           (*given.shape == "point" || !given.size_m.empty());
  };
  std::vector<LightNote>& notes = file.light_notes;
  notes.erase(std::remove_if(notes.begin(), notes.end(), is_given), notes.end());
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
    DropNotesOnGiven(given, *result.file);
    luminaire.distribution = Distribution::kMeasured;
    luminaire.table = std::make_shared<IntensityTable>(result.file->table);
    luminaire.shape = result.file->shape;
    luminaire.size_m = result.file->size_m;
    luminaire.flux_lm = result.file->luminaire_flux_lm;
  }
  if (!given.gamma_deg.empty()) luminaire.table = GivenTable(given);
  if (given.shape) {
    const LuminaireShape shape = ShapeFrom(*given.shape);
    // The file's size is valid only with the file's shape.
    if (shape != luminaire.shape) luminaire.size_m.setZero();
    luminaire.shape = shape;
  }
  if (!given.size_m.empty()) luminaire.size_m = {given.size_m.front(), given.size_m.back()};
  luminaire.emission = given.emission;
  if (given.cosine_exponent) luminaire.cosine_exponent = *given.cosine_exponent;
  if (given.position_m) luminaire.position = *given.position_m;
  if (given.aim) luminaire.aim = *given.aim;
  if (given.heading) luminaire.heading = *given.heading;
  if (result.file) luminaire.flux_lm *= TiltFactor(*result.file, luminaire.aim);
  if (given.flux_lm) luminaire.flux_lm = *given.flux_lm;
  return result;
}

}  // namespace luxfit
