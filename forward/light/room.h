// Prepares a room for light: it computes once all that depends on geometry alone.
//
// Receivers are the places whose illuminance is wanted: elements of the room first (in the order given), then
// sensor points. Elements gather from patches. Sensors gather from elements, whose direct light is known in
// finer detail. Patches may thus be coarse, as they only carry light from the second reflection on. An empty
// scene is allowed: then all light is direct.
//
// Throws as its parts do (Subdivide, ComputeFormFactors).
// Source: see forward/factors/form_factors.h and forward/radiosity/transport.h; Reichert (1992), "A two-pass
// radiosity method driven by lights and viewer position" (final gather).
#ifndef LUXFIT_FORWARD_LIGHT_ROOM_H_
#define LUXFIT_FORWARD_LIGHT_ROOM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/factors/form_factors.h"
#include "forward/luminaire/luminaire.h"
#include "forward/mesh/planes.h"
#include "forward/radiosity/transport.h"
#include "forward/room/patches.h"
#include "forward/room/scene.h"
#include "forward/room/visibility.h"

namespace luxfit {

class SparseTransport;

struct RoomOptions {
  PatchesOptions patches;
  FormFactorOptions form_factors;
  double max_matrix_bytes =
      4e9;  // bytes of form factors and coupling; beyond it, only pairs that rays find are kept
  std::optional<PlanesOptions> planes = std::nullopt;  // lays a mesh that is finer than patches onto planes
};

struct Room {
  Scene scene;
  RayScene rays;
  Patches patches;
  FormFactors form_factors;
  TransportGeometry transport;
  // Set in rooms of many patches. There form_factors and transport have no matrices, rays_per_element are
  // those of kMalley, and indirect light is the same all over a patch.
  std::shared_ptr<const SparseTransport> sparse;
  std::optional<LaidOnPlanes> on_planes;  // how the given mesh became `scene`
  // The same elements with patches about twice as large, for callers that exchange light often; null: they would be
  // hardly fewer. See internal/clustered_room.h.
  std::shared_ptr<const Room> clusters;
};
// Makes a room. A mesh finer than patches is laid onto planes first where the options ask for it (LayOnPlanes); of any
// other, facets drawn on one another are cut (WithoutOverlaps), and planes of one material are named where the options ask
// for it (WithPlanesNamed). So `scene` may differ from the given one.
Room MakeRoom(const Scene& given, const RoomOptions& options = {});

struct Receivers {
  std::vector<int> elements;  // indices into room.patches.elements
  std::vector<Sensor> sensors;
  Eigen::SparseMatrix<float, Eigen::RowMajor> sensor_to_element;  // form factors, sensors x elements
  std::vector<Sensor> points;                                     // centre and normal of every receiver
  // PrepareGather fills these; else they are empty. They are the form factors of the receiving elements
  // (elements x patches), and of the sensors to patches by way of the elements of each material (sensors x
  // patches).
  FormFactorMatrix element_to_patch;
  std::vector<Eigen::MatrixXf> sensor_to_patch;
  int count() const { return static_cast<int>(points.size()); }
};
Receivers MakeReceivers(const Room& room, const std::vector<int>& elements,
                        const std::vector<Sensor>& sensors, int rays_per_sensor = kSensorRays);

// Multiplies out what depends on geometry alone, for callers that need the light at the same receivers
// repeatedly. Elements that are no receivers then need no indirect light. Sparse rooms stay as they are.
void PrepareGather(const Room& room, Receivers& receivers);

// Holds the share of each luminaire that each place sees: elements x luminaires and receivers x luminaires,
// in [0, 1]. Elements are probed at 4 x 4 points against `order` points a side of the luminaire (at their corners
// against 2 a side where those agree), sensors at their point.
struct LuminaireVisibility {
  Eigen::MatrixXf elements;
  Eigen::MatrixXf receivers;
};
LuminaireVisibility ComputeVisibility(const Room& room, const Receivers& receivers,
                                      const std::vector<Luminaire>& luminaires, int order = 3);
// Computes the columns of `which` luminaires anew, for the others have not moved.
void UpdateVisibility(const Room& room, const Receivers& receivers, const std::vector<Luminaire>& luminaires,
                      int order, const std::vector<int>& which, LuminaireVisibility& visibility);
// Gives the receivers the rows of `visibility.elements`, and computes those of sensors.
void FillReceivers(const Room& room, const Receivers& receivers, const std::vector<Luminaire>& luminaires,
                   LuminaireVisibility& visibility);
// Computes the receivers' part alone.
LuminaireVisibility ComputeReceiverVisibility(const Room& room, const Receivers& receivers,
                                              const std::vector<Luminaire>& luminaires, int order = 3);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_ROOM_H_
