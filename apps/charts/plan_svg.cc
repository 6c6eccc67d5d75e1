#include "apps/charts/plan_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/charts/svg.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kPlanWidthPx = 900, kPlanMarginPx = 30, kPlanLegendPx = 56;

constexpr size_t kMostLabels = 60;

// Maps metres in the world to pixels of the picture, y upwards.
struct Plan {
  Eigen::AlignedBox3d box;
  double scale = 1;
  double X(double x) const { return kPlanMarginPx + scale * (x - box.min().x()); }
  double Y(double y) const { return kPlanMarginPx + scale * (box.max().y() - y); }
};

// Returns facets to draw: a facet that a surface covers only in part as the surface's triangles.
std::vector<Facet> FacetsToDraw(const Scene& scene) {
  constexpr double kNearlyAll = 0.85;
  if (scene.surface.empty()) return scene.facets;
  const std::vector<Facet> triangles = SurfaceFacets(scene);
  std::vector<Facet> drawn;
  for (size_t t = 0; t < triangles.size(); ++t) {
    if (scene.facets[static_cast<size_t>(scene.surface[t].facet)].covered_share < kNearlyAll)
      drawn.push_back(triangles[t]);
  }
  std::copy_if(scene.facets.begin(), scene.facets.end(), std::back_inserter(drawn),
               [](const Facet& facet) { return facet.covered_share >= kNearlyAll; });
  std::stable_sort(drawn.begin(), drawn.end(),
                   [](const Facet& a, const Facet& b) { return a.origin.z() < b.origin.z(); });
  return drawn;
}

std::string Outlines(const Plan& plan, const Scene& scene) {
  std::string text;
  for (const Facet& facet : FacetsToDraw(scene)) {
    // Only surfaces that face up are drawn: furniture and floor. Walls appear as the floor's edge.
    if (facet.Normal().z() < 0.5) continue;
    std::string points;
    const bool triangle = facet.kind == FacetKind::kTriangle;
    for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      if (triangle && u + v > 1) continue;
      const Eigen::Vector3d p = facet.PointAt(u, v);
      points += fmt::format("{:.1f},{:.1f} ", plan.X(p.x()), plan.Y(p.y()));
    }
    text += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"#888\"/>\n", points,
                        facet.origin.z() < plan.box.min().z() + 0.01 ? "#f4f2ee" : "#e2d6c4");
  }
  return text;
}

Plan PlanOfScene(const Scene& scene) {
  Plan plan;
  plan.box = scene.Bounds();
  // A sheet that stands on the y axis has no width.
  plan.scale = (kPlanWidthPx - 2 * kPlanMarginPx) / std::max(plan.box.sizes().x(), 1e-3);
  return plan;
}

std::string MaterialColour(int material) {
  return fmt::format("hsl({:.0f},55%,40%)",
                     std::fmod(137.5 * material, 360.0));  // the golden angle: far apart
}

bool IsUpright(const Facet& facet) { return std::abs(facet.Normal().z()) < 0.1; }

// Draws upright facets as the lines that they are from above.
std::string Walls(const Plan& plan, const Scene& scene) {
  std::string text;
  for (const Facet& facet : scene.facets) {
    if (!IsUpright(facet)) continue;
    const Eigen::Vector2d normal = facet.Normal().head<2>().normalized();
    const Eigen::Vector2d along(-normal.y(), normal.x());
    Eigen::Vector2d first = facet.origin.head<2>(), last = first;
    for (const Eigen::Vector3d& p : {facet.PointAt(1, 0), facet.PointAt(0, 1)}) {
      const Eigen::Vector2d q = p.head<2>();
      if (along.dot(q - first) < 0) first = q;
      if (along.dot(q - last) > 0) last = q;
    }
    if (facet.kind == FacetKind::kParallelogram) {
      const Eigen::Vector2d q = facet.PointAt(1, 1).head<2>();
      if (along.dot(q - first) < 0) first = q;
      if (along.dot(q - last) > 0) last = q;
    }
    text += SvgLine(plan.X(first.x()), plan.Y(first.y()), plan.X(last.x()), plan.Y(last.y()),
                    fmt::format(" stroke=\"{}\" stroke-width=\"4\"", MaterialColour(facet.material)));
  }
  return text;
}

// Tells whether a material is better named at this facet: at one that a plan shows as an area, at the larger one.
bool IsBetterToName(const Facet& facet, const Facet& than) {
  const bool upright = IsUpright(facet), than_upright = IsUpright(than);
  return upright == than_upright ? facet.AreaM2() > than.AreaM2() : than_upright;
}

