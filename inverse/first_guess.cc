#include "inverse/first_guess.h"

#include <tbb/parallel_for.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "forward/direct_light.h"

namespace luxfit {
namespace {

// Light of one luminaire at one place: luminance of a material's element, or (material -1) illuminance at a
// sensor.
struct Sample {
  Sensor place;
  int material;
  double value;
  double weight;
};

struct Measurement {
  int state;
  double value;
};

// Shares what was measured at one place in several states out among the luminaires.
void Separate(const std::vector<Measurement>& list, const std::vector<Eigen::VectorXd>& states, Sample sample,
              std::vector<std::vector<Sample>>& samples) {
  const Eigen::Index lamps = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixXd dimming(static_cast<Eigen::Index>(list.size()), lamps);
  Eigen::VectorXd values(dimming.rows());
  for (Eigen::Index i = 0; i < dimming.rows(); ++i) {
    const Measurement& measured = list[static_cast<size_t>(i)];
    const double weight = 1 / std::max(1e-12, measured.value);  // equal relative errors
    dimming.row(i) = weight * states[static_cast<size_t>(measured.state)].transpose();
    values[i] = weight * measured.value;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(dimming);
  const auto add = [&](Eigen::Index k, double value) {
    sample.value = value;
    if (value > 0) samples[static_cast<size_t>(k)].push_back(sample);
  };
  if (qr.rank() == lamps) {
    const Eigen::VectorXd own = qr.solve(values);
    for (Eigen::Index k = 0; k < lamps; ++k) add(k, own[k]);
    return;
  }
  // Not all states show this place: take those luminaires that were on alone.
  for (const Measurement& measured : list) {
    const Eigen::VectorXd& d = states[static_cast<size_t>(measured.state)];
    Eigen::Index k = 0;
    const double most = d.maxCoeff(&k);
    if (most > 0 && d.sum() == most) add(k, measured.value / most);
  }
}

std::vector<std::vector<Sample>> SeparateLuminaires(const Room& room, const LightData& data, int lamps) {
  std::vector<std::vector<Sample>> samples(static_cast<size_t>(lamps));
  std::map<int, std::vector<Measurement>> by_element;
  for (const Observation& o : data.observations)
    by_element[o.element].push_back({o.state, o.relative_luminance});
  for (const auto& [index, list] : by_element) {
    const Element& element = room.patches.elements[static_cast<size_t>(index)];
    const int material = room.patches.patches[static_cast<size_t>(element.patch)].material;
    Separate(list, data.dimming, {{element.center, element.normal}, material, 0, 1}, samples);
  }
  // Photos, where there are any, see far more than the few readings, in another unit.
  if (!data.observations.empty()) return samples;
  std::map<std::array<double, 6>, std::vector<const Reading*>> by_sensor;
  for (const Reading& r : data.readings) {
    const Eigen::Vector3d &p = r.sensor.position, &n = r.sensor.normal;
    if (r.used) by_sensor[{p.x(), p.y(), p.z(), n.x(), n.y(), n.z()}].push_back(&r);
  }
  for (const auto& [key, list] : by_sensor) {
    std::vector<Measurement> measured;
    for (const Reading* r : list) measured.push_back({r->state, r->illuminance_lx});
    Separate(measured, data.dimming, {list.front()->sensor, -1, 0, 1}, samples);
  }
  return samples;
}

std::vector<Sample> Thin(std::vector<Sample> samples, int most) {
  const size_t stride = std::max<size_t>(1, samples.size() / static_cast<size_t>(most));
  std::vector<Sample> thin;
  double mean = 0;
  for (size_t i = 0; i < samples.size(); i += stride) {
    thin.push_back(samples[i]);
    mean += samples[i].value;
  }
  mean /= static_cast<double>(thin.size());
  // Relative errors of 10 %, and a floor where there is little light.
  for (Sample& s : thin) s.weight = 1 / std::pow(0.1 * s.value + 0.02 * mean, 2);
  return thin;
}

struct Candidate {
  Eigen::Vector3d position;
  Distribution distribution = Distribution::kIsotropic;
  double exponent = 1;
  double cost = std::numeric_limits<double>::infinity();
  std::map<int, Eigen::Vector2d> line;  // by material: a, b
};

// min |a d + b - y|^2 weighted, a, b >= 0: the free optimum, or the better edge.
Eigen::Vector2d NonNegativeLine(double dd, double d1, double one, double dy, double y1) {
  const double det = dd * one - d1 * d1;
  if (det > 1e-12 * dd * one) {
    Eigen::Vector2d both((one * dy - d1 * y1) / det, (dd * y1 - d1 * dy) / det);
    if (both.minCoeff() >= 0) return both;
  }
  const double gain_slope = dd > 0 ? dy * dy / dd : 0, gain_level = y1 * y1 / one;
  return gain_slope > gain_level ? Eigen::Vector2d(dy / dd, 0) : Eigen::Vector2d(0, y1 / one);
}

void Score(const std::vector<Sample>& samples, const std::vector<double>& direct, Candidate& candidate) {
  struct Sums {
    double dd = 0, d1 = 0, one = 0, dy = 0, y1 = 0, yy = 0;
  };
  std::map<int, Sums> sums;
  for (size_t i = 0; i < samples.size(); ++i) {
    const double w = samples[i].weight, y = samples[i].value, d = direct[i];
    Sums& s = sums[samples[i].material];
    s.dd += w * d * d, s.d1 += w * d, s.one += w, s.dy += w * d * y, s.y1 += w * y, s.yy += w * y * y;
  }
  candidate.cost = 0;
  for (const auto& [material, s] : sums) {
    const Eigen::Vector2d ab = NonNegativeLine(s.dd, s.d1, s.one, s.dy, s.y1);
    candidate.line[material] = ab;
    candidate.cost += s.yy + ab[0] * ab[0] * s.dd + ab[1] * ab[1] * s.one +
                      2 * (ab[0] * ab[1] * s.d1 - ab[0] * s.dy - ab[1] * s.y1);
  }
}

struct Lobe {
  Distribution distribution;
  double exponent;
};
constexpr Lobe kLobes[] = {{Distribution::kIsotropic, 0},
                           {Distribution::kCosinePower, 1},
                           {Distribution::kCosinePower, 3},
                           {Distribution::kCosinePower, 8}};
using Candidates = std::array<Candidate, std::size(kLobes)>;  // one a lobe

Candidates CandidatesAt(const Room& room, const std::vector<Sample>& samples,
                        const Eigen::Vector3d& position) {
  Luminaire lamp;
  lamp.position = position;
  std::vector<bool> visible(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    const Sensor& place = samples[i].place;
    visible[i] = VisibleFraction(room.rays, lamp, place.position, place.normal, 1) > 0;
  }
  Candidates candidates;
  for (size_t l = 0; l < candidates.size(); ++l) {
    lamp.distribution = kLobes[l].distribution;
    lamp.cosine_exponent = kLobes[l].exponent;
    std::vector<double> direct(samples.size(), 0);
    for (size_t i = 0; i < samples.size(); ++i) {
      if (!visible[i]) continue;
      const Sensor& place = samples[i].place;
      // A candidate close to a surface must not win by one enormous value.
      if ((position - place.position).norm() < 0.1) continue;
      direct[i] = DirectIlluminancePerLumen(lamp, place.position, place.normal).lx_per_lm;
    }
    candidates[l] = {position, lamp.distribution, std::max(lamp.cosine_exponent, 1.0), 0, {}};
    Score(samples, direct, candidates[l]);
  }
  return candidates;
}

// The best place for every lobe.
Candidates Best(const Room& room, const std::vector<Sample>& samples,
                const std::vector<Eigen::Vector3d>& places) {
  std::vector<Candidates> at(places.size());
  tbb::parallel_for(size_t{0}, places.size(),
                    [&](size_t i) { at[i] = CandidatesAt(room, samples, places[i]); });
  Candidates best;
  for (const Candidates& candidates : at) {
    for (size_t l = 0; l < best.size(); ++l) {
      if (candidates[l].cost < best[l].cost) best[l] = candidates[l];
    }
  }
  return best;
}

// Cell centres of a grid through the box, so that none lies on a wall.
std::vector<Eigen::Vector3d> GridThrough(const Eigen::AlignedBox3d& box, double step) {
  const Eigen::Array3i n = (box.sizes().array() / step).ceil().cast<int>().max(1);
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < n[0]; ++i) {
    for (int j = 0; j < n[1]; ++j) {
      for (int k = 0; k < n[2]; ++k) {
        const Eigen::Array3d at = (Eigen::Array3d(i, j, k) + 0.5) / n.cast<double>();
        places.push_back(box.min() + (at * box.sizes().array()).matrix());
      }
    }
  }
  return places;
}

// The room; without a mesh, the box of the sensors, as far again to every side.
Eigen::AlignedBox3d SearchBox(const Room& room, const std::vector<Sample>& samples) {
  Eigen::AlignedBox3d box = room.scene.Bounds();
  if (!box.isEmpty()) return box;
  for (const Sample& sample : samples) box.extend(sample.place.position);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(box.sizes().maxCoeff());
  return {box.min() - margin, box.max() + margin};
}

Candidate Locate(const Room& room, const std::vector<Sample>& samples, const FirstGuessOptions& options) {
  const Eigen::AlignedBox3d box = SearchBox(room, samples);
  double step = std::min(options.grid_m, box.sizes().maxCoeff() / 8);
  Candidates best = Best(room, samples, GridThrough(box, step));
  // Each lobe by itself: on the coarse grid a wrong one may win, with the height wrong to match.
  for (int r = 0; r < options.refinements; ++r) {
    step *= 0.5;
    for (size_t l = 0; l < best.size(); ++l) {
      std::vector<Eigen::Vector3d> places;
      for (int i = 0; i < 27; ++i) {
        const Eigen::Vector3d offset = Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).cast<double>();
        const Eigen::Vector3d inner = Eigen::Vector3d::Constant(5e-3);
        places.push_back(
            (best[l].position + step * offset).cwiseMax(box.min() + inner).cwiseMin(box.max() - inner));
      }
      best[l] = Best(room, samples, places)[l];
    }
  }
  return *std::min_element(best.begin(), best.end(),
                           [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
}

// Step 3: reflectances and flux from the lines a_m D + b_m of all luminaires.
void ShareOutAlbedo(const Room& room, const std::vector<Candidate>& best, FirstGuess& guess) {
  double area = 0;
  for (const Patch& patch : room.patches.patches) area += patch.area_m2;
  std::vector<double> ratios;
  for (const Candidate& c : best) {
    for (const auto& [material, ab] : c.line) {
      if (ab[0] > 0 && ab[1] > 0) ratios.push_back(ab[1] / ab[0] * area);
    }
  }
  double ratio = 1;  // as much indirect as rho = 0.5 gives
  if (!ratios.empty()) {
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2),
                     ratios.end());
    ratio = ratios[ratios.size() / 2];
  }
  const double mean_albedo = std::clamp(ratio / (1 + ratio), 0.1, 0.8);
  // a_m of each luminaire relative to its mean over the materials; the geometric mean over luminaires.
  const Eigen::Index materials = static_cast<Eigen::Index>(room.scene.materials.size());
  Eigen::VectorXd log_sum = Eigen::VectorXd::Zero(materials), count = log_sum;
  for (size_t k = 0; k < best.size(); ++k) {
    double sum = 0, n = 0;
    for (const auto& [material, ab] : best[k].line) {
      if (ab[0] > 0) sum += ab[0], n += 1;
    }
    for (const auto& [material, ab] : best[k].line) {
      if (ab[0] <= 0 || material < 0) continue;
      log_sum[material] += std::log(ab[0] * n / sum);
      count[material] += 1;
    }
    // Photos: a = rho Phi / pi at camera scale 1. Readings: a = Phi.
    const bool readings = best[k].line.count(-1) > 0;
    guess.luminaires[k].flux = n > 0 ? (readings ? 1 : 3.14159265358979323846 / mean_albedo) * sum / n : 1;
  }
  guess.albedo = Eigen::VectorXd::Constant(materials, 0.5);
  for (Eigen::Index m = 0; m < materials; ++m) {
    if (count[m] > 0) guess.albedo[m] = std::clamp(mean_albedo * std::exp(log_sum[m] / count[m]), 0.05, 0.9);
  }
}

}  // namespace

