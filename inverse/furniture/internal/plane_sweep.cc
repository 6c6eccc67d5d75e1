#include "inverse/furniture/internal/plane_sweep.h"

#include <algorithm>
#include <array>

#include "inverse/furniture/internal/signature.h"

namespace luxfit {
namespace {

constexpr double kLeastCosine = 0.15;
constexpr double kLeastShare = 0.6;  // of the views that face a cell

// Holds the views that face one cell. It is a class because the buffers serve all cells.
class CellJudge {
 public:
  explicit CellJudge(const SweptViews& swept)
      : swept_(swept), signatures_(swept.views.empty() ? 0 : swept.views.front().states) {}

  int VoteOn(const Eigen::Vector3d& place, const Eigen::Vector3d& normal, std::uint64_t& agreeing) {
    agreeing = 0;
    FindFacing(place, normal);
    if (count_ < swept_.fewest_views) return 0;
    if (UnexplainedOf((std::uint64_t{1} << count_) - 1) < 2) return -1;
    Sample();
    if (count_ < swept_.fewest_views) return 0;
    const std::uint64_t best = LargestAgreement();
    const int agree = __builtin_popcountll(best), unexplained = UnexplainedOf(best);
    if (agree < swept_.fewest_views || agree < kLeastShare * count_) return -1;
    if (2 * unexplained < agree) return -1;
    for (int i = 0; i < count_; ++i) {
      if ((best >> i & 1U) != 0 && !facing_[static_cast<size_t>(i)].is_explained)
        agreeing |= std::uint64_t{1} << facing_[static_cast<size_t>(i)].view;
    }
    return 1;
  }

 private:
  struct Facing {
    int view = 0;
    bool is_explained = false;
    Eigen::Vector2d pixel;
  };

  void FindFacing(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
    count_ = 0;
    const size_t views = std::min<size_t>(swept_.views.size(), kMostViews - 1);
    for (size_t v = 0; v < views; ++v) {
      const Eigen::Vector3d to_eye = swept_.eyes[v] - place;
      const double distance = to_eye.norm();
      if (to_eye.dot(normal) < kLeastCosine * distance) continue;
      const Eigen::Vector2d pixel = PixelOf(swept_.views[v], place);
      if (!(pixel.x() > 0)) continue;
      const MeshAgreement& mesh = swept_.mesh[v];
      const size_t cell = mesh.CellOf(pixel.x(), pixel.y());
      if (distance > mesh.distance_m[cell] + kOnMeshM) continue;
      facing_[static_cast<size_t>(count_++)] = {static_cast<int>(v), mesh.is_explained[cell] != 0, pixel};
    }
  }

  int UnexplainedOf(std::uint64_t set) const {
    int unexplained = 0;
    for (int i = 0; i < count_; ++i)
      unexplained += (set >> i & 1U) != 0 && !facing_[static_cast<size_t>(i)].is_explained ? 1 : 0;
    return unexplained;
  }

  // Keeps the views whose signature is known.
  void Sample() {
    signatures_.Clear();
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const Facing& f = facing_[static_cast<size_t>(i)];
      if (!signatures_.Add(swept_.views[static_cast<size_t>(f.view)], f.pixel.x(), f.pixel.y())) continue;
      facing_[static_cast<size_t>(kept++)] = f;
    }
    count_ = kept;
  }

  // Returns the views that agree with the one with which most agree.
  std::uint64_t LargestAgreement() const {
    std::array<std::uint64_t, kMostViews> agree{};
    for (int a = 0; a < count_; ++a) {
      agree[static_cast<size_t>(a)] |= std::uint64_t{1} << a;
      for (int b = a + 1; b < count_; ++b) {
        if (!signatures_.Agree(a, b, swept_.tolerance)) continue;
        agree[static_cast<size_t>(a)] |= std::uint64_t{1} << b;
        agree[static_cast<size_t>(b)] |= std::uint64_t{1} << a;
      }
    }
    return *std::max_element(agree.begin(), agree.begin() + count_, [](std::uint64_t a, std::uint64_t b) {
      return __builtin_popcountll(a) < __builtin_popcountll(b);
    });
  }

  const SweptViews& swept_;
  Signatures signatures_;
  std::array<Facing, kMostViews> facing_;
  int count_ = 0;
};

}  // namespace

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
