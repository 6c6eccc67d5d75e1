#include "inverse/model/internal/search/places_inside.h"

namespace luxfit {

Eigen::Vector3d Inside(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& place) {
  const Eigen::Vector3d inner = Eigen::Vector3d::Constant(5e-3);
  return place.cwiseMax(box.min() + inner).cwiseMin(box.max() - inner);
}

std::vector<SeenPlace> PlacesInside(const Eigen::AlignedBox3d& box, std::vector<SeenPlace> places) {
  if (box.isEmpty()) return places;
  for (SeenPlace& place : places) place.position = Inside(box, place.position);
  return places;
}

}  // namespace luxfit
