#include "apps/stages/observe/found_furniture.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/stages/linearize/linearize.h"
#include "apps/stages/stage_cache.h"
#include "inverse/furniture/furniture.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {
namespace {

using nlohmann::json;

std::vector<SignatureView> ViewsOf(const Session& session, const LinearizedPhotos& photos,
                                   const RegisteredSession& registered, const RunContext& context) {
  const std::vector<RegisteredView>& views = registered.registration.views;
  std::vector<SignatureView> signatures(views.size());
  tbb::parallel_for(size_t{0}, views.size(), [&](size_t v) {
    const Camera& camera = registered.cameras[static_cast<size_t>(views[v].camera)];
    std::vector<std::shared_ptr<const LuminanceImage>> kept(session.states.size());
    std::vector<const LuminanceImage*> images(session.states.size());
    for (const LinearizedPhoto& photo : photos.photos) {
      if (photo.view != views[v].view || photo.camera != views[v].camera) continue;
      const auto state = static_cast<size_t>(StateIndex(session, photo.state));
      kept[state] = ReadKept(photos, photo, camera, context);
      images[state] = kept[state].get();
    }
    signatures[v] = MakeSignatureView(camera, views[v].cam_from_world, images);
  });
  return signatures;
}

// Returns where meters stood and tags lie: no solid is there.
std::vector<Eigen::Vector3d> FreePlacesOf(const Session& session) {
  std::vector<Eigen::Vector3d> places;
  for (const SessionReading& reading : session.luxmeter.readings) places.push_back(reading.position_m);
  for (const SurveyedTag& tag : session.tags.survey) places.push_back(tag.center_in_world);
  return places;
}

// Returns the box as a session gives it.
std::string BoxText(const FoundBox& found) {
  const RoomBox& b = found.box;
  std::string text =
      fmt::format("{{ name = \"{}\", min = [{:.2f}, {:.2f}, {:.2f}], max = [{:.2f}, {:.2f}, {:.2f}]", b.name,
                  b.min_m.x(), b.min_m.y(), b.min_m.z(), b.max_m.x(), b.max_m.y(), b.max_m.z());
  constexpr double kDegPerRad = 57.29577951308232;
  if (std::abs(b.turn_rad) > 1e-3) text += fmt::format(", turn_deg = {:.1f}", kDegPerRad * b.turn_rad);
  return text + " }";
}

void Record(const std::vector<FoundBox>& found, RunContext& context) {
  if (found.empty()) return;
  std::string words;
  for (const FoundBox& f : found) {
    words += (words.empty() ? "" : ", ") + BoxText(f);
  }
  context.warnings.push_back(
      {"furniture_found",
       fmt::format("photos show {} box{} that the room lacks, and the fit uses {}: box = [{}]", found.size(),
                   found.size() == 1 ? "" : "es", found.size() == 1 ? "it" : "them", words),
       "measure what stands there and give it, or write furniture = \"given\" under [scene] where there is "
       "nothing"});
}

}  // namespace

json BoxesJson(const std::vector<RoomBox>& boxes) {
  json list = json::array();
  for (const RoomBox& b : boxes)
    list.push_back({{"name", b.name},
                    {"min_m", {b.min_m.x(), b.min_m.y(), b.min_m.z()}},
                    {"max_m", {b.max_m.x(), b.max_m.y(), b.max_m.z()}},
                    {"turn_rad", b.turn_rad}});
  return list;
}

std::vector<RoomBox> BoxesFromJson(const json& list) {
  std::vector<RoomBox> boxes;
  for (const json& entry : list) {
    RoomBox box;
    box.name = entry.at("name");
    for (int i = 0; i < 3; ++i) {
      box.min_m[i] = entry.at("min_m").at(static_cast<size_t>(i));
      box.max_m[i] = entry.at("max_m").at(static_cast<size_t>(i));
    }
    box.turn_rad = entry.at("turn_rad");
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<RoomBox> FurnitureKept(const Session& session, const LinearizedPhotos& photos,
                                   const RegisteredSession& registered, const Room& room,
                                   const SessionInputs& inputs, RunContext& context) {
  if (!session.scene || !session.scene->finds_furniture || registered.registration.views.size() < 3)
    return {};
  if (const auto kept = KeptProduct("furniture", inputs.furniture, context)) return BoxesFromJson(*kept);
  const StageMark mark(context);
  const StageTimer timer(context, "furniture", "what views agree on and the room lacks");
  FurnitureOptions options;
  options.free_places = FreePlacesOf(session);
  const std::vector<FoundBox> found =
      FindFurniture(room.scene, ViewsOf(session, photos, registered, context), options);
  Record(found, context);
  std::vector<RoomBox> boxes;
  boxes.reserve(found.size());
  for (const FoundBox& f : found) boxes.push_back(f.box);
  KeepProduct("furniture", inputs.furniture, context, mark, BoxesJson(boxes));
  return boxes;
}

}  // namespace luxfit
