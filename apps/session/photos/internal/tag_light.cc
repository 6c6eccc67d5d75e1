#include "apps/session/photos/internal/tag_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr double kDarkestLight = 1e-4;  // of full scale

using Quad = std::array<Eigen::Vector2d, 4>;

bool IsInside(const Quad& quad, const Eigen::Vector2d& point) {
  int left = 0;
  for (size_t c = 0; c < 4; ++c) {
    const Eigen::Vector2d side = quad[(c + 1) % 4] - quad[c], way = point - quad[c];
    left += side.x() * way.y() - side.y() * way.x() > 0 ? 1 : -1;
  }
  return std::abs(left) == 4;
}

// Returns the mean of the light over a tag; empty where it is clipped, dark, or covers no pixel.
std::optional<double> MeanOver(const PhotoLook& photo, const Quad& corners_px) {
  const double step =
      std::round(static_cast<double>(photo.width_px) / static_cast<double>(photo.light.cols()));
  Quad quad = corners_px;
  for (Eigen::Vector2d& corner : quad) corner = (corner.array() + 0.5) / step - 0.5;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : quad) box.extend(corner);
  double sum = 0;
  int count = 0;
  for (int v = static_cast<int>(box.min().y()); v <= box.max().y(); ++v) {
    for (int u = static_cast<int>(box.min().x()); u <= box.max().x(); ++u) {
      if (u < 0 || v < 0 || u >= photo.light.cols() || v >= photo.light.rows() || !IsInside(quad, {u, v}))
        continue;
      sum += static_cast<double>(photo.light(v, u));
      ++count;
    }
  }
  const double mean = sum / std::max(1, count);
  return mean > kDarkestLight ? std::optional(mean) : std::nullopt;  // NaN is not greater
}

// Returns the median over the picture: a luminaire in view says little of the light in the room.
double MedianLight(const PhotoLook& photo) {
  std::vector<double> values;
  values.reserve(static_cast<size_t>(photo.pattern.size()));
  for (Eigen::Index i = 0; i < photo.pattern.size(); ++i) {
    const float value = photo.pattern.data()[i];
    values.push_back(std::isfinite(value) ? static_cast<double>(value) : 1);
  }
  return std::max(kDarkestLight, Median(values));
}

}  // namespace

void MeasureTagLight(const std::vector<PhotoLook>& photos, const std::vector<LightGroup*>& groups) {
  std::map<int, std::vector<Quad>> seen;
  for (const LightGroup* group : groups) {
    for (const size_t i : group->photos) {
      for (const TagDetection& tag : photos[i].tags) seen[tag.id].push_back(tag.corners_px);
    }
  }
  for (LightGroup* group : groups) {
    std::map<int, std::vector<double>> values;
    std::vector<double> levels;
    for (const size_t i : group->photos) {
      const PhotoLook& photo = photos[i];
      group->camera = photo.capture.camera + std::to_string(photo.width_px);
      group->is_absolute = group->is_absolute && photo.RelativeExposure().has_value();
      const double log_exposure = std::log(photo.RelativeExposure().value_or(1));
      levels.push_back(std::log(MedianLight(photo)) - log_exposure);
      for (const auto& [id, quads] : seen) {
        if (const auto mean = MeanOver(photo, quads.front()))
          values[id].push_back(std::log(*mean) - log_exposure);
      }
    }
    group->level = Median(levels);
    for (const auto& [id, logs] : values) group->log_light[id] = Median(logs);
  }
}

std::optional<double> TagLightDifference(const LightGroup& a, const LightGroup& b) {
  constexpr double kMost = 1.5;  // one tag in a beam says no more than that it is another state
  std::vector<double> differences;
  for (const auto& [id, light] : a.log_light) {
    const auto other = b.log_light.find(id);
    if (other != b.log_light.end()) differences.push_back(light - other->second);
  }
  const bool is_absolute = a.is_absolute && b.is_absolute && a.camera == b.camera;
  if (differences.size() < (is_absolute ? 1 : 3)) return std::nullopt;
  const double factor = is_absolute ? 0 : Median(differences);
  double sum = 0;
  for (const double difference : differences) sum += std::min(kMost, std::abs(difference - factor));
  return sum / static_cast<double>(differences.size());
}

}  // namespace luxfit
