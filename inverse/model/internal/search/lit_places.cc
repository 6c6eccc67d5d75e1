#include "inverse/model/internal/search/lit_places.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "forward/direct/direct_light.h"

namespace luxfit {
namespace {

LitPlace LightFrom(const Room& room, const std::vector<Sensor>& sensors, const Eigen::Vector3d& position) {
  const auto rows = static_cast<Eigen::Index>(sensors.size());
  LitPlace place;
  place.lx_per_cd.setZero(rows);
  place.rays.setZero(rows, 3);
  Luminaire lamp;
  lamp.position = position;
  lamp.distribution = Distribution::kIsotropic;
  constexpr double kIsotropicCdPerLm = 0.25 / M_PI;
  // A candidate close to a surface must not win by one enormous value.
  constexpr double kNearestM = 0.1;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Sensor& sensor = sensors[static_cast<size_t>(i)];
    const Eigen::Vector3d ray = sensor.position - position;
    const double distance = ray.norm();
    if (distance < kNearestM || VisibleFraction(room.rays, lamp, sensor.position, sensor.normal, 1) == 0)
      continue;
    place.lx_per_cd[i] =
        static_cast<float>(SensorIlluminancePerLumen(lamp, sensor).lx_per_lm / kIsotropicCdPerLm);
    place.rays.row(i) = (ray / distance).cast<float>();
  }
  return place;
}

// Returns the light of a lobe that shines to both sides; none where the sensors see but one of them: the other's could
// be as much as one likes.
Eigen::ArrayXf TwoSidedColumn(const LitPlace& place, const Eigen::ArrayXf& cosine, double share_back) {
  const Eigen::ArrayXf lx = cosine * place.lx_per_cd.array();
  if (lx.size() == 0 || !(lx.minCoeff() < 0 && lx.maxCoeff() > 0)) return Eigen::ArrayXf::Zero(lx.size());
  const auto front = static_cast<float>((1 - share_back) / M_PI),
             back = static_cast<float>(share_back / M_PI);
  return front * lx.max(0.0F) - back * lx.min(0.0F);
}

// Raises cosines to a power: whole ones by multiplication, in a fifth of the time.
void RaiseTo(double exponent, Eigen::Ref<Eigen::ArrayXf> cosine) {
  if (exponent != std::floor(exponent)) {
    constexpr float kDark = 1e-30F;  // has a logarithm
    cosine = (static_cast<float>(exponent) * cosine.max(kDark).log()).exp();
    return;
  }
  Eigen::ArrayXf power = cosine;  // to 1, 2, 4, ...
  bool is_first = true;
  for (auto left = static_cast<int>(exponent); left > 0; left /= 2) {
    if (left % 2 == 1 && is_first) cosine = power;
    if (left % 2 == 1 && !is_first) cosine *= power;
    is_first = is_first && left % 2 == 0;
    if (left > 1) power = power.square();
  }
}

}  // namespace

Eigen::MatrixXf LobeColumns(const LitPlace& place, const std::vector<Lobe>& lobes) {
  Eigen::MatrixXf columns(place.lx_per_cd.size(), static_cast<Eigen::Index>(lobes.size()));
  // Thousands of lobes are tried at each place: whole columns at a time take a tenth of the time that
  // IntensityPerLumen takes sensor by sensor.
  for (size_t l = 0; l < lobes.size(); ++l) {
    auto column = columns.col(static_cast<Eigen::Index>(l)).array();
    if (lobes[l].distribution == Distribution::kIsotropic) {
      column = static_cast<float>(0.25 / M_PI) * place.lx_per_cd.array();
      continue;
    }
    if (lobes[l].distribution != Distribution::kCosinePower)
      throw std::invalid_argument("LobeColumns: expected isotropic lobes and cosine powers");
    column = (place.rays * lobes[l].aim.cast<float>()).array();
    if (lobes[l].share_back > 0) {
      column = TwoSidedColumn(place, column, lobes[l].share_back);
      continue;
    }
    column = column.max(0.0F);
    RaiseTo(lobes[l].exponent, column);
    column *= static_cast<float>((lobes[l].exponent + 1) / (2 * M_PI)) * place.lx_per_cd.array();
  }
  if (place.along.empty()) return columns;
  for (const LitPlace& other : place.along) columns += LobeColumns(other, lobes);
  return columns / static_cast<float>(1 + place.along.size());
}

std::vector<Eigen::Vector3d> GridThrough(const Eigen::AlignedBox3d& box, double step) {
  const Eigen::Array3i n = (box.sizes().array() / step).ceil().cast<int>().max(1);
  std::vector<Eigen::Vector3d> places;
  places.reserve(static_cast<size_t>(n.cast<double>().prod()));
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

LitPlaces Lit(const Room& room, const std::vector<Sensor>& sensors, std::vector<Eigen::Vector3d> positions,
              const std::vector<Watcher>& views) {
  LitPlaces places{std::move(positions), {}};
  places.light.resize(places.positions.size());
  tbb::parallel_for(size_t{0}, places.positions.size(), [&](size_t i) {
    places.light[i] = LightFrom(room, sensors, places.positions[i]);
    places.light[i].watching = ViewsOf(room, views, places.positions[i]);
  });
  return places;
}

LitPlaces LitAlong(const Room& room, const std::vector<Sensor>& sensors, const Eigen::Vector3d& middle,
                   const Eigen::Vector3d& half_length) {
  LitPlaces lit = Lit(room, sensors, {middle});
  if (half_length.isZero()) return lit;
  LitPlace& place = lit.light.front();
  place.half_length = half_length;
  for (const double at : {-0.8, -0.4, 0.4, 0.8})
    place.along.push_back(LightFrom(room, sensors, middle + at * half_length));
  return lit;
}

}  // namespace luxfit
