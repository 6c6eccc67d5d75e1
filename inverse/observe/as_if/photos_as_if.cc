#include "inverse/observe/as_if/photos_as_if.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/observe/as_if/internal/srgb_observations.h"
#include "inverse/observe/internal/photo_offsets.h"
#include "inverse/observe/internal/view_table.h"
#include "inverse/select/contradicted.h"

namespace luxfit {
namespace {

constexpr int kComparedElements = 2000;  // enough for patterns of light
constexpr size_t kFewestShared = 30;
constexpr double kExplainsPhoto = 4.5;  // highest score of a state that explains a photo: half of the worst
constexpr int kMostFound = 50;  // passes: each takes the worst photo out, which may have misled about others

// Holds the differences of a photo to the other views, element by element.
struct PatternRows {
  std::vector<double> difference, noise;  // of ln Y; variance
  std::vector<int> group;                 // patch

  void Add(double d, double variance, int patch) {
    difference.push_back(d);
    noise.push_back(variance);
    group.push_back(patch);
  }
  // Takes the common factor out.
  void Centre() {
    const double middle = Median(difference);
    for (double& d : difference) d -= middle;
  }
  double Spread() const {
    std::vector<double> size;
    for (const double d : difference) size.push_back(std::abs(d));
    return kSigmaPerMad * Median(std::move(size));
  }
  GroupScores Scores(double spread) const {
    GroupScores scores;
    for (size_t i = 0; i < difference.size(); ++i)
      scores[group[i]].Add(difference[i] / std::sqrt(noise[i] + spread * spread));
    return scores;
  }
};

// Says what the other views of an element show.
class OtherViews {
 public:
  explicit OtherViews(const ViewTable& table) : table_(table), offset_(PhotoOffsets(table)) {
    for (int e = 0; e < table.elements(); ++e)
      of_column_.insert(of_column_.end(), static_cast<size_t>(End(e) - First(e)), e);
  }

  // Returns the median over the views of a column's element but its own and `without`; NaN where fewer than `fewest`
  // show it in the state.
  double Median(int column, int state, size_t fewest, int without) const {
    const int element = of_column_[static_cast<size_t>(column)];
    std::vector<double> values;
    for (int c = First(element); c < End(element); ++c) {
      const int view = table_.view[static_cast<size_t>(c)];
      const double y = table_.log_luminance(state, c);
      if (c != column && view != without && std::isfinite(y)) values.push_back(y - offset_(state, view));
    }
    return values.size() < fewest ? std::nan("") : luxfit::Median(std::move(values));
  }

 private:
  int First(int element) const { return table_.first[static_cast<size_t>(element)]; }
  int End(int element) const { return table_.first[static_cast<size_t>(element) + 1]; }

  const ViewTable& table_;
  const Eigen::ArrayXXd offset_;
  std::vector<int> of_column_;  // element
};

struct JudgedPhoto {
  PhotoAsIf photo;
  double score = 0, score_as_if = 0;  // as given, and so read
};

class PhotoJudge {
 public:
  // `decoded`: the table as it is where the photos of `counted` went through the curve of sRGB.
  PhotoJudge(const Patches& patches, const ViewTable& table, const ViewTable& decoded,
             const CountedShares& counted)
      : patches_(patches), table_(table), decoded_(decoded), counted_(counted), others_(table) {
    for (int c = 0; c < table.columns(); ++c) {
      const auto view = static_cast<size_t>(table.view[static_cast<size_t>(c)]);
      if (columns_.size() <= view) columns_.resize(view + 1);
      columns_[view].push_back(c);
    }
    std::vector<double> spreads;
    for (int v = 0; v < views(); ++v) {
      for (int s = 0; s < states(); ++s) {
        const PatternRows rows = Compared({v, s}, {s, kSure});
        if (rows.difference.size() >= kFewestShared) spreads.push_back(rows.Spread());
      }
    }
    spread_ = spreads.empty() ? kLeastBetweenViews : std::max(kLeastBetweenViews, Median(spreads));
  }

  // Returns the photo that its state explains worst, with the one that it was exchanged with; none where all are right.
  std::vector<PhotoAsIf> FindWorst() const {
    std::optional<JudgedPhoto> worst;
    for (int v = 0; v < views(); ++v) {
      for (int s = 0; s < states(); ++s) {
        const auto judged = Judge({v, s}, kSure);
        if (judged && (!worst || judged->score > worst->score) && !IsAnothersFault({v, s})) worst = judged;
      }
    }
    if (!worst) return {};
    std::vector<PhotoAsIf> found{worst->photo};
    if (worst->photo.is_srgb) return found;
    // One other view may say so of a photo whose state is known to be another one's.
    const auto partner = Judge({worst->photo.view, worst->photo.as_if}, kAny);
    if (!partner || partner->photo.is_srgb || partner->photo.as_if != worst->photo.state) return found;
    found.push_back(partner->photo);
    for (PhotoAsIf& photo : found) photo.is_exchanged = true;
    return found;
  }

 private:
  static constexpr size_t kSure = 2, kAny = 1;  // other views
  struct PhotoOf {
    int view, state;
  };
  // Names what a photo is compared with: others in a state, at least so many, but for one view; -1: all.
  struct Reference {
    int state;
    size_t fewest;
    int without = -1;
  };

