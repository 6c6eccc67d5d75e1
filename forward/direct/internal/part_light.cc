#include "forward/direct/internal/part_light.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "forward/direct/internal/surface_rule.h"

namespace luxfit {

PartLight::PartLight(const Luminaire& luminaire, PartKind kind)
    : whole_(luminaire), kind_(kind), size_(PartShares(luminaire, kind).size()) {
  Luminaire one = luminaire;
  one.flux_lm = 1;
  if (size_ == 0) throw std::invalid_argument("PartLight: expected a luminaire that has such parts");
  if (kind == PartKind::kCell) {
    one.flux_lm = static_cast<double>(luminaire.emission.size());
    one.emission.setConstant(1 / one.flux_lm);  // cells without light are parts too
  } else {
    node_flux_ = NodeFlux(luminaire.table->gamma_rad);
    if (kind == PartKind::kSide) nodes_of_sides_ = NodesOfSides(luminaire);
  }
  for (LuminaireCell& cell : CellsOf(one)) cells_.push_back(std::move(cell.luminaire));
}

Eigen::VectorXd PartLight::At(const Sensor& place) const {
  if (kind_ != PartKind::kCell && place.response.kind == ResponseKind::kCosine) {
    Eigen::VectorXd light = Eigen::VectorXd::Zero(node_flux_.size());
    for (const Luminaire& cell : cells_) AddNodes(cell, place.position, place.normal, light);
    light = light.cwiseQuotient(node_flux_);
    return kind_ == PartKind::kSide ? (nodes_of_sides_ * light).eval() : light;
  }
  Eigen::VectorXd light = PartShares(whole_, kind_);
  for (Eigen::Index j = 0; j < light.size(); ++j) {
    light[j] = kind_ == PartKind::kCell
                   ? SensorIlluminancePerLumen(cells_[static_cast<size_t>(j)], place).lx_per_lm
                   : SensorIlluminancePerLumen(PartOf(whole_, kind_, static_cast<int>(j)), place).lx_per_lm;
  }
  return light;
}

// The light of a surface point belongs to the two nodes about its gamma.
void PartLight::AddNodes(const Luminaire& cell, const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                         Eigen::VectorXd& sum) const {
  const LuminousSurface surface(cell);
  const std::vector<double>& gamma_rad = cell.table->gamma_rad;
  for (const SurfaceSample& sample : SurfaceRuleFor(surface, p, normal)) {
    const Eigen::Vector3d to_lamp = surface.PointOf({sample.a, sample.b}) - p;
    const double r2 = to_lamp.squaredNorm(), height = normal.dot(to_lamp);
    if (height <= 0 || r2 < 1e-12) continue;
    const double r = std::sqrt(r2);
    const double gamma = std::acos(std::clamp(-cell.aim.dot(to_lamp) / r, -1.0, 1.0));
    if (gamma < gamma_rad.front() || gamma > gamma_rad.back()) continue;
    const auto above = std::upper_bound(gamma_rad.begin() + 1, gamma_rad.end() - 1, gamma);
    const auto node = static_cast<Eigen::Index>(above - gamma_rad.begin());
    const double share = (gamma - *(above - 1)) / (*above - *(above - 1));
    const double light = cell.flux_lm * sample.weight * height / (r2 * r);
    sum[node - 1] += (1 - share) * light;
    sum[node] += share * light;
  }
}

}  // namespace luxfit
