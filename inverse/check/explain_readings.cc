#include "inverse/check/explain_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "inverse/check/internal/factor_words.h"
#include "inverse/check/internal/misreading.h"
#include "inverse/select/contradicted.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

constexpr double kNotPredicted = std::numeric_limits<double>::quiet_NaN();
constexpr double kByChance = 1;  // mean square of normal residuals over their sigma
constexpr double kExplains =
    3;  // highest score of an explanation: a quarter of the readings may be off otherwise
constexpr double kWorst = 9;  // of a row, as GroupScore bounds it

struct ReadingTable {
  const ExplainingLight& light;
  const std::vector<ReadingAsGiven>& readings;
  std::vector<int> group;  // place, by reading
  int groups = 0;
  ScaleSource scale = ScaleSource::kOther;

  // Returns whether the reading judges: one that sets the scale agrees with it whatever it is.
  bool IsJudge(size_t i) const { return scale != ScaleSource::kReadings || !readings[i].sets_scale; }
};

ReadingTable TableOf(const ExplainingLight& light, const std::vector<ReadingAsGiven>& readings) {
  ReadingTable table{light, readings, {}, 0, light.scale};
  std::map<std::string, int> groups;
  for (const ReadingAsGiven& r : readings)
    table.group.push_back(groups.emplace(r.id, static_cast<int>(groups.size())).first->second);
  table.groups = static_cast<int>(groups.size());
  const bool has_scale =
      std::any_of(readings.begin(), readings.end(), [](const ReadingAsGiven& r) { return r.sets_scale; });
  if (light.scale == ScaleSource::kReadings && !has_scale) table.scale = ScaleSource::kNone;
  return table;
}

