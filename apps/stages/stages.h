// The stages of a run and what each hands on.
//
//   scene -> linearize -> register -> observe -> fit -> result
//
// Stages read the session and what came before; they print progress on standard error and write nothing but
// their own artifact in OUT/stages/. What the data do not determine is a warning, never an exception.
//
// Throws std::runtime_error for what the user wrote wrong and only decoding shows (an 8-bit photo declared
// linear, a mesh in another unit than declared, no tag in any view).
#ifndef LUXFIT_APPS_STAGES_STAGES_H_
#define LUXFIT_APPS_STAGES_STAGES_H_

#include <Eigen/Core>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/text/artifact.h"
#include "calib/lens/camera.h"
#include "calib/luminance/luminance.h"
#include "calib/register/registration.h"
#include "forward/light/room.h"
#include "forward/room/mesh_check.h"
#include "inverse/fit/fit_room.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

class ProgressLine;

// What all stages share: where to write, and what was found on the way.
struct RunContext : Findings {
  std::string out;
  Provenance provenance;
  std::map<std::string, double> timing_s;
  std::map<std::string, double> expected_s;  // what stages took in the last run into that folder
  std::shared_ptr<ProgressLine> progress;    // of the stage that runs, where lines are printed
  std::vector<std::string> reused_stages;    // not run: those of the last run stand
  bool is_quiet = false;                     // no progress lines

  void Add(const Findings& more);
};

// Measures a stage from its making to its end, adds to context.timing_s, shows a progress line where one is
// given.
class StageTimer {
 public:
  StageTimer(RunContext& context, std::string stage, const std::string& line);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  RunContext& context_;
  std::string stage_;
  double start_s_;
  std::shared_ptr<ProgressLine> progress_;
};

// One more of `total` is done of the stage that runs; from any thread.
void Advance(const RunContext& context, size_t total);

// The mesh of a session that has a [scene], checked against the tag survey, and what is wrong with it.
struct LoadedMesh {
  Scene scene;
  std::vector<MeshFinding> findings;
};
LoadedMesh LoadMesh(const Session& session);
void WarnOfMesh(const std::vector<MeshFinding>& findings, const Room& room, RunContext& context);

// That mesh with its form factors; an empty room where the session has no [scene].
Room LoadRoom(const Session& session, RunContext& context);

// Photos as the later stages use them: one for each view, state and camera with its bracket of exposures, the
// cameras with their response and vignetting. Writes OUT/stages/linearize.json.
Session LinearizePhotos(Session session, RunContext& context);
// That, and readings without ambient light.
Session LinearizeSession(Session session, RunContext& context);

struct RegisteredSession {
  std::vector<Camera> cameras;
  Registration registration;
};
RegisteredSession RegisterSession(const Session& session, RunContext& context);

// What a view's pose comes from: tags | colmap | both.
std::string MethodOf(const RegisteredView& view);

// One photo of a linearized session as relative luminance, its bracket merged; checks that it is linear, or
// its camera's response known, and of the camera's size.
LuminanceImage ReadLuminance(const Session& session, const SessionPhoto& photo, const Camera& camera);

// What photos of registered views tell: relative luminance of every element in each, and the places where
// luminaires show.
struct SessionObservations {
  std::vector<Observation> observations;
  std::vector<SeenPlace> seen;
};
SessionObservations ObserveSession(const Session& session, const RegisteredSession& registered,
                                   const Room& room, RunContext& context);

RoomFit FitSession(const Session& session, const Room& room, const SessionObservations& observed,
                   RunContext& context);

// What a session gives in full, simulated: the artifact of OUT/stages/simulate.json, which it writes with
// OUT/illuminance.csv (id,state,lux,direct_lux,indirect_lux of every reading). Patches, rays and bounces are
// chosen for that error.
nlohmann::json SimulateSession(const Session& session, double error_percent, RunContext& context);

// Speed against accuracy of the forward model on such a session: writes OUT/chart.csv, OUT/chart.svg and
// OUT/stages/chart.json, which it returns.
struct ChartOptions {
  double error_percent = 1;  // that the automatic choice is asked for
  double budget_s = 120;     // points that would take longer are skipped
  int threads = 0;           // asked for; 0: all
};
nlohmann::json ChartSession(const Session& session, const ChartOptions& options, RunContext& context);

// Parts of any artifact.
nlohmann::json ChoicesJson(const RunContext& context);
nlohmann::json WarningsJson(const RunContext& context);

// Photometric files of a luminaire, relative to OUT; empty: none were written.
struct LuminaireFiles {
  std::string ies, ldt;
};

// OUT/result.json and, as text, the tables for the terminal. `registered` may be empty (no photos); `files`
// by luminaire.
nlohmann::json ResultJson(const Session& session, const Room& room, const RegisteredSession& registered,
                          const RoomFit& fit, const std::vector<LuminaireFiles>& files,
                          const RunContext& context);
std::string ResultTables(const nlohmann::json& result);
std::string LinearizeTable(const Session& session, const nlohmann::json& artifact);
std::string SimulationTable(const nlohmann::json& artifact);
std::string ChartTable(const nlohmann::json& artifact);
std::string LuxmeterTable(const nlohmann::json& result);
std::string WarningText(const nlohmann::json& result);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_STAGES_H_
