#include "apps/session/photos/internal/same_view.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr double kSameShift =
    0.004;  // of the width: 2 px of 480, 16 px of 4000; another pose shifts far more
constexpr double kSameEdges = 0.15, kDoubtfulEdges = 0.08;
constexpr size_t kSeveralTags = 2;

struct PosePair {
  int common_tags = 0;
  double shift = 0;       // where there are common tags
  double agreement = 0;   // of the edges
  bool is_other = false;  // the tags say that the poses differ
  bool is_same = false;
};

// Ids that a photo shows once: copies of a tag tell nothing.
std::map<int, const TagDetection*> TagsById(const PhotoLook& photo) {
  std::map<int, const TagDetection*> by_id;
  std::vector<int> twice;
  for (const TagDetection& tag : photo.tags) {
    if (!by_id.emplace(tag.id, &tag).second) twice.push_back(tag.id);
  }
  for (const int id : twice) by_id.erase(id);
  return by_id;
}

PosePair ComparePoses(const PhotoLook& a, const PhotoLook& b) {
  PosePair pair;
  pair.is_other =
      a.width_px != b.width_px || a.height_px != b.height_px || a.capture.camera != b.capture.camera;
  if (pair.is_other) return pair;
  const auto tags_a = TagsById(a), tags_b = TagsById(b);
  std::vector<double> shifts;
  for (const auto& [id, tag] : tags_a) {
    const auto other = tags_b.find(id);
    if (other == tags_b.end()) continue;
    ++pair.common_tags;
    for (size_t c = 0; c < 4; ++c)
      shifts.push_back((tag->corners_px[c] - other->second->corners_px[c]).norm() / a.width_px);
  }
  if (!shifts.empty()) pair.shift = Median(shifts);
  pair.agreement = static_cast<double>(a.edges.matrix().dot(b.edges.matrix()));
  const bool has_moved = pair.common_tags > 0 && pair.shift >= kSameShift;
  const bool shares_none = pair.common_tags == 0 && std::min(tags_a.size(), tags_b.size()) >= kSeveralTags;
  pair.is_other = has_moved || shares_none;
  pair.is_same = !pair.is_other && (pair.common_tags > 0 || pair.agreement >= kSameEdges);
  return pair;
}

// Joins photos into sets, and refuses to join what its tags hold apart.
class PoseSets {
 public:
  explicit PoseSets(size_t photos) : set_(photos) { std::iota(set_.begin(), set_.end(), 0); }

  int Of(size_t photo) const { return set_[photo]; }
  void Join(size_t a, size_t b, const std::vector<std::vector<PosePair>>& pairs) {
    if (set_[a] == set_[b]) return;
    for (size_t i = 0; i < set_.size(); ++i) {
      for (size_t j = 0; j < set_.size(); ++j) {
        if (set_[i] == set_[a] && set_[j] == set_[b] && pairs[i][j].is_other) return;
      }
    }
    const int from = set_[b], to = set_[a];
    std::replace(set_.begin(), set_.end(), from, to);
  }

 private:
  std::vector<int> set_;
};

std::vector<std::vector<PosePair>> PairsOf(const std::vector<PhotoLook>& photos) {
  std::vector<std::vector<PosePair>> pairs(photos.size(), std::vector<PosePair>(photos.size()));
  for (size_t i = 0; i < photos.size(); ++i) {
    for (size_t j = 0; j < i; ++j) pairs[i][j] = pairs[j][i] = ComparePoses(photos[i], photos[j]);
  }
  return pairs;
}

// Pairs by tags come first, the most tags before others; then those by edges.
std::vector<std::pair<size_t, size_t>> SurestFirst(const std::vector<std::vector<PosePair>>& pairs) {
  std::vector<std::pair<size_t, size_t>> order;
  for (size_t i = 0; i < pairs.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (pairs[i][j].is_same) order.emplace_back(i, j);
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](const auto& x, const auto& y) {
    const PosePair &a = pairs[x.first][x.second], &b = pairs[y.first][y.second];
    return std::pair(a.common_tags, a.agreement) > std::pair(b.common_tags, b.agreement);
  });
  return order;
}

// Says what is doubtful about a photo whose view rests on edges.
std::string DoubtOf(const PoseGuess& guess, double best_elsewhere) {
  if (guess.tags > 0) return "";
  if (guess.agreement == 0)
    return best_elsewhere > kDoubtfulEdges ? "no tags are seen in it, and it resembles photos of another view"
                                           : "";
  return guess.agreement - best_elsewhere < kSameEdges ? "no tags are seen in it, and its edges fit two views"
                                                       : "";
}

}  // namespace

std::vector<PoseGuess> GroupByPose(const std::vector<PhotoLook>& photos) {
  const std::vector<std::vector<PosePair>> pairs = PairsOf(photos);
  PoseSets sets(photos.size());
  for (const auto& [i, j] : SurestFirst(pairs)) sets.Join(i, j, pairs);
  std::map<int, int> view_of_set;
  std::vector<PoseGuess> guesses(photos.size());
  for (size_t i = 0; i < photos.size(); ++i) {
    PoseGuess& guess = guesses[i];
    guess.view = view_of_set.emplace(sets.Of(i), static_cast<int>(view_of_set.size())).first->second;
    double best_elsewhere = 0;
    for (size_t j = 0; j < photos.size(); ++j) {
      if (j == i) continue;
      const bool is_inside = sets.Of(j) == sets.Of(i);
      double& best = is_inside ? guess.agreement : best_elsewhere;
      best = std::max(best, pairs[i][j].is_other ? 0 : pairs[i][j].agreement);
      if (is_inside) guess.tags = std::max(guess.tags, pairs[i][j].common_tags);
    }
    guess.doubt = DoubtOf(guess, best_elsewhere);
  }
  return guesses;
}

}  // namespace luxfit
