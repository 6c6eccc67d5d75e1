#include "apps/session/earlier_result.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/session/session_corrections.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/input_error.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

using nlohmann::json;

Eigen::Vector3d VectorFrom(const json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

// Returns the flux at which the fit ended; null where it had none.
json FluxOfFit(const std::string& id, const std::string& result_path) {
  const std::string folder = std::filesystem::path(result_path).parent_path().string();
  const json fit = ReadJson(folder + "/stages/fit.json");
  for (const json& parameter : fit.at("parameters")) {
    if (parameter.at("kind") == "log_flux" && parameter.at("luminaire") == id)
      return std::exp(parameter.at("value").get<double>());
  }
  return nullptr;
}

json FluxOf(const json& fitted, FluxUnit unit, const std::string& path) {
  if (unit != FluxUnit::kLumen && fitted.contains("flux_relative")) return fitted["flux_relative"];
  const json& flux = fitted.at("flux_lm");
  return flux.is_null() && unit == FluxUnit::kAsFitted ? FluxOfFit(fitted.at("id"), path) : flux;
}

void Replace(SessionLuminaire& luminaire, const json& fitted, FluxUnit unit, const std::string& path) {
  const json flux = FluxOf(fitted, unit, path);
  if (!flux.is_number())
    throw InputError({path, 0}, "luminaires",
                     "expected fluxes in lm, but that of " + Quoted(luminaire.id) +
                         (fitted.contains("flux_relative")
                              ? " is relative; run the fit with a luxmeter reading that sets the scale"
                              : " is not determined; the result's warnings say what the data lack"));
  luminaire.line = std::max(luminaire.line, 1);  // > 0: the luminaire is described now
  luminaire.position_m = VectorFrom(fitted.at("position_m"));
  luminaire.aim = VectorFrom(fitted.at("aim"));
  luminaire.flux_lm = flux.get<double>();
  luminaire.shape = fitted.at("shape").get<std::string>();
  luminaire.size_m = fitted.at("size_m").get<std::vector<double>>();
  // A photometric file stays the session's own.
  if (luminaire.photometry_path.empty()) luminaire.photometry = fitted.at("photometry").get<std::string>();
  if (fitted.contains("heading")) luminaire.heading = VectorFrom(fitted.at("heading"));
  if (fitted.contains("gamma_deg")) {
    luminaire.gamma_deg = fitted.at("gamma_deg").get<std::vector<double>>();
    luminaire.cd_per_klm = fitted.at("cd_per_klm").get<std::vector<double>>();
  }
  if (fitted.contains("emission")) {
    const json& rows = fitted.at("emission");
    luminaire.emission.resize(static_cast<Eigen::Index>(rows.at(0).size()),
                              static_cast<Eigen::Index>(rows.size()));
    for (size_t j = 0; j < rows.size(); ++j) {
      for (size_t i = 0; i < rows[0].size(); ++i)
        luminaire.emission(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            rows[j].at(i).get<double>();
    }
  }
  if (fitted.contains("cosine_exponent")) luminaire.cosine_exponent = fitted["cosine_exponent"].get<double>();
}

void ReplaceLuminaires(Session& session, const json& result, FluxUnit unit, bool is_held,
                       const std::string& path) {
  for (const json& fitted : result.at("luminaires")) {
    const std::string id = fitted.at("id").get<std::string>();
    const auto known = std::find_if(session.luminaires.begin(), session.luminaires.end(),
                                    [&](const SessionLuminaire& l) { return l.id == id; });
    if (known == session.luminaires.end())
      throw InputError({path, 0}, "luminaires",
                       "expected luminaires of " + session.path + ", got " + Quoted(id) +
                           "; give the result of this session");
    Replace(*known, fitted, unit, path);
    known->is_held = is_held;
  }
}

std::runtime_error NotWhole(const std::string& path, const json::exception& e) {
  return InputError({path, 0}, "", std::string("expected a whole result of luxfit; ") + e.what());
}

}  // namespace

std::string ResultFileOf(const std::string& named) {
  namespace fs = std::filesystem;
  return fs::is_directory(named) ? (fs::path(named) / "result.json").string() : named;
}

std::string RunFolderOf(const std::string& named) {
  const std::filesystem::path path = named;
  if (path.filename() != "result.json") return named;
  return path.has_parent_path() ? path.parent_path().string() : ".";
}

json ReadResult(const std::string& path) {
  json result = ReadJson(path);
  if (!result.is_object() || result.value("format", "") != "luxfit-result-1")
    throw InputError({path, 0}, "format",
                     "expected \"luxfit-result-1\", got another file; give the result.json that `luxfit run` "
                     "wrote");
  return result;
}

Session WithCorrectionsOf(Session session, const json& result) {
  const auto corrections = result.find("corrections");
  return corrections == result.end() ? session
                                     : Corrected(std::move(session), CorrectionsFromJson(*corrections));
}

Session WithLuminairesOf(Session session, const std::string& path) {
  const json result = ReadResult(path);
  try {
    ReplaceLuminaires(session, result, FluxUnit::kLumen, true, path);
  } catch (const json::exception& e) {
    throw NotWhole(path, e);
  }
  session.input_files.push_back(path);
  return session;
}

Session WithResult(Session session, const std::string& path, FluxUnit unit) {
  const json result = ReadResult(path);
  try {
    session = WithCorrectionsOf(std::move(session), result);
    ReplaceLuminaires(session, result, unit, false, path);
    for (const json& material : result.at("materials")) {
      if (!session.scene) break;
      const json &rgb = material.at("albedo_rgb"), &grey = material.at("albedo");
      const std::string name = material.at("name").get<std::string>();
      if (rgb.is_array()) {
        session.scene->known_albedo_rgb[name] = VectorFrom(rgb);
      } else if (grey.is_number()) {
        session.scene->known_albedo_rgb[name] = Eigen::Vector3d::Constant(grey.get<double>());
      }
    }
  } catch (const json::exception& e) {
    throw NotWhole(path, e);
  }
  session.input_files.push_back(path);
  return session;
}

}  // namespace luxfit
