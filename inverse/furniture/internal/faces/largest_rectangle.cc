#include "inverse/furniture/internal/faces/largest_rectangle.h"

namespace luxfit {

VoteRectangle FindLargestRectangle(const VoteGrid& votes) {
  VoteRectangle best;
  for (Eigen::Index top = 0; top < votes.rows(); ++top) {
    Eigen::ArrayXi sums = Eigen::ArrayXi::Zero(votes.cols());
    for (Eigen::Index bottom = top; bottom < votes.rows(); ++bottom) {
      sums += votes.row(bottom).cast<int>().transpose();
      int run = 0;
      Eigen::Index first = 0;
      for (Eigen::Index column = 0; column < votes.cols(); ++column) {
        if (run <= 0) run = 0, first = column;
        run += sums[column];
        if (run > best.sum)
          best = {static_cast<int>(top), static_cast<int>(first), static_cast<int>(bottom - top + 1),
                  static_cast<int>(column - first + 1), run};
      }
    }
  }
  return best;
}

}  // namespace luxfit
