// Rooms whose photos and readings the light tracer makes: the truth shares no patch and no form factor with the model.
//
//   L_ev = mean over p seen by v in e of sum_k d_k rho(q) E_k(q) / pi      e: element, v: view, q: what v sees at p
//
// A room is what is there, its mesh what the fit is given; they may differ. Photos see nine points an element. A
// luminaire shows in a photo where its opening shines towards the camera and nothing hides it. World frame, metres.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_TRACED_ROOM_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_TRACED_ROOM_H_

#include <Eigen/Core>
#include <random>
#include <string>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"
#include "forward/room/scene.h"
#include "inverse/fit/fit_room.h"
#include "inverse/fit/room_observations.h"

namespace luxfit::support {

struct TracedRoom {
  Scene truth;             // its materials begin with those of the mesh
  Eigen::VectorXd albedo;  // by material of the truth
  std::vector<Luminaire> luminaires;
  std::vector<bool> is_hidden;           // by luminaire: no photo shows its opening; empty: none is
  std::vector<Eigen::VectorXd> dimming;  // by state
  std::vector<Eigen::Vector3d> eyes;     // one a view
  std::vector<Sensor> places;            // readings in the last state; the first gives the scale
};

struct TracedRoomOptions {
  int paths_per_point = 256, paths_per_reading = 32768;
  double noise = 0.003, reading_noise = 0.01;  // relative, 1 sigma
  double place_sigma_m = 0.02;                 // of places that photos show
  double outline_sigma_px = 0.3;               // of a whole outline, each axis
};

// Returns what photos and a luxmeter tell of the room, whose mesh is that of `model`. `rng` draws the noise.
RoomObservations ObserveTraced(const TracedRoom& room, const Room& model, std::mt19937_64& rng,
                               const TracedRoomOptions& options = {});

// Returns the luminaire of the fit for each true one: the nearest that the same states switch.
std::vector<size_t> MatchesOf(const TracedRoom& room, const RoomFit& fit);

struct FoundLimits {
  double outlined_off_mm = 5.3;  // of luminaires whose outlines photos show
  double off_mm = 60;            // of others
  double flux_percent = 5;
  double sigmas = 3;             // of each coordinate, in its sigma
  double common_error_mm = 1.5;  // standard error of what all luminaires err alike along an axis
  double reading_percent = 2;    // mean of the readings that only check
};

// Fits, prints how far each luminaire is from the true one, and expects it within the limits, no error of position that
// they share (z of the mean along each axis), and right readings. Luminaires that the same states switch are
// interchangeable.
void ExpectFound(const TracedRoom& room, const Room& model, const RoomObservations& given,
                 const FoundLimits& limits = {});

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_TRACED_ROOM_H_
