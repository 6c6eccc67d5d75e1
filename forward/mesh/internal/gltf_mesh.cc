#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "forward/mesh/internal/gltf_file.h"
#include "forward/mesh/internal/json_place.h"
#include "forward/mesh/internal/polygon_mesh.h"

namespace luxfit {
namespace {

// A small file can place one mesh any number of times.
constexpr size_t kMaxTriangles = 4'000'000;
constexpr double kQuaternionTolerance = 0.01;  // rounded ones stay inside

enum ComponentType : size_t { kUint8 = 5121, kUint16 = 5123, kUint32 = 5125, kFloat = 5126 };
enum Mode : size_t { kTriangles = 4, kStrip = 5, kFan = 6 };

size_t SizeOf(size_t component_type) {
  return component_type == kUint8 ? 1 : component_type == kUint16 ? 2 : 4;
}

float FloatAt(const char* bytes) {
  const uint32_t bits = LittleEndian(bytes, 4);
  float value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

// Describes elements that all lie inside their buffer.
struct Accessor {
  const char* first = nullptr;
  size_t count = 0, stride = 0, component_type = kFloat;
  const char* At(size_t index) const { return first + index * stride; }
};

// Holds three corners for each triangle, in the frame of the node.
struct Primitive {
  std::vector<Eigen::Vector3d> corners;
  int material = 0;
};

// Returns corner k of triangle t.
size_t CornerOf(size_t mode, size_t t, size_t k) {
  if (mode == kTriangles) return 3 * t + k;
  if (mode == kFan) return k == 0 ? 0 : t + k;
  return t + (t % 2 == 0 || k == 0 ? k : 3 - k);  // every other triangle of a strip is turned
}

class GltfReader {
 public:
  GltfReader(const GltfFile& file, const std::string& name)
      : file_(file), root_(file.document, name), meshes_(CountOf("meshes")) {}

  PolygonMesh Read() {
    ExpectSupported();
    PlaceScene();
    return std::move(mesh_);
  }

 private:
  struct Visit {
    size_t node;
    Eigen::Affine3d world_from_parent;
  };

  size_t CountOf(const char* key) const { return root_.Has(key) ? root_.At(key).Count() : 0; }

  // Returns what the index at `place` names in one of the lists of the root.
  JsonPlace Named(const JsonPlace& place, const char* list) const {
    const size_t index = place.Integer();
    if (index >= CountOf(list))
      place.Fail("expected one of " + std::to_string(CountOf(list)) + " " + list + ", got " +
                 std::to_string(index) + "; export it again");
    return root_.At(list).At(index);
  }

  void ExpectSupported() const {
    const JsonPlace version = root_.At("asset").At("version");
    if (version.Text().substr(0, 2) != "2.") version.FailExpecting("glTF 2.0");
    if (!root_.Has("extensionsRequired")) return;
    const JsonPlace required = root_.At("extensionsRequired");
    for (size_t i = 0; i < required.Count(); ++i) {
      const std::string& extension = required.At(i).Text();
      const auto is_of = [&](const char* family) { return extension.rfind(family, 0) == 0; };
      // These change how a surface looks, not where it is.
      if (is_of("KHR_materials_") || is_of("KHR_texture_") || is_of("EXT_texture_") || is_of("KHR_lights_"))
        continue;
      required.At(i).Fail("expected a mesh without extensions, got \"" + extension.substr(0, 60) +
                          "\"; export it without compression, quantization or instancing");
    }
  }

  void PlaceScene() {
    if (CountOf("scenes") == 0) root_.Fail("expected a scene, got none; export it again");
    const JsonPlace scene =
        root_.Has("scene") ? Named(root_.At("scene"), "scenes") : root_.At("scenes").At(size_t{0});
    // glTF is y up, the world z up.
    Eigen::Affine3d world_from_scene = Eigen::Affine3d::Identity();
    world_from_scene.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    std::vector<bool> seen(CountOf("nodes"), false);
    std::vector<Visit> open;  // a chain of nodes may be longer than the stack is deep
    Open(scene, "nodes", world_from_scene, seen, open);
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const JsonPlace node = root_.At("nodes").At(visit.node);
      const Eigen::Affine3d world_from_node = visit.world_from_parent * TransformOf(node);
      if (node.Has("mesh")) PlaceMesh(node, world_from_node);
      Open(node, "children", world_from_node, seen, open);
    }
  }

  // Pushes the nodes that a scene or a node names; the first is on top of the stack.
  void Open(const JsonPlace& parent, const char* key, const Eigen::Affine3d& world_from_parent,
            std::vector<bool>& seen, std::vector<Visit>& open) const {
    if (!parent.Has(key)) return;
    const JsonPlace children = parent.At(key);
    for (size_t i = children.Count(); i-- > 0;) {
      const JsonPlace child = children.At(i);
      Named(child, "nodes");
      const size_t node = child.Integer();
      if (seen[node])
        child.Fail("expected a node that no other node has, got one that is in a cycle or has two parents");
      seen[node] = true;
      open.push_back({node, world_from_parent});
    }
  }

  template <int kSize>
  Eigen::Matrix<double, kSize, 1> NumbersOf(const JsonPlace& list) const {
    if (list.Count() != kSize)
      list.Fail("expected " + std::to_string(kSize) + " numbers, got " + std::to_string(list.Count()));
    Eigen::Matrix<double, kSize, 1> numbers;
    for (int i = 0; i < kSize; ++i) numbers[i] = list.At(static_cast<size_t>(i)).Number();
    return numbers;
  }

  // Returns parent_from_node.
  Eigen::Affine3d TransformOf(const JsonPlace& node) const {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (node.Has("matrix")) {
      const Eigen::Matrix<double, 16, 1> numbers = NumbersOf<16>(node.At("matrix"));
      transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(numbers.data());  // by columns, both
      if (transform.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1))
        node.At("matrix").Fail("expected an affine matrix, got one whose last row is not 0 0 0 1");
      return transform;
    }
    if (node.Has("translation")) transform.translate(NumbersOf<3>(node.At("translation")));
    if (node.Has("rotation")) {
      const Eigen::Quaterniond rotation(NumbersOf<4>(node.At("rotation")));  // x, y, z, w, both
      if (!(std::abs(rotation.norm() - 1) <= kQuaternionTolerance))
        node.At("rotation")
            .Fail("expected a unit quaternion, got one of length " + std::to_string(rotation.norm()) +
                  "; export it again");
      transform.rotate(rotation.normalized());
    }
    if (node.Has("scale")) transform.scale(NumbersOf<3>(node.At("scale")));
    return transform;
  }

