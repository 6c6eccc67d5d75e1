#include "forward/light/internal/clustered_room.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "forward/light/illuminance.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A room whose floor is two triangles, with a box that stands on it.
Scene FurnishedRoom() {
  Scene scene = support::ClosedRoom({4, 3.2, 2.4}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  const Facet floor = scene.facets[4];
  scene.facets.erase(scene.facets.begin() + 4);
  support::AddTriangle(scene, floor.origin, floor.edge_u, floor.edge_v, "floor");
  support::AddTriangle(scene, floor.PointAt(1, 1), -floor.edge_u, -floor.edge_v, "floor");
  support::AddBox(scene, {Eigen::Vector3d(2.1, 1.1, 0), Eigen::Vector3d(2.9, 1.9, 0.75)},
                  support::Facing::kOutward, {"box"});
  return scene;
}

class FurnishedRoomTest : public testing::Test {
 protected:
  FurnishedRoomTest() {
    lamp_.position = Eigen::Vector3d(1.4, 1.3, 2.1);
    lamp_.flux_lm = 1000;
  }
  // Returns the illuminance of every element, lx.
  Eigen::VectorXd LightOf(const Room& room) const {
    std::vector<int> all(room.patches.elements.size());
    for (size_t e = 0; e < all.size(); ++e) all[e] = static_cast<int>(e);
    const Receivers receivers = MakeReceivers(room, all, {});
    const LuminaireVisibility visibility = ComputeVisibility(room, receivers, {lamp_});
    Eigen::VectorXd albedo(4);
    albedo << 0.6, 0.8, 0.3, 0.4;
    return lamp_.flux_lm *
           ComputeIlluminance(room, receivers, visibility, {lamp_}, albedo).total.col(0).cast<double>();
  }

  Room room_ = MakeRoom(FurnishedRoom(), {{0.25, 0.125}, {64}});
  Luminaire lamp_;
};

TEST_F(FurnishedRoomTest, ClustersAreNeighboursOfOneFacet) {
  ASSERT_TRUE(room_.clusters);
  const std::vector<Patch>& patches = room_.patches.patches;
  const std::vector<Patch>& clusters = room_.clusters->patches.patches;
  EXPECT_LT(clusters.size(), 0.4 * static_cast<double>(patches.size()));
  for (size_t p = 0; p < patches.size(); ++p) {
    const Patch& cluster = clusters[static_cast<size_t>(patches[p].cluster)];
    EXPECT_EQ(cluster.facet, patches[p].facet);
    EXPECT_LT((cluster.center - patches[p].center).norm(), 0.25 * std::sqrt(2.0));
  }
}

TEST_F(FurnishedRoomTest, ElementsStayAndClustersEncloseThem) {
  const Room& clusters = *room_.clusters;
  ASSERT_EQ(clusters.patches.elements.size(), room_.patches.elements.size());
  double area = 0;
  for (const Patch& cluster : clusters.patches.patches) area += cluster.area_m2;
  EXPECT_NEAR(area, room_.transport.patch_area_m2.cast<double>().sum(), 1e-3);
  for (size_t e = 0; e < clusters.patches.elements.size(); ++e) {
    const Element& element = clusters.patches.elements[e];
    EXPECT_EQ(element.center, room_.patches.elements[e].center);
    const Patch& cluster = clusters.patches.patches[static_cast<size_t>(element.patch)];
    Eigen::Matrix<double, 3, 2> edges;
    edges << cluster.edge_u, cluster.edge_v;
    const Eigen::Vector2d at = edges.colPivHouseholderQr().solve(element.center - cluster.origin);
    EXPECT_GT(at.minCoeff(), -1e-9);
    EXPECT_LT(at.maxCoeff(), 1 + 1e-9);
  }
}

TEST_F(FurnishedRoomTest, ElementsSeeAClusterAsTheySeeItsPatches) {
  const FormFactorMatrix& fine = room_.form_factors.element_to_patch;
  const FormFactorMatrix& coarse = room_.clusters->form_factors.element_to_patch;
  EXPECT_LT((fine.rowwise().sum() - coarse.rowwise().sum()).cwiseAbs().maxCoeff(), 1e-5);
  const int last = room_.patches.patches.back().cluster;
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(fine.rows());
  for (Eigen::Index p = 0; p < fine.cols(); ++p)
    if (room_.patches.patches[static_cast<size_t>(p)].cluster == last) sum += fine.col(p);
  EXPECT_LT((coarse.col(last) - sum).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(FurnishedRoomTest, TheLampIsSeenAlike) {
  const Receivers receivers = MakeReceivers(room_, {}, {});
  const Eigen::MatrixXf of_patches = ComputeVisibility(room_, receivers, {lamp_}).elements;
  const Eigen::MatrixXf of_clusters = ComputeVisibility(*room_.clusters, receivers, {lamp_}).elements;
  EXPECT_EQ(of_patches, of_clusters);
  EXPECT_LT(of_patches.minCoeff(), 0.5F) << "the box casts a shadow";
}

TEST_F(FurnishedRoomTest, LightIsAlikeToAPercent) {
  // Patches of twice the length leave four times the error of a second-order rule: it is 1 % at 0.5 m here.
  const Eigen::VectorXd fine = LightOf(room_), coarse = LightOf(*room_.clusters);
  const double rms = std::sqrt((coarse - fine).squaredNorm() / static_cast<double>(fine.size()));
  EXPECT_LT(rms, 0.01 * fine.mean());
  EXPECT_GT(rms, 0);
}

TEST(ClusteredRoom, SmallAndSparseRoomsHaveNone) {
  EXPECT_FALSE(MakeRoom(support::ClosedRoom({4, 3, 2.4}), {{0.5, 0.25}, {16}}).clusters);
  RoomOptions sparse{{0.25, 0.125}, {16}};
  sparse.max_matrix_bytes = 0;
  const Room room = MakeRoom(support::ClosedRoom({4, 3, 2.4}), sparse);
  EXPECT_FALSE(room.clusters);
  EXPECT_THROW(ClusteredRoom(room), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
