#include "apps/stages/observe/explained_photos.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace luxfit {
namespace {

const std::string& StateName(const Session& session, int state) {
  return session.states[static_cast<size_t>(state)].id;
}

// Returns the name of the photo of a view and state; the view's where there is none.
std::string NameOf(const RoomPhotos& photos, const PhotoNames& names, const std::string& view, int state) {
  for (size_t i = 0; i < photos.photos.size(); ++i)
    if (photos.photos[i].view == view && photos.photos[i].state == state) return names.photos[i];
  return view;
}

std::string DifferenceWords(const PhotoAsIf& photo) {
  return fmt::format("{:.1f} % as given and by {:.1f} %", 100 * photo.difference,
                     100 * photo.difference_as_if);
}

}  // namespace

void WarnOfPhotos(const std::vector<PhotoAsIf>& found, const RoomPhotos& photos,
                  const std::vector<RegisteredView>& views, const PhotoNames& names, Findings& findings) {
  for (const PhotoAsIf& photo : found) {
    const std::string& view = views[static_cast<size_t>(photo.view)].view;
    const std::string &state = names.states[static_cast<size_t>(photo.state)],
                      &as_if = names.states[static_cast<size_t>(photo.as_if)];
    const std::string name = NameOf(photos, names, view, photo.state);
    if (photo.is_srgb) {
      findings.warnings.push_back(
          {"photos_as_if",
           fmt::format(
               "{} looks as if it was encoded in sRGB, not linear: the pattern of its light differs from "
               "the other views' by {} so read; it was not used",
               name, DifferenceWords(photo)),
           "develop it as the camera's other photos, without a tone curve; or give it a view and a "
           "[[camera]] "
           "of its own, with response = \"srgb\""});
    } else if (!photo.is_exchanged) {
      findings.warnings.push_back(
          {"photos_as_if",
           fmt::format(
               "{} looks as if it was taken in state {}, not {}: the pattern of its light differs from "
               "the other views' by {} so; it was not used",
               name, as_if, state, DifferenceWords(photo)),
           fmt::format("correct its state in the photo table, or take it again in state {}", state)});
    } else if (photo.state < photo.as_if) {
      findings.warnings.push_back(
          {"photos_as_if",
           fmt::format(
               "{} and {} look exchanged: the pattern of their light differs from the other views' by "
               "{} the other way round; neither was used",
               name, NameOf(photos, names, view, photo.as_if), DifferenceWords(photo)),
           fmt::format("exchange their states, {} and {}, in the photo table", state, as_if)});
    }
  }
}

void WarnOfStates(const std::vector<StateExplanation>& explanations, Findings& findings) {
  if (explanations.empty()) return;
  std::string remedy;
  for (const StateExplanation& e : explanations) remedy += (remedy.empty() ? "" : "; or ") + e.remedy;
  findings.warnings.push_back({"states_as_if", InWords(explanations), remedy, true});
}

nlohmann::json PhotosAsIfJson(const Session& session, const Registration& registration,
                              const std::vector<PhotoAsIf>& photos) {
  nlohmann::json list = nlohmann::json::array();
  for (const PhotoAsIf& photo : photos)
    list.push_back({{"view", registration.views[static_cast<size_t>(photo.view)].view},
                    {"state", StateName(session, photo.state)},
                    {"as_if_state", StateName(session, photo.as_if)},
                    {"exchanged", photo.is_exchanged},
                    {"encoded_in_srgb", photo.is_srgb},
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
