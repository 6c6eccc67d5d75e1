#include "inverse/fit/internal/indirect_albedo.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace luxfit {

void WarnOfIndirectAlbedo(const Room& room, const RoomFit& result, Findings& findings) {
  if (!result.IsUsable() || !result.TellsDirectLight()) return;
  const std::vector<bool> told = ToldByIndirectLight(room, result);
  for (size_t m = 0; m < told.size(); ++m) {
    const double sigma = SigmaOf(result.fit, ParameterKind::kAlbedo, static_cast<int>(m));
    if (!told[m] || !std::isfinite(sigma)) continue;
    const std::string& name = room.scene.materials[m];
    findings.warnings.push_back(
        {"albedo_by_indirect_light",
         fmt::format(
             "the reflectance of \"{}\", {:.2f} ± {:.2f}, is told only by the light that it reflects to "
             "other "
             "places: it stands for gloss, texture and geometry that the model lacks, as its sigma says",
             name, result.fit.state.albedo[static_cast<Eigen::Index>(m)], sigma),
         fmt::format("photograph it, add readings that face it from nearby, or give scene.albedo.{}", name)});
  }
}

}  // namespace luxfit
