#include "inverse/model/internal/search/alike_places.h"

#include <gtest/gtest.h>

namespace luxfit {
namespace {

SeenPlace Seen(double x_m, double z_m, double area_m2, int views = 3) {
  SeenPlace place;
  place.position = {x_m, 1, z_m};
  place.area_m2 = area_m2;
  place.views = views;
  return place;
}

TEST(AlikePlacesTest, LikePlacesAreTheAnswerWhereTheyAreAsManyAsAreSought) {
  std::vector<SeenPlace> places = {Seen(1, 2.8, 0.36), Seen(2, 2.75, 0.4), Seen(3, 2.8, 0.35),
                                   Seen(4, 2.8, 1.5),  Seen(5, 1.2, 0.36), Seen(6, 2.8, 0.36, 2)};
  const std::vector<SparseSource> sources = SourcesAtAlike(places, 3);
  ASSERT_EQ(sources.size(), 3U);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(sources[i].is_seen);
    EXPECT_EQ(sources[i].luminaire.position, places[i].position);
    EXPECT_EQ(PlaceOf(sources[i], places), &places[i]);
  }
  EXPECT_TRUE(SourcesAtAlike(places, 4).empty());
  EXPECT_TRUE(SourcesAtAlike(places, 1).empty());  // alike are several
  places[5].views = 3;
  EXPECT_EQ(SourcesAtAlike(places, 4).size(), 4U);
  EXPECT_TRUE(SourcesAtAlike(places, 3).empty());
}

TEST(AlikePlacesTest, LikeOnesShareTheirStrengthAndOthersKeepTheirs) {
  const std::vector<SeenPlace> places = {Seen(1, 2.8, 0.36), Seen(2, 2.8, 0.36), Seen(3, 2.8, 0.36),
                                         Seen(4, 2.8, 1.5)};
  std::vector<SparseSource> sources;
  sources.reserve(places.size() + 1);
  for (const SeenPlace& place : places) sources.push_back(SourceAt(place));
  sources.emplace_back();  // of a search
  const double strengths[] = {6, 0, 0, 5, 7};
  for (size_t i = 0; i < 5; ++i) sources[i].strength = strengths[i];
  ShareAmongAlike(places, sources);
  const double shared[] = {2, 2, 2, 5, 7};
  for (size_t i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(sources[i].strength, shared[i]) << i;
}

}  // namespace
}  // namespace luxfit
