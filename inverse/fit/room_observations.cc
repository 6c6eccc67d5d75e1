#include "inverse/fit/room_observations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "inverse/fit/fit_room.h"

namespace luxfit {
namespace {

// Files round ratios and fluxes to a percent. Beyond this tolerance one of the two is wrong.
constexpr double kFluxTolerance = 0.03;

// An .ies states no light output ratio, but none is above 1. The tenth is for lumens that were rounded, or
// measured apart. Below a tenth a factor is missing, such as that of intensities per 1000 lm.
constexpr double kLeastOutputRatio = 0.1, kMostOutputRatio = 1.1;

struct LampContradiction {
  double lamp_flux_lm, ratio;
};

// Some files' factor makes intensities those of the stated lamps, others' those of lamps that much brighter:
// both are allowed.
std::optional<LampContradiction> ContradictionOfLamps(const PhotometryFile& file) {
  if (file.stated_flux_lm > 0 || !(file.lamp_flux_lm > 0)) return std::nullopt;
  const double with_factor_lm = file.lamp_flux_lm * file.factor, flux_lm = file.luminaire_flux_lm;
  const double least_lm = std::min(file.lamp_flux_lm, with_factor_lm);
  const double most_lm = std::max(file.lamp_flux_lm, with_factor_lm);
  if (flux_lm > kMostOutputRatio * most_lm) return LampContradiction{most_lm, flux_lm / most_lm};
  if (flux_lm < kLeastOutputRatio * least_lm) return LampContradiction{least_lm, flux_lm / least_lm};
  return std::nullopt;
}

std::string RemedyFor(LightNote::Of of) {
  if (of == LightNote::Of::kFlux) return "give flux_lm, or correct the file";
  if (of == LightNote::Of::kOpening) return "give shape and size_m where luminaires are near what they light";
  return "complete the file, or ask the maker for one that is whole";
}

// Warns of what changes the light, once for all luminaires that share a file.
void WarnOfLightNotes(const std::string& id, const PhotometryFile& file, Findings& findings) {
  const std::string name = std::filesystem::path(file.name).filename().string();
  for (const LightNote& note : file.light_notes) {
    const std::string message = name.empty() ? fmt::format("the photometry of {}: {}", id, note.text)
                                             : fmt::format("{}: {}", name, note.text);
    const bool is_said = std::any_of(findings.warnings.begin(), findings.warnings.end(),
                                     [&](const Warning& warning) { return warning.message == message; });
    if (is_said) continue;
    findings.warnings.push_back({"photometry_changed", message, RemedyFor(note.of)});
  }
}

}  // namespace

void RecordPhotometryFile(const std::string& id, const PhotometryFile& file, Findings& findings) {
  std::string because = fmt::format("the file's intensities integrate to {:.6g} lm", file.luminaire_flux_lm);
  for (const std::string& note : file.notes) because += "; " + note;
  findings.choices.push_back({"photometry of " + id, file.format + ", C0 along the heading", {}, because});
  WarnOfLightNotes(id, file, findings);
  if (const auto lamps = ContradictionOfLamps(file)) {
    findings.warnings.push_back(
        {"photometry_flux",
         fmt::format(
             "the intensities of the photometry of {} integrate to {:.6g} lm, {:.3g} times the {:.6g} lm of "
             "its lamps",
             id, file.luminaire_flux_lm, lamps->ratio, lamps->lamp_flux_lm),
         "the intensities were used; correct the lamps, lumens per lamp or multiplier of the file, or give "
         "flux_lm"});
  }
  const bool differs =
      file.stated_flux_lm > 0 && std::abs(file.luminaire_flux_lm / file.stated_flux_lm - 1) > kFluxTolerance;
  if (!differs) return;
  findings.warnings.push_back(
      {"photometry_flux",
       fmt::format("the photometry of {} states {:.6g} lm, but its intensities integrate to {:.6g} lm", id,
                   file.stated_flux_lm, file.luminaire_flux_lm),
       "the intensities were used; give flux_lm, or ask the maker for a consistent file"});
}

void WarnOfTilt(const Luminaire& luminaire, const PhotometryFile& file, Findings& findings) {
  if (!file.missing_tilt_file.empty()) {
    findings.warnings.push_back(
        {"photometry_tilt",
         fmt::format(
             "the photometry of {} names the TILT file {}, which was not found: its factors are left out",
             luminaire.id, file.missing_tilt_file),
         "put the file beside the .ies, or give flux_lm"});
  }
  const double factor = TiltFactor(file, luminaire.aim);
  if (factor == 1) return;
  constexpr double kDegrees = 180 / M_PI;
  findings.warnings.push_back(
      {"photometry_tilt",
       fmt::format("{} is aimed {:.3g} degrees off straight down: the TILT factor {:.4g} of its file was "
                   "applied to its "
                   "flux",
                   luminaire.id, kDegrees * std::acos(std::clamp(-luminaire.aim.z(), -1.0, 1.0)), factor),
       "nothing, where the lamp is of the kind that the file was made for; else give flux_lm"});
}

}  // namespace luxfit
