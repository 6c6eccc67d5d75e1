#include "inverse/fit/internal/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "forward/luminaire/distribution_ops.h"
#include "inverse/model/internal/light_model.h"

namespace luxfit {
namespace {

std::string NameOf(RefinementKind kind) {
  switch (kind) {
    case RefinementKind::kHeading:
      return "heading";
    case RefinementKind::kAim:
      return "aim";
    case RefinementKind::kTable:
      return "table of intensities";
    case RefinementKind::kEmission:
      return "emission over the opening";
  }
  return "";
}

std::string NameOf(const Eigen::Vector3d& aim) {
  if (aim.isApprox(Eigen::Vector3d(0, 0, -1))) return "straight down";
  return fmt::format("towards ({:.2f}, {:.2f}, {:.2f})", aim.x(), aim.y(), aim.z());
}

std::string ScoresOf(const DetailChoice& choice) {
  std::string scores;
  for (const DetailCandidate& c : choice.among)
    scores += fmt::format("{}{} {:.3f}", scores.empty() ? "" : ", ", c.name, c.score);
  return scores;
}

std::vector<std::string> NamesOf(const DetailChoice& choice) {
  std::vector<std::string> names;
  names.reserve(choice.among.size());
  for (const DetailCandidate& c : choice.among) names.push_back(c.name);
  return names;
}

struct NeedlessWords {
  std::string what, simplest, fitted;
};

NeedlessWords WordsOf(const NeedlessParameter& n) {
  constexpr double kDegrees = 180 / M_PI;
  const std::string angle = fmt::format("{:.2f} ± {:.2f} degrees", kDegrees * n.fitted, kDegrees * n.sigma);
  switch (n.kind) {
    case NeedlessKind::kExponent:
      return {"cosine exponent of ", "1 (lambertian)", fmt::format("{:.3f} ± {:.3f}", n.fitted, n.sigma)};
    case NeedlessKind::kSize:
      return {"size of ", "none (point)", fmt::format("{:.2f} ± {:.2f} m", n.fitted, n.sigma)};
    case NeedlessKind::kTilt:
      return {"tilt of ", "none", angle};
    case NeedlessKind::kHeading:
      break;
  }
  return {"turn of ", "none", angle};
}

void WarnOfUnknownFluxes(const RoomFit& result, Findings& findings) {
  if (!result.fit.IsUsable() || !result.absolute || !result.TellsDirectLight() || result.stopped) return;
  std::vector<std::string> ids;
  for (size_t k = 0; k < result.luminaire_found.size(); ++k)
    if (result.luminaire_found[k] && !IsFluxKnown(result, k))
      ids.push_back(result.fit.state.luminaires[k].id);
  if (ids.empty()) return;
  findings.AddUndetermined(
      {"flux_undetermined",
       fmt::format(
           "the flux of {} is known no better than to a factor of e: most of the light may fall where "
           "nothing was observed",
           fmt::join(ids, ", ")),
       "photograph what it lights, or give its photometry"});
}

}  // namespace

void WarnOfInterchangeable(const RoomObservations& given, const std::vector<int>& group, Findings& findings) {
  std::vector<std::string> ids;
  for (const int k : group) {
    const KnownLuminaire& known = given.luminaires[static_cast<size_t>(k)];
    if (!known.position_m && given.luminaires_are_named) ids.push_back(known.luminaire.id);
  }
  if (ids.size() < 2) return;
  findings.warnings.push_back(
      {"luminaires_interchangeable",
       fmt::format(
           "luminaires {} are always on together: their places are found, but not which is at which; they "
           "are given in the order of x, and of y in a column",
           fmt::join(ids, ", ")),
       fmt::format("photograph {} without the others, or give position_m", ids.front())});
}

void RecordFirstGuess(const RoomObservations& given, const FirstGuess& guess,
                      const std::vector<SeenPlace>& seen, Findings& findings) {
  const std::vector<std::string> among = {"seen in photos", "search over places"};
  for (size_t k = 0; k < guess.luminaires.size(); ++k) {
    const LuminaireGuess& luminaire = guess.luminaires[k];
    if (!luminaire.found || luminaire.seen_candidates == 0) continue;
    const std::string explains = fmt::format("leaves {:.1f} % of the direct light unexplained (rms)",
                                             100 * luminaire.relative_residual);
    const std::string what = "first guess of " + given.luminaires[k].luminaire.id;
    if (!luminaire.seen) {
      findings.choices.push_back(
          {what, among[1], among,
           fmt::format("none of the {} bright places in the photos explains its light as well as the place "
                       "found, which {}",
                       luminaire.seen_candidates, explains)});
      continue;
    }
    const SeenPlace& place = seen[static_cast<size_t>(*luminaire.seen)];
    const std::string area = std::isfinite(place.area_m2)
                                 ? fmt::format(", {:.3f} m2 if it faces down", place.area_m2)
                                 : std::string();
    const std::string from = place.is_at_common_height ? fmt::format("{} view{} at the height of like places",
                                                                     place.views, place.views == 1 ? "" : "s")
                                                       : fmt::format("{} views", place.views);
    findings.choices.push_back(
        {what, among[0], among,
         fmt::format("bright in {} photos, triangulated from {} to {:.0f} mm{}; of {} such places it {}{}",
                     place.photos, from, 1000 * place.sigma_m, area, luminaire.seen_candidates, explains,
                     luminaire.was_searched ? "; a search anywhere gives its rivals"
                                            : ", so that no other was searched")});
  }
}

void RecordStarts(const RoomObservations& given, const StartComparison& comparison, bool is_settled,
                  Findings& findings) {
  const std::string id = given.luminaires[static_cast<size_t>(comparison.luminaire)].luminaire.id;
  const auto place = [](const Eigen::Vector3d& p) {
    return fmt::format("({:.2f}, {:.2f}, {:.2f}) m", p.x(), p.y(), p.z());
  };
  std::vector<std::string> among;
  std::string scores;
  for (size_t i = 0; i < comparison.start.size(); ++i) {
    among.push_back(place(comparison.start[i]));
    scores += fmt::format("{}{} +- {:.3f} ends at {}", i == 0 ? "" : ", ",
                          fmt::format("{:.3f}", comparison.score[i]), comparison.standard_error[i],
                          place(comparison.end[i].position));
  }
  const auto chosen = static_cast<size_t>(comparison.chosen);
  findings.choices.push_back(
      {"start of " + id, among[chosen], among,
       fmt::format(
           "the search found several places that explain its light; of {} starts {} ended within 1 cm of "
           "the one kept, which is the best on patches left out, or the first within one standard error "
           "of it (mean squared normalised error: {})",
           among.size(), comparison.agreeing, scores)});
  if (comparison.rivals.empty()) return;
  std::string others;
  for (const int rival : comparison.rivals)
    others += (others.empty() ? "" : " or ") + place(comparison.end[static_cast<size_t>(rival)].position);
  findings.warnings.push_back(
      {"starts_disagree",
       fmt::format("luminaire {} may hang at {} as well as at {}: both explain its light equally, within one "
                   "standard error; the latter was kept",
                   id, others, place(comparison.end[chosen].position)),
       fmt::format("give position_m of {} roughly, with position_sigma_m, or measure where the two differ: "
                   "surfaces close to each, or photos in which {} itself shows",
                   id, id),
       !is_settled});
}

void RecordChoice(const RoomObservations& given, const LuminaireChoice& choice, Findings& findings) {
  std::string scores;
  for (size_t i = 0; i < choice.among.size(); ++i) {
    scores += fmt::format("{}{} {:.3f}", i == 0 ? "" : ", ", choice.among[i], choice.score[i]);
  }
  const size_t chosen = static_cast<size_t>(choice.chosen);
  findings.choices.push_back(
      {"photometry and shape of " + given.luminaires[static_cast<size_t>(choice.luminaire)].luminaire.id,
       choice.among[chosen], choice.among,
       "simplest within one standard error of the best on patches left out (mean squared normalised "
       "error: " +
           scores + ")"});
}

void WarnOfContradiction(const RoomObservations& given, const Contradiction& found, Findings& findings) {
  const KnownLuminaire& known = given.luminaires[static_cast<size_t>(found.luminaire)];
  const std::string& id = known.luminaire.id;
  const Luminaire& better = found.better;
  std::string lobe = ToString(better.distribution);
  if (OpsOf(better.distribution).has_exponent) lobe += fmt::format(" {:.2f}", better.cosine_exponent);
  findings.warnings.push_back(
      {"photometry_contradicted",
       fmt::format(
           "what is given of luminaire {} ({}{}) does not explain its light: a {} {} at ({:.2f}, {:.2f}, "
           "{:.2f}) m leaves {:.0f} % of the squared error on patches left out; position and flux fitted "
           "with what is given are not as sure as their sigmas say",
           id, known.photometry_name, known.shape_is_known ? ", " + ToString(known.luminaire.shape) : "",
           lobe, ToString(better.shape), better.position.x(), better.position.y(), better.position.z(),
           100 * found.score_better / found.score_given),
       fmt::format("check photometry, shape and aim of {}, or set photometry = \"auto\" and leave shape out",
                   id)});
}

void RecordAim(const RoomObservations& given, const AimChoice& choice, const Eigen::Vector3d& start,
               Findings& findings) {
  const std::string held = NameOf(start);
  findings.choices.push_back(
      {"aim of " + given.luminaires[static_cast<size_t>(choice.luminaire)].luminaire.id,
       choice.is_free ? "estimated" : held,
       {held, "estimated"},
       fmt::format("simplest within one standard error of the best on patches left out (mean squared "
                   "normalised error: {} {:.3f}, estimated {:.3f}, standard error of the difference "
                   "{:.3f})",
                   held, choice.score_held, choice.score_free, choice.standard_error)});
}

void RecordNeedless(const RoomObservations& given, const std::vector<NeedlessParameter>& needless,
                    Findings& findings) {
  for (const NeedlessParameter& n : needless) {
    const NeedlessWords words = WordsOf(n);
    findings.choices.push_back({words.what + given.luminaires[static_cast<size_t>(n.luminaire)].luminaire.id,
                                words.simplest,
                                {words.simplest, "estimated"},
                                words.fitted + " in the fit of all luminaires together"});
  }
}

void RecordRefinement(const RoomObservations& given, const Refinement& step, Findings& findings) {
  const std::string& id = given.luminaires[static_cast<size_t>(step.luminaire)].luminaire.id;
  std::string scores;
  for (size_t i = 0; i < step.among.size(); ++i) {
    scores += fmt::format("{}{} {:.3f}", i == 0 ? "" : ", ", step.among[i], step.score[i]);
    if (step.effective_parameters[i] > 1)
      scores += fmt::format(" ({:.1f} effective parameters)", step.effective_parameters[i]);
  }
  std::string rule = "the best";
  if (step.kind != RefinementKind::kHeading)
    rule = "the fewest effective parameters within one standard error of the best";
  if (step.kind == RefinementKind::kAim || step.kind == RefinementKind::kEmission)
    rule += ", or within a quarter of it,";
  findings.choices.push_back(
      {NameOf(step.kind) + " of " + id, step.among[static_cast<size_t>(step.chosen)], step.among,
       fmt::format("{} on what was left out (mean squared normalised error: {}; standard error of the best "
                   "one's difference from the first {:.3f})",
                   rule, scores, step.standard_error)});
}

void RecordDirectShare(const DirectShare& share, Findings& findings) {
  std::vector<std::string> among;
  std::string shares;
  for (const DirectShareCandidate& c : share.candidates) {
    among.push_back(c.name);
    shares += fmt::format("{}{} {:.3f} ± {:.3f}{}", shares.empty() ? "" : ", ", c.name, c.share, c.sigma,
                          c.is_admissible ? "" : " (does not explain the readings)");
  }
  const std::string interval =
      fmt::format("{:.2f}, 95 % interval {:.2f} to {:.2f}", share.share, share.lower, share.upper);
  findings.choices.push_back({"direct share of the readings", interval, among,
                              "over all luminaire models that explain the readings as well: " + shares});
  if (share.is_determined) return;
  findings.AddUndetermined(
      {"direct_share_undetermined",
       "the readings do not tell light that comes straight from light that comes by the walls: the direct "
       "share is " +
           interval + ", for other lobes and sizes with other reflectances explain the readings as well",
       "photograph or measure one state with a dark cloth over the walls, or one luminaire alone, or give "
       "reflectances in [scene.albedo] or the luminaires' photometry"});
}

void RecordOutcome(const RoomObservations& given, const RoomFit& result, Findings& findings) {
  const LuminaireFit& fit = result.fit;
  if (given.luminaires_are_named)
    findings.choices.push_back(
        {"number of luminaires", std::to_string(given.luminaires.size()), {}, "given by the session"});
  if (fit.status == FitStatus::kNotConverged && !result.stopped) {
    findings.AddUndetermined(
        {"not_converged", fit.message,
         "look at the residuals: a luminaire missing from [states], or a mesh that differs from the room"});
  }
  if (!fit.IsUsable()) {
    if (fit.null_directions.empty())
      findings.AddUndetermined({"parameters_undetermined", fit.message,
                                "more readings or views, one luminaire switched alone, or give what is known "
                                "of them"});
    for (const NullDirection& direction : fit.null_directions)
      findings.AddUndetermined({"parameters_undetermined", direction.meaning, direction.remedy});
  }
  WarnOfUnknownFluxes(result, findings);
  for (const ParameterId& id : fit.at_bound) {
    findings.warnings.push_back({"parameter_at_bound", NameOf(id) + " stopped at a bound of what is possible",
                                 "check the mesh around it, or give what is known of it"});
  }
}

void RecordTransportColour(const ColourChoice& choice, Findings& findings) {
  if (!choice.is_compared) return;
  const std::vector<std::string> among = {"luminance", "red, green, blue"};
  findings.choices.push_back(
      {"channels of reflected light", among[choice.is_used ? 1 : 0], among,
       fmt::format("three channels move the {} by {:.2f} of its sigma, more than any other parameter; 0.1 is "
                   "worth three solves",
                   NameOf(choice.moved_most), choice.effect_sigmas)});
}

void RecordPlaces(const RoomObservations& given, const PlacesChoice& choice, Findings& findings) {
  std::vector<std::string> ids;
  ids.reserve(choice.luminaires.size());
  for (const int k : choice.luminaires) ids.push_back(given.luminaires[static_cast<size_t>(k)].luminaire.id);
  const std::vector<std::string> among = {"found by the light", "seen in photos"};
  findings.choices.push_back(
      {fmt::format("places of {}", fmt::join(ids, ", ")), among[choice.is_seen ? 1 : 0], among,
       fmt::format("models of the type from either start; the better on patches left out (mean squared "
                   "normalised error: {} {:.3f}, {} {:.3f})",
                   among[0], choice.score_found, among[1], choice.score_seen)});
}

void RecordTypes(const TypedState& typed, Findings& findings) {
  const auto id = [&](int k) { return typed.state.luminaires[static_cast<size_t>(k)].id; };
  for (const std::vector<int>& type : TypesOf(typed.state)) {
    if (type.size() < 2) continue;
    std::vector<std::string> ids;
    ids.reserve(type.size());
    for (const int k : type) ids.push_back(id(k));
    std::string why;
    for (const MergedTypes& merged : typed.merged) {
      if (merged.into == type.front())
        why += fmt::format("; the fit does not tell {} from {} (chi2 {:.1f} of {})", id(merged.merged),
                           id(merged.into), merged.chi2, merged.parameters);
    }
    const bool is_turned_alike =
        std::count(typed.turned_alike.begin(), typed.turned_alike.end(), type.front()) > 0;
    if (is_turned_alike) why += "; the fit does not tell their aims from one common aim";
    const bool has_own_aims = typed.state.free[static_cast<size_t>(type.front())].own_direction;
    findings.choices.push_back(
        {"type of " + ids.front(),
         fmt::format("shared by {}", fmt::join(ids, ", ")),
         {"each its own", "shared"},
         fmt::format("luminaires that are always on together are taken as alike, but for {}{}",
                     has_own_aims ? "place, aim and flux" : "place and flux", why)});
  }
}

void WarnOfDeviatingFluxes(const LightState& state, const std::vector<LuminaireType>& types,
                           Findings& findings) {
  for (const LuminaireType& type : types) {
    for (const DeviatingFlux& flux : type.deviating)
      findings.warnings.push_back(
          {"flux_deviates",
           fmt::format("{} gives {:.0f} % of the flux of its type (median of {}, spread {:.1f} %, z {:+.1f})",
                       state.luminaires[static_cast<size_t>(flux.luminaire)].id, 100 * flux.ratio,
                       type.luminaires.size(), 100 * type.relative_spread, flux.z),
           "look at its lamp, driver and cover; if it is dimmed, say so in [states]"});
  }
}

void WarnOfOddLuminaires(const LightState& state, const std::vector<OddLuminaire>& odd, Findings& findings) {
  const auto id = [&](int luminaire) { return state.luminaires[static_cast<size_t>(luminaire)].id; };
  for (const OddLuminaire& o : odd) {
    std::string fellows;
    for (const int k : o.fellows) fellows += (fellows.empty() ? "" : ", ") + id(k);
    findings.AddUndetermined(
        {"luminaire_unlike_others",
         o.is_left_over
             ? fmt::format(
                   "{} gives {:.1f} % of the light of {}, which are always on together with it: another may "
                   "stand for two, and this one is left over",
                   id(o.luminaire), 100 * o.flux_ratio, fellows)
             : fmt::format("{} has {:.0f} times the area of {}, which are always on together with it: it may "
                           "stand for "
                           "several of them",
                           id(o.luminaire), o.area_ratio, fellows),
         fmt::format(
             "photograph {} without the others, give position_m roughly with position_sigma_m, or show "
             "it in more views",
             id(o.luminaire))});
  }
}

void WarnOfOversizedLuminaires(const LightState& state, const std::vector<OversizedLuminaire>& oversized,
                               Findings& findings) {
  for (const OversizedLuminaire& o : oversized) {
    const std::string& id = state.luminaires[static_cast<size_t>(o.luminaire)].id;
    findings.AddUndetermined(
        {"luminaire_unlike_photos",
         fmt::format("{} has {:.2g} m2, {:.0f} times the area that photos of it show ({:.2g} m2): the fit "
                     "probably ended at a wrong place",
                     id, o.area_m2, o.area_m2 / o.shown_m2, o.shown_m2),
         fmt::format("give size_m of {}, or photograph it from more views and with less noise", id)});
  }
}

void RecordBodies(const BodyChoice& choice, Findings& findings) {
  if (choice.presence.among.empty()) return;
  findings.choices.push_back(
      {"luminaire bodies", choice.presence.Chosen().name, NamesOf(choice.presence),
       fmt::format(
           "they hide what is behind them and reflect {:g} +- {:g}; better on patches left out, or as "
           "good within a tenth (mean squared normalised error: {})",
           kBodyAlbedo, kBodyAlbedoSigma, ScoresOf(choice.presence))});
}

void RecordColours(const RoomObservations& given, const Room& room, const ColourDetail& colours,
                   Findings& findings) {
  std::string coloured, grey;
  for (size_t m = 0; m < colours.materials.size(); ++m) {
    const DetailChoice& choice = colours.materials[m];
    if (choice.among.empty()) continue;
    std::string& list = choice.chosen == 0 ? grey : coloured;
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", room.scene.materials[m], ScoresOf(choice));
  }
  if (coloured.empty() && grey.empty()) {
    findings.choices.push_back({"colour",
                                "luminance",
                                {"luminance", "rgb"},
                                "readings and fluxes are photometric; no photo tells a material's colour"});
    return;
  }
  findings.choices.push_back(
      {"colour",
       coloured.empty() ? "luminance" : "rgb",
       {"luminance", "rgb"},
       fmt::format(
           "readings and fluxes are photometric, reflectances by channel follow from them; coloured on "
           "patches left out (mean squared normalised error): {}; grey, and given as such: {}",
           coloured.empty() ? "none" : coloured, grey.empty() ? "none" : grey)});
  if (colours.luminaires.among.empty()) return;
  std::string tints;
  for (Eigen::Index k = 0; k < colours.tint.cols(); ++k) {
    if (colours.tint.col(k).allFinite())
      tints += fmt::format("; {} {:.3f} {:.3f} {:.3f}", given.luminaires[static_cast<size_t>(k)].luminaire.id,
                           colours.tint(0, k), colours.tint(1, k), colours.tint(2, k));
  }
  findings.choices.push_back(
      {"colour of the luminaires", colours.luminaires.Chosen().name, NamesOf(colours.luminaires),
       fmt::format(
           "the simplest within one standard error of the best on patches left out (mean squared normalised "
           "error: {}); red, green and blue of their light against the mean{}{}",
           ScoresOf(colours.luminaires), tints,
           colours.luminaires.chosen == 0 ? "" : "; albedo_rgb is that in their mean light")});
}

}  // namespace luxfit
