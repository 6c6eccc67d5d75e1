#include "apps/accuracy_choices.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace luxfit {

void RecordAccuracy(const AccuracyChoice& choice, int patches, double error_percent, RunContext& context) {
  const SceneLightOptions& options = choice.options;
  std::vector<std::string> sizes, rays;
  for (const TriedAccuracy& tried : choice.tried) {
    const std::string size = fmt::format("{:g} m", tried.patch_size_m),
                      count = std::to_string(tried.rays_per_element);
    if (sizes.empty() || sizes.back() != size) sizes.push_back(size);
    if (rays.empty() || rays.back() != count) rays.push_back(count);
  }
  context.choices.push_back(
      {"patches",
       fmt::format("{} patches up to {:g} m, elements up to {:g} m", patches,
                   options.room.patches.patch_size_m, options.room.patches.element_size_m),
       sizes, choice.patches_because});
  context.choices.push_back({"rays per element", std::to_string(options.room.form_factors.rays_per_element),
                             rays, choice.rays_because});
  context.choices.push_back({"bounces",
                             choice.all_bounces ? "all" : std::to_string(options.solver.bounces),
                             {"as many as the error asks for", "all"},
                             choice.bounces_because});
  if (!choice.reached)
    context.warnings.push_back(
        {"accuracy_not_reached",
         fmt::format(
             "an error of {:g} % was asked for, {:.2g} % is the estimate of what was reached; patches: "
             "{}; rays: {}",
             error_percent, choice.estimated_error_percent, choice.patches_because, choice.rays_because),
         "ask for less with --error, or leave out details of the mesh"});
}

nlohmann::json TriedJson(const AccuracyChoice& choice) {
  nlohmann::json list = nlohmann::json::array();
  for (const TriedAccuracy& tried : choice.tried) {
    list.push_back({{"patch_size_m", tried.patch_size_m},
                    {"rays", tried.rays_per_element},
                    {"patches", tried.patches},
                    {"elements", tried.elements},
                    {"change_percent", tried.change_percent}});
  }
  return list;
}

}  // namespace luxfit
