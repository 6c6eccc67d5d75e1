// Holds everything that a fit of a room starts from: the observations and the prior knowledge.
//
// Frame: the room's world. Units: m, lx, lm. States and luminaires are indices; `dimming` says which
// luminaires shine in which state. A luminaire of which nothing is known is a KnownLuminaire with an id.
//
// A sigma of 0 fixes a quantity. A sigma above 0 makes the value a prior. A value without a sigma is the
// start of the search.
#ifndef LUXFIT_INVERSE_FIT_ROOM_OBSERVATIONS_H_
#define LUXFIT_INVERSE_FIT_ROOM_OBSERVATIONS_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/luminaire/photometry_file.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/seen_luminaires.h"
#include "inverse/observe/watchers.h"

namespace luxfit {

struct Findings;  // inverse/fit/fit_room.h

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
  std::optional<double> position_sigma_m, flux_sigma_lm;  // each belongs to the value of its name
  bool is_held = false;                                   // true: nothing of it is estimated
};

// Holds one reading of the luxmeter.
struct MeterReading {
  Sensor sensor;
  int state = 0;
  double illuminance_lx = 0;  // without the ambient light; 0 where nothing was measured
  double ambient_lx = 0;      // already subtracted from illuminance_lx
  bool used = false;          // for the fit or the scale; false: only predicted
  int sensor_index = -1;  // one of several sensors of a meter, each with its own gain; -1: the only sensor
};

struct Meter {
  std::vector<MeterReading> readings;
  int sensor_count = 0;        // number of sensors that `sensor_index` names
  double common_sigma = 0;     // relative, of the calibration that all readings share; 0: unknown meter class
  double sensor_sigma = 0.03;  // relative, of the gains of its sensors
};

struct RoomObservations {
  std::vector<KnownLuminaire> luminaires;
  bool luminaires_are_named = true;       // false: their number was estimated and their names mean nothing
  std::vector<Eigen::VectorXd> dimming;   // one vector per state, by luminaire, 0 to 1
  std::vector<Observation> observations;  // all views (inverse/observe/observe.h)
  std::vector<SeenPlace> seen;            // where luminaires show in photos
  std::vector<SeenOutline> outlines;      // how they show there
  std::vector<Watcher> views;             // from where photos would show them
  // Covers the views that SeenOutline::view numbers, 6 rows and columns each: rotation vector in world axes (rad), camera
  // centre in world (m) (calib/register/registration.h). Empty: poses are exact.
  Eigen::MatrixXd pose_covariance;
  // Relative standard deviation of the ambient light that was subtracted, from photo to photo (AmbientLight::spread).
  double ambient_spread = 0;
  Meter meter;
  std::vector<std::optional<double>> albedo;  // by material, where known; may be empty
  std::optional<double> camera_scale;         // relative luminance per cd/m2, where known
  // Weigh red, green and blue in the relative luminance, and sum to 1.
  Eigen::Vector3d luminance_weights{0.265, 0.670, 0.065};
  bool luminance_weights_are_assumed = false;  // true: nothing tells the camera's colours
  bool channels_are_of_sensor = false;         // true: not balanced for white, as RAW has them
  std::vector<int> neutral;                    // materials that reflect red, green and blue alike
};

// Records what was taken from a photometric file. Warns ("photometry_changed") of each of its light_notes, once for all
// luminaires of one file. Warns ("photometry_flux") where its intensities contradict
// its stated flux or, where it states none, that of its lamps: more than 1.1 times it, or less than a tenth.
void RecordPhotometryFile(const std::string& id, const PhotometryFile& file, Findings& findings);

// Warns ("photometry_tilt") where the luminaire's flux, taken from the file, depends on its tilt (LM-63, TILT): which
// factor applies, or that the file of factors is missing.
void WarnOfTilt(const Luminaire& luminaire, const PhotometryFile& file, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_ROOM_OBSERVATIONS_H_
