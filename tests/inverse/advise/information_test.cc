// The algebra of advice against covariances that are computed by brute force: all rows, their whole error covariance,
// inverses.
#include "inverse/advise/information.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <vector>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr Eigen::Index kParameters = 5;
constexpr PhotoSigmas kSigmas{0.012, 0.02, 0.01};
// Sums of some hundred products: rounding.
constexpr double kRounding = 1e-9;

Eigen::MatrixXd RandomMatrix(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(rng); });
}

Eigen::MatrixXd RandomCovariance(std::mt19937_64& rng) {
  const Eigen::MatrixXd root = 0.05 * RandomMatrix(kParameters, kParameters + 3, rng);
  return root * root.transpose();
}

// Photo `first` to `first + count` of elements, two states, patches of four elements.
std::vector<PhotoRow> PhotoOf(int first, int count, int state, std::mt19937_64& rng) {
  std::vector<PhotoRow> rows;
  for (int e = first; e < first + count; ++e)
    rows.push_back({e, e / 4, state, RandomMatrix(kParameters, 1, rng)});
  return rows;
}

// Returns J^T R^-1 J of rows whose R is written out: `photo` numbers the photo whose gain they share, -1: none.
Eigen::MatrixXd InformationByHand(const std::vector<PhotoRow>& rows, const std::vector<int>& photo) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(count, count), jacobian(count, kParameters);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& a = rows[static_cast<size_t>(i)];
    jacobian.row(i) = a.derivative.transpose();
    for (Eigen::Index j = 0; j < count; ++j) {
      const auto& b = rows[static_cast<size_t>(j)];
      if (i == j) errors(i, j) += kSigmas.row * kSigmas.row;
      if (a.patch == b.patch && a.state == b.state) errors(i, j) += kSigmas.patch * kSigmas.patch;
      const int of_a = photo[static_cast<size_t>(i)], of_b = photo[static_cast<size_t>(j)];
      if (of_a >= 0 && of_a == of_b) errors(i, j) += kSigmas.view * kSigmas.view;
    }
  }
  return jacobian.transpose() * errors.inverse() * jacobian;
}

void ExpectNear(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  EXPECT_LT((a - b).norm(), kRounding * b.norm()) << a << "\n\n" << b;
}

TEST(CovarianceWith, IsTheInverseOfTheSumOfInformations) {
  std::mt19937_64 rng = support::TestRng();
  const Eigen::MatrixXd covariance = RandomCovariance(rng);
  const Eigen::MatrixXd rows = RandomMatrix(3, kParameters, rng) / 0.02;
  const Eigen::MatrixXd information = rows.transpose() * rows;
  const Eigen::MatrixXd expected = (covariance.inverse() + information).inverse();
  const Eigen::MatrixXd root = CovarianceRoot(covariance);
  ExpectNear(root * root.transpose(), covariance);
  ExpectNear(CovarianceWith(root, information), expected);
  const Eigen::MatrixXd quantities = RandomMatrix(2, kParameters, rng);
  ExpectNear(VariancesWith(root, quantities, information),
             (quantities * expected * quantities.transpose()).diagonal());
}

TEST(CovarianceWith, AParameterThatWasHeldStaysHeld) {
  std::mt19937_64 rng = support::TestRng();
  Eigen::MatrixXd covariance = RandomCovariance(rng);
  covariance.row(2).setZero();
  covariance.col(2).setZero();
  const Eigen::MatrixXd rows = RandomMatrix(4, kParameters, rng);
  const Eigen::MatrixXd after = CovarianceWith(CovarianceRoot(covariance), rows.transpose() * rows);
  EXPECT_LT(after.row(2).norm(), kRounding * covariance.norm());
  EXPECT_GT(covariance(0, 0), after(0, 0));
}

TEST(TakenRows, TheFirstPhotoTellsWhatItsErrorsLeave) {
  std::mt19937_64 rng = support::TestRng();
  const std::vector<PhotoRow> photo = PhotoOf(0, 22, 0, rng);
  const TakenRows taken(kSigmas, 1);
  ExpectNear(taken.InformationOf(photo), InformationByHand(photo, std::vector<int>(photo.size(), 0)));
}