// Names each material once.
std::string MaterialNames(const Plan& plan, const Scene& scene) {
  std::map<int, const Facet*> named;
  for (const Facet& facet : scene.facets) {
    if (facet.Normal().z() < -0.1) continue;
    const Facet*& known = named[facet.material];
    if (!known || IsBetterToName(facet, *known)) known = &facet;
  }
  std::string text;
  size_t labels = 0;
  for (const auto& [material, facet] : named) {
    if (++labels > kMostLabels) break;
    const double at = facet->kind == FacetKind::kTriangle ? 1.0 / 3 : 0.5;
    const Eigen::Vector3d p = facet->PointAt(at, at);
    constexpr double kBesideWallPx = 12, kHalfLinePx = 4;
    Eigen::Vector2d aside(0, 0);
    if (IsUpright(*facet)) aside = kBesideWallPx * facet->Normal().head<2>();
    // Names stand on the wall's inner side.
    const char* anchor =
        aside.x() > 0.5 * kBesideWallPx ? "start" : (aside.x() < -0.5 * kBesideWallPx ? "end" : "middle");
    text += SvgText(plan.X(p.x()) + aside.x(), plan.Y(p.y()) - aside.y() + kHalfLinePx,
                    scene.materials[static_cast<size_t>(material)],
                    fmt::format(" text-anchor=\"{}\" fill=\"{}\"", anchor, MaterialColour(material)));
  }
  return text;
}

// Draws a camera that looks along (dx, dy), with its name.
std::string CameraMark(double x, double y, double dx, double dy, const std::string& colour,
                       const std::string& name) {
  const double angle = std::atan2(-dy, dx), spread = 0.35, length = 34;
  return fmt::format(
             "<path d=\"M{0:.1f} {1:.1f} L{2:.1f} {3:.1f} L{4:.1f} {5:.1f} Z\" fill=\"{6}\" "
             "fill-opacity=\"0.25\" "
             "stroke=\"{6}\"/>",
             x, y, x + length * std::cos(angle - spread), y + length * std::sin(angle - spread),
             x + length * std::cos(angle + spread), y + length * std::sin(angle + spread), colour) +
         SvgText(x, y - 5, name, fmt::format(" fill=\"{}\"", colour));
}

std::string Cameras(const Plan& plan, const json& views) {
  std::string text;
  for (const json& view : views) {
    // The third column of the rotation is the viewing direction.
    text += CameraMark(
        plan.X(view["position_m"][0].get<double>()), plan.Y(view["position_m"][1].get<double>()),
        view["R_scene_from_camera"][0][2].get<double>(), view["R_scene_from_camera"][1][2].get<double>(),
        "#3b6fb6", view["view"].get<std::string>());
  }
  return text;
}

std::string AdvisedPlaces(const Plan& plan, const json& advice) {
  constexpr char kColour[] = "#c62828";
  std::string text;
  for (const json& step : advice) {
    const double x = plan.X(step["position_m"][0].get<double>()),
                 y = plan.Y(step["position_m"][1].get<double>());
    const std::string label =
        fmt::format("{}: {}", step["rank"].get<int>(), step["state"].get<std::string>());
    if (step["kind"] == "photo") {
      text += CameraMark(x, y, step["looking"][0].get<double>(), step["looking"][1].get<double>(), kColour,
                         label);
    } else {
      text += SvgCircle(x, y, 5, fmt::format(" fill=\"{}\"", kColour)) +
              SvgText(x + 8, y + 4, label, fmt::format(" fill=\"{}\"", kColour));
    }
  }
  return text;
}

std::string FluxText(const json& luminaire) {
  const json &flux = luminaire["flux_lm"], &sigma = luminaire["flux_sigma_lm"];
  if (!flux.is_number() || !sigma.is_number()) return "flux undetermined";
  return fmt::format("{:.0f} ± {:.0f} lm", flux.get<double>(), sigma.get<double>());
}

std::string Luminaires(const Plan& plan, const json& luminaires) {
  std::string text;
  for (const json& l : luminaires) {
    const double x = plan.X(l["position_m"][0].get<double>()), y = plan.Y(l["position_m"][1].get<double>());
    const json& size = l["size_m"];
    const std::string style = " fill=\"#ffd84d\" stroke=\"#a67c00\" stroke-width=\"1.5\"";
    if (l["shape"] == "rectangle") {
      const double w = plan.scale * size[0].get<double>(), h = plan.scale * size[1].get<double>();
      text += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"{}/>\n",
                          x - w / 2, y - h / 2, w, h, style);
    } else {
      const double radius = size.empty() ? 0 : 0.5 * plan.scale * size[0].get<double>();
      text += SvgCircle(x, y, std::max(6.0, radius), style);
    }
    const std::string id = l["id"];
    text +=
        SvgText(x + 8, y - 8, l.contains("flux_lm") ? id + ": " + FluxText(l) : id, " font-weight=\"bold\"");
  }
  return text;
}

