#include "forward/light/illuminance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <stdexcept>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

class ColouredRoom : public testing::Test {
 protected:
  ColouredRoom()
      : room_(MakeRoom(support::ClosedRoom({3, 3, 3}, {"wall", "wall", "wall", "wall", "floor", "wall"}),
                       {{0.75, 0.75}, {64}})) {
    lamp_.position = {1.5, 1.5, 2.5};
    receivers_ = MakeReceivers(room_, {}, {{{1, 1, 0.01}, {0, 0, 1}}, {{1, 1, 2}, {0, 0, 1}}});
    visibility_ = ComputeVisibility(room_, receivers_, {lamp_});
  }
  ColourIlluminance Compute(const Eigen::Matrix3Xd& albedo, const Eigen::Vector3d& weights) const {
    return ComputeColourIlluminance(room_, receivers_, visibility_, {lamp_}, albedo, weights);
  }
  Eigen::VectorXf Plain(double wall, double floor) const {
    return ComputeIlluminance(room_, receivers_, visibility_, {lamp_}, Eigen::Vector2d(wall, floor))
        .total.col(0);
  }

  Room room_;
  Luminaire lamp_;
  Receivers receivers_;
  LuminaireVisibility visibility_;
  const Eigen::Vector3d weights_{0.265, 0.670, 0.065};
};

TEST_F(ColouredRoom, IsTheWeightedMeanOfItsChannels) {
  Eigen::Matrix3Xd albedo(3, 2);
  albedo << 0.8, 0.5, 0.4, 0.3, 0.1, 0.2;
  const ColourIlluminance light = Compute(albedo, 3 * weights_);  // weights need not sum to 1
  const Eigen::VectorXf expected =
      0.265f * Plain(0.8, 0.5) + 0.670f * Plain(0.4, 0.3) + 0.065f * Plain(0.1, 0.2);
  EXPECT_EQ(light.solved_channels, 3);
  EXPECT_LT((light.total.col(0) - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.maxCoeff());  // floats
  // Colour bleeding: not what the mean reflectance gives. Light reflected n times goes as rho^n, convex.
  const Eigen::Vector2d mean = albedo.transpose() * weights_;
  EXPECT_GT((light.total.col(0) - Plain(mean[0], mean[1])).minCoeff(), 1e-3 * expected.maxCoeff());
}

TEST_F(ColouredRoom, SolvesEqualChannelsOnce) {
  Eigen::Matrix3Xd grey(3, 2);
  grey << 0.6, 0.3, 0.6, 0.3, 0.6, 0.3;
  const ColourIlluminance light = Compute(grey, weights_);
  EXPECT_EQ(light.solved_channels, 1);
  EXPECT_LT((light.total.col(0) - Plain(0.6, 0.3)).cwiseAbs().maxCoeff(), 1e-6 * light.total.maxCoeff());
  Eigen::Matrix3Xd two = grey;
  two.row(1) << 0.5, 0.3;
  EXPECT_EQ(Compute(two, weights_).solved_channels, 2);
}

TEST_F(ColouredRoom, RefusesWhatHasNoMeaning) {
  const Eigen::Matrix3Xd grey = Eigen::Matrix3Xd::Constant(3, 2, 0.5);
  EXPECT_THROW(Compute(Eigen::Matrix3Xd::Constant(3, 3, 0.5), weights_), std::invalid_argument);
  EXPECT_THROW(Compute(grey, Eigen::Vector3d::Zero()), std::invalid_argument);
  EXPECT_THROW(Compute(grey, {1, -1, 1}), std::invalid_argument);
  EXPECT_THROW(Compute(Eigen::Matrix3Xd::Constant(3, 2, 1.0), weights_), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
