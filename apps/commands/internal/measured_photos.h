// Gives the photos of a session or of a finished run as measured luminance, for commands that read values from them.
//
//   L = k Y,   k: cd/m2 per unit of relative luminance
//
// A session's k is cdm2_per_count_s of each camera; a run's is that of its fit, with the exposures, the gains and the
// vignetting that the run found. The relative sigma of a run's k is that of the fit and of its light model:
//
//   (sigma_k / k)^2 = var(ln c) + model^2
//
// Throws std::runtime_error naming file or flag: neither a session nor a run, no photos, no folder for the results.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_MEASURED_PHOTOS_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_MEASURED_PHOTOS_H_

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

// Holds what commands on measured photos take.
struct MeasuredInput {
  std::string input;                  // session.toml, or the folder of a run or its result.json
  std::string session;                // of a run whose session has moved
  std::string out;                    // folder of the results; empty: that of the run
  std::string command_line;           // as typed, for the artifacts
  std::optional<double> scale_sigma;  // relative sigma of k, in place of the run's
  bool json = false;                  // print the result as JSON on standard output
};

struct LuminanceScale {
  double cdm2_per_unit = 0;
  std::optional<double> relative_sigma;  // empty: not known
};

struct MeasuredPhotos {
  LinearizedPhotos photos;
  std::vector<std::string> names;  // VIEW_STATE of each photo
  RegisteredSession registered;    // cameras, and poses where they are known
  PhotoCorrections corrections;
  std::vector<std::optional<LuminanceScale>> scale;  // by camera; empty: relative

  // Returns the index of a photo by its name, or by that of one of its files, with or without the ending. Throws
  // std::runtime_error that begins with `where`.
  size_t IndexOf(const std::string& name, const std::string& where) const;
  const std::optional<LuminanceScale>& ScaleOf(size_t photo) const;
  // Returns the rotation that turns directions of the photo's camera so that z is up: by its pose, or, where that is
  // unknown or looks nearly straight up or down, as if the camera were held upright and level.
  Eigen::Matrix3d LevelFromCamera(size_t photo) const;
  // Reads a photo with the variance of its pixels.
  LuminanceImage Read(size_t photo) const;
};

// Directions of pixels need the lens and the pose; counts do not.
enum class LensNeed { kNone, kDirections };

// `context` becomes that of the command.
MeasuredPhotos ReadMeasuredPhotos(const MeasuredInput& input, LensNeed need, RunContext& context);

// Returns the value, or null where it is not known.
nlohmann::json OrNull(const std::optional<double>& value);

// Adds the warning "scale_undetermined": `what` has no absolute scale.
void AddNoScale(const std::string& what, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_MEASURED_PHOTOS_H_
