#include "forward/room/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "forward/room/internal/embree_queries.h"
#include "forward/room/internal/expect_valid.h"
#include "forward/room/internal/facet_corners.h"

namespace luxfit {
namespace {

constexpr unsigned kTriangles = 0, kQuads = 1;  // geometry ids

struct RayCorner {
  float x, y, z;
};

RayCorner ToRayCorner(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

RTCRay MakeRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, float tfar) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tfar = tfar;
  ray.mask = std::numeric_limits<unsigned>::max();  // Debian's build compares masks; 0 would hit nothing
  return ray;
}

// Fills a ray packet of Embree; lanes past `count` stay off.
template <typename Ray>
void FillRays(const RayPacket& packet, Ray& rays, int* valid) {
  for (int k = 0; k < RayPacket::kSize; ++k) {
    const bool on = k < packet.count;
    valid[k] = on ? -1 : 0;
    rays.org_x[k] = on ? packet.origin[0][k] : 0;
    rays.org_y[k] = on ? packet.origin[1][k] : 0;
    rays.org_z[k] = on ? packet.origin[2][k] : 0;
    rays.dir_x[k] = on ? packet.direction[0][k] : 0;
    rays.dir_y[k] = on ? packet.direction[1][k] : 0;
    rays.dir_z[k] = on ? packet.direction[2][k] : 1;
    rays.tnear[k] = 0;
    rays.tfar[k] = std::numeric_limits<float>::infinity();
    rays.time[k] = 0;
    rays.mask[k] = std::numeric_limits<unsigned>::max();
    rays.id[k] = 0;
    rays.flags[k] = 0;
  }
}

}  // namespace

struct RayScene::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<int> facet_of_triangle, facet_of_quad;
  std::vector<std::array<Eigen::Vector2f, 3>>
      corners;  // by triangle, of Scene::surface; empty: facets themselves

  // Returns (u, v) of the facet at barycentric (u, v) of a triangle or (u, v) of a quad.
  Eigen::Vector2f OnFacet(unsigned geometry, unsigned primitive, float u, float v) const {
    if (geometry == kQuads || corners.empty()) return {u, v};
    const auto& [a, b, c] = corners[primitive];
    return a + u * (b - a) + v * (c - a);
  }

  int FacetOf(unsigned geometry, unsigned primitive) const {
    return (geometry == kQuads ? facet_of_quad : facet_of_triangle)[primitive];
  }

  ~State() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void Attach(RTCGeometryType type, unsigned id, unsigned corners_each,
              const std::vector<RayCorner>& vertices) {
    if (vertices.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, type);
    auto* out = static_cast<RayCorner*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(RayCorner), vertices.size()));
    std::copy(vertices.begin(), vertices.end(), out);
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, corners_each == 3 ? RTC_FORMAT_UINT3 : RTC_FORMAT_UINT4,
        corners_each * sizeof(unsigned), vertices.size() / corners_each));
    for (unsigned i = 0; i < vertices.size(); ++i) index[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
  }
};

RayScene::RayScene(const Scene& scene) {
  ExpectValid(scene);
  const auto state = std::make_shared<State>();
  state->device = rtcNewDevice("");
  if (state->device == nullptr)
    throw std::runtime_error("Embree: expected a device, got none (SSE2 is needed)");
  state->scene = rtcNewScene(state->device);
  // Robust: rays through the common edge of two facets must hit one of them.
  rtcSetSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST);
  std::vector<RayCorner> triangles, quads;
  for (const SurfaceTriangle& triangle : scene.surface) {
    const Facet& facet = scene.facets[static_cast<size_t>(triangle.facet)];
    for (const Eigen::Vector2d& corner : triangle.corners)
      triangles.push_back(ToRayCorner(facet.PointAt(corner.x(), corner.y())));
    state->facet_of_triangle.push_back(triangle.facet);
    const auto& [a, b, c] = triangle.corners;
    state->corners.push_back({a.cast<float>(), b.cast<float>(), c.cast<float>()});
  }
  for (size_t f = 0; f < scene.facets.size() && scene.surface.empty(); ++f) {
    const Facet& facet = scene.facets[f];
    const bool quad = facet.kind == FacetKind::kParallelogram;
    std::vector<RayCorner>& vertices = quad ? quads : triangles;
    for (const Eigen::Vector3d& corner : CornersOf(facet)) vertices.push_back(ToRayCorner(corner));
    (quad ? state->facet_of_quad : state->facet_of_triangle).push_back(static_cast<int>(f));
  }
  state->Attach(RTC_GEOMETRY_TYPE_TRIANGLE, kTriangles, 3, triangles);
  state->Attach(RTC_GEOMETRY_TYPE_QUAD, kQuads, 4, quads);
  rtcCommitScene(state->scene);
  state_ = state;
}

RayHit RayScene::Trace(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  RTCRayHit query{};
  query.ray = MakeRay(origin, direction, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  Intersect(state_->scene, query);
  RayHit hit;
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.facet = state_->FacetOf(query.hit.geomID, query.hit.primID);
  hit.distance = query.ray.tfar;
  const Eigen::Vector2f at = state_->OnFacet(query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v);
  hit.u = at.x();
  hit.v = at.y();
  hit.front =
      query.hit.Ng_x * query.ray.dir_x + query.hit.Ng_y * query.ray.dir_y + query.hit.Ng_z * query.ray.dir_z <
      0;
  return hit;
}

bool RayScene::Occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  const Eigen::Vector3d direction = to - from;
  const double length = direction.norm();
  if (length <= 1e-5) return false;
  RTCRay ray = MakeRay(from, direction, static_cast<float>(1.0 - 1e-5 / length));
  Occlude(state_->scene, ray);
  return ray.tfar < 0;
}

PacketHits RayScene::Trace(const RayPacket& packet) const {
  RTCRayHit8 query;
  alignas(32) int valid[RayPacket::kSize];
  FillRays(packet, query.ray, valid);
  for (int k = 0; k < RayPacket::kSize; ++k) {
    query.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  Intersect(state_->scene, valid, query);
  PacketHits hits;
  for (int k = 0; k < packet.count; ++k) {
    hits.facet[k] = -1;
    hits.front[k] = false;
    if (query.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
    hits.facet[k] = state_->FacetOf(query.hit.geomID[k], query.hit.primID[k]);
    const Eigen::Vector2f at =
        state_->OnFacet(query.hit.geomID[k], query.hit.primID[k], query.hit.u[k], query.hit.v[k]);
    hits.u[k] = at.x();
    hits.v[k] = at.y();
    hits.front[k] = query.hit.Ng_x[k] * query.ray.dir_x[k] + query.hit.Ng_y[k] * query.ray.dir_y[k] +
                        query.hit.Ng_z[k] * query.ray.dir_z[k] <
                    0;
  }
  return hits;
}

unsigned RayScene::Occluded(const RayPacket& packet) const {
  RTCRay8 query;
  alignas(32) int valid[RayPacket::kSize];
  FillRays(packet, query, valid);
  for (int k = 0; k < packet.count; ++k) {
    const float length = std::sqrt(query.dir_x[k] * query.dir_x[k] + query.dir_y[k] * query.dir_y[k] +
                                   query.dir_z[k] * query.dir_z[k]);
    query.tfar[k] = 1.0f - 1e-5f / std::max(length, 1e-5f);
  }
  Occlude(state_->scene, valid, query);
  unsigned blocked = 0;
  for (int k = 0; k < packet.count; ++k) {
    if (query.tfar[k] < 0) blocked |= 1u << k;
  }
  return blocked;
}

}  // namespace luxfit
