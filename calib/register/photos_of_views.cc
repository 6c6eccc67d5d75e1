#include "calib/register/photos_of_views.h"

#include <algorithm>
#include <map>

namespace luxfit {
namespace {

constexpr double kSameTagPx = 3;  // photos of one pose agree to a tenth of that
constexpr int kFewestWitnesses = 2;

bool IsSame(const TagDetection& a, const TagDetection& b) {
  if (a.id != b.id) return false;
  for (size_t i = 0; i < a.corners_px.size(); ++i)
    if ((a.corners_px[i] - b.corners_px[i]).norm() > kSameTagPx) return false;
  return true;
}

class TagsOfViews {
 public:
  explicit TagsOfViews(const std::vector<PhotoTags>& photos) : photos_(photos) {
    for (size_t i = 0; i < photos.size(); ++i) of_view_[photos[i].view].push_back(i);
  }

  // Returns how many tags of a photo fit a view.
  int Fitting(size_t photo, int view) const {
    int fitting = 0;
    for (const TagDetection& tag : photos_[photo].tags) {
      int witnesses = 0;
      for (const size_t other : of_view_.at(view)) witnesses += other != photo && Shows(other, tag) ? 1 : 0;
      fitting += witnesses >= kFewestWitnesses ? 1 : 0;
    }
    return fitting;
  }

  // Returns whether two photos of a view agree on a tag, one of its photos left out.
  bool IsKnown(int view, size_t left_out) const {
    for (const size_t i : of_view_.at(view)) {
      for (const size_t j : of_view_.at(view)) {
        if (i >= j || i == left_out || j == left_out) continue;
        for (const TagDetection& tag : photos_[i].tags)
          if (Shows(j, tag)) return true;
      }
    }
    return false;
  }

  const std::map<int, std::vector<size_t>>& of_view() const { return of_view_; }

 private:
  bool Shows(size_t photo, const TagDetection& tag) const {
    const std::vector<TagDetection>& tags = photos_[photo].tags;
    return std::any_of(tags.begin(), tags.end(), [&](const TagDetection& t) { return IsSame(t, tag); });
  }

  const std::vector<PhotoTags>& photos_;
  std::map<int, std::vector<size_t>> of_view_;
};

}  // namespace

std::vector<PhotoOfOtherView> FindPhotosOfOtherViews(const std::vector<PhotoTags>& photos) {
  const TagsOfViews views(photos);
  std::vector<PhotoOfOtherView> found;
  for (size_t p = 0; p < photos.size(); ++p) {
    if (photos[p].tags.empty() || views.Fitting(p, photos[p].view) > 0 || !views.IsKnown(photos[p].view, p))
      continue;
    PhotoOfOtherView best{p, photos[p].view, 0};
    for (const auto& [view, own] : views.of_view()) {
      const int fitting = view == photos[p].view ? 0 : views.Fitting(p, view);
      if (fitting > best.tags) best = {p, view, fitting};
    }
    if (2 * best.tags > static_cast<int>(photos[p].tags.size())) found.push_back(best);
  }
  return found;
}

}  // namespace luxfit
