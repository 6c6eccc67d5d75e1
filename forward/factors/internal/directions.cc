#include "forward/factors/internal/directions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

class Collector {
 public:
  void Add(const Eigen::Vector3d& direction, double weight) {
    unit_.push_back(direction.normalized().cast<float>());
    weight_.push_back(static_cast<float>(weight));
  }
  void AddLifted(double radius2, double turns, double weight) { Add(LiftedFromDisc(radius2, turns), weight); }
  Directions Get() const {
    Directions set;
    set.unit.resize(3, static_cast<Eigen::Index>(unit_.size()));
    set.weight.resize(static_cast<Eigen::Index>(unit_.size()));
    for (size_t k = 0; k < unit_.size(); ++k) {
      set.unit.col(static_cast<Eigen::Index>(k)) = unit_[k];
      set.weight[static_cast<Eigen::Index>(k)] = weight_[k];
    }
    return set;
  }

 private:
  std::vector<Eigen::Vector3f> unit_;
  std::vector<float> weight_;
};

void AddMalley(int count, uint64_t variant, Collector& set) {
  // Dimensions 1 and 2 of the additive recurrence of the generalised golden ratio (x^5 = x + 1); 3 and 4 are
  // the origins.
  const double shift = UnitFrom(Mix(variant));
  for (int k = 1; k <= count; ++k) {
    set.AddLifted(Fraction(shift + 0.85667488385450287 * k), Fraction(0.73389185662660285 * k), 1.0 / count);
  }
}

void AddStratified(int count, uint64_t variant, Collector& set) {
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(count))));
  uint64_t state = Mix(variant);
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double s = UnitFrom(state = Mix(state)), t = UnitFrom(state = Mix(state));
      set.AddLifted((i + s) / side, (j + t) / side, 1.0 / (side * side));
    }
  }
}

void AddIsocell(int count, Collector& set) {
  const std::vector<Eigen::Vector2d> cells = Isocell(count);
  for (const Eigen::Vector2d& cell : cells)
    set.AddLifted(cell[0], cell[1], 1.0 / static_cast<double>(cells.size()));
}

void AddMonteCarlo(int count, uint64_t variant, Collector& set) {
  uint64_t state = Mix(variant);
  for (int k = 0; k < count; ++k) {
    const double cosine = UnitFrom(state = Mix(state)), angle = 2 * M_PI * UnitFrom(state = Mix(state));
    const double sine = std::sqrt(1 - cosine * cosine);
    set.Add({sine * std::cos(angle), sine * std::sin(angle), std::max(cosine, 1e-6)}, 2 * cosine / count);
  }
}

void AddHemicube(int count, Collector& set) {
  // Half-width and height 1, `side` x `side` pixels on top and half as many on each side: 3 side^2 in all.
  const int half = std::max(1, static_cast<int>(std::lround(std::sqrt(count / 12.0))));
  const double width = 1.0 / half, area = width * width;
  for (int i = -half; i < half; ++i) {
    const double x = (i + 0.5) * width;
    for (int j = -half; j < half; ++j) {
      const double y = (j + 0.5) * width, r2 = x * x + y * y + 1;
      set.Add({x, y, 1}, area / (M_PI * r2 * r2));
    }
    for (int j = 0; j < half; ++j) {
      const double z = (j + 0.5) * width, r2 = x * x + z * z + 1, delta = z * area / (M_PI * r2 * r2);
      set.Add({x, 1, z}, delta);
      set.Add({x, -1, z}, delta);
      set.Add({1, x, z}, delta);
      set.Add({-1, x, z}, delta);
    }
  }
}

// Configuration factor to a parallel rectangle with a corner overhead (Howell's catalogue, B-3), at distance
// 1; odd in both.
double CornerFactor(double a, double b) {
  const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
  return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * M_PI);
}

void AddSinglePlane(int count, Collector& set) {
  // Proxels wider towards the rim, where they count less: their borders are at equal steps of a / sqrt(1 +
  // a^2).
  constexpr double kHalfWidth = 10;
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(count))));
  const double reach = kHalfWidth / std::sqrt(1 + kHalfWidth * kHalfWidth);
  const auto border = [&](double i) {
    const double s = reach * (2.0 * i / side - 1);
    return s / std::sqrt(1 - s * s);
  };
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double x0 = border(i), x1 = border(i + 1), y0 = border(j), y1 = border(j + 1);
      const double factor =
          CornerFactor(x1, y1) - CornerFactor(x0, y1) - CornerFactor(x1, y0) + CornerFactor(x0, y0);
      set.Add({border(i + 0.5), border(j + 0.5), 1}, factor);
    }
  }
}

}  // namespace

Directions MakeDirections(FormFactorMethod method, int count, uint64_t variant) {
  Collector set;
  switch (method) {
    case FormFactorMethod::kMalley:
      AddMalley(count, variant, set);
      break;
    case FormFactorMethod::kMalleyStratified:
      AddStratified(count, variant, set);
      break;
    case FormFactorMethod::kIsocell:
      AddIsocell(count, set);
      break;
    case FormFactorMethod::kMonteCarlo:
      AddMonteCarlo(count, variant, set);
      break;
    case FormFactorMethod::kHemicube:
      AddHemicube(count, set);
      break;
    case FormFactorMethod::kSinglePlane:
      AddSinglePlane(count, set);
      break;
    case FormFactorMethod::kHybrid:
    case FormFactorMethod::kAnalytic:
    case FormFactorMethod::kWallace:
      throw std::invalid_argument("MakeDirections: " + ToString(method) + " casts no rays over a hemisphere");
  }
  return set.Get();
}

}  // namespace luxfit
