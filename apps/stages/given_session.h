// What a session gives in full, where nothing is estimated: luminaires, reflectances, places of readings.
//
// Throws std::runtime_error("FILE:LINE: key: expected ..., got ...; ...") for what is missing.
#ifndef LUXFIT_APPS_STAGES_GIVEN_SESSION_H_
#define LUXFIT_APPS_STAGES_GIVEN_SESSION_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/stages/stages.h"
#include "forward/light/scene_light.h"

namespace luxfit {

// `command` is who asks, for messages.
std::vector<Luminaire> GivenLuminaires(const Session& session, const std::string& command,
                                       RunContext& context);

// 3 x materials of the scene; bodies of luminaires are black.
Eigen::Matrix3Xd GivenAlbedo(const Session& session, const Scene& scene);

// The places of the readings, each once, and which of them is a reading's.
struct ReadingPlaces {
  std::vector<Sensor> sensors;
  std::vector<Eigen::Index> sensor_of_reading;
};
ReadingPlaces PlacesOfReadings(const Session& session);

// All of it, bodies of luminaires in the scene.
struct GivenScene {
  LitScene lit;
  ReadingPlaces places;
  std::vector<MeshFinding> findings;
};
GivenScene ReadGivenScene(const Session& session, const std::string& command, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_GIVEN_SESSION_H_
