// Translates a session into what the inversion takes.
#ifndef LUXFIT_APPS_STAGES_SESSION_LIGHT_H_
#define LUXFIT_APPS_STAGES_SESSION_LIGHT_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "apps/stages/stages.h"
#include "inverse/fit/room_observations.h"

namespace luxfit {

// Returns one vector for each state, in the order of session.luminaires.
std::vector<Eigen::VectorXd> DimmingOf(const Session& session);

// Throws as ReadGivenLuminaire does.
KnownLuminaire KnownOf(const SessionLuminaire& given);

// Returns the luminance reflectance that the session gives, by material of the room's mesh.
std::vector<std::optional<double>> KnownAlbedo(const Session& session, const Room& room);

StateTable StateTableOf(const Session& session);

// Returns what is stated of the photos and their cameras. Who calls says how to read them.
RoomPhotos RoomPhotosOf(const Session& session, const LinearizedPhotos& photos);

// Throws as ReadGivenLuminaire does.
RoomObservations RoomObservationsOf(const Session& session, const LinearizedSession& linearized,
                                    const Room& room, const Evidence& observed);

// Returns the session with as many luminaires as its light requires, where it leaves their number open.
Session WithCountedLuminaires(Session session, const LinearizedSession& linearized, const Room& room,
                              const Evidence& observed, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_SESSION_LIGHT_H_
