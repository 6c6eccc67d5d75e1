// Writes a session file as `luxfit init` does, from what was found, with every guess marked.
#ifndef LUXFIT_APPS_SESSION_SESSION_DRAFT_H_
#define LUXFIT_APPS_SESSION_SESSION_DRAFT_H_

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "apps/session/photos/photo_names.h"
#include "apps/session/session.h"
#include "calib/luminance/exposure.h"
#include "calib/photo_files/tone_mapped.h"

namespace luxfit {

struct DraftPhoto {
  NamedPhoto name;  // file relative to the session
  ExposureMetadata exposure;
  int width_px = 0, height_px = 0;
  int bits_per_channel = 16;
  int camera = 0;
};

struct SessionDraft {
  std::string name;
  std::string mesh;  // relative to the session, as all files; empty: the room is an upright box
  // Describe the box where there is no mesh: its least corner, and what told its lengths (empty: the user).
  Eigen::Vector2d corner_m = Eigen::Vector2d::Zero();
  std::string size_because;
  std::string unit, unit_because;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  std::map<std::string, double> material_area_m2;
  std::string tags;  // empty: none
  std::string family, family_because;
  std::vector<int> seen_tags;
  std::vector<DraftPhoto> photos;
  std::string names_because;
  std::vector<GuessedState> states;
  std::map<int, std::string> intrinsics;  // by camera: a file that lies beside the photos
  int cameras = 1;
  ToneMappedFiles tone_mapped;           // relative to the session
  std::vector<SessionReading> readings;  // of the table that lies there already
};

std::string SessionText(const SessionDraft& draft);
std::string PhotoTable(const SessionDraft& draft);
std::string ReadingsTemplate();

// Returns the readings of a table that a person filled in; none of a template that nobody did. Throws std::runtime_error,
// naming file and line, for any other file.
std::vector<SessionReading> FilledReadings(const std::string& path);

// Calls the only mix of luminaires that nothing names (mix1) by the only name of a state that readings have and no photo
// has (evening). Does nothing where there are several of either.
void NameMixByReadings(SessionDraft& draft);

// Lists what is left to do before `luxfit run`, the most important first.
std::vector<std::string> ToDo(const SessionDraft& draft);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_SESSION_DRAFT_H_
