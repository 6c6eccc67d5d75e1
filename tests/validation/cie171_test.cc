// The analytical cases of CIE 171:2006, "Test cases to assess the accuracy of lighting computer programs",
// that are about electric light: 5.2, 5.3, 5.6, 5.7 and 5.8, every row of cie171_refs.csv.
//
// Two steps a case. First the geometry, which the table does not give, is shown to be right: closed forms of
// this file's own (tests/support/closed_forms.h) give every value to its printed digits. Then the engine,
// from a mesh or a luminaire on, is held to 0.5 % of it. Points lie in the middle of the room (x = 2 m of 4),
// positions in fixtures/forward_reference/README.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "forward/direct/direct_light.h"
#include "forward/factors/internal/polygon_factor.h"
#include "forward/light/illuminance.h"
#include "forward/light/room.h"
#include "tests/paths.h"
#include "tests/support/closed_forms.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using Values = std::map<std::string, double>;  // by point
using Sensors = std::map<std::string, Sensor>;
using support::kPi;

enum class Column { kExact = 3, kPublished = 4 };

// A case's rows; their text, for its digits.
std::map<std::string, std::string> ReadCase(const std::string& test, Column column) {
  std::ifstream file(LUXFIT_FIXTURES "/forward_reference/cie171_refs.csv");
  std::map<std::string, std::string> values;
  for (std::string line; std::getline(file, line);) {
    std::istringstream text(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    if (cells.at(0) == test) values[cells.at(1)] = cells.at(static_cast<size_t>(column));
  }
  return values;
}

double HalfOfTheLastDigit(const std::string& number) {
  const size_t point = number.find('.');
  return 0.5 * std::pow(10, point == std::string::npos ? 0 : -static_cast<double>(number.size() - point - 1));
}

void ExpectGeometry(const std::string& test, Column column, const Values& closed_form) {
  const std::map<std::string, std::string> rows = ReadCase(test, column);
  ASSERT_EQ(rows.size(), closed_form.size()) << test;
  for (const auto& [point, text] : rows) {
    // 1e-9: a value that ends in 5 may round either way.
    EXPECT_NEAR(closed_form.at(point), std::stod(text), HalfOfTheLastDigit(text) + 1e-9)
        << test << " " << point;
  }
}

void ExpectWithinHalfAPercent(const std::string& test, const char* path, const Values& ours) {
  const std::map<std::string, std::string> rows = ReadCase(test, Column::kExact);
  ASSERT_EQ(rows.size(), ours.size()) << test;
  std::printf("CIE 171 case %s, %s\n  %-9s %10s %10s %10s\n", test.c_str(), path, "point", "exact", "ours",
              "difference");
  for (const auto& [point, text] : rows) {
    const double exact = std::stod(text), value = ours.at(point);
    if (exact == 0) {
      std::printf("  %-9s %10.3f %10.3f\n", point.c_str(), exact, value);
      EXPECT_NEAR(value, 0, HalfOfTheLastDigit(text)) << test << " " << point;
      continue;
    }
    std::printf("  %-9s %10.3f %10.3f %+8.3f %%\n", point.c_str(), exact, value, 100 * (value / exact - 1));
    EXPECT_NEAR(value / exact, 1, 0.005) << test << " " << point << ", " << path;
  }
}

// Names from `first` on, at the places (x, y, z) of step `step`.
void AddLine(Sensors& sensors, char first, int count, const Eigen::Vector3d& from,
             const Eigen::Vector3d& step, const Eigen::Vector3d& normal) {
  for (int i = 0; i < count; ++i)
    sensors[std::string(1, static_cast<char>(first + i))] = {from + i * step, normal};
}

std::vector<Sensor> ListOf(const Sensors& sensors) {
  std::vector<Sensor> list;
  for (const auto& [name, sensor] : sensors) list.push_back(sensor);
  return list;
}

Values Named(const Sensors& sensors, const Eigen::VectorXd& values) {
  Values named;
  for (const auto& [name, sensor] : sensors) named[name] = values[static_cast<Eigen::Index>(named.size())];
  return named;
}

Values TotalLx(const Scene& scene, const Sensors& sensors, const Luminaire& luminaire) {
  const Room room = MakeRoom(scene);
  const Receivers receivers = MakeReceivers(room, {}, ListOf(sensors));
  const LuminaireVisibility visibility = ComputeVisibility(room, receivers, {luminaire});
  const Eigen::VectorXd black = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(scene.materials.size()));
  const Illuminance light = ComputeIlluminance(room, receivers, visibility, {luminaire}, black);
  return Named(sensors, luminaire.flux_lm * light.total.col(0).cast<double>());
}

