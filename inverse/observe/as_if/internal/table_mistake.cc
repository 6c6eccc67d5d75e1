#include "inverse/observe/as_if/internal/table_mistake.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "calib/luminance/weighted_median.h"

namespace luxfit {
namespace {

constexpr double kLeastChange = 0.1;
constexpr double kGreatest = 1.05;  // 1 is all that a luminaire gives

class MistakeList {
 public:
  MistakeList(const StateTable& table, const SuperposedColumns& columns, const Eigen::MatrixXd& dimming)
      : table_(table), columns_(columns), dimming_(dimming), units_(UnitsOf(dimming)) {}

  std::vector<TableMistake> Make() {
    for (Eigen::Index s = 0; s < dimming_.rows(); ++s) {
      AddExchangedStates(s);
      AddExchangedLuminaires(s);
      AddValues(s);
    }
    return std::move(mistakes_);
  }

 private:
  // Returns luminaires with equal columns together; those that are off in all states are left out.
  static std::vector<std::vector<Eigen::Index>> UnitsOf(const Eigen::MatrixXd& dimming) {
    std::vector<std::vector<Eigen::Index>> units;
    for (Eigen::Index k = 0; k < dimming.cols(); ++k) {
      if (dimming.col(k).isZero()) continue;
      bool is_new = true;
      for (auto& unit : units) {
        if (dimming.col(unit.front()) != dimming.col(k)) continue;
        unit.push_back(k);
        is_new = false;
      }
      if (is_new) units.push_back({k});
    }
    return units;
  }

  const std::string& StateName(Eigen::Index row) const {
    return table_.states[static_cast<size_t>(columns_.states[static_cast<size_t>(row)])];
  }