std::string LuxmeterPoints(const Plan& plan, const Session& session, const json& luxmeter) {
  struct Point {
    double x = 0, y = 0, worst_percent = 0;
  };
  std::map<std::string, Point> points;
  const std::vector<SessionReading>& readings = session.luxmeter.readings;
  for (const json& checked : luxmeter) {
    const std::string id = checked["id"], state = checked["state"];
    const auto reading = std::find_if(readings.begin(), readings.end(), [&](const SessionReading& r) {
      return r.id == id && r.state == state;
    });
    if (reading == readings.end()) continue;
    Point& point = points[id];
    point.x = plan.X(reading->position_m.x());
    point.y = plan.Y(reading->position_m.y());
    const json &measured = checked["measured_lx"], &predicted = checked["predicted_lx"];
    if (!predicted.is_number() || !measured.is_number() || !(measured.get<double>() > 0)) continue;
    const double error = 100 * (predicted.get<double>() / measured.get<double>() - 1);
    if (std::abs(error) > std::abs(point.worst_percent)) point.worst_percent = error;
  }
  std::string text;
  for (const auto& [id, point] : points) {
    const double error = std::abs(point.worst_percent);
    const char* colour = error < 2 ? "#2e8b57" : (error < 5 ? "#e08a00" : "#c62828");
    const std::string fill = fmt::format(" fill=\"{}\"", colour);
    text += SvgCircle(point.x, point.y, 5, fill);
    text += SvgText(point.x + 8, point.y + 4, fmt::format("{} {:+.1f} %", id, point.worst_percent), fill);
  }
  return text;
}

}  // namespace

std::string RoomPlanSvg(const std::string& name, const Scene& scene) {
  if (scene.facets.empty()) return "";
  const Plan plan = PlanOfScene(scene);
  const Eigen::Vector3d size = plan.box.sizes();
  const double height = plan.scale * size.y() + 2 * kPlanMarginPx;
  const std::string text =
      Outlines(plan, scene) + Walls(plan, scene) + MaterialNames(plan, scene) +
      SvgText(
          kPlanMarginPx, height + 8,
          fmt::format("{}: {:.2f} m x {:.2f} m x {:.2f} m. x to the right, y up; the lower left corner is "
                      "({:.2f}, {:.2f}) m.",
                      name, size.x(), size.y(), size.z(), plan.box.min().x(), plan.box.min().y()));
  return SvgDocument(kPlanWidthPx, height + kPlanLegendPx, text);
}

std::string PlanSvg(const Session& session, const Scene& scene, const json& result) {
  if (scene.facets.empty()) return "";
  const Plan plan = PlanOfScene(scene);
  const double height = plan.scale * plan.box.sizes().y() + 2 * kPlanMarginPx;
  const json &summary = result["summary"], &mean = summary["mean_abs_error_percent"];
  std::string text = Outlines(plan, scene) + Cameras(plan, result["views"]) +
                     LuxmeterPoints(plan, session, result["luxmeter"]) +
                     Luminaires(plan, result["luminaires"]);
  text +=
      SvgText(kPlanMarginPx, height + 8,
              fmt::format("{}: {:.1f} m x {:.1f} m. Yellow: fitted luminaires, ± 1 sigma. Blue: registered "
                          "views.",
                          session.name, plan.box.sizes().x(), plan.box.sizes().y()));
  text += SvgText(
      kPlanMarginPx, height + 28,
      fmt::format(
          "Dots: luxmeter points with the worst error of their states (green below 2 %, orange below 5 "
          "%); mean {} over {} readings.",
          mean.is_number() ? fmt::format("{:.2f} %", mean.get<double>()) : "-",
          summary["readings_checked"].get<int>()));
  return SvgDocument(kPlanWidthPx, height + kPlanLegendPx, text);
}

std::string AdvicePlanSvg(const std::string& name, const Scene& scene, const json& result,
                          const json& advice) {
  if (scene.facets.empty()) return "";
  const Plan plan = PlanOfScene(scene);
  const double height = plan.scale * plan.box.sizes().y() + 2 * kPlanMarginPx;
  std::string text = Outlines(plan, scene) + Cameras(plan, result["views"]) +
                     Luminaires(plan, result["luminaires"]) + AdvisedPlaces(plan, advice["advice"]);
  const bool is_guess = advice.contains("assumed");
  text +=
      SvgText(kPlanMarginPx, height + 8,
              fmt::format("{}: red: what to take {}, by rank and state (a wedge: a photo, a dot: a "
                          "reading). {}.",
                          name, is_guess ? "first" : "next",
                          is_guess ? "Yellow: luminaires, given or guessed" : "Blue: views that there are"));
  return SvgDocument(kPlanWidthPx, height + kPlanLegendPx, text);
}

}  // namespace luxfit
