#include "inverse/check/internal/misreading.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace luxfit {
namespace {

using Change = std::function<Sensor(const Sensor&)>;

Misreading OfPlaces(const std::string& as_if, const std::string& remedy, Change change) {
  return {{{as_if, std::move(change)}}, remedy};
}

struct Axes {
  bool exchanged, mirrors_x, mirrors_y;
  std::string_view as_if;
};

// The symmetries of a rectangle, but for that which changes nothing.
constexpr Axes kAxes[] = {
    {true, false, false, "x and y were exchanged"},
    {false, true, false, "x was counted from the opposite wall"},
    {false, false, true, "y was counted from the opposite wall"},
    {false, true, true, "x and y were counted from the opposite corner"},
    {true, true, false,
     "the axes were turned by 90 degrees: the given y is counted along x, from the opposite wall"},
    {true, false, true,
     "the axes were turned by 90 degrees: the given x is counted along y, from the opposite wall"},
    {true, true, true, "x and y were exchanged and counted from the opposite corner"},
};

Sensor WithAxes(const Axes& axes, const Eigen::AlignedBox3d& bounds, Sensor sensor) {
  for (Eigen::Vector3d* v : {&sensor.position, &sensor.normal})
    if (axes.exchanged) std::swap(v->x(), v->y());
  for (const int axis : {0, 1}) {
    if (!(axis == 0 ? axes.mirrors_x : axes.mirrors_y)) continue;
    sensor.position[axis] = bounds.min()[axis] + bounds.max()[axis] - sensor.position[axis];
    sensor.normal[axis] *= -1;
  }
  return sensor;
}

void AddAxes(const Eigen::AlignedBox3d& bounds, std::vector<Misreading>& misreadings) {
  for (const Axes& axes : kAxes)
    misreadings.push_back(OfPlaces(std::string(axes.as_if),
                                   "compare x_m and y_m of the readings with the axes of the mesh",
                                   [&axes, bounds](const Sensor& s) { return WithAxes(axes, bounds, s); }));
}

void AddUnits(std::vector<Misreading>& misreadings) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}, {"in", 0.0254}};
  for (const auto& [unit, metres] : kUnits) {
    misreadings.push_back(OfPlaces(fmt::format("their places were in {}", unit),
                                   "write x_m, y_m and z_m of the readings in metres",
                                   [metres = metres](Sensor s) {
                                     s.position *= metres;
                                     return s;
                                   }));
    misreadings.push_back(OfPlaces(fmt::format("their heights were in {}", unit),
                                   "write z_m of the readings in metres", [metres = metres](Sensor s) {
                                     s.position.z() *= metres;
                                     return s;
                                   }));
  }
}

void AddHeights(const ExplainingLight& light, std::vector<Misreading>& misreadings) {
  misreadings.push_back(OfPlaces("the meter lay on top of what stands at each place",
                                 "write the height above the floor as z_m of the readings",
                                 [top_m = light.top_m](Sensor s) {
                                   constexpr double kAboveM = 1e-3;
                                   s.position.z() = top_m(s.position.x(), s.position.y()) + kAboveM;
                                   return s;
                                 }));
  constexpr double kStepM = 0.05;
  constexpr int kSteps = 24;  // to 1.2 m: the height of a table or of a held meter
  Misreading shifted{{}, "measure z_m of the readings again, from the mesh's floor"};
  for (int i = -kSteps; i <= kSteps; ++i) {
    if (i == 0) continue;
    const double by_m = i * kStepM;
    shifted.ways.push_back(
        {fmt::format("the meter was {:.2f} m {}", std::abs(by_m), by_m > 0 ? "higher" : "lower"),
         [by_m](Sensor s) {
           s.position.z() += by_m;
           return s;
         }});
  }
  misreadings.push_back(std::move(shifted));
}

// All readings with the head tilted alike: a meter that does not lie flat, or is held by its lower edge.
void AddTilts(std::vector<Misreading>& misreadings) {
  constexpr double kDegrees = M_PI / 180;
  Misreading tilted{{}, "level the meter's head, or give nx, ny and nz as it faced"};
  for (const int tilt_deg : {3, 5, 8, 12}) {
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 45) {
      const Eigen::Vector3d towards(std::cos(azimuth_deg * kDegrees), std::sin(azimuth_deg * kDegrees), 0);
      const Eigen::AngleAxisd turn(tilt_deg * kDegrees, Eigen::Vector3d::UnitZ().cross(towards));
      tilted.ways.push_back(
          {fmt::format("the meter's head was tilted by about {} degrees towards ({:.0f}, {:.0f})", tilt_deg,
                       std::round(towards.x()) + 0.0, std::round(towards.y()) + 0.0),
           [turn](Sensor s) {
             s.normal = turn * s.normal;
             return s;
           }});
    }
  }
  misreadings.push_back(std::move(tilted));
}

void AddStates(const std::vector<std::string>& states, std::vector<Misreading>& misreadings) {
  const int count = static_cast<int>(states.size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      const std::string &of_a = states[static_cast<size_t>(a)], &of_b = states[static_cast<size_t>(b)];
      misreadings.push_back(
          {{{fmt::format("the readings of states {} and {} were written for each other", of_a, of_b),
             {},
             {a, b}}},
           fmt::format("exchange {} and {} in the table of readings, or in [states]", of_a, of_b)});
    }
  }
}

}  // namespace

std::vector<Misreading> Misreadings(const ExplainingLight& light) {
  std::vector<Misreading> misreadings;
  AddAxes(light.bounds, misreadings);
  misreadings.push_back(
      OfPlaces("the meter faced the other way",
               "turn nx, ny and nz of the readings round: they point to where the meter faces", [](Sensor s) {
                 s.normal *= -1;
                 return s;
               }));
  AddUnits(misreadings);
  AddHeights(light, misreadings);
  AddTilts(misreadings);
  AddStates(light.states, misreadings);
  if (light.scale != ScaleSource::kNone)
    misreadings.push_back({{{"", {}}}, "read them again, in lx, and see the range of the meter", true});
  return misreadings;
}

}  // namespace luxfit
