#include "apps/session/photos/internal/name_states.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace luxfit {
namespace {

constexpr double kMixError = 0.15;  // relative, rms over pixels
constexpr double kLeastDimming = 0.05;
constexpr double kOff = 0.01;  // of the brightest state

using Pictures = std::map<int, ImagePlane>;  // by view: light / exposure, NaN where clipped

// Returns the picture of a group's photo that shows most: the others clip more, or are darker.
ImagePlane PictureOf(const LightGroup& group, const std::vector<PhotoLook>& photos) {
  ImagePlane best;
  Eigen::Index most = -1;
  for (const size_t i : group.photos) {
    const Eigen::Index usable = (photos[i].pattern > 0.01f).count();
    if (usable <= most) continue;
    most = usable;
    best = photos[i].pattern / static_cast<float>(*photos[i].RelativeExposure());
  }
  return best;
}

std::vector<Pictures> PicturesOfStates(const std::vector<PhotoLook>& photos,
                                       const std::vector<LightGroup>& groups,
                                       const std::vector<int>& state_of) {
  std::vector<Pictures> pictures(
      static_cast<size_t>(*std::max_element(state_of.begin(), state_of.end()) + 1));
  for (size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].is_absolute)
      pictures[static_cast<size_t>(state_of[i])][groups[i].view] = PictureOf(groups[i], photos);
  }
  return pictures;
}

// Returns the light of every state (columns) at the pixels that all of them show, in the views that all of them have.
Eigen::MatrixXd CommonPixels(const std::vector<Pictures>& pictures, const std::vector<size_t>& states) {
  constexpr Eigen::Index kStep = 7;  // every pixel would tell little more
  std::vector<double> values;
  const auto columns = static_cast<Eigen::Index>(states.size());
  for (const auto& [view, first] : pictures[states.front()]) {
    if (!std::all_of(states.begin(), states.end(),
                     [&, v = view](size_t s) { return pictures[s].count(v) > 0; }))
      continue;
    for (Eigen::Index p = 0; p < first.size(); p += kStep) {
      const size_t before = values.size();
      for (const size_t s : states) {
        const float value = pictures[s].at(view).data()[p];
        if (value > 0) values.push_back(static_cast<double>(value));
      }
      if (values.size() != before + states.size()) values.resize(before);
    }
  }
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), static_cast<Eigen::Index>(values.size()) / columns, columns);
}

struct Mix {
  Eigen::VectorXd dimming;
  double relative_error = 1;
};

// Minimises the relative error of the target as a sum of columns with weights that are not negative.
Mix SolveMix(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target) {
  constexpr int kRounds = 500;
  const Eigen::MatrixXd a = target.cwiseInverse().asDiagonal() * columns;
  const Eigen::MatrixXd normal = a.transpose() * a;
  const Eigen::VectorXd right = a.transpose() * Eigen::VectorXd::Ones(target.size());
  Eigen::VectorXd d = Eigen::VectorXd::Zero(columns.cols());
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index k = 0; k < d.size(); ++k)
      d[k] = std::max(0.0, d[k] + (right[k] - normal.row(k).dot(d)) / normal(k, k));
  }
  return {d, std::sqrt((a * d - Eigen::VectorXd::Ones(target.size())).squaredNorm() /
                       static_cast<double>(target.size()))};
}

// Returns the state as a mix of others; none where no view shows them all.
Mix MixOf(size_t state, const std::vector<size_t>& others, const std::vector<Pictures>& pictures) {
  constexpr Eigen::Index kFewestPixels = 50;
  std::vector<size_t> states = others;
  states.insert(states.begin(), state);
  const Eigen::MatrixXd light = CommonPixels(pictures, states);
  if (light.rows() < kFewestPixels) return {};
  return SolveMix(light.rightCols(light.cols() - 1), light.col(0));
}

bool IsMix(const Mix& mix) {
  constexpr double kFullLight = 1.1;  // a luminaire gives no more than it does alone
  return mix.relative_error < kMixError && mix.dimming.maxCoeff() < kFullLight;
}

// Returns the mean over views of the state's light as a share of the view's brightest state.
double ShareOf(const Pictures& state, const std::vector<Pictures>& pictures) {
  double sum = 0;
  const auto light_of = [](const ImagePlane& picture) {
    return static_cast<double>(picture.isFinite().select(picture, 0.0f).mean());
  };
  for (const auto& [view, picture] : state) {
    double brightest = 0;
    for (const Pictures& other : pictures) {
      if (other.count(view) > 0) brightest = std::max(brightest, light_of(other.at(view)));
    }
    sum += brightest > 0 ? light_of(picture) / brightest : 0;
  }
  return state.empty() ? 1 : sum / static_cast<double>(state.size());
}

std::string LuminaireName(size_t number) {
  return number < 26 ? std::string(1, static_cast<char>('A' + number)) : "lamp" + std::to_string(number + 1);
}

