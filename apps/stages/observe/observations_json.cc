#include "apps/stages/observe/observations_json.h"

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "apps/text/formats/json_vectors.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr size_t kNumbers = 11;  // numbers of one observation

std::array<double, kNumbers> NumbersOf(const Observation& o) {
  return {static_cast<double>(o.element),
          static_cast<double>(o.view),
          static_cast<double>(o.state),
          static_cast<double>(o.pixels),
          o.relative_luminance,
          o.variance,
          o.relative_rgb[0],
          o.relative_rgb[1],
          o.relative_rgb[2],
          o.relative_indirect,
          o.relative_ambient};
}

Observation FromNumbers(const std::array<double, kNumbers>& n) {
  Observation o;
  o.element = static_cast<int>(n[0]);
  o.view = static_cast<int>(n[1]);
  o.state = static_cast<int>(n[2]);
  o.pixels = static_cast<int>(n[3]);
  o.relative_luminance = n[4];
  o.variance = n[5];
  o.relative_rgb = {n[6], n[7], n[8]};
  o.relative_indirect = n[9];
  o.relative_ambient = n[10];
  return o;
}

// The rays follow one another: direction and pixels per radian.
json OutlineJson(const SeenOutline& outline) {
  Eigen::VectorXd rays(4 * static_cast<Eigen::Index>(outline.rays.size()));
  for (size_t i = 0; i < outline.rays.size(); ++i)
    rays.segment<4>(4 * static_cast<Eigen::Index>(i)) << outline.rays[i].direction,
        outline.rays[i].px_per_rad;
  return {{"view", outline.view},
          {"camera", outline.camera},
          {"state", outline.state},
          {"eye_m", VectorJson(outline.eye)},
          {"rays", VectorJson(rays)}};
}

SeenOutline OutlineFromJson(const json& entry) {
  SeenOutline outline;
  outline.view = entry.at("view");
  outline.camera = entry.at("camera");
  outline.state = entry.at("state");
  outline.eye = VectorFromJson(entry.at("eye_m"));
  const Eigen::VectorXd rays = VectorFromJson(entry.at("rays"));
  for (Eigen::Index i = 0; i + 4 <= rays.size(); i += 4)
    outline.rays.push_back({rays.segment<3>(i), rays[i + 3]});
  return outline;
}

json AsIfJson(const Evidence& observed) {
  json photos = json::array(), states = json::array();
  for (const PhotoAsIf& p : observed.photos_as_if)
    photos.push_back({{"view", p.view},
                      {"state", p.state},
                      {"as_if", p.as_if},
                      {"is_exchanged", p.is_exchanged},
                      {"difference", p.difference},
                      {"difference_as_if", p.difference_as_if},
                      {"is_srgb", p.is_srgb}});
  for (const StateExplanation& e : observed.states_as_if) {
    json dimming = json::array();
    for (const Eigen::VectorXd& row : e.dimming) dimming.push_back(VectorJson(row));
    states.push_back({{"as_if", e.as_if},
                      {"remedy", e.remedy},
                      {"dimming", dimming},
                      {"difference_as_given", e.difference_as_given},
                      {"difference", e.difference}});
  }
  return {{"photos", photos}, {"states", states}};
}

void ReadAsIf(const json& in, Evidence& observed) {
  for (const json& p : in.at("photos"))
    observed.photos_as_if.push_back({p.at("view"), p.at("state"), p.at("as_if"), p.at("is_exchanged"),
                                     p.at("difference"), p.at("difference_as_if"), p.at("is_srgb")});
  for (const json& e : in.at("states")) {
    StateExplanation explanation{
        e.at("as_if"), e.at("remedy"), {}, e.at("difference_as_given"), e.at("difference")};
    for (const json& row : e.at("dimming")) explanation.dimming.push_back(VectorFromJson(row));
    observed.states_as_if.push_back(std::move(explanation));
  }
}

