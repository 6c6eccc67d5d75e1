#include "inverse/fit/internal/light_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace luxfit {
namespace {

// White and grey paints depart from equal reflectance by a few percent in blue (CIELAB b* to 3), pressed boards as well.
constexpr double kNeutralSigma = 0.03;

// Returns the mean of the values between the quartiles. Under lamps of two colours, ratios have two heaps, and a median may stand on
// either.
double MiddleHalfMean(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto quarter = static_cast<std::ptrdiff_t>(values.size() / 4);
  const double sum = std::accumulate(values.begin() + quarter, values.end() - quarter, 0.0);
  return sum / static_cast<double>(values.size() - 2 * static_cast<size_t>(quarter));
}

bool IsNeutral(const RoomObservations& given, int material) {
  return std::find(given.neutral.begin(), given.neutral.end(), material) != given.neutral.end();
}

int MaterialOf(const Room& room, const Observation& o) { return room.patches.PatchOf(o.element).material; }

bool IsSeen(const Room& room, const RoomObservations& given, int material) {
  return std::any_of(given.observations.begin(), given.observations.end(),
                     [&](const Observation& o) { return MaterialOf(room, o) == material; });
}

// Returns r: the mean over neutral materials whose colour was estimated; ones where that of none was.
Eigen::Vector3d LeftOfNeutral(const RoomObservations& given, const RoomFit& fit) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const int material : given.neutral) {
    const Eigen::Vector3d ratio =
        fit.tinted_material_rgb.cols() > material
            ? Eigen::Vector3d(fit.tinted_material_rgb.col(material))
            : Eigen::Vector3d(fit.albedo_rgb.col(material) / fit.fit.state.albedo[material]);
    if (!ratio.allFinite() || !(ratio.minCoeff() > 0)) continue;
    sum += ratio;
    ++count;
  }
  return count > 0 ? Eigen::Vector3d(sum / count) : Eigen::Vector3d::Ones();
}

}  // namespace

Eigen::Vector3d ChannelBalance(const Room& room, const RoomObservations& given) {
  const bool has_neutral = std::any_of(given.neutral.begin(), given.neutral.end(),
                                       [&](int material) { return IsSeen(room, given, material); });
  if (!has_neutral && !given.channels_are_of_sensor) return Eigen::Vector3d::Ones();
  std::array<std::vector<double>, 3> ratios;
  for (const Observation& o : given.observations) {
    if (has_neutral && !IsNeutral(given, MaterialOf(room, o))) continue;
    if (!(o.relative_luminance > 0) || !(o.relative_rgb.minCoeff() > 0)) continue;
    for (size_t c = 0; c < 3; ++c)
      ratios[c].push_back(o.relative_rgb[static_cast<Eigen::Index>(c)] / o.relative_luminance);
  }
  if (ratios[0].empty()) return Eigen::Vector3d::Ones();
  Eigen::Vector3d balance;
  for (size_t c = 0; c < 3; ++c) balance[static_cast<Eigen::Index>(c)] = MiddleHalfMean(std::move(ratios[c]));
  const double luminance = given.luminance_weights.dot(balance);
  return luminance > 0 ? Eigen::Vector3d(balance / luminance) : Eigen::Vector3d::Ones();
}

LightData WithBalance(LightData data, const Eigen::Vector3d& balance) {
  for (Observation& o : data.observations) o.relative_rgb = o.relative_rgb.cwiseQuotient(balance);
  data.luminance_weights = data.luminance_weights.cwiseProduct(balance);
  return data;
}

void WarnOfAssumedWeights(const RoomObservations& given, const RoomFit& fit, Findings& findings) {
  if (!given.luminance_weights_are_assumed || fit.tint_rgb.cols() == 0) return;
  constexpr double kWorthWarning = 0.01;
  const Eigen::Vector3d of_srgb(0.2126, 0.7152, 0.0722);
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const auto& tint : fit.tint_rgb.colwise()) {
    const double change = std::log(of_srgb.dot(tint) / given.luminance_weights.dot(tint));
    if (!std::isfinite(change)) continue;
    least = std::min(least, change);
    most = std::max(most, change);
  }
  if (!(most - least > kWorthWarning)) return;
  findings.warnings.push_back(
      {"luminance_weights_assumed",
       fmt::format("luminaires differ in colour, and nothing states what the camera's red, green and blue "
                   "are worth in luminance: with "
                   "the weights of sRGB instead, ratios of fluxes change by up to {:.1f} %",
                   100 * (most - least)),
       "give the camera's xyz_from_rgb or luminance_weights, or photos as RAW, which bring the sensor's "
       "matrix"});
}

void AddLightColours(const Room& room, const RoomObservations& given, const Eigen::Vector3d& balance,
                     RoomFit& fit) {
  const bool has_neutral = std::any_of(given.neutral.begin(), given.neutral.end(),
                                       [&](int material) { return IsSeen(room, given, material); });
  if (!has_neutral) return;
  const Eigen::Vector3d left = LeftOfNeutral(given, fit);
  for (auto material : fit.albedo_rgb.colwise()) material = material.cwiseQuotient(left).eval();
  const Eigen::Index luminaires = static_cast<Eigen::Index>(fit.fit.state.luminaires.size());
  const bool differ = fit.tint_rgb.cols() == luminaires;
  fit.light_rgb.resize(3, luminaires);
  fit.light_rgb_sigma.setConstant(3, luminaires, kNeutralSigma);
  for (Eigen::Index k = 0; k < luminaires; ++k) {
    fit.light_rgb.col(k) = balance.cwiseProduct(left);
    if (!differ) continue;
    fit.light_rgb.col(k) = fit.light_rgb.col(k).cwiseProduct(fit.tint_rgb.col(k)).eval();
    fit.light_rgb_sigma.col(k) =
        fit.tint_rgb_sigma.col(k).unaryExpr([](double own) { return std::hypot(own, kNeutralSigma); });
  }
}

}  // namespace luxfit
