#include "inverse/study/degrade.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "forward/changes/pieces.h"

namespace luxfit {
namespace {

void ExpectNotNegative(double value, const char* what) {
  if (!(value >= 0)) throw std::invalid_argument(std::string(what) + ": expected >= 0");
}

void Scale(Observation& o, double factor) {
  o.relative_luminance *= factor;
  o.relative_rgb *= factor;
  o.variance *= factor * factor;
}

// Returns `count` of the values, drawn at random.
std::set<int> Draw(const std::set<int>& values, int count, std::mt19937_64& rng) {
  if (count < 0 || count > static_cast<int>(values.size()))
    throw std::invalid_argument("degrade: expected to leave out 0 to " + std::to_string(values.size()) +
                                ", got " + std::to_string(count));
  std::vector<int> order(values.begin(), values.end());
  std::shuffle(order.begin(), order.end(), rng);
  return {order.begin(), order.begin() + count};
}

// `of`: Observation::view or Observation::state.
std::set<int> Observed(const std::vector<Observation>& observations, int Observation::*of) {
  std::set<int> observed;
  for (const Observation& o : observations) observed.insert(o.*of);
  return observed;
}

std::vector<Observation> Without(int dropped, int Observation::*of, std::vector<Observation> observations,
                                 std::mt19937_64& rng) {
  const std::set<int> out = Draw(Observed(observations, of), dropped, rng);
  const auto is_out = [&](const Observation& o) { return out.count(o.*of) > 0; };
  observations.erase(std::remove_if(observations.begin(), observations.end(), is_out), observations.end());
  return observations;
}

}  // namespace

std::vector<Observation> WithPixelNoise(std::vector<Observation> observations, double relative_sigma,
                                        std::mt19937_64& rng) {
  ExpectNotNegative(relative_sigma, "WithPixelNoise: relative_sigma");
  std::normal_distribution<double> normal;
  for (Observation& o : observations) {
    const double sigma = relative_sigma / std::sqrt(std::max(1, o.pixels));
    const double before = o.relative_luminance;
    // Noise must not make a luminance negative: this is the darkest mean.
    const double factor = std::max(1e-3, 1 + sigma * normal(rng));
    o.relative_luminance *= factor;
    o.relative_rgb *= factor;
    o.variance += std::pow(sigma * before, 2);
  }
  return observations;
}

std::vector<Observation> WithExposureErrors(std::vector<Observation> observations, double log_sigma,
                                            std::mt19937_64& rng) {
  ExpectNotNegative(log_sigma, "WithExposureErrors: log_sigma");
  std::normal_distribution<double> normal;
  std::map<std::pair<int, int>, double> gains;
  for (const Observation& o : observations) gains[{o.view, o.state}] = 1;
  for (auto& [photo, gain] : gains) gain = std::exp(log_sigma * normal(rng));
  for (Observation& o : observations) Scale(o, gains.at({o.view, o.state}));
  return observations;
}

std::vector<Observation> WithoutViews(const std::vector<Observation>& observations, int dropped,
                                      std::mt19937_64& rng) {
  return Without(dropped, &Observation::view, observations, rng);
}

std::vector<Observation> WithoutStates(const std::vector<Observation>& observations, int dropped,
                                       std::mt19937_64& rng) {
  return Without(dropped, &Observation::state, observations, rng);
}

int CountViews(const std::vector<Observation>& observations) {
  return static_cast<int>(Observed(observations, &Observation::view).size());
}

int CountStates(const std::vector<Observation>& observations) {
  return static_cast<int>(Observed(observations, &Observation::state).size());
}

std::vector<SurveyedTag> WithMovedTags(std::vector<SurveyedTag> survey, double sigma_m,
                                       std::mt19937_64& rng) {
  ExpectNotNegative(sigma_m, "WithMovedTags: sigma_m");
  std::normal_distribution<double> normal;
  for (SurveyedTag& tag : survey) {
    for (int axis = 0; axis < 3; ++axis) tag.center_in_world[axis] += sigma_m * normal(rng);
  }
  return survey;
}

Scene WithoutPieces(const Scene& scene, int dropped, std::mt19937_64& rng) {
  const std::vector<std::vector<int>> pieces = LoosePieces(scene);
  std::set<int> all;
  for (size_t p = 0; p < pieces.size(); ++p) all.insert(static_cast<int>(p));
  std::vector<int> out;
  for (const int p : Draw(all, dropped, rng)) {
    const std::vector<int>& piece = pieces[static_cast<size_t>(p)];
    out.insert(out.end(), piece.begin(), piece.end());
  }
  return WithoutFacets(scene, out);
}

std::vector<Luminaire> WithLuminairesTogether(std::vector<Luminaire> luminaires, double distance_m) {
  ExpectNotNegative(distance_m, "WithLuminairesTogether: distance_m");
  if (luminaires.size() < 2)
    throw std::invalid_argument("WithLuminairesTogether: expected two luminaires or more");
  size_t first = 0, second = 1;
  const auto distance = [&](size_t a, size_t b) {
    return (luminaires[a].position - luminaires[b].position).norm();
  };
  for (size_t a = 0; a < luminaires.size(); ++a) {
    for (size_t b = a + 1; b < luminaires.size(); ++b) {
      if (distance(a, b) < distance(first, second)) first = a, second = b;
    }
  }
  Eigen::Vector3d &p = luminaires[first].position, &q = luminaires[second].position;
  const Eigen::Vector3d middle = 0.5 * (p + q);
  const Eigen::Vector3d along = (q - p).norm() > 0 ? (q - p).normalized() : Eigen::Vector3d::UnitX();
  p = middle - 0.5 * distance_m * along;
  q = middle + 0.5 * distance_m * along;
  return luminaires;
}

Eigen::VectorXd WithRaisedAlbedo(const Eigen::VectorXd& albedo, double share) {
  if (!(share >= 0 && share <= 1)) throw std::invalid_argument("WithRaisedAlbedo: expected a share in 0..1");
  constexpr double kWhite = 0.95;
  return albedo.unaryExpr([&](double rho) { return std::max(rho, rho + share * (kWhite - rho)); });
}

}  // namespace luxfit
