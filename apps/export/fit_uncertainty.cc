#include "apps/export/fit_uncertainty.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/stages/parameter_json.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/text/input_error.h"

namespace luxfit {

using nlohmann::json;

FitUncertainty ReadFitUncertainty(const std::string& out) {
  const std::string path = out + "/stages/fit.json";
  try {
    const json fit = ReadJson(path);
    FitUncertainty uncertainty;
    json values = json::array();
    for (const json& parameter : fit.at("parameters")) {
      uncertainty.parameters.push_back(IdFromJson(parameter));
      uncertainty.is_determined.push_back(parameter.at("determined"));
      values.push_back(parameter.at("value"));
    }
    uncertainty.values = VectorFromJson(values);
    uncertainty.relative_model_sigma = fit.value("relative_model_error", 0.0);
    if (!fit.at("covariance").empty()) uncertainty.covariance = MatrixFromJson(fit.at("covariance"));
    return uncertainty;
  } catch (const json::exception& e) {
    throw InputError(
        {path, 0}, "",
        std::string("expected the fit of a run of this version; run `luxfit run` again; ") + e.what());
  }
}

FittedSurfaces SurfacesOf(const FittedRoom& fitted) {
  FittedSurfaces surfaces{fitted.room.scene.materials, fitted.albedo, {}};
  surfaces.is_known.assign(surfaces.materials.size(), false);
  for (const json& material : fitted.result->at("materials")) {
    const auto at = std::find(surfaces.materials.begin(), surfaces.materials.end(),
                              material.at("name").get<std::string>());
    if (at == surfaces.materials.end() || material.at("albedo").is_null()) continue;
    surfaces.is_known[static_cast<size_t>(at - surfaces.materials.begin())] = true;
  }
  return surfaces;
}

}  // namespace luxfit