constexpr double kRoomM = 4, kHeightM = 3;
constexpr double kLambertianLm = 1000 * kPi;  // I_0 = 1000 cd

TEST(Cie171, Case52PointLightSource) {
  Sensors sensors;
  const Eigen::Vector3d up(0, 0, 1), step(0.5, 0, 0);
  AddLine(sensors, 'A', 4, {0, 0, 0}, step, up);
  AddLine(sensors, 'E', 3, {0.5, 0.5, 0}, step, up);
  AddLine(sensors, 'H', 2, {1, 1, 0}, step, up);
  AddLine(sensors, 'J', 1, {1.5, 1.5, 0}, step, up);
  Luminaire luminaire;
  luminaire.position = {0, 0, kHeightM};
  luminaire.flux_lm = kLambertianLm;
  Values closed_form;
  for (const auto& [name, sensor] : sensors)
    closed_form[name] =
        support::PointLx(kLambertianLm, support::LambertianCdPerLm, luminaire.position, sensor.position);
  ExpectGeometry("5.2", Column::kExact, closed_form);
  ExpectWithinHalfAPercent("5.2", "a point luminaire, no scene", TotalLx({}, sensors, luminaire));
}

// A luminous square of 1 m in the middle of the ceiling.
TEST(Cie171, Case53AreaLightSource) {
  Sensors sensors;
  AddLine(sensors, 'A', 6, {2, 0, 2.75}, {0, 0, -0.5}, {0, 1, 0});
  AddLine(sensors, 'G', 8, {2, 0.25, 0}, {0, 0.5, 0}, {0, 0, 1});
  Luminaire luminaire;
  luminaire.position = {2, 2, kHeightM};
  luminaire.shape = LuminaireShape::kRectangle;
  luminaire.size_m = {1, 1};
  luminaire.flux_lm = kLambertianLm;
  Values closed_form;
  for (const auto& [name, sensor] : sensors) {
    const double below_m = kHeightM - sensor.position.z();
    closed_form[name] = sensor.normal.z() > 0 ? support::LambertianRectangleLx(
                                                    kLambertianLm, luminaire.position, 1, 1, sensor.position)
                                              : kLambertianLm * 2 *
                                                    (support::PerpendicularCornerFactor(2.5, 0.5, below_m) -
                                                     support::PerpendicularCornerFactor(1.5, 0.5, below_m));
  }
  ExpectGeometry("5.3", Column::kExact, closed_form);
  ExpectWithinHalfAPercent("5.3", "a rectangle in the ceiling of a black room",
                           TotalLx(support::ClosedRoom({kRoomM, kRoomM, kHeightM}), sensors, luminaire));
}

// Rows of form factors of every sensor (sensors x elements).
FormFactorMatrix RowsOf(const Room& room, const Sensors& sensors, int ray_count) {
  FormFactorMatrix rows(static_cast<Eigen::Index>(sensors.size()),
                        static_cast<Eigen::Index>(room.patches.elements.size()));
  Eigen::Index row = 0;
  for (const auto& [name, sensor] : sensors)
    rows.row(row++) = SensorFormFactors(room.rays, room.patches, sensor, ray_count);
  return rows;
}

