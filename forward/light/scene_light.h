// Returns illuminance at sensors from scene, luminaires and reflectances, with every model choice open.
//
// `simulate` calls it once, choose_accuracy a few times and the chart some hundred times. Arrays are as in
// forward/light/illuminance.h: sensors x luminaires, lx per lm of luminaire.
//
// Throws as its parts do (MakeRoom, ComputeColourIlluminance).
// Source: see forward/light/room.h, forward/radiosity/solvers.h.
#ifndef LUXFIT_FORWARD_LIGHT_SCENE_LIGHT_H_
#define LUXFIT_FORWARD_LIGHT_SCENE_LIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/light/illuminance.h"
#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"
#include "forward/radiosity/solvers.h"
#include "forward/room/scene.h"

namespace luxfit {

// Holds all that light depends on. Luminaires that are bodies must be in the scene already
// (forward/direct/luminaire_body.h).
struct LitScene {
  Scene scene;
  std::vector<Luminaire> luminaires;
  Eigen::Matrix3Xd albedo_rgb;                           // 3 x materials
  Eigen::Vector3d channel_weights{0.265, 0.670, 0.065};  // weights of R, G, B in luminance
  std::vector<Sensor> sensors;
};

struct SceneLightOptions {
  RoomOptions room;
  int rays_per_sensor = kSensorRays;
  RadiositySolverOptions solver;
};

// Returns options for patches no larger than that, of elements a quarter as large, whose direct light sensors
// gather.
PatchesOptions PatchesOfSize(double patch_size_m);

struct SceneLight {
  Room room;
  Receivers receivers;
  LuminaireVisibility visibility;
  ColourIlluminance light;
};
SceneLight ComputeSceneLight(const LitScene& lit, const SceneLightOptions& options = {});

// Recomputes the light alone, with other rays of the sensors.
SceneLight Regather(const LitScene& lit, SceneLight prediction, const SceneLightOptions& options);

// Recomputes the light alone, with another solver.
ColourIlluminance Relight(const LitScene& lit, const SceneLight& prediction,
                          const RadiositySolverOptions& solver);

// Returns the root mean square of value / reference - 1 over all entries, percent. Where the reference is
// below 1 % of its column's mean (a sensor in the dark of a luminaire), that 1 % takes its place.
double RelativeRmsPercent(const Eigen::MatrixXd& value, const Eigen::MatrixXd& reference);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_SCENE_LIGHT_H_
