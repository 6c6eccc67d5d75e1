#include "apps/commands/internal/advise/advice_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/stages/session_light.h"
#include "apps/text/input_error.h"
#include "calib/lens/camera_file.h"

namespace luxfit {
namespace {

Session SessionWithRoom(const std::string& path) {
  Session session = ReadSession(path);
  if (!session.scene)
    throw InputError(
        {session.path, 0}, "scene",
        "expected the room, where advice has photos taken, got none; add [scene] with mesh, size or "
        "outline");
  return session;
}

Room QuietRoom(const Session& session) {
  RunContext context;
  context.is_quiet = true;
  return LoadRoom(session, context);
}

// A group whose number is open gets its share of the floor's luminaires.
void CountLuminaires(GuessedSession& guessed) {
  Session& session = guessed.session;
  const std::vector<std::string> groups = OpenGroups(session);
  if (!session.count_is_estimated && groups.empty()) return;
  constexpr int kMost = 12;
  const int most = session.max_luminaires > 0 ? session.max_luminaires : kMost;
  int count = std::max(static_cast<int>(session.luminaires.size()), GuessedCount(guessed.room, most));
  if (session.count_is_estimated) {
    session = WithMoreLuminaires(std::move(session), count);
  } else {
    count = std::max(1, count / static_cast<int>(groups.size()));
    for (const std::string& group : groups) session = WithCountedGroup(std::move(session), group, count);
  }
  guessed.advice.assumed.push_back({"count",
                                    {},
                                    fmt::format("{}{}: one for every {:g} m2 of the floor", count,
                                                groups.empty() ? "" : " a group", kM2PerLuminaire)});
}

// Adds each luminaire alone to a session that names no states.
void NameStates(GuessedSession& guessed) {
  Session& session = guessed.session;
  const bool are_open = !session.states_are_named;
  for (const SessionState& state : session.states) guessed.advice.states.push_back({state.id, are_open});
  if (!are_open || session.luminaires.size() < 2) return;
  for (const SessionLuminaire& luminaire : session.luminaires) {
    session.states.push_back({luminaire.id + " alone", {{luminaire.id, 1}}});
    guessed.advice.states.push_back({session.states.back().id, true});
  }
  guessed.advice.assumed.push_back({"states", {}, "each luminaire alone, and all"});
}

Camera CameraOf(const Session& session, std::vector<Assumption>& assumed) {
  for (const SessionCamera& camera : session.cameras) {
    if (!camera.intrinsics.empty()) return ReadCamera(camera.intrinsics, camera.id);
  }
  Camera camera = GuessedCamera();
  assumed.push_back({"camera",
                     {},
                     fmt::format("{:g} degrees wide (a phone's main lens), {} x {} px", kGuessedFieldDeg,
                                 camera.width_px, camera.height_px)});
  return camera;
}

// Luminaires are known to a metre: six places along a large room are enough.
double SpacingOf(const Room& room) {
  return std::max(kStandSpacingM, room.scene.Bounds().sizes().head<2>().maxCoeff() / 6);
}

RoomKnowledge KnowledgeOf(const Session& session, const Room& room) {
  RoomKnowledge known;
  for (const SessionLuminaire& luminaire : session.luminaires) known.luminaires.push_back(KnownOf(luminaire));
  known.albedo = KnownAlbedo(session, room);
  known.camera_is_absolute = !session.cameras.empty() && session.cameras.front().cdm2_per_count_s > 0;
  return known;
}

}  // namespace

GuessedSession GuessSession(const std::string& path, const AdviceCandidates& candidates) {
  Session read = SessionWithRoom(path);
  Room room = QuietRoom(read);
  GuessedSession guessed{std::move(read), std::move(room), {}};
  std::vector<Assumption>& assumed = guessed.advice.assumed;
  CountLuminaires(guessed);
  NameStates(guessed);
  const Session& session = guessed.session;
  RoomGuess guess = GuessRoom(guessed.room, KnowledgeOf(session, guessed.room));
  AdviceGiven& given = guessed.advice.given = std::move(guess.given);
  assumed.insert(assumed.end(), guess.assumed.begin(), guess.assumed.end());
  given.meter_common_sigma = session.luxmeter.common_sigma;
  given.dimming = DimmingOf(session);
  AddPredicted(session, given);
  const Camera camera = CameraOf(session, assumed);
  if (session.tags.survey.empty())
    assumed.push_back({"tags", {}, "enough wherever a photo is taken: the session has no tag map"});
  AddCandidates({session, guessed.room, camera, false, SpacingOf(guessed.room)}, candidates, given);
  return guessed;
}

}  // namespace luxfit
