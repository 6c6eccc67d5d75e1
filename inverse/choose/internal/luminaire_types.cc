#include "inverse/choose/internal/luminaire_types.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "forward/luminaire/photometry.h"

namespace luxfit {
namespace {

constexpr double kSameAim = 0.9998;    // cosine of a degree
constexpr double kNearlyAlike = 0.98;  // cosine of 11 degrees: within that, a tilt or heading is a number

bool IsOpen(const OpenChoice& open) { return open.distribution && open.shape; }

bool AreOnTogether(const LightData& data, int a, int b) {
  constexpr double kSameLevel = 1e-6;
  return std::all_of(data.dimming.begin(), data.dimming.end(), [&](const Eigen::VectorXd& dimming) {
    return std::abs(dimming[a] - dimming[b]) < kSameLevel;
  });
}

// Returns whether photos show luminaires of two kinds, at other heights. Their areas tell no more than the fit of
// shapes, which starts worse from types that these split.
bool AreOfTwoKinds(const std::optional<SeenPlace>& a, const std::optional<SeenPlace>& b) {
  constexpr double kHeightM = 0.3;
  return a && b && std::abs(a->position.z() - b->position.z()) > kHeightM;
}

// Returns whether one shines all round or to both sides, as globes and pendants do, and the other in a beam.
bool HaveTwoLobes(const LightState& state, size_t a, size_t b) {
  constexpr double kBeam = 3;  // half of its peak lies 37 degrees off the aim
  const auto is_all_round = [&](size_t k) {
    return state.luminaires[k].distribution == Distribution::kIsotropic || state.free[k].sides;
  };
  const auto is_beam = [&](size_t k) {
    return state.luminaires[k].distribution == Distribution::kCosinePower &&
           state.luminaires[k].cosine_exponent > kBeam;
  };
  return (is_all_round(a) && is_beam(b)) || (is_beam(a) && is_all_round(b));
}

// Returns whether the search for places told the aims of all these luminaires, and two of them differ.
bool MayHaveOwnAims(const LightState& state, const std::vector<int>& type) {
  const auto aim = [&](int k) { return state.luminaires[static_cast<size_t>(k)].aim; };
  return std::all_of(type.begin(), type.end(),
                     [&](int k) { return state.free[static_cast<size_t>(k)].tilt; }) &&
         std::any_of(type.begin(), type.end(), [&](int k) {
           return std::any_of(type.begin(), type.end(),
                              [&](int j) { return aim(k).dot(aim(j)) < kNearlyAlike; });
         });
}

bool HaveOneTable(const Luminaire& a, const Luminaire& b) {
  if (!a.table || !b.table) return !a.table && !b.table;
  return a.table->gamma_rad == b.table->gamma_rad && a.table->c_rad == b.table->c_rad;
}

// Returns whether two luminaires differ in numbers only.
bool HaveOneForm(const Luminaire& a, const Luminaire& b) {
  return a.distribution == b.distribution && a.shape == b.shape && HaveOneTable(a, b) &&
         a.emission.size() == 0 && b.emission.size() == 0;
}

bool HaveOneDirection(const Luminaire& a, const Luminaire& b) {
  const bool is_turnable = a.shape == LuminaireShape::kRectangle;
  return a.aim.dot(b.aim) > kNearlyAlike &&
         (!is_turnable || std::abs(AxesOf(a).along.dot(AxesOf(b).along)) > kNearlyAlike);
}

bool IsTurnableByQuarter(const Luminaire& luminaire, const OpenChoice& open) {
  return IsOpen(open) && open.heading && luminaire.shape == LuminaireShape::kRectangle &&
         luminaire.emission.size() == 0 && (!luminaire.table || IsSymmetricAboutAim(*luminaire.table));
}

double SidesApart(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a.array() / b.array()).log().abs().sum();
}

bool IsPlace(LuminaireQuantity quantity) {
  return quantity == LuminaireQuantity::kPositionX || quantity == LuminaireQuantity::kPositionY ||
         quantity == LuminaireQuantity::kPositionZ;
}

bool IsDirection(LuminaireQuantity quantity) {
  return quantity == LuminaireQuantity::kTiltAlong || quantity == LuminaireQuantity::kTiltAcross ||
         quantity == LuminaireQuantity::kHeading;
}

// Holds where a fit has the parameter of one number of the form; -1: it is held there.
using Number = std::tuple<LuminaireQuantity, int, int>;  // quantity, part, reference
std::map<Number, Eigen::Index> FormOf(const LuminaireFit& fit, int luminaire) {
  std::map<Number, Eigen::Index> form;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Parameter& p = fit.parameters[i];
    const bool is_own =
        IsPlace(p.quantity) ||
        (fit.state.free[static_cast<size_t>(luminaire)].own_direction && IsDirection(p.quantity));
    if (p.kind == ParameterKind::kLuminaire && p.index == luminaire && !is_own)
      form[{p.quantity, p.part, p.reference}] = static_cast<Eigen::Index>(i);
  }
  return form;
}

