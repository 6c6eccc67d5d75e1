#include "forward/luminaire/internal/direction_sampler.h"

#include <algorithm>
#include <cmath>

#include "forward/luminaire/distribution_ops.h"

namespace luxfit {
namespace {

constexpr size_t kBands = 360, kSectors = 72;
constexpr double kBandRad = M_PI / kBands;

Eigen::Vector3d DirectionOf(const Eigen::Vector3d& aim, const LuminaireAxes& axes, double cosine,
                            double c_rad) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return sine * (std::cos(c_rad) * axes.along + std::sin(c_rad) * axes.across) + cosine * aim;
}

// Holds the interval of a rising list of shares that a number falls into, and how far into it.
struct Drawn {
  size_t cell = 0;
  double within = 0;
};
template <typename Iterator>
Drawn Draw(Iterator first, Iterator last, double unit) {
  const Iterator above = std::upper_bound(first, last - 1, unit);
  const double before = above == first ? 0 : *(above - 1), share = *above - before;
  return {static_cast<size_t>(above - first), share > 0 ? std::min((unit - before) / share, 1.0) : 0.5};
}

}  // namespace

DirectionSampler::DirectionSampler(const Luminaire& luminaire)
    : aim_(luminaire.aim), axes_(AxesOf(luminaire)), sectors_(AboutAimOf(luminaire) ? 1 : kSectors) {
  const double sector_rad = 2 * M_PI / static_cast<double>(sectors_);
  const auto towards = OpsOf(luminaire.distribution).towards;
  for (size_t i = 0; i <= kBands; ++i) edge_cosine_.push_back(std::cos(static_cast<double>(i) * kBandRad));
  double total = 0;
  for (size_t i = 0; i < kBands; ++i) {
    const double centre = std::cos((static_cast<double>(i) + 0.5) * kBandRad);
    const double cell_sr = (edge_cosine_[i] - edge_cosine_[i + 1]) * sector_rad;
    double in_band = 0;
    for (size_t j = 0; j < sectors_; ++j) {
      const double c_rad = (static_cast<double>(j) + 0.5) * sector_rad;
      density_.push_back(towards(luminaire, axes_, DirectionOf(aim_, axes_, centre, c_rad)).cd_per_lm);
      in_band += density_.back() * cell_sr;
      share_within_band_.push_back(in_band);
    }
    for (size_t j = 0; in_band > 0 && j < sectors_; ++j) share_within_band_[i * sectors_ + j] /= in_band;
    total += in_band;
    band_share_.push_back(total);
  }
  if (!(total > 0)) return;
  for (double& density : density_) density /= total;
  for (double& share : band_share_) share /= total;
}

Eigen::Vector3d DirectionSampler::DirectionAt(const Eigen::Vector2d& unit) const {
  const Drawn band = Draw(band_share_.begin(), band_share_.end(), unit[0]);
  const auto first = share_within_band_.begin() + static_cast<std::ptrdiff_t>(band.cell * sectors_);
  const Drawn sector = Draw(first, first + static_cast<std::ptrdiff_t>(sectors_), unit[1]);
  const double cosine =
      edge_cosine_[band.cell] + band.within * (edge_cosine_[band.cell + 1] - edge_cosine_[band.cell]);
  const double c_rad =
      2 * M_PI * (static_cast<double>(sector.cell) + sector.within) / static_cast<double>(sectors_);
  return DirectionOf(aim_, axes_, cosine, c_rad);
}

double DirectionSampler::Density(const Eigen::Vector3d& direction) const {
  const double cosine = std::clamp(aim_.dot(direction), -1.0, 1.0);
  const size_t band = std::min(static_cast<size_t>(std::acos(cosine) / kBandRad), kBands - 1);
  if (sectors_ == 1) return density_[band];
  const double turns = std::atan2(axes_.across.dot(direction), axes_.along.dot(direction)) / (2 * M_PI);
  const double part = (turns < 0 ? turns + 1 : turns) * static_cast<double>(sectors_);
  return density_[band * sectors_ + std::min(static_cast<size_t>(part), sectors_ - 1)];
}

}  // namespace luxfit
