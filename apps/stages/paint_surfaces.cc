#include "apps/stages/paint_surfaces.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/text/formats/json_vectors.h"
#include "forward/mesh/named_planes.h"
#include "inverse/albedo/paint_segments.h"

namespace luxfit {
namespace {

using nlohmann::json;

void RecordPaints(const Room& room, const PaintSegments& paints, RunContext& context) {
  std::string because = fmt::format(
      "elements that adjoin scatter by {:.2g} %, and the light errs by {:.2g} % from place to place; "
      "neighbours that differ "
      "by less than 3 sigmas are one",
      100 * paints.element_sigma, 100 * paints.shared_sigma);
  if (std::isfinite(paints.least_z))
    because += fmt::format(", those that are left differ by {:.1f} sigmas and more", paints.least_z);
  context.choices.push_back(
      {"surfaces of like paint",
       fmt::format("{} surfaces", paints.segments.size()),
       {"surfaces of like reflectance", fmt::format("the mesh's {} planes", room.scene.materials.size())},
       because});
}

json SurfaceJson(const PaintSegment& segment, size_t number) {
  constexpr double kFacesOneWay = 0.9;
  const double length = segment.normal.norm();
  return {{"name", "paint " + std::to_string(number)},
          {"center_m", VectorJson(segment.center)},
          {"normal", length > kFacesOneWay ? VectorJson(segment.normal / length) : json()},
          {"height_m", {segment.low_m, segment.high_m}},
          {"area_m2", segment.area_m2},
          {"elements", segment.elements.size()},
          {"albedo", segment.albedo},
          {"sigma", segment.sigma},
          {"albedo_rgb", segment.albedo_rgb.allFinite() ? VectorJson(segment.albedo_rgb) : json()}};
}

}  // namespace

json PaintSurfacesJson(const Room& room, const RoomFit& fit, RunContext& context) {
  json surfaces = json::array();
  if (!AreNamedPlanes(room.scene) || room.sparse || fit.data.observations.empty() || fit.stopped ||
      !fit.IsUsable())
    return surfaces;
  const StageTimer timer(context, "surfaces", "surfaces of like paint");
  const PaintSegments paints = SegmentPaints(room, fit.data, fit.fit);
  RecordPaints(room, paints, context);
  for (const PaintSegment& segment : paints.segments)
    surfaces.push_back(SurfaceJson(segment, surfaces.size() + 1));
  return surfaces;
}

}  // namespace luxfit