// Returns x_a - x_b for the numbers that either has free.
Eigen::VectorXd DifferenceOf(const LuminaireFit& fit, int a, int b, const std::set<Number>& numbers) {
  LightState as_b = fit.state;
  const auto at_a = static_cast<size_t>(a);
  as_b.luminaires[at_a] = OfTypeOf(fit.state.luminaires[static_cast<size_t>(b)], fit.state.luminaires[at_a],
                                   fit.state.free[at_a].own_direction);
  std::vector<Parameter> of_a;
  of_a.reserve(numbers.size());
  for (const auto& [quantity, part, reference] : numbers) {
    Parameter p{ParameterKind::kLuminaire, a, quantity, -1e9, 1e9, ""};
    p.part = part, p.reference = reference;
    of_a.push_back(std::move(p));
  }
  of_a = Recentred(std::move(of_a), fit.state);
  return PackParameters(fit.state, of_a) - PackParameters(as_b, of_a);
}

// Source: Wilson and Hilferty (1931).
double Chi2Of95(double freedom) {
  const double variance = 2 / (9 * freedom);
  return freedom * std::pow(1 - variance + 1.6449 * std::sqrt(variance), 3);
}

// Returns the comparison of two types by their first luminaires; none where they cannot be one.
std::optional<MergedTypes> Compared(const LuminaireFit& fit, int a, int b) {
  const auto at_a = static_cast<size_t>(a), at_b = static_cast<size_t>(b);
  const Luminaire &of_a = fit.state.luminaires[at_a], &of_b = fit.state.luminaires[at_b];
  const bool has_own_direction = fit.state.free[at_a].own_direction;
  if (has_own_direction != fit.state.free[at_b].own_direction || !HaveOneForm(of_a, of_b)) return {};
  if (!has_own_direction && !HaveOneDirection(of_a, of_b)) return {};
  const std::map<Number, Eigen::Index> form_a = FormOf(fit, a), form_b = FormOf(fit, b);
  std::set<Number> numbers;
  for (const auto& [number, column] : form_a) numbers.insert(number);
  for (const auto& [number, column] : form_b) numbers.insert(number);
  const auto n = static_cast<Eigen::Index>(numbers.size());
  MergedTypes merged{a, b, 0, static_cast<int>(n)};
  if (n == 0) return merged;
  Eigen::MatrixXd contrast = Eigen::MatrixXd::Zero(n, fit.covariance.cols());
  Eigen::Index row = 0;
  for (const Number& number : numbers) {
    const auto in_a = form_a.find(number), in_b = form_b.find(number);
    if (in_a != form_a.end()) contrast(row, in_a->second) = 1;
    if (in_b != form_b.end()) contrast(row, in_b->second) = -1;
    ++row;
  }
  const Eigen::VectorXd difference = DifferenceOf(fit, a, b, numbers);
  const Eigen::LDLT<Eigen::MatrixXd> factor(contrast * fit.covariance * contrast.transpose());
  if (!factor.isPositive()) return {};
  merged.chi2 = difference.dot(factor.solve(difference));
  if (!(merged.chi2 <= Chi2Of95(static_cast<double>(n)))) return {};
  return merged;
}

// Holds where a fit turns a luminaire; none where its aim is held.
struct FittedTurn {
  AimFrame frame;
  std::array<Eigen::Index, 2> columns{-1, -1};  // of the tilts along and across
};

std::optional<FittedTurn> TurnOf(const LuminaireFit& fit, int luminaire) {
  FittedTurn turn;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Parameter& p = fit.parameters[i];
    const bool is_along = p.Is(ParameterKind::kLuminaire, luminaire, LuminaireQuantity::kTiltAlong);
    if (!is_along && !p.Is(ParameterKind::kLuminaire, luminaire, LuminaireQuantity::kTiltAcross)) continue;
    turn.frame = p.frame;
    turn.columns[is_along ? 0 : 1] = static_cast<Eigen::Index>(i);
  }
  if (turn.columns[0] < 0 || turn.columns[1] < 0) return {};
  return turn;
}

