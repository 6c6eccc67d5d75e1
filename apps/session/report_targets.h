// Reads the targets of a room's light: areas and observers of a TOML file that the user edits.
//
//   [[area]]    id, task | average_lx, uniformity, ugr, cylindrical_lx, wall_lx, ceiling_lx; height_m, polygon_m | origin_m, edge_u_m, edge_v_m;
//               margin_m, spacing_m
//   [[observer]] id, eye_m, looking; ugr
//   [report]     apps/session/report_details.h
//   [power_w]    W of luminaires by id, fully on
//   maintenance_factor
//
// A `task` is a row of EN 12464-1:2021, table 34 (offices) or 9 (traffic zones); keys beside it take
// precedence. Without a polygon or edges an area is the whole floor at height_m, less margin_m. Absent
// requirements are empty optionals: statistics are still computed, and compared with nothing.
//
// Throws std::runtime_error("FILE:LINE: key: expected X, got Y; remedy").
// Source: docs/report.md, "Targets".
#ifndef LUXFIT_APPS_SESSION_REPORT_TARGETS_H_
#define LUXFIT_APPS_SESSION_REPORT_TARGETS_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "apps/session/report_details.h"
#include "forward/views/illuminance_plane.h"

namespace luxfit {

// Holds one row of the standard.
struct LightingTask {
  std::string key, name;
  double average_lx = 0, uniformity = 0, ugr = 0;
  double cylindrical_lx = 0, wall_lx = 0, ceiling_lx = 0;  // mean, maintained; uniformity of all three 0.10
};
const std::vector<LightingTask>& LightingTasks();

struct TargetArea {
  std::string id;
  std::string task;  // key of a row; empty: none
  std::optional<double> average_lx, uniformity, ugr;
  std::optional<double> cylindrical_lx, wall_lx, ceiling_lx;
  double height_m = 0.75;
  double margin_m = kStandardMargin;
  double spacing_m = 0;                    // 0: EN 12464-1
  std::vector<Eigen::Vector2d> polygon_m;  // empty: none
  std::optional<IlluminancePlane> plane;   // from the edges, where they are given
};

struct TargetObserver {
  std::string id;
  Eigen::Vector3d eye_m;
  Eigen::Vector3d looking;  // unit
  std::optional<double> ugr;
};

struct LuminairePower {
  std::string id;
  double power_w = 0;  // fully on
  int line = 0;        // in the file
};

struct ReportTargets {
  std::string path;  // empty: the default
  ReportDetails details;
  // Maintained illuminance is this times the illuminance found; absent: only what was found is shown.
  std::optional<double> maintenance_factor;
  std::vector<LuminairePower> powers;
  std::vector<TargetArea> areas;
  std::vector<TargetObserver> observers;
};

ReportTargets ReadTargets(const std::string& path);

// Returns the default targets: the floor at 0.75 m for office work (writing, typing, reading), and seated
// observers at the middle of each of its sides. Returns nothing where the scene has no floor.
ReportTargets DefaultTargets(const Scene& scene);

// Writes the targets as a file that ReadTargets reads.
std::string TargetsToml(const ReportTargets& targets);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_REPORT_TARGETS_H_
