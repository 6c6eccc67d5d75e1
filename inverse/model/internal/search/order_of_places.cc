#include "inverse/model/internal/search/order_of_places.h"

#include <algorithm>
#include <numeric>

namespace luxfit {
namespace {

constexpr double kEqual_m = 0.3;

using Iterator = std::vector<size_t>::iterator;

// Sorts [begin, end) by an axis, and runs of equal coordinates by the next ones. The last axis has no equals.
void SortFrom(int axis, const std::vector<Eigen::Vector3d>& places, Iterator begin, Iterator end) {
  std::stable_sort(begin, end, [&](size_t a, size_t b) { return places[a][axis] < places[b][axis]; });
  if (axis == 2) return;
  while (begin != end) {
    const auto is_apart = [&](size_t a, size_t b) { return places[b][axis] - places[a][axis] > kEqual_m; };
    const Iterator last = std::adjacent_find(begin, end, is_apart);
    const Iterator next = last == end ? end : last + 1;
    SortFrom(axis + 1, places, begin, next);
    begin = next;
  }
}

}  // namespace

std::vector<size_t> OrderOfPlaces(const std::vector<Eigen::Vector3d>& places) {
  std::vector<size_t> order(places.size());
  std::iota(order.begin(), order.end(), size_t{0});
  SortFrom(0, places, order.begin(), order.end());
  return order;
}

}  // namespace luxfit
