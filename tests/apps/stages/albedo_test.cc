// `luxfit albedo`, as a user runs it: an object under lights in turn (a ray-cast sphere), and
// fixtures/office.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>

#include "tests/support/apps/program.h"
#include "tests/support/inverse/stereo_scene.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr int kAcross = 64;
constexpr int kLights = 8;

json Read(const std::string& path) {
  std::ifstream file(path);
  return json::parse(file);
}

// A session of a sphere with a cast shadow and highlights, and of a mirror sphere beside it in another view.
class ObjectSession : public testing::Test {
 protected:
  ObjectSession() {
    std::mt19937_64 rng(11);
    support::StereoScene scene;
    scene.pixels_across = kAcross;
    scene.noise_sigma = 0.002;
    picture_ = support::RenderStereo(scene, support::LightsAround(kLights), rng);
    cv::Mat mask = cv::Mat::zeros(kAcross, kAcross, CV_8U), card = mask.clone();
    for (size_t i = 0; i < picture_.places.size(); ++i) {
      const Eigen::Vector2i at = picture_.places[i];
      mask.at<unsigned char>(at.y(), at.x()) = 255;
      // Pixels whose albedo is known: the lighter stripes near the middle.
      const double albedo = picture_.albedo[static_cast<Eigen::Index>(i)];
      if (picture_.normal(2, static_cast<Eigen::Index>(i)) > 0.9 && albedo > 0.5)
        card.at<unsigned char>(at.y(), at.x()) = 255;
    }
    Write("mask.png", mask);
    Write("card.png", card);
    std::string photos = "file,camera,view,state,exposure_s\n", directions = "state,x,y,z\n";
    for (int k = 0; k < kLights; ++k) {
      cv::Mat image = cv::Mat::zeros(kAcross, kAcross, CV_16UC3), mirror(200, 200, CV_16UC3);
      for (size_t i = 0; i < picture_.places.size(); ++i) {
        const Eigen::Vector2i at = picture_.places[i];
        const double count = std::min(65535.0, 30000 * picture_.value(k, static_cast<Eigen::Index>(i)));
        image.at<cv::Vec3w>(at.y(), at.x()) = cv::Vec3w::all(static_cast<unsigned short>(count));
      }
      for (int v = 0; v < mirror.rows; ++v) {
        for (int u = 0; u < mirror.cols; ++u) {
          const double value =
              support::MirrorValue(Eigen::Vector2d(u - 99.5, v - 99.5) / 95, picture_.to_light.col(k), 0.06);
          mirror.at<cv::Vec3w>(v, u) = cv::Vec3w::all(static_cast<unsigned short>(250 * value));
        }
      }
      const std::string state = "L" + std::to_string(k);
      Write("object_" + state + ".png", image);
      Write("mirror_" + state + ".png", mirror);
      photos += "object_" + state + ".png,cam0,object," + state + ",1\nmirror_" + state +
                ".png,cam0,mirror," + state + ",1\n";
      const Eigen::Vector3d l = 2 * picture_.to_light.col(k);
      directions += state + "," + std::to_string(l.x()) + "," + std::to_string(l.y()) + "," +
                    std::to_string(l.z()) + "\n";
    }
    cv::Mat circle(200, 200, CV_8U);
    for (int v = 0; v < circle.rows; ++v) {
      for (int u = 0; u < circle.cols; ++u)
        circle.at<unsigned char>(v, u) = Eigen::Vector2d(u - 99.5, v - 99.5).norm() < 95 ? 255 : 0;
    }
    Write("circle.png", circle);
    folder_.Write("photos.csv", photos);
    folder_.Write("lights.csv", directions);
  }

  void Write(const std::string& name, const cv::Mat& image) const { cv::imwrite(folder_.Path(name), image); }

  support::ProgramRun Albedo(const std::string& lights) const {
    folder_.Write("session.toml",
                  "[[camera]]\nid = \"cam0\"\n[photos]\ntable = \"photos.csv\"\n[lights]\n" + lights);
    return support::RunProgram("albedo '" + folder_.Path("session.toml") + "' -o '" + folder_.Path("out") +
                               "'");
  }

  // Mean angle of OUT/normals.exr from the truth, degrees.
  double NormalErrorDeg() const {
    const cv::Mat map = cv::imread(folder_.Path("out/normals.exr"), cv::IMREAD_UNCHANGED);
    Eigen::Matrix3Xd normals(3, picture_.normal.cols());
    for (size_t i = 0; i < picture_.places.size(); ++i) {
      const cv::Vec3f bgr = map.at<cv::Vec3f>(picture_.places[i].y(), picture_.places[i].x());
      normals.col(static_cast<Eigen::Index>(i)) << bgr[2], bgr[1], bgr[0];
    }
    return support::MeanAngleDeg(normals, picture_.normal);
  }

  // Mean |albedo - truth| of OUT/albedo.exr.
  double AlbedoError() const {
    const cv::Mat map = cv::imread(folder_.Path("out/albedo.exr"), cv::IMREAD_UNCHANGED);
    double sum = 0;
    for (size_t i = 0; i < picture_.places.size(); ++i) {
      const cv::Vec3f bgr = map.at<cv::Vec3f>(picture_.places[i].y(), picture_.places[i].x());
      sum += std::abs(bgr[2] - picture_.albedo[static_cast<Eigen::Index>(i)]);
    }
    return sum / static_cast<double>(picture_.places.size());
  }

