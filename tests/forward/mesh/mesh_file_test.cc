#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kRoundingM = 1e-12;  // of doubles of some metres

// A 3 x 2 m floor and a 2 x 1 m wall beside it.
constexpr char kTwoQuads[] =
    "mtllib room.mtl\n"
    "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\n"
    "v 0 0 1\nv 0 2 1\n"
    "usemtl floor\nf 1 2 3 4\n"
    "usemtl wall\nf 1 4 6 5\n";
constexpr char kMaterialFile[] = "newmtl floor\nKd 0.5 0.5 0.5\nnewmtl wall\nKd 0.5 0.5 0.5\n";

Scene SceneOf(const std::string& obj, double metres_per_unit = 1) {
  const TempFolder folder;
  folder.Write("room.obj", obj);
  folder.Write("room.mtl", kMaterialFile);
  return ReadScene(folder.Path("room.obj"), metres_per_unit);
}

TEST(ReadScene, RectanglesStayWholeAndKeepTheirMaterial) {
  const Scene scene = SceneOf(kTwoQuads);
  ASSERT_EQ(scene.facets.size(), 2u);
  for (const Facet& facet : scene.facets) {
    EXPECT_EQ(facet.kind, FacetKind::kParallelogram);
    const bool floor = scene.materials[static_cast<size_t>(facet.material)] == "floor";
    EXPECT_TRUE(floor || scene.materials[static_cast<size_t>(facet.material)] == "wall");
    EXPECT_NEAR(facet.AreaM2(), floor ? 6 : 2, 6 * kRoundingM);
    const Eigen::Vector3d normal = floor ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    EXPECT_NEAR((facet.Normal() - normal).norm(), 0, kRoundingM) << facet.Normal().transpose();
  }
  EXPECT_NE(scene.facets[0].material, scene.facets[1].material);
  EXPECT_EQ(scene.dropped_facets, 0);
}

TEST(ReadScene, LengthsAreScaledToMetres) {
  const Scene scene = SceneOf(kTwoQuads, 0.01);
  EXPECT_NEAR((scene.Bounds().min() - Eigen::Vector3d::Zero()).norm(), 0, kRoundingM);
  EXPECT_NEAR((scene.Bounds().max() - Eigen::Vector3d(0.03, 0.02, 0.01)).norm(), 0, kRoundingM);
}

TEST(ReadScene, AConcavePolygonBecomesTrianglesOfItsAreaAndNormal) {
  // An L: a 2 x 2 square without its 1 x 1 upper right quarter, so 3 m2. A fan from the first corner would
  // cover 4.
  const Scene scene =
      SceneOf("usemtl floor\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n");
  double area = 0;
  for (const Facet& facet : scene.facets) {
    EXPECT_EQ(facet.kind, FacetKind::kTriangle);
    EXPECT_NEAR((facet.Normal() - Eigen::Vector3d::UnitZ()).norm(), 0, kRoundingM);
    EXPECT_FALSE(facet.PointAt(1. / 3, 1. / 3).x() > 1 && facet.PointAt(1. / 3, 1. / 3).y() > 1);
    area += facet.AreaM2();
  }
  EXPECT_EQ(scene.facets.size(), 4u);  // a polygon of n corners has n - 2 triangles
  EXPECT_NEAR(area, 3, 4 * kRoundingM);
}

TEST(ReadScene, FacesWithoutAreaAreCounted) {
  const Scene scene = SceneOf(std::string(kTwoQuads) + "v 1 0 0\nv 2 0 0\nf 1 7 8\n");
  EXPECT_EQ(scene.dropped_facets, 1);
  EXPECT_EQ(scene.facets.size(), 2u);
}

