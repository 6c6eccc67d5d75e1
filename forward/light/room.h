// A room made ready for light: everything that depends on geometry alone, computed once.
//
// Receivers are the places whose illuminance is asked for: elements of the room first (in the order given),
// then sensor points. Elements gather from patches, sensors from elements, whose direct light is known in
// finer detail: patches may be coarse, as they only carry light from the second reflection on. An empty scene
// is allowed: then all light is direct.
//
// Throws as its parts do (Subdivide, ComputeFormFactors).
// Source: see forward/factors/form_factors.h and forward/radiosity/transport.h; Reichert (1992), "A two-pass radiosity method
// driven by lights and viewer position" (final gather).
#ifndef LUXFIT_FORWARD_LIGHT_ROOM_H_
#define LUXFIT_FORWARD_LIGHT_ROOM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/factors/form_factors.h"
#include "forward/luminaire/luminaire.h"
#include "forward/radiosity/sparse_transport.h"
#include "forward/radiosity/transport.h"
#include "forward/room/patches.h"
#include "forward/room/scene.h"
#include "forward/room/visibility.h"

namespace luxfit {

struct RoomOptions {
  PatchesOptions patches;
  FormFactorOptions form_factors;
  double max_matrix_bytes =
      4e9;  // of form factors and coupling; beyond it, only pairs that rays find are kept
};

struct Room {
  Scene scene;
  RayScene rays;
  Patches patches;
  FormFactors form_factors;
  TransportGeometry transport;
  // Of rooms of many patches; then form_factors and transport have no matrices, rays_per_element are those of
  // kMalley, and indirect light is the same all over a patch.
  std::shared_ptr<const SparseTransport> sparse;
};
// Facets drawn on one another are cut first (WithoutOverlaps), so `scene` may differ from the given one.
Room MakeRoom(const Scene& given, const RoomOptions& options = {});

struct Receivers {
  std::vector<int> elements;  // indices into room.patches.elements
  std::vector<Sensor> sensors;
  Eigen::SparseMatrix<float, Eigen::RowMajor> sensor_to_element;  // form factors, sensors x elements
  std::vector<Sensor> points;                                     // centre and normal of every receiver
  // Filled by PrepareGather, else empty: form factors of the receiving elements (elements x patches), and of
  // the sensors to patches by way of the elements of each material (sensors x patches).
  FormFactorMatrix element_to_patch;
  std::vector<Eigen::MatrixXf> sensor_to_patch;
  int count() const { return static_cast<int>(points.size()); }
};
Receivers MakeReceivers(const Room& room, const std::vector<int>& elements,
                        const std::vector<Sensor>& sensors, int rays_per_sensor = kSensorRays);

// For those who ask for the light at the same receivers again and again: what depends on geometry alone is
// multiplied out, so that elements which are no receivers need no indirect light. Sparse rooms stay as they
// are.
void PrepareGather(const Room& room, Receivers& receivers);

// Share of each luminaire that each place sees: elements x luminaires and receivers x luminaires, in [0, 1].
// Elements are probed at 2 x 2 points against `order` points a side of the luminaire (against 2 where those
// agree), sensors at their point.
struct LuminaireVisibility {
  Eigen::MatrixXf elements;
  Eigen::MatrixXf receivers;
};
LuminaireVisibility ComputeVisibility(const Room& room, const Receivers& receivers,
                                      const std::vector<Luminaire>& luminaires, int order = 3);
// The receivers' part alone.
LuminaireVisibility ComputeReceiverVisibility(const Room& room, const Receivers& receivers,
                                              const std::vector<Luminaire>& luminaires, int order = 3);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_ROOM_H_