TEST(TakenRows, ALaterPhotoAddsWhatEarlierRowsDoNotTell) {
  std::mt19937_64 rng = support::TestRng();
  // Elements 8 to 15 were seen, those of 16 and 17 share a patch with others that were.
  std::vector<PhotoRow> earlier = PhotoOf(0, 18, 0, rng), later = PhotoOf(8, 20, 0, rng);
  const std::vector<PhotoRow> other_state = PhotoOf(0, 10, 1, rng);
  earlier.insert(earlier.end(), other_state.begin(), other_state.end());
  TakenRows taken(kSigmas, 1);
  taken.Add(earlier);
  std::vector<PhotoRow> all = earlier;
  std::vector<int> photo(earlier.size(), -1);
  for (const PhotoRow& row : later) {
    if (row.element < 18) continue;
    all.push_back(row);
    photo.push_back(0);
  }
  const Eigen::MatrixXd before = InformationByHand(earlier, std::vector<int>(earlier.size(), -1));
  ExpectNear(taken.InformationOf(later), InformationByHand(all, photo) - before);
  taken.Add(later);
  EXPECT_TRUE(taken.InformationOf(later).isZero()) << "seen already";
}

TEST(TakenRows, ElementsOfASampleStandForOthersLikeThem) {
  std::mt19937_64 rng = support::TestRng();
  const std::vector<PhotoRow> sample = PhotoOf(0, 12, 0, rng);
  std::vector<PhotoRow> all;
  for (const PhotoRow& row : sample) {
    for (int copy = 0; copy < 3; ++copy) {
      all.push_back(row);
      all.back().element = 3 * row.element + copy;
    }
  }
  ExpectNear(TakenRows(kSigmas, 3).InformationOf(sample), TakenRows(kSigmas, 1).InformationOf(all));
}

TEST(VarianceInflation, IsTheRatioOfVariancesWhereTheInformationTells) {
  std::mt19937_64 rng = support::TestRng();
  const Eigen::MatrixXd covariance = RandomCovariance(rng);
  EXPECT_NEAR(VarianceInflation(7 * covariance, covariance.inverse()), 7, 1e-6);
  EXPECT_EQ(VarianceInflation(0.1 * covariance, covariance.inverse()), 1) << "never below what rows say";
  Eigen::MatrixXd half = Eigen::MatrixXd::Zero(kParameters, kParameters);
  half.topLeftCorner(2, 2) = 4 * covariance.topLeftCorner(2, 2).inverse();
  EXPECT_NEAR(VarianceInflation(covariance, half), 4, 1e-6) << "over two directions of five";
  EXPECT_EQ(VarianceInflation(covariance, Eigen::MatrixXd::Zero(kParameters, kParameters)), 1);
}

TEST(Information, SizesThatDoNotFitAreRefused) {
  const Eigen::MatrixXd three = Eigen::MatrixXd::Identity(3, 3), two = Eigen::MatrixXd::Identity(2, 2);
  EXPECT_THROW(CovarianceWith(three, two), std::invalid_argument);
  const std::vector<PhotoRow> uneven = {{0, 0, 0, Eigen::Vector2d(1, 1)},
                                        {1, 0, 0, Eigen::Vector3d(1, 1, 1)}};
  EXPECT_THROW(TakenRows(kSigmas, 1).InformationOf(uneven), std::invalid_argument);
}

// As many rows and parameters as Eigen multiplies in blocks, which it cannot of nothing.
TEST(TakenRows, APhotoOfWhatWasTakenAddsNothing) {
  TakenRows taken({0.01, 0.01, 0.01}, 1);
  std::vector<PhotoRow> photo(200);
  for (int i = 0; i < 200; ++i) {
    photo[static_cast<size_t>(i)].element = i;
    photo[static_cast<size_t>(i)].derivative = Eigen::VectorXd::Constant(150, 1);
  }
  EXPECT_FALSE(taken.InformationOf(photo).isZero());
  taken.Add(photo);
  EXPECT_TRUE(taken.InformationOf(photo).isZero());
}

}  // namespace
}  // namespace luxfit
