// Finds the furniture of fixtures/office, which an independent renderer photographed, from its three lengths; limits are
// 1.5 times what was measured.
#include "inverse/furniture/furniture.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "forward/mesh/mesh_file.h"
#include "tests/support/office_truth.h"
#include "tests/support/office_views.h"

namespace luxfit {
namespace {

using support::EmptyOffice;
using support::OfficeViews;

// Returns by how much the sides of two boxes differ at most, m.
double WorstSideM(const RoomBox& found, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return std::max((found.min_m - low).cwiseAbs().maxCoeff(), (found.max_m - high).cwiseAbs().maxCoeff());
}

TEST(Furniture, TheOfficesCabinetAndDesksAreFoundFromItsThreeLengths) {
  const std::vector<FoundBox> found = FindFurniture(EmptyOffice(), OfficeViews());
  for (const FoundBox& f : found)
    std::printf("%s: %.2f %.2f %.2f to %.2f %.2f %.2f, face %.2f m2 in %d views, +-%.3f m\n",
                f.box.name.c_str(), f.box.min_m.x(), f.box.min_m.y(), f.box.min_m.z(), f.box.max_m.x(),
                f.box.max_m.y(), f.box.max_m.z(), f.face_area_m2, f.views, f.sigma_m);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_TRUE(found[0].is_upright);
  EXPECT_FALSE(found[0].is_thin);
  EXPECT_LT(WorstSideM(found[0].box, {5.5, 0.2, 0}, {5.98, 1.4, 1.6}), 0.06);  // the cabinet
  for (const FoundBox& desk : {found[1], found[2]}) {
    EXPECT_FALSE(desk.is_upright);
    EXPECT_TRUE(desk.is_thin);  // views look under it
    EXPECT_NEAR(desk.box.max_m.z(), 0.74, 0.01);
    EXPECT_NEAR(desk.box.min_m.z(), 0.70, 0.01);
  }
  const bool is_first = found[1].box.min_m.x() < found[2].box.min_m.x();
  const FoundBox& near = found[is_first ? 1 : 2];
  const FoundBox& far = found[is_first ? 2 : 1];
  EXPECT_LT(WorstSideM(near.box, {0.8, 1.0, 0.70}, {2.4, 1.8, 0.74}),
            0.17);  // one view alone sees its left end
  EXPECT_LT(WorstSideM(far.box, {3.4, 2.3, 0.70}, {5.0, 3.1, 0.74}), 0.12);
}

// The whole office turned by 30 degrees about the vertical: its boxes turn with it.
TEST(Furniture, BoxesTurnWithTheRoom) {
  const double turn_rad = 0.5235987755982988;
  const Eigen::Isometry3d turned(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()));
  Scene scene = EmptyOffice();
  for (Facet& facet : scene.facets) {
    facet.origin = turned * facet.origin;
    facet.edge_u = turned.linear() * facet.edge_u;
    facet.edge_v = turned.linear() * facet.edge_v;
  }
  std::vector<SignatureView> views = OfficeViews();
  for (SignatureView& view : views) view.cam_from_world = view.cam_from_world * turned.inverse();
  const std::vector<FoundBox> found = FindFurniture(scene, views),
                              upright = FindFurniture(EmptyOffice(), OfficeViews());
  ASSERT_EQ(found.size(), upright.size());
  for (size_t i = 0; i < found.size(); ++i) {
    const RoomBox &a = found[i].box, &b = upright[i].box;
    EXPECT_NEAR(a.turn_rad, turn_rad, 1e-9);
    EXPECT_LT((0.5 * (a.min_m + a.max_m) - turned * (0.5 * (b.min_m + b.max_m))).norm(), 0.02) << a.name;
    EXPECT_LT(((a.max_m - a.min_m) - (b.max_m - b.min_m)).norm(), 0.04) << a.name;
  }
}

TEST(Furniture, NothingIsFoundWhereTheMeshHasIt) {
  EXPECT_TRUE(FindFurniture(ReadScene(support::kOfficeFolder + "room.obj"), OfficeViews()).empty());
}

// Meters stood in the air under the desk's top and on it: the top moves to the latter; a box round the former is none.
TEST(Furniture, NoBoxBuriesAPlaceWhereAMeterStood) {
  FurnitureOptions options;
  options.free_places = {{1.6, 1.4, 0.735}, {5.8, 0.8, 0.8}};
  const std::vector<FoundBox> found = FindFurniture(EmptyOffice(), OfficeViews(), options);
  for (const FoundBox& f : found)
    for (const Eigen::Vector3d& p : options.free_places)
      EXPECT_FALSE(Eigen::AlignedBox3d(f.box.min_m, f.box.max_m).contains(p)) << f.box.name;
  EXPECT_GE(found.size(), 2u);
}

TEST(Furniture, TwoViewsFindNothing) {
  const std::vector<SignatureView> two(OfficeViews().begin(), OfficeViews().begin() + 2);
  EXPECT_TRUE(FindFurniture(EmptyOffice(), two).empty());
}

}  // namespace
}  // namespace luxfit
