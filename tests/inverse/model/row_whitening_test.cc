#include "inverse/model/internal/weights/row_whitening.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <random>
#include <vector>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kRounding = 1e-10;  // of sums of some dozen products; eigenvalues reach 1e3

Eigen::MatrixXd RandomMatrix(Eigen::Index rows, Eigen::Index cols, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd matrix(rows, cols);
  for (double& x : matrix.reshaped()) x = normal(rng);
  return matrix;
}

// Holds a whitening beside the same shared errors as a dense matrix U.
struct Shared {
  RowWhitening whitening;
  Eigen::MatrixXd u;

  Eigen::MatrixXd Covariance() const {
    return Eigen::MatrixXd::Identity(u.rows(), u.rows()) + u * u.transpose();
  }
  Eigen::MatrixXd W() const {
    RowWhitening::Rows rows = RowWhitening::Rows::Identity(u.rows(), u.rows());
    whitening.Apply(rows);
    return rows;
  }

  void AppendColumn(const Eigen::VectorXd& column) {
    u.conservativeResize(Eigen::NoChange, u.cols() + 1);
    u.rightCols(1) = column;
  }
  // Adds a group whose rows lie apart.
  void AddSingle(const std::vector<Eigen::Index>& rows, std::mt19937_64& rng) {
    std::normal_distribution<double> normal;
    Eigen::VectorXd column = Eigen::VectorXd::Zero(u.rows());
    std::vector<double> effect;
    effect.reserve(rows.size());
    for (const Eigen::Index i : rows) {
      effect.push_back(2 * normal(rng));
      column[i] = effect.back();
    }
    whitening.Add(rows, effect);
    AppendColumn(column);
  }
  // Adds rows that depend on six quantities of their owner. Owners take turns; their errors have a joint root.
  void AddPoses(Eigen::Index first, Eigen::Index count, int owners, Eigen::Index shared,
                std::mt19937_64& rng) {
    constexpr Eigen::Index kQuantities = 6;
    const Eigen::MatrixXd effect = RandomMatrix(count, kQuantities, rng);
    const Eigen::MatrixXd root = RandomMatrix(owners * kQuantities, shared, rng);
    std::vector<int> owner;
    owner.reserve(static_cast<size_t>(count));
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(u.rows(), shared);
    for (Eigen::Index i = 0; i < count; ++i) {
      owner.push_back(static_cast<int>(i) % owners);
      own.row(first + i) = effect.row(i) * root.middleRows(owner.back() * kQuantities, kQuantities);
    }
    whitening.Add(first, effect, owner, root);
    u.conservativeResize(Eigen::NoChange, u.cols() + shared);
    u.rightCols(shared) = own;
  }
};

Shared NothingShared(Eigen::Index rows) { return {RowWhitening(), Eigen::MatrixXd(rows, 0)}; }

Shared Groups(std::mt19937_64& rng) {
  Shared shared = NothingShared(12);
  shared.AddSingle({0, 4, 8}, rng);
  shared.AddSingle({1, 2, 3, 9, 11}, rng);
  shared.AddSingle({5}, rng);  // rows 6, 7 and 10 stand alone
  return shared;
}

// More rows than shared errors, and fewer.
Shared Poses(Eigen::Index shared_errors, std::mt19937_64& rng) {
  Shared shared = NothingShared(16);
  shared.AddPoses(2, 13, 3, shared_errors, rng);
  return shared;
}

Shared GroupsAndPoses(std::mt19937_64& rng) {
  Shared shared = NothingShared(30);
  shared.AddSingle({0, 3, 6}, rng);
  shared.AddSingle({1, 2, 29}, rng);
  shared.AddPoses(8, 20, 2, 5, rng);
  return shared;
}

std::vector<Shared> AllKinds(std::mt19937_64& rng) {
  return {Groups(rng), Poses(4, rng), Poses(18, rng), GroupsAndPoses(rng)};
}