// Tells which states are mixes of others that are none. The brightest are looked at first: what is a part of them, they
// are no part of.
std::vector<bool> FindMixes(const std::vector<Pictures>& pictures, const std::vector<double>& share) {
  std::vector<size_t> by_light;
  for (size_t s = 0; s < pictures.size(); ++s) {
    if (share[s] >= kOff) by_light.push_back(s);
  }
  std::stable_sort(by_light.begin(), by_light.end(), [&](size_t a, size_t b) { return share[a] > share[b]; });
  std::vector<bool> is_mix(pictures.size(), false);
  for (const size_t s : by_light) {
    std::vector<size_t> others;
    for (const size_t other : by_light) {
      if (other != s && !is_mix[other]) others.push_back(other);
    }
    is_mix[s] = !others.empty() && IsMix(MixOf(s, others, pictures));
  }
  return is_mix;
}

// Rounds to what a dimmer is set to: full light where the light says so to a tenth.
double RoundedDimming(double dimming) {
  return std::abs(dimming - 1) < 0.1 ? 1 : std::min(1.0, 0.05 * std::round(dimming / 0.05));
}

// Says what is on in a mix of `singles`, the names of the states of one luminaire each.
GuessedState MixedState(const Mix& mix, const std::vector<std::string>& singles) {
  GuessedState state;
  for (Eigen::Index k = 0; k < mix.dimming.size(); ++k) {
    const double dimming = RoundedDimming(mix.dimming[k]);
    if (dimming < kLeastDimming) continue;
    state.luminaires.push_back(singles[static_cast<size_t>(k)]);
    state.dimming.push_back(dimming);
  }
  state.because = fmt::format("its light is this sum of other states, to {:.0f} %", 100 * mix.relative_error);
  return state;
}

bool IsEverythingOn(const GuessedState& state, const std::vector<std::string>& singles) {
  return !singles.empty() && state.luminaires.size() == singles.size() &&
         std::all_of(state.dimming.begin(), state.dimming.end(), [](double d) { return d == 1; });
}

}  // namespace

std::vector<GuessedState> NameStates(const std::vector<PhotoLook>& photos,
                                     const std::vector<LightGroup>& groups,
                                     const std::vector<int>& state_of_group) {
  const std::vector<Pictures> pictures = PicturesOfStates(photos, groups, state_of_group);
  std::vector<double> share;
  share.reserve(pictures.size());
  for (const Pictures& state : pictures) share.push_back(ShareOf(state, pictures));
  const std::vector<bool> is_mix = FindMixes(pictures, share);
  std::vector<GuessedState> states(pictures.size());
  std::vector<size_t> single_states;
  std::vector<std::string> singles;
  for (size_t s = 0; s < states.size(); ++s) {
    if (share[s] < kOff) {
      states[s] = {"off", {}, {}, "it has less than 1 % of the light of the brightest"};
    } else if (!is_mix[s]) {
      single_states.push_back(s);
      singles.push_back(LuminaireName(singles.size()));
      states[s] = {
          singles.back(), {singles.back()}, {}, "taken for one luminaire: it is no sum of other states"};
    }
  }
  if (singles.size() == 1) states[single_states[0]].id = "all";
  int mixes = 0;
  for (size_t s = 0; s < states.size(); ++s) {
    if (!is_mix[s]) continue;
    states[s] = MixedState(MixOf(s, single_states, pictures), singles);
    states[s].is_unnamed = !IsEverythingOn(states[s], singles);
    states[s].id = states[s].is_unnamed ? "mix" + std::to_string(++mixes) : "all";
  }
  return states;
}

std::vector<GuessedState> WithMixesOfOccasions(std::vector<GuessedState> states,
                                               const std::vector<PhotoLook>& photos,
                                               const std::vector<LightGroup>& groups,
                                               const std::vector<int>& state_of_group) {
  const std::vector<Pictures> pictures = PicturesOfStates(photos, groups, state_of_group);
  std::vector<size_t> single_states;
  std::vector<std::string> singles;
  for (size_t s = 0; s < states.size(); ++s) {
    if (states[s].luminaires != std::vector<std::string>{states[s].id}) continue;
    single_states.push_back(s);
    singles.push_back(states[s].id);
  }
  for (size_t s = 0; s < states.size(); ++s) {
    GuessedState& state = states[s];
    if (!state.is_occasion) continue;
    const Mix mix = pictures[s].empty() ? Mix{} : MixOf(s, single_states, pictures);
    if (IsMix(mix)) {
      const std::string id = state.id;
      state = MixedState(mix, singles);
      state.id = id;
    } else {
      state.because += pictures[s].empty()
                           ? "; its photos state no exposure, so that their light does not tell"
                           : "; its light is no sum of the others', or no view shows them all";
    }
  }
  return states;
}

}  // namespace luxfit
