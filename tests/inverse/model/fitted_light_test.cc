#include "inverse/model/fitted_light.h"

#include <gtest/gtest.h>

#include "forward/light/illuminance.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

struct Office {
  Room room = MakeRoom(support::ClosedRoom({4, 3, 2.5}));
  std::vector<Luminaire> luminaires;
  Eigen::VectorXd albedo = Eigen::VectorXd::Constant(1, 0.6);
  std::vector<Sensor> places = {{{1, 1, 0.8}, {0, 0, 1}, {}}, {{3, 2, 0.8}, {0, 0, 1}, {}}};

  Office() {
    Luminaire lamp;
    lamp.id = "A";
    lamp.position = {1.2, 1.4, 2.4};
    lamp.shape = LuminaireShape::kDisc;
    lamp.size_m = {0.3, 0.3};
    lamp.flux_lm = 1500;
    luminaires.push_back(lamp);
    lamp.id = "B";
    lamp.position = {3.0, 1.8, 2.4};
    lamp.distribution = Distribution::kCosinePower;
    lamp.cosine_exponent = 2;
    lamp.flux_lm = 900;
    luminaires.push_back(lamp);
  }

  PlaceLight Predicted(const ParameterCovariance& known) const {
    return FittedLight(room, {luminaires, albedo}).LightAt(places, known);
  }
  // Light at the places as the forward model has it, lx, places x luminaires.
  Eigen::MatrixXd Light(const std::vector<Luminaire>& lamps, const Eigen::VectorXd& rho) const {
    const Receivers receivers = MakeReceivers(room, {}, places);
    const Illuminance light =
        ComputeIlluminance(room, receivers, ComputeVisibility(room, receivers, lamps), lamps, rho);
    Eigen::MatrixXd lux = light.total.cast<double>();
    for (size_t k = 0; k < lamps.size(); ++k) lux.col(static_cast<Eigen::Index>(k)) *= lamps[k].flux_lm;
    return lux;
  }
};

ParameterCovariance Diagonal(const std::vector<ParameterId>& ids, const Eigen::VectorXd& sigma) {
  return {ids, sigma.cwiseAbs2().asDiagonal()};
}

const ParameterId kFluxLmOfA{ParameterKind::kLogFlux, "A"};
const ParameterId kHeightOfB{ParameterKind::kLuminaire, "B", LuminaireQuantity::kPositionZ};
const ParameterId kExponentOfB{ParameterKind::kLuminaire, "B", LuminaireQuantity::kExponent};
const ParameterId kWall{ParameterKind::kAlbedo, "wall"};
const ParameterId kNodeOfZ{ParameterKind::kLuminaire, "Z", LuminaireQuantity::kGammaNode, 3};

TEST(FittedLight, ColumnsAreThoseOfTheForwardModel) {
  const Office office;
  const PlaceLight predicted = office.Predicted(Diagonal({kFluxLmOfA}, Eigen::VectorXd::Constant(1, 0.02)));
  const Eigen::MatrixXd light = office.Light(office.luminaires, office.albedo);
  EXPECT_LT((predicted.total_lx - light).cwiseAbs().maxCoeff(), 1e-4 * light.maxCoeff());
  EXPECT_TRUE((predicted.direct_lx.array() < predicted.total_lx.array()).all());
}

// A flux known to 2 % makes its column uncertain by 2 %, and no other.
TEST(FittedLight, AFluxMovesItsOwnColumn) {
  const Office office;
  const PlaceLight predicted = office.Predicted(
      Diagonal({kFluxLmOfA, {ParameterKind::kLogCameraScale, ""}}, Eigen::Vector2d(0.02, 0.5)));
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_NEAR(predicted.factor.row(2 * i).norm(), 0.02 * predicted.total_lx(i, 0), 1e-9);
    EXPECT_NEAR(predicted.factor.row(2 * i + 1).norm(), 0, 1e-9);
  }
  EXPECT_TRUE(predicted.left_out.empty());
}

// The factor against finite differences of the forward model: albedo, position, exponent, each by itself.
TEST(FittedLight, SigmasAreThoseOfFiniteDifferences) {
  const Office office;
  const auto moved = [&](const ParameterId& id, double by) {
    std::vector<Luminaire> lamps = office.luminaires;
    Eigen::VectorXd rho = office.albedo;
    if (id == kHeightOfB) lamps[1].position.z() += by;
    if (id == kExponentOfB) lamps[1].cosine_exponent *= std::exp(by);
    if (id == kWall) rho[0] += by;
    return office.Light(lamps, rho);
  };
  for (const auto& [id, sigma] :
       {std::pair<ParameterId, double>(kHeightOfB, 0.02), {kExponentOfB, 0.05}, {kWall, 0.01}}) {
    const PlaceLight predicted = office.Predicted(Diagonal({id}, Eigen::VectorXd::Constant(1, sigma)));
    const Eigen::MatrixXd difference = 0.5 * (moved(id, sigma) - moved(id, -sigma));
    for (Eigen::Index i = 0; i < 2; ++i) {
      for (Eigen::Index k = 0; k < 2; ++k) {
        EXPECT_NEAR(predicted.factor.row(2 * i + k).norm(), std::abs(difference(i, k)),
                    0.02 * difference.cwiseAbs().maxCoeff())
            << NameOf(id) << " " << i << " " << k;
      }
    }
  }
}

TEST(FittedLight, UnknownParametersAreNamed) {
  const Office office;
  const PlaceLight predicted = office.Predicted(Diagonal({kFluxLmOfA, kNodeOfZ}, Eigen::Vector2d(0.02, 1)));
  EXPECT_EQ(predicted.left_out, std::vector<ParameterId>{kNodeOfZ});
  EXPECT_THROW(office.Predicted({{kFluxLmOfA}, {}}), std::invalid_argument);
}

TEST(FittedLight, WithoutACovarianceThereIsLightAlone) {
  const Office office;
  const PlaceLight predicted = office.Predicted({});
  EXPECT_EQ(predicted.factor.size(), 0);
  EXPECT_GT(predicted.total_lx.minCoeff(), 0);
}

}  // namespace
}  // namespace luxfit