// Per cent of a surface's exitance that reaches each sensor: by its row of form factors, and by the solution
// of a room in which that surface alone reflects and is lit evenly.
//
// Rays through equal cells err only in the cells that an edge crosses: some sqrt(N) of N, each off by half a
// cell at random, so about 0.5 N^-0.75 of the hemisphere an edge. With two edges and the default 2^14 rays
// that is 0.05 of the per cents in the table (three standard deviations: 0.15), which is 1.6 % of the least
// value here; with 2^20 rays it is 0.07 % of it: what the 0.5 % are asked of.
void ExpectFromLitSurface(const std::string& test, const Scene& scene, const std::string& lit_material,
                          const Sensors& sensors) {
  constexpr double kReflectance = 0.6, kDefaultRaysPercent = 0.15;
  constexpr int kManyRays = 1 << 20;
  const Room room = MakeRoom(scene);
  const Eigen::Index material =
      std::find(room.scene.materials.begin(), room.scene.materials.end(), lit_material) -
      room.scene.materials.begin();
  Eigen::MatrixXf lit(static_cast<Eigen::Index>(room.patches.patches.size()), 1);
  for (Eigen::Index p = 0; p < lit.rows(); ++p)
    lit(p, 0) = room.patches.patches[static_cast<size_t>(p)].material == material ? 1 : 0;
  const FormFactorMatrix rows = RowsOf(room, sensors, kManyRays);
  const auto at_elements = [&](const Eigen::MatrixXf& of_patches) {
    Eigen::VectorXf values(static_cast<Eigen::Index>(room.patches.elements.size()));
    for (Eigen::Index e = 0; e < values.size(); ++e)
      values[e] = of_patches(room.patches.elements[static_cast<size_t>(e)].patch, 0);
    return values;
  };
  const Values by_rows = Named(sensors, 100 * (rows * at_elements(lit)).cast<double>());
  ExpectWithinHalfAPercent(test, "the sensors' rows of form factors", by_rows);
  Eigen::VectorXd albedo = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(room.scene.materials.size()));
  albedo[material] = kReflectance;
  const Eigen::MatrixXf exitance = Transport(room.transport, albedo).Exitance(lit);
  ExpectWithinHalfAPercent(
      test, "the solved room",
      Named(sensors, 100 / kReflectance * (rows * at_elements(exitance)).cast<double>()));
  const Receivers receivers = MakeReceivers(room, {}, ListOf(sensors));
  for (const auto& [point, percent] :
       Named(sensors, 100 * (receivers.sensor_to_element * at_elements(lit)).cast<double>()))
    EXPECT_NEAR(percent, by_rows.at(point), kDefaultRaysPercent) << test << " " << point << ", default rays";
}

TEST(Cie171, Case56ReflectionOverADiffuseSurface) {
  Sensors sensors;
  AddLine(sensors, 'A', 6, {2, 0, 0.25}, {0, 0, 0.5}, {0, 1, 0});
  AddLine(sensors, 'G', 4, {2, 0.25, kHeightM}, {0, 0.5, 0}, {0, 0, -1});
  const Scene scene =
      support::ClosedRoom({kRoomM, kRoomM, kHeightM}, {"wall", "wall", "wall", "wall", "floor", "wall"});
  const ConvexPolygon floor =
      MakePolygon({0, 0, 0}, {kRoomM, 0, 0}, {0, kRoomM, 0}, FacetKind::kParallelogram);
  Values closed_form, polygon;
  for (const auto& [name, sensor] : sensors) {
    const double z = sensor.position.z(), y = sensor.position.y();
    const double factor = y == 0 ? support::PerpendicularCornerFactor(kRoomM, 2, z)
                                 : support::CornerFactor(y, 2, z) + support::CornerFactor(kRoomM - y, 2, z);
    closed_form[name] = 100 * 2 * factor;
    polygon[name] = 100 * PointToPolygon(sensor.position, sensor.normal, floor);
  }
  ExpectGeometry("5.6", Column::kExact, closed_form);
  ExpectWithinHalfAPercent("5.6", "PointToPolygon", polygon);
  ExpectFromLitSurface("5.6", scene, "floor", sensors);
}

