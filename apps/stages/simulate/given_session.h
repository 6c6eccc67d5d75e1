// Reads a session in which everything is given and nothing is estimated: luminaires, reflectances, places of
// readings.
//
// Throws std::runtime_error("FILE:LINE: key: expected ..., got ...; ...") for a missing value.
#ifndef LUXFIT_APPS_STAGES_SIMULATE_GIVEN_SESSION_H_
#define LUXFIT_APPS_STAGES_SIMULATE_GIVEN_SESSION_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/stages/stages.h"
#include "forward/light/scene_light.h"

namespace luxfit {

// `command` is the name of the calling command, for messages.
std::vector<Luminaire> GivenLuminaires(const Session& session, const std::string& command,
                                       RunContext& context);

// Returns reflectances, 3 x materials of the scene. Bodies of luminaires are black.
Eigen::Matrix3Xd GivenAlbedo(const Session& session, const Scene& scene);

// Holds the places of the readings, each once, and the place of each reading.
struct ReadingPlaces {
  std::vector<Sensor> sensors;
  std::vector<Eigen::Index> sensor_of_reading;
};
ReadingPlaces PlacesOfReadings(const Session& session);

// Holds everything that is given; the scene contains the bodies of luminaires.
struct GivenScene {
  LitScene lit;
  ReadingPlaces places;
  std::vector<MeshFinding> findings;
};
GivenScene ReadGivenScene(const Session& session, const std::string& command, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_SIMULATE_GIVEN_SESSION_H_
