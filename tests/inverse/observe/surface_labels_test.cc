// A room with chairs that its mesh lacks, lit by two small lamps in three states. Eight views see floor and walls, or a
// chair before them. Reflectance and light are plain formulas: labels need neither.
#include "inverse/observe/surface_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using ViewKey = std::pair<int, int>;  // element, view

Scene MeshOfRoom() {
  return support::ClosedRoom({5, 4, 2.8}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
}

Scene RoomWithChairs() {
  Scene scene = MeshOfRoom();
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d at(1.2 + 1.2 * (i % 3), i < 3 ? 1.2 : 2.6, 0);
    support::AddBox(scene, {at + Eigen::Vector3d(-0.22, -0.22, 0.42), at + Eigen::Vector3d(0.22, 0.22, 0.46)},
                    support::Facing::kOutward, {"chair"});
    support::AddBox(scene, {at + Eigen::Vector3d(-0.22, 0.18, 0.46), at + Eigen::Vector3d(0.22, 0.22, 0.9)},
                    support::Facing::kOutward, {"chair"});
  }
  return scene;
}

std::vector<Eigen::Vector3d> Eyes() {
  return {{0.4, 0.4, 1.6}, {4.6, 0.4, 1.7}, {4.6, 3.6, 1.5}, {0.4, 3.6, 1.6},
          {2.5, 0.3, 1.7}, {2.5, 3.7, 1.6}, {0.3, 2.0, 1.5}, {4.7, 2.0, 1.6}};
}

// Returns the light of a lamp straight above floor and walls, and of some that comes from everywhere.
double LightAt(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, int state) {
  const Eigen::Vector3d lamps[] = {{1.2, 2, 2.7}, {3.8, 2, 2.7}};
  double light = 0;
  for (int k = 0; k < 2; ++k) {
    if (state == 1 - k) continue;
    const Eigen::Vector3d to = lamps[k] - point;
    light += 0.15 + std::max(0.0, normal.dot(to.normalized())) * std::max(0.0, to.normalized().z()) /
                        to.squaredNorm();
  }
  return light;
}

struct Case {
  std::vector<Observation> observations;
  std::set<ViewKey> views, others;
};

struct CaseOptions {
  double view_sigma = 0.01, noise = 0.003;
  std::map<std::string, double> albedo{{"wall", 0.6}, {"floor", 0.3}, {"ceiling", 0.8}, {"chair", 0.15}};
};

Case See(const Room& room, const Scene& truth, const CaseOptions& options, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  const RayScene rays(truth);
  Case seen;
  for (size_t e = 0; e < room.patches.elements.size(); ++e) {
    const Element& element = room.patches.elements[e];
    for (size_t v = 0; v < Eyes().size(); ++v) {
      const RayHit hit = rays.Trace(Eyes()[v], element.center - Eyes()[v]);
      if (hit.facet < 0 || !hit.front) continue;
      const Facet& facet = truth.facets[static_cast<size_t>(hit.facet)];
      const std::string& material = truth.materials[static_cast<size_t>(facet.material)];
      const ViewKey key{static_cast<int>(e), static_cast<int>(v)};
      seen.views.insert(key);
      if (material == "chair") seen.others.insert(key);
      const double common = options.view_sigma * normal(rng);
      for (int s = 0; s < 3; ++s) {
        Observation o;
        o.element = key.first, o.view = key.second, o.state = s, o.pixels = 50;
        const double y =
            options.albedo.at(material) * LightAt(facet.PointAt(hit.u, hit.v), facet.Normal(), s);
        o.relative_luminance = y * std::exp(common + options.noise * normal(rng));
        o.variance = std::pow(options.noise * y, 2);
        seen.observations.push_back(o);
      }
    }
  }
  return seen;
}

struct Rates {
  double found = 0;  // share of the views of chairs that are labelled so
  double wrong = 0;  // share of the views of the mesh that are labelled as something else
};

Rates RatesOf(const Case& seen, const SurfaceLabels& labels) {
  Rates rates;
  for (const ElementView& v : labels.views) {
    const bool is_other = seen.others.count({v.element, v.view}) > 0;
    if (v.own_probability <= 0.5) (is_other ? rates.found : rates.wrong) += 1;
  }
  const auto others = static_cast<double>(seen.others.size());
  rates.found /= std::max(1.0, others);
  rates.wrong /= static_cast<double>(seen.views.size()) - others;
  std::printf("  %zu of %zu views see chairs; found %.1f %%, false %.2f %%; c %.4f r %.4f share %.3f\n",
              seen.others.size(), seen.views.size(), 100 * rates.found, 100 * rates.wrong,
              labels.common_sigma, labels.state_sigma, labels.other_share);
  return rates;
}

class SurfaceLabelsTest : public testing::Test {
 protected:
  SurfaceLabelsTest() : room_(MakeRoom(MeshOfRoom(), {{0.4, 0.125}, {}})) {}
  const Room room_;
  std::mt19937_64 rng_ = support::TestRng();
};

TEST_F(SurfaceLabelsTest, ChairsThatTheMeshLacksAreFound) {
  const Case seen = See(room_, RoomWithChairs(), {}, rng_);
  const Rates rates = RatesOf(seen, LabelSurfaces(room_, seen.observations));
  EXPECT_GT(rates.found, 0.9);
  EXPECT_LT(rates.wrong, 0.01);
}

TEST_F(SurfaceLabelsTest, ARoomThatIsItsMeshLosesNothing) {
  const Case seen = See(room_, MeshOfRoom(), {}, rng_);
  const SurfaceLabels labels = LabelSurfaces(room_, seen.observations);
  EXPECT_LT(RatesOf(seen, labels).wrong, 1e-3);
  EXPECT_NEAR(labels.common_sigma, 0.01, 0.0005);
}

// An exposure that is 5 % off says nothing of what its photo shows.
TEST_F(SurfaceLabelsTest, APhotoThatIsTooBrightLosesNothing) {
  Case seen = See(room_, MeshOfRoom(), {}, rng_);
  for (Observation& o : seen.observations) o.relative_luminance *= o.view == 3 && o.state == 1 ? 1.05 : 1;
  EXPECT_LT(RatesOf(seen, LabelSurfaces(room_, seen.observations)).wrong, 1e-3);
}

TEST_F(SurfaceLabelsTest, WithoutPhotosThereIsNothingToLabel) {
  EXPECT_TRUE(LabelSurfaces(room_, {}).views.empty());
}

// Nothing is taken away where views share too little.
TEST_F(SurfaceLabelsTest, OneViewIsTakenAsItIs) {
  Case seen = See(room_, RoomWithChairs(), {}, rng_);
  std::vector<Observation> one;
  for (const Observation& o : seen.observations)
    if (o.view == 0) one.push_back(o);
  const SurfaceLabels labels = LabelSurfaces(room_, one);
  EXPECT_FALSE(labels.is_estimated);
  EXPECT_EQ(OfOwnSurface(one, labels).size(), one.size());
}

// A chair as bright as the floor shows in the ratio of the states alone.
TEST_F(SurfaceLabelsTest, ChairsOfTheFloorsReflectance) {
  CaseOptions options;
  options.albedo["chair"] = options.albedo["floor"];
  const Case seen = See(room_, RoomWithChairs(), options, rng_);
  const Rates rates = RatesOf(seen, LabelSurfaces(room_, seen.observations));
  EXPECT_GT(rates.found, 0.7);
  EXPECT_LT(rates.wrong, 0.02);
}

}  // namespace
}  // namespace luxfit
