#include <algorithm>
#include <cmath>

#include "apps/export/exports.h"
#include "apps/export/false_colours.h"
#include "apps/export/value_mesh.h"
#include "apps/text/file_stem.h"
#include "apps/text/formats/artifact.h"

namespace luxfit {
namespace {

// Holds the light of the elements by state and by luminaire, with names that suit files.
std::vector<FaceValues> ValuesOf(const FittedRoom& fitted, const Eigen::VectorXd& albedo) {
  const std::string lx = fitted.is_absolute ? "lx_" : "relative_";
  const std::string cd = fitted.is_absolute ? "luminance_cd_m2_" : "luminance_relative_";
  std::vector<FaceValues> values{{"albedo", albedo}};
  const auto add = [&](const std::string& of, const Eigen::VectorXd& total, const Eigen::VectorXd& direct) {
    values.push_back({"illuminance_" + lx + of, total});
    values.push_back({"direct_" + lx + of, direct});
    values.push_back({"indirect_" + lx + of, total - direct});
    values.push_back({cd + of, albedo.cwiseProduct(total) / M_PI});
  };
  const PlaceLight& light = fitted.light->AtElements();
  std::vector<std::string> states, ids;
  for (const SessionState& state : fitted.session.states) states.push_back(state.id);
  for (const Luminaire& luminaire : fitted.luminaires) ids.push_back(luminaire.id);
  const std::vector<std::string> state_stems = DistinctFileStems(states), id_stems = DistinctFileStems(ids);
  for (size_t s = 0; s < states.size(); ++s) {
    const Eigen::VectorXd dimming = DimmingOf(fitted, states[s]);
    add(state_stems[s], light.Under(dimming), light.direct_lx * dimming);
  }
  for (size_t k = 0; k < ids.size(); ++k) {
    const Eigen::Index column = static_cast<Eigen::Index>(k);
    add("of_" + id_stems[k], light.total_lx.col(column), light.direct_lx.col(column));
  }
  return values;
}

Eigen::Matrix3Xi ColoursOf(const Eigen::VectorXd& values, const ColourScale& scale) {
  Eigen::Matrix3Xi rgb(3, values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    rgb.col(i) = FalseColour((values[i] - scale.lower) / (scale.upper - scale.lower));
  return rgb;
}

}  // namespace

ExportedFiles ExportPatches(const FittedRoom& fitted, const std::string& folder) {
  const Patches& patches = fitted.room.patches;
  ExportedFiles exported;
  if (patches.elements.empty()) {
    exported.notes.push_back("the session has no mesh: there are no patches to export");
    return exported;
  }
  Eigen::VectorXd albedo(static_cast<Eigen::Index>(patches.elements.size()));
  for (size_t e = 0; e < patches.elements.size(); ++e) {
    const Patch& patch = patches.patches[static_cast<size_t>(patches.elements[e].patch)];
    albedo[static_cast<Eigen::Index>(e)] = fitted.albedo[patch.material];
  }
  ValueMesh elements = MeshOfElements(patches, fitted.room.scene.materials);
  elements.values = ValuesOf(fitted, albedo);
  ValueMesh coarse = MeshOfPatches(patches, fitted.room.scene.materials);
  for (const FaceValues& value : elements.values)
    coarse.values.push_back({value.name, PatchMeans(patches, value.values)});
  const Eigen::VectorXd shown = fitted.light->AtElements().Under(DimmingOf(fitted, BrightestState(fitted)));
  const ColourScale scale = ScaleOf(shown.cast<float>().transpose().array(), "");
  const auto write = [&](const std::string& name, const std::string& text) {
    WriteText(folder + "/" + name, text);
    exported.files.push_back(folder + "/" + name);
  };
  write("elements.vtp", VtpText(elements));
  write("elements.ply", PlyText(elements, ColoursOf(shown, scale)));
  write("patches.vtp", VtpText(coarse));
  write("patches.ply", PlyText(coarse, ColoursOf(PatchMeans(patches, shown), scale)));
  return exported;
}

}  // namespace luxfit
