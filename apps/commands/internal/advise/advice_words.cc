#include "apps/commands/internal/advise/advice_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/text/formats/json_vectors.h"

namespace luxfit {
namespace {

using nlohmann::json;

struct KindWords {
  const char* name;
  const char* unit;  // of the terminal
  double per_unit;   // of the terminal
};

KindWords WordsOf(AdviceKind kind) {
  switch (kind) {
    case AdviceKind::kFlux:
      return {"flux", "%", 100};
    case AdviceKind::kPosition:
      return {"position", "mm", 1000};
    case AdviceKind::kReading:
      return {"reading", "%", 100};
  }
  return {"", "", 1};
}

std::string OfWhat(const AdviceQuantity& quantity) {
  const std::string name = WordsOf(quantity.kind).name;
  return quantity.kind == AdviceKind::kReading ? name + " " + quantity.owner : name + " of " + quantity.owner;
}

std::string ChangeText(const SigmaChange& change) {
  const KindWords words = WordsOf(change.of.kind);
  if (change.of.kind == AdviceKind::kPosition && !change.is_determined)
    return OfWhat(change.of) + " (first of two stands)";
  const auto sigma = [&](double value, bool is_determined) {
    return is_determined ? fmt::format("{:.2g}", words.per_unit * value) : "not determined";
  };
  return fmt::format("{} {} -> {}{}", OfWhat(change.of), sigma(change.before, change.was_determined),
                     sigma(change.after, change.is_determined),
                     change.is_determined ? std::string(" ") + words.unit : "");
}

json ChangeJson(const SigmaChange& change) {
  const bool is_position = change.of.kind == AdviceKind::kPosition;
  const std::string unit = is_position ? "_m" : "_percent";
  const double factor = is_position ? 1 : 100;
  const auto sigma = [&](double value, bool is_determined) {
    return is_determined ? json(factor * value) : json(nullptr);
  };
  return {{"kind", WordsOf(change.of.kind).name},
          {"of", change.of.owner},
          {"sigma_before" + unit, sigma(change.before, change.was_determined)},
          {"sigma_after" + unit, sigma(change.after, change.is_determined)}};
}

// Returns the material of the surface that carries the meter.
std::string CarrierOf(const Room& room, const Sensor& sensor) {
  constexpr double kNearM = 0.02;
  const RayHit hit = room.rays.Trace(sensor.position, -sensor.normal);
  if (hit.facet < 0 || hit.distance > kNearM) return "";
  const Facet& facet = room.scene.facets[static_cast<size_t>(hit.facet)];
  return room.scene.materials[static_cast<size_t>(facet.material)];
}

std::string PlaceText(const Eigen::Vector3d& place) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", place.x(), place.y(), place.z());
}

void DescribePhoto(const Room& room, const SessionAdvice& advice, const PhotoCandidate& photo, json& entry) {
  const AdviceView& view = advice.given.views[static_cast<size_t>(photo.view)];
  const Eigen::Isometry3d world_from_cam = view.cam_from_world.inverse();
  const Eigen::Vector3d eye = world_from_cam.translation(), looking = world_from_cam.linear().col(2);
  const std::string material = MaterialInView(room, view);
  entry["id"] = view.id;
  entry["position_m"] = VectorJson(eye);
  entry["looking"] = VectorJson(looking);
  entry["looking_at"] = material;
  const double tilt_deg = 180 / M_PI * std::asin(std::clamp(looking.z(), -1.0, 1.0));
  std::string towards = fmt::format("{:.0f} deg from +x", 180 / M_PI * std::atan2(looking.y(), looking.x()));
  if (std::abs(tilt_deg) >= 1)
    towards += fmt::format(", {:.0f} deg {}", std::abs(tilt_deg), tilt_deg > 0 ? "up" : "down");
  entry["words"] = fmt::format("photograph state {} from {}{}, looking at {} ({})",
                               entry["state"].get<std::string>(), view.id.empty() ? "" : view.id + " ",
                               PlaceText(eye), material.empty() ? "nothing" : material, towards);
}

void DescribeReading(const Room& room, const ReadingCandidate& reading, json& entry) {
  const std::string carrier = CarrierOf(room, reading.sensor);
  entry["id"] = reading.id;
  entry["position_m"] = VectorJson(reading.sensor.position);
  entry["normal"] = VectorJson(reading.sensor.normal);
  entry["on"] = carrier;
  entry["words"] = fmt::format("read state {} at {}{}{}", entry["state"].get<std::string>(),
                               reading.id.empty() ? "" : reading.id + " ", PlaceText(reading.sensor.position),
                               carrier.empty() ? "" : " on " + carrier);
}

json StepJson(const Room& room, const SessionAdvice& advice, const AdviceStep& step, size_t rank) {
  const AdviceGiven& given = advice.given;
  const int state = step.is_photo ? given.photos[step.candidate].state : given.readings[step.candidate].state;
  const AdviceState& named = advice.states[static_cast<size_t>(state)];
  json entry = {{"rank", rank},
                {"kind", step.is_photo ? "photo" : "reading"},
                {"state", named.name},
                {"state_is_new", named.is_new},
                {"gain_percent", 100 * step.gain},
                {"helps", ChangeJson(step.helped)},
                {"changes", json::array()}};
  if (step.is_photo) DescribePhoto(room, advice, given.photos[step.candidate], entry);
  if (!step.is_photo) DescribeReading(room, given.readings[step.candidate], entry);
  entry["words"] = entry["words"].get<std::string>() + ": " + ChangeText(step.helped);
  for (const SigmaChange& change : step.changes) entry["changes"].push_back(ChangeJson(change));
  return entry;
}

// Returns the worst sigma of each kind.
std::string NowText(const AdvicePlan& plan) {
  std::string text;
  for (const AdviceKind kind : {AdviceKind::kFlux, AdviceKind::kPosition, AdviceKind::kReading}) {
    const SigmaChange* worst = nullptr;
    for (const SigmaChange& change : plan.now) {
      if (change.of.kind == kind && (worst == nullptr || change.before > worst->before)) worst = &change;
    }
    if (worst == nullptr) continue;
    const KindWords words = WordsOf(kind);
    text += (text.empty() ? "" : ", ") + OfWhat(worst->of) + " " +
            (worst->was_determined ? fmt::format("{:.2g} {}", words.per_unit * worst->before, words.unit)
                                   : std::string("not determined"));
  }
  return text;
}

}  // namespace

