#include "forward/light/covered_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "forward/light/illuminance.h"
#include "tests/support/closed_forms.h"
#include "tests/support/forward/adaptive_integral.h"
#include "tests/support/forward/cut_ceiling.h"

namespace luxfit {
namespace {

const Eigen::Vector3d kRoom(3.2, 2.6, 2.4);

Luminaire Panel(double below_m) { return support::PanelUnder(kRoom.z(), below_m, {1.5, 1.2}, {0.6, 0.6}); }

// Returns the mean over a disc of the form factor from its points to an equal coaxial disc (Howell, B-13).
double MeanDiscFactor(double radius, double distance) {
  const auto ring = [&](double a) {
    const double all = a * a + distance * distance + radius * radius;
    const double factor =
        0.5 * (1 - (all - 2 * radius * radius) / std::sqrt(all * all - std::pow(2 * a * radius, 2)));
    return 2 * a / (radius * radius) * factor;
  };
  return support::AdaptiveIntegral(ring, 0, radius, 1e-7);
}

double CoveredM2(const CoveredSurface& surface) {
  double area = 0;
  for (const auto& [element, covered_m2] : surface.elements) area += covered_m2;
  return area;
}

Eigen::Vector3d CentreOf(const CoveredSurface& surface, const Room& room) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [element, covered_m2] : surface.elements)
    sum += covered_m2 * room.patches.elements[static_cast<size_t>(element)].center;
  return sum / CoveredM2(surface);
}

class CoveredSurfacesTest : public testing::Test {
 protected:
  std::vector<CoveredSurface> Find(const Luminaire& luminaire) const {
    return FindCoveredSurfaces(room_, {luminaire});
  }

  Room room_ =
      MakeRoom(support::ClosedRoom(kRoom, {"wall", "wall", "wall", "wall", "floor", "ceiling"}), {{}, {64}});
};

TEST_F(CoveredSurfacesTest, ShareIsThatOfCoaxialDiscsOfItsArea) {
  for (const double below_m : {0.01, 0.05, 0.2, 0.5, 0.9}) {
    Luminaire disc = Panel(below_m);
    disc.shape = LuminaireShape::kDisc;
    disc.size_m[0] = 0.7;
    const std::vector<CoveredSurface> of_panel = Find(Panel(below_m)), of_disc = Find(disc);
    ASSERT_EQ(of_panel.size(), 1u) << below_m;
    ASSERT_EQ(of_disc.size(), 1u) << below_m;
    EXPECT_NEAR(of_panel[0].share, MeanDiscFactor(0.6 / std::sqrt(support::kPi), below_m), 1e-5) << below_m;
    EXPECT_NEAR(of_disc[0].share, MeanDiscFactor(0.35, below_m), 1e-5) << below_m;
  }
}

TEST_F(CoveredSurfacesTest, PointsAndPendantsCoverNothing) {
  Luminaire point = Panel(0.01), sphere = point;
  point.shape = LuminaireShape::kPoint;
  sphere.shape = LuminaireShape::kSphere;
  EXPECT_TRUE(Find(point).empty());
  EXPECT_TRUE(Find(sphere).empty());
  ASSERT_LT(MeanDiscFactor(0.6 / std::sqrt(support::kPi), 1), 0.1);
  EXPECT_TRUE(Find(Panel(1)).empty());
  Luminaire upwards = Panel(0.01);
  upwards.aim = {0, 0, 1};  // the floor lies behind it, 2.4 m away
  EXPECT_TRUE(Find(upwards).empty());
}

TEST_F(CoveredSurfacesTest, NothingBehindIsNothingCovered) {
  Scene open = support::ClosedRoom(kRoom);
  open.facets.pop_back();
  EXPECT_TRUE(FindCoveredSurfaces(MakeRoom(open, {{}, {64}}), {Panel(0.01)}).empty());
  // A sheet that shows its back to the luminaire reflects nothing there.
  support::AddParallelogram(open, {0, 0, kRoom.z()}, {kRoom.x(), 0, 0}, {0, kRoom.y(), 0}, "sheet");
  EXPECT_TRUE(FindCoveredSurfaces(MakeRoom(open, {{}, {64}}), {Panel(0.01)}).empty());
}