// Height on the wall y = 4 m up to which a box of 1 m height, from y = 2.5 to 2.7 m and as wide as the room,
// hides it from (y, z).
double HiddenUpTo(double y, double z) {
  double hidden_m = 0;
  for (const double edge_m : {2.5, 2.7})
    hidden_m = std::max(hidden_m, z + (1 - z) * (kRoomM - y) / (edge_m - y));
  return std::min(hidden_m, kHeightM);
}

TEST(Cie171, Case57InternalObstruction) {
  Sensors sensors;
  AddLine(sensors, 'A', 6, {2, 0, 2.75}, {0, 0, -0.5}, {0, 1, 0});
  AddLine(sensors, 'G', 5, {2, 0.25, 0}, {0, 0.5, 0}, {0, 0, 1});
  Scene scene =
      support::ClosedRoom({kRoomM, kRoomM, kHeightM}, {"wall", "wall", "wall", "lit", "wall", "wall"});
  support::AddBox(scene, {Eigen::Vector3d(0, 2.5, 0), Eigen::Vector3d(kRoomM, 2.7, 1)},
                  support::Facing::kOutward, {"box"});
  Values closed_form;
  for (const auto& [name, sensor] : sensors) {
    const double y = sensor.position.y(), z = sensor.position.z(), hidden_m = HiddenUpTo(y, z);
    const double factor = y == 0 ? support::CornerFactor(2, kHeightM - z, kRoomM) -
                                       support::CornerFactor(2, hidden_m - z, kRoomM)
                                 : support::PerpendicularCornerFactor(kHeightM, 2, kRoomM - y) -
                                       support::PerpendicularCornerFactor(hidden_m, 2, kRoomM - y);
    closed_form[name] = 100 * 2 * factor;
  }
  // The column `exact` of this case was integrated on a grid (B 16.333 for 16.330): its digits are not all
  // right.
  ExpectGeometry("5.7", Column::kPublished, closed_form);
  ExpectFromLitSurface("5.7", scene, "lit", sensors);
}

// A cube of 4 m and an isotropic luminaire in its middle: the area mean of the indirect illuminance is
// rho Phi / (A (1 - rho)).
TEST(Cie171, Case58InternalReflectedComponent) {
  constexpr double kFluxLm = 10000, kAreaM2 = 96;
  const Room room = MakeRoom(support::ClosedRoom({4, 4, 4}));
  Luminaire luminaire;
  luminaire.position = {2, 2, 2};
  luminaire.distribution = Distribution::kIsotropic;
  std::vector<int> elements(room.patches.elements.size());
  for (size_t e = 0; e < elements.size(); ++e) elements[e] = static_cast<int>(e);
  const Receivers receivers = MakeReceivers(room, elements, {});
  const LuminaireVisibility visibility = ComputeVisibility(room, receivers, {luminaire});
  Values closed_form, ours;
  for (const auto& [point, text] : ReadCase("5.8", Column::kExact)) {
    const double rho = std::stod(point.substr(std::string("rho=").size()));
    closed_form[point] = rho * kFluxLm / (kAreaM2 * (1 - rho));
    const Illuminance light =
        ComputeIlluminance(room, receivers, visibility, {luminaire}, Eigen::VectorXd::Constant(1, rho));
    double indirect_lm = 0;
    for (size_t e = 0; e < elements.size(); ++e) {
      const Eigen::Index row = static_cast<Eigen::Index>(e);
      indirect_lm += room.patches.elements[e].area_m2 * (light.total(row, 0) - light.direct(row, 0));
    }
    ours[point] = kFluxLm * indirect_lm / kAreaM2;
  }
  ExpectGeometry("5.8", Column::kExact, closed_form);
  ExpectWithinHalfAPercent("5.8", "MakeRoom and ComputeIlluminance", ours);
}

}  // namespace
}  // namespace luxfit
