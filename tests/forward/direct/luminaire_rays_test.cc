#include "forward/direct/internal/luminaire_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "forward/factors/internal/polygon_factor.h"
#include "forward/luminaire/photometry_file.h"
#include "tests/paths.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

struct Cube {
  Scene scene = support::ClosedRoom({2, 2, 2});
  RayScene rays{scene};
  Patches patches = Subdivide(scene, rays, {2, 2});  // a patch a face
};

// The standard deviation of a sixth found with as many independent rays: spread evenly, they must do no
// worse.
const double kTolerance = std::sqrt(1.0 / 6 * 5 / 6 / 16384);

TEST(LuminaireFormFactors, OfAnIsotropicPointInACubeAreASixthEach) {
  const Cube cube;
  Luminaire lamp;
  lamp.position = {1, 1, 1};
  lamp.distribution = Distribution::kIsotropic;
  const Eigen::VectorXf shares = LuminaireFormFactors(cube.rays, cube.patches, lamp);
  for (Eigen::Index j = 0; j < 6; ++j) EXPECT_NEAR(shares[j], 1.0 / 6, kTolerance) << j;
  EXPECT_NEAR(shares.sum(), 1, 1e-5);  // float rounding
}

TEST(LuminaireFormFactors, OfALambertianPanelAreItsFormFactors) {
  const Cube cube;
  Luminaire panel;
  panel.position = {0.9, 1.1, 1.5};
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {0.8, 0.6};
  const Eigen::VectorXf shares = LuminaireFormFactors(cube.rays, cube.patches, panel);
  const ConvexPolygon surface =
      MakePolygon({0.5, 0.8, 1.5}, {0, 0.6, 0}, {0.8, 0, 0}, FacetKind::kParallelogram);  // faces down
  for (size_t j = 0; j < 6; ++j) {
    const Facet& face = cube.scene.facets[j];
    const double expected =
        PolygonToPolygon(surface, MakePolygon(face.origin, face.edge_u, face.edge_v, face.kind));
    EXPECT_NEAR(shares[static_cast<Eigen::Index>(j)], expected, kTolerance) << j;
  }
}

TEST(LuminaireFormFactors, FollowTheCurveOfASpot) {
  const Cube cube;
  Luminaire spot;
  spot.position = {1, 1, 1.9};
  spot.distribution = Distribution::kCosinePower;
  spot.cosine_exponent = 20;
  // Of a cosine power m the share within gamma is 1 - cos^(m + 1); the floor's inscribed and circumscribed
  // cones bound its share.
  const double h = 1.9, inner = 1 - std::pow(h / std::hypot(h, 1), 21),
               outer = 1 - std::pow(h / std::hypot(h, std::sqrt(2)), 21);
  const float floor = LuminaireFormFactors(cube.rays, cube.patches, spot)[4];
  EXPECT_GT(floor, inner);
  EXPECT_LT(floor, outer);
}

TEST(SampleDistribution, CarriesTheFluxOfAMeasuredLuminaire) {
  // A real file that throws more light to one side: flux through each octant, against the table's own
  // integral.
  Luminaire lamp;
  lamp.distribution = Distribution::kMeasured;
  lamp.table = std::make_shared<const IntensityTable>(
      Normalized(ReadPhotometry(LUXFIT_FIXTURES "/forward_reference/spots/wallwash.ies").table));
  const LuminaireRays rays = SampleDistribution(lamp, 20000);
  const LuminaireAxes axes = AxesOf(lamp);
  double by_rays[8] = {}, by_integral[8] = {};
  const auto octant = [](const Eigen::Vector3d& d) {
    return (d.x() > 0 ? 1 : 0) + (d.y() > 0 ? 2 : 0) + (d.z() > 0 ? 4 : 0);
  };
  for (Eigen::Index k = 0; k < rays.directions.cols(); ++k)
    by_rays[octant(rays.directions.col(k))] += rays.share[k];
  constexpr int kCells = 400;
  for (int i = 0; i < kCells; ++i) {
    for (int k = 0; k < 2 * kCells; ++k) {
      const double z = -1 + (i + 0.5) * 2 / kCells, turn = 3.14159265358979 * (k + 0.5) / kCells,
                   r = std::sqrt(1 - z * z);
      const Eigen::Vector3d d(r * std::cos(turn), r * std::sin(turn), z);
      by_integral[octant(d)] +=
          IntensityPerLumen(lamp, axes, d).cd_per_lm * 2 / kCells * 3.14159265358979 / kCells;
    }
  }
  for (int o = 0; o < 8; ++o)
    EXPECT_NEAR(by_rays[o], by_integral[o], 3e-3) << o;  // of 20 000 rays and 320 000 cells
  EXPECT_THROW(SampleDistribution(lamp, 0), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