  void PlaceMesh(const JsonPlace& node, const Eigen::Affine3d& world_from_node) {
    if (node.Has("skin")) node.At("skin").Fail("expected a rigid mesh, got a skinned one; apply its pose");
    if (node.Has("extensions") && node.At("extensions").Has("EXT_mesh_gpu_instancing"))
      node.Fail("expected a mesh without instances, got EXT_mesh_gpu_instancing; export them as nodes");
    const JsonPlace mesh = Named(node.At("mesh"), "meshes");
    std::optional<std::vector<Primitive>>& primitives = meshes_[node.At("mesh").Integer()];
    if (!primitives) primitives = PrimitivesOf(mesh);
    const bool mirrored = world_from_node.linear().determinant() < 0;  // which turns fronts to backs
    for (const Primitive& primitive : *primitives) {
      Count(placed_triangles_, primitive.corners.size() / 3, node);
      for (size_t c = 0; c < primitive.corners.size(); ++c) {
        if (c % 3 == 0) {
          mesh_.first_corner.push_back(mesh_.corners.size());
          mesh_.material.push_back(primitive.material);
        }
        const size_t corner = mirrored ? c - c % 3 + (3 - c % 3) % 3 : c;
        mesh_.corners.push_back(static_cast<int>(mesh_.vertices.size()));
        mesh_.vertices.emplace_back(world_from_node * primitive.corners[corner]);
        if (!mesh_.vertices.back().allFinite())
          node.Fail("expected finite vertices, got one that is not; export it again");
      }
    }
  }

  void Count(size_t& triangles, size_t more, const JsonPlace& place) const {
    triangles += more;
    if (triangles > kMaxTriangles)
      place.Fail("expected at most " + std::to_string(kMaxTriangles) +
                 " triangles, got more; simplify the mesh");
  }

  std::vector<Primitive> PrimitivesOf(const JsonPlace& mesh) {
    const JsonPlace list = mesh.At("primitives");
    std::vector<Primitive> primitives;
    for (size_t p = 0; p < list.Count(); ++p) {
      const JsonPlace place = list.At(p);
      const size_t mode = place.IntegerOr("mode", kTriangles);
      if (mode > kFan) place.At("mode").FailExpecting("0 to 6");
      if (mode >= kTriangles) primitives.push_back(PrimitiveOf(place, mode));  // others: points and lines
    }
    return primitives;
  }

