#include "inverse/model/internal/search/lit_places.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <utility>

#include "forward/direct/direct_light.h"

namespace luxfit {
namespace {

// Returns the direct illuminance per lumen at the places (rows) by every lobe (columns) at one position.
Eigen::MatrixXf LobeColumns(const Room& room, const std::vector<Sensor>& places,
                            const Eigen::Vector3d& position) {
  const auto rows = static_cast<Eigen::Index>(places.size());
  const auto lobes = static_cast<Eigen::Index>(Lobes().size());
  Eigen::MatrixXf columns = Eigen::MatrixXf::Zero(rows, lobes);
  Luminaire lamp;
  lamp.position = position;
  lamp.distribution = Distribution::kIsotropic;
  constexpr double kIsotropicCdPerLm = 0.25 / M_PI;
  // A candidate close to a surface must not win by one enormous value.
  constexpr double kNearestM = 0.1;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Sensor& place = places[static_cast<size_t>(i)];
    const Eigen::Vector3d ray = place.position - position;
    const double distance = ray.norm();
    if (distance < kNearestM || VisibleFraction(room.rays, lamp, place.position, place.normal, 1) == 0)
      continue;
    const double isotropic = SensorIlluminancePerLumen(lamp, place).lx_per_lm;
    for (Eigen::Index l = 0; l < lobes; ++l) {
      const Lobe& lobe = Lobes()[static_cast<size_t>(l)];
      const double cosine = lobe.aim.dot(ray) / distance;
      lamp.distribution = lobe.distribution;
      lamp.cosine_exponent = lobe.exponent;
      columns(i, l) =
          static_cast<float>(isotropic / kIsotropicCdPerLm * IntensityPerLumen(lamp, cosine).cd_per_lm);
    }
    lamp.distribution = Distribution::kIsotropic;
  }
  return columns;
}

}  // namespace

const std::vector<Lobe>& Lobes() {
  using D = Distribution;
  static const std::vector<Lobe> lobes = {
      {D::kIsotropic, 1, {0, 0, -1}},   {D::kCosinePower, 1, {0, 0, -1}}, {D::kCosinePower, 3, {0, 0, -1}},
      {D::kCosinePower, 8, {0, 0, -1}}, {D::kCosinePower, 1, {0, 0, 1}},  {D::kCosinePower, 1, {1, 0, 0}},
      {D::kCosinePower, 1, {-1, 0, 0}}, {D::kCosinePower, 1, {0, 1, 0}},  {D::kCosinePower, 1, {0, -1, 0}}};
  return lobes;
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

LitPlaces Lit(const Room& room, const std::vector<Sensor>& sensors, std::vector<Eigen::Vector3d> positions) {
  LitPlaces places{std::move(positions), {}};
  places.columns.resize(places.positions.size());
  tbb::parallel_for(size_t{0}, places.positions.size(),
                    [&](size_t i) { places.columns[i] = LobeColumns(room, sensors, places.positions[i]); });
  return places;
}

}  // namespace luxfit