// Returns whether the fit tells the aims of luminaires, each free, from one common aim. Aims and their sigmas are
// compared as tilts in the first one's frame.
bool TellsAimsApart(const LuminaireFit& fit, const std::vector<int>& type) {
  const std::optional<FittedTurn> first = TurnOf(fit, type.front());
  if (!first) return true;
  const auto n = static_cast<Eigen::Index>(2 * (type.size() - 1));
  Eigen::MatrixXd contrast = Eigen::MatrixXd::Zero(n, fit.covariance.cols());
  Eigen::VectorXd difference(n);
  const Eigen::Vector3d& aim = fit.state.luminaires[static_cast<size_t>(type.front())].aim;
  for (size_t m = 1; m < type.size(); ++m) {
    const std::optional<FittedTurn> turn = TurnOf(fit, type[m]);
    const Eigen::Vector3d& other = fit.state.luminaires[static_cast<size_t>(type[m])].aim;
    if (!turn || other.dot(aim) < kNearlyAlike) return true;
    const auto row = static_cast<Eigen::Index>(2 * (m - 1));
    for (Eigen::Index i = 0; i < 2; ++i) {
      const Eigen::Vector3d& axis = i == 0 ? first->frame.along : first->frame.across;
      difference[row + i] = (other - aim).dot(axis);
      contrast(row + i, first->columns[static_cast<size_t>(i)]) = -1;
      contrast(row + i, turn->columns[0]) = turn->frame.along.dot(axis);
      contrast(row + i, turn->columns[1]) = turn->frame.across.dot(axis);
    }
  }
  const Eigen::LDLT<Eigen::MatrixXd> factor(contrast * fit.covariance * contrast.transpose());
  return !factor.isPositive() ||
         !(difference.dot(factor.solve(difference)) <= Chi2Of95(static_cast<double>(n)));
}

// Returns whether each place has a luminaire of its own near it.
bool AreReached(const std::vector<Eigen::Vector3d>& places, const LightState& state,
                const std::vector<int>& type) {
  constexpr double kReachM = 0.3;
  std::set<int> taken;
  for (const Eigen::Vector3d& place : places) {
    int nearest = -1;
    double least = kReachM;
    for (const int k : type) {
      const double distance = (state.luminaires[static_cast<size_t>(k)].position - place).norm();
      if (taken.count(k) == 0 && distance < least) nearest = k, least = distance;
    }
    if (nearest < 0) return false;
    taken.insert(nearest);
  }
  return true;
}

}  // namespace

LightState TypedBySwitching(const LightData& data, LightState start, const std::vector<OpenChoice>& open,
                            const ShownLuminaires& shown) {
  std::vector<int> first;
  for (int k = 0; k < static_cast<int>(open.size()); ++k) {
    const auto of = static_cast<size_t>(k);
    first.push_back(k);
    double least_m = std::numeric_limits<double>::infinity();
    for (int j = 0; j < k; ++j) {
      const auto other = static_cast<size_t>(j);
      const Luminaire &a = start.luminaires[of], &b = start.luminaires[other];
      const bool has_one_aim = (open[of].aim && open[other].aim) || a.aim.dot(b.aim) > kSameAim;
      const double apart_m = std::abs(a.position.z() - b.position.z());
      if (!IsOpen(open[of]) || !IsOpen(open[other]) || !AreOnTogether(data, j, k) || !has_one_aim ||
          AreOfTwoKinds(shown[of], shown[other]) || HaveTwoLobes(start, of, other) || apart_m >= least_m)
        continue;
      first.back() = first[other];
      least_m = apart_m;
    }
  }
  start.first_of_type = std::move(first);
  for (const std::vector<int>& type : TypesOf(start)) {
    if (!MayHaveOwnAims(start, type)) continue;
    for (const int k : type) start.free[static_cast<size_t>(k)].own_direction = true;
  }
  return start;
}

