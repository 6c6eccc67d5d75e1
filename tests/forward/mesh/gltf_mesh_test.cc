#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;
using Pointer = Json::json_pointer;

constexpr double kFloatM = 1e-6;  // of floats of some metres

std::string Base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
  }
  return text;
}

template <typename T>
std::string BytesOf(const std::vector<T>& values) {  // the tests run on little-endian machines
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// Indices 0 1 2 0 2 3, then corners (0 0 0), (3 0 0), (3 2 0), (0 2 0): in glTF's axes an upright wall that
// faces +z, in the world's one that faces -y.
std::string QuadBytes() {
  return BytesOf<uint16_t>({0, 1, 2, 0, 2, 3}) + BytesOf<float>({0, 0, 0, 3, 0, 0, 3, 2, 0, 0, 2, 0});
}

// Its document but for the buffer's uri.
Json QuadJson() {
  return Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "materials": [{"name": "white wall"}, {}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0, "material": 0}]}],
    "buffers": [{"byteLength": 60}],
    "bufferViews": [{"buffer": 0, "byteLength": 12}, {"buffer": 0, "byteOffset": 12, "byteLength": 48}],
    "accessors": [{"bufferView": 0, "componentType": 5123, "count": 6, "type": "SCALAR"},
                  {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"}]})");
}

Json QuadWith(const std::string& bytes) {
  Json json = QuadJson();
  json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + Base64(bytes);
  return json;
}

Json Quad() { return QuadWith(QuadBytes()); }

Json Patched(const std::string& pointer, const Json& value) {
  Json json = Quad();
  json[Pointer(pointer)] = value;
  return json;
}

// Chunks padded to 4 bytes, as the format wants them.
std::string Glb(const Json& json, const std::string& binary) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto size = [](size_t bytes) { return static_cast<uint32_t>(bytes); };
  return "glTF" + BytesOf<uint32_t>({2, size(12 + 8 + text.size() + 8 + binary.size()), size(text.size())}) +
         "JSON" + text + BytesOf<uint32_t>({size(binary.size())}) + std::string("BIN\0", 4) + binary;
}

Scene Parse(const std::string& bytes) { return ParseScene(bytes, MeshFormat::kGltf, "room"); }

