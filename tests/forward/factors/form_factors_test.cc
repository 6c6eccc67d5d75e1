#include "forward/factors/form_factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/support/closed_forms.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// Howell's catalogue C-11 and C-14 for the unit cube; a face's row, 1 opposite and 4 adjacent, adds up to 1.
constexpr double kOpposite = 0.199825, kAdjacent = 0.200044;

// Standard deviation of a share F found with n independent rays; the low-discrepancy rays are no worse.
double SamplingSigma(double share, double rays) { return std::sqrt(share * (1 - share) / rays); }

struct Ready {
  Scene scene;
  RayScene rays;
  Patches patches;
};
Ready MakeReady(const Scene& scene, const PatchesOptions& options) {
  RayScene rays(scene);
  Patches patches = Subdivide(scene, rays, options);
  return {scene, std::move(rays), std::move(patches)};
}

TEST(FormFactors, RowsOfAClosedRoomAddUpToOne) {
  const Ready room = MakeReady(support::ClosedRoom({3, 2, 2.5}), {0.5, 0.25});
  const FormFactors factors = ComputeFormFactors(room.rays, room.patches);
  EXPECT_EQ(factors.element_to_patch.rows(), static_cast<Eigen::Index>(room.patches.elements.size()));
  EXPECT_EQ(factors.escaped_fraction, 0);
  EXPECT_EQ(factors.back_fraction, 0);
  const Eigen::VectorXf sums = factors.element_to_patch.rowwise().sum();
  EXPECT_NEAR(sums.minCoeff(), 1, 1e-5);  // float rounding of some hundred terms
  EXPECT_NEAR(sums.maxCoeff(), 1, 1e-5);
  EXPECT_GE(factors.element_to_patch.minCoeff(), 0);
}

TEST(FormFactors, OfACubeAreItsClosedForms) {
  const Ready cube =
      MakeReady(support::ClosedRoom({1, 1, 1}), {1, 0.1});  // a patch a face, 100 elements each
  ASSERT_EQ(cube.patches.patches.size(), 6u);
  constexpr int kRays = 4096;
  const FormFactors factors = ComputeFormFactors(cube.rays, cube.patches, {kRays, FormFactorMethod::kMalley});
  double mean_opposite = 0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Eigen::RowVectorXf row = factors.element_to_patch.middleRows(100 * i, 100).colwise().mean();
    mean_opposite += row[i ^ 1] / 6;
    for (Eigen::Index j = 0; j < 6; ++j) {
      const double expected = j == i ? 0 : j == (i ^ 1) ? kOpposite : kAdjacent;
      EXPECT_NEAR(row[j], expected, 4 * SamplingSigma(0.2, 100 * kRays))
          << i << " to " << j;  // 36 of them: 4 sigma
    }
  }
  EXPECT_NEAR(mean_opposite, kOpposite, 3 * SamplingSigma(0.2, 600 * kRays));
}

TEST(FormFactors, AnOpenBoxReportsWhatEscapes) {
  Scene open = support::ClosedRoom({1, 1, 1});
  open.facets.pop_back();  // its lid
  const Ready box = MakeReady(open, {1, 0.1});
  constexpr int kRays = 1024;
  const FormFactors factors = ComputeFormFactors(box.rays, box.patches, {kRays, FormFactorMethod::kMalley});
  const double expected = (kOpposite + 4 * kAdjacent) / 5;  // through the lid from the floor and four walls
  EXPECT_NEAR(factors.escaped_fraction, expected, 4 * SamplingSigma(expected, 500 * kRays));
  EXPECT_EQ(factors.back_fraction, 0);
  const double kept = factors.element_to_patch.rowwise().sum().mean();
  EXPECT_NEAR(kept, 1 - factors.escaped_fraction, 1e-5);  // float rounding
}

TEST(FormFactors, RaysFromUnderASolidDoNotCount) {
  Scene scene = support::ClosedRoom({2, 2, 2});
  // Its sides cut through elements of 0.25 m; the part of those under it must take nothing from their rows.
  support::AddBox(scene, {Eigen::Vector3d(0.6, 0.6, 0), Eigen::Vector3d(1.1, 1.1, 1)},
                  support::Facing::kOutward, {"box"});
  scene.facets.erase(scene.facets.begin() + 10);  // its bottom, which lies in the floor
  const Ready room = MakeReady(scene, {0.5, 0.25});
  const FormFactors factors = ComputeFormFactors(room.rays, room.patches);
  EXPECT_GT(factors.back_fraction, 0);
  EXPECT_EQ(factors.escaped_fraction, 0);
  // 1e-5: float rounding. A ray may also end on a piece of floor that has been left out: none can see those
  // from outside.
  const Eigen::VectorXf sums = factors.element_to_patch.rowwise().sum();
  EXPECT_NEAR(sums.minCoeff(), 1, 1e-5);
  EXPECT_NEAR(sums.maxCoeff(), 1, 1e-5);
}

