// Leaves the door out of fixtures/office, while the photos, which an independent renderer made, show it.
#include "inverse/furniture/painted_parts.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "forward/mesh/mesh_file.h"
#include "tests/support/office_truth.h"
#include "tests/support/office_views.h"

namespace luxfit {
namespace {

using support::OfficeViews;

std::vector<PaintedPart> Find(const Scene& room) {
  std::vector<PaintedPart> parts = FindPaintedParts(room, OfficeViews());
  for (const PaintedPart& part : parts) {
    const PaintedRectangle& r = part.rectangle;
    const Eigen::Vector3d to = r.corner + r.edge_u + r.edge_v;
    std::printf("%s of %s: (%.3f, %.3f, %.3f) to (%.3f, %.3f, %.3f), ratio %.2f, %d sides\n", r.name.c_str(),
                part.material.c_str(), r.corner.x(), r.corner.y(), r.corner.z(), to.x(), to.y(), to.z(),
                part.luminance_ratio, part.sides);
  }
  return parts;
}

std::vector<RoomBox> Furniture() {
  return {{"desk 1", {0.8, 1.0, 0.70}, {2.4, 1.8, 0.74}, 0},
          {"desk 2", {3.4, 2.3, 0.70}, {5.0, 3.1, 0.74}, 0},
          {"cabinet", {5.5, 0.2, 0}, {5.98, 1.4, 1.6}, 0}};
}

// It stands 3 cm before its wall: views from the side show it that much off.
TEST(PaintedParts, TheDoorIsFound) {
  const std::vector<PaintedPart> parts = Find(WithBoxes(support::EmptyOffice(), Furniture()));
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].material, "wall 1");
  const PaintedRectangle& r = parts[0].rectangle;
  const Eigen::Vector3d middle = r.corner + 0.5 * (r.edge_u + r.edge_v);
  EXPECT_NEAR(middle.x(), 3.05, 0.03);
  EXPECT_NEAR(r.edge_u.norm(), 0.9, 0.05);
  EXPECT_NEAR(middle.z() + r.edge_v.norm() / 2, 2.05, 0.03);
  EXPECT_NEAR(middle.z() - r.edge_v.norm() / 2, 0, 0.03);
  EXPECT_NEAR(parts[0].luminance_ratio, 0.32 / 0.7, 0.1);  // reflectances of door and wall
}

TEST(PaintedParts, NothingIsFoundWhereTheMeshHasAll) {
  EXPECT_TRUE(Find(ReadScene(support::kOfficeFolder + "room.obj")).empty());
}

TEST(PaintedParts, OneViewFindsNothing) {
  EXPECT_TRUE(FindPaintedParts(support::EmptyOffice(), {OfficeViews()[0]}).empty());
}

}  // namespace
}  // namespace luxfit