TEST_F(CoveredSurfacesTest, CoveredAreaIsThatOfTheLuminaire) {
  Luminaire turned = Panel(0.02), disc = turned, on_wall = turned;
  turned.heading = Eigen::Vector3d(2, 1, 0).normalized();
  turned.size_m = {1.1, 0.3};
  disc.shape = LuminaireShape::kDisc;
  on_wall.position = {0.03, 1.3, 1.2};
  on_wall.aim = {1, 0, 0};
  on_wall.heading = {0, 0, 1};
  const auto check = [&](const Luminaire& luminaire, double area_m2, const std::string& material) {
    const std::vector<CoveredSurface> surfaces = Find(luminaire);
    ASSERT_EQ(surfaces.size(), 1u);
    EXPECT_NEAR(CoveredM2(surfaces[0]), area_m2, 1e-6 * area_m2);  // rounding of the weights
    EXPECT_EQ(room_.scene.materials[static_cast<size_t>(surfaces[0].material)], material);
    // The elements lie behind the luminaire. Their centres stand for parts of them, 0.1 m wide.
    const Eigen::Vector3d off = CentreOf(surfaces[0], room_) - luminaire.position;
    EXPECT_LT((off - off.dot(luminaire.aim) * luminaire.aim).norm(), 0.05);
  };
  check(turned, 1.1 * 0.3, "ceiling");
  check(disc, support::kPi / 4 * 0.6 * 0.6, "ceiling");
  check(on_wall, 0.36, "wall");
}

TEST_F(CoveredSurfacesTest, EachLuminaireKeepsItsOwn) {
  Luminaire pendant = Panel(1.2), other = Panel(0.01);
  other.position.x() = 0.6;
  const std::vector<CoveredSurface> surfaces = FindCoveredSurfaces(room_, {pendant, Panel(0.01), other});
  ASSERT_EQ(surfaces.size(), 2u);
  EXPECT_EQ(surfaces[0].luminaire, 1);
  EXPECT_EQ(surfaces[1].luminaire, 2);
}

// Meshes cut a ceiling into triangles, which a luminaire covers as it covers a whole one.
TEST_F(CoveredSurfacesTest, ACeilingOfTrianglesIsCoveredAsAWholeOne) {
  Scene scene = room_.scene;
  const Facet ceiling = scene.facets.back();
  scene.facets.pop_back();
  support::AddTriangle(scene, ceiling.origin, ceiling.edge_u, ceiling.edge_v, "ceiling");
  support::AddTriangle(scene, ceiling.PointAt(1, 1), -ceiling.edge_u, -ceiling.edge_v, "ceiling");
  const std::vector<CoveredSurface> surfaces = FindCoveredSurfaces(
      MakeRoom(scene, {{}, {64}}), {support::PanelUnder(kRoom.z(), 0.01, {1.6, 1.3}, {0.6, 0.6})});
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_NEAR(CoveredM2(surfaces[0]), 0.36, 1e-6);
}

// Holds the light of two luminaires, the panel and a point, as a body on the panel changes it.
struct BodyRoom {
  static constexpr double kCeiling = 0.8, kBody = 0.1;

  Room room;
  std::vector<Luminaire> luminaires{Panel(0.01), Luminaire{}};
  Receivers receivers;
  LuminaireVisibility visibility;

  explicit BodyRoom(const Scene& scene) : room(MakeRoom(scene)) {
    luminaires[1].position = {2.6, 0.7, 1.4};
    luminaires[1].distribution = Distribution::kIsotropic;
    std::vector<Sensor> sensors;
    for (const double x : {0.4, 1.5, 2.7}) {
      sensors.push_back({{x, 0.5, 0.75}, {0, 0, 1}, {}});
      sensors.push_back({{x, 1.9, 1.2}, {0, -1, 0}, {}});
      sensors.push_back({{x, 1.3, 0.01}, {0, 0, 1}, {}});
    }
    std::vector<int> elements;
    for (int e = 0; e < static_cast<int>(room.patches.elements.size()); e += 37) elements.push_back(e);
    receivers = MakeReceivers(room, elements, sensors);
    visibility = ComputeVisibility(room, receivers, luminaires);
  }

