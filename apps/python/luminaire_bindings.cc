#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/stages/simulate/given_luminaire.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/suggest.h"
#include "apps/version.h"
#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/photometry_file.h"

namespace luxfit {
namespace {

namespace py = pybind11;

constexpr double kDegPerRad = 180 / M_PI;

std::runtime_error Wrong(const std::string& argument, const std::string& message) {
  return std::runtime_error("Luminaire: " + argument + ": " + message);
}

Eigen::Vector3d UnitVector(const std::string& argument, const Eigen::Vector3d& v) {
  if (!v.allFinite() || !(v.norm() > 0)) throw Wrong(argument, "expected a direction, any length but 0");
  return v.normalized();
}

Eigen::Vector3d Place(const Eigen::Vector3d& p) {
  if (!p.allFinite()) throw Wrong("position_m", "expected three finite numbers");
  return p;
}

double Flux(double flux_lm) {
  if (!std::isfinite(flux_lm) || flux_lm < 0) throw Wrong("flux_lm", "expected a number >= 0");
  return flux_lm;
}

bool IsFile(const std::string& photometry) {
  const std::string extension = std::filesystem::path(photometry).extension().string();
  return extension == ".ies" || extension == ".ldt" || extension == ".IES" || extension == ".LDT";
}

// Holds the keys of a session's [[luminaire]] that light depends on.
struct Arguments {
  std::optional<double> flux_lm, cosine_exponent;
  std::string photometry;
  std::optional<std::string> shape;
  std::vector<double> size_m, gamma_deg, cd_per_klm;
};

void Check(const Arguments& given, const Luminaire& luminaire) {
  const DistributionOps* const ops = FindDistribution(given.photometry);
  if (ops == nullptr && !IsFile(given.photometry))
    throw Wrong("photometry",
                ExpectedOneOf(PhotometryNames(), given.photometry) + ", or a file (.ies, .ldt)");
  if (!IsFile(given.photometry) && !given.flux_lm)
    throw Wrong("flux_lm", "expected a flux in lm, got None; only photometric files have one of their own");
  const bool has_exponent = given.cosine_exponent && *given.cosine_exponent > 0;
  if (ops != nullptr && ops->has_exponent && !has_exponent)
    throw Wrong("cosine_exponent", "expected a number > 0 beside photometry = " + Quoted(given.photometry));
  if (ops != nullptr && ops->has_table &&
      (given.gamma_deg.size() < 2 || given.gamma_deg.size() != given.cd_per_klm.size()))
    throw Wrong("gamma_deg, cd_per_klm", "expected two lists of one length, two entries or more");
  const std::vector<std::string> shapes = {"point", "disc", "rectangle", "sphere"};
  if (given.shape && std::count(shapes.begin(), shapes.end(), *given.shape) == 0)
    throw Wrong("shape", ExpectedOneOf(shapes, *given.shape));
  const bool is_point = luminaire.shape == LuminaireShape::kPoint;
  const bool has_size =
      luminaire.size_m[0] > 0 && (luminaire.shape != LuminaireShape::kRectangle || luminaire.size_m[1] > 0);
  if (!is_point && !has_size)
    throw Wrong("size_m", "expected lengths in m > 0: two of a rectangle, one of a disc or sphere");
}

Luminaire MakeLuminaire(const Eigen::Vector3d& position_m, const Arguments& given, const Eigen::Vector3d& aim,
                        const Eigen::Vector3d& heading, const std::string& id) {
  SessionLuminaire session;
  session.id = id;
  session.photometry = given.photometry;
  if (IsFile(given.photometry)) session.photometry_path = given.photometry;
  session.cosine_exponent = given.cosine_exponent;
  session.gamma_deg = given.gamma_deg;
  session.cd_per_klm = given.cd_per_klm;
  session.shape = given.shape;
  session.size_m = given.size_m;
  session.position_m = Place(position_m);
  session.aim = UnitVector("aim", aim);
  session.heading = UnitVector("heading", heading);
  if (given.flux_lm) session.flux_lm = Flux(*given.flux_lm);
  // A table is made of the given nodes, which are checked first.
  const DistributionOps* const ops = FindDistribution(given.photometry);
  if (ops != nullptr && ops->has_table) Check(given, Luminaire{});
  Luminaire luminaire = ReadGivenLuminaire(session).luminaire;
  Check(given, luminaire);
  return luminaire;
}

Eigen::VectorXd IntensityCd(const Luminaire& luminaire, const RowMajorXd& directions) {
  if (directions.cols() != 3) throw Wrong("directions", "expected an array of shape (n, 3)");
  const LuminaireAxes axes = AxesOf(luminaire);
  Eigen::VectorXd intensity(directions.rows());
  for (Eigen::Index i = 0; i < directions.rows(); ++i) {
    const Eigen::Vector3d direction = UnitVector("directions", directions.row(i));
    intensity[i] = luminaire.flux_lm * IntensityPerLumen(luminaire, axes, direction).cd_per_lm;
  }
  return intensity;
}

py::dict PhotometryDict(const std::filesystem::path& path) {
  PhotometryFile file = ReadPhotometry(path.string());
  // Photometry about a horizontal axis (LM-63 type B) is converted to C and gamma, which everything here
  // uses.
  if (!file.table.table_from_luminaire.isIdentity()) {
    file.table = Resampled(file.table, 5, 1);
    file.notes.emplace_back("type B photometry, interpolated every 5 degrees of C and 1 degree of gamma");
  }
  const IntensityTable& table = file.table;
  const auto planes = static_cast<Eigen::Index>(table.c_rad.size());
  const auto angles = static_cast<Eigen::Index>(table.gamma_rad.size());
  py::dict dict;
  dict["format"] = file.format;
  py::list keywords;
  for (const PhotometryKeyword& k : file.keywords)
    keywords.append(py::make_tuple(py::bytes(k.name), py::bytes(k.text)));
  dict["keywords"] = keywords;
  dict["c_deg"] = Eigen::VectorXd(kDegPerRad * Eigen::Map<const Eigen::VectorXd>(table.c_rad.data(), planes));
  dict["gamma_deg"] =
      Eigen::VectorXd(kDegPerRad * Eigen::Map<const Eigen::VectorXd>(table.gamma_rad.data(), angles));
  dict["cd_per_klm"] =
      RowMajorXd(1000 * Eigen::Map<const RowMajorXd>(table.cd_per_lm.data(), planes, angles));
  dict["flux_lm"] = file.luminaire_flux_lm;
  dict["stated_flux_lm"] = file.stated_flux_lm > 0 ? py::object(py::float_(file.stated_flux_lm)) : py::none();
  dict["lamp_flux_lm"] = file.lamp_flux_lm > 0 ? py::object(py::float_(file.lamp_flux_lm)) : py::none();
  dict["shape"] = ToString(file.shape);
  dict["size_m"] = file.size_m;
  dict["notes"] = file.notes;
  return dict;
}

void WriteFile(const std::filesystem::path& path, const Luminaire& luminaire, const std::string& test) {
  const std::string extension = path.extension().string();
  if (extension != ".ies" && extension != ".ldt")
    throw std::runtime_error(path.string() + ": expected a name ending in .ies or .ldt");
  if (!(luminaire.flux_lm > 0)) throw Wrong("flux_lm", "expected a flux above 0 to write");
  PhotometryLabels labels;
  labels.test = test;
  labels.laboratory = std::string("luxfit ") + kVersion;
  labels.manufacturer = "unknown";
  labels.catalogue_number = labels.luminaire = luminaire.id;
  const PhotometryTexts texts = WritePhotometry(luminaire, labels);
  WriteText(path.string(), extension == ".ies" ? texts.ies : texts.ldt);
}

}  // namespace

void BindLuminaire(py::module_& module) {
  py::class_<Luminaire>(
      module, "Luminaire",
      "Where a luminaire hangs and how it shines, as a [[luminaire]] of a session says it.\n\n"
      "photometry: isotropic, lambertian, cosine_power (with cosine_exponent), table (with "
      "gamma_deg and cd_per_klm, rotationally symmetric) or the path of an .ies or .ldt file, "
      "whose flux, shape and size count where none are given. aim: gamma = 0; heading: the C0 "
      "half-plane and the direction of size_m[0].")
      .def(py::init([](const Eigen::Vector3d& position_m, std::optional<double> flux_lm,
                       const std::string& photometry, const Eigen::Vector3d& aim,
                       const Eigen::Vector3d& heading, std::optional<std::string> shape,
                       std::vector<double> size_m, std::optional<double> cosine_exponent,
                       std::vector<double> gamma_deg, std::vector<double> cd_per_klm, const std::string& id) {
             const Arguments given{
                 flux_lm,           cosine_exponent,      photometry,           std::move(shape),
                 std::move(size_m), std::move(gamma_deg), std::move(cd_per_klm)};
             return MakeLuminaire(position_m, given, aim, heading, id);
           }),
           py::arg("position_m"), py::arg("flux_lm") = py::none(), py::arg("photometry") = "lambertian",
           py::kw_only(), py::arg("aim") = Eigen::Vector3d(0, 0, -1),
           py::arg("heading") = Eigen::Vector3d(1, 0, 0), py::arg("shape") = py::none(),
           py::arg("size_m") = std::vector<double>(), py::arg("cosine_exponent") = py::none(),
           py::arg("gamma_deg") = std::vector<double>(), py::arg("cd_per_klm") = std::vector<double>(),
           py::arg("id") = "")
      .def_readwrite("id", &Luminaire::id)
      .def_property(
          "position_m", [](const Luminaire& l) { return l.position; },
          [](Luminaire& l, const Eigen::Vector3d& p) { l.position = Place(p); }, "Centre, world frame, m.")
      .def_property(
          "aim", [](const Luminaire& l) { return l.aim; },
          [](Luminaire& l, const Eigen::Vector3d& v) { l.aim = UnitVector("aim", v); }, "Unit: gamma = 0.")
      .def_property(
          "heading", [](const Luminaire& l) { return AxesOf(l).along; },
          [](Luminaire& l, const Eigen::Vector3d& v) { l.heading = UnitVector("heading", v); },
          "Unit, perpendicular to aim: C0.")
      .def_property(
          "flux_lm", [](const Luminaire& l) { return l.flux_lm; },
          [](Luminaire& l, double flux_lm) { l.flux_lm = Flux(flux_lm); }, "Luminous flux, lm.")
      .def_property_readonly("photometry", [](const Luminaire& l) { return ToString(l.distribution); })
      .def_property_readonly("shape", [](const Luminaire& l) { return ToString(l.shape); })
      .def_property_readonly("size_m", [](const Luminaire& l) { return l.size_m; })
      .def("intensity_cd", &IntensityCd, py::arg("directions"),
           "Luminous intensity in cd (n,) towards world directions (n, 3) of any length but 0.")
      .def("__repr__", [](const Luminaire& l) {
        return "<luxfit.Luminaire " + l.id + " " + ToString(l.distribution) + " " + ToString(l.shape) + ", " +
               std::to_string(l.flux_lm) + " lm>";
      });
  module.def(
      "read_photometry", &PhotometryDict, py::arg("path"),
      "An .ies or .ldt file: c_deg (C,) over the whole circle, gamma_deg (G,) from the nadir, cd_per_klm "
      "(C, G) per 1000 lm of the luminaire's flux, flux_lm (the integral), stated_flux_lm and lamp_flux_lm "
      "(None where the file says none), shape, size_m along C0 and across, keywords (bytes, UTF-8) "
      "and notes.");
  module.def(
      "write_photometry", &WriteFile, py::arg("path"), py::arg("luminaire"), py::arg("test") = "",
      "Writes a luminaire's distribution, flux and opening as .ies (LM-63-2002) or .ldt, by the ending.");
}

}  // namespace luxfit
