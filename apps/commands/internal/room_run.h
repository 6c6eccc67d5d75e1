// Runs `luxfit run`, `fit` and `albedo` on a room: all stages in order, each kept, and none repeated.
//
// Where nothing has changed since the last run into the folder, that run's result remains and is shown again.
// Returns the exit status: 0 done, 1 the data do not determine what was asked. Throws as the stages do.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_ROOM_RUN_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_ROOM_RUN_H_

#include "apps/commands/commands.h"
#include "apps/session/session.h"
#include "apps/stages/stages.h"

namespace luxfit {

// kAll is kFit and the report.
enum class RoomRun { kAll, kFit, kFitAndAlbedo };
int RunRoom(Session session, const RunCommandOptions& options, RoomRun what);

// Returns the context of a run: where to write, and the provenance of its artifacts.
RunContext MakeContext(const SessionCommandOptions& options, const Session& session);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_ROOM_RUN_H_
