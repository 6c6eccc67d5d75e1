#include "apps/export/luminaire_files.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>

#include "apps/text/file_stem.h"
#include "apps/version.h"
#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/photometry_file.h"

namespace luxfit {
namespace {

// Returns what the files hold of a luminaire, which excludes its place.
bool IsInFiles(const Parameter& parameter) {
  if (parameter.kind == ParameterKind::kLogFlux) return true;
  return parameter.kind == ParameterKind::kLuminaire &&
         (parameter.quantity == LuminaireQuantity::kExponent ||
          parameter.quantity == LuminaireQuantity::kSizeAlong ||
          parameter.quantity == LuminaireQuantity::kSizeAcross ||
          parameter.quantity == LuminaireQuantity::kGammaNode ||
          parameter.quantity == LuminaireQuantity::kSide);
}

bool IsDetermined(const RoomFit& fit, size_t luminaire) {
  const LuminaireFit& solved = fit.fit;
  const bool is_solved = solved.IsUsable() || solved.covariance.size() > 0;
  if (!fit.absolute || !is_solved || !fit.TellsDirectLight() || !fit.luminaire_found[luminaire]) return false;
  const auto holds = [](const std::vector<ParameterId>& list, const Parameter& p) {
    return std::count(list.begin(), list.end(), p.id()) > 0;
  };
  return std::none_of(solved.parameters.begin(), solved.parameters.end(), [&](const Parameter& p) {
    // A flux at its bound is meaningless: the fit could not explain the light.
    const bool is_lost = p.kind == ParameterKind::kLogFlux && holds(solved.at_bound, p);
    return p.Concerns(static_cast<int>(luminaire)) && IsInFiles(p) &&
           (is_lost || holds(solved.undetermined, p));
  });
}

std::string Described(const Luminaire& luminaire) {
  std::string text = ToString(luminaire.distribution);
  if (OpsOf(luminaire.distribution).has_exponent) text += fmt::format(" {:.2f}", luminaire.cosine_exponent);
  text += ", " + ToString(luminaire.shape);
  if (luminaire.shape == LuminaireShape::kPoint) return text;
  text += fmt::format(" {:.3f}", luminaire.size_m[0]);
  if (luminaire.shape == LuminaireShape::kRectangle) text += fmt::format(" x {:.3f}", luminaire.size_m[1]);
  return text + " m";
}

PhotometryLabels LabelsOf(const Session& session, const Luminaire& luminaire,
                          const std::string& photometry_path) {
  PhotometryLabels labels;
  labels.test = "session " + session.name;
  labels.laboratory = std::string("luxfit ") + kVersion;
  labels.manufacturer = "unknown";
  labels.catalogue_number = luminaire.id;
  labels.luminaire = luminaire.id + ": " + Described(luminaire);
  labels.issue_date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
  labels.remarks = {fmt::format("fitted to measurements in a room, flux {:.6g} lm", luminaire.flux_lm)};
  if (luminaire.emission.size() > 0)
    labels.remarks.push_back("the opening shines unevenly, which these files cannot say");
  if (!photometry_path.empty())
    labels.remarks.push_back("distribution of " + std::filesystem::path(photometry_path).filename().string());
  return labels;
}

}  // namespace

std::vector<LuminaireFiles> WriteLuminaireFiles(const Session& session, const RoomFit& fit,
                                                const RunContext& context) {
  const std::vector<Luminaire>& luminaires = fit.fit.state.luminaires;
  std::vector<std::string> ids;
  ids.reserve(luminaires.size());
  for (const Luminaire& luminaire : luminaires) ids.push_back(luminaire.id);
  const std::vector<std::string> stems = DistinctFileStems(ids);
  std::vector<LuminaireFiles> files(luminaires.size());
  for (size_t k = 0; k < luminaires.size(); ++k) {
    const LuminaireFiles names{"luminaires/" + stems[k] + ".ies", "luminaires/" + stems[k] + ".ldt"};
    if (!IsDetermined(fit, k)) {
      std::filesystem::remove(context.out + "/" + names.ies);
      std::filesystem::remove(context.out + "/" + names.ldt);
      continue;
    }
    const PhotometryTexts texts = WritePhotometry(
        luminaires[k], LabelsOf(session, luminaires[k], session.luminaires[k].photometry_path));
    WriteText(context.out + "/" + names.ies, texts.ies);
    WriteText(context.out + "/" + names.ldt, texts.ldt);
    files[k] = names;
  }
  return files;
}

}  // namespace luxfit
