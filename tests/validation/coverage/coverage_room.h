// Draws the real rooms of study_coverage: how each differs from the room and the views that the fit is given.
//
//   facet f     moved along its normal by N(0, mesh_m), turned about each of its edges by N(0, mesh_rad)
//   rho_f       (reflectance of the facet's material) * (1 + N(0, facet_reflectance))
//   texture_e   1 + N(0, element_reflectance), of one element of the model
//   view v      moved along each axis by N(0, view_m), turned about each axis by N(0, view_rad)
//   reading r   its place moved along each axis by N(0, survey_m), where the fit uses it
//
// A real room's facets are drawn larger than the model's: their planes meet inside, so that no ray leaves
// through a gap. Its materials are its facets. Units: m, rad; world frame.
// Source: own.
#ifndef LUXFIT_TESTS_VALIDATION_COVERAGE_COVERAGE_ROOM_H_
#define LUXFIT_TESTS_VALIDATION_COVERAGE_COVERAGE_ROOM_H_

#include <Eigen/Core>
#include <random>
#include <vector>

#include "forward/light/room.h"
#include "forward/room/scene.h"
#include "inverse/model/light_state.h"

namespace luxfit::coverage {

// Standard deviations; relative ones without a unit.
struct ErrorSizes {
  double view_m = 2e-3, view_rad = 5.236e-4;  // 0.03 degrees
  double survey_m = 5e-3;
  double mesh_m = 5e-3, mesh_rad = 1.745e-3;  // 0.1 degrees
  double facet_reflectance = 0.01, element_reflectance = 0.02;
  double exposure = 3e-3;  // of a photo
  double noise = 5e-3;     // of an observation
  double reading = 0.01;
};

struct View {
  Eigen::Vector3d eye, axis;  // unit axis
};

// Holds what the fit is given, without errors. Each state has one luminaire on: state s has luminaire s.
struct Setup {
  Room room;
  LightState light;
  std::vector<int> elements;  // those observed
  std::vector<View> views;
  std::vector<Reading> readings;  // places, states and use; no values
};
Setup MakeSetup();

struct RealView {
  Eigen::Vector3d shift_m;
  Eigen::Matrix3d turn;
};

struct RealRoom {
  Scene scene;
  Eigen::VectorXd albedo;  // by facet
  // Mean over the area of the real facets, by material of the model. The fit estimates it.
  Eigen::VectorXd material_albedo;
  Eigen::VectorXd texture;       // by element of the model
  std::vector<RealView> views;   // by view
  Eigen::Matrix3Xd places;       // by reading
  Eigen::MatrixXd facet_states;  // facets x states, standard normal: the form of the model error
};
RealRoom DrawRealRoom(const Setup& setup, const ErrorSizes& sizes, std::mt19937_64& rng);

}  // namespace luxfit::coverage

#endif  // LUXFIT_TESTS_VALIDATION_COVERAGE_COVERAGE_ROOM_H_