  // Reflectances of wall, floor, ceiling and, where it has its own material, the part behind the panel.
  Eigen::VectorXd Albedo(double behind) const {
    return Eigen::Vector4d(0.6, 0.3, kCeiling, behind)
        .head(static_cast<Eigen::Index>(room.scene.materials.size()));
  }
  Eigen::MatrixXd Lux(double behind) const {
    return ComputeIlluminance(room, receivers, visibility, luminaires, Albedo(behind)).total.cast<double>();
  }
  // Returns what the covered part sends less where the body takes its place, c left out.
  Eigen::MatrixXd Hidden() const {
    const Transport transport(room.transport, Albedo(kCeiling));
    const CoveredLight light = ComputeCoveredLight(room, receivers, visibility, luminaires, transport,
                                                   FindCoveredSurfaces(room, luminaires));
    return (kCeiling - kBody) * light.response * light.incident;
  }
};

// Returns the largest relative error of each luminaire's hidden light, and prints their range.
Eigen::Vector2d WorstErrors(const Eigen::MatrixXd& hidden, const Eigen::MatrixXd& truth) {
  Eigen::Vector2d worst;
  for (Eigen::Index k = 0; k < 2; ++k) {
    const Eigen::ArrayXd error = hidden.col(k).array() / truth.col(k).array() - 1;
    std::printf("luminaire %d: hidden light against the truth %+.2f to %+.2f %%\n", static_cast<int>(k),
                100 * error.minCoeff(), 100 * error.maxCoeff());
    worst[k] = error.abs().maxCoeff();
  }
  return worst;
}

// Terms of second order are left out: the covered part lights itself by way of the other surfaces, +0.9 % of
// the difference. The point's light also falls unevenly on the part, of which the mean is taken: 2.5 %.
TEST(CoveredLightTest, IsThatOfADarkerPartOfTheCeiling) {
  const BodyRoom body(support::CutCeiling(kRoom, Panel(0.01), "behind"));
  const Eigen::MatrixXd before = body.Lux(BodyRoom::kCeiling), truth = before - body.Lux(BodyRoom::kBody);
  const Eigen::Vector2d worst = WorstErrors(body.Hidden(), truth);
  EXPECT_LT(worst[0], 0.014);
  EXPECT_LT(worst[1], 0.037);
  for (Eigen::Index k = 0; k < 2; ++k)  // there is something to hide
    EXPECT_GT((truth.col(k).array() / before.col(k).array()).maxCoeff(), 0.005);
}

// Products that are prepared for the receivers give what the light of every element gives.
TEST(CoveredLightTest, IsTheSameByPreparedProducts) {
  BodyRoom body(support::CutCeiling(kRoom, Panel(0.01), "behind"));
  const Eigen::MatrixXd by_elements = body.Hidden();
  PrepareGather(body.room, body.receivers);
  EXPECT_LT((body.Hidden() - by_elements).cwiseAbs().maxCoeff(), 1e-5 * by_elements.cwiseAbs().maxCoeff());
}

// Where no facet ends at the panel's edge, the light of whole patches stands for that of the covered part.
TEST(CoveredLightTest, NeedsNoFacetOfItsOwn) {
  const BodyRoom cut(support::CutCeiling(kRoom, Panel(0.01), "behind")),
      whole(support::ClosedRoom(kRoom, {"wall", "wall", "wall", "wall", "floor", "ceiling"}));
  const Eigen::MatrixXd truth = cut.Lux(BodyRoom::kCeiling) - cut.Lux(BodyRoom::kBody);
  const int sensors = static_cast<int>(cut.receivers.sensors.size());  // elements differ between the rooms
  const Eigen::Vector2d worst = WorstErrors(whole.Hidden().bottomRows(sensors), truth.bottomRows(sensors));
  EXPECT_LT(worst[0], 0.022);
  EXPECT_LT(worst[1], 0.065);
}

}  // namespace
}  // namespace luxfit
