// Moves furniture of fixtures/office in its mesh, while the photos, which an independent renderer made, show it where it is.
#include "inverse/furniture/missing_pieces.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "forward/mesh/mesh_file.h"
#include "tests/support/office_truth.h"
#include "tests/support/office_views.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using support::OfficeViews;

Scene Office() { return ReadScene(support::kOfficeFolder + "room.obj"); }

// Returns the office with the piece whose bounds hold a place moved by some metres.
Scene WithMoved(const Eigen::Vector3d& place, const Eigen::Vector3d& by_m) {
  const Scene office = Office();
  for (const std::vector<int>& piece : LoosePieces(office)) {
    const Eigen::AlignedBox3d bounds = BoundsOf(office, piece);
    if (bounds.contains(place)) return WithPiecesMoved(office, {{bounds, by_m}});
  }
  ADD_FAILURE() << "no piece is there";
  return office;
}

RevisedFurniture Revise(const Scene& mesh) {
  RevisedFurniture revised = ReviseFurniture(mesh, mesh, OfficeViews());
  for (const MissingPiece& piece : revised.missing) {
    const Eigen::Vector3d at = piece.move.bounds.center(),
                          by = piece.move.by_m.value_or(Eigen::Vector3d::Zero());
    std::printf("%s at %.2f %.2f: %d views see through %.2f of %.2f m2; %s %.3f %.3f\n",
                piece.material.c_str(), at.x(), at.y(), piece.views, piece.through_m2, piece.judged_m2,
                piece.move.by_m ? "moved by" : "is not there", by.x(), by.y());
  }
  return revised;
}

void ExpectMovedBack(const Eigen::Vector3d& place, const Eigen::Vector3d& by_m, const std::string& material,
                     double within_m) {
  const RevisedFurniture revised = Revise(WithMoved(place, by_m));
  EXPECT_TRUE(revised.found.empty());
  ASSERT_EQ(revised.missing.size(), 1u);
  EXPECT_EQ(revised.missing[0].material, material);
  ASSERT_TRUE(revised.missing[0].move.by_m.has_value());
  EXPECT_LT((*revised.missing[0].move.by_m + by_m).norm(), within_m);
}

TEST(MissingPieces, NoneIsMissingFromTheOffice) {
  const RevisedFurniture revised = Revise(Office());
  EXPECT_TRUE(revised.missing.empty());
  EXPECT_TRUE(revised.found.empty());
}

TEST(MissingPieces, ACabinetStandsAMetreFurther) {
  ExpectMovedBack({5.7, 0.8, 1}, {0, 1, 0}, "cabinet", 0.035);
}

TEST(MissingPieces, ADeskStandsHalfAMetreFurtherAlongItsSide) {
  ExpectMovedBack({4, 2.5, 0.72}, {0.5, 0, 0}, "desk", 0.04);
}

TEST(MissingPieces, ADeskStandsHalfAMetreFurtherAcross) {
  ExpectMovedBack({4, 2.5, 0.72}, {0, 0.5, 0}, "desk", 0.04);
}

TEST(MissingPieces, ABoxThatTheRoomLacksIsLeftOut) {
  Scene mesh = Office();
  support::AddBox(mesh, {Eigen::Vector3d(2.6, 1.9, 0), Eigen::Vector3d(3.2, 2.5, 1)},
                  support::Facing::kOutward, {"crate"});
  const RevisedFurniture revised = Revise(mesh);
  EXPECT_TRUE(revised.found.empty());
  ASSERT_EQ(revised.missing.size(), 1u);
  EXPECT_EQ(revised.missing[0].material, "crate");
  EXPECT_FALSE(revised.missing[0].move.by_m.has_value());
}

TEST(MissingPieces, TwoViewsTellNothing) {
  const std::vector<SignatureView> two(OfficeViews().begin(), OfficeViews().begin() + 2);
  const Scene mesh = WithMoved({5.7, 0.8, 1}, {0, 1, 0});
  EXPECT_TRUE(ReviseFurniture(mesh, mesh, two).missing.empty());
}

}  // namespace
}  // namespace luxfit
