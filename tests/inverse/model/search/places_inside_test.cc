#include "inverse/model/internal/search/places_inside.h"

#include <gtest/gtest.h>

namespace luxfit {
namespace {

SeenPlace At(const Eigen::Vector3d& position) {
  SeenPlace place;
  place.position = position;
  place.views = 3;
  return place;
}

TEST(PlacesInside, MovesThoseAboveTheCeilingUnderIt) {
  const Eigen::AlignedBox3d room(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 2.5));
  const std::vector<SeenPlace> places =
      PlacesInside(room, {At({1, 2, 2.53}), At({-0.1, 1, 1}), At({2, 1, 2.4})});
  ASSERT_EQ(places.size(), 3u);
  EXPECT_TRUE(places[0].position.isApprox(Eigen::Vector3d(1, 2, 2.495)));
  EXPECT_TRUE(places[1].position.isApprox(Eigen::Vector3d(0.005, 1, 1)));
  EXPECT_EQ(places[2].position, Eigen::Vector3d(2, 1, 2.4)) << "to the digit";
  EXPECT_EQ(places[0].views, 3);
}

TEST(PlacesInside, LeavesThemWhereThereIsNoMesh) {
  EXPECT_EQ(PlacesInside({}, {At({1, 2, 9})})[0].position, Eigen::Vector3d(1, 2, 9));
}

}  // namespace
}  // namespace luxfit
