// What stages keep comes back as it went in, to the last bit.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/stages/linearize/linearized_json.h"
#include "apps/stages/observe/observations_json.h"
#include "apps/stages/register/registration_json.h"

namespace luxfit {
namespace {

// Through the bytes that are written.
nlohmann::json ThroughCbor(const nlohmann::json& json) {
  return nlohmann::json::from_cbor(nlohmann::json::to_cbor(json));
}

TEST(KeptProductsTest, Registration) {
  Session session;
  session.cameras.resize(2);
  session.cameras[0].id = "left";
  session.cameras[1].id = "right";
  RegisteredSession before;
  before.cameras.resize(2);
  before.cameras[0].fx_px = 1.0 / 3;
  before.cameras[1].lens = LensModel::kSplined;
  before.cameras[1].spline = {3, 2, 2, 90, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}};
  RegisteredView view;
  view.view = "v00";
  view.camera = 1;
  view.cam_from_world =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()) * Eigen::Translation3d(0.1, -2, 1.0 / 7);
  view.covariance.setRandom();
  view.points_used = 7;
  before.registration.views = {view, view};
  const Eigen::MatrixXd any = Eigen::MatrixXd::Random(12, 12);
  before.registration.pose_covariance = any + any.transpose();
  before.registration.survey_sigma_m = 0.01 / 3;
  before.registration.focal_scale = {1, 1.01};
  before.registration.notes = {{"v01", -1, "no_tags", "message", "remedy"}};
  SurveyedTag tag;
  tag.center_in_world = {0.1, 0.2, 0.3};
  tag.normal_in_world = Eigen::Vector3d::UnitX();
  tag.up_in_world = Eigen::Vector3d::UnitZ();
  before.registration.placed_tags = {tag};
  before.registration.converged = true;
  const RegisteredSession after = RegistrationFromJson(ThroughCbor(RegistrationJson(session, before)));
  EXPECT_EQ(after.cameras.at(0).fx_px, before.cameras[0].fx_px);
  EXPECT_EQ(after.cameras.at(1).lens, LensModel::kSplined);
  EXPECT_EQ(after.cameras.at(1).spline.control_points, before.cameras[1].spline.control_points);
  const RegisteredView& again = after.registration.views.at(0);
  EXPECT_EQ(again.cam_from_world.matrix(), view.cam_from_world.matrix());
  EXPECT_EQ(again.covariance, view.covariance);
  EXPECT_EQ(again.points_used, 7);
  EXPECT_EQ(after.registration.pose_covariance, before.registration.pose_covariance);
  EXPECT_EQ(after.registration.survey_sigma_m, before.registration.survey_sigma_m);
  EXPECT_EQ(after.registration.focal_scale, before.registration.focal_scale);
  EXPECT_EQ(after.registration.notes.at(0).code, "no_tags");
  EXPECT_EQ(after.registration.placed_tags.at(0).center_in_world, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_TRUE(after.registration.IsUsable());
}

TEST(KeptProductsTest, SigmasOfARegistrationMayBeUnknown) {
  Session session;
  session.cameras.resize(1);
  RegisteredSession before;
  before.cameras.resize(1);
  RegisteredView view;
  view.covariance.setIdentity();
  view.position_sigma_m = {0.001, std::numeric_limits<double>::quiet_NaN(), 0.003};
  before.registration.views = {view};
  before.registration.pose_covariance.setConstant(6, 6, std::numeric_limits<double>::quiet_NaN());
  // Text has null where the bytes above have NaN.
  nlohmann::json kept = nlohmann::json::parse(RegistrationJson(session, before).dump());
  ASSERT_TRUE(kept["views"][0]["position_sigma_m"][1].is_null());
  const RegisteredView part = RegistrationFromJson(kept).registration.views.at(0);
  EXPECT_EQ(part.position_sigma_m.x(), 0.001);
  EXPECT_TRUE(std::isnan(part.position_sigma_m.y()));
  EXPECT_EQ(part.position_sigma_m.z(), 0.003);
  EXPECT_TRUE(RegistrationFromJson(kept).registration.pose_covariance.array().isNaN().all());
  EXPECT_EQ(RegistrationTable(kept),
            "         0 tags, reprojection RMS 0.000 px, camera centre ± 1.0 - 3.0 mm\n");
  kept["views"][0]["position_sigma_m"] = nullptr;
  kept["views"][0]["covariance"] = nullptr;
  const RegisteredView none = RegistrationFromJson(kept).registration.views.at(0);
  EXPECT_TRUE(none.position_sigma_m.array().isNaN().all());
  EXPECT_TRUE(none.covariance.array().isNaN().all());
  EXPECT_EQ(RegistrationTable(kept),
            "         0 tags, reprojection RMS 0.000 px, camera centre ± - - - mm\n");
}

TEST(KeptProductsTest, Linearized) {
  const Eigen::VectorXd counts = Eigen::Vector3d(0, 100, 255);
  const Eigen::VectorXd exposure = Eigen::Vector3d(0, 0.3, 1), sigma = Eigen::Vector3d(0.1, 0.01, 0.02);
  Session read;
  read.cameras.resize(1);
  read.cameras[0].id = "left";
  LinearizedPhotos before;
  before.cameras.resize(1);
  before.cameras[0].full_scale_counts = 255;
  before.cameras[0].response =
      CameraResponse(counts, {exposure, exposure, exposure}).WithRelativeSigma({sigma, sigma, sigma});
  before.cameras[0].vignetting = Vignetting{{10, 20}, 30, Eigen::Vector2d(-0.1, 0.02)};
  LinearizedPhoto photo;
  photo.file = "a.png";
  photo.view = "v";
  photo.state = "s";
  photo.exposure_s = 1.0 / 7;
  photo.bracket = {{"a.png", 0.5, 3}, {"b.png", 1.0 / 3, 4, 4095}};
  before.photos = {photo};
  const LinearizedPhotos after = LinearizedFromJson(read, ThroughCbor(LinearizedJson(before)));
  ASSERT_EQ(after.photos.size(), 1U);
  EXPECT_EQ(after.photos[0].bracket.at(1).relative_exposure_s, 1.0 / 3);
  EXPECT_EQ(after.photos[0].bracket[1].cut_off_counts, 4095);
  EXPECT_FALSE(after.photos[0].bracket[0].cut_off_counts);
  EXPECT_EQ(after.photos[0].exposure_s, 1.0 / 7);
  EXPECT_EQ(after.photos[0].view, "v");
  EXPECT_EQ(after.photos[0].state, "s");
  const LinearizedCamera& camera = after.cameras.at(0);
  EXPECT_EQ(camera.given.id, "left");
  EXPECT_EQ(camera.full_scale_counts, 255);
  EXPECT_EQ(camera.vignetting->coefficients, Eigen::Vector2d(-0.1, 0.02));
  for (const double count : {0.0, 57.0, 100.0, 250.0}) {
    EXPECT_EQ(camera.response->Exposure(1, count), before.cameras[0].response->Exposure(1, count));
    EXPECT_EQ(camera.response->RelativeSigma(2, count), before.cameras[0].response->RelativeSigma(2, count));
  }
}

TEST(KeptProductsTest, Observations) {
  Evidence before;
  Observation o;
  o.element = 123456;
  o.view = -1;
  o.state = 3;
  o.pixels = 17;
  o.relative_luminance = 1.0 / 3;
  o.variance = 1e-300;
  o.relative_rgb = {0.1, 0.2, 0.7};
  before.observations = {o, Observation{}};
  SeenPlace place;
  place.position = {0.1, 0.2, 0.3};
  place.states = {0, 2};
  place.area_m2 = std::numeric_limits<double>::quiet_NaN();
  before.seen = {place};
  before.photos_as_if = {{3, 0, 1, true, 1.0 / 7, 0.01, true}};
  before.states_as_if = {{"A was off", "take it out", {Eigen::Vector2d(0, 1.0 / 3)}, 0.3, 0.02}};
  const Evidence after = ObservationsFromJson(ThroughCbor(ObservationsJson(before)));
  ASSERT_EQ(after.observations.size(), 2U);
  EXPECT_EQ(after.observations[0].element, o.element);
  EXPECT_EQ(after.observations[0].view, -1);
  EXPECT_EQ(after.observations[0].relative_luminance, o.relative_luminance);
  EXPECT_EQ(after.observations[0].variance, o.variance);
  EXPECT_EQ(after.observations[0].relative_rgb, o.relative_rgb);
  ASSERT_EQ(after.seen.size(), 1U);
  EXPECT_EQ(after.seen[0].states, place.states);
  EXPECT_TRUE(std::isnan(after.seen[0].area_m2));
  ASSERT_EQ(after.photos_as_if.size(), 1U);
  EXPECT_EQ(after.photos_as_if[0].as_if, 1);
  EXPECT_TRUE(after.photos_as_if[0].is_exchanged);
  EXPECT_EQ(after.photos_as_if[0].difference, 1.0 / 7);
  EXPECT_TRUE(after.photos_as_if[0].is_srgb);
  ASSERT_EQ(after.states_as_if.size(), 1U);
  EXPECT_EQ(after.states_as_if[0].as_if, "A was off");
  EXPECT_EQ(after.states_as_if[0].dimming.at(0), Eigen::Vector2d(0, 1.0 / 3));
  EXPECT_EQ(after.states_as_if[0].difference_as_given, 0.3);
}

}  // namespace
}  // namespace luxfit
