#include "apps/stages/simulate/accuracy_choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace luxfit {

void RecordAccuracy(const AccuracyChoice& choice, int patches, double error_percent, RunContext& context) {
  const SceneLightOptions& options = choice.options;
  const FormFactorOptions& form_factors = options.room.form_factors;
  const auto named = [](FormFactorMethod method, int count) {
    return fmt::format("{}, {} rays", ToString(method), count);
  };
  std::vector<std::string> sizes, methods, sensor_rays;
  for (const TriedAccuracy& tried : choice.tried) {
    const std::string size = fmt::format("{:g} m, elements {:g} m", tried.patch_size_m, tried.element_size_m),
                      how = named(tried.method, tried.rays_per_element);
    if (std::count(sizes.begin(), sizes.end(), size) == 0) sizes.push_back(size);
    if (std::count(methods.begin(), methods.end(), how) == 0) methods.push_back(how);
    const std::string rays = std::to_string(tried.rays_per_sensor);
    if (std::count(sensor_rays.begin(), sensor_rays.end(), rays) == 0) sensor_rays.push_back(rays);
  }
  context.choices.push_back(
      {"patches",
       fmt::format("{} patches of {:g} m and less{}, elements of {:g} m", patches,
                   options.room.patches.patch_size_m,
                   options.room.patches.must_split ? ", split where illuminance varies" : "",
                   options.room.patches.element_size_m),
       sizes, choice.patches_because});
  context.choices.push_back({"form factors", named(form_factors.method, form_factors.rays_per_element),
                             methods, choice.rays_because});
  context.choices.push_back(
      {"rays of a sensor", std::to_string(options.rays_per_sensor), sensor_rays, choice.sensors_because});
  context.choices.push_back({"bounces",
                             choice.all_bounces ? "all" : std::to_string(options.solver.bounces),
                             {"as many as the error asks for", "all"},
                             choice.bounces_because});
  if (!choice.reached)
    context.warnings.push_back(
        {"accuracy_not_reached",
         fmt::format("an error of {:g} % was asked for, {} of what was reached; patches: {}; rays: {}",
                     error_percent,
                     std::isfinite(choice.estimated_error_percent)
                         ? fmt::format("{:.2g} % is the estimate", choice.estimated_error_percent)
                         : "there is no estimate",
                     choice.patches_because, choice.rays_because),
         "ask for less with --error, or leave out details of the mesh"});
}

nlohmann::json TriedJson(const AccuracyChoice& choice) {
  nlohmann::json list = nlohmann::json::array();
  for (const TriedAccuracy& tried : choice.tried) {
    list.push_back({{"patch_size_m", tried.patch_size_m},
                    {"element_size_m", tried.element_size_m},
                    {"rays_per_sensor", tried.rays_per_sensor},
                    {"method", ToString(tried.method)},
                    {"rays", tried.rays_per_element},
                    {"patches", tried.patches},
                    {"elements", tried.elements},
                    {"change_percent", tried.change_percent}});
  }
  return list;
}

}  // namespace luxfit