  Primitive PrimitiveOf(const JsonPlace& place, size_t mode) {
    if (place.Has("targets"))
      place.At("targets").Fail("expected a rigid mesh, got morph targets; apply the shape");
    const JsonPlace position = place.At("attributes").At("POSITION");
    const Accessor points = AccessorOf(position, "VEC3", {kFloat});
    const bool indexed = place.Has("indices");
    Accessor indices;
    if (indexed) indices = AccessorOf(place.At("indices"), "SCALAR", {kUint8, kUint16, kUint32});
    const size_t count = indexed ? indices.count : points.count;
    if (count < 3 || (mode == kTriangles && count % 3 != 0))
      place.Fail("expected the corners of triangles, got " + std::to_string(count) + "; export it again");
    const size_t triangles = mode == kTriangles ? count / 3 : count - 2;
    Count(read_triangles_, triangles, place);
    Primitive primitive;
    primitive.material = MaterialOf(place);
    primitive.corners.reserve(3 * triangles);
    for (size_t c = 0; c < 3 * triangles; ++c) {
      size_t index = CornerOf(mode, c / 3, c % 3);
      if (indexed) index = LittleEndian(indices.At(index), SizeOf(indices.component_type));
      if (index >= points.count)
        place.At("indices").Fail("expected indices of " + std::to_string(points.count) + " vertices, got " +
                                 std::to_string(index) + "; export it again");
      const char* point = points.At(index);
      primitive.corners.emplace_back(FloatAt(point), FloatAt(point + 4), FloatAt(point + 8));
      if (!primitive.corners.back().allFinite())
        position.Fail("expected finite vertices, got one that is not; export it again");
    }
    return primitive;
  }

  int MaterialOf(const JsonPlace& primitive) {
    std::string name = kDefaultMaterial;
    if (primitive.Has("material")) {
      const JsonPlace material = Named(primitive.At("material"), "materials");
      name = material.Has("name") ? material.At("name").Text()
                                  : "material_" + std::to_string(primitive.At("material").Integer());
    }
    return mesh_.MaterialIndex(name);
  }

  Accessor AccessorOf(const JsonPlace& index, const std::string& type,
                      const std::vector<size_t>& component_types) const {
    const JsonPlace place = Named(index, "accessors");
    if (place.Has("sparse"))
      place.At("sparse").Fail(
          "expected a plain accessor, got a sparse one; export it without sparse accessors");
    if (place.At("type").Text() != type) place.At("type").FailExpecting(type);
    Accessor accessor;
    accessor.component_type = place.At("componentType").Integer();
    if (std::find(component_types.begin(), component_types.end(), accessor.component_type) ==
        component_types.end())
      place.At("componentType").FailExpecting(type == "VEC3" ? "5126 (float)" : "5121, 5123 or 5125");
    const size_t element = (type == "VEC3" ? 3 : 1) * SizeOf(accessor.component_type);

    const JsonPlace view = Named(place.At("bufferView"), "bufferViews");
    const JsonPlace buffer = Named(view.At("buffer"), "buffers");
    const std::string& bytes = file_.buffers[view.At("buffer").Integer()];
    const size_t begin = view.IntegerOr("byteOffset", 0), length = view.At("byteLength").Integer();
    if (begin + length > bytes.size())
      view.Fail("expected " + std::to_string(begin + length) + " bytes in its buffer, got " +
                std::to_string(bytes.size()) + "; export it again");
    accessor.stride = view.IntegerOr("byteStride", element);
    if (accessor.stride < element) view.At("byteStride").FailExpecting("at least " + std::to_string(element));
    const size_t offset = place.IntegerOr("byteOffset", 0);
    accessor.count = place.At("count").Integer();
    const size_t room = length < offset + element ? 0 : (length - offset - element) / accessor.stride + 1;
    if (accessor.count < 1 || accessor.count > room)
      place.At("count").FailExpecting("1 to " + std::to_string(room) + ", which its bufferView has room for");
    accessor.first = bytes.data() + begin + offset;
    return accessor;
  }

  const GltfFile& file_;
  const JsonPlace root_;
  std::vector<std::optional<std::vector<Primitive>>> meshes_;  // those that were needed
  size_t read_triangles_ = 0, placed_triangles_ = 0;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh ParseGltf(std::string_view bytes, const std::string& name, const std::string& folder) {
  return GltfReader(ParseGltfFile(bytes, name, folder), name).Read();
}

}  // namespace luxfit
