#include "inverse/model/internal/search/order_of_places.h"

#include <gtest/gtest.h>

namespace luxfit {
namespace {

using Order = std::vector<size_t>;

TEST(OrderOfPlaces, IsThatOfXWherePlacesAreApart) {
  EXPECT_EQ(OrderOfPlaces({{5.2, 2, 2.5}, {2, 4, 2.5}, {3, 9, 1}}), (Order{1, 2, 0}));
}

TEST(OrderOfPlaces, IsThatOfYWithinAColumnWhateverNoiseDoesToX) {
  EXPECT_EQ(OrderOfPlaces({{0.893, 3.1, 2.7}, {0.919, 1.5, 2.7}}), (Order{1, 0}));
  EXPECT_EQ(OrderOfPlaces({{0.919, 3.1, 2.7}, {0.893, 1.5, 2.7}}), (Order{1, 0}));
}

TEST(OrderOfPlaces, GoesThroughARasterColumnByColumn) {
  EXPECT_EQ(OrderOfPlaces({{2.41, 1, 3}, {0.02, 3, 3}, {2.39, 3.01, 3}, {0.01, 1, 3}, {0, 3.02, 1}}),
            (Order{3, 4, 1, 0, 2}));
}

TEST(OrderOfPlaces, OfNoneIsEmpty) { EXPECT_TRUE(OrderOfPlaces({}).empty()); }

}  // namespace
}  // namespace luxfit
