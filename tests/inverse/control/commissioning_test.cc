#include "inverse/control/commissioning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Luminaire Downlight(const std::string& id, const Eigen::Vector3d& position, double flux_lm) {
  Luminaire luminaire;
  luminaire.id = id;
  luminaire.position = position;
  luminaire.distribution = Distribution::kCosinePower;
  luminaire.cosine_exponent = 3;
  luminaire.flux_lm = flux_lm;
  return luminaire;
}

MeasuredLuminaire Measured(const Luminaire& luminaire) {
  MeasuredLuminaire measured;
  measured.luminaire = luminaire;
  measured.position_sigma_m = {0.005, 0.005, 0.01};
  measured.relative_flux_sigma = 0.02;
  measured.distribution_sigma = 0.005;
  return measured;
}

class Commissioned : public testing::Test {
 protected:
  Commissioned()
      : designed_{Downlight("A", {1, 1, 2.8}, 1000), Downlight("B", {3, 1, 2.8}, 1000),
                  Downlight("C", {5, 1, 2.8}, 1000)} {
    for (const Luminaire& luminaire : designed_) measured_.push_back(Measured(luminaire));
  }
  std::vector<CommissioningFault> FaultsOf(size_t i) const {
    return CompareWithDesign(designed_, measured_).luminaires[i].faults;
  }
  std::vector<Luminaire> designed_;
  std::vector<MeasuredLuminaire> measured_;
};

TEST_F(Commissioned, NothingIsWrongWithWhatIsAsDesigned) {
  for (size_t i = 0; i < 3; ++i) EXPECT_THAT(FaultsOf(i), IsEmpty());
}

TEST_F(Commissioned, EachFaultIsNamedAndNoOther) {
  measured_[0].luminaire.position.x() += 0.2;
  measured_[1].luminaire.flux_lm = 700;
  measured_[2].luminaire.aim = Eigen::Vector3d(std::sin(0.2), 0, -std::cos(0.2));
  EXPECT_THAT(FaultsOf(0), ElementsAre(CommissioningFault::kMoved));
  EXPECT_THAT(FaultsOf(1), ElementsAre(CommissioningFault::kWeak));
  EXPECT_THAT(FaultsOf(2), ElementsAre(CommissioningFault::kAimTurned));
}

TEST_F(Commissioned, WhatTheIntervalCoversIsNoFault) {
  measured_[0].luminaire.flux_lm = 930;
  EXPECT_THAT(FaultsOf(0), IsEmpty());  // 7 % less, known to 4 %, 5 % allowed
  measured_[0].relative_flux_sigma = 0.002;
  EXPECT_THAT(FaultsOf(0), ElementsAre(CommissioningFault::kWeak));
}

TEST_F(Commissioned, ALuminaireThatIsNotThereIsOff) {
  measured_.erase(measured_.begin() + 1);
  const Commissioning commissioning = CompareWithDesign(designed_, measured_);
  EXPECT_EQ(commissioning.luminaires[1].measured, -1);
  EXPECT_THAT(commissioning.luminaires[1].faults, ElementsAre(CommissioningFault::kOff));
  EXPECT_THAT(commissioning.undesigned, IsEmpty());
}

TEST_F(Commissioned, ExchangedIdsAreSwapped) {
  std::swap(measured_[0].luminaire.id, measured_[2].luminaire.id);
  EXPECT_THAT(FaultsOf(0), ElementsAre(CommissioningFault::kSwapped));
  EXPECT_THAT(FaultsOf(1), IsEmpty());
  EXPECT_EQ(CompareWithDesign(designed_, measured_).luminaires[0].swapped_with, 2);
}

TEST_F(Commissioned, AnotherLobeIsAnotherPhotometry) {
  measured_[1].luminaire.distribution = Distribution::kLambertian;
  EXPECT_THAT(FaultsOf(1), ElementsAre(CommissioningFault::kPhotometry));
}

// Flux within gamma of cos^m is 1 - cos^(m+1); two lobes cross once, where their difference is largest:
// of m = 3 and m = 1 at cos^2 = 1/2, u^2 - u^4 = 1/4.
TEST(DistributionDistance, OfTwoLobesIsTheirClosedForm) {
  Luminaire a = Downlight("a", {0, 0, 0}, 1), b = a;
  b.distribution = Distribution::kLambertian;
  EXPECT_NEAR(DistributionDistance(a, b), 0.25, 2e-4);
  EXPECT_NEAR(DistributionDistance(a, a), 0, 1e-12);
  b.aim = Eigen::Vector3d(1, 0, 0);
  b.heading = Eigen::Vector3d(0, 0, 1);
  EXPECT_NEAR(DistributionDistance(a, b), 0.25, 2e-4);  // each in its own axes
}

}  // namespace
}  // namespace luxfit
