#include "inverse/fit/internal/start_at_outlines.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/inverse/luminaire_outlines.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A panel of 1.2 m x 0.6 m, 1.4 m above the eyes of four views that see it obliquely, as a fit to light left it: 80 mm
// off, and a point.
class PanelOffItsOutlines : public testing::Test {
 protected:
  PanelOffItsOutlines() {
    truth_.id = "A";
    truth_.position = {2.1, 1.7, 2.8};
    truth_.shape = LuminaireShape::kRectangle;
    truth_.size_m = {1.2, 0.6};
    state_.luminaires = {truth_};
    state_.luminaires[0].shape = LuminaireShape::kPoint;
    state_.luminaires[0].position += Eigen::Vector3d(0.03, 0.02, -0.07);
    state_.free.resize(1);
  }

  // Shows what hangs at `place`.
  void ShowFrom(const std::vector<Eigen::Vector3d>& eyes, const Eigen::Vector3d& place) {
    Luminaire shown = truth_;
    shown.position = place;
    for (const Eigen::Vector3d& eye : eyes)
      outlines_.push_back({0, support::OutlineFrom(eye, shown, {static_cast<int>(outlines_.size()), 0, 1})});
  }

  double OffMm() const { return 1e3 * (Found() - truth_.position).norm(); }
  Eigen::Vector3d Found(const Room& room = MakeRoom(Scene{})) const {
    return AtOutlines(room, outlines_, state_).luminaires[0].position;
  }

  const std::vector<Eigen::Vector3d> around_{
      {0.6, 0.5, 1.4}, {4.2, 0.4, 1.4}, {4.6, 3.1, 1.4}, {0.4, 3.3, 1.4}};
  const std::vector<Eigen::Vector3d> one_side_{{0.6, -0.9, 1.4}, {2.2, -1.3, 1.4}, {3.9, -0.8, 1.4}};
  Luminaire truth_;
  LightState state_;
  std::vector<LuminaireOutline> outlines_;
};

// 32 points of its sides leave out the corners by up to a sixteenth of the rim: the centroid errs by millimetres.
TEST_F(PanelOffItsOutlines, ItIsMovedToWhereTheyMeet) {
  EXPECT_NEAR(OffMm(), 79, 1) << "nothing shows it";
  ShowFrom(around_, truth_.position);
  EXPECT_LT(OffMm(), 3);
}

// From one side, what middles of pictures are off by does not cancel.
TEST_F(PanelOffItsOutlines, ViewsFromOneSideAreEnough) {
  ShowFrom(one_side_, truth_.position);
  EXPECT_LT(OffMm(), 6);
}

TEST_F(PanelOffItsOutlines, TwoViewsAreNotEnough) {
  ShowFrom({around_[0], around_[2]}, truth_.position);
  EXPECT_NEAR(OffMm(), 79, 1);
}

TEST_F(PanelOffItsOutlines, SomethingElseDoesNotMoveIt) {
  ShowFrom(around_, truth_.position + Eigen::Vector3d(0.3, 0, 0));
  EXPECT_NEAR(OffMm(), 79, 1);
}

// The ceiling hangs 5 mm too low in the mesh.
TEST_F(PanelOffItsOutlines, ItStaysBelowTheCeiling) {
  const Room room = MakeRoom(
      support::ClosedRoom({5, 4, truth_.position.z() - 0.005}, {"w", "w", "w", "w", "floor", "ceiling"}));
  ShowFrom(around_, truth_.position);
  EXPECT_NEAR(Found(room).z(), truth_.position.z() - 0.015, 1e-6);
  EXPECT_LT(1e3 * (Found(room) - truth_.position).head<2>().norm(), 3);
}

TEST_F(PanelOffItsOutlines, AGivenPlaceStays) {
  state_.free[0].position = false;
  ShowFrom(around_, truth_.position);
  EXPECT_NEAR(OffMm(), 79, 1);
}

}  // namespace
}  // namespace luxfit