  int states() const { return static_cast<int>(table_.log_luminance.rows()); }
  int views() const { return static_cast<int>(columns_.size()); }

  PatternRows Compared(PhotoOf photo, Reference with, std::optional<Reference> shared = {}) const {
    return Compared(table_, photo, with, shared);
  }

  // Compares a photo, as a table has it, with a reference, on the elements that `shared` has, too.
  PatternRows Compared(const ViewTable& own, PhotoOf photo, Reference with,
                       std::optional<Reference> shared) const {
    PatternRows rows;
    for (const int c : columns_[static_cast<size_t>(photo.view)]) {
      if (!std::isfinite(own.log_luminance(photo.state, c))) continue;
      const double d = own.log_luminance(photo.state, c) - ValueOf(with, c);
      if (std::isfinite(d) && (!shared || std::isfinite(ValueOf(*shared, c))))
        rows.Add(d, own.variance(photo.state, c),
                 patches_.elements[static_cast<size_t>(own.element[static_cast<size_t>(c)])].patch);
    }
    if (!rows.difference.empty()) rows.Centre();
    return rows;
  }

  double ValueOf(const Reference& reference, int column) const {
    return others_.Median(column, reference.state, reference.fewest, reference.without);
  }

  bool IsExplained(const PatternRows& rows) const { return Mean(rows.Scores(spread_)) <= kExplainsPhoto; }

  // Returns whether the photo is right once another view is not asked, or too few elements are left to tell.
  bool IsAnothersFault(PhotoOf photo) const {
    for (int other = 0; other < views(); ++other) {
      if (other == photo.view) continue;
      const PatternRows rows = Compared(photo, {photo.state, kAny, other});
      if (rows.difference.size() < kFewestShared || IsExplained(rows)) return true;
    }
    return false;
  }

  // `fewest`: other views that have to show an element in the photo's state as given.
  std::optional<JudgedPhoto> Judge(PhotoOf photo, size_t fewest) const {
    const Reference own{photo.state, fewest};
    const PatternRows all = Compared(photo, own);
    if (all.difference.size() < kFewestShared || IsExplained(all)) return std::nullopt;
    std::optional<JudgedPhoto> found = JudgeEncoding(photo, all, own);
    double best = found ? found->score_as_if : kExplainsPhoto;
    for (int s = 0; s < states(); ++s) {
      if (s == photo.state) continue;
      const Reference other{s, kAny};
      const PatternRows as_given = Compared(photo, own, other), as_if = Compared(photo, other, own);
      if (as_if.difference.size() < kFewestShared) continue;
      const GroupScores scores = as_if.Scores(spread_);
      if (Mean(scores) > best || !IsContradicted(as_given.Scores(spread_), scores)) continue;
      best = Mean(scores);
      found = {{photo.view, photo.state, s, false, as_given.Spread(), as_if.Spread()},
               Mean(all.Scores(spread_)),
               best};
    }
    return found;
  }

  // Returns the photo as one encoded in sRGB where that explains it. `as_given`: compared with `own`.
  std::optional<JudgedPhoto> JudgeEncoding(PhotoOf photo, const PatternRows& as_given,
                                           const Reference& own) const {
    if (counted_.count({photo.view, photo.state}) == 0) return std::nullopt;
    const PatternRows as_if = Compared(decoded_, photo, own, {});
    const GroupScores given_scores = as_given.Scores(spread_), scores = as_if.Scores(spread_);
    if (Mean(scores) > kExplainsPhoto || !IsContradicted(given_scores, scores)) return std::nullopt;
    PhotoAsIf encoded{photo.view, photo.state, photo.state, false, as_given.Spread(), as_if.Spread(), true};
    return JudgedPhoto{encoded, Mean(given_scores), Mean(scores)};
  }

  const Patches& patches_;
  const ViewTable& table_;
  const ViewTable& decoded_;
  const CountedShares& counted_;
  const OtherViews others_;
  std::vector<std::vector<int>> columns_;  // by view
  double spread_ = 0;
};

}  // namespace

std::vector<PhotoAsIf> FindPhotosAsIf(const Patches& patches, const std::vector<Observation>& observations,
                                      const CountedShares& counted) {
  std::vector<Observation> rest = ThinElements(observations, kComparedElements);
  std::vector<PhotoAsIf> photos;
  for (int pass = 0; pass < kMostFound && !rest.empty(); ++pass) {
    const ViewTable table = TableOfViews(rest), decoded = TableOfViews(DecodedSrgb(rest, counted));
    const std::vector<PhotoAsIf> found = PhotoJudge(patches, table, decoded, counted).FindWorst();
    if (found.empty()) break;
    photos.insert(photos.end(), found.begin(), found.end());
    rest = WithoutPhotos(rest, found);
  }
  return photos;
}

std::vector<Observation> WithoutPhotos(const std::vector<Observation>& observations,
                                       const std::vector<PhotoAsIf>& photos) {
  std::set<std::pair<int, int>> left_out;  // view, state
  for (const PhotoAsIf& photo : photos) left_out.emplace(photo.view, photo.state);
  std::vector<Observation> rest;
  rest.reserve(observations.size());
  for (const Observation& o : observations)
    if (left_out.count({o.view, o.state}) == 0) rest.push_back(o);
  return rest;
}

}  // namespace luxfit
