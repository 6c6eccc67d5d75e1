#include "forward/mesh/mesh_check.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// On the walls and the floor of a room of 6 x 4 x 2.8 m. Most are away from the three planes through the
// origin: on those a tag lies at any scale of the mesh.
const std::vector<Eigen::Vector3d> kTags = {{0, 1, 1.5},   {6, 2.5, 1.2}, {6, 0.7, 1.6}, {2, 0, 1.8},
                                            {4.5, 4, 0.7}, {1.5, 4, 1.3}, {3, 2.2, 0}};

// The room as a mesh whose numbers are in another unit than it was read in.
Scene RoomReadAs(double true_metres_per_unit, double declared_metres_per_unit) {
  return support::ClosedRoom(Eigen::Vector3d(6, 4, 2.8) / true_metres_per_unit * declared_metres_per_unit);
}

TEST(CheckSurvey, TagsOnTheWallsFit) {
  const SurveyCheck check = CheckSurvey(RoomReadAs(1, 1), kTags, 1);
  EXPECT_TRUE(check.fits);
  EXPECT_NEAR(check.distance_m, 0, 1e-12);  // double rounding
  EXPECT_EQ(check.better_unit, "");
}

TEST(CheckSurvey, ToleratesATagThatHangsInTheAir) {
  std::vector<Eigen::Vector3d> tags = kTags;
  tags[0] += Eigen::Vector3d(1, 0, 0);
  EXPECT_TRUE(CheckSurvey(RoomReadAs(1, 1), tags, 1).fits);
  for (Eigen::Vector3d& p : tags) p += Eigen::Vector3d(0.7, 0.7, 0.7);
  const SurveyCheck shifted = CheckSurvey(RoomReadAs(1, 1), tags, 1);
  EXPECT_FALSE(shifted.fits);
  EXPECT_GT(shifted.distance_m, 0.1);
  EXPECT_EQ(shifted.better_unit, "");  // another frame is no matter of units
}

TEST(CheckSurvey, AMeshInAnotherUnitIsRecognised) {
  struct Case {
    const char* unit;
    double metres;
  };
  for (const Case& c : {Case{"cm", 0.01}, Case{"mm", 0.001}, Case{"in", 0.0254}, Case{"ft", 0.3048}}) {
    const SurveyCheck as_metres = CheckSurvey(RoomReadAs(c.metres, 1), kTags, 1);
    EXPECT_FALSE(as_metres.fits) << c.unit;
    EXPECT_EQ(as_metres.better_unit, c.unit);
  }
  EXPECT_EQ(CheckSurvey(RoomReadAs(1, 0.01), kTags, 0.01).better_unit,
            "m");  // metres declared as centimetres
}

TEST(CheckSurvey, AMeshWithYUpIsRecognised) {
  Scene y_up = RoomReadAs(1, 1);
  const auto turned = [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.z(), -p.y()); };
  for (Facet& facet : y_up.facets) {
    facet.origin = turned(facet.origin);
    facet.edge_u = turned(facet.edge_u);
    facet.edge_v = turned(facet.edge_v);
  }
  const SurveyCheck check = CheckSurvey(y_up, kTags, 1);
  EXPECT_FALSE(check.fits);
  EXPECT_TRUE(check.fits_y_up);
  EXPECT_EQ(check.better_unit, "");
  EXPECT_FALSE(CheckSurvey(RoomReadAs(1, 1), kTags, 1).fits_y_up);
  EXPECT_FALSE(CheckSurvey(RoomReadAs(0.01, 1), kTags, 1).fits_y_up) << "the unit explains it";
}

TEST(CheckSurvey, WithoutTagsThereIsNothingToCheck) {
  EXPECT_TRUE(CheckSurvey(RoomReadAs(1, 1), {}, 1).fits);
}

}  // namespace
}  // namespace luxfit
