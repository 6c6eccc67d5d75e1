#include "inverse/model/internal/search/grouped_light.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "inverse/model/internal/search/spread_elements.h"

namespace luxfit {
namespace {

struct Measurement {
  int state = 0;
  double value = 0, indirect = 0;
};

// Returns states x luminaires; states without observations are 0.
Eigen::MatrixXd ObservedDimming(const LightData& data) {
  const Eigen::Index lamps = data.dimming.empty() ? 0 : data.dimming[0].size();
  Eigen::MatrixXd table = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(data.dimming.size()), lamps);
  for (const Observation& o : data.observations)
    table.row(o.state) = data.dimming[static_cast<size_t>(o.state)].transpose();
  for (const Reading& r : data.readings) {
    if (r.used && data.observations.empty())
      table.row(r.state) = data.dimming[static_cast<size_t>(r.state)].transpose();
  }
  return table;
}

// Returns the groups' own (value, indirect) at a place: groups x 2, NaN where unknown.
Eigen::MatrixX2d Separate(const std::vector<Measurement>& list, const Eigen::MatrixXd& dimming) {
  const auto rows = static_cast<Eigen::Index>(list.size());
  Eigen::MatrixXd table(rows, dimming.cols());
  Eigen::MatrixX2d measured(rows, 2);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Measurement& m = list[static_cast<size_t>(i)];
    const double weight = 1 / std::max(1e-12, m.value);  // equal relative errors
    table.row(i) = weight * dimming.row(m.state);
    measured.row(i) = weight * Eigen::RowVector2d(m.value, m.indirect);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(table);
  if (qr.rank() == dimming.cols()) return qr.solve(measured);
  // Too few states show this place: take those in which a group was on alone.
  Eigen::MatrixX2d own =
      Eigen::MatrixX2d::Constant(dimming.cols(), 2, std::numeric_limits<double>::quiet_NaN());
  for (const Measurement& m : list) {
    const Eigen::VectorXd d = dimming.row(m.state);
    Eigen::Index g = 0;
    const double most = d.maxCoeff(&g);
    if (most > 0 && d.sum() == most) own.row(g) = Eigen::RowVector2d(m.value, m.indirect) / most;
  }
  return own;
}

struct Place {
  Sensor sensor;
  int material = -1;
  std::vector<Measurement> measured;
};

std::vector<Place> PlacesOf(const Room& room, const LightData& data, int max_places) {
  std::vector<Place> places;
  std::map<int, std::vector<Measurement>> by_element;
  for (const Observation& o : SpreadElements(room, data, max_places))
    by_element[o.element].push_back({o.state, o.relative_luminance, o.relative_indirect});
  for (auto& [index, list] : by_element) {
    const Element& element = room.patches.elements[static_cast<size_t>(index)];
    const int material = room.patches.patches[static_cast<size_t>(element.patch)].material;
    places.push_back({{element.center, element.normal, {}}, material, std::move(list)});
  }
  // Photos see far more than the few readings do, in another unit. They exclude readings here.
  if (!data.observations.empty()) return places;
  std::map<std::array<double, 6>, size_t> place_of_sensor;
  for (const Reading& r : data.readings) {
    if (!r.used) continue;
    const Eigen::Vector3d &p = r.sensor.position, &n = r.sensor.normal;
    const auto [place, is_new] =
        place_of_sensor.try_emplace({p.x(), p.y(), p.z(), n.x(), n.y(), n.z()}, places.size());
    if (is_new) places.push_back({r.sensor, -1, {}});
    places[place->second].measured.push_back({r.state, r.illuminance_lx, 0});
  }
  return places;
}

}  // namespace

GroupedLight GroupLight(const Room& room, const LightData& data, int max_places) {
  GroupedLight light;
  DimmingGroups found = GroupByDimming(ObservedDimming(data));
  light.groups = std::move(found.groups);
  const Eigen::MatrixXd& dimming = found.dimming;
  for (Eigen::Index g = 0; g < dimming.cols(); ++g) {
    light.is_on.emplace_back();
    for (Eigen::Index s = 0; s < dimming.rows(); ++s) light.is_on.back().push_back(dimming(s, g) > 0);
  }
  light.separable =
      dimming.cols() > 0 && Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(dimming).rank() == dimming.cols();
  const std::vector<Place> places = PlacesOf(room, data, max_places);
  const auto rows = static_cast<Eigen::Index>(places.size());
  light.value.resize(rows, dimming.cols());
  light.indirect.resize(rows, dimming.cols());
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Place& place = places[static_cast<size_t>(i)];
    light.places.push_back(place.sensor);
    light.material.push_back(place.material);
    const Eigen::MatrixX2d own = Separate(place.measured, dimming);
    light.value.row(i) = own.col(0).transpose();
    light.indirect.row(i) = own.col(1).transpose();
  }
  return light;
}

}  // namespace luxfit
