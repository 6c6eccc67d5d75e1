// value_mesh.h and radiance_scene.h.
#include "apps/export/value_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "apps/export/radiance_scene.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"

namespace luxfit {
namespace {

using testing::HasSubstr;
using testing::Not;

Scene FloorAndGable() {
  Scene scene;
  scene.materials = {"floor", "gable"};
  for (const Facet& f : FacetsFromPolygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, 0))
    scene.facets.push_back(f);
  for (const Facet& f : FacetsFromPolygon({{0, 1, 0}, {2, 1, 0}, {1, 1, 1}}, 1)) scene.facets.push_back(f);
  return scene;
}

class Values : public testing::Test {
 protected:
  Values() : scene_(FloorAndGable()), patches_(Subdivide(scene_, RayScene(scene_), {0.5, 0.25})) {
    mesh_ = MeshOfElements(patches_, scene_.materials);
    mesh_.values.push_back({"illuminance_lx_all", Eigen::VectorXd::LinSpaced(
                                                      static_cast<Eigen::Index>(mesh_.faces.size()), 1, 99)});
  }
  Scene scene_;
  Patches patches_;
  ValueMesh mesh_;
};

TEST_F(Values, PlyIsReadAsTheSameSurface) {
  const Eigen::Matrix3Xi rgb =
      Eigen::Matrix3Xi::Constant(3, static_cast<Eigen::Index>(mesh_.faces.size()), 7);
  const Scene read = ParseScene(PlyText(mesh_, rgb), MeshFormat::kPly, "a.ply");
  double given_m2 = 0, read_m2 = 0;
  for (const Facet& f : scene_.facets) given_m2 += f.AreaM2();
  for (const Facet& f : read.facets) read_m2 += f.AreaM2();
  EXPECT_EQ(read.facets.size(), mesh_.faces.size());
  EXPECT_NEAR(read_m2, given_m2, 1e-6);
  EXPECT_TRUE(read.Bounds().isApprox(scene_.Bounds()));
}

TEST_F(Values, VtpHoldsOneValueAFace) {
  const std::string text = VtpText(mesh_);
  EXPECT_THAT(text, HasSubstr("NumberOfPolys=\"" + std::to_string(mesh_.faces.size()) + "\""));
  const std::string open = "Name=\"illuminance_lx_all\" format=\"ascii\">\n";
  const size_t at = text.find(open);
  ASSERT_NE(at, std::string::npos);
  std::istringstream values(text.substr(at + open.size()));
  for (const double expected : mesh_.values[0].values) {
    double value = 0;
    ASSERT_TRUE(values >> value);
    EXPECT_NEAR(value, expected, 1e-5 * expected);
  }
  std::string end;
  values >> end;
  EXPECT_EQ(end, "</DataArray>");
}

TEST_F(Values, WhatNoFileCanHoldIsRefused) {
  mesh_.values[0].values[0] = std::nan("");
  EXPECT_THROW(VtpText(mesh_), std::invalid_argument);
  mesh_.values[0].values[0] = 1;
  mesh_.values[0].name = "two words";
  EXPECT_THROW(VtpText(mesh_), std::invalid_argument);
}

TEST_F(Values, NamesOfMaterialsStayOnTheirLine) {
  mesh_.materials[0] = "paint\nelement face 0";
  const Eigen::Matrix3Xi rgb = Eigen::Matrix3Xi::Zero(3, static_cast<Eigen::Index>(mesh_.faces.size()));
  EXPECT_THAT(PlyText(mesh_, rgb), HasSubstr("comment material 0 paint element face 0\n"));
}

TEST_F(Values, PatchMeansKeepTheSum) {
  const Eigen::VectorXd means = PatchMeans(patches_, mesh_.values[0].values);
  double elements = 0, patches = 0;
  for (size_t e = 0; e < patches_.elements.size(); ++e)
    elements += patches_.elements[e].area_m2 * mesh_.values[0].values[static_cast<Eigen::Index>(e)];
  for (size_t p = 0; p < patches_.patches.size(); ++p)
    patches += patches_.patches[p].area_m2 * means[static_cast<Eigen::Index>(p)];
  EXPECT_NEAR(patches, elements, 1e-9 * elements);
}

// L = Phi / (pi A) of a Lambertian panel, in W/(sr m2) at 179 lm/W.
TEST(RadianceScene, APanelHasItsLuminance) {
  Luminaire panel;
  panel.id = "A";
  panel.position = {1, 2, 2.8};
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {0.6, 0.3};
  panel.flux_lm = 1790;
  const RadianceLuminaire text = RadianceSceneOf(panel, "lamp", 0.5);
  EXPECT_TRUE(text.table.empty());
  const size_t at = text.scene.find("light lamp_light\n0\n0\n3 ");
  ASSERT_NE(at, std::string::npos);
  std::istringstream numbers(text.scene.substr(at + 23));
  double radiance = 0;
  numbers >> radiance;
  EXPECT_NEAR(radiance, 0.5 * 10 / (M_PI * 0.18), 1e-6);
  EXPECT_TRUE(RadianceSceneOf(panel, "lamp", 0).scene.empty());
}

TEST(RadianceScene, APanelFacesItsAim) {
  Luminaire panel;
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {2, 1};
  panel.aim = {0, 0, -1};
  const std::string text = RadianceSceneOf(panel, "p").scene;
  const size_t at = text.find("polygon p_surface\n0\n0\n12\n");
  ASSERT_NE(at, std::string::npos);
  std::istringstream numbers(text.substr(at + 25));
  std::vector<Eigen::Vector3d> corners(4);
  for (Eigen::Vector3d& p : corners) numbers >> p.x() >> p.y() >> p.z();
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[1]);
  EXPECT_NEAR((normal - 2 * panel.aim).norm(), 0, 1e-9);
}

// oconv executes a line that begins with `!`.
TEST(RadianceScene, NamesBringNoLinesOfTheirOwn) {
  Luminaire panel;
  panel.id = "A\n!touch pwned\r\n!touch pwned";
  for (const LuminaireShape shape : {LuminaireShape::kPoint, LuminaireShape::kDisc}) {
    panel.shape = shape;
    panel.size_m = {0.2, 0.2};
    const std::string scene = RadianceSceneOf(panel, "lamp").scene;
    EXPECT_THAT(scene, HasSubstr("# luminaire A !touch pwned  !touch pwned, "));
    EXPECT_THAT(scene, Not(HasSubstr("\n!")));
  }
  for (const char* stem : {"", "a b", "a\n!b", "!b", "a#"}) {
    EXPECT_THROW(RadianceSceneOf(panel, stem), std::invalid_argument) << stem;
    EXPECT_THROW(RadianceMaterials({stem}, Eigen::Matrix3Xd::Zero(3, 1)), std::invalid_argument) << stem;
  }
}

TEST(RadianceScene, NamesAreOneAMaterial) {
  EXPECT_THROW(RadianceMaterials({"a"}, Eigen::Matrix3Xd::Zero(3, 2)), std::invalid_argument);
  EXPECT_THROW(RadianceSurfaces(FloorAndGable(), {"a"}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
