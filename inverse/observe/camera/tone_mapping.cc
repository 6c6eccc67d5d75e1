#include "inverse/observe/camera/tone_mapping.h"

#include <array>
#include <utility>

#include "inverse/observe/camera/internal/view_slope.h"

namespace luxfit {
namespace {

constexpr double kTolerance = 1e-4;  // of k

// Returns the differences of ln surroundings of one size, an index into kSurroundSigmas.
std::vector<double> SurroundDifferences(const PhotoPair& pair, const std::vector<Surround::Values>& surround,
                                        size_t size) {
  std::vector<double> differences;
  differences.reserve(pair.shared.size());
  for (const auto& [a, b] : pair.shared)
    differences.push_back((surround[a] - surround[b])[static_cast<Eigen::Index>(size)]);
  return differences;
}

std::optional<ToneMapping> BySurround(const std::vector<PhotoPair>& pairs,
                                      const std::vector<std::vector<double>>& log_ratios,
                                      const std::vector<Surround::Values>& surround, size_t size) {
  std::vector<std::vector<double>> differences;
  differences.reserve(pairs.size());
  for (const PhotoPair& pair : pairs) differences.push_back(SurroundDifferences(pair, surround, size));
  const auto found = SlopeOverViews(pairs, log_ratios, std::move(differences), kTolerance);
  if (!found) return std::nullopt;
  return ToneMapping{-found->slope, found->sigma, found->views, found->spread, found->spread_without};
}

std::optional<ToneMapping> ToneMappingOf(const std::vector<Observation>& observations,
                                         const std::vector<Surround::Values>& surround,
                                         const std::vector<PhotoPair>& pairs) {
  std::vector<std::vector<double>> log_ratios;
  log_ratios.reserve(pairs.size());
  for (const PhotoPair& pair : pairs) log_ratios.push_back(LogRatios(pair, observations));
  const auto near = BySurround(pairs, log_ratios, surround, 0),
             far = BySurround(pairs, log_ratios, surround, 1);
  if (!near || !far) return std::nullopt;
  return near->strength * far->sigma >= far->strength * near->sigma ? near : far;
}

}  // namespace

std::vector<std::optional<ToneMapping>> FindToneMapping(const std::vector<Observation>& observations,
                                                        const std::vector<Surround::Values>& surround,
                                                        const std::vector<int>& camera_of_view, int cameras) {
  std::vector<std::optional<ToneMapping>> found;
  found.reserve(static_cast<size_t>(cameras));
  for (int camera = 0; camera < cameras; ++camera)
    found.push_back(ToneMappingOf(observations, surround, PairViews(observations, camera_of_view, camera)));
  return found;
}

}  // namespace luxfit