  std::string UnitName(const std::vector<Eigen::Index>& unit) const {
    std::vector<std::string> names;
    names.reserve(unit.size());
    for (const Eigen::Index k : unit) names.push_back(table_.luminaires[static_cast<size_t>(k)]);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  void AddExchangedStates(Eigen::Index a) {
    for (Eigen::Index b = a + 1; b < dimming_.rows(); ++b) {
      if (dimming_.row(a) == dimming_.row(b)) continue;
      TableMistake mistake{
          fmt::format("states {} and {} were exchanged", StateName(a), StateName(b)),
          fmt::format("exchange {} and {} in the photo table, or in [states]", StateName(a), StateName(b)),
          dimming_};
      mistake.dimming.row(a).swap(mistake.dimming.row(b));
      mistakes_.push_back(std::move(mistake));
    }
  }

  void AddExchangedLuminaires(Eigen::Index s) {
    for (size_t a = 0; a < units_.size(); ++a) {
      for (size_t b = a + 1; b < units_.size(); ++b) {
        const double of_a = dimming_(s, units_[a].front()), of_b = dimming_(s, units_[b].front());
        if (of_a == of_b) continue;
        const std::string name_a = UnitName(units_[a]), name_b = UnitName(units_[b]);
        TableMistake mistake{
            fmt::format("{} and {} were exchanged in state {}", name_a, name_b, StateName(s)),
            fmt::format("exchange {} and {} in {} of [states]", name_a, name_b, StateName(s)), dimming_};
        for (const Eigen::Index k : units_[a]) mistake.dimming(s, k) = of_b;
        for (const Eigen::Index k : units_[b]) mistake.dimming(s, k) = of_a;
        mistakes_.push_back(std::move(mistake));
      }
    }
  }

  void AddValues(Eigen::Index s) {
    Eigen::MatrixXd of_units(dimming_.rows(), static_cast<Eigen::Index>(units_.size()));
    for (Eigen::Index u = 0; u < of_units.cols(); ++u)
      of_units.col(u) = dimming_.col(units_[static_cast<size_t>(u)].front());
    const Eigen::RowVectorXd given = of_units.row(s);
    Eigen::MatrixXd others = of_units;
    others.row(s).setZero();
    if (RankOf(others) < of_units.cols()) return;  // the other states do not tell the luminaires apart
    const Eigen::MatrixXd light = LightWithout(columns_, of_units, s);
    const Eigen::RowVectorXd predicted = given * light;
    AddFactor(s, predicted);
    for (Eigen::Index u = 0; u < of_units.cols(); ++u) {
      if (!(given[u] > 0 && IsAlone(given))) AddValue(s, u, light.row(u), predicted);
    }
  }

  // Returns whether nothing but one unit is on: its value is the state's factor.
  static bool IsAlone(const Eigen::RowVectorXd& given) { return (given.array() > 0).count() == 1; }

  void AddFactor(Eigen::Index s, const Eigen::RowVectorXd& predicted) {
    std::vector<std::pair<double, double>> ratios;
    for (Eigen::Index c = 0; c < predicted.size(); ++c)
      if (predicted[c] > 0)
        ratios.emplace_back(columns_.luminance(s, c) / predicted[c], predicted[c] / columns_.sigma(s, c));
    const double factor = WeightedMedian(std::move(ratios));
    if (!(std::abs(factor - 1) >= kLeastChange)) return;
    TableMistake mistake{
        fmt::format("all of state {} gave {:.2f} times the light, or its exposures were so much longer than "
                    "stated",
                    StateName(s), factor),
        fmt::format("write {:.2f} times the values of {} in [states], or check the exposures of its photos",
                    factor, StateName(s)),
        dimming_, true};
    mistake.dimming.row(s) *= factor;
    mistakes_.push_back(std::move(mistake));
  }

  void AddValue(Eigen::Index s, Eigen::Index u, const Eigen::RowVectorXd& light,
                const Eigen::RowVectorXd& predicted) {
    const std::vector<Eigen::Index>& unit = units_[static_cast<size_t>(u)];
    const double given = dimming_(s, unit.front());
    std::vector<std::pair<double, double>> values;
    for (Eigen::Index c = 0; c < light.size(); ++c)
      if (light[c] > 0)
        values.emplace_back(given + (columns_.luminance(s, c) - predicted[c]) / light[c],
                            light[c] / columns_.sigma(s, c));
    double value = WeightedMedian(std::move(values));
    if (std::abs(value) < kLeastChange / 2) value = 0;
    if (!(std::abs(value - given) >= kLeastChange) || value < 0 || value > kGreatest) return;
    TableMistake mistake{ValueWords(s, unit, given, value), ValueRemedy(s, unit, value), dimming_};
    for (const Eigen::Index k : unit) mistake.dimming(s, k) = value;
    mistakes_.push_back(std::move(mistake));
  }

  std::string ValueWords(Eigen::Index s, const std::vector<Eigen::Index>& unit, double given,
                         double value) const {
    const std::string what =
        value == 0 ? "off"
                   : (given == 0 ? fmt::format("on at {:.2f}", value) : fmt::format("at {:.2f}", value));
    return fmt::format("{} {} {} in state {}, where [states] has {}", UnitName(unit),
                       unit.size() > 1 ? "were" : "was", what, StateName(s),
                       given == 0 ? "it off" : fmt::format("{:.2f}", given));
  }

  std::string ValueRemedy(Eigen::Index s, const std::vector<Eigen::Index>& unit, double value) const {
    return value == 0
               ? fmt::format("take {} out of {} in [states]", UnitName(unit), StateName(s))
               : fmt::format("write {:.2f} for {} in {} of [states]", value, UnitName(unit), StateName(s));
  }

  const StateTable& table_;
  const SuperposedColumns& columns_;
  const Eigen::MatrixXd& dimming_;
  const std::vector<std::vector<Eigen::Index>> units_;
  std::vector<TableMistake> mistakes_;
};

}  // namespace

std::vector<TableMistake> TableMistakes(const StateTable& table, const SuperposedColumns& columns,
                                        const Eigen::MatrixXd& dimming) {
  return MistakeList(table, columns, dimming).Make();
}

}  // namespace luxfit
