#include "inverse/model/internal/search/places_inside.h"

namespace luxfit {

std::vector<SeenPlace> PlacesInside(const Eigen::AlignedBox3d& box, std::vector<SeenPlace> places) {
  if (box.isEmpty()) return places;
  const Eigen::Vector3d inner = Eigen::Vector3d::Constant(5e-3);
  for (SeenPlace& place : places)
    place.position = place.position.cwiseMax(box.min() + inner).cwiseMin(box.max() - inner);
  return places;
}

}  // namespace luxfit
