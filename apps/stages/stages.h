// Declares the stages of a run and what each hands on.
//
//   scene -> linearize -> register -> furniture -> observe -> fit -> result
//
// Each stage reads the session and the products of the stages before. It prints progress on standard error
// and writes only its own artifact in OUT/stages/. Where the data determine too little, it warns and does not
// throw.
//
// Throws std::runtime_error for mistakes of the user that only decoding reveals (an 8-bit photo declared
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

#include "apps/charts/before_after.h"
#include "apps/session/photo_corrections.h"
#include "apps/session/session.h"
#include "apps/stages/linearize/linearized_session.h"
#include "apps/text/formats/artifact.h"
#include "calib/lens/camera.h"
#include "calib/luminance/luminance.h"
#include "calib/register/registration.h"
#include "forward/light/room.h"
#include "forward/mesh/mesh_check.h"
#include "inverse/fit/fit_room.h"
#include "inverse/observe/evidence.h"

namespace luxfit {

class FitStop;
class PhotoStore;
class ProgressLine;

// Holds what all stages share: where to write, and what was found on the way.
struct RunContext : Findings {
  std::string out;
  Provenance provenance;
  std::map<std::string, double> timing_s;
  std::map<std::string, double> expected_s;  // times of the stages in the last run into that folder
  std::shared_ptr<ProgressLine> progress;    // for the running stage, where lines are printed
  std::vector<std::string> reused_stages;    // not run: products of the last run are used
  std::shared_ptr<const FitStop> stop;       // ends the fit early; null: nothing does
  std::shared_ptr<PhotoStore> photos;        // the run's decoded photos; may be null
  bool is_quiet = false;                     // no progress lines

