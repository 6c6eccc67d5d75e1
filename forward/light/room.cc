#include "forward/light/room.h"

#include <tbb/parallel_for.h>

#include <numeric>

#include "forward/direct/direct_light.h"
#include "forward/direct/internal/expect_sensor.h"
#include "forward/direct/internal/luminaire_sight.h"
#include "forward/direct/internal/sensor_rows.h"
#include "forward/light/internal/clustered_room.h"
#include "forward/light/internal/room_again.h"
#include "forward/luminaire/internal/expect_luminaire.h"
#include "forward/mesh/mesh_check.h"
#include "forward/mesh/named_planes.h"
#include "forward/radiosity/internal/sparse_transport.h"
#include "forward/room/internal/expect_valid.h"

namespace luxfit {
namespace {

constexpr int kSensorOrder = 12;  // few sensors: afford the finest rule

void FillSensorRows(const Room& room, const Receivers& receivers, const std::vector<Luminaire>& luminaires,
                    Eigen::MatrixXf& rows) {
  tbb::parallel_for(size_t{0}, receivers.sensors.size(), [&](size_t i) {
    const auto row = static_cast<Eigen::Index>(receivers.elements.size() + i);
    for (size_t k = 0; k < luminaires.size(); ++k) {
      rows(row, static_cast<Eigen::Index>(k)) = static_cast<float>(
          SensorVisibleFraction(room.rays, luminaires[k], receivers.sensors[i], kSensorOrder));
    }
  });
}

// Returns the bytes of form factors (elements x patches) and coupling (patches x patches).
double MatrixBytes(const Patches& patches) {
  const double n = static_cast<double>(patches.patches.size());
  return n * (n + static_cast<double>(patches.elements.size())) * sizeof(float);
}

Room SparseRoom(Scene scene, RayScene rays, Patches patches, const FormFactorOptions& options) {
  auto sparse = std::make_shared<const SparseTransport>(rays, patches, options);
  FormFactors form_factors;
  form_factors.method = FormFactorMethod::kMalley;
  form_factors.because = "dense form factors would not fit into memory";
  form_factors.escaped_fraction = sparse->escaped_fraction();
  form_factors.back_fraction = sparse->back_fraction();
  form_factors.rays = sparse->rays();
  TransportGeometry transport{PatchAreas(patches), PatchMaterials(patches), {}};
  return {std::move(scene),     std::move(rays),   std::move(patches), std::move(form_factors),
          std::move(transport), std::move(sparse), std::nullopt,       nullptr};
}

Room DenseRoom(Scene scene, RayScene rays, Patches patches, const FormFactorOptions& options) {
  FormFactors form_factors = ComputeFormFactors(rays, patches, options);
  TransportGeometry transport = MakeTransportGeometry(patches, form_factors);
  Room room{std::move(scene),     std::move(rays), std::move(patches), std::move(form_factors),
            std::move(transport), nullptr,         std::nullopt,       nullptr};
  if (HasClusters(room.patches)) room.clusters = std::make_shared<const Room>(ClusteredRoom(room));
  return room;
}

}  // namespace

Room MakeRoom(const Scene& given, const RoomOptions& options) {
  ExpectValid(given);
  std::optional<LaidOnPlanes> on_planes;
  Scene scene;
  if (options.planes && given.surface.empty() && IsFinerThanPatches(given, options.patches)) {
    OnPlanes laid = LayOnPlanes(given, *options.planes);
    scene = std::move(laid.scene);
    on_planes = laid.how;
  } else {
    scene = given.surface.empty() ? WithoutOverlaps(given) : given;
    if (options.planes) scene = WithPlanesNamed(std::move(scene), options.planes->named_material);
  }
  RayScene rays(scene);
  Patches patches = Subdivide(scene, rays, options.patches);
  const auto make = MatrixBytes(patches) > options.max_matrix_bytes ? SparseRoom : DenseRoom;
  Room room = make(std::move(scene), std::move(rays), std::move(patches), options.form_factors);
  room.on_planes = on_planes;
  return room;
}

Room WithFormFactors(Room room, const FormFactorOptions& options) {
  const auto make = room.sparse ? SparseRoom : DenseRoom;
  const std::optional<LaidOnPlanes> on_planes = room.on_planes;
  Room again = make(std::move(room.scene), std::move(room.rays), std::move(room.patches), options);
  again.on_planes = on_planes;
  return again;
}

Receivers MakeReceivers(const Room& room, const std::vector<int>& elements,
                        const std::vector<Sensor>& sensors, int rays_per_sensor) {
  ExpectValid(sensors);
  Receivers receivers{elements, sensors, {}, {}, {}, {}};
  receivers.points.reserve(elements.size() + sensors.size());
  for (const int e : elements) {
    const Element& element = room.patches.elements[static_cast<size_t>(e)];
    receivers.points.push_back({element.center, element.normal, {}});
  }
  receivers.points.insert(receivers.points.end(), sensors.begin(), sensors.end());
  receivers.sensor_to_element = SensorRows(room.rays, room.patches, sensors, rays_per_sensor);
  return receivers;
}

void PrepareGather(const Room& room, Receivers& receivers) {
  if (room.sparse || room.patches.elements.empty()) return;
  const FormFactorMatrix& all = room.form_factors.element_to_patch;
  receivers.element_to_patch.resize(static_cast<Eigen::Index>(receivers.elements.size()), all.cols());
  tbb::parallel_for(size_t{0}, receivers.elements.size(), [&](size_t i) {
    receivers.element_to_patch.row(static_cast<Eigen::Index>(i)) = all.row(receivers.elements[i]);
  });
  const auto sensors = static_cast<Eigen::Index>(receivers.sensors.size());
  receivers.sensor_to_patch.assign(room.scene.materials.size(), Eigen::MatrixXf::Zero(sensors, all.cols()));
  using Gather = Eigen::SparseMatrix<float, Eigen::RowMajor>;
  tbb::parallel_for(Eigen::Index{0}, sensors, [&](Eigen::Index s) {
    std::vector<Eigen::RowVectorXf> rows(room.scene.materials.size(), Eigen::RowVectorXf::Zero(all.cols()));
    for (Gather::InnerIterator it(receivers.sensor_to_element, s); it; ++it) {
      const int patch = room.patches.elements[static_cast<size_t>(it.col())].patch;
      const int material = room.patches.patches[static_cast<size_t>(patch)].material;
      rows[static_cast<size_t>(material)] += it.value() * all.row(it.col());
    }
    for (size_t m = 0; m < rows.size(); ++m) receivers.sensor_to_patch[m].row(s) = rows[m];
  });
}

LuminaireVisibility ComputeVisibility(const Room& room, const Receivers& receivers,
                                      const std::vector<Luminaire>& luminaires, int order) {
  ExpectValid(luminaires);
  std::vector<int> all(room.patches.elements.size());
  std::iota(all.begin(), all.end(), 0);
  LuminaireVisibility visibility;
  visibility.elements = ElementVisibility(room.rays, room.patches, all, luminaires, order);
  FillReceivers(room, receivers, luminaires, visibility);
  return visibility;
}

void UpdateVisibility(const Room& room, const Receivers& receivers, const std::vector<Luminaire>& luminaires,
                      int order, const std::vector<int>& which, LuminaireVisibility& visibility) {
  std::vector<Luminaire> moved;
  moved.reserve(which.size());
  for (const int k : which) moved.push_back(luminaires[static_cast<size_t>(k)]);
  const bool has_elements = visibility.elements.size() > 0;
  const LuminaireVisibility anew =
      (has_elements ? ComputeVisibility : ComputeReceiverVisibility)(room, receivers, moved, order);
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(which.size()); ++i) {
    const int k = which[static_cast<size_t>(i)];
    if (has_elements) visibility.elements.col(k) = anew.elements.col(i);
    visibility.receivers.col(k) = anew.receivers.col(i);
  }
}

void FillReceivers(const Room& room, const Receivers& receivers, const std::vector<Luminaire>& luminaires,
                   LuminaireVisibility& visibility) {
  visibility.receivers.resize(receivers.count(), static_cast<Eigen::Index>(luminaires.size()));
  for (size_t i = 0; i < receivers.elements.size(); ++i)
    visibility.receivers.row(static_cast<Eigen::Index>(i)) = visibility.elements.row(receivers.elements[i]);
  FillSensorRows(room, receivers, luminaires, visibility.receivers);
}

LuminaireVisibility ComputeReceiverVisibility(const Room& room, const Receivers& receivers,
                                              const std::vector<Luminaire>& luminaires, int order) {
  ExpectValid(luminaires);
  LuminaireVisibility visibility;
  visibility.receivers.resize(receivers.count(), static_cast<Eigen::Index>(luminaires.size()));
  visibility.receivers.topRows(static_cast<Eigen::Index>(receivers.elements.size())) =
      ElementVisibility(room.rays, room.patches, receivers.elements, luminaires, order);
  FillSensorRows(room, receivers, luminaires, visibility.receivers);
  return visibility;
}

}  // namespace luxfit
