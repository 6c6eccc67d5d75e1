#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/commands/commands.h"
#include "apps/export/fit_uncertainty.h"
#include "apps/export/fitted_room.h"
#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/session/earlier_result.h"
#include "apps/text/suggest.h"
#include "forward/room/threads.h"

namespace luxfit {
namespace {

namespace py = pybind11;
using nlohmann::json;

// Holds result.json and, from stages/fit.json, the parameters with their covariance.
struct Result {
  json whole;
  FitUncertainty fit;
  std::string out;  // folder

  const json& List(const std::string& key) const {
    static const json kNone = json::array();
    const auto found = whole.find(key);
    return found == whole.end() ? kNone : *found;
  }
};

Result ReadResultOf(const std::filesystem::path& given) {
  const std::filesystem::path path = ResultFileOf(given.string()), out = path.parent_path();
  Result result{ReadResult(path.string()), {}, out.string()};
  if (std::filesystem::exists(out / "stages" / "fit.json")) result.fit = ReadFitUncertainty(out.string());
  return result;
}

Result Fit(const std::filesystem::path& session, const std::filesystem::path& out, int threads, bool fresh,
           const std::optional<std::filesystem::path>& luminaires, double budget_s, bool apply) {
  if (!(budget_s > 0))
    throw py::value_error("fit: budget_s: expected seconds > 0, got " + std::to_string(budget_s));
  RunCommandOptions options;
  options.session = session.string();
  options.out = out.string();
  if (luminaires) options.earlier_luminaires = ResultFileOf(luminaires->string());
  options.fresh = fresh;
  options.prints = false;
  options.budget_s = budget_s;
  options.applies = apply;
  options.command_line = "luxfit.fit(\"" + options.session + "\", \"" + options.out + "\")";
  const py::gil_scoped_release release;
  const ThreadLimit limit(threads);
  RunCommand(options);
  return ReadResultOf(out);
}

Eigen::VectorXd Column(const json& list, const std::string& key) {
  Eigen::VectorXd column(static_cast<Eigen::Index>(list.size()));
  for (size_t i = 0; i < list.size(); ++i) column[static_cast<Eigen::Index>(i)] = NumberOrNan(list[i], key);
  return column;
}

std::vector<std::string> Names(const json& list, const std::string& key) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const json& entry : list) names.push_back(entry.value(key, ""));
  return names;
}

Eigen::VectorXd LightOfResult(const Result& result, const RowMajorXd& position_m, const RowMajorXd& normal,
                              const std::map<std::string, double>& dimming) {
  std::vector<Sensor> places = SensorsFrom(position_m, normal);
  const py::gil_scoped_release release;
  const FittedRoom fitted = ReadFittedRoom(result.out);
  for (Sensor& place : places) place.response = fitted.session.luxmeter.response;
  return fitted.light->LightAt(places).Under(DimmingFrom(fitted.luminaires, dimming));
}

RowMajorXd CovarianceOf(const Result& result, const std::vector<std::string>& names) {
  const std::vector<std::string> known = NamesOf(result.fit.parameters);
  std::vector<Eigen::Index> at;
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) throw std::runtime_error("covariance_of: " + ExpectedOneOf(known, name));
    at.push_back(found - known.begin());
  }
  if (result.fit.covariance.size() == 0) throw std::runtime_error("covariance_of: the fit has no covariance");
  return result.fit.covariance(at, at);
}

using ResultClass = py::class_<Result>;

// Adds properties that are lists of dicts, with the keys of result.json.
void AddLists(ResultClass& result) {
  for (const char* key : {"luminaires", "materials", "views", "luxmeter", "choices", "warnings"})
    result.def_property_readonly(key, [key](const Result& r) { return PythonFrom(r.List(key)); });
  result.def_property_readonly(
      "summary", [](const Result& r) { return PythonFrom(r.whole.value("summary", json::object())); });
  result.def_property_readonly(
      "whole", [](const Result& r) { return PythonFrom(r.whole); }, "All of result.json.");
  result.def_property_readonly(
      "status", [](const Result& r) { return r.whole.value("status", ""); },
      "done, or undetermined (see status_because).");
  result.def_property_readonly(
      "status_because",
      [](const Result& r) { return r.whole.value("status_because", std::vector<std::string>()); },
      "The codes of the warnings that say what is undetermined; empty where nothing is.");
}