std::string GltfErrorOf(const std::string& bytes) {
  try {
    Parse(bytes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

std::string ErrorAt(const std::string& pointer, const Json& value) {
  return GltfErrorOf(Patched(pointer, value).dump());
}

void ExpectWall(const Scene& scene) {
  ASSERT_EQ(scene.facets.size(), 2u);
  double area_m2 = 0;
  for (const Facet& facet : scene.facets) {
    area_m2 += facet.AreaM2();
    EXPECT_NEAR((facet.Normal() + Eigen::Vector3d::UnitY()).norm(), 0, kFloatM);
  }
  EXPECT_NEAR(area_m2, 6, 6 * kFloatM);
  EXPECT_NEAR((scene.Bounds().max() - Eigen::Vector3d(3, 0, 2)).norm(), 0, kFloatM);
  EXPECT_EQ(scene.materials, std::vector<std::string>{"white wall"});
}

TEST(ParseGltf, TurnsYUpToZUp) { ExpectWall(Parse(Quad().dump())); }

TEST(ParseGltf, ReadsGlb) {
  ExpectWall(Parse(Glb(QuadJson(), QuadBytes())));
  ExpectWall(Parse(Glb(QuadJson(), QuadBytes() + std::string(3, '\0'))));  // padded
}

TEST(ReadScene, FindsBuffersBesideTheFile) {
  const TempFolder folder;
  folder.Write("my room.bin", QuadBytes());
  Json json = QuadJson();
  json["buffers"][0]["uri"] = "my%20room.bin";
  folder.Write("room.gltf", json.dump());
  folder.Write("room.GLB", Glb(QuadJson(), QuadBytes()));
  ExpectWall(ReadScene(folder.Path("room.gltf")));
  ExpectWall(ReadScene(folder.Path("room.GLB")));
  EXPECT_THAT(GltfErrorOf(json.dump()),
              StartsWith("room: /buffers/0/uri: expected a buffer within the file"));
  json["buffers"][0]["byteLength"] = 61;
  folder.Write("room.gltf", json.dump());
  EXPECT_THROW(ReadScene(folder.Path("room.gltf")), std::runtime_error);
  json["buffers"][0]["uri"] = "nowhere.bin";
  folder.Write("room.gltf", json.dump());
  EXPECT_THROW(ReadScene(folder.Path("room.gltf")), std::runtime_error);
}

TEST(ParseGltf, PlacesNodes) {
  // The parent moves by (10, 0, 0) and doubles; the child turns by a quarter round y, which takes x to -z,
  // and so the world's x to y.
  Json json = Quad();
  json["nodes"] = Json::parse(R"([{"children": [1], "translation": [10, 0, 0], "scale": [2, 2, 2]},
                      {"mesh": 0, "rotation": [0, 0.70710678, 0, 0.70710678]}])");
  const Scene turned = Parse(json.dump());
  EXPECT_NEAR((turned.Bounds().min() - Eigen::Vector3d(10, 0, 0)).norm(), 0, 10 * kFloatM);
  EXPECT_NEAR((turned.Bounds().max() - Eigen::Vector3d(10, 6, 4)).norm(), 0, 10 * kFloatM);
  EXPECT_NEAR((turned.facets[0].Normal() - Eigen::Vector3d::UnitX()).norm(), 0, kFloatM);
  // The same in one matrix, by columns.
  json["nodes"] =
      Json::parse(R"([{"mesh": 0, "matrix": [0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 10, 0, 0, 1]}])");
  const Scene by_matrix = Parse(json.dump());
  ASSERT_EQ(by_matrix.facets.size(), turned.facets.size());
  for (size_t f = 0; f < turned.facets.size(); ++f) {
    for (const auto& [u, v] : {std::pair{0., 0.}, {1., 0.}, {0., 1.}})
      EXPECT_NEAR((by_matrix.facets[f].PointAt(u, v) - turned.facets[f].PointAt(u, v)).norm(), 0,
                  10 * kFloatM);
  }
}

TEST(ParseGltf, AMirroredNodeKeepsItsFront) {
  // Mirrored in its own plane: the wall still faces -y. Mirrored through it: it faces +y.
  for (const auto& [scale, facing] : {std::pair{Json{-1, 1, 1}, -1.0},
                                      {Json{1, -1, 1}, -1.0},
                                      {Json{1, 1, -1}, 1.0},
                                      {Json{-1, -1, 1}, -1.0}}) {
    const Scene scene = Parse(Patched("/nodes/0/scale", scale).dump());
    ASSERT_EQ(scene.facets.size(), 2u);
    for (const Facet& facet : scene.facets) EXPECT_NEAR(facet.Normal().y(), facing, kFloatM) << scale;
  }
}

TEST(ParseGltf, StripsAndFansAreTriangles) {
  for (const int mode : {5, 6}) {
    // A strip runs across, a fan round.
    Json json = QuadWith(mode == 5 ? BytesOf<uint16_t>({0, 1, 3, 2, 0, 0}) + QuadBytes().substr(12)
                                   : BytesOf<uint16_t>({0, 1, 2, 3, 0, 0}) + QuadBytes().substr(12));
    json["accessors"][0]["count"] = 4;
    json["meshes"][0]["primitives"][0]["mode"] = mode;
    ExpectWall(Parse(json.dump()));
  }
}

TEST(ParseGltf, TakesInterleavedCornersWithoutIndices) {
  // Each corner is followed by its normal.
  Json json = QuadWith(std::string(12, '\0') +
                       BytesOf<float>({0, 0, 0, 0, 0, 1, 3, 0, 0, 0, 0, 1, 3, 2, 0, 0, 0, 1}));
  json["buffers"][0]["byteLength"] = 84;
  json["bufferViews"][1] = {{"buffer", 0}, {"byteOffset", 12}, {"byteLength", 72}, {"byteStride", 24}};
  json["accessors"][1]["count"] = 3;
  json["meshes"][0]["primitives"][0].erase("indices");
  const Scene scene = Parse(json.dump());
  ASSERT_EQ(scene.facets.size(), 1u);
  EXPECT_NEAR(scene.facets[0].AreaM2(), 3, 3 * kFloatM);
}

TEST(ParseGltf, SurfacesWithoutANamedMaterialHaveADefinedName) {
  EXPECT_EQ(Parse(Patched("/meshes/0/primitives/0/material", 1).dump()).materials,
            std::vector<std::string>{"material_1"});
  Json json = Quad();
  json["meshes"][0]["primitives"][0].erase("material");
  EXPECT_EQ(Parse(json.dump()).materials, std::vector<std::string>{"DefaultMaterial"});
}

TEST(ParseGltf, PointsLinesAndUnusedMeshesAreLeftOut) {
  Json json = Quad();
  json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 1}}}, {"mode", 1}});
  json["meshes"].push_back({{"primitives", {{{"attributes", Json::object()}}}}});
  ExpectWall(Parse(json.dump()));
}

