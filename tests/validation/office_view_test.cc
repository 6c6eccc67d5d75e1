// Photos of fixtures/office, which an independent renderer made, against the luminance that this project
// computes for the same camera, luminaires and reflectances: nothing fitted, the camera's scale included.
//
// Compared are means over 8 x 8 pixels that the photo shows neither dark nor saturated and that lie within
// one surface, away from its rim and from the tags, which are not in the mesh. The renderer's own error is 1
// to 2 % here and there (its irradiance cache) and 0.4 % in the median, the photo's noise 0.1 to 0.3 %.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/lens/camera_file.h"
#include "calib/luminance/luminance.h"
#include "calib/photo_files/image.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "forward/views/surface_view.h"
#include "tests/paths.h"

namespace luxfit {
namespace {

const std::string kFolder = std::string(LUXFIT_FIXTURES) + "/office/";
const Eigen::Vector3d kWeights(0.265, 0.670, 0.065);
constexpr int kBlock = 8;

Eigen::Vector3d VectorOf(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

nlohmann::json ReadJson(const std::string& name) {
  return nlohmann::json::parse(std::ifstream(kFolder + name));
}

// Panels: flat and Lambertian. Downlights: points with the intensity of cos^3.
std::vector<Luminaire> TrueLuminaires(const nlohmann::json& truth) {
  std::vector<Luminaire> lamps;
  for (const nlohmann::json& json : truth.at("lamps")) {
    Luminaire lamp;
    lamp.id = json.at("id");
    lamp.position = VectorOf(json.at("position"));
    lamp.flux_lm = json.at("flux_lm");
    if (json.at("kind") == "panel") {
      lamp.shape = LuminaireShape::kRectangle;
      lamp.heading = VectorOf(json.at("u")).normalized();
      lamp.size_m = {2 * VectorOf(json.at("u")).norm(), 2 * VectorOf(json.at("v")).norm()};
    } else {
      lamp.distribution = Distribution::kCosinePower;
      lamp.cosine_exponent = 3;
    }
    lamps.push_back(lamp);
  }
  return lamps;
}

Eigen::MatrixXd AlbedoOf(const Scene& scene, const nlohmann::json& truth) {
  Eigen::MatrixXd albedo(static_cast<Eigen::Index>(scene.materials.size()), 3);
  for (Eigen::Index m = 0; m < albedo.rows(); ++m)
    albedo.row(m) = VectorOf(truth.at("materials").at(scene.materials[static_cast<size_t>(m)]));
  return albedo;
}

struct View {
  Eigen::Vector3d eye;
  Eigen::Matrix3d world_from_cam;
};
View ViewOf(const nlohmann::json& truth, const std::string& name) {
  for (const nlohmann::json& json : truth.at("views")) {
    if (json.at("view") != name) continue;
    View view;
    view.eye = VectorOf(json.at("position_m"));
    for (int row = 0; row < 3; ++row)
      view.world_from_cam.row(row) = VectorOf(json.at("R_scene_from_camera").at(static_cast<size_t>(row)));
    return view;
  }
  throw std::runtime_error("no view " + name);
}

class OfficeView : public testing::Test {
 protected:
  bool NearTag(const Eigen::Vector3d& p) const {
    for (const nlohmann::json& tag : tags_) {
      if ((VectorOf(tag.at("center_m")) - p).norm() < tag.at("size_m").get<double>() + 0.05) return true;
    }
    return false;
  }

  // Ratio of the photo's to the computed luminance over the photo's blocks.
  std::vector<double> Ratios(const std::string& view_name, const std::string& state,
                             double exposure_s) const {
    const View view = ViewOf(truth_, view_name);
    const LuminanceImage photo =
        ToRelativeLuminance(ReadPhoto(kFolder + "photos/" + view_name + "_" + state + ".png"), exposure_s);
    std::vector<Luminaire> lamps;
    for (const Luminaire& lamp : TrueLuminaires(truth_)) {
      const auto on = truth_.at("states").at(state).find(lamp.id);
      if (on == truth_.at("states").at(state).end()) continue;
      lamps.push_back(lamp);
      lamps.back().flux_lm *= on->get<double>();
    }
    const LitRoom lit = LightRoom(room_, lamps, AlbedoOf(room_.scene, truth_));
    std::vector<double> ratios;
    for (int v = 0; v + kBlock <= camera_.height_px; v += kBlock) {
      for (int u = 0; u + kBlock <= camera_.width_px; u += kBlock) {
        if (!photo.valid.block(v, u, kBlock, kBlock).all()) continue;
        Eigen::Matrix3Xd directions(3, kBlock * kBlock);
        for (int k = 0; k < kBlock * kBlock; ++k)
          directions.col(k) =
              view.world_from_cam * Unproject(camera_, Eigen::Vector2d(u + k % kBlock, v + k / kBlock));
        if (!WithinOneSurface(view.eye, directions)) continue;
        // Four of the pixels stand for the block.
        Eigen::Matrix3Xd few(3, 4);
        few << directions.col(18), directions.col(21), directions.col(42), directions.col(45);
        const double computed = (RenderView(room_, lit, view.eye, few) * kWeights).mean();
        const double measured = photo.relative_luminance.block(v, u, kBlock, kBlock).mean() /
                                truth_.at("cameras").at("cam0").at("counts_per_cdm2_s").get<double>();
        ratios.push_back(measured / computed);
      }
    }
    return ratios;
  }

  bool WithinOneSurface(const Eigen::Vector3d& eye, const Eigen::Matrix3Xd& directions) const {
    int facet = -1;
    for (const Eigen::Index k : {0, kBlock - 1, kBlock * (kBlock - 1), kBlock * kBlock - 1}) {
      const RayHit hit = room_.rays.Trace(eye, directions.col(k));
      if (hit.facet < 0 || (facet >= 0 && hit.facet != facet)) return false;
      facet = hit.facet;
      if (NearTag(room_.scene.facets[static_cast<size_t>(facet)].PointAt(hit.u, hit.v))) return false;
    }
    return true;
  }

  const nlohmann::json truth_ = ReadJson("truth.json"), tags_ = ReadJson("tags.json");
  const Camera camera_ = ReadCamera(kFolder + "cam0.yaml");
  const Room room_ = MakeRoom(ReadScene(kFolder + "room.obj"));
};

TEST_F(OfficeView, PhotosAreReproduced) {
  struct Case {
    const char *view, *state;
    double exposure_s;
  };
  for (const Case& c : {Case{"v00", "all", 0.0848}, Case{"v03", "C", 0.671}}) {
    std::vector<double> ratios = Ratios(c.view, c.state, c.exposure_s);
    ASSERT_GT(ratios.size(), 500u) << c.view;
    std::sort(ratios.begin(), ratios.end());
    const auto at = [&](double share) {
      return ratios[static_cast<size_t>(share * static_cast<double>(ratios.size() - 1))];
    };
    std::printf("%s %-4s %5zu blocks: photo / computed median %.4f, 5 %% %.4f, 95 %% %.4f\n", c.view, c.state,
                ratios.size(), at(0.5), at(0.05), at(0.95));
    EXPECT_NEAR(at(0.5), 1, 0.01);  // the renderer's median error, 0.4 %, and ours of the readings, 0.4 % rms
    EXPECT_GT(at(0.05), 0.97);      // its cache: 1 to 2 % here and there; shadow edges
    EXPECT_LT(at(0.95), 1.03);
  }
}

}  // namespace
}  // namespace luxfit