TEST(FormFactors, RepeatThemselves) {
  const Ready room = MakeReady(support::ClosedRoom({3, 2, 2.5}), {1, 0.5});
  EXPECT_EQ(ComputeFormFactors(room.rays, room.patches).element_to_patch,
            ComputeFormFactors(room.rays, room.patches).element_to_patch);
}

// A room with a partition, its factors known by many rays of one method: independent of the closed forms.
class EveryMethod : public testing::TestWithParam<FormFactorMethod> {
 protected:
  EveryMethod() {
    static const FormFactorMatrix reference =
        ComputeFormFactors(room_.rays, room_.patches, {65536, FormFactorMethod::kMalley}).element_to_patch;
    reference_ = &reference;
  }

  static Ready RoomWithPartition() {
    Scene scene = support::ClosedRoom({3, 2, 2.5});
    support::AddBox(scene, {Eigen::Vector3d(1.4, 0, 0), Eigen::Vector3d(1.5, 1.2, 1.8)},
                    support::Facing::kOutward, {"partition"});
    return MakeReady(scene, {0.5, 0.5});
  }

  Ready room_ = RoomWithPartition();
  const FormFactorMatrix* reference_;
};

// Error of the illuminance that a smooth exitance gives, root mean square over the elements, relative.
double IlluminanceError(const Patches& patches, const FormFactorMatrix& a, const FormFactorMatrix& b) {
  Eigen::VectorXf exitance(static_cast<Eigen::Index>(patches.patches.size()));
  for (size_t j = 0; j < patches.patches.size(); ++j) {
    const Eigen::Vector3d& c = patches.patches[j].center;
    exitance[static_cast<Eigen::Index>(j)] =
        static_cast<float>(1 + std::sin(1.3 * c.x() + 0.7 * c.y() - c.z()));
  }
  return ((a - b) * exitance).norm() / (b * exitance).norm();
}

TEST_P(EveryMethod, FindsTheFactorsOfARoomWithAPartition) {
  const FormFactors factors = ComputeFormFactors(room_.rays, room_.patches, {1024, GetParam()});
  EXPECT_EQ(factors.method, GetParam());
  EXPECT_GT(factors.rays, 0);
  EXPECT_GE(factors.element_to_patch.minCoeff(), 0);
  // Methods that spread their rays over the element: 1 / sqrt(1024) = 3 % for purely random ones. Those that
  // start at its centre see half a metre of a wall from one point: some percents near edges, which no number
  // of rays fixes.
  const bool from_center = OpsOf(GetParam()).is_from_center;
  EXPECT_LT(IlluminanceError(room_.patches, factors.element_to_patch, *reference_), from_center ? 0.1 : 0.03);
  const Eigen::VectorXf sums = factors.element_to_patch.rowwise().sum();
  // The partition's bottom and its side in the wall, 1.2 m and 1.8 m long, face out of the room and see
  // nothing: 3 and 4 elements.
  const double inside = static_cast<double>((sums.array() > 0).count());
  EXPECT_NEAR(sums.sum() / inside, 1, from_center ? 0.05 : 0.01);
  EXPECT_EQ(static_cast<double>(sums.size()) - inside, 3 + 4);
}

std::vector<FormFactorMethod> Methods() {
  std::vector<FormFactorMethod> methods;
  for (const FormFactorOps& ops : FormFactorMethods()) methods.push_back(ops.method);
  return methods;
}

INSTANTIATE_TEST_SUITE_P(FormFactors, EveryMethod, testing::ValuesIn(Methods()),
                         [](const auto& method) { return ToString(method.param); });

TEST(FormFactors, OfTheHybridAreExactWhereNothingStandsBetween) {
  const Ready room = MakeReady(support::ClosedRoom({3, 2, 2.5}), {0.5, 0.5});
  const FormFactors hybrid = ComputeFormFactors(room.rays, room.patches);
  const FormFactors analytic = ComputeFormFactors(room.rays, room.patches, {1, FormFactorMethod::kAnalytic});
  EXPECT_LT(analytic.closure_error, 1e-6);  // float rounding of the sums
  EXPECT_LT(hybrid.closure_error, 1e-4);    // quadrature, see pair_rows.cc
  EXPECT_LT(ReciprocityError(room.patches, analytic), 1e-6);
  EXPECT_LT((hybrid.element_to_patch - analytic.element_to_patch).rowwise().norm().maxCoeff(), 1e-4);
}

TEST(FormFactors, NeedRays) {
  const Ready room = MakeReady(support::ClosedRoom({1, 1, 1}), {1, 1});
  EXPECT_THROW(ComputeFormFactors(room.rays, room.patches, {0}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