std::string ErrorOf(const std::string& path) {
  try {
    ReadScene(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReadScene, AMissingFileIsNamed) {
  const std::string path = TempFolder().Path("nowhere.obj");
  EXPECT_NE(ErrorOf(path).find(path), std::string::npos) << ErrorOf(path);
}

TEST(ReadScene, AFileWithoutFacetsIsNamed) {
  const TempFolder folder;
  folder.Write("points.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n");
  folder.Write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  folder.Write("text.obj", "this is no mesh\n");
  for (const char* name : {"points.obj", "line.obj", "text.obj"}) {
    const std::string path = folder.Path(name);
    EXPECT_NE(ErrorOf(path).find(path), std::string::npos) << ErrorOf(path);
  }
}

std::string ParseError(const std::string& bytes, MeshFormat format) {
  try {
    ParseScene(bytes, format, "room");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

std::string ObjError(const std::string& text) { return ParseError(text, MeshFormat::kObj); }
std::string PlyError(const std::string& bytes) { return ParseError(bytes, MeshFormat::kPly); }

TEST(ParseObj, MalformedLinesAreNamed) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_THAT(ObjError("v 0 0 0\nv 1 0\n"),
              StartsWith("room:2: v: expected three finite numbers, got fewer"));
  EXPECT_THAT(ObjError("v 0 0 nan\n"), StartsWith("room:1: v: expected three finite numbers, got \"nan\""));
  EXPECT_THAT(ObjError("v 0 0 1e999\n"), StartsWith("room:1: v: "));
  EXPECT_THAT(ObjError("v 0,5 0 1\n"), HasSubstr("decimal points"));
  EXPECT_THAT(ObjError(corners + "f 1 2 4\n"),
              StartsWith("room:4: f: expected one of 3 vertices, got number 4"));
  EXPECT_THAT(ObjError(corners + "f 1 2 -4\n"),
              StartsWith("room:4: f: expected the number of a vertex, got \"-4\""));
  EXPECT_THAT(ObjError(corners + "f 1 2 0\n"), StartsWith("room:4: f: "));
  EXPECT_THAT(ObjError(corners + "f 1 2 99999999999999999999\n"), StartsWith("room:4: f: "));
  EXPECT_THAT(ObjError(corners + "f 1 2 x\n"), StartsWith("room:4: f: "));
  EXPECT_THAT(ObjError("v 0 0 0\nv 1e6 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("within 100 km"));
  EXPECT_THAT(ObjError(""), HasSubstr("at least one facet"));
}

TEST(ParseObj, TakesWhatTheFormatAllows) {
  // Continued lines, comments, texture and normal indices, negative indices, vertices after their face, CRLF.
  const std::string text =
      "# a comment\r\no thing\r\nusemtl two words\r\nf 1/1/1 2//1 \\\r\n3\r\nv 0 0 0\r\nv 1 0 0 0.5 0.5 "
      "0.5\r\n"
      "v 1 1 +0.0\r\nusemtl floor\r\nf -3 -2 -1 # corners\r\nl 1 2\r\n";
  const Scene scene = ParseScene(text, MeshFormat::kObj, "room");
  ASSERT_EQ(scene.facets.size(), 2u);
  EXPECT_EQ(scene.materials, (std::vector<std::string>{"two words", "floor"}));
  for (const Facet& facet : scene.facets) EXPECT_NEAR(facet.AreaM2(), 0.5, kRoundingM);
}

constexpr char kPlyHeader[] =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string BinaryPly(const std::string& format, bool swapped) {
  std::string bytes = "ply\nformat " + format + " 1.0\n" + kPlyHeader;
  const auto add = [&](auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    for (size_t i = 0; i < sizeof(value); ++i) bytes += raw[swapped ? sizeof(value) - 1 - i : i];
  };
  for (int v = 0; v < 4; ++v) {
    for (const float x : {v == 1 || v == 2 ? 3.f : 0.f, v > 1 ? 2.f : 0.f, 1.f}) add(x);
    add(uint8_t{200});
  }
  add(uint8_t{4});
  for (int32_t v = 0; v < 4; ++v) add(v);
  return bytes;
}

TEST(ParsePly, TextAndBothByteOrdersGiveTheSame) {
  const std::string text = std::string("ply\nformat ascii 1.0\ncomment made by hand\n") + kPlyHeader +
                           "0 0 1 200\n3 0 1 200\n3 2 1 200\n0 2 1 200\n4 0 1 2 3\n";
  // The tests run on little-endian machines.
  for (const std::string& bytes :
       {text, BinaryPly("binary_little_endian", false), BinaryPly("binary_big_endian", true)}) {
    const Scene scene = ParseScene(bytes, MeshFormat::kPly, "room", 2);
    ASSERT_EQ(scene.facets.size(), 1u);
    EXPECT_EQ(scene.facets[0].kind, FacetKind::kParallelogram);
    EXPECT_NEAR(scene.facets[0].AreaM2(), 4 * 6, 4 * kRoundingM);
    EXPECT_NEAR((scene.facets[0].PointAt(1, 1) - Eigen::Vector3d(6, 4, 2)).norm(), 0, kRoundingM);
  }
}

TEST(ParsePly, EveryTruncationIsAnError) {
  const std::string bytes = BinaryPly("binary_little_endian", false);
  for (size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THAT(PlyError(bytes.substr(0, length)), StartsWith("room")) << length;
  }
}

TEST(ParsePly, MalformedFilesAreNamed) {
  const std::string head = "ply\nformat ascii 1.0\n";
  EXPECT_THAT(PlyError("plx\n"), StartsWith("room:1: "));
  EXPECT_THAT(PlyError("ply\nformat utf8 1.0\n"), StartsWith("room:2: format"));
  EXPECT_THAT(PlyError(head + "element vertex many\n"), StartsWith("room:3: element"));
  EXPECT_THAT(PlyError(head + "element vertex 4000000000\n"), StartsWith("room:3: element"));
  EXPECT_THAT(PlyError(head + "property float x\n"), StartsWith("room:3: property"));
  EXPECT_THAT(PlyError(head + "element vertex 1\nproperty text x\n"), StartsWith("room:4: property"));
  // Two thousand million vertices in a file of some hundred bytes.
  EXPECT_THAT(
      PlyError(head + "element vertex 2000000000\nproperty float x\nproperty float y\nproperty float z\n"
                      "end_header\n0 0 0\n"),
      HasSubstr("truncated"));
  const std::string body = head + kPlyHeader + "0 0 1 9\n3 0 1 9\n3 2 1 9\n";
  EXPECT_THAT(PlyError(body + "0 2 x 9\n4 0 1 2 3\n"),
              StartsWith("room:14: element vertex 3: expected a number"));
  EXPECT_THAT(PlyError(body + "0 2 nan 9\n4 0 1 2 3\n"), HasSubstr("finite"));
  EXPECT_THAT(PlyError(body + "0 2 1 9\n4 0 1 2 4\n"), HasSubstr("expected one of 4 vertices, got index 4"));
  EXPECT_THAT(PlyError(body + "0 2 1 9\n4 0 1 2 -1\n"), HasSubstr("expected the index of a vertex"));
  EXPECT_THAT(PlyError(body + "0 2 1 9\n9999999 0 1 2 3\n"), HasSubstr("expected a list"));
  EXPECT_THAT(PlyError(head + "element vertex 1\nproperty float x\nend_header\n0\n"),
              HasSubstr("a property y"));
}

TEST(ReadScene, OtherAndBrokenFormatsAreNamed) {
  const TempFolder folder;
  folder.Write("room.dxf", "0\nSECTION\n");
  folder.Write("room.glb", "glTF");
  folder.Write("long.glb", std::string("glTF\x02\0\0\0\xff\0\0\0", 12));
  for (const char* name : {"room.dxf", "room.glb", "long.glb"}) {
    EXPECT_THAT(ErrorOf(folder.Path(name)), StartsWith(folder.Path(name) + ": expected")) << name;
  }
}

}  // namespace
}  // namespace luxfit