LightState WithTypes(LightState state, const std::vector<int>& first_of_type) {
  state.first_of_type = first_of_type;
  for (const std::vector<int>& type : TypesOf(state)) {
    const auto likeness = [&](int k) {
      double sum = 0;
      for (const int j : type)
        sum += state.luminaires[static_cast<size_t>(k)].aim.dot(state.luminaires[static_cast<size_t>(j)].aim);
      return sum;
    };
    const int model = *std::max_element(type.begin(), type.end(),
                                        [&](int a, int b) { return likeness(a) < likeness(b) - 1e-9; });
    Luminaire& first = state.luminaires[static_cast<size_t>(type.front())];
    first = OfTypeOf(state.luminaires[static_cast<size_t>(model)], first,
                     state.free[static_cast<size_t>(type.front())].own_direction);
    state.free[static_cast<size_t>(type.front())] = state.free[static_cast<size_t>(model)];
  }
  return WithLikeTypes(std::move(state));
}

std::vector<TypePlaces> SeenPlacesOfTypes(const std::vector<SeenPlace>& seen, const LightData& data,
                                          const LightState& state, const ShownLuminaires& shown) {
  std::vector<TypePlaces> all;
  for (const std::vector<int>& type : TypesOf(state)) {
    if (type.size() < 2) continue;
    std::vector<SeenPlace> own;
    for (const SeenPlace& place : seen) {
      const bool is_of_kind = std::none_of(type.begin(), type.end(), [&](int k) {
        return AreOfTwoKinds(place, shown[static_cast<size_t>(k)]);
      });
      if (is_of_kind && MayBePlaceOf(place, data.dimming, type.front()) && place.area_m2 > 0)
        own.push_back(place);
    }
    if (own.size() < type.size()) continue;
    std::stable_sort(own.begin(), own.end(),
                     [](const SeenPlace& a, const SeenPlace& b) { return a.area_m2 > b.area_m2; });
    own.resize(type.size());
    TypePlaces places{type.front(), {}};
    for (const SeenPlace& place : own) places.places.push_back(place.position);
    std::sort(places.places.begin(), places.places.end(),
              [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.x() < b.x(); });
    if (!AreReached(places.places, state, type)) all.push_back(std::move(places));
  }
  return all;
}

LightState WithSidesAlike(LightState state, const std::vector<OpenChoice>& open) {
  constexpr double kUnlike = 0.2;  // sum of the sides' logarithmic ratios
  std::vector<int> earlier;
  for (const std::vector<int>& type : TypesOf(state)) {
    const int k = type.front();
    Luminaire& first = state.luminaires[static_cast<size_t>(k)];
    if (!IsTurnableByQuarter(first, open[static_cast<size_t>(k)]) ||
        state.free[static_cast<size_t>(k)].heading)
      continue;
    const bool is_other_way = std::any_of(earlier.begin(), earlier.end(), [&](int j) {
      const Eigen::Vector2d& sides = state.luminaires[static_cast<size_t>(j)].size_m;
      const double as_it_is = SidesApart(first.size_m, sides);
      return as_it_is > kUnlike && SidesApart(first.size_m.reverse(), sides) < as_it_is / 2;
    });
    if (is_other_way) {
      first.heading = AxesOf(first).across;
      first.size_m.reverseInPlace();
    }
    earlier.push_back(k);
  }
  return WithLikeTypes(std::move(state));
}

TypedState WithMergedTypes(const LuminaireFit& fit, const std::vector<OpenChoice>& open) {
  TypedState typed{fit.state, {}, {}};
  if (fit.covariance.size() == 0) return typed;
  std::vector<int>& first = typed.state.first_of_type;
  if (first.empty()) {
    for (int k = 0; k < static_cast<int>(open.size()); ++k) first.push_back(k);
  }
  const std::vector<std::vector<int>> types = TypesOf(typed.state);
  for (const std::vector<int>& type : types) {
    if (!fit.state.free[static_cast<size_t>(type.front())].own_direction || TellsAimsApart(fit, type))
      continue;
    typed.turned_alike.push_back(type.front());
    for (const int k : type) typed.state.free[static_cast<size_t>(k)].own_direction = false;
  }
  for (size_t t = 0; t < types.size(); ++t) {
    const int own = types[t].front();
    if (!IsOpen(open[static_cast<size_t>(own)])) continue;
    for (size_t u = 0; u < t && first[static_cast<size_t>(own)] == own; ++u) {
      const int other = types[u].front();
      if (first[static_cast<size_t>(other)] != other || !IsOpen(open[static_cast<size_t>(other)])) continue;
      const std::optional<MergedTypes> merged = Compared(fit, other, own);
      if (!merged) continue;
      typed.merged.push_back(*merged);
      for (const int k : types[t]) first[static_cast<size_t>(k)] = other;
    }
  }
  typed.state = WithLikeTypes(std::move(typed.state));
  return typed;
}

}  // namespace luxfit
