// Reads a session, one TOML file and the tables that it names, and checks it; paths become absolute.
//
// Units are those of the format: m, s, lm, lx. `scene.unit` is converted to metres per mesh unit. A value
// that the file leaves out is an empty optional or an empty list, never an invented value. What the stages
// derive from a session has types of its own (apps/stages/linearize/linearized_session.h).
//
// Throws std::runtime_error("FILE:LINE: key: expected ..., got ...") for anything malformed: unknown keys
// (with the nearest known one), missing files, wrong headers, decimal commas, unknown camera, state or
// luminaire names, and duplicate ids.
//
// Source: docs/session-format.md.
#ifndef LUXFIT_APPS_SESSION_SESSION_H_
#define LUXFIT_APPS_SESSION_SESSION_H_

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/lens/lens_family.h"
#include "calib/targets/board.h"
#include "calib/targets/tags.h"
#include "forward/changes/frame_mistakes.h"
#include "forward/changes/painted_rectangles.h"
#include "forward/changes/pieces.h"
#include "forward/changes/plane_moves.h"
#include "forward/direct/sensor.h"
#include "forward/mesh/outline.h"

namespace luxfit {

struct SessionScene {
  std::string mesh;  // absolute path; empty: the room is an outline
  double metres_per_unit = 1;
  std::string unit = "m";
  std::map<std::string, Eigen::Vector3d> known_albedo_rgb;  // material name -> RGB reflectance, in [0, 1)
  int line = 0;                                             // line of [scene.albedo], else of [scene]
  std::optional<RoomOutline> outline;                       // from size or outline; m
  bool finds_furniture = true;                              // furniture = "find"
  bool names_planes = true;                                 // materials = "find"
  std::vector<std::string> neutral;                         // materials of one reflectance at all wavelengths
  std::optional<MeshMove> mesh_move;    // where the mesh is instead, as a run's corrections have it
  std::vector<RoomBox> furniture;       // found in photos (apps/stages/observe/found_furniture.h), m
  std::vector<PlaneMove> walls;         // of the mesh, which photos show elsewhere
  std::vector<PieceMove> moves;         // of the mesh's furniture, which photos show elsewhere or not at all
  std::vector<PaintedRectangle> parts;  // of walls, which photos show painted otherwise
};

struct SessionTags {
  std::string family = "tag36h11";
  std::string map_path;  // empty: no map was given
  std::vector<SurveyedTag> survey;
  double size_m = 0;  // side of every tag where there is no map; 0: not given
};

struct SessionRegistration {
  std::string method = "auto";  // tags | colmap | both | auto
  std::string colmap_model;     // absolute path of its folder; empty: none
  // Rough places of the cameras of these views in the scene's frame; empty, or three and more.
  std::map<std::string, Eigen::Vector3d> start_positions_m;
};

struct SessionCamera {
  std::string id;
  std::string intrinsics;  // absolute path; empty: calibrated from images
  std::optional<Board> board;
  std::vector<std::string> calibration_images;  // absolute paths, sorted; empty: none
  std::string response = "linear";              // linear | estimate | file
  std::string response_path;                    // absolute path of that file
  std::string vignetting = "none";              // none | estimate | file
  std::string vignetting_path;
  std::string calibration_corners;              // absolute path of a corners.vnl; empty: corners are found
  std::optional<Eigen::Array2i> image_size_px;  // where corners come without images
  double black_level_counts = 0;
  double cdm2_per_count_s = 0;  // 0: unknown
  Eigen::Vector3d luminance_weights{0.265, 0.670, 0.065};
  std::optional<Eigen::Matrix3d> xyz_from_rgb;  // given, or as the photos state it
  std::string colours;  // what tells luminance_weights: a key, or what the photos state; empty: nothing
  int line = 0;         // line of its [[camera]]
};

// Holds one row of the photo table.
struct SessionPhoto {
  std::string file;  // absolute path, checked to exist
  int camera = 0;    // index into cameras
  std::string view;
  std::string state;
  double exposure_s = 0;  // 0: the photo's own metadata states it
  std::optional<double> f_number, iso;
  int line = 0;  // in the photo table
};

// Holds luminaires that are switched together.
struct SessionGroup {
  std::string name;
  std::vector<std::string>
      luminaires;  // ids; where their number is to be estimated, the group's name stands for them
  bool count_is_estimated = false;
};

struct SessionState {
  std::string id;
  std::map<std::string, double> dimming;  // luminaire id -> 0..1; groups stand as their luminaires
};

// Describes an object under distant lights switched in turn, seen from one place: photometric stereo.
struct SessionLights {
  struct Light {
    Eigen::Vector3d to_light = Eigen::Vector3d::UnitZ();  // unit; x right, y up, z towards the camera
    double strength = 1;
  };
  std::string view, mask;       // view of the object; absolute path of its mask
  std::string directions_path;  // path of the table; empty: directions come from the mirror sphere
  std::map<std::string, Light> light_of_state;  // empty: directions come from the mirror sphere
  double direction_sigma_deg = 0;               // sigma of the directions in the table; 0: exact
  std::string mirror_view, mirror_mask;         // empty: no mirror sphere
  bool strengths_known = true;                  // all equal, or as in the table
  std::string ambient_state;                    // all lights off; empty: none
  std::string reference_mask;                   // pixels of known albedo; empty: none
  double reference_albedo = 0;
  int line = 0;
};

struct SessionLuminaire {
  std::string id;
  std::string photometry =
      "auto";  // isotropic | lambertian | cosine_power | table | auto | a file as the session has it
  std::string photometry_path;  // absolute path of that .ies or .ldt; empty: none
  std::optional<double> cosine_exponent;
  std::vector<double> gamma_deg, cd_per_klm;  // nodes of a given table; empty: to be estimated
  Eigen::ArrayXXd emission;                   // cells along the heading x across; empty: even
  std::optional<std::string> shape;           // point | disc | rectangle | sphere
  std::vector<double> size_m;
  std::optional<Eigen::Vector3d> position_m;
  std::optional<double> position_sigma_m;
  std::optional<Eigen::Vector3d> aim;      // unit
  std::optional<Eigen::Vector3d> heading;  // unit
  std::optional<double> flux_lm;
  std::optional<double> flux_sigma_lm;
  bool is_held = false;  // from an earlier fit: nothing of it is estimated
  int line = 0;          // line of its [[luminaire]]; 0: only named in [states]
};

enum class ReadingRole { kFit, kScale, kCheck };
std::string ToString(ReadingRole role);  // as in result.json

struct SessionReading {
  std::string id;
  Eigen::Vector3d position_m;
  Eigen::Vector3d normal;  // unit
  std::string state;
  bool is_measured = true;    // false: illuminance_lx is empty, to be predicted only
  double illuminance_lx = 0;  // 0 where not measured; with the ambient light
  ReadingRole role = ReadingRole::kCheck;
  std::string sensor;  // id where a meter has several sensors, each with its own gain; else empty
  int line = 0;        // in the readings table
};

struct SessionLuxmeter {
  std::string readings_path;  // empty: no [luxmeter] section
  std::vector<SessionReading> readings;
  SensorResponse response;       // for every reading
  std::string sensitivity_path;  // path of its table; empty: cosine
  std::string meter_class;       // "", L, A, B, C
  // Relative standard uncertainty that all readings share (calibration), from the class; 0 where none is
  // given.
  double common_sigma = 0;
  double sensor_sigma = 0.03;  // relative sigma of the gains of sensors that the table names
};

// Says how cameras without intrinsics are calibrated.
struct SessionCalibration {
  std::optional<LensKind> lens;    // absent: chosen
  std::string back_end = "mrcal";  // mrcal | opencv
  std::string rig = "auto";        // auto | names | numbers | order | none: how images form sets
  double focal_start_px = 0;       // 0: scanned
};
// Returns the values that `rig` may have.
std::vector<std::string> RigRules();

struct Session {
  std::string name;
  std::string path;  // absolute path of the session file
  std::optional<SessionScene> scene;
  SessionTags tags;
  SessionRegistration registration;
  std::vector<SessionCamera> cameras;
  SessionCalibration calibration;
  std::string photos_path;  // empty: no [photos] section
  std::vector<SessionPhoto> photos;
  std::vector<SessionGroup> groups;  // in file order
  std::vector<SessionState>
      states;                     // in file order; absent in the file: one state named by the tables, all on
  bool states_are_named = false;  // the file has [states]
  std::vector<SessionLuminaire>
      luminaires;  // [[luminaire]], completed by those that [groups] or [states] name, in that order
  bool count_is_estimated = false;  // there may be more luminaires than those, all on in the only state
  int max_luminaires = 0;           // 0: the file does not say
  SessionLuxmeter luxmeter;
  std::optional<SessionLights> lights;   // an object instead of a room
  std::vector<std::string> input_files;  // every file read or referred to, for hashing
};

Session ReadSession(const std::string& path);

// Adds luminaires "lamp1", "lamp2", ... until there are `count`, each on in every state.
Session WithMoreLuminaires(Session session, int count);

// Returns the names of the groups whose number of luminaires is to be estimated.
std::vector<std::string> OpenGroups(const Session& session);

// Returns the session with `count` luminaires GROUP_1, GROUP_2, ... in place of the one that stands for a group.
Session WithCountedGroup(Session session, const std::string& group, int count);

// Returns the index of the state in which the luminaire that stands for a group is on alone, the brightest of them; -1: none.
int StateOfGroupAlone(const Session& session, const std::string& group);

// Returns the index into session.states; -1 where no state has that name.
int StateIndex(const Session& session, const std::string& id);

// Returns the luminance weights of the session's first camera; those of the format where there is no camera.
Eigen::Vector3d LuminanceWeights(const Session& session);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_SESSION_H_
