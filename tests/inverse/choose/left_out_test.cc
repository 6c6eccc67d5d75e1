#include "inverse/choose/internal/left_out.h"

#include <gtest/gtest.h>

#include "inverse/choose/internal/luminaire_chooser.h"

namespace luxfit {
namespace {

constexpr int kRows = 40, kGroups = 8;

// A problem of photos' rows, each of an element of its own, with 100 measured everywhere.
SubProblem PlainProblem() {
  SubProblem problem;
  for (int i = 0; i < kRows; ++i) {
    problem.group_of_row.push_back(i % kGroups);
    problem.element_of_row.push_back(i);
    problem.material_of_row.push_back(0);
    problem.value.push_back(100);
    problem.variance.push_back(1);
  }
  return problem;
}

// A model that predicts `value`, and sees a shadow's edge in all rows from `smooth` on.
FittedModel ModelOf(double value, double relative_sigma, int smooth) {
  FittedModel model;
  model.left_out.value = Eigen::VectorXd::Constant(kRows, value);
  model.left_out.value.tail(kRows - smooth).setZero();
  model.left_out.is_smooth.assign(static_cast<size_t>(smooth), true);
  model.left_out.is_smooth.resize(kRows, false);
  model.left_out.relative_sigma = relative_sigma;
  model.left_out.texture_sigma = Eigen::VectorXd::Zero(1);
  return model;
}

TEST(SelectAmong, ComparesWhereNoModelSeesAShadowsEdge) {
  const FittedModel whole = ModelOf(101, 0.01, kRows), most = ModelOf(100, 0.01, kRows * 3 / 4);
  const Selection selection = SelectAmong(PlainProblem(), {&whole, &most}, {0, 1});
  EXPECT_EQ(selection.chosen, 1U);
  EXPECT_LT(selection.score[1], 1e-9) << "the last quarter, where it predicts nothing, does not count";
}

// A luminaire that a fit has lost in a corner explains the few rows that it sees whole.
TEST(SelectAmong, AModelThatExplainsFewRowsIsNeitherChosenNorAsked) {
  const FittedModel whole = ModelOf(101, 0.01, kRows), lost = ModelOf(100, 0.002, kRows / 8);
  const Selection selection = SelectAmong(PlainProblem(), {&lost, &whole}, {0, 1});
  EXPECT_EQ(selection.chosen, 1U);
  EXPECT_NEAR(selection.score[1], 0.5, 1e-9) << "1 of 100 by noise of 1 and the model error of 1 %";
  EXPECT_GT(selection.score[0], 7) << "it is scored by the rows of the other";
}

}  // namespace
}  // namespace luxfit