double MedianOf(std::vector<double> values) {
  if (values.empty()) return kNotPredicted;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Returns g. `left_out`: the place whose readings do not count, where those that judge choose it; -1: none.
double ScaleFactor(const ReadingTable& table, const Eigen::VectorXd& lit, bool has_own_scale, int left_out) {
  if (table.scale == ScaleSource::kOther && !has_own_scale) return 1;
  const bool by_judges = has_own_scale || table.scale == ScaleSource::kNone;
  std::vector<double> ratios;
  for (size_t i = 0; i < table.readings.size(); ++i) {
    const double lx = lit[static_cast<Eigen::Index>(i)];
    const bool counts = by_judges ? table.IsJudge(i) && table.group[i] != left_out : !table.IsJudge(i);
    if (counts && lx > 0) ratios.push_back(table.readings[i].measured_lx / lx);
  }
  return MedianOf(std::move(ratios));
}

// Returns r; NaN where nothing is predicted.
double Residual(const ReadingTable& table, size_t i, double predicted_lx) {
  const ReadingAsGiven& r = table.readings[i];
  return (r.measured_lx - predicted_lx) / std::hypot(r.sigma_lx, table.light.relative_sigma * predicted_lx);
}

GroupScores ScoresOf(const ReadingTable& table, const Eigen::VectorXd& lit, bool has_own_scale) {
  std::vector<double> factors;
  factors.reserve(static_cast<size_t>(table.groups));
  for (int g = 0; g < table.groups; ++g) factors.push_back(ScaleFactor(table, lit, has_own_scale, g));
  GroupScores scores;
  for (size_t i = 0; i < table.readings.size(); ++i) {
    if (!table.IsJudge(i)) continue;
    const double factor = factors[static_cast<size_t>(table.group[i])];
    const double r = Residual(table, i, factor * lit[static_cast<Eigen::Index>(i)]);
    scores[table.group[i]].Add(std::isfinite(r) ? r : std::sqrt(kWorst));
  }
  return scores;
}

// Holds a misreading with the way in which it was probably made.
struct Candidate {
  const Misreading* misreading = nullptr;
  size_t way = 0;
  GroupScores scores;   // each place by the way that the others choose
  Eigen::VectorXd lit;  // by the way, without g
};

double SumWithout(const GroupScores& scores, int left_out) {
  double sum = 0;
  for (const auto& [group, score] : scores) sum += group == left_out ? 0 : score.sum;
  return sum;
}

size_t BestWay(const std::vector<GroupScores>& ways, int left_out) {
  const auto is_less = [&](const GroupScores& a, const GroupScores& b) {
    return SumWithout(a, left_out) < SumWithout(b, left_out);
  };
  return static_cast<size_t>(std::min_element(ways.begin(), ways.end(), is_less) - ways.begin());
}

std::vector<Sensor> PlacesOf(const ReadingTable& table, const Rereading& way) {
  std::vector<Sensor> places;
  for (const ReadingAsGiven& r : table.readings) places.push_back(way.place ? way.place(r.sensor) : r.sensor);
  return places;
}

// `in_states`: of PlacesOf(table, way).
Eigen::VectorXd LitBy(const ReadingTable& table, const Rereading& way, const Eigen::MatrixXd& in_states) {
  Eigen::VectorXd lit(in_states.rows());
  const auto [a, b] = way.exchanged_states;
  for (Eigen::Index i = 0; i < lit.size(); ++i) {
    const int state = table.readings[static_cast<size_t>(i)].state;
    lit[i] = in_states(i, state == a ? b : (state == b ? a : state));
  }
  return lit;
}

Candidate Judge(const ReadingTable& table, const Misreading& misreading,
                const std::vector<Eigen::MatrixXd>& in_states) {
  std::vector<Eigen::VectorXd> lit;
  std::vector<GroupScores> ways;
  for (size_t w = 0; w < misreading.ways.size(); ++w) {
    lit.push_back(LitBy(table, misreading.ways[w], in_states[w]));
    ways.push_back(ScoresOf(table, lit.back(), misreading.has_own_scale));
  }
  Candidate candidate{&misreading, BestWay(ways, -1), {}, {}};
  candidate.lit = lit[candidate.way];
  for (const auto& [group, score] : ways.front())
    candidate.scores[group] = ways[BestWay(ways, group)].at(group);
  return candidate;
}

// Judges all misreadings; their light is asked for at once. `as_given`: the light at the places as given.
std::vector<Candidate> JudgeAll(const ReadingTable& table, const std::vector<Misreading>& misreadings,
                                const Eigen::MatrixXd& as_given) {
  std::vector<Sensor> places;
  for (const Misreading& m : misreadings) {
    for (const Rereading& way : m.ways) {
      if (!way.place) continue;
      for (Sensor& sensor : PlacesOf(table, way)) places.push_back(std::move(sensor));
    }
  }
  const Eigen::MatrixXd in_states = table.light.in_states(places);
  std::vector<Candidate> candidates;
  Eigen::Index next = 0;
  for (const Misreading& m : misreadings) {
    std::vector<Eigen::MatrixXd> of_ways;
    for (const Rereading& way : m.ways) {
      of_ways.push_back(way.place ? in_states.middleRows(next, as_given.rows()) : as_given);
      if (way.place) next += as_given.rows();
    }
    candidates.push_back(Judge(table, m, of_ways));
  }
  return candidates;
}

// Returns the mean score of the readings that stand in a state with one that sets the scale; 0 where there are none.
// Where they are off with it, not the reading is wrong but what is on in that state.
double ScoreBesideScale(const ReadingTable& table, const Candidate& candidate) {
  std::set<int> states;
  for (size_t i = 0; i < table.readings.size(); ++i)
    if (!table.IsJudge(i)) states.insert(table.readings[i].state);
  const double factor = ScaleFactor(table, candidate.lit, true, -1);
  GroupScore beside;
  for (size_t i = 0; i < table.readings.size(); ++i) {
    if (table.IsJudge(i) && states.count(table.readings[i].state) > 0)
      beside.Add(Residual(table, i, factor * candidate.lit[static_cast<Eigen::Index>(i)]));
  }
  return beside.count > 0 ? beside.sum / beside.count : 0;
}

std::vector<Candidate> Holding(const ReadingTable& table, std::vector<Candidate> candidates,
                               const GroupScores& as_given) {
  const auto fails = [&](const Candidate& c) {
    return Mean(c.scores) > kExplains || !IsContradicted(as_given, c.scores) ||
           (c.misreading->has_own_scale && ScoreBesideScale(table, c) > kExplains);
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), fails), candidates.end());
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return Mean(a.scores) < Mean(b.scores); });
  const auto is_refused = [&](const Candidate& c) {
    return Mean(c.scores) > kByChance && IsContradicted(c.scores, candidates.front().scores);
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), is_refused), candidates.end());
  return candidates;
}

double RmsPercent(const ReadingTable& table, const Eigen::VectorXd& lit, bool has_own_scale) {
  const double factor = ScaleFactor(table, lit, has_own_scale, -1);
  double squares = 0, measured_lx = 0;
  int count = 0;
  for (size_t i = 0; i < table.readings.size(); ++i) {
    const double predicted_lx = factor * lit[static_cast<Eigen::Index>(i)];
    if (!table.IsJudge(i) || !std::isfinite(predicted_lx)) continue;
    squares += std::pow(table.readings[i].measured_lx - predicted_lx, 2);
    measured_lx += table.readings[i].measured_lx;
    ++count;
  }
  return count > 0 ? 100 * std::sqrt(squares * count) / measured_lx : kNotPredicted;
}

int PlacesOutside(const ReadingTable& table, const Eigen::VectorXd& lit) {
  std::set<int> outside;
  for (size_t i = 0; i < table.group.size(); ++i)
    if (std::isnan(lit[static_cast<Eigen::Index>(i)])) outside.insert(table.group[i]);
  return static_cast<int>(outside.size());
}

// Says by which factor readings are off: those that set the scale, or all where something else sets it.
struct WrongScale {
  std::string words;
  double given_over_right = 1;  // as the cause has it where it is known, else as the readings have it
  bool is_of_all = false;
  bool may_be_the_others = false;  // those that do not set the scale, the other way
};

