#include "inverse/fit/internal/light_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "inverse/albedo/internal/albedo_rgb.h"

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

// Records whether neutral surfaces told the colour of light.
void RecordLight(const RoomObservations& given, const ColourDetail& colours, Findings& findings) {
  if (given.neutral.empty()) return;
  const bool is_told = colours.neutral_light.allFinite();
  findings.choices.push_back({"colour of light",
                              is_told ? "by neutral surfaces" : "not determined",
                              {"by neutral surfaces", "not determined"},
                              is_told ? "luminaires light them more than other surfaces do"
                                      : "no neutral surface that photos show gets more light from luminaires "
                                        "than from other surfaces: name "
                                        "one that they light in scene.neutral"});
}

// Returns the colours of light in the camera's own channels, and sets their sigmas.
void AddLight(const Eigen::Vector3d& balance, const ColourDetail& colours, RoomFit& result) {
  const Eigen::Index luminaires = static_cast<Eigen::Index>(colours.tint.cols());
  const bool differ = result.tint_rgb.cols() == luminaires;
  result.light_rgb = balance.cwiseProduct(colours.neutral_light).replicate(1, luminaires);
  result.light_rgb_sigma.resize(3, luminaires);
  for (Eigen::Index k = 0; k < luminaires; ++k) {
    if (differ) result.light_rgb.col(k) = result.light_rgb.col(k).cwiseProduct(result.tint_rgb.col(k)).eval();
    for (Eigen::Index c = 0; c < 3; ++c) {
      const double of_tint = differ ? result.tint_rgb_sigma(c, k) : 0;
      result.light_rgb_sigma(c, k) =
          std::hypot(kNeutralSigma, std::hypot(of_tint, colours.neutral_light_sigma[c]));
    }
  }
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

ColourDetail AddColours(const Room& room, const RoomObservations& given, const Eigen::Vector3d& balance,
                        const LuminaireFit& fit, RoomFit& result) {
  LightData data = result.data;
  ColourDetail colours = CompareColours(room, data, fit, given.neutral);
  const bool is_told = colours.neutral_light.allFinite();
  if (is_told) {
    // White light shows what is grey.
    data = WithBalance(std::move(data), colours.neutral_light);
    const Eigen::Vector3d light = colours.neutral_light, sigma = colours.neutral_light_sigma;
    colours = CompareColours(room, data, fit);
    colours.neutral_light = light;
    colours.neutral_light_sigma = sigma;
  }
  result.albedo_rgb = EstimateAlbedoRgb(room, data, fit);
  for (size_t m = 0; m < colours.materials.size(); ++m) {
    const Eigen::Index material = static_cast<Eigen::Index>(m);
    if (!colours.materials[m].among.empty() && colours.materials[m].chosen == 0)
      result.albedo_rgb.col(material).setConstant(fit.state.albedo[material]);
  }
  if (!colours.luminaires.among.empty() && colours.luminaires.chosen != 0) {
    result.tint_rgb = colours.tint;
    result.tint_rgb_sigma = colours.tint_sigma;
  }
  if (is_told) AddLight(balance, colours, result);
  RecordLight(given, colours, result.findings);
  return colours;
}

}  // namespace luxfit
