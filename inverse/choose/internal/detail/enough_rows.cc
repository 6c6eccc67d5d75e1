#include "inverse/choose/internal/detail/enough_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace luxfit {
namespace {

std::map<int, int> NumberElements(const std::vector<Observation>& observations) {
  std::map<int, int> number;
  for (const Observation& o : observations) number.emplace(o.element, 0);
  int count = 0;
  for (auto& [element, n] : number) n = count++;
  return number;
}

// Returns the level of each place in a stride: 0 for its first, 1 for its middle, and so on.
std::vector<int> LevelInStride(int stride) {
  std::vector<int> level(static_cast<size_t>(stride), -1);
  for (int k = 0; std::count(level.begin(), level.end(), -1) > 0; ++k) {
    for (int j = 0; j < 1 << k; ++j) {
      int& place = level[static_cast<size_t>(j * stride >> k)];
      if (place < 0) place = k;
    }
  }
  return level;
}

class Levels {
 public:
  Levels(const Room& room, const LightData& data, const std::vector<ParameterPrior>& priors,
         int first_elements, const FitLuminairesOptions& options)
      : room_(room),
        data_(data),
        priors_(priors),
        options_(options),
        level_(LevelsOf(data.observations, first_elements)) {
    if (!level_.empty()) last_ = *std::max_element(level_.begin(), level_.end());
    first_rows_ = std::max<double>(1, std::count(level_.begin(), level_.end(), 0));
  }

  int last() const { return last_; }

  LightData UpTo(int level) const {
    LightData part = data_;
    part.observations.clear();
    for (size_t i = 0; i < level_.size(); ++i) {
      if (level_[i] <= level) part.observations.push_back(data_.observations[i]);
    }
    return part;
  }

  LuminaireFit FitTo(const LightData& part, const LightState& start, double relative_sigma,
                     const std::shared_ptr<const FrozenLight>& frozen) const {
    FitLuminairesOptions options = OptionsFor(part);
    options.initial_relative_sigma = relative_sigma;
    options.frozen = frozen;
    return FitLuminaires(room_, part, start, priors_, options);
  }

  // Predicts what the next level's rows add to a fit to this one's.
  LargestShift EffectOfNext(int level, const LuminaireFit& fit) const {
    const LightData more = UpTo(level + 1);
    FitLuminairesOptions weighing = OptionsFor(more);
    weighing.max_outer_iterations = 0;
    weighing.covariance = false;
    weighing.initial_relative_sigma = fit.relative_sigma;
    weighing.frozen = fit.frozen;
    const LuminaireFit weighed = FitLuminaires(room_, more, fit.state, priors_, weighing);
    std::vector<bool> is_fitted;
    is_fitted.reserve(more.observations.size());
    for (const int of_row : level_) {
      if (of_row <= level + 1) is_fitted.push_back(of_row <= level);
    }
    return LargestShiftOf(fit, ShiftByPart(room_, more, weighed, priors_, is_fitted));
  }

 private:
  FitLuminairesOptions OptionsFor(const LightData& part) const {
    FitLuminairesOptions options = options_;
    const double times = static_cast<double>(part.observations.size()) / first_rows_;
    options.photo_design_effect = 1 + (options_.photo_design_effect - 1) * times;
    return options;
  }

  const Room& room_;
  const LightData& data_;
  const std::vector<ParameterPrior>& priors_;
  const FitLuminairesOptions& options_;
  const std::vector<int> level_;
  int last_ = 0;
  double first_rows_ = 1;
};

// Returns after how many more doublings the effect is below what is worth one.
int DoublingsToGo(double sigmas) {
  return std::max(1, static_cast<int>(std::ceil(2 * std::log2(sigmas / kWorthSigmas))));
}

}  // namespace

std::vector<int> LevelsOf(const std::vector<Observation>& observations, int first_elements) {
  const std::map<int, int> number = NumberElements(observations);
  const int stride = std::max(1, static_cast<int>(number.size()) / std::max(1, first_elements));
  const std::vector<int> in_stride = LevelInStride(stride);
  std::vector<int> levels;
  levels.reserve(observations.size());
  for (const Observation& o : observations)
    levels.push_back(in_stride[static_cast<size_t>(number.at(o.element) % stride)]);
  return levels;
}

EnoughRows FitToEnoughRows(const Room& room, const LightData& data, const LightState& start,
                           const std::vector<ParameterPrior>& priors, int first_elements,
                           const FitLuminairesOptions& options) {
  const Levels levels(room, data, priors, first_elements, options);
  EnoughRows enough;
  enough.taken.observed_elements = static_cast<int>(NumberElements(data.observations).size());
  int level = enough.taken.observed_elements > kFewTimes * first_elements ? 0 : levels.last();
  LightData part = levels.UpTo(level);
  enough.fit = levels.FitTo(part, start, options.initial_relative_sigma, options.frozen);
  while (level < levels.last()) {
    const bool is_known = enough.fit.IsUsable() && enough.fit.covariance.size() > 0;
    int more = levels.last();
    if (is_known) {
      const auto elements = static_cast<int>(NumberElements(part.observations).size());
      enough.taken.doublings.push_back({elements, levels.EffectOfNext(level, enough.fit)});
      const double sigmas = enough.taken.doublings.back().effect.sigmas;
      if (sigmas < kWorthSigmas) break;
      more = DoublingsToGo(sigmas);
    }
    level = std::min(levels.last(), level + more);
    part = levels.UpTo(level);
    enough.fit = levels.FitTo(part, is_known ? enough.fit.state : start,
                              is_known ? enough.fit.relative_sigma : options.initial_relative_sigma,
                              enough.fit.frozen);
  }
  enough.taken.elements = static_cast<int>(NumberElements(part.observations).size());
  enough.observations = std::move(part.observations);
  return enough;
}

}  // namespace luxfit