json ViewJson(const Watcher& view) {
  json border = json::array();
  for (const Eigen::Vector3d& ray : view.border) border.push_back(VectorJson(ray));
  return {{"eye_m", VectorJson(view.eye)}, {"border", border}, {"states", view.states}};
}

Watcher ViewFromJson(const json& in) {
  Watcher view;
  view.eye = VectorFromJson(in.at("eye_m"));
  for (const json& ray : in.at("border")) view.border.emplace_back(VectorFromJson(ray));
  view.states = in.at("states").get<std::vector<int>>();
  return view;
}

}  // namespace

json ObservationsJson(const Evidence& observed) {
  constexpr size_t kBytes = kNumbers * sizeof(double);
  std::vector<uint8_t> bytes(observed.observations.size() * kBytes);
  for (size_t i = 0; i < observed.observations.size(); ++i) {
    const auto numbers = NumbersOf(observed.observations[i]);
    std::memcpy(bytes.data() + i * kBytes, numbers.data(), kBytes);
  }
  json seen = json::array();
  for (const SeenPlace& p : observed.seen)
    seen.push_back({{"position_m", VectorJson(p.position)},
                    {"sigma_m", p.sigma_m},
                    {"states", p.states},
                    {"dark_states", p.dark_states},
                    {"covered_states", p.covered_states},
                    {"photos", p.photos},
                    {"views", p.views},
                    {"missing", p.missing},
                    {"is_at_common_height", p.is_at_common_height},
                    {"size_m", VectorJson(p.size_m)},
                    {"heading", VectorJson(p.heading)},
                    {"area_m2", VectorJson(Eigen::VectorXd::Constant(1, p.area_m2))}});
  json outlines = json::array();
  for (const SeenOutline& outline : observed.outlines) outlines.push_back(OutlineJson(outline));
  json views = json::array();
  for (const Watcher& view : observed.views) views.push_back(ViewJson(view));
  return {{"observations", json::binary(std::move(bytes))},
          {"seen", seen},
          {"outlines", outlines},
          {"views", views},
          {"ambient_spread", observed.ambient_spread},
          {"as_if", AsIfJson(observed)}};
}

Evidence ObservationsFromJson(const json& in) {
  constexpr size_t kBytes = kNumbers * sizeof(double);
  const std::vector<uint8_t>& bytes = in.at("observations").get_binary();
  Evidence observed;
  observed.observations.reserve(bytes.size() / kBytes);
  for (size_t i = 0; i + kBytes <= bytes.size(); i += kBytes) {
    std::array<double, kNumbers> numbers{};
    std::memcpy(numbers.data(), bytes.data() + i, kBytes);
    observed.observations.push_back(FromNumbers(numbers));
  }
  for (const json& entry : in.at("seen")) {
    SeenPlace place;
    place.position = VectorFromJson(entry.at("position_m"));
    place.sigma_m = entry.at("sigma_m");
    place.states = entry.at("states").get<std::vector<int>>();
    place.dark_states = entry.at("dark_states").get<std::vector<int>>();
    place.covered_states = entry.at("covered_states").get<std::vector<int>>();
    place.photos = entry.at("photos");
    place.views = entry.at("views");
    place.missing = entry.at("missing");
    place.is_at_common_height = entry.at("is_at_common_height");
    place.size_m = VectorFromJson(entry.at("size_m"));
    place.heading = VectorFromJson(entry.at("heading"));
    place.area_m2 = VectorFromJson(entry.at("area_m2"))[0];
    observed.seen.push_back(place);
  }
  for (const json& entry : in.value("views", json::array())) observed.views.push_back(ViewFromJson(entry));
  observed.ambient_spread = in.at("ambient_spread");
  for (const json& entry : in.at("outlines")) observed.outlines.push_back(OutlineFromJson(entry));
  ReadAsIf(in.at("as_if"), observed);
  return observed;
}

}  // namespace luxfit
