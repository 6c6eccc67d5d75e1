// Translates a session into what the inversion takes.
#ifndef LUXFIT_APPS_STAGES_SESSION_LIGHT_H_
#define LUXFIT_APPS_STAGES_SESSION_LIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "apps/stages/stages.h"
#include "inverse/fit/room_observations.h"

namespace luxfit {

// One a state, by session.luminaires.
std::vector<Eigen::VectorXd> DimmingOf(const Session& session);

// Throws as ReadGivenLuminaire does.
RoomObservations RoomObservationsOf(const Session& session, const Room& room,
                                    const SessionObservations& observed);

// The session with as many luminaires as its light asks for, where it leaves their number open.
Session WithCountedLuminaires(Session session, const Room& room, const SessionObservations& observed,
                              RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_SESSION_LIGHT_H_
