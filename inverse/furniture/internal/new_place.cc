#include "inverse/furniture/internal/new_place.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "inverse/furniture/internal/piece_cells.h"

namespace luxfit {
namespace {

constexpr double kCoarseCellM = 0.08, kCoarseStepM = 0.02, kFineCellM = 0.03, kFineStepM = 0.01;
constexpr int kCoarseReach = 10, kFineReach = 4;  // steps: edges of boxes are off by up to 0.17 m
constexpr double kCoarseTolerance = 2;            // over that of the fine search
constexpr double kPlateauShare = 0.97;
constexpr double kLeastShareOfPiece = 0.7;
constexpr double kBeyondRoomM = 0.03, kTouchM = 0.01;

using Steps = std::pair<int, int>;  // along the room's two axes

struct ShiftScore {
  int sum = 0;  // of votes
  double agree_m2 = 0, judged_m2 = 0;
};

// A piece along the room's axes, and where it may stand.
struct ShiftedPiece {
  const RoomAxes& axes;
  Eigen::AlignedBox3d bounds;
  std::vector<Eigen::Vector3d> free_places;

  Eigen::Vector3d ShiftOf(const Steps& steps, double step_m) const {
    return {steps.first * step_m, steps.second * step_m, 0};
  }
  bool IsAllowed(const Eigen::Vector3d& shift) const {
    const Eigen::AlignedBox3d moved(bounds.min() + shift, bounds.max() + shift);
    const Eigen::Vector3d beyond = Eigen::Vector3d::Constant(kBeyondRoomM);
    if (!Eigen::AlignedBox3d(axes.bounds.min() - beyond, axes.bounds.max() + beyond).contains(moved))
      return false;
    const Eigen::Vector3d touch = Eigen::Vector3d::Constant(kTouchM);
    const Eigen::AlignedBox3d inside(moved.min() + touch, moved.max() - touch);
    return std::none_of(free_places.begin(), free_places.end(),
                        [&](const Eigen::Vector3d& p) { return inside.contains(p); });
  }
};

// Lists the steps about those that lay sides or middles of the piece onto those of a box.
std::set<Steps> StepsNear(const std::vector<FoundBox>& found, const ShiftedPiece& piece) {
  std::set<Steps> steps;
  for (const FoundBox& f : found) {
    const Eigen::AlignedBox3d box = AlongAxes(f.box, piece.axes);
    std::array<std::array<int, 3>, 2> starts{};
    for (int i = 0; i < 2; ++i) {
      const double low = box.min()[i] - piece.bounds.min()[i], high = box.max()[i] - piece.bounds.max()[i];
      int k = 0;
      for (const double start_m : {low, 0.5 * (low + high), high})
        starts[static_cast<size_t>(i)][static_cast<size_t>(k++)] =
            static_cast<int>(std::lround(start_m / kCoarseStepM));
    }
    for (const int x : starts[0])
      for (const int y : starts[1])
        for (int dx = -kCoarseReach; dx <= kCoarseReach; ++dx)
          for (int dy = -kCoarseReach; dy <= kCoarseReach; ++dy) steps.emplace(x + dx, y + dy);
  }
  return steps;
}

ShiftScore ScoreOf(const SweptViews& swept, const std::vector<PieceCell>& cells,
                   const Eigen::Vector3d& shift) {
  ShiftScore score;
  CellJudge judge(swept);
  std::uint64_t agreeing = 0;
  for (const PieceCell& cell : cells) {
    const int vote = judge.VoteOn(cell.place + shift, cell.normal, agreeing);
    score.sum += vote;
    if (vote != 0) score.judged_m2 += cell.area_m2;
    if (vote > 0) score.agree_m2 += cell.area_m2;
  }
  return score;
}

struct BestShift {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // along the room's axes
  ShiftScore score;
};

std::optional<BestShift> BestOf(const SweptViews& swept, const std::vector<PieceCell>& cells,
                                const ShiftedPiece& piece, const std::vector<Eigen::Vector3d>& shifts) {
  std::vector<ShiftScore> scores(shifts.size());
  tbb::parallel_for(size_t{0}, shifts.size(), [&](size_t i) {
    scores[i] = ScoreOf(swept, cells, piece.axes.world_from_axes * shifts[i]);
  });
  BestShift best;
  for (const ShiftScore& score : scores)
    if (score.sum > best.score.sum) best.score = score;
  if (best.score.sum <= 0) return std::nullopt;
  int count = 0;
  for (size_t i = 0; i < shifts.size(); ++i)
    if (scores[i].sum >= kPlateauShare * best.score.sum) best.shift += shifts[i], ++count;
  best.shift /= count;
  return best;
}

}  // namespace

std::optional<Eigen::Vector3d> FindNewPlace(const Scene& mesh, const std::vector<int>& piece,
                                            const SweptViews& swept, const RoomAxes& axes,
                                            const std::vector<FoundBox>& found,
                                            const FurnitureOptions& options) {
  const ShiftedPiece shifted{axes, AlongAxes(mesh, piece, axes), AlongAxes(options.free_places, axes)};
  std::vector<Eigen::Vector3d> shifts;
  for (const Steps& steps : StepsNear(found, shifted)) {
    const Eigen::Vector3d shift = shifted.ShiftOf(steps, kCoarseStepM);
    if (shifted.IsAllowed(shift)) shifts.push_back(shift);
  }
  SweptViews coarse = swept;
  coarse.tolerance *= kCoarseTolerance;
  const auto rough = BestOf(coarse, CellsOf(mesh, piece, kCoarseCellM), shifted, shifts);
  if (!rough) return std::nullopt;
  shifts.clear();
  for (int dx = -kFineReach; dx <= kFineReach; ++dx) {
    for (int dy = -kFineReach; dy <= kFineReach; ++dy) {
      const Eigen::Vector3d shift = rough->shift + shifted.ShiftOf({dx, dy}, kFineStepM);
      if (shifted.IsAllowed(shift)) shifts.push_back(shift);
    }
  }
  const auto fine = BestOf(swept, CellsOf(mesh, piece, kFineCellM), shifted, shifts);
  if (!fine || fine->score.agree_m2 < options.least_face_m2 ||
      fine->score.agree_m2 < kLeastShareOfPiece * fine->score.judged_m2)
    return std::nullopt;
  return axes.world_from_axes * fine->shift;
}

}  // namespace luxfit
