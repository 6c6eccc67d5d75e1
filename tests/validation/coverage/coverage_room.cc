#include "tests/validation/coverage/coverage_room.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "tests/support/inverse/poster_room.h"

namespace luxfit::coverage {
namespace {

Eigen::VectorXd Draw(Eigen::Index count, double sigma, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd drawn(count);
  for (double& value : drawn) value = sigma * normal(rng);
  return drawn;
}

Eigen::Matrix3d Turn(const Eigen::Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation_rad / angle).toRotationMatrix();
}

// Returns the facet moved, turned about its middle and enlarged.
Facet RealFacet(const Facet& facet, const ErrorSizes& sizes, std::mt19937_64& rng) {
  constexpr double kEnlarged = 1.1;  // far more than the planes move
  const Eigen::Vector2d turns = Draw(2, sizes.mesh_rad, rng);
  const Eigen::Matrix3d turn =
      Turn(turns[0] * facet.edge_u.normalized() + turns[1] * facet.edge_v.normalized());
  const Eigen::Vector3d middle = facet.PointAt(0.5, 0.5);
  Facet real = facet;
  real.origin =
      middle + Draw(1, sizes.mesh_m, rng)[0] * facet.Normal() + turn * (kEnlarged * (facet.origin - middle));
  real.edge_u = turn * (kEnlarged * facet.edge_u);
  real.edge_v = turn * (kEnlarged * facet.edge_v);
  return real;
}

Eigen::VectorXd MeanByMaterial(const Scene& model, const Eigen::VectorXd& facet_albedo) {
  const auto materials = static_cast<Eigen::Index>(model.materials.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(materials), area_m2 = sum;
  for (size_t f = 0; f < model.facets.size(); ++f) {
    const Facet& facet = model.facets[f];
    sum[facet.material] += facet.AreaM2() * facet_albedo[static_cast<Eigen::Index>(f)];
    area_m2[facet.material] += facet.AreaM2();
  }
  return sum.cwiseQuotient(area_m2);
}

std::vector<Reading> ReadingsToTake() {
  std::vector<Reading> readings;
  readings.reserve(15);
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(1, 1, 0.8), {3, 2, 0.8}, {2, 1.5, 0.8}, {0.7, 2.2, 0.8}, {3.2, 0.6, 0.8}}) {
    for (int state = 0; state < 3; ++state) readings.push_back({{p, {0, 0, 1}, {}}, state, 0, 0, false});
  }
  readings[0].used = readings[4].used = true;  // two places, two states
  return readings;
}

}  // namespace

Setup MakeSetup() {
  Setup setup{support::PosterRoomModel(0.25), support::PosterRoomLight(), {}, {}, ReadingsToTake()};
  const size_t elements = setup.room.patches.elements.size();
  setup.elements.reserve(elements / 2 + 1);
  for (size_t e = 0; e < elements; e += 2) setup.elements.push_back(static_cast<int>(e));
  setup.views.reserve(4);
  // One camera in each corner, aimed across the room: two a little down, two a little up.
  const Eigen::Vector3d low(2, 1.5, 1.1), high(2, 1.5, 1.4);
  for (const Eigen::Vector3d& eye : {Eigen::Vector3d(0.3, 0.3, 1.2), {3.7, 0.3, 1.2}})
    setup.views.push_back({eye, (low - eye).normalized()});
  for (const Eigen::Vector3d& eye : {Eigen::Vector3d(3.7, 2.7, 1.2), {0.3, 2.7, 1.2}})
    setup.views.push_back({eye, (high - eye).normalized()});
  return setup;
}

RealRoom DrawRealRoom(const Setup& setup, const ErrorSizes& sizes, std::mt19937_64& rng) {
  const Scene& model = setup.room.scene;
  const auto facets = static_cast<Eigen::Index>(model.facets.size());
  RealRoom real;
  real.albedo = Draw(facets, sizes.facet_reflectance, rng).array() + 1;
  real.scene.facets.reserve(model.facets.size());
  real.scene.materials.reserve(model.facets.size());
  for (Eigen::Index f = 0; f < facets; ++f) {
    Facet facet = RealFacet(model.facets[static_cast<size_t>(f)], sizes, rng);
    real.albedo[f] *= setup.light.albedo[facet.material];
    facet.material = static_cast<int>(f);
    real.scene.facets.push_back(facet);
    real.scene.materials.push_back(fmt::format("facet_{}", f));
  }
  real.material_albedo = MeanByMaterial(model, real.albedo);
  const auto elements = static_cast<Eigen::Index>(setup.room.patches.elements.size());
  real.texture = Draw(elements, sizes.element_reflectance, rng).array() + 1;
  real.views.reserve(setup.views.size());
  for (size_t v = 0; v < setup.views.size(); ++v) {
    const Eigen::Vector3d shift_m = Draw(3, sizes.view_m, rng), rotation_rad = Draw(3, sizes.view_rad, rng);
    real.views.push_back({shift_m, Turn(rotation_rad)});
  }
  real.places.resize(3, static_cast<Eigen::Index>(setup.readings.size()));
  for (size_t r = 0; r < setup.readings.size(); ++r) {
    const Reading& reading = setup.readings[r];
    const double sigma_m = reading.used ? sizes.survey_m : 0;
    real.places.col(static_cast<Eigen::Index>(r)) = reading.sensor.position + Draw(3, sigma_m, rng);
  }
  const auto states = static_cast<Eigen::Index>(setup.light.luminaires.size());
  real.facet_states = Draw(facets * states, 1, rng).reshaped(facets, states);
  return real;
}

}  // namespace luxfit::coverage
