// Holds what the linearize stage derives from a session. The session itself stays as the user wrote it.
//
// Photos are one for each view, state and camera. Readings are without the light of the all-off state.
#ifndef LUXFIT_APPS_STAGES_LINEARIZE_LINEARIZED_SESSION_H_
#define LUXFIT_APPS_STAGES_LINEARIZE_LINEARIZED_SESSION_H_

#include <optional>
#include <string>
#include <vector>

#include "apps/session/session.h"
#include "calib/luminance/response.h"
#include "calib/luminance/vignetting.h"

namespace luxfit {

// Holds one file of a bracket.
struct PhotoExposure {
  std::string file;
  // exposure_s * (iso / iso of the camera's first photo) * (f-number of that / f-number)^2, as corrected.
  double relative_exposure_s = 0;
  int line = 0;  // in the photo table
  std::optional<double> cut_off_counts =
      {};  // below full scale; photos at it are saturated (calib/luminance/cut_off.h)
};

struct LinearizedPhoto {
  std::string file;  // of the longest exposure as stated; it names the photo
  int camera = 0;    // index into cameras
  std::string view;
  std::string state;
  double exposure_s = 0;               // of its first row in the photo table
  std::vector<PhotoExposure> bracket;  // the longest exposure first
};

struct LinearizedCamera {
  SessionCamera given;
  std::optional<CameraResponse> response;  // absent: linear
  std::optional<Vignetting> vignetting;    // from a flat field; absent: V = 1, or estimated from surfaces
  double full_scale_counts = 65535;        // counts of its photos, above black for RAW

  // Returns k of L = k Y (inverse/observe/room_photos.h), cd/m2; empty where it is not stated.
  std::optional<double> Cdm2PerUnit() const {
    if (!(given.cdm2_per_count_s > 0)) return std::nullopt;
    return given.cdm2_per_count_s * (full_scale_counts - given.black_level_counts);
  }
};

struct LinearizedPhotos {
  std::vector<LinearizedCamera> cameras;  // in the session's order
  std::vector<LinearizedPhoto> photos;    // in the order of their first rows
};

// Holds a reading as the light of the luminaires alone.
struct LuminaireReading {
  SessionReading given;
  double illuminance_lx = 0;  // without ambient_lx; means nothing where not measured
  double ambient_lx = 0;      // measured there with all luminaires off
  bool is_outside = false;    // not in the room of the mesh: not used, and not predicted
};

struct LinearizedSession {
  LinearizedPhotos photos;
  std::vector<LuminaireReading> readings;  // without those of the all-off state
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_LINEARIZE_LINEARIZED_SESSION_H_
