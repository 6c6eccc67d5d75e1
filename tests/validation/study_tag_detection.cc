// Tag detection: speed against accuracy, and where it stops working.
//
//   study_tag_detection -o FOLDER [--quick]
//
// Writes calib_tag_speed.csv|svg (CPU time against corner error of one photo full of tags) and, for sweeps of
// one thing at a time, calib_tag_stability.csv and
// calib_tag_{size,blur,noise,exposure,tilt}_{found,error}.svg. Ends with 1 where tags of 40 px and more in
// good photos are missed or their corners err by more than 0.06 px.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "apps/charts/xy_chart_svg.h"
#include "apps/text/formats/artifact.h"
#include "calib/targets/board.h"
#include "calib/targets/tags.h"
#include "tests/support/calib/board_render.h"
#include "tests/support/calib/tag_scene.h"
#include "tests/support/study_options.h"

namespace luxfit {
namespace {

double CpuS() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Score {
  int tags = 0, found = 0;
  double square_px2 = 0;

  double FoundPercent() const { return 100.0 * found / tags; }
  double RmsPx() const {
    return found > 0 ? std::sqrt(square_px2 / (8 * found)) : std::numeric_limits<double>::quiet_NaN();
  }
};

double SquareError(const std::array<Eigen::Vector2d, 4>& a, const std::array<Eigen::Vector2d, 4>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += (a[k] - b[k]).squaredNorm();
  return sum;
}

// ---- stability ----

struct Conditions {
  double side_px = 48, tilt_deg = 20, exposure = 1;
  support::BoardRenderOptions render;

