#include "inverse/fit/internal/detail_words.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace luxfit {
namespace {

// Ambient light that varies by more, 1 sigma, is worth a word.
constexpr double kAmbientChanged = 0.03;

std::vector<std::string> NamesOf(const EffectChoice& choice) {
  std::vector<std::string> names;
  names.reserve(choice.among.size());
  for (const EffectCandidate& c : choice.among) names.push_back(c.name);
  return names;
}

std::string NameOf(const LargestShift& effect) {
  if (!(effect.sigmas > 0)) return "nothing";
  return fmt::format("the {} by {:.2g} of its sigma", NameOf(effect.parameter), effect.sigmas);
}

// Says what the coarsest candidate, in those words, would move, and whether it would do.
std::string WouldMove(const EffectChoice& choice, const std::string& coarser) {
  const LargestShift& effect = choice.among.front().effect;
  return choice.chosen == 0 ? fmt::format("{} would do: it would move {}", coarser, NameOf(effect))
                            : fmt::format("{} would move {}", coarser, NameOf(effect));
}

void RecordBounces(const EffectChoice& bounces, const std::string& why_all, Findings& findings) {
  std::string effects;
  for (const EffectCandidate& c : bounces.among)
    effects += fmt::format("{}{} {:.2g}", effects.empty() ? "" : ", ", c.name, c.effect.sigmas);
  std::string fewest = "no fewer would do";
  if (bounces.chosen + 1 < bounces.among.size())
    fewest = fmt::format("{} would do and move {}", bounces.Chosen().name, NameOf(bounces.Chosen().effect));
  if (bounces.chosen > 0) {
    const EffectCandidate& fewer = bounces.among[bounces.chosen - 1];
    fewest += fmt::format("; {} would move {}", fewer.name, NameOf(fewer.effect));
  }
  findings.choices.push_back({"bounces", "all", NamesOf(bounces),
                              fmt::format("{}; {} (largest shift of a parameter in sigmas: {}; 0.1 counts)",
                                          why_all, fewest, effects)});
}

// `error`: relative, of the light by the size in use.
void RecordSize(const std::string& what, const EffectChoice& choice, double size_m, double error,
                double model_error, Findings& findings) {
  const double in_use = choice.among.back().effect.sigmas, left = kDiscretisationLeft * in_use;
  findings.choices.push_back(
      {what + " size",
       fmt::format("{:.2g} m", size_m),
       {fmt::format("{:.2g} m", 2 * size_m), fmt::format("{:.2g} m", size_m)},
       fmt::format(
           "cut before the fit; {}; the size in use errs by {:.2g}, the fit's correction leaves {:.2g} of "
           "it{} (of the light {:.2g} %, the fit's other errors are {:.2g} %)",
           WouldMove(choice, "twice the size"), in_use, left,
           left > kWorthSigmas ? ", more than 0.1: a smaller size would change the answer" : "", 100 * error,
           100 * model_error)});
}

void RecordRows(const EffectChoice& rows, const TakenRows& taken, Findings& findings) {
  const int fitted = taken.elements;
  std::vector<std::string> among = {std::to_string((fitted + 1) / 2), std::to_string(fitted)};
  std::string because = "all that photos show";
  if (!taken.doublings.empty()) {
    because = fmt::format("taken evenly of {} that photos show", taken.observed_elements);
    among.clear();
    for (const RowDoubling& d : taken.doublings) {
      among.push_back(std::to_string(d.elements));
      because += fmt::format("; twice {} would move {}", d.elements, NameOf(d.effect));
    }
    among.push_back(std::to_string(taken.observed_elements));
  }
  findings.choices.push_back({"elements fitted", std::to_string(fitted), among,
                              fmt::format("{}; {}", because, WouldMove(rows, "half of them"))});
}

}  // namespace

void RecordDetail(const SceneDetail& detail, const TakenRows& taken, Findings& findings) {
  const std::string why_all = "the radiosity system is factored once: every bounce costs the same as one";
  if (!detail.is_compared) {
    findings.choices.push_back({"bounces", "all", {}, why_all});
    return;
  }
  RecordBounces(detail.bounces, why_all, findings);
  RecordSize("patch", detail.patches, detail.patch_size_m, detail.patch_error, detail.model_error, findings);
  RecordSize("element", detail.elements, detail.element_size_m, detail.element_error, detail.model_error,
             findings);
  RecordRows(detail.rows, taken, findings);
  if (detail.IsFineEnough()) return;
  findings.warnings.push_back(
      {"elements_too_coarse",
       fmt::format(
           "patches of {:.2g} m err by {:.2g} % of the light, elements of {:.2g} m by {:.2g} %: more than "
           "the {:.2g} % by which the fit misses its data otherwise",
           detail.patch_size_m, 100 * detail.patch_error, detail.element_size_m, 100 * detail.element_error,
           100 * detail.model_error),
       "luxfit chart SESSION --fit shows how far results move with finer ones; leave out photos of surfaces "
       "close to a luminaire"});
}

void RecordAmbientLeft(const AmbientLeft& left, double spread, Findings& findings) {
  if (left.states.empty()) return;
  findings.choices.push_back(
      {"ambient light in the fit",
       left.IsNeeded() ? fmt::format("a share for each of {} states", left.states.size()) : "as subtracted",
       {"as subtracted", "a share for each state"},
       fmt::format("of what was subtracted from the photos of a state, {:.1f} to {:.1f} % are left, with "
                   "sigmas up to {:.1f} %: "
                   "{} (chi2 {:.3g}, 95 % of {:.3g})",
                   100 * left.share.minCoeff(), 100 * left.share.maxCoeff(), 100 * left.sigma.maxCoeff(),
                   left.IsNeeded() ? "more than chance makes" : "not told from none", left.chi2,
                   left.chi2_95)});
  const double all = std::hypot(left.Spread(), spread);
  if (all < kAmbientChanged) return;
  findings.warnings.push_back(
      {"ambient_changed",
       fmt::format("ambient light changed while photos were taken: views show that it varied by {:.0f} %, "
                   "and of what was subtracted from "
                   "the photos of a state, {:.0f} to {:.0f} % are left. The fit allows for both; the ambient "
                   "part of each reading counts as "
                   "uncertain by {:.0f} %",
                   100 * spread, 100 * left.share.minCoeff(), 100 * left.share.maxCoeff(), 100 * all),
       "take photos and readings with all luminaires off right beside the others of their view or place, or "
       "wait until it is dark"});
}

}  // namespace luxfit