// Adds properties that are arrays, with one row for each entry of those lists.
void AddColumns(ResultClass& result) {
  const auto names = [&](const char* name, const char* of, const char* key, const char* help) {
    result.def_property_readonly(
        name, [of, key](const Result& r) { return Names(r.List(of), key); }, help);
  };
  const auto numbers = [&](const char* name, const char* of, const char* key, const char* help) {
    result.def_property_readonly(
        name, [of, key](const Result& r) { return Column(r.List(of), key); }, help);
  };
  const auto vectors = [&](const char* name, const char* of, const char* key, const char* help) {
    result.def_property_readonly(
        name, [of, key](const Result& r) { return VectorRows(r.List(of), key); }, help);
  };
  names("luminaire_ids", "luminaires", "id", "list of K");
  vectors("position_m", "luminaires", "position_m", "(K, 3), world frame.");
  vectors("position_sigma_m", "luminaires", "position_sigma_m", "(K, 3)");
  vectors("aim", "luminaires", "aim", "(K, 3), unit.");
  numbers("flux_lm", "luminaires", "flux_lm", "(K,)");
  numbers("flux_sigma_lm", "luminaires", "flux_sigma_lm", "(K,)");
  names("material_names", "materials", "name", "list of M");
  numbers("albedo", "materials", "albedo", "(M,)");
  numbers("albedo_sigma", "materials", "sigma", "(M,)");
  vectors("camera_position_m", "views", "position_m", "(V, 3), world frame.");
  names("reading_ids", "luxmeter", "id", "list of n");
  names("reading_states", "luxmeter", "state", "list of n");
  names("reading_roles", "luxmeter", "role", "fit, scale or check.");
  numbers("measured_lx", "luxmeter", "measured_lx", "(n,)");
  numbers("predicted_lx", "luxmeter", "predicted_lx", "(n,)");
  numbers("prediction_sigma_lx", "luxmeter", "prediction_sigma_lx",
          "(n,): of the prediction, model error included.");
}

void AddParameters(ResultClass& result) {
  const auto of_fit = [](auto member) { return [member](const Result& r) { return r.fit.*member; }; };
  result
      .def_property_readonly(
          "parameter_names", [](const Result& r) { return NamesOf(r.fit.parameters); },
          "Of parameters and covariance.")
      .def_property_readonly(
          "parameters", of_fit(&FitUncertainty::values),
          "(p,), as fitted: positions and sizes m, tilts rad, reflectances; logarithms where the "
          "name says so.")
      .def_property_readonly(
          "covariance", [](const Result& r) { return RowMajorXd(r.fit.covariance); },
          "(p, p) of the parameters; empty where there is none.")
      .def("illuminance", &LightOfResult, py::arg("position_m"), py::arg("normal"), py::arg("dimming"),
           "(S,): illuminance in lx at places, as predicted_lx: with bodies and colours, by the session's "
           "meter. "
           "position_m, normal (S, 3). dimming: {luminaire: 0 to 1}; the others are off.")
      .def("covariance_of", &CovarianceOf, py::arg("names"), "Covariance of these parameters alone.")
      .def(
          "position_covariance_m2",
          [](const Result& r, const std::string& id) {
            return CovarianceOf(r, {"position x of " + id, "position y of " + id, "position z of " + id});
          },
          py::arg("id"), "(3, 3) of a luminaire's estimated position.");
}

}  // namespace

void BindResult(py::module_& module) {
  ResultClass result(
      module, "Result",
      "What a fit found. Lists of dicts have the keys of result.json (docs/session-format.md); arrays are in "
      "the order of those lists, NaN where the data do not determine a number.");
  AddLists(result);
  AddColumns(result);
  AddParameters(result);
  result.def("__repr__", [](const Result& r) {
    return "<luxfit.Result of " + r.whole.value("session", "?") + ", " + r.whole.value("status", "?") + ">";
  });
  module.def(
      "read_result", &ReadResultOf, py::arg("out"),
      "The result of an earlier run: its folder, or result.json in it. Raises InputError for anything else.");
  module.def("fit", &Fit, py::arg("session"), py::arg("out"), py::kw_only(), py::arg("threads") = 0,
             py::arg("fresh") = false, py::arg("luminaires") = py::none(), py::arg("budget_s") = kFitBudgetS,
             py::arg("apply") = false,
             "As `luxfit run SESSION -o OUT`: registers the photos, observes, fits, checks; writes "
             "OUT/result.json and "
             "OUT/stages and returns the Result. session, out, luminaires: paths; luminaires: result.json of "
             "an earlier "
             "fit whose luminaires count as given. Stages of an earlier run into OUT that nothing has "
             "changed are taken "
             "over, unless fresh. apply: as --apply. Progress goes to standard error.");
  module.attr("run") = module.attr("fit");
}

}  // namespace luxfit
