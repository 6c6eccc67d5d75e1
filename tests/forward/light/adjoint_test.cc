#include "forward/light/internal/adjoint.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// A room with a box in it, two luminaires, elements and sensors that look.
class AdjointTest : public testing::Test {
 protected:
  AdjointTest() {
    Scene scene = support::ClosedRoom({4, 3, 2.5}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
    support::AddBox(scene, {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1.6, 2, 1)}, support::Facing::kOutward,
                    {"box"});
    room_ = std::make_unique<Room>(MakeRoom(scene, {{0.5, 0.25}, {64}}));
    luminaires_.resize(2);
    luminaires_[0].position = {1, 1.2, 2.3};
    luminaires_[0].flux_lm = 1200;
    luminaires_[1].position = {3, 2, 2.2};
    luminaires_[1].shape = LuminaireShape::kRectangle;
    luminaires_[1].size_m = {0.6, 0.3};
    luminaires_[1].flux_lm = 800;
    receivers_ = MakeReceivers(*room_, {3, 50, 200},
                               {{{2, 1, 0.8}, {0, 0, 1}, {}}, {{3.5, 2.5, 1.2}, {-1, 0, 0}, {}}});
    visibility_ = ComputeVisibility(*room_, receivers_, luminaires_);
    std::mt19937_64 rng = support::TestRng();
    std::uniform_real_distribution<double> uniform(-1, 1);
    weights_.resize(receivers_.count());
    for (double& w : weights_) w = uniform(rng);
    albedo_ = Eigen::Vector4d(0.6, 0.3, 0.8, 0.4);
    for (int k = 0; k < 2; ++k) {
      for (const LuminaireQuantity q :
           {LuminaireQuantity::kPositionX, LuminaireQuantity::kPositionZ, LuminaireQuantity::kTiltAlong})
        request_.parameters.push_back({k, q});
    }
    request_.materials = {0, 1, 2, 3};
  }

  std::unique_ptr<Room> room_;
  std::vector<Luminaire> luminaires_;
  Receivers receivers_;
  LuminaireVisibility visibility_;
  Eigen::VectorXd weights_, albedo_;
  DerivativeRequest request_;
};

TEST_F(AdjointTest, GivesWhatForwardModeGives) {
  const Illuminance forward =
      ComputeIlluminance(*room_, receivers_, visibility_, luminaires_, albedo_, request_);
  const AdjointDerivatives adjoint =
      ComputeAdjoint(*room_, receivers_, visibility_, luminaires_, albedo_, weights_, request_);
  const Eigen::VectorXd per_lumen = forward.total.cast<double>().transpose() * weights_;
  const double size = (forward.total.cast<double>().transpose() * weights_.cwiseAbs()).maxCoeff();
  const double rounding = 1e-4 * size;  // of floats, through sums of a thousand terms
  double sum = 0;
  for (Eigen::Index k = 0; k < 2; ++k) {
    EXPECT_NEAR(adjoint.d_flux[k], per_lumen[k], rounding);
    sum += luminaires_[static_cast<size_t>(k)].flux_lm * per_lumen[k];
  }
  EXPECT_NEAR(adjoint.sum_lx, sum, 2000 * rounding);
  const Eigen::VectorXd d_luminaire = forward.d_luminaire.cast<double>().transpose() * weights_;
  for (size_t p = 0; p < request_.parameters.size(); ++p) {
    const double flux = luminaires_[static_cast<size_t>(request_.parameters[p].luminaire)].flux_lm;
    EXPECT_NEAR(adjoint.d_parameters[static_cast<Eigen::Index>(p)] / flux,
                d_luminaire[static_cast<Eigen::Index>(p)], 5 * rounding)
        << p;
  }
  const Eigen::VectorXd d_albedo = forward.d_albedo.cast<double>().transpose() * weights_;
  for (Eigen::Index m = 0; m < 4; ++m) {
    const double expected = luminaires_[0].flux_lm * d_albedo[m] + luminaires_[1].flux_lm * d_albedo[4 + m];
    EXPECT_NEAR(adjoint.d_albedo[m], expected, 1e-3 * d_albedo.norm() * 2000) << m;
  }
  EXPECT_NEAR(adjoint.d_patch_albedo.sum(), adjoint.d_albedo.sum(),
              1e-9 * std::abs(adjoint.d_albedo.sum()) + 1e-9);
}

TEST_F(AdjointTest, NeedsAWeightForEveryReceiver) {
  EXPECT_THROW(
      ComputeAdjoint(*room_, receivers_, visibility_, luminaires_, albedo_, Eigen::VectorXd::Ones(2)),
      std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