  TempFolder folder_;
  support::StereoPicture picture_;
};

TEST_F(ObjectSession, GivenDirectionsAndACard) {
  // The card's albedo is that of the light stripes without their gloss: 0.7 * 0.85.
  const support::ProgramRun run = Albedo(
      "mask = \"mask.png\"\nview = \"object\"\ndirections = \"lights.csv\"\nreference = { mask = "
      "\"card.png\", albedo = 0.595 }\n");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_LT(NormalErrorDeg(), 1.5) << run.output;
  EXPECT_LT(AlbedoError(), 0.02) << run.output;
  const json result = Read(folder_.Path("out/result.json"));
  EXPECT_EQ(result["object"]["albedo_unit"], "reflectance");
  EXPECT_EQ(result["object"]["pixels"], picture_.places.size());
  EXPECT_EQ(result["lights"].size(), static_cast<size_t>(kLights));
  bool has_curve = false;
  for (const json& choice : result["choices"]) has_curve = has_curve || choice["what"] == "reflectance curve";
  EXPECT_TRUE(has_curve);
  EXPECT_TRUE(std::filesystem::exists(folder_.Path("out/stages/albedo.json")));
  EXPECT_TRUE(std::filesystem::exists(folder_.Path("out/lights.csv")));
}

TEST_F(ObjectSession, DirectionsFromAMirrorSphere) {
  const support::ProgramRun run =
      Albedo("mask = \"mask.png\"\nmirror_sphere = { view = \"mirror\", mask = \"circle.png\" }\n");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_LT(NormalErrorDeg(), 2.0) << run.output;
  const json result = Read(folder_.Path("out/result.json"));
  EXPECT_THAT(result["warnings"].dump(), HasSubstr("albedo_relative"));
  for (size_t k = 0; k < kLights; ++k) {
    const json& l = result["lights"][k]["to_light"];
    const Eigen::Vector3d found(l[0], l[1], l[2]);
    EXPECT_LT(std::acos(std::min(1.0, found.dot(picture_.to_light.col(static_cast<Eigen::Index>(k))))), 0.02);
  }
}

TEST_F(ObjectSession, ErrorsSayWhereAndHow) {
  const auto refusal = [&](const std::string& lights) {
    const support::ProgramRun run = Albedo(lights);
    EXPECT_EQ(run.status, 2) << run.output;
    return run.output;
  };
  const std::string mask = "mask = \"mask.png\"\n";
  EXPECT_THAT(refusal(mask + "view = \"object\"\ndirection = \"lights.csv\"\n"),
              HasSubstr("did you mean \"directions\"?"));
  EXPECT_THAT(refusal(mask + "view = \"objekt\"\ndirections = \"lights.csv\"\n"),
              HasSubstr("did you mean \"object\"?"));
  EXPECT_THAT(refusal(mask + "directions = \"lights.csv\"\n"),
              HasSubstr("lights: expected view, the one that shows the object"));
  EXPECT_THAT(refusal(mask + "view = \"object\"\n"), HasSubstr("lights.directions: expected"));
  EXPECT_THAT(refusal("view = \"object\"\ndirections = \"lights.csv\"\n"),
              HasSubstr("lights.mask: expected"));
  EXPECT_THAT(
      refusal(mask + "view = \"object\"\nmirror_sphere = { view = \"mirror\", mask = \"mask.png\" }\n"),
      HasSubstr("expected 200 x 200 pixels"));
  folder_.Write("few.csv", "state,x,y,z\nL0,0,0,1\n");
  EXPECT_THAT(refusal(mask + "view = \"object\"\ndirections = \"few.csv\"\n"), HasSubstr("none for \"L1\""));
  EXPECT_THAT(refusal(mask + "view = \"object\"\ndirections = \"lights.csv\"\n[states]\nL0 = {}\n"),
              HasSubstr("states: expected no such section beside [lights]"));
}

TEST_F(ObjectSession, OtherCommandsSayThatItIsAnObject) {
  Albedo("mask = \"mask.png\"\nview = \"object\"\ndirections = \"lights.csv\"\n");
  for (const std::string command : {"run", "register", "calibrate", "simulate", "chart"}) {
    const support::ProgramRun run = support::RunProgram(command + " '" + folder_.Path("session.toml") +
                                                        "' -o '" + folder_.Path("out") + "'");
    EXPECT_EQ(run.status, 2) << command;
    EXPECT_THAT(run.output, HasSubstr("run luxfit albedo on it")) << command;
  }
}

TEST_F(ObjectSession, LightsInOnePlaneAreSaid) {
  std::string directions = "state,x,y,z\n";
  for (int k = 0; k < kLights; ++k)
    directions += "L" + std::to_string(k) + "," + std::to_string(0.1 * k) + ",0,1\n";
  folder_.Write("plane.csv", directions);
  const support::ProgramRun run =
      Albedo("mask = \"mask.png\"\nview = \"object\"\ndirections = \"plane.csv\"\n");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("one plane"));
}

}  // namespace
}  // namespace luxfit