FirstGuess GuessLuminaires(const Room& room, const LightData& data, const FirstGuessOptions& options) {
  FirstGuess guess;
  const int lamps = data.dimming.empty() ? 0 : static_cast<int>(data.dimming[0].size());
  Eigen::MatrixXd table = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(data.dimming.size()), lamps);
  for (const Observation& o : data.observations) {
    table.row(o.state) = data.dimming[static_cast<size_t>(o.state)].transpose();
  }
  for (const Reading& r : data.readings) {
    if (r.used && data.observations.empty())
      table.row(r.state) = data.dimming[static_cast<size_t>(r.state)].transpose();
  }
  guess.luminaires.resize(static_cast<size_t>(lamps));
  guess.albedo = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(room.scene.materials.size()), 0.5);
  guess.separable = lamps > 0 && Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(table).rank() == lamps;
  if (!guess.separable) {
    guess.message = "the photographed states do not tell the luminaires apart";
    return guess;
  }
  std::vector<Candidate> best;
  std::vector<std::vector<Sample>> samples = SeparateLuminaires(room, data, lamps);
  for (int k = 0; k < lamps; ++k) {
    std::vector<Sample>& own = samples[static_cast<size_t>(k)];
    LuminaireGuess& luminaire = guess.luminaires[static_cast<size_t>(k)];
    best.emplace_back();
    if (own.size() < 20) continue;  // too little light seen to place it
    own = Thin(std::move(own), options.max_elements);
    best.back() = Locate(room, own, options);
    luminaire.found = true;
    luminaire.position = best.back().position;
    luminaire.distribution = best.back().distribution;
    luminaire.cosine_exponent = best.back().exponent;
    luminaire.relative_residual = 0.1 * std::sqrt(best.back().cost / static_cast<double>(own.size()));
  }
  ShareOutAlbedo(room, best, guess);
  return guess;
}

}  // namespace luxfit
