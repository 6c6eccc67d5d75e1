#include "tests/support/truth_comparison.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace luxfit {
namespace {

using nlohmann::json;

Eigen::Vector3d Vector(const json& v) { return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()}; }

double Luminance(const json& rgb) { return Eigen::Vector3d(0.265, 0.670, 0.065).dot(Vector(rgb)); }

const json* Find(const json& list, const std::string& key, const std::string& value) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const json& item) { return item[key] == value; });
  return found == list.end() ? nullptr : &*found;
}

// Of the same id; luminaires that the program had to name ("lamp1", ...): the nearest.
const json* FittedOf(const json& luminaires, const json& lamp) {
  if (const json* same = Find(luminaires, "id", lamp["id"])) return same;
  const auto distance = [&](const json& one) {
    return (Vector(one["position_m"]) - Vector(lamp["position"])).norm();
  };
  const json* nearest = nullptr;
  for (const json& one : luminaires) {
    const bool is_named_by_us = one["id"].get<std::string>().rfind("lamp", 0) == 0;
    if (is_named_by_us && (nearest == nullptr || distance(one) < distance(*nearest))) nearest = &one;
  }
  return nearest;
}

}  // namespace

TruthComparison CompareWithTruth(const json& result, const json& truth) {
  TruthComparison comparison;
  for (const json& lamp : truth["lamps"]) {
    const std::string id = lamp["id"];
    const json* fitted = FittedOf(result["luminaires"], lamp);
    if (fitted == nullptr || !(*fitted)["flux_lm"].is_number()) {
      ++comparison.luminaires_missing;
      continue;
    }
    const LuminaireError error{
        1e3 * (Vector((*fitted)["position_m"]) - Vector(lamp["position"])).norm(),
        100 * ((*fitted)["flux_lm"].get<double>() / lamp["flux_lm"].get<double>() - 1)};
    comparison.luminaires[id] = error;
    comparison.worst_position_mm = std::max(comparison.worst_position_mm, error.position_mm);
    comparison.worst_flux_percent = std::max(comparison.worst_flux_percent, std::abs(error.flux_percent));
  }
  for (const json& material : result["materials"]) {
    const std::string name = material["name"];
    if (material["source"] != "estimated" || !truth["materials"].contains(name)) continue;
    const double error = material["albedo"].get<double>() - Luminance(truth["materials"][name]);
    comparison.albedo_error[name] = error;
    comparison.worst_albedo = std::max(comparison.worst_albedo, std::abs(error));
  }
  std::vector<double> cameras;
  for (const json& view : result["views"]) {
    const json* known = Find(truth["views"], "view", view["view"]);
    if (known == nullptr) continue;
    cameras.push_back(1e3 * (Vector(view["position_m"]) - Vector((*known)["position_m"])).norm());
    comparison.camera_mm[view["view"]] = cameras.back();
  }
  std::sort(cameras.begin(), cameras.end());
  if (!cameras.empty()) {
    comparison.median_camera_mm = cameras[cameras.size() / 2];
    comparison.worst_camera_mm = cameras.back();
  }
  return comparison;
}

std::string TruthTable(const json& result, const json& truth) {
  const TruthComparison comparison = CompareWithTruth(result, truth);
  std::string text =
      "\nluminaire  true position m          fitted position m        off by     true lm  fitted lm  off "
      "by\n";
  for (const auto& [id, error] : comparison.luminaires) {
    const json& lamp = *Find(truth["lamps"], "id", id);
    const json& fitted = *FittedOf(result["luminaires"], lamp);
    const Eigen::Vector3d p = Vector(lamp["position"]), q = Vector(fitted["position_m"]);
    text += fmt::format(
        "{:<10} {:6.3f} {:6.3f} {:6.3f}     {:6.3f} {:6.3f} {:6.3f}     {:4.1f} mm   {:7.0f}  {:9.1f}  "
        "{:+.2f} %\n",
        id, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), error.position_mm, lamp["flux_lm"].get<double>(),
        fitted["flux_lm"].get<double>(), error.flux_percent);
  }
  text += "\nmaterial       true albedo   fitted    off by\n";
  for (const auto& [name, error] : comparison.albedo_error) {
    const double known = Luminance(truth["materials"][name]);
    text += fmt::format("{:<14} {:11.4f} {:8.4f}   {:+.4f}\n", name, known, known + error, error);
  }
  text += fmt::format("\ncamera centres: median {:.1f} mm, worst {:.1f} mm off, of {} views\n",
                      comparison.median_camera_mm, comparison.worst_camera_mm, comparison.camera_mm.size());
  return text;
}

}  // namespace luxfit
