#include "inverse/fit/internal/name_in_order.h"

#include <gtest/gtest.h>

namespace luxfit {
namespace {

// A and B in one row, C and D in another, all of one type, along x in the order B A D C.
struct TwoRows {
  RoomObservations given;
  LightState state;
  TwoRows() {
    const double x[] = {2, 1, 2, 1};
    for (int k = 0; k < 4; ++k) {
      given.luminaires.emplace_back();
      Luminaire luminaire;
      luminaire.id = std::string(1, static_cast<char>('A' + k));
      luminaire.position = {x[k], k < 2 ? 0.0 : 3.0, 2.8};
      luminaire.flux_lm = 1000 * x[k];
      state.luminaires.push_back(luminaire);
    }
    state.free.resize(4);
    state.first_of_type = {0, 0, 0, 0};
    given.dimming = {Eigen::Vector4d(1, 1, 0, 0), Eigen::Vector4d(0, 0, 1, 1)};
  }
  double X(size_t k) const { return WithNamesInOrder(given, state).luminaires[k].position.x(); }
};

TEST(NameInOrder, OrdersEachRowByItself) {
  const TwoRows rows;
  const LightState named = WithNamesInOrder(rows.given, rows.state);
  for (size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(named.luminaires[k].id, std::string(1, static_cast<char>('A' + k)));
    EXPECT_EQ(named.luminaires[k].position, Eigen::Vector3d(k % 2 == 0 ? 1 : 2, k < 2 ? 0 : 3, 2.8));
    EXPECT_EQ(named.luminaires[k].flux_lm, k % 2 == 0 ? 1000 : 2000) << "the flux goes with its place";
  }
}

TEST(NameInOrder, KeepsThoseThatAreToldApart) {
  TwoRows apart;
  apart.given.dimming[0][0] = 0.5;
  EXPECT_EQ(apart.X(0), 2) << "A is dimmed alone";
  EXPECT_EQ(apart.X(2), 1);
  TwoRows of_two_types;
  of_two_types.state.first_of_type = {0, 1, 2, 2};
  EXPECT_EQ(of_two_types.X(0), 2);
  EXPECT_EQ(of_two_types.X(2), 1);
  TwoRows given;
  given.given.luminaires[0].position_m = Eigen::Vector3d(2, 0, 2.8);
  given.given.luminaires[2].flux_lm = 2000;
  EXPECT_EQ(given.X(0), 2);
  EXPECT_EQ(given.X(2), 2);
}

}  // namespace
}  // namespace luxfit
