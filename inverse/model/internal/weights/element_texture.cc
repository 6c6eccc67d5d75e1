#include "inverse/model/internal/weights/element_texture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr size_t kFewestElements = 20;
constexpr double kLargestSigma = 1;
constexpr double kDarkest = -0.95;  // a black element has no ratio
// Strays of plain materials may be a luminaire before its ceiling: their light is not exchanged.
constexpr double kExchangedSigma = 0.03;

// Holds t_e as its own rows give it, and the variance of that.
struct OwnDeviation {
  double value = 0, variance = 0;
  bool is_known = false;  // by two states at least
};

OwnDeviation DeviationOf(const std::vector<Eigen::Index>& rows, const Eigen::VectorXd& model,
                         const Eigen::VectorXd& measured, const Eigen::VectorXd& root_weight) {
  double information = 0, gradient = 0;
  int used = 0;
  for (const Eigen::Index i : rows) {
    if (!(root_weight[i] > 0)) continue;
    const double u = root_weight[i] * model[i];
    information += u * u;
    gradient += u * root_weight[i] * (measured[i] - model[i]);
    ++used;
  }
  if (!(information > 0)) return {};
  return {gradient / information, 1 / information, used >= 2};
}

double MedianZ(const std::vector<OwnDeviation>& deviations, double centre, double tau) {
  std::vector<double> z;
  z.reserve(deviations.size());
  for (const OwnDeviation& d : deviations)
    z.push_back(std::abs(d.value - centre) / std::sqrt(tau * tau + d.variance));
  return kSigmaPerMad * Median(std::move(z));
}

double CentreOf(const std::vector<OwnDeviation>& deviations) {
  std::vector<double> values;
  values.reserve(deviations.size());
  for (const OwnDeviation& d : deviations) values.push_back(d.value);
  return Median(std::move(values));
}

// Returns whether at least half of the elements, all but strays, scatter no more than their own rows' errors
// say.
bool IsPlain(const std::vector<OwnDeviation>& deviations, double centre) {
  std::vector<OwnDeviation> near;
  near.reserve(deviations.size());
  for (const OwnDeviation& d : deviations) {
    const double off = d.value - centre;
    if (off * off <= kStraySigmas * kStraySigmas * d.variance) near.push_back(d);
  }
  if (2 * near.size() < deviations.size()) return false;
  // The standard error of the median of |z|, over that median, is 1.17 / sqrt(n); 2.33: one-sided 99 %.
  const double chance = 2.33 * 1.17 / std::sqrt(static_cast<double>(near.size()));
  return MedianZ(near, CentreOf(near), 0) < 1 + chance;
}