WrongScale WrongScaleOf(const ReadingTable& table, const Eigen::VectorXd& lit) {
  const double asked = ScaleFactor(table, lit, true, -1);
  std::string first, whose;
  size_t scaling = 0;
  for (size_t i = 0; i < table.readings.size(); ++i) {
    if (table.IsJudge(i)) continue;
    const ReadingAsGiven& r = table.readings[i];
    if (scaling++ == 0) first = r.id + "@" + table.light.states[static_cast<size_t>(r.state)];
  }
  WrongScale wrong;
  wrong.is_of_all = scaling == 0;
  wrong.may_be_the_others = scaling > 0 && 2 * scaling >= table.readings.size();
  // The light is as bright as the readings that set the scale are.
  const double given_over_right = scaling > 0 ? ScaleFactor(table, lit, false, -1) / asked : asked;
  if (wrong.is_of_all) {
    whose = fmt::format("all {} readings were", table.readings.size());
  } else {
    whose = scaling == 1 ? fmt::format("the reading that sets the scale, {}, was", first)
                         : fmt::format("the {} readings that set the scale were", scaling);
  }
  const bool is_high = given_over_right > 1;
  wrong.given_over_right = given_over_right;
  const std::optional<KnownFactor> known = FindKnownFactor(given_over_right);
  if (known) wrong.given_over_right = known->factor;
  const std::string size =
      fmt::format("{:.3g} times too {}{}", is_high ? given_over_right : 1 / given_over_right,
                  is_high ? "high" : "low", known ? ", " + known->words : "");
  wrong.words = whose + " " + size;
  if (wrong.may_be_the_others)
    wrong.words += fmt::format(", or the other {} the other way", table.readings.size() - scaling);
  return wrong;
}

ReadingAsGiven ReadBy(const Rereading& way, ReadingAsGiven reading) {
  const auto [a, b] = way.exchanged_states;
  if (way.place) reading.sensor = way.place(reading.sensor);
  if (reading.state == a || reading.state == b) reading.state = reading.state == a ? b : a;
  return reading;
}

ReadingAsGiven ScaledBy(const WrongScale& wrong, ReadingAsGiven reading) {
  if (wrong.is_of_all || reading.sets_scale) reading.measured_lx /= wrong.given_over_right;
  return reading;
}

ReadingExplanation Explained(const ReadingTable& table, const Candidate& candidate,
                             const Eigen::VectorXd& as_given) {
  const Misreading& misreading = *candidate.misreading;
  ReadingExplanation explanation;
  if (misreading.has_own_scale) {
    const WrongScale wrong = WrongScaleOf(table, candidate.lit);
    explanation.as_if = wrong.words;
    if (!wrong.may_be_the_others)
      explanation.so_read = [wrong](ReadingAsGiven r) { return ScaledBy(wrong, std::move(r)); };
  } else {
    const Rereading& way = misreading.ways[candidate.way];
    explanation.as_if = way.as_if;
    explanation.so_read = [way](ReadingAsGiven r) { return ReadBy(way, std::move(r)); };
  }
  explanation.remedy = misreading.remedy;
  explanation.rms_percent_as_given = RmsPercent(table, as_given, false);
  explanation.rms_percent = RmsPercent(table, candidate.lit, misreading.has_own_scale);
  explanation.places = table.groups;
  explanation.places_outside_as_given = PlacesOutside(table, as_given);
  explanation.places_outside = PlacesOutside(table, candidate.lit);
  return explanation;
}

}  // namespace

std::vector<ReadingExplanation> ExplainReadings(const ExplainingLight& light,
                                                const std::vector<ReadingAsGiven>& readings) {
  const ReadingTable table = TableOf(light, readings);
  const Rereading given;
  const Eigen::MatrixXd in_states = light.in_states(PlacesOf(table, given));
  const Eigen::VectorXd as_given = LitBy(table, given, in_states);
  const GroupScores scores = ScoresOf(table, as_given, false);
  if (scores.empty() || Mean(scores) <= kByChance) return {};
  const std::vector<Misreading> misreadings = Misreadings(light);
  std::vector<ReadingExplanation> explanations;
  for (const Candidate& c : Holding(table, JudgeAll(table, misreadings, in_states), scores))
    explanations.push_back(Explained(table, c, as_given));
  return explanations;
}

std::string InWords(const std::vector<ReadingExplanation>& explanations) {
  const ReadingExplanation& best = explanations.front();
  std::string text = "the readings look as if ";
  for (size_t i = 0; i < explanations.size(); ++i)
    text += (i > 0 ? ", or as if " : "") + explanations[i].as_if;
  if (explanations.size() > 1) text += ", which explain them equally";
  text += fmt::format(": so read, they are {:.1f} % off (rms), and ", best.rms_percent);
  text += std::isnan(best.rms_percent_as_given) ? std::string("as given nothing predicts them")
                                                : fmt::format("{:.0f} % as given", best.rms_percent_as_given);
  if (best.places_outside_as_given > best.places_outside)
    text += fmt::format("; {} of {} places lie outside the room as given, {} so read",
                        best.places_outside_as_given, best.places, best.places_outside);
  return text;
}

}  // namespace luxfit
