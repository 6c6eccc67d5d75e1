#include "forward/radiosity/internal/sparse_transport.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "forward/light/room.h"
#include "forward/radiosity/solvers.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// Few rays, so that most pairs are missing.
class SparseRoom : public testing::Test {
 protected:
  SparseRoom() {
    Scene scene = support::ClosedRoom({4, 3, 2.5}, {"wall", "wall", "wall", "wall", "floor", "wall"});
    support::AddBox(scene, {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(2.1, 1.9, 1.2)},
                    support::Facing::kOutward, {"solid"});
    support::AddTriangle(scene, {3, 0.5, 1}, {0.5, 0, 0.2}, {0, 0.5, 0}, "solid");
    RoomOptions options;
    options.patches = {0.5, 0.25};
    options.form_factors.rays_per_element = 32;
    options.form_factors.method = FormFactorMethod::kMalley;  // the rays that the sparse store keeps
    room_ = std::make_unique<Room>(MakeRoom(scene, options));
    sparse_ = std::make_unique<SparseTransport>(room_->rays, room_->patches, options.form_factors);
  }
  const FormFactorMatrix& dense() const { return room_->transport.coupling; }
  std::unique_ptr<Room> room_;
  std::unique_ptr<SparseTransport> sparse_;
};

TEST_F(SparseRoom, HoldsTheNumbersOfTheDenseMatrix) {
  std::mt19937_64 rng = support::TestRng();
  const Eigen::Index n = dense().rows();
  ASSERT_EQ(sparse_->size(), n);
  EXPECT_EQ(sparse_->pair_count(), (dense().array() != 0).count());
  EXPECT_LT(sparse_->pair_count(), n * n / 2) << "sparse";
  const float rounding = 1e-5f * dense().maxCoeff();
  EXPECT_LT((sparse_->DiagonalBlock(3, 200) - dense().block(3, 3, 200, 200)).cwiseAbs().maxCoeff(), rounding);
  const Eigen::MatrixXf x =
      Eigen::MatrixXf::NullaryExpr(n, 2, [&] { return std::uniform_real_distribution<float>(-1, 1)(rng); });
  EXPECT_LT((sparse_->RowsTimes(7, 100, x) - dense().middleRows(7, 100) * x).cwiseAbs().maxCoeff(), 1e-5f);
  Eigen::VectorXf y = x.col(0);
  sparse_->AddColumn(5, 2.5f, y);
  EXPECT_LT((y - x.col(0) - 2.5f * dense().col(5)).cwiseAbs().maxCoeff(), 1e-5f);
}

TEST_F(SparseRoom, IterativeSolversGiveWhatTheyGiveForTheDenseMatrix) {
  const Eigen::Vector3d albedo(0.7, 0.3, 0.5);
  // Every third patch lit. (A single lit patch would put its 100 lx so far above the mean that floats end
  // short of 0.1 % of it.)
  const Eigen::MatrixXf direct = Eigen::MatrixXf::NullaryExpr(
      dense().rows(), 3, [](Eigen::Index i, Eigen::Index column) { return i % 3 == column ? 100.0f : 0.0f; });
  for (const RadiositySolver solver :
       {RadiositySolver::kAuto, RadiositySolver::kJacobi, RadiositySolver::kGaussSeidel,
        RadiositySolver::kNeumann, RadiositySolver::kShooting, RadiositySolver::kConjugateGradient,
        RadiositySolver::kBicgstab}) {
    const std::string name = ToString(solver);
    RadiositySolverOptions options;
    options.solver = solver;
    const RadiositySolution sparse = SolveRadiosity(*sparse_, PatchAreas(room_->patches),
                                                    PatchMaterials(room_->patches), albedo, direct, options);
    if (options.solver == RadiositySolver::kAuto) options.solver = sparse.solver;
    const RadiositySolution full = SolveRadiosity(room_->transport, albedo, direct, options);
    EXPECT_TRUE(sparse.converged) << name << ": " << sparse.message;
    // Shooting may pick another patch where rounding decides between two: the tolerance, not rounding.
    const float allowed = 1e-3f * full.exitance.cwiseAbs().colwise().mean().maxCoeff();
    EXPECT_LT((sparse.exitance - full.exitance).cwiseAbs().maxCoeff(), allowed) << name;
  }
}

TEST_F(SparseRoom, RaysAreNeeded) {
  EXPECT_THROW(SparseTransport(room_->rays, room_->patches, {0}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