  void Add(const Findings& more);
};

// Measures a stage from construction to destruction, adds the time to context.timing_s, and shows a progress
// line where one is given.
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

// Counts one more of `total` parts of the running stage as done. Any thread may call it.
void Advance(const RunContext& context, size_t total);

// Shows words beside the running stage; where there is no terminal, every ten seconds at most.
void Say(const RunContext& context, const std::string& words);

// Says by how much surveyed tags miss the surfaces of a session's room, and what to do, as the message of an
// error. Returns an empty text where they lie on them. The session has a [scene].
std::string SurveyComplaint(const Session& session, const Scene& scene);

// Loads the room of a session that has a [scene], checks it against the tag survey, and lists its defects.
struct LoadedMesh {
  Scene scene;
  std::vector<MeshFinding> findings;
};
LoadedMesh LoadMesh(const Session& session);
// Judges defects by what rays saw. Of a scan that was laid onto planes, holes count only where rays find them.
std::vector<MeshFinding> JudgedByRays(std::vector<MeshFinding> findings, bool is_on_planes, RayShares shares);
void WarnOfMesh(std::vector<MeshFinding> findings, const Room& room, RunContext& context);
// Warns of reflectances that the session gives for materials that the room does not have.
// `materials`: the names that there are.
void WarnOfUnknownMaterials(const Session& session, const std::vector<std::string>& materials,
                            RunContext& context);

// Returns the material that says nothing of paints, so that its planes get materials of their own: the only one of the mesh, where
// [scene] says neither its reflectance nor materials = "given". Empty: none. See forward/mesh/named_planes.h.
std::string MaterialWithoutPaints(const SessionScene& scene, const Scene& mesh);

// Returns that room with its form factors; an empty room where the session has no [scene].
Room LoadRoom(const Session& session, RunContext& context);

// Returns the session's photos as the later stages use them. There is one for each view, state and camera,
// with its bracket of exposures; cameras have their response and vignetting. Writes OUT/stages/linearize.json
// where the session has photos.
LinearizedPhotos LinearizePhotos(const Session& session, RunContext& context);
// Does the same, and removes ambient light from the readings.
LinearizedSession LinearizeSession(const Session& session, RunContext& context);

// Names a photo whose tags lie where another view shows them (calib/register/photos_of_views.h).
struct MisplacedPhoto {
  std::string view, state;  // as given
  std::string as_if_view;
  int tags = 0;  // that lie so
};

struct RegisteredSession {
  std::vector<Camera> cameras;
  Registration registration;
  std::vector<MisplacedPhoto> misplaced;  // the poses know nothing of them
};
RegisteredSession RegisterSession(const Session& session, const LinearizedPhotos& photos,
                                  RunContext& context);

// Returns the source of a view's pose: tags | colmap | both.
std::string MethodOf(const RegisteredView& view);

// Tells which photos have the variance of their pixels: merged brackets, or single photos too, by DefaultNoise.
enum class NoiseNeed { kOfBrackets, kOfAll };

// Reads one of the photos as relative luminance, its bracket merged. Checks that the photo is linear or its
// camera's response known, and that it has the camera's size.
LuminanceImage ReadLuminance(const LinearizedPhotos& photos, const LinearizedPhoto& photo,
                             const Camera& camera, NoiseNeed noise = NoiseNeed::kOfBrackets);
// Returns how it reads the counts of a camera; the noise is not set.
LuminanceOptions LuminanceOptionsOf(const LinearizedCamera& camera);
// Returns the same from the context's store, where it has one.
std::shared_ptr<const LuminanceImage> ReadKept(const LinearizedPhotos& photos, const LinearizedPhoto& photo,
                                               const Camera& camera, const RunContext& context);
// Returns the same with what an earlier run found of the photo and its camera.
LuminanceImage ReadCorrected(const LinearizedPhotos& photos, const LinearizedPhoto& photo,
                             const Camera& camera, const PhotoCorrections& corrections,
                             NoiseNeed noise = NoiseNeed::kOfBrackets);

// Observes the photos of the registered views (inverse/observe/evidence.h), and says what was found in them. Writes
// OUT/stages/observe.json.
Evidence ObserveSession(const Session& session, const LinearizedPhotos& photos,
                        const RegisteredSession& registered, const Room& room, RunContext& context);

RoomFit FitSession(const Session& session, const LinearizedSession& linearized, const Room& room,
                   const Evidence& observed, RunContext& context);

// Simulates a session in which everything is given. Returns the artifact of OUT/stages/simulate.json, which
// it writes with OUT/illuminance.csv (id, state, illuminance_lx, direct_lx, indirect_lx of every reading).
// Patches, rays and bounces are chosen for the given error.
nlohmann::json SimulateSession(const Session& session, double error_percent, RunContext& context);

// Charts speed against accuracy of the forward model on such a session. Writes OUT/chart.csv, OUT/chart.svg
// and OUT/stages/chart.json, which it returns.
struct ChartOptions {
  double error_percent = 1;  // error asked of the automatic choice
  double budget_s = 120;     // points that would take longer are skipped
  int threads = 0;           // number asked for; 0: all
  EarlierChart before;       // drawn in the same picture
};
nlohmann::json ChartSession(const Session& session, const ChartOptions& options, RunContext& context);

// Return parts that any artifact may have.
nlohmann::json ChoicesJson(const RunContext& context);
nlohmann::json WarningsJson(const RunContext& context);
// Adds `status` (done or undetermined) and, where it is undetermined, `status_because`: the codes of the warnings that
// say what is not determined.
void AddStatus(const RunContext& context, nlohmann::json& artifact);

// Names the photometric files of a luminaire, relative to OUT; empty where none were written.
struct LuminaireFiles {
  std::string ies, ldt;
};

// Return OUT/result.json and the tables for the terminal. `registered` may be empty (no photos); `files` is
// by luminaire. ResultJson warns in `context` where the readings that check contradict the fit.
nlohmann::json ResultJson(const Session& session, const std::vector<LuminaireReading>& readings,
                          const Room& room, const RegisteredSession& registered, const Evidence& observed,
                          const RoomFit& fit, const std::vector<LuminaireFiles>& files, RunContext& context);
std::string ResultTables(const nlohmann::json& result);
std::string LinearizeTable(const Session& session, const nlohmann::json& artifact);
std::string RegistrationTable(const nlohmann::json& artifact);
std::string SimulationTable(const nlohmann::json& artifact);
std::string ChartTable(const nlohmann::json& artifact);
std::string LuxmeterTable(const nlohmann::json& result);
// Returns the session's name, and the status with its cause.
std::string StatusLine(const nlohmann::json& result);
// Returns the warnings of an artifact; those that leave it undetermined come first.
std::string WarningText(const nlohmann::json& result);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_STAGES_H_
