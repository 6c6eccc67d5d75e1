#include "inverse/fit/internal/fit_whole.h"

#include <algorithm>
#include <utility>

#include "inverse/albedo/internal/albedo_rgb.h"
#include "inverse/choose/internal/detail/ambient_left.h"
#include "inverse/choose/internal/detail/choose_bodies.h"
#include "inverse/choose/internal/detail/choose_colour.h"
#include "inverse/choose/internal/two_sides.h"
#include "inverse/fit/internal/detail_words.h"
#include "inverse/fit/internal/outlines.h"
#include "inverse/fit/internal/words.h"
#include "inverse/observe/ambient_light.h"

namespace luxfit {
namespace {

// Runs the steps in order. It is a class because each step fits to the same data.
class WholeFitter {
 public:
  WholeFitter(const Room& room, const RoomObservations& given, const WholeProblem& problem, LightData& data,
              Findings& findings)
      : room_(room), given_(given), problem_(problem), data_(data), findings_(findings) {}

  WholeFit Fit(const LightState& start) {
    LightData part = data_;
    part.observations = ThinElements(data_.observations, problem_.max_elements);
    LuminaireFit near = FitFromModels(part, WithSeenSizes(problem_.open, part.outlines, start, findings_));
    if (near.status == FitStatus::kNoData) return {std::move(near), {}};
    near = WithSeenRectangles(part, std::move(near));
    near = WithoutUnexplained(part, std::move(near));
    near = WithoutNeedless(part, std::move(near));
    near = WithOneOfLikeTypes(part, std::move(near));
    near = WithAmbientChosen(part, std::move(near));
    const ColourChoice colour =
        ChooseColour(room_, part, near, EstimateAlbedoRgb(room_, part, near), problem_.priors());
    RecordTransportColour(colour, findings_);
    const BodyChoice bodies = ChooseBodies(room_, part, colour.fit, problem_.priors());
    RecordBodies(bodies, findings_);
    FitLuminairesOptions options;
    options.on_round = problem_.on_round;
    options.start_is_near = true;
    options.has_texture = problem_.has_texture;
    options.initial_relative_sigma = bodies.relative_sigma;
    options.photo_design_effect = colour.fit.photo_design_effect;
    options.frozen = colour.fit.frozen;
    EnoughRows enough =
        FitToEnoughRows(room_, data_, bodies.state, problem_.priors(), problem_.max_elements, options);
    data_.observations = std::move(enough.observations);
    return {std::move(enough.fit), std::move(enough.taken)};
  }

 private:
  // Turns a luminaire into a point where its size has shrunk to nothing.
  LightState WithoutVanishedSizes(LightState state) {
    for (size_t k = 0; k < state.luminaires.size(); ++k) {
      Luminaire& luminaire = state.luminaires[k];
      if (!state.free[k].size || !HasVanished(luminaire)) continue;
      findings_.choices.push_back({"shape of " + luminaire.id,
                                   "point",
                                   {ToString(luminaire.shape), "point"},
                                   "its size shrank to nothing in the fit of all luminaires together"});
      luminaire.shape = LuminaireShape::kPoint;
      luminaire.size_m.setZero();
      state.free[k].size = false;
    }
    return state;
  }

  // Fits from the chosen models, each of which was fitted with the others and the indirect light held. Where that light
  // was wrong, the start is as far as a rough one: rows that disagree with it would lose their weight for good.
  LuminaireFit FitFromModels(const LightData& part, const LightState& chosen) {
    FitLuminairesOptions options = OfPart();
    options.start_is_near = true;
    LuminaireFit fit = FitLuminaires(room_, part, chosen, problem_.priors(), options);
    if (fit.relative_sigma <= options.initial_relative_sigma) return fit;
    options.start_is_near = false;
    return FitLuminaires(room_, part, chosen, problem_.priors(), options);
  }

  // Merges types that the fit does not tell apart.
  LuminaireFit WithOneOfLikeTypes(const LightData& part, LuminaireFit fit) {
    TypedState typed = WithMergedTypes(fit, problem_.open);
    RecordTypes(typed, findings_);
    if (typed.merged.empty() && typed.turned_alike.empty()) return fit;
    return FitLuminaires(room_, part, typed.state, problem_.priors(), OfPart(&fit));
  }

