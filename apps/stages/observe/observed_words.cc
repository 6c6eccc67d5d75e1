#include "apps/stages/observe/observed_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/stages/observe/explained_photos.h"
#include "apps/stages/observe/observed_light.h"
#include "apps/text/suggest.h"
#include "calib/photo_files/tone_mapped.h"

namespace luxfit {
namespace {

void RecordAmbient(const ObservedPhotos& observed, Findings& findings) {
  if (!observed.has_ambient) return;
  const AmbientLight& ambient = observed.ambient;
  findings.choices.push_back(
      {"ambient light",
       ambient.share.empty() ? "subtracted" : "subtracted, a share for each photo",
       {"subtracted", "subtracted, a share for each photo"},
       fmt::format("photos of a state with all luminaires off are given; what views of one place differ by "
                   "on patches left out (mean squared normalised "
                   "error): {:.3f} as subtracted, {:.3f} with a share for each photo",
                   ambient.score_of_ones, ambient.score_of_shares)});
  if (observed.views_without_ambient.empty()) return;
  findings.warnings.push_back({"ambient_missing",
                               "views " + ListNames(observed.views_without_ambient) +
                                   " have no photo with all luminaires off: of places that other views show "
                                   "so, these say how much ambient light was subtracted; the rest of "
                                   "these views was not used",
                               "photograph these views with all luminaires off too"});
}

// Returns whether photos of some camera went through local tone mapping.
bool RecordToneMapping(const std::vector<std::optional<ToneMapping>>& by_camera, const PhotoNames& names,
                       Findings& findings) {
  bool is_found = false;
  for (size_t c = 0; c < by_camera.size(); ++c) {
    if (!by_camera[c]) continue;
    const ToneMapping& mapping = *by_camera[c];
    const std::string slope =
        fmt::format("surroundings e times as bright make the same light {:.1f} +- {:.1f} % darker",
                    100 * (1 - std::exp(-mapping.strength)), 100 * mapping.sigma);
    findings.choices.push_back(
        {"local tone mapping" + (by_camera.size() > 1 ? " of " + names.cameras[c] : ""),
         mapping.IsFound() ? "found" : "none",
         {"none", "found"},
         fmt::format("{}, by {} views", slope, mapping.views)});
    if (!mapping.IsFound()) continue;
    is_found = true;
    findings.warnings.push_back(
        {"local_tone_mapping",
         fmt::format("photos of camera {} went through local tone mapping: {}; their counts do not tell "
                     "light, and fluxes "
                     "and reflectances are off beyond their sigmas",
                     names.cameras[c], slope),
         std::string(kToneMappingRemedy) + ", or take another camera", true});
  }
  return is_found;
}

void RecordVeilingGlare(const std::vector<std::optional<VeilingGlare>>& by_camera, const PhotoNames& names,
                        Findings& findings) {
  for (size_t c = 0; c < by_camera.size(); ++c) {
    if (!by_camera[c]) continue;
    const VeilingGlare& veil = *by_camera[c];
    std::string because =
        fmt::format("the lens adds {:.2f} +- {:.2f} % of a picture's mean to every pixel, by {} views",
                    100 * veil.share, 100 * veil.sigma, veil.views);
    if (veil.IsFound())
      because += fmt::format("; they differ by {:.2f} % with it and {:.2f} % without", 100 * veil.difference,
                             100 * veil.difference_without);
    findings.choices.push_back({"veiling glare" + (by_camera.size() > 1 ? " of " + names.cameras[c] : ""),
                                veil.IsFound() ? "taken out" : "none",
                                {"none", "taken out"},
                                because});
  }
}

}  // namespace

void RecordObserved(const ObservedPhotos& observed, const RoomPhotos& photos,
                    const std::vector<RegisteredView>& views, const PhotoNames& names, Findings& findings) {
  RecordAmbient(observed, findings);
  WarnOfPhotos(observed.evidence.photos_as_if, photos, views, names, findings);
  const bool is_mapped = RecordToneMapping(observed.tone_mapping, names, findings);
  RecordVeilingGlare(observed.veiling_glare, names, findings);
  WarnOfStates(observed.evidence.states_as_if, findings);
  if (!observed.radiometry) return;
  Findings radiometry;
  RecordRadiometry(*observed.radiometry, photos, names, radiometry);
  findings.choices.insert(findings.choices.end(), radiometry.choices.begin(), radiometry.choices.end());
  // Mapped tones make exposures look wrong that are not.
  if (!is_mapped)
    findings.warnings.insert(findings.warnings.end(), radiometry.warnings.begin(), radiometry.warnings.end());
}

}  // namespace luxfit
