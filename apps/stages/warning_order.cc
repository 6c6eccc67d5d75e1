#include "apps/stages/warning_order.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace luxfit {
namespace {

constexpr std::array<std::string_view, 26> kCauses = {"ambient_changed",
                                                      "colmap_failed",
                                                      "colmap_missing",
                                                      "counts_cut_off",
                                                      "exposure_metadata",
                                                      "focal_length_off",
                                                      "furniture_found",
                                                      "furniture_moved",
                                                      "given_contradicted",
                                                      "local_tone_mapping",
                                                      "luminaire_named_once",
                                                      "luminaire_outside",
                                                      "luminance_weights_assumed",
                                                      "mesh_as_if",
                                                      "paint_found",
                                                      "photo_of_other_view",
                                                      "photos_as_if",
                                                      "reading_shaded",
                                                      "readings_as_if",
                                                      "response_not_linear",
                                                      "states_as_if",
                                                      "survey_less_accurate",
                                                      "tag_disagrees",
                                                      "tag_unknown",
                                                      "vignetting_found",
                                                      "wall_moved"};

}  // namespace

void PutCausesFirst(std::vector<Warning>& warnings) {
  std::stable_partition(warnings.begin(), warnings.end(), [](const Warning& w) {
    return std::find(kCauses.begin(), kCauses.end(), w.code) != kCauses.end();
  });
}

}  // namespace luxfit
