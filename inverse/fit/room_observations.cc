#include "inverse/fit/room_observations.h"

#include <fmt/format.h>

#include <cmath>

#include "inverse/fit/fit_room.h"

namespace luxfit {
namespace {

// Files round ratios and fluxes to a percent. Beyond this tolerance one of the two is wrong.
constexpr double kFluxTolerance = 0.03;

}  // namespace

void RecordPhotometryFile(const std::string& id, const PhotometryFile& file, Findings& findings) {
  std::string because = fmt::format("the file's intensities integrate to {:.6g} lm", file.luminaire_flux_lm);
  for (const std::string& note : file.notes) because += "; " + note;
  findings.choices.push_back({"photometry of " + id, file.format + ", C0 along the heading", {}, because});
  const bool differs =
      file.stated_flux_lm > 0 && std::abs(file.luminaire_flux_lm / file.stated_flux_lm - 1) > kFluxTolerance;
  if (!differs) return;
  findings.warnings.push_back(
      {"photometry_flux",
       fmt::format("the photometry of {} states {:.6g} lm, but its intensities integrate to {:.6g} lm", id,
                   file.stated_flux_lm, file.luminaire_flux_lm),
       "the intensities were used; give flux_lm, or ask the maker for a consistent file"});
}

}  // namespace luxfit