TEST(ParseGltf, WhatLiesOutOfRangeIsNamed) {
  EXPECT_THAT(
      ErrorAt("/accessors/0/count", 9),
      StartsWith("room: /accessors/0/count: expected 1 to 6, which its bufferView has room for, got 9"));
  EXPECT_THAT(ErrorAt("/accessors/0/count", 9007199254740992), StartsWith("room: /accessors/0/count: "));
  EXPECT_THAT(ErrorAt("/accessors/0/count", 0), StartsWith("room: /accessors/0/count: "));
  EXPECT_THAT(ErrorAt("/accessors/0/count", -3), StartsWith("room: /accessors/0/count: expected a whole"));
  EXPECT_THAT(ErrorAt("/accessors/0/count", 6.0), StartsWith("room: /accessors/0/count: expected a whole"));
  EXPECT_THAT(ErrorAt("/accessors/0/count", 5),
              StartsWith("room: /meshes/0/primitives/0: expected the corners"));
  EXPECT_THAT(ErrorAt("/accessors/1/count", 3),
              StartsWith("room: /meshes/0/primitives/0/indices: expected indices of 3 vertices, got 3"));
  EXPECT_THAT(ErrorAt("/accessors/1/byteOffset", 1), StartsWith("room: /accessors/1/count: "));
  EXPECT_THAT(ErrorAt("/accessors/1/byteOffset", 9007199254740992), StartsWith("room: /accessors/1/count: "));
  EXPECT_THAT(ErrorAt("/accessors/1/componentType", 5123), HasSubstr("componentType: expected 5126 (float)"));
  EXPECT_THAT(ErrorAt("/accessors/1/type", "VEC2"), HasSubstr("/accessors/1/type: expected VEC3"));
  EXPECT_THAT(ErrorAt("/bufferViews/1/byteLength", 49),
              StartsWith("room: /bufferViews/1: expected 61 bytes"));
  EXPECT_THAT(ErrorAt("/bufferViews/1/byteOffset", 9007199254740992), StartsWith("room: /bufferViews/1: "));
  EXPECT_THAT(ErrorAt("/bufferViews/1/byteStride", 8), HasSubstr("byteStride: expected at least 12, got 8"));
  EXPECT_THAT(ErrorAt("/bufferViews/1/byteStride", 0), HasSubstr("byteStride: expected at least 12, got 0"));
  EXPECT_THAT(ErrorAt("/bufferViews/1/buffer", 1),
              StartsWith("room: /bufferViews/1/buffer: expected one of 1 buffers, got 1"));
  EXPECT_THAT(ErrorAt("/buffers/0/byteLength", 63), StartsWith("room: /buffers/0: expected 63 bytes"));
  EXPECT_THAT(ErrorAt("/buffers/0/byteLength", uint64_t{1} << 40), HasSubstr("2 GiB"));
  EXPECT_THAT(ErrorAt("/buffers/0/uri", "data:,text"), HasSubstr("expected data in base64"));
  EXPECT_THAT(ErrorAt("/buffers/0/uri", "data:;base64,AA*A"), HasSubstr("/buffers/0/uri: expected base64"));
  EXPECT_THAT(ErrorAt("/nodes/0/mesh", 1), StartsWith("room: /nodes/0/mesh: expected one of 1 meshes"));
  EXPECT_THAT(ErrorAt("/nodes/0/matrix", Json{1, 0, 0}), HasSubstr("matrix: expected 16 numbers, got 3"));
  EXPECT_THAT(ErrorAt("/nodes/0/matrix", std::vector<int>(16, 1)), HasSubstr("last row"));
  EXPECT_THAT(ErrorAt("/nodes/0/rotation", Json{0, 0, 0, 0}),
              HasSubstr("rotation: expected a unit quaternion"));
  EXPECT_THAT(ErrorAt("/nodes/0/scale", Json{1e300, 1, 1}), HasSubstr("within 100 km"));
  EXPECT_THAT(ErrorAt("/nodes/0/translation", Json{1, "2", 3}),
              StartsWith("room: /nodes/0/translation/1: expected a number, got \"2\""));
  EXPECT_THAT(ErrorAt("/scene", 1), StartsWith("room: /scene: expected one of 1 scenes"));
  EXPECT_THAT(ErrorAt("/scenes", Json::array()), StartsWith("room: expected a scene, got none"));
  EXPECT_THAT(ErrorAt("/meshes/0/primitives/0/mode", 7), HasSubstr("mode: expected 0 to 6, got 7"));
  EXPECT_THAT(ErrorAt("/meshes/0/primitives/0/attributes", Json::object()),
              HasSubstr("expected a key \"POSITION\", got none"));
  std::string bytes = QuadBytes();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&bytes[12], &nan, sizeof(nan));
  EXPECT_THAT(GltfErrorOf(QuadWith(bytes).dump()), HasSubstr("POSITION: expected finite vertices"));
}

