#include "apps/stages/observe/explained_photos.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/stages/linearize/linearize.h"
#include "apps/stages/session_light.h"

namespace luxfit {
namespace {

const std::string& StateName(const Session& session, int state) {
  return session.states[static_cast<size_t>(state)].id;
}

std::string DifferenceWords(const PhotoAsIf& photo) {
  return fmt::format("{:.1f} % as given and by {:.1f} %", 100 * photo.difference,
                     100 * photo.difference_as_if);
}

}  // namespace

void WarnOfPhotos(const Session& session, const LinearizedPhotos& photos, const RegisteredSession& registered,
                  const std::vector<PhotoAsIf>& found, RunContext& context) {
  for (const PhotoAsIf& photo : found) {
    const std::string& view = registered.registration.views[static_cast<size_t>(photo.view)].view;
    const std::string &state = StateName(session, photo.state), &as_if = StateName(session, photo.as_if);
    const std::string name = PhotoName(session, photos, view, state);
    if (!photo.is_exchanged) {
      context.warnings.push_back(
          {"photos_as_if",
           fmt::format(
               "{} looks as if it was taken in state {}, not {}: the pattern of its light differs from "
               "the other views' by {} so; it was not used",
               name, as_if, state, DifferenceWords(photo)),
           fmt::format("correct its state in the photo table, or take it again in state {}", state)});
    } else if (photo.state < photo.as_if) {
      context.warnings.push_back(
          {"photos_as_if",
           fmt::format(
               "{} and {} look exchanged: the pattern of their light differs from the other views' by "
               "{} the other way round; neither was used",
               name, PhotoName(session, photos, view, as_if), DifferenceWords(photo)),
           fmt::format("exchange their states, {} and {}, in the photo table", state, as_if)});
    }
  }
}

std::vector<StateExplanation> ExplainStates(const Session& session, const Patches& patches,
                                            const std::vector<Observation>& observations,
                                            RunContext& context) {
  if (session.luminaires.empty()) return {};
  StateTable table;
  for (const SessionState& state : session.states) table.states.push_back(state.id);
  for (const SessionLuminaire& luminaire : session.luminaires) table.luminaires.push_back(luminaire.id);
  table.dimming = DimmingOf(session);
  std::vector<StateExplanation> explanations = FindStatesAsIf(patches, observations, table);
  if (explanations.empty()) return explanations;
  std::string remedy;
  for (const StateExplanation& e : explanations) remedy += (remedy.empty() ? "" : "; or ") + e.remedy;
  context.warnings.push_back({"states_as_if", InWords(explanations), remedy, true});
  return explanations;
}

nlohmann::json PhotosAsIfJson(const Session& session, const Registration& registration,
                              const std::vector<PhotoAsIf>& photos) {
  nlohmann::json list = nlohmann::json::array();
  for (const PhotoAsIf& photo : photos)
    list.push_back({{"view", registration.views[static_cast<size_t>(photo.view)].view},
                    {"state", StateName(session, photo.state)},
                    {"as_if_state", StateName(session, photo.as_if)},
                    {"exchanged", photo.is_exchanged},
                    {"difference_percent", 100 * photo.difference},
                    {"difference_percent_as_if", 100 * photo.difference_as_if}});
  return list;
}

nlohmann::json StatesAsIfJson(const std::vector<StateExplanation>& explanations) {
  nlohmann::json list = nlohmann::json::array();
  for (const StateExplanation& e : explanations)
    list.push_back({{"as_if", e.as_if},
                    {"remedy", e.remedy},
                    {"difference_percent_as_given", 100 * e.difference_as_given},
                    {"difference_percent", 100 * e.difference}});
  return list;
}

}  // namespace luxfit