  // Holds ambient light as it was subtracted where the fit does not tell that some is left; else readings, too, may hold some.
  LuminaireFit WithAmbientChosen(LightData& part, LuminaireFit fit) {
    const AmbientLeft left = AmbientLeftIn(fit, kShareSigma);
    RecordAmbientLeft(left, given_.ambient_spread, findings_);
    data_.readings = part.readings = WithAmbientSpread(std::move(part.readings), left.Spread());
    if (left.states.empty() || left.IsNeeded()) return fit;
    return FitLuminaires(room_, part, WithoutAmbientLeft(fit.state), problem_.priors(), OfPart(&fit));
  }

  // Lets photos tell squares from discs where the light did not.
  LuminaireFit WithSeenRectangles(const LightData& part, LuminaireFit fit) {
    const std::optional<LightState> rectangles = WithRectangles(problem_.open, part, fit);
    if (!rectangles) return fit;
    LuminaireFit squared = FitLuminaires(room_, part, *rectangles, problem_.priors(), OfPart(&fit));
    const LightState kept = WithExplainedRectangles(part, fit, squared, findings_);
    const auto is_alike = [](const Luminaire& a, const Luminaire& b) { return a.shape == b.shape; };
    if (std::equal(kept.luminaires.begin(), kept.luminaires.end(), rectangles->luminaires.begin(), is_alike))
      return squared;
    return FitLuminaires(room_, part, kept, problem_.priors(), OfPart(&fit));
  }

  // Takes outlines that the fit does not explain out of the data, and fits again without them.
  LuminaireFit WithoutUnexplained(LightData& part, LuminaireFit fit) {
    data_.outlines = ExplainedOutlines(given_, part, fit, findings_);
    if (data_.outlines.size() == part.outlines.size()) return fit;
    part.outlines = data_.outlines;
    return FitLuminaires(room_, part, fit.state, problem_.priors(), OfPart(&fit));
  }

  // Fits again without what the fit does not tell from its simplest value. A narrow lobe and a small opening are alike:
  // where either is needless beside the other, the one without which more light is explained goes.
  LuminaireFit WithoutNeedless(const LightData& part, LuminaireFit fit) {
    const SimplifiedState simplified = WithoutNeedlessParameters(fit, problem_.open, problem_.held);
    const auto fitted = [&](const SimplifiedState& s) {
      return FitLuminaires(room_, part, WithSidesAlike(s.state, problem_.open), problem_.priors(),
                           OfPart(&fit));
    };
    if (simplified.needless.empty()) {
      fit.state = WithoutVanishedSizes(fit.state);
      return fit;
    }
    LuminaireFit simple = fitted(simplified);
    if (const auto other = WithOtherPoints(fit, problem_.open, problem_.held, simplified)) {
      LuminaireFit with_points = fitted(*other);
      if (with_points.relative_sigma < simple.relative_sigma) {
        RecordNeedless(given_, other->needless, findings_);
        return WithoutNeedless(part, std::move(with_points));
      }
    }
    RecordNeedless(given_, simplified.needless, findings_);
    simple.state = WithoutVanishedSizes(simple.state);
    return simple;
  }

  // `near`: a fit to the same part, from which the fit starts.
  FitLuminairesOptions OfPart(const LuminaireFit* near = nullptr) {
    FitLuminairesOptions options;
    options.on_round = problem_.on_round;
    options.subtracts_discretisation = false;
    options.steps_by_direct_light = !data_.observations.empty();
    options.has_texture = problem_.has_texture;
    if (near == nullptr) return options;
    options.start_is_near = true;
    options.initial_relative_sigma = near->relative_sigma;
    options.photo_design_effect = near->photo_design_effect;
    options.frozen = near->frozen;
    return options;
  }

  const Room& room_;
  const RoomObservations& given_;
  const WholeProblem& problem_;
  LightData& data_;
  Findings& findings_;
};

}  // namespace

WholeFit FitWhole(const Room& room, const RoomObservations& given, const LightState& start,
                  const WholeProblem& problem, LightData& data, Findings& findings) {
  return WholeFitter(room, given, problem, data, findings).Fit(start);
}

}  // namespace luxfit
