#include "inverse/furniture/internal/faces/plane_sweep.h"

namespace luxfit {

PlaneVotes Sweep(const SweptViews& swept, const SweptPlane& plane) {
  PlaneVotes result;
  result.votes.resize(plane.rows, plane.columns);
  result.views.resize(static_cast<size_t>(plane.rows) * static_cast<size_t>(plane.columns));
  CellJudge judge(swept);
  size_t at = 0;
  for (int row = 0; row < plane.rows; ++row) {
    for (int column = 0; column < plane.columns; ++column, ++at)
      result.votes(row, column) =
          static_cast<signed char>(judge.VoteOn(plane.CenterOf(row, column), plane.normal, result.views[at]));
  }
  return result;
}

void SweepAgain(const SweptViews& swept, const SweptPlane& plane, PlaneVotes& votes) {
  CellJudge judge(swept);
  size_t at = 0;
  for (int row = 0; row < plane.rows; ++row) {
    for (int column = 0; column < plane.columns; ++column, ++at) {
      if (votes.votes(row, column) > 0)
        votes.votes(row, column) = static_cast<signed char>(
            judge.VoteOn(plane.CenterOf(row, column), plane.normal, votes.views[at]));
    }
  }
}

}  // namespace luxfit
