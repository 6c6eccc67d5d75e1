// `luxfit advise` on photos of an independent renderer: the office from two views, and what its other photos would tell.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/support/apps/advised_office.h"

namespace luxfit {
namespace {

using nlohmann::json;
using support::OfficeOutcome;
using support::TakenPhoto;

// Two views tell the downlight C hardly at all: 29 mm off. One photo of thirty-five helps, and is found without being taken.
TEST(AdviseOffice, APhotoAsAdvisedTellsWhatWasPredicted) {
  const support::AdvisedOffice office;
  std::set<TakenPhoto> photos = support::FromTwoViews({"A", "B", "C", "D"});
  const OfficeOutcome before = office.Fit(photos);
  office.WritePlaces(photos);
  const std::vector<json> steps = office.Advise(1);
  ASSERT_EQ(steps.size(), 1u);
  photos.insert(support::PhotoOf(steps[0]));
  const OfficeOutcome after = office.Fit(photos);
  const double predicted_m = support::PredictedPositionSigmaM(steps[0]);
  std::printf("%s\npositions: sigma %.1f mm, predicted %.1f mm, then %.1f mm; error %.1f mm, then %.1f mm\n",
              steps[0]["words"].get<std::string>().c_str(), 1e3 * before.position_sigma_m, 1e3 * predicted_m,
              1e3 * after.position_sigma_m, 1e3 * before.position_error_m, 1e3 * after.position_error_m);
  EXPECT_LT(after.position_sigma_m, 0.8 * before.position_sigma_m);
  EXPECT_LT(after.position_sigma_m, 2 * predicted_m);
  EXPECT_GT(after.position_sigma_m, 0.5 * predicted_m);
  EXPECT_LT(after.position_error_m, 0.5 * before.position_error_m);
}

// The tutorial's way (docs/tutorial.md): ten photos, run, ask, two more.
TEST(AdviseOffice, TenPhotosAndTheTwoThatAreAdvised) {
  const support::AdvisedOffice office;
  std::set<TakenPhoto> photos = support::FromTwoViews({"A", "B", "C", "D", "all"});
  const OfficeOutcome ten = office.Fit(photos);
  office.WritePlaces(photos);
  const std::vector<json> steps = office.Advise(2);
  ASSERT_EQ(steps.size(), 2u);
  for (const json& step : steps) {
    std::printf("%s\n", step["words"].get<std::string>().c_str());
    photos.insert(support::PhotoOf(step));
  }
  const OfficeOutcome twelve = office.Fit(photos);
  std::printf("positions: %.1f mm off, sigma %.1f mm; then %.1f mm off, sigma %.1f mm\n",
              1e3 * ten.position_error_m, 1e3 * ten.position_sigma_m, 1e3 * twelve.position_error_m,
              1e3 * twelve.position_sigma_m);
  EXPECT_LT(twelve.position_error_m, 0.5 * ten.position_error_m);
  EXPECT_LT(twelve.position_sigma_m, 0.7 * ten.position_sigma_m);
}

// The first eight photos, advised with no run and of views that register: each luminaire alone from two of them. Each is
// found; of random draws of eight, two in five lose one (docs/advise.md).
TEST(AdviseOffice, TheFirstPhotosAsAdvisedFindEveryLuminaire) {
  const support::AdvisedOffice office;
  office.WritePlaces({});
  std::set<TakenPhoto> photos;
  for (const json& step : office.AdviseFirst(8)) photos.insert(support::PhotoOf(step));
  ASSERT_EQ(photos.size(), 8u);
  const OfficeOutcome outcome = office.Fit(photos);
  std::printf("positions: sigma %.1f mm, error %.1f mm\n", 1e3 * outcome.position_sigma_m,
              1e3 * outcome.position_error_m);
  // 28.5 mm, of which A's height has most: 2092 of 8368 elements are fitted, since twice as many would move nothing by a tenth of
  // its sigma. Where 4184 were taken, it was 18 mm.
  EXPECT_LT(outcome.position_sigma_m, 0.043);
  EXPECT_LT(outcome.position_error_m, 2 * outcome.position_sigma_m);
}

}  // namespace
}  // namespace luxfit