double LargestOf(const Eigen::MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

TEST(RowWhitening, ItsSquareIsTheInverseCovariance) {
  std::mt19937_64 rng = support::TestRng();
  for (const Shared& shared : AllKinds(rng)) {
    const Eigen::MatrixXd w = shared.W();
    EXPECT_LT(LargestOf(w * w - shared.Covariance().inverse()), kRounding) << shared.u.cols() << " shared";
    EXPECT_LT(LargestOf(w - w.transpose()), kRounding) << shared.u.cols() << " shared";
    EXPECT_EQ(w.llt().info(), Eigen::Success);  // the positive root
  }
}

TEST(RowWhitening, AVectorIsWhitenedAsAColumnIs) {
  std::mt19937_64 rng = support::TestRng();
  for (const Shared& shared : AllKinds(rng)) {
    const Eigen::VectorXd rows = RandomMatrix(shared.u.rows(), 1, rng);
    Eigen::VectorXd whitened = rows;
    shared.whitening.Apply(whitened);
    EXPECT_LT(LargestOf(whitened - shared.W() * rows), kRounding) << shared.u.cols() << " shared";
  }
}

TEST(RowWhitening, TheRemainderAndItsVarianceAreThoseOfTheInverseCovariance) {
  std::mt19937_64 rng = support::TestRng();
  for (const Shared& shared : AllKinds(rng)) {
    const Eigen::MatrixXd inverse = shared.Covariance().inverse();
    const Eigen::VectorXd rows = RandomMatrix(shared.u.rows(), 1, rng);
    EXPECT_LT(LargestOf(shared.whitening.Remainder(rows) - inverse * rows), kRounding)
        << shared.u.cols() << " shared";
    EXPECT_LT(LargestOf(shared.whitening.RemainingVariance(rows.size()) - inverse.diagonal()), kRounding)
        << shared.u.cols() << " shared";
  }
}

TEST(RowWhitening, EffectsOfZeroChangeNothing) {
  std::mt19937_64 rng = support::TestRng();
  const Eigen::VectorXd rows = RandomMatrix(10, 1, rng);
  const Eigen::MatrixXd root = RandomMatrix(12, 3, rng);
  RowWhitening whitening;
  whitening.Add({0, 3, 4}, {0, 0, 0});
  whitening.Add(5, Eigen::MatrixXd::Zero(4, 6), {0, 1, 0, 1}, root);
  whitening.Add(5, RandomMatrix(4, 6, rng), {0, 1, 0, 1}, Eigen::MatrixXd::Zero(12, 3));
  whitening.Add(5, RandomMatrix(4, 6, rng), {0, 1, 0, 1}, Eigen::MatrixXd());
  Eigen::VectorXd whitened = rows;
  whitening.Apply(whitened);
  EXPECT_EQ(whitened, rows);
  EXPECT_EQ(whitening.Remainder(rows), rows);
  EXPECT_EQ(whitening.RemainingVariance(10), Eigen::VectorXd::Ones(10));
}

// Variable projection: min over x, a |A x + U a - b|^2 + |a|^2 has the x of min |W (A x - b)|^2.
TEST(RowWhitening, TheFitIsThatWithTheSharedErrorsAsParameters) {
  std::mt19937_64 rng = support::TestRng();
  for (const Shared& shared : AllKinds(rng)) {
    const Eigen::Index rows = shared.u.rows(), errors = shared.u.cols(), parameters = 3;
    const Eigen::MatrixXd a = RandomMatrix(rows, parameters, rng);
    const Eigen::VectorXd b = RandomMatrix(rows, 1, rng);

    Eigen::MatrixXd all(rows, parameters + errors);
    all << a, shared.u;
    Eigen::MatrixXd information = all.transpose() * all;
    information.bottomRightCorner(errors, errors).diagonal().array() += 1;
    const Eigen::VectorXd expected = information.ldlt().solve(all.transpose() * b);

    RowWhitening::Rows jacobian = a;
    Eigen::VectorXd target = b;
    shared.whitening.Apply(jacobian);
    shared.whitening.Apply(target);
    const Eigen::VectorXd found =
        (jacobian.transpose() * jacobian).ldlt().solve(jacobian.transpose() * target);

    // Normal equations square the condition number.
    EXPECT_LT(LargestOf(found - expected.head(parameters)), 1e-9) << errors << " shared";
    EXPECT_LT(LargestOf(shared.whitening.Remainder(b - a * found) - (b - all * expected)), 1e-9)
        << errors << " shared";
  }
}

}  // namespace
}  // namespace luxfit