TEST(ParseGltf, NodesFormATree) {
  EXPECT_THAT(ErrorAt("/nodes/0/children", Json{0}),
              StartsWith("room: /nodes/0/children/0: expected a node that"));
  EXPECT_THAT(ErrorAt("/scenes/0/nodes", (Json{0, 0})),
              StartsWith("room: /scenes/0/nodes/0: expected a node"));
  EXPECT_THAT(ErrorAt("/scenes/0/nodes", Json{5}), HasSubstr("expected one of 1 nodes, got 5"));
  // A chain that no recursion would survive.
  constexpr size_t kNodes = 200'000;
  Json json = Quad();
  json["nodes"] = Json::array();
  for (size_t n = 0; n + 1 < kNodes; ++n) json["nodes"].push_back({{"children", {n + 1}}});
  json["nodes"].push_back({{"mesh", 0}});
  ExpectWall(Parse(json.dump()));
}

TEST(ParseGltf, FewBytesDoNotBecomeManyTriangles) {
  // A thousand nodes of a mesh of a thousand primitives of sixty triangles.
  Json json = QuadWith(std::string(360, '\0') + QuadBytes().substr(12));
  json["buffers"][0]["byteLength"] = 408;
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 360}},
                         {{"buffer", 0}, {"byteOffset", 360}, {"byteLength", 48}}};
  json["accessors"][0]["count"] = 180;
  json["meshes"][0]["primitives"] = std::vector<Json>(1000, json["meshes"][0]["primitives"][0]);
  json["nodes"] = std::vector<Json>(1000, {{"mesh", 0}});
  std::vector<int> nodes(1000);
  for (int n = 0; n < 1000; ++n) nodes[static_cast<size_t>(n)] = n;
  json["scenes"][0]["nodes"] = nodes;
  EXPECT_THAT(GltfErrorOf(json.dump()), HasSubstr("expected at most 4000000 triangles"));
}

TEST(ParseGltf, WhatIsNotReadIsRefusedByName) {
  for (const char* extension :
       {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization"}) {
    EXPECT_THAT(ErrorAt("/extensionsRequired", Json{extension}),
                AllOf(StartsWith("room: /extensionsRequired/0: "), HasSubstr(extension)));
  }
  ExpectWall(Parse(Patched("/extensionsRequired", Json{"KHR_materials_unlit"}).dump()));
  EXPECT_THAT(ErrorAt("/accessors/1/sparse", Json::object()), HasSubstr("/accessors/1/sparse: "));
  EXPECT_THAT(ErrorAt("/nodes/0/skin", 0), HasSubstr("skinned"));
  EXPECT_THAT(ErrorAt("/nodes/0/extensions", {{"EXT_mesh_gpu_instancing", Json::object()}}),
              HasSubstr("EXT_mesh_gpu_instancing"));
  EXPECT_THAT(ErrorAt("/meshes/0/primitives/0/targets", Json::array()), HasSubstr("morph targets"));
  EXPECT_THAT(ErrorAt("/asset/version", "1.0"), StartsWith("room: /asset/version: expected glTF 2.0"));
}

TEST(ParseGltf, TextThatIsNoJsonIsNamedWithItsLine) {
  EXPECT_THAT(GltfErrorOf("{\"asset\":\n{\"version\": 2.0,}}"), StartsWith("room:2: expected the JSON"));
  EXPECT_THAT(GltfErrorOf(""), StartsWith("room:1: expected the JSON"));
  EXPECT_THAT(GltfErrorOf("[1e999]"), HasSubstr("expected numbers within 1e308"));
  EXPECT_THAT(GltfErrorOf("[]"), StartsWith("room: expected an object, got array"));
  EXPECT_THAT(GltfErrorOf(std::string(1'000'000, '[')), StartsWith("room:1: expected the JSON"));
  EXPECT_THAT(ErrorAt("/scenes/0/nodes", "0"),
              StartsWith("room: /scenes/0/nodes: expected a list, got \"0\""));
  // Nested deeper than the stack, where a number belongs.
  std::string text = Quad().dump();
  const std::string scene = "\"scene\":0";
  text.replace(text.find(scene), scene.size(),
               "\"scene\":" + std::string(1'000'000, '[') + std::string(1'000'000, ']'));
  EXPECT_THAT(GltfErrorOf(text),
              StartsWith("room: /scene: expected a whole number from 0 to 2^53, got array"));
}

TEST(ParseGltf, EveryTruncationIsAnError) {
  for (const std::string& bytes : {Glb(QuadJson(), QuadBytes()), Quad().dump()}) {
    for (size_t length = 0; length < bytes.size(); ++length)
      EXPECT_THAT(GltfErrorOf(bytes.substr(0, length)), StartsWith("room")) << length;
  }
  std::string other = Glb(QuadJson(), QuadBytes());
  other[4] = 1;
  EXPECT_THAT(GltfErrorOf(other), StartsWith("room: expected GLB version 2, got 1"));
  other = Glb(QuadJson(), QuadBytes());
  other[13] = 9;  // the first chunk's length
  EXPECT_THAT(GltfErrorOf(other), StartsWith("room: chunk 0: "));
}

}  // namespace
}  // namespace luxfit