  Conditions() {
    render.noise_sigma = 0.005;
    render.levels = 255;
  }
};

using Method = std::function<std::vector<TagDetection>(const ImagePlane&, const Camera&)>;

// Clipped pixels move edges: the fit is told which they are.
ImagePlane WithoutClipped(const ImagePlane& grey) {
  return (grey >= 1.0f).select(std::numeric_limits<float>::quiet_NaN(), grey);
}

std::vector<std::pair<std::string, Method>> Methods() {
  const auto detect = [](double enlarge) {
    DetectTagsOptions options;
    options.enlarge = enlarge;
    return options;
  };
  return {{"detector", [=](const ImagePlane& grey, const Camera&) { return DetectTags(grey, detect(1)); }},
          {"detector, photo enlarged by 3",
           [=](const ImagePlane& grey, const Camera&) { return DetectTags(grey, detect(3)); }},
          {"enlarged by 3, corners refined", [=](const ImagePlane& grey, const Camera& camera) {
             return RefineTagCorners(WithoutClipped(grey), camera, DetectTags(grey, detect(3)));
           }}};
}

// By method.
std::vector<Score> ScoreAt(const Conditions& conditions, int photos, std::mt19937_64& rng) {
  const Camera camera = support::OffAxisCamera(static_cast<int>(2.6 * conditions.side_px) + 24);
  const support::BoardRenderer renderer(camera);
  const auto methods = Methods();
  std::vector<Score> scores(methods.size());
  for (int i = 0; i < photos; ++i) {
    const support::TagScene scene =
        support::MakeTagScene(camera, conditions.side_px, conditions.tilt_deg * M_PI / 180, rng);
    // The drawing's origin is the tag's top-left corner, x right, y down, z into the wall.
    Eigen::Isometry3d world_from_tag = Eigen::Isometry3d::Identity();
    world_from_tag.linear() << scene.tag.up_in_world.cross(scene.tag.normal_in_world), -scene.tag.up_in_world,
        -scene.tag.normal_in_world;
    world_from_tag.translation() = TagCornersInWorld(scene.tag)[0];
    support::BoardRenderOptions render = conditions.render;
    render.exposure = conditions.exposure;
    const ImagePlane grey =
        renderer.Render(scene.cam_from_world * world_from_tag,
                        DrawSingleTag("tag36h11", scene.tag.id, scene.tag.size_m), rng, render);
    const std::array<Eigen::Vector2d, 4> truth = scene.CornersPx(camera);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      ++scores[m].tags;
      for (const TagDetection& tag : methods[m].second(grey, camera)) {
        const double square_px2 = SquareError(tag.corners_px, truth);
        if (tag.id != scene.tag.id || square_px2 > 4 * std::pow(conditions.side_px / 4, 2)) continue;
        ++scores[m].found;
        scores[m].square_px2 += square_px2;
        break;
      }
    }
  }
  return scores;
}

struct Sweep {
  std::string name, label;
  bool is_log = false;
  std::vector<double> values;
  std::function<void(Conditions&, double)> set;
};

std::vector<Sweep> Sweeps(bool is_quick) {
  std::vector<Sweep> sweeps = {{"size",
                                "side of the black square, px",
                                true,
                                {8, 10, 12, 14, 16, 20, 24, 32, 40, 56, 80, 120},
                                [](Conditions& c, double v) { c.side_px = v; }},
                               {"blur",
                                "lens blur (sigma), px; tags of 48 px",
                                false,
                                {0.2, 0.5, 0.7, 1, 1.4, 1.8, 2.2, 2.6, 3, 3.5, 4},
                                [](Conditions& c, double v) { c.render.blur_px = v; }},
                               {"noise",
                                "noise (sigma), percent of full scale; tags of 48 px",
                                false,
                                {0, 0.5, 1, 2, 4, 6, 8, 10, 13, 16},
                                [](Conditions& c, double v) { c.render.noise_sigma = v / 100; }},
                               {"exposure",
                                "exposure, stops from white at 0.85 of full scale; tags of 48 px",
                                false,
                                {-8, -7, -6, -5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5},
                                [](Conditions& c, double v) { c.exposure = std::exp2(v); }},
                               {"tilt",
                                "tilt, degrees; tags of 48 px before it",
                                false,
                                {0, 20, 40, 50, 60, 65, 70, 75, 80, 84},
                                [](Conditions& c, double v) { c.tilt_deg = v; }}};
  if (is_quick) {
    for (Sweep& sweep : sweeps) sweep.values = {sweep.values[sweep.values.size() / 2 + 1]};
  }
  return sweeps;
}

XyChart ChartOf(const Sweep& sweep, const std::string& title, const std::string& y, bool is_log) {
  XyChart chart;
  chart.title = title;
  chart.subtitle = "tag36h11, tilt 20 degrees, blur 0.7 px, noise 0.5 %, 8 bits where not swept";
  chart.x.label = sweep.label;
  chart.x.is_log = sweep.is_log;
  chart.y.label = y;
  chart.y.is_log = is_log;
  return chart;
}

// Whether good photos gave what they must.
bool StudyStability(const std::string& folder, bool is_quick) {
  std::string csv = "sweep,value,method,found_percent,corner_rms_px\n";
  bool is_good = true;
  for (const Sweep& sweep : Sweeps(is_quick)) {
    std::map<std::string, XySeries> found, error;
    for (const double value : sweep.values) {
      std::mt19937_64 rng(20260727);
      Conditions conditions;
      sweep.set(conditions, value);
      const std::vector<Score> scores = ScoreAt(conditions, is_quick ? 4 : 30, rng);
      for (std::size_t m = 0; m < scores.size(); ++m) {
        const std::string name = Methods()[m].first;
        found[name].points.emplace_back(value, scores[m].FoundPercent());
        error[name].points.emplace_back(value, scores[m].RmsPx());
        csv += fmt::format("{},{:g},\"{}\",{:.1f},{:.4f}\n", sweep.name, value, name,
                           scores[m].FoundPercent(), scores[m].RmsPx());
      }
      const bool is_easy = sweep.name == "size" && value >= 40;
      if (is_easy)
        is_good = is_good && scores.back().found == scores.back().tags && scores.back().RmsPx() < 0.06;
    }
    XyChart share = ChartOf(sweep, "Tags found", "tags found, percent", false);
    share.y.min = 0;
    share.y.max = 105;
    XyChart rms = ChartOf(sweep, "Corner error of tags found", "rms an axis, px", true);
    for (const auto& [name, method] : Methods()) {
      share.series.push_back({name, found[name].points, {}, true});
      rms.series.push_back({name, error[name].points, {}, true});
    }
    WriteText(folder + "/calib_tag_" + sweep.name + "_found.svg", XyChartsSvg({share}));
    WriteText(folder + "/calib_tag_" + sweep.name + "_error.svg", XyChartsSvg({rms}));
    std::printf("%s\n", sweep.name.c_str());
  }
  WriteText(folder + "/calib_tag_stability.csv", csv);
  return is_good;
}

// ---- speed against accuracy ----

struct WallPhoto {
  Board board;
  Camera camera;
  ImagePlane grey;
  std::vector<Eigen::Vector2d> corners_px;  // by the board's numbers
};

// A wall of tags seen at 60 degrees: near ones several times as large as far ones.
WallPhoto MakeWallPhoto(bool is_quick) {
  WallPhoto photo;
  photo.board.columns = is_quick ? 6 : 20;
  photo.board.rows = is_quick ? 4 : 14;
  photo.board.tag_size_m = 0.1;
  photo.board.spacing = 0.5;
  photo.camera.width_px = is_quick ? 1000 : 4000;
  photo.camera.height_px = is_quick ? 750 : 3000;
  photo.camera.fx_px = photo.camera.fy_px = 0.8 * photo.camera.width_px;
  photo.camera.cx_px = photo.camera.width_px / 2.0;
  photo.camera.cy_px = photo.camera.height_px / 2.0;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      (Eigen::AngleAxisd(-1.05, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  const double width_m = 0.15 * photo.board.columns;
  pose.translation() =
      Eigen::Vector3d(0, 0, 1.1 * width_m) - pose.linear() * (BoardCorners(photo.board).back() / 2);
  std::mt19937_64 rng(20260727);
  support::BoardRenderOptions render;
  render.noise_sigma = 0.005;
  render.levels = 255;
  photo.grey = support::BoardRenderer(photo.camera).Render(pose, DrawBoard(photo.board), rng, render);
  for (const Eigen::Vector3d& corner : BoardCorners(photo.board))
    photo.corners_px.push_back(Project(photo.camera, pose * corner));
  return photo;
}

// Of the tag with this id; the board is numbered from the bottom left.
std::array<Eigen::Vector2d, 4> TruthOf(const WallPhoto& photo, int id) {
  const int across = 2 * photo.board.columns, row = photo.board.rows - 1 - id / photo.board.columns;
  const auto first = static_cast<std::size_t>(2 * row * across + 2 * (id % photo.board.columns));
  const auto below = first + static_cast<std::size_t>(across);
  return {photo.corners_px[first], photo.corners_px[first + 1], photo.corners_px[below + 1],
          photo.corners_px[below]};
}

struct SpeedPoint {
  std::string series, label;
  double cpu_s = 0;
  Score score;
};

SpeedPoint Timed(const WallPhoto& photo, const std::string& series, const std::string& label,
                 const std::function<std::vector<TagDetection>()>& detect) {
  SpeedPoint point{series, label, 0, {}};
  const double start_s = CpuS();
  const std::vector<TagDetection> tags = detect();
  point.cpu_s = CpuS() - start_s;
  point.score.tags = photo.board.columns * photo.board.rows;
  for (const TagDetection& tag : tags) {
    if (tag.id >= point.score.tags) continue;
    const double square_px2 = SquareError(tag.corners_px, TruthOf(photo, tag.id));
    if (square_px2 > 4 * 9) continue;
    ++point.score.found;
    point.score.square_px2 += square_px2;
  }
  return point;
}

// DetectBoard's corners, tag by tag.
std::vector<TagDetection> BoardAsTags(const WallPhoto& photo) {
  const BoardDetection detection = DetectBoard(photo.grey, photo.board);
  std::map<int, Eigen::Vector2d> corners;
  for (const BoardCorner& corner : detection.corners) corners[corner.index] = corner.pixel;
  std::vector<TagDetection> tags;
  for (int id = 0; id < photo.board.columns * photo.board.rows; ++id) {
    const int across = 2 * photo.board.columns, row = photo.board.rows - 1 - id / photo.board.columns;
    const int first = 2 * row * across + 2 * (id % photo.board.columns);
    const std::array<int, 4> indices = {first, first + 1, first + across + 1, first + across};
    TagDetection tag;
    tag.id = id;
    bool is_whole = true;
    for (std::size_t k = 0; k < 4; ++k) {
      is_whole = is_whole && corners.count(indices[k]) > 0;
      if (is_whole) tag.corners_px[k] = corners[indices[k]];
    }
    if (is_whole) tags.push_back(tag);
  }
  return tags;
}

std::vector<SpeedPoint> SpeedPoints(const WallPhoto& photo) {
  const auto detect = [&](double decimate, bool refine_edges, double enlarge) {
    DetectTagsOptions options;
    options.decimate = decimate;
    options.refine_edges = refine_edges;
    options.enlarge = enlarge;
    return DetectTags(photo.grey, options);
  };
  std::vector<SpeedPoint> points;
  for (const double decimate : {1.0, 1.5, 2.0, 3.0, 4.0}) {
    const std::string label = fmt::format("{:g}", decimate);
    points.push_back(Timed(photo, "edges as found", label, [&] { return detect(decimate, false, 1); }));
    points.push_back(Timed(photo, "edges refined", label, [&] { return detect(decimate, true, 1); }));
    points.push_back(Timed(photo, "edges refined, pictures fitted", label, [&] {
      return RefineTagCorners(photo.grey, photo.camera, detect(decimate, true, 1));
    }));
  }
  points.push_back(Timed(photo, "edges refined", "enlarged by 2", [&] { return detect(1, true, 2); }));
  points.push_back(Timed(photo, "as one board (DetectBoard)", "", [&] { return BoardAsTags(photo); }));
  return points;
}

void StudySpeed(const std::string& folder, bool is_quick) {
  const WallPhoto photo = MakeWallPhoto(is_quick);
  double least_px = std::numeric_limits<double>::infinity(), most_px = 0;
  for (int id = 0; id < photo.board.columns * photo.board.rows; ++id) {
    const std::array<Eigen::Vector2d, 4> c = TruthOf(photo, id);
    double side_px = 0;
    for (std::size_t k = 0; k < 4; ++k) side_px += (c[(k + 1) % 4] - c[k]).norm() / 4;
    least_px = std::min(least_px, side_px);
    most_px = std::max(most_px, side_px);
  }
  std::string csv = "corners,decimation,cpu_s,found_percent,corner_rms_px\n";
  XyChart chart;
  chart.title = "Tag detection: speed against accuracy";
  chart.subtitle = fmt::format(
      "{} tags of {:.0f} to {:.0f} px, 60 degrees oblique, {:.1f} megapixels; decimation, "
      "tags found",
      photo.board.columns * photo.board.rows, least_px, most_px,
      1e-6 * static_cast<double>(photo.grey.size()));
  chart.x = {"CPU time, s", true, {}, {}};
  chart.y = {"corner error of tags found, rms an axis, px", true, {}, {}};
  for (const SpeedPoint& point : SpeedPoints(photo)) {
    csv += fmt::format("\"{}\",{},{:.3f},{:.1f},{:.4f}\n", point.series, point.label, point.cpu_s,
                       point.score.FoundPercent(), point.score.RmsPx());
    auto series = std::find_if(chart.series.begin(), chart.series.end(),
                               [&](const XySeries& s) { return s.name == point.series; });
    if (series == chart.series.end())
      series = chart.series.insert(chart.series.end(), XySeries{point.series, {}, {}, false});
    series->points.emplace_back(point.cpu_s, point.score.RmsPx());
    // One series with labels tells them all: the others lie above and below it.
    const bool has_label = point.series == "edges as found" || point.label.size() > 3;
    series->labels.push_back(has_label ? fmt::format("{}: {:.0f} %", point.label, point.score.FoundPercent())
                                       : "");
  }
  WriteText(folder + "/calib_tag_speed.csv", csv);
  WriteText(folder + "/calib_tag_speed.svg", XyChartsSvg({chart}));
  std::printf("%s", csv.c_str());
}

}  // namespace
}  // namespace luxfit

int main(int argc, char** argv) {
  const auto options = luxfit::support::ReadStudyOptions(argc, argv);
  if (!options) return 2;
  luxfit::StudySpeed(options->folder, options->is_quick);
  return luxfit::StudyStability(options->folder, options->is_quick) ? 0 : 1;
}
