#include "inverse/fit/internal/judge/unmodelled.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "forward/changes/pieces.h"
#include "inverse/observe/internal/adjacent_elements.h"

namespace luxfit {
namespace {

constexpr size_t kFewestViews = 2, kFewestElements = 4, kMostNamed = 3;

// Returns the root of a tree of a forest of parents.
int RootOf(std::vector<int>& parent, int i) {
  while (parent[static_cast<size_t>(i)] != i) {
    int& up = parent[static_cast<size_t>(i)];
    up = parent[static_cast<size_t>(up)];
    i = up;
  }
  return i;
}

// Returns the area of the elements by the facet on which they lie.
std::map<int, double> AreaOfFacets(const Room& room, const std::vector<int>& elements) {
  std::map<int, double> area_m2;
  for (const int e : elements)
    area_m2[room.patches.PatchOf(e).facet] += room.patches.elements[static_cast<size_t>(e)].area_m2;
  return area_m2;
}

// Holds which facets are furniture, and how much of each facet two views or more show.
struct ShownFacets {
  std::set<int> furniture;
  std::map<int, double> area_m2;
};

ShownFacets ShownFacetsOf(const Room& room, const SurfaceLabels& labels) {
  std::map<int, size_t> views;
  for (const ElementView& v : labels.views) ++views[v.element];
  std::vector<int> shown;
  for (const auto& [element, count] : views)
    if (count >= kFewestViews) shown.push_back(element);
  ShownFacets facets{{}, AreaOfFacets(room, shown)};
  for (const std::vector<int>& piece : LoosePieces(room.scene))
    facets.furniture.insert(piece.begin(), piece.end());
  return facets;
}

// Returns whether the elements, where views show something else, are most of what views show of furniture's faces.
bool AreOfLackingPiece(const Room& room, const std::vector<int>& elements, const ShownFacets& shown) {
  double other_m2 = 0, shown_m2 = 0;
  for (const auto& [facet, area_m2] : AreaOfFacets(room, elements)) {
    if (shown.furniture.count(facet) == 0) return false;
    other_m2 += area_m2, shown_m2 += shown.area_m2.at(facet);
  }
  return other_m2 > 0.5 * shown_m2;
}

UnmodelledPlace PlaceOf(const Room& room, const std::vector<int>& elements,
                        const std::map<int, std::set<int>>& views) {
  UnmodelledPlace place;
  std::map<int, double> area_of_material;
  std::set<int> all;
  for (const int e : elements) {
    const Element& element = room.patches.elements[static_cast<size_t>(e)];
    place.center += element.area_m2 * element.center;
    place.area_m2 += element.area_m2;
    area_of_material[room.patches.PatchOf(e).material] += element.area_m2;
    all.insert(views.at(e).begin(), views.at(e).end());
  }
  place.center /= place.area_m2;
  place.views = static_cast<int>(all.size());
  place.material = std::max_element(area_of_material.begin(), area_of_material.end(), [](auto& a, auto& b) {
                     return a.second < b.second;
                   })->first;
  return place;
}

}  // namespace

std::vector<UnmodelledPlace> FindUnmodelled(const Room& room, const SurfaceLabels& labels) {
  std::map<int, std::set<int>> views;  // that show something else, by element
  for (const ElementView& v : labels.views) {
    if (v.own_probability <= 0.5) views[v.element].insert(v.view);
  }
  std::vector<int> elements;
  for (const auto& [element, others] : views) {
    if (others.size() >= kFewestViews) elements.push_back(element);
  }
  std::vector<int> parent(elements.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& [i, j] : AdjacentElements(room, elements))
    parent[static_cast<size_t>(RootOf(parent, i))] = RootOf(parent, j);
  std::map<int, std::vector<int>> regions;
  for (size_t i = 0; i < elements.size(); ++i)
    regions[RootOf(parent, static_cast<int>(i))].push_back(elements[i]);
  std::vector<UnmodelledPlace> places;
  const ShownFacets shown = ShownFacetsOf(room, labels);
  for (const auto& [root, region] : regions) {
    if (region.size() < kFewestElements) continue;
    places.push_back(PlaceOf(room, region, views));
    places.back().is_of_lacking_piece = AreOfLackingPiece(room, region, shown);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const UnmodelledPlace& a, const UnmodelledPlace& b) { return a.area_m2 > b.area_m2; });
  return places;
}

void RecordLabels(const Room& room, const SurfaceLabels& labels, Findings& findings) {
  if (!labels.is_estimated) return;
  findings.choices.push_back(
      {"views of something else",
       fmt::format("{:.2g} % of the views of elements are left out", 100 * labels.other_share),
       {},
       fmt::format("they differ in several states from views that agree within {:.2g} % (1 sigma)",
                   100 * labels.common_sigma)});
  const std::vector<UnmodelledPlace> places = FindUnmodelled(room, labels);
  if (places.empty()) return;
  const auto named = static_cast<std::ptrdiff_t>(std::min(kMostNamed, places.size()));
  const bool is_any_lacking = std::any_of(places.begin(), places.begin() + named,
                                          [](const auto& place) { return place.is_of_lacking_piece; });
  std::string words;
  double area_m2 = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    const UnmodelledPlace& place = places[i];
    area_m2 += place.area_m2;
    if (i >= kMostNamed) continue;
    words +=
        fmt::format("{}{:.2g} m2 of \"{}\" near ({:.2f}, {:.2f}, {:.2f}) m in {} views{}", i > 0 ? "; " : "",
                    place.area_m2, room.scene.materials[static_cast<size_t>(place.material)],
                    place.center.x(), place.center.y(), place.center.z(), place.views,
                    place.is_of_lacking_piece ? ", which look through it: the room lacks it" : "");
  }
  findings.warnings.push_back(
      {"unmodelled_surface",
       fmt::format("views see something else than the mesh before {:.2g} m2 of it, at {} place{}: {}",
                   area_m2, places.size(), places.size() == 1 ? "" : "s", words),
       is_any_lacking
           ? "take what the room lacks out of the mesh, or move it to where it stands; add to the mesh what "
             "stands at the other places"
           : "add what stands there to the mesh, or take it out of the room; nothing need be done where it "
             "is a "
             "reflection in a shiny surface: these views take no part in the fit"});
}

}  // namespace luxfit
