#include "apps/stages/observe/found_furniture.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace luxfit {
namespace {

TEST(FoundFurniture, MovesAreReadAsTheyWereWritten) {
  const Eigen::AlignedBox3d cabinet(Eigen::Vector3d(5.5, 0.2, 0), Eigen::Vector3d(5.98, 1.4, 1.6)),
      desk(Eigen::Vector3d(0.8, 1, 0.7), Eigen::Vector3d(2.4, 1.8, 0.74));
  const nlohmann::json json = MovesJson({{cabinet, Eigen::Vector3d(0, -1.003, 0)}, {desk, std::nullopt}});
  EXPECT_TRUE(json.at(1).at("moved_m").is_null());
  const std::vector<PieceMove> moves = MovesFromJson(nlohmann::json::parse(json.dump()));
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_TRUE(moves[0].bounds.isApprox(cabinet, 0));
  ASSERT_TRUE(moves[0].by_m.has_value());
  EXPECT_EQ(*moves[0].by_m, Eigen::Vector3d(0, -1.003, 0));
  EXPECT_FALSE(moves[1].by_m.has_value());
}

TEST(FoundFurniture, WallsAreReadAsTheyWereWritten) {
  const nlohmann::json json = WallsJson({{{-1, 0, 0}, -6.05, 0.0511}});
  const std::vector<PlaneMove> walls = WallsFromJson(nlohmann::json::parse(json.dump()));
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_EQ(walls[0].normal, Eigen::Vector3d(-1, 0, 0));
  EXPECT_EQ(walls[0].offset_m, -6.05);
  EXPECT_EQ(walls[0].by_m, 0.0511);
}

}  // namespace
}  // namespace luxfit