double SigmaOf(const std::vector<OwnDeviation>& deviations) {
  if (deviations.size() < kFewestElements) return 0;
  const double centre = CentreOf(deviations);  // an error of the reflectance is not texture
  if (IsPlain(deviations, centre)) return 0;
  double low = 0, high = kLargestSigma;
  constexpr double kTolerance = 1e-4;
  while (high - low > kTolerance) {
    const double middle = 0.5 * (low + high);
    (MedianZ(deviations, centre, middle) > 1 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

TextureEstimator::TextureEstimator(const Room& room, const LightData& data)
    : materials_(static_cast<Eigen::Index>(room.scene.materials.size())) {
  std::map<int, size_t> place;
  for (size_t i = 0; i < data.observations.size(); ++i) {
    const int element = data.observations[i].element;
    const auto [at, is_new] = place.try_emplace(element, rows_.size());
    if (is_new) {
      rows_.emplace_back();
      material_.push_back(room.patches.PatchOf(element).material);
      patch_.push_back(room.patches.elements[static_cast<size_t>(element)].patch);
    }
    rows_[at->second].push_back(static_cast<Eigen::Index>(i));
    has_several_states_ = has_several_states_ || !is_new;
  }
}

ElementTexture TextureEstimator::None(Eigen::Index rows, Eigen::Index materials) {
  return {Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Zero(materials)};
}

ElementTexture TextureEstimator::Estimate(const Eigen::VectorXd& model, const Eigen::VectorXd& measured,
                                          const Eigen::VectorXd& root_weight) const {
  if (!has_several_states_) return None(model.size(), materials_);
  std::vector<OwnDeviation> own;
  own.reserve(rows_.size());
  std::vector<std::vector<OwnDeviation>> of_material(static_cast<size_t>(materials_));
  for (size_t e = 0; e < rows_.size(); ++e) {
    own.push_back(DeviationOf(rows_[e], model, measured, root_weight));
    if (own.back().is_known) of_material[static_cast<size_t>(material_[e])].push_back(own.back());
  }
  ElementTexture texture = None(model.size(), materials_);
  for (Eigen::Index m = 0; m < materials_; ++m)
    texture.sigma_of_material[m] = SigmaOf(of_material[static_cast<size_t>(m)]);
  for (size_t e = 0; e < rows_.size(); ++e) {
    const double tau = texture.sigma_of_material[material_[e]];
    const double expected = tau * tau + own[e].variance, t2 = own[e].value * own[e].value;
    double variance = tau * tau;
    if (own[e].is_known && t2 > kStraySigmas * kStraySigmas * expected)
      variance += t2 / (kStraySigmas * kStraySigmas) - expected;
    if (!(variance > 0)) continue;
    const double deviation = std::max(kDarkest, own[e].value * variance / (variance + own[e].variance));
    for (const Eigen::Index i : rows_[e]) {
      texture.deviation[i] = deviation;
      texture.sigma[i] = std::sqrt(variance);
    }
  }
  return texture;
}

Eigen::VectorXd TextureEstimator::PatchFactors(const Room& room, const ElementTexture& texture) const {
  const auto patches = static_cast<Eigen::Index>(room.patches.patches.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(patches), count = sum;
  for (size_t e = 0; e < rows_.size(); ++e) {
    if (texture.sigma_of_material[material_[e]] < kExchangedSigma) continue;
    sum[patch_[e]] += texture.deviation[rows_[e].front()];
    count[patch_[e]] += 1;
  }
  const Eigen::VectorXd departure = sum.cwiseQuotient(count.cwiseMax(1));
  const Eigen::VectorXd area_m2 = room.transport.patch_area_m2.cast<double>();
  if (departure.cwiseAbs().dot(area_m2) < kLeastDeparture * area_m2.sum()) return {};
  return (1 + departure.array()).max(0);
}

std::vector<TextureMean> TextureEstimator::Means(const Eigen::VectorXd& model,
                                                 const Eigen::VectorXd& root_weight,
                                                 const ElementTexture& texture) const {
  std::vector<TextureMean> means(static_cast<size_t>(materials_));
  std::vector<double> variance(static_cast<size_t>(materials_), 0);
  for (size_t e = 0; e < rows_.size(); ++e) {
    const Eigen::Index first = rows_[e].front();
    const auto material = static_cast<size_t>(material_[e]);
    const double tau = texture.sigma_of_material[material_[e]];
    if (!(tau > 0)) continue;
    double information = 1 / std::pow(texture.sigma[first], 2);
    for (const Eigen::Index i : rows_[e]) information += std::pow(root_weight[i] * model[i], 2);
    variance[material] += 1 / information;
    for (const Eigen::Index i : rows_[e]) {
      if (root_weight[i] > 0) means[material].terms.emplace_back(i, root_weight[i] * model[i] / information);
    }
  }
  for (size_t m = 0; m < means.size(); ++m) {
    for (auto& [row, coefficient] : means[m].terms) coefficient /= std::sqrt(variance[m]);
  }
  means.erase(
      std::remove_if(means.begin(), means.end(), [](const TextureMean& mean) { return mean.terms.empty(); }),
      means.end());
  return means;
}

}  // namespace luxfit
