// Finds the rectangle of a grid of votes that has the largest sum.
//
// Source: Bentley (1984), "Programming pearls: algorithm design techniques", CACM 27(9), for rows summed between
// every pair of rows: O(rows^2 columns).
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_LARGEST_RECTANGLE_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_LARGEST_RECTANGLE_H_

#include <Eigen/Core>

namespace luxfit {

using VoteGrid = Eigen::Array<signed char, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct VoteRectangle {
  int row = 0, column = 0, rows = 0, columns = 0;
  int sum = 0;  // 0: no vote is positive
};

VoteRectangle FindLargestRectangle(const VoteGrid& votes);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_LARGEST_RECTANGLE_H_
