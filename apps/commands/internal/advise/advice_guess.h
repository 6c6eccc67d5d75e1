// Makes what advice starts from before the first photo: a room as the session says, and guesses (inverse/advise/room_guess.h).
//
// The states are those of [states]; without it, each luminaire alone, and all. A number of luminaires that is to be
// estimated is guessed from the floor. Photos are those of the first camera with intrinsics, else of a phone's lens.
// Photos and values of readings that the session already has do not count. `assumed` says what was guessed.
//
// Throws std::runtime_error for a session without a room, as LoadRoom does, and as AddCandidates does.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_GUESS_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_GUESS_H_

#include <string>

#include "apps/commands/internal/advise/advice_given.h"

namespace luxfit {

struct GuessedSession {
  Session session;  // with the luminaires and states that were guessed
  Room room;
  SessionAdvice advice;
};
GuessedSession GuessSession(const std::string& path, const AdviceCandidates& candidates);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_GUESS_H_
