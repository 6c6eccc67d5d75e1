// Reads a lighting design: luminaires as in a session, their power, and points with the light they need.
//
//   [[luminaire]]   as in a session; position_m, photometry and a flux must be given
//   [power_w]       W by luminaire, fully on; without it power goes with the flux, at 100 lm/W
//   [[point]]       id, illuminance_lx; position_m and normal, or the id of a place of the luxmeter
//
// Throws std::runtime_error("FILE:LINE: key: expected X, got Y; remedy").
// Source: docs/commands.md.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_DESIGN_FILE_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_DESIGN_FILE_H_

#include <map>
#include <string>
#include <vector>

#include "apps/session/session.h"
#include "forward/direct/sensor.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

struct DesignPoint {
  std::string id;
  Sensor sensor;
  double illuminance_lx = 0;
};

struct LightingDesign {
  std::vector<Luminaire> luminaires;
  std::map<std::string, double> power_w;  // by id
  std::vector<DesignPoint> points;
};

// `session` gives the luxmeter's places.
LightingDesign ReadDesign(const std::string& path, const Session& session);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_DESIGN_FILE_H_
