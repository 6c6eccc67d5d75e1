// Holds everything that a fit of a room starts from: what was observed, and what is known beforehand.
//
// Frames: the room's world. Units: m, lx, lm. States and luminaires are indices; `dimming` says which luminaires shine in
// which state. A luminaire of which nothing is known is a KnownLuminaire with an id. A sigma of 0 fixes a quantity, a sigma
// above 0 makes a prior of it, and a value without sigma is where the search starts.
#ifndef LUXFIT_INVERSE_FIT_ROOM_OBSERVATIONS_H_
#define LUXFIT_INVERSE_FIT_ROOM_OBSERVATIONS_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/luminaire/photometry_file.h"
#include "inverse/fit/findings.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

enum class KnownPhotometry {
  kNothing,    // chosen by the fit
  kLobe,       // the luminaire's distribution; its exponent is estimated where it has one
  kTableOpen,  // a table of intensities, to be estimated; the luminaire's is the start
  kTable,      // the luminaire's table
  kFile,       // the table of `file`
};

struct KnownLuminaire {
  Luminaire luminaire;  // id, distribution, shape, size, table and emission as far as they are known
  KnownPhotometry photometry = KnownPhotometry::kNothing;
  std::string photometry_name = "auto";  // for messages: "lambertian", "downlight.ies"
  std::optional<PhotometryFile> file;
  bool shape_is_known = false;
  std::optional<Eigen::Vector3d> position_m, aim, heading;
  std::optional<double> flux_lm;
  std::optional<double> position_sigma_m, flux_sigma_lm;  // beside their values
  bool is_held = false;                                   // nothing of it is estimated
};

// One reading of the luxmeter.
struct MeterReading {
  Sensor sensor;
  int state = 0;
  double illuminance_lx = 0;  // without the ambient light; 0 where nothing was measured
  double ambient_lx = 0;      // that was subtracted
  bool used = false;          // fitted to, or for the scale; else only predicted
  int sensor_index = -1;  // of several sensors of one meter, each with a gain of its own; -1: the only one
};

struct Meter {
  std::vector<MeterReading> readings;
  int sensor_count = 0;  // that `sensor_index` names
  double common_sigma =
      0;  // relative, shared by all readings (calibration); 0: the meter's class is not known
  double sensor_sigma = 0.03;  // relative, of the gains of its sensors
};

struct RoomObservations {
  std::vector<KnownLuminaire> luminaires;
  bool luminaires_are_named = true;       // false: their number was estimated, their names mean nothing
  std::vector<Eigen::VectorXd> dimming;   // one a state, by luminaire, 0 to 1
  std::vector<Observation> observations;  // of every view (inverse/observe/observe.h)
  std::vector<SeenPlace> seen;            // where luminaires show in photos
  Meter meter;
  std::vector<std::optional<double>> albedo;  // by material of the room, where it is known; may be empty
  std::optional<double> camera_scale;         // relative luminance per cd/m2, where it is known
};

// Records what was taken from a photometric file; warns ("photometry_flux") where its intensities contradict its stated flux.
void RecordPhotometryFile(const std::string& id, const PhotometryFile& file, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_ROOM_OBSERVATIONS_H_
