#include "inverse/fit/internal/judge/superfluous_luminaires.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace luxfit {
namespace {

// A fit by hand of four luminaires that were counted, all on.
class SuperfluousLuminaires : public testing::Test {
 protected:
  SuperfluousLuminaires() {
    given_.luminaires_are_named = false;
    given_.dimming = {Eigen::VectorXd::Ones(4)};
    for (int k = 0; k < 4; ++k) {
      Luminaire downlight;
      downlight.id = "lamp" + std::to_string(k + 1);
      downlight.flux_lm = 900;
      downlight.position = {1.0 * k, 1, 2.7};
      fit_.fit.state.luminaires.push_back(downlight);
      given_.luminaires.emplace_back();
      given_.luminaires.back().luminaire.id = downlight.id;
    }
    fit_.fit.state.free.resize(4);
    fit_.fit.state.camera_scale_free = false;
    fit_.fit.status = FitStatus::kConverged;
    fit_.fit.relative_sigma = 0.02;
    fit_.luminaire_found.assign(4, true);
    fit_.absolute = true;
    fit_.data.dimming = given_.dimming;
  }

  // How many are left; 0: as given.
  size_t Left() {
    fit_.fit.parameters = FreeParameters(MakeRoom(Scene{}), fit_.fit.state);
    const auto n = static_cast<Eigen::Index>(fit_.fit.parameters.size());
    if (fit_.fit.covariance.rows() != n) fit_.fit.covariance = 1e-4 * Eigen::MatrixXd::Identity(n, n);
    const std::optional<RoomObservations> fewer = WithoutSuperfluous(given_, fit_);
    return fewer ? fewer->luminaires.size() : 0;
  }

  RoomObservations given_;
  RoomFit fit_;
};

TEST_F(SuperfluousLuminaires, LikeOnesAreAllNeeded) { EXPECT_EQ(Left(), 0u); }

TEST_F(SuperfluousLuminaires, OneWithHardlyAnyLightIsLeftOver) {
  fit_.fit.state.luminaires[1].flux_lm = 9;
  EXPECT_EQ(Left(), 3u);
  given_.luminaires_are_named = true;
  EXPECT_EQ(Left(), 0u) << "who names a luminaire wants to know of it";
}

TEST_F(SuperfluousLuminaires, AFitThatIsAstrayHasNone) {
  fit_.fit.state.luminaires[1].flux_lm = 9;
  fit_.fit.relative_sigma = 0.06;
  EXPECT_EQ(Left(), 0u);
}

TEST_F(SuperfluousLuminaires, OneThatNothingDeterminesIsLeftOver) {
  fit_.fit.undetermined = {
      {ParameterKind::kLuminaire, "lamp3", LuminaireQuantity::kPositionZ, 0},
      {ParameterKind::kLogFlux, "lamp3", {}, 0},
  };
  EXPECT_EQ(Left(), 3u);
  fit_.fit.undetermined = {{ParameterKind::kAlbedo, "lamp3", {}, 0}};
  EXPECT_EQ(Left(), 0u) << "the floor's name";
}

TEST_F(SuperfluousLuminaires, OneWhoseFluxIsUnknownIsLeftOver) {
  ASSERT_EQ(Left(), 0u);
  for (size_t i = 0; i < fit_.fit.parameters.size(); ++i)
    if (fit_.fit.parameters[i].Is(ParameterKind::kLogFlux, 3, {}))
      fit_.fit.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) = 4;
  EXPECT_EQ(Left(), 3u);
}

// Those that a session gives stay, whatever the fit says of them.
TEST_F(SuperfluousLuminaires, WhatIsGivenStays) {
  given_.luminaires[0].position_m = fit_.fit.state.luminaires[0].position;
  given_.dimming[0][0] = 0.4;
  fit_.fit.state.luminaires[0].flux_lm = 9;
  EXPECT_EQ(Left(), 0u);
  fit_.fit.state.luminaires[2].flux_lm = 9;
  const std::optional<RoomObservations> fewer = WithoutSuperfluous(given_, fit_);
  ASSERT_TRUE(fewer);
  ASSERT_EQ(fewer->luminaires.size(), 3u);
  EXPECT_EQ(fewer->luminaires.back().luminaire.id, "lamp3") << "names go on from 1, whichever is left over";
  EXPECT_EQ(fewer->dimming[0], Eigen::Vector3d(0.4, 1, 1));
}

TEST_F(SuperfluousLuminaires, FewerExplainAsWellOrStayOut) {
  RoomFit fewer = fit_;
  fewer.fit.relative_sigma = 0.0205;
  EXPECT_TRUE(ExplainsAsWell(fewer, 0.02));
  fewer.fit.relative_sigma = 0.022;
  EXPECT_FALSE(ExplainsAsWell(fewer, 0.02));
  fewer.fit.relative_sigma = 0.009;
  EXPECT_TRUE(ExplainsAsWell(fewer, 0.002)) << "both are as good as mesh and paint let them be";
  fewer.fit.status = FitStatus::kNoData;
  EXPECT_FALSE(ExplainsAsWell(fewer, 0.02));
}

}  // namespace
}  // namespace luxfit