void AddAdvice(const Room& room, const SessionAdvice& advice, const AdvicePlan& plan, double least_gain,
               json& artifact) {
  for (const Assumption& one : advice.assumed)
    artifact["assumed"].push_back({{"what", one.what}, {"of", one.of}, {"value", one.value}});
  artifact["enough"] = plan.is_enough;
  artifact["undetermined"] = json::array();
  for (const AdviceQuantity& quantity : plan.Undetermined())
    artifact["undetermined"].push_back(OfWhat(quantity));
  artifact["least_gain_percent"] = 100 * least_gain;
  artifact["worst_now"] = NowText(plan);
  artifact["now"] = json::array();
  for (const SigmaChange& change : plan.now) artifact["now"].push_back(ChangeJson(change));
  artifact["advice"] = json::array();
  for (size_t i = 0; i < plan.steps.size(); ++i)
    artifact["advice"].push_back(StepJson(room, advice, plan.steps[i], i + 1));
}

std::string AdviceText(const json& artifact) {
  std::string text;
  for (const json& one : artifact.value("assumed", json::array()))
    text += fmt::format(
        "assumed: {}{}: {}\n", one["what"].get<std::string>(),
        one["of"].empty() ? ""
                          : fmt::format(" of {}", fmt::join(one["of"].get<std::vector<std::string>>(), ", ")),
        one["value"].get<std::string>());
  text += "worst now: " + artifact["worst_now"].get<std::string>() + "\n";
  for (const json& step : artifact["advice"])
    text += fmt::format("{}  {}\n", step["rank"].get<int>(), step["words"].get<std::string>());
  if (!artifact["enough"].get<bool>()) return text;
  const auto undetermined = artifact["undetermined"].get<std::vector<std::string>>();
  text +=
      fmt::format("{}: no {}candidate lowers a sigma by more than {:g} %\n",
                  undetermined.empty() ? "enough" : "no more to advise",
                  artifact["advice"].empty() ? "" : "further ", artifact["least_gain_percent"].get<double>());
  if (!undetermined.empty())
    text += fmt::format("not determined by any of these: {}; allow other candidates, photos and readings\n",
                        fmt::join(undetermined, ", "));
  return text;
}

}  // namespace luxfit
