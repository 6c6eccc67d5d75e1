// Registration: speed against accuracy, and where it stops working.
//
//   study_registration -o FOLDER [--quick]
//
// Writes calib_registration_pnp.csv|svg (methods of one view's pose: time against error),
// calib_registration_methods.csv|svg (tags, features and both against the number of surveyed tags),
// calib_registration_bundle.csv|svg (time against views and points) and, for sweeps of one thing at a time,
// calib_registration_stability.csv and calib_registration_{tags,focal,survey,outliers,flips}.svg. Ends with 1
// where good photos of twelve tags lose a view, or where any view of a sweep without a wrong camera is given
// a pose that is wrong beyond its sigma more than once in fifty.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <opencv2/calib3d.hpp>
#include <random>
#include <string>
#include <vector>

#include "apps/charts/xy_chart_svg.h"
#include "apps/text/formats/artifact.h"
#include "calib/luminance/median.h"
#include "calib/register/mesh_alignment.h"
#include "calib/register/registration.h"
#include "tests/support/calib/feature_room.h"
#include "tests/support/study_options.h"

namespace luxfit {
namespace {

using support::FeatureRoom;

constexpr double kCornerNoisePx = 0.1;

double CpuS() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double ErrorM(const RegisteredView& view, const FeatureRoom& room) {
  const auto v = static_cast<std::size_t>(std::stoi(view.view.substr(1)));
  return support::PoseError(view, room.poses[v]).tail<3>().norm();
}

std::vector<ViewDetections> DetectAll(const FeatureRoom& room, std::mt19937_64& rng) {
  std::vector<ViewDetections> views;
  for (std::size_t v = 0; v < room.poses.size(); ++v)
    views.push_back(support::DetectTagsOf(room, room.tags, v, kCornerNoisePx, rng));
  return views;
}

void Save(const std::string& folder, const std::string& name, const std::string& csv, const XyChart& chart) {
  WriteText(folder + "/" + name + ".csv", csv);
  WriteText(folder + "/" + name + ".svg", XyChartsSvg({chart}));
}

// ---- methods of one view's pose ----

struct Pairs {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
};

Pairs PairsOf(const FeatureRoom& room, const ViewDetections& view) {
  Pairs pairs;
  for (const TagDetection& detection : view.tags) {
    const auto corners = TagCornersInWorld(room.tags[static_cast<std::size_t>(detection.id)]);
    for (std::size_t i = 0; i < 4; ++i) {
      pairs.points.emplace_back(corners[i].x(), corners[i].y(), corners[i].z());
      pairs.pixels.emplace_back(detection.corners_px[i].x(), detection.corners_px[i].y());
    }
  }
  return pairs;
}

// The camera centre by OpenCV's method; NaN where it gives none.
Eigen::Vector3d CentreByOpenCv(const Camera& camera, const Pairs& pairs, cv::SolvePnPMethod method) {
  const cv::Matx33d matrix(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  cv::Vec3d r, t;
  try {
    if (!cv::solvePnP(pairs.points, pairs.pixels, matrix, distortion, r, t, false, method))
      return Eigen::Vector3d::Constant(std::nan(""));
  } catch (const cv::Exception&) {
    return Eigen::Vector3d::Constant(std::nan(""));
  }
  cv::Matx33d rotation;
  cv::Rodrigues(r, rotation);
  const cv::Vec3d centre = -(rotation.t() * t);
  return {centre[0], centre[1], centre[2]};
}

// One tag on the wall x = 0, or more on two walls, seen obliquely: nothing about these views is ambiguous.
FeatureRoom PnpRoom(int tags, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> uniform(0, 1);
  FeatureRoom room;
  room.camera = OfficeCamera({-0.112, 0.061, 4e-4, -7e-4, 0, 0, 0, 0});
  for (int i = 0; i < tags; ++i) {
    const support::WallPlace place =
        support::OnWall(i % 2 == 0 ? 0 : 2, 0.15 + 0.3 * uniform(rng), 0.4 + 0.3 * uniform(rng));
    room.tags.push_back({i, 0.2, place.p, place.normal, Eigen::Vector3d::UnitZ()});
  }
  const Eigen::Vector3d from(2 + 0.6 * uniform(rng), 2 + 0.6 * uniform(rng), 1.2 + 0.6 * uniform(rng));
  const Eigen::Vector3d at = tags == 1 ? room.tags[0].center_in_world : Eigen::Vector3d(0.3, 0.3, 1.4);
  room.poses = {support::LookAt(from, at)};
  return room;
}

struct PnpMethod {
  std::string name;
  std::function<Eigen::Vector3d(const FeatureRoom&, const ViewDetections&)> centre;
  bool is_planar = false;  // for points of one plane only
};

std::vector<PnpMethod> PnpMethods() {
  const auto by_opencv = [](cv::SolvePnPMethod method) {
    return [method](const FeatureRoom& room, const ViewDetections& view) {
      return CentreByOpenCv(room.camera, PairsOf(room, view), method);
    };
  };
  return {
      {"IPPE", by_opencv(cv::SOLVEPNP_IPPE), true},
      {"SQPNP", by_opencv(cv::SOLVEPNP_SQPNP)},
      {"EPNP", by_opencv(cv::SOLVEPNP_EPNP)},
      {"iterative", by_opencv(cv::SOLVEPNP_ITERATIVE)},
      {"ours, with covariance", [](const FeatureRoom& room, const ViewDetections& view) -> Eigen::Vector3d {
         RegisterViewsOptions options;
         options.survey_sigma_m = options.tag_size_sigma = 0;
         options.max_rotation_sigma_rad = 1;
         const Registration registration = RegisterViews({room.camera}, room.tags, {view}, options);
         if (registration.views.empty()) return Eigen::Vector3d::Constant(std::nan(""));
         return registration.views[0].cam_from_world.inverse().translation();
       }}};
}

void StudyPnp(const std::string& folder, bool is_quick) {
  const int draws = is_quick ? 5 : 200;
  std::string csv = "method,tags,time_ms,median_error_mm,found_percent\n";
  XyChart chart{"One view's pose from its tags",
                fmt::format("{} views, tags of 0.2 m at 2 to 3.5 m, corners {} px rms; labels: tags", draws,
                            kCornerNoisePx),
                {"CPU time, ms", true, {}, {}},
                {"camera centre, median error, mm", true, {}, {}},
                {}};
  for (const PnpMethod& method : PnpMethods()) {
    XySeries series;
    series.name = method.name;
    for (const int tags : {1, 2, 4, 8}) {
      if (method.is_planar && tags > 1) continue;
      std::mt19937_64 rng(static_cast<std::uint64_t>(tags));
      std::vector<double> errors;
      double time_s = 0;
      int tried = 0;
      for (int draw = 0; draw < draws; ++draw) {
        const FeatureRoom room = PnpRoom(tags, rng);
        const ViewDetections view = support::DetectTagsOf(room, room.tags, 0, kCornerNoisePx, rng);
        if (static_cast<int>(view.tags.size()) < tags) continue;
        ++tried;
        const double start_s = CpuS();
        const Eigen::Vector3d centre = method.centre(room, view);
        time_s += CpuS() - start_s;
        if (centre.allFinite()) errors.push_back((centre - room.poses[0].inverse().translation()).norm());
      }
      const double time_ms = 1000 * time_s / std::max(1, tried), error_mm = 1000 * Median(errors);
      csv += fmt::format("\"{}\",{},{:.4g},{:.4g},{:.1f}\n", method.name, tags, time_ms, error_mm,
                         100.0 * static_cast<double>(errors.size()) / std::max(1, tried));
      series.points.emplace_back(time_ms, error_mm);
      series.labels.push_back(std::to_string(tags));
    }
    chart.series.push_back(series);
  }
  Save(folder, "calib_registration_pnp", csv, chart);
}

// ---- tags, features, both ----

TriangleSurface SurfaceOfRoom() {
  TriangleSurface surface;
  surface.vertices_m.resize(3, 8);
  for (int i = 0; i < 8; ++i) {
    surface.vertices_m.col(i) << ((i & 1) != 0 ? support::kRoomSize[0] : 0),
        ((i & 2) != 0 ? support::kRoomSize[1] : 0), ((i & 4) != 0 ? support::kRoomSize[2] : 0);
  }
  const int sides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                           {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  surface.triangles.resize(3, 12);
  for (int side = 0; side < 6; ++side) {
    const int* const c = sides[side];
    surface.triangles.col(2 * static_cast<Eigen::Index>(side)) << c[0], c[1], c[2];
    surface.triangles.col(2 * static_cast<Eigen::Index>(side) + 1) << c[0], c[2], c[3];
  }
  return surface;
}

Registration ByFeatures(const FeatureRoom& room, const FeatureModel& features) {
  Eigen::Matrix3Xd points(3, features.tracks.size());
  for (std::size_t i = 0; i < features.tracks.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = features.tracks[i].p_in_model;
  std::map<std::string, Eigen::Vector3d> places;
  std::vector<ViewDetections> views;
  for (std::size_t v = 0; v < room.poses.size(); ++v) {
    places[support::ViewName(v)] = room.poses[v].inverse().translation() + Eigen::Vector3d(0.15, -0.1, 0.1);
    views.push_back({support::ViewName(v), 0, {}});
  }
  const std::optional<Similarity> start = StartFromPlaces(features.views, places);
  if (!start) return {};
  const SurfaceAlignment alignment = AlignPointsToSurface(points, SurfaceOfRoom(), *start);
  if (!alignment.is_determined) return {};
  return RegisterViews({room.camera}, {}, views, OnSurface(features, alignment));
}

struct MethodScore {
  std::vector<double> errors_m;
  double registered = 0, views = 0;

  void Add(const Registration& registration, const FeatureRoom& room) {
    views += static_cast<double>(room.poses.size());
    registered += static_cast<double>(registration.views.size());
    for (const RegisteredView& view : registration.views) errors_m.push_back(ErrorM(view, room));
  }
};

FeatureRoom RoomWithFloor(int views, int tags, int points, std::mt19937_64& rng) {
  FeatureRoom room = support::MakeFeatureRoom(views, tags, points, rng);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < points / 3; ++i)
    room.points.emplace_back(support::kRoomSize[0] * uniform(rng), support::kRoomSize[1] * uniform(rng), 0);
  return room;
}

void StudyMethods(const std::string& folder, bool is_quick) {
  const int draws = is_quick ? 1 : 10;
  std::string csv = "surveyed_tags,method,registered_percent,median_error_mm\n";
  XyChart chart{"Tags, features and both",
                "10 views of a 6 m x 4 m room, 300 feature points at 0.4 px, survey 1 mm; labels: % of "
                "views registered",
                {"surveyed tags in the room", true, {}, {}},
                {"camera centre, median error, mm", true, {}, {}},
                {{"tags", {}, {}}, {"features on the mesh", {}, {}}, {"both", {}, {}}}};
  for (const int tags : {1, 2, 4, 8, 16, 32}) {
    MethodScore scores[3];
    std::mt19937_64 rng(static_cast<std::uint64_t>(100 + tags));
    std::normal_distribution<double> normal(0, 1);
    for (int draw = 0; draw < draws; ++draw) {
      const FeatureRoom room = RoomWithFloor(10, tags, 300, rng);
      std::vector<SurveyedTag> survey = room.tags;
      for (SurveyedTag& tag : survey)
        tag.center_in_world += 0.001 * Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
      const std::vector<ViewDetections> detections = DetectAll(room, rng);
      const FeatureModel features =
          support::FeaturesOfRoom(room, {0.4, 0, 0.005}, support::AnySimilarity(), rng);
      scores[0].Add(RegisterViews({room.camera}, survey, detections), room);
      scores[1].Add(ByFeatures(room, features), room);
      scores[2].Add(RegisterViews({room.camera}, survey, detections, features), room);
    }
    for (std::size_t m = 0; m < 3; ++m) {
      const double percent = 100 * scores[m].registered / scores[m].views,
                   error_mm = 1000 * Median(scores[m].errors_m);
      csv += fmt::format("{},\"{}\",{:.1f},{:.4g}\n", tags, chart.series[m].name, percent, error_mm);
      chart.series[m].points.emplace_back(tags, error_mm);
      chart.series[m].labels.push_back(fmt::format("{:.0f}", percent));
    }
  }
  Save(folder, "calib_registration_methods", csv, chart);
}

// ---- size of the bundle ----

void StudyBundle(const std::string& folder, bool is_quick) {
  std::string csv = "views,points,observations,cpu_s,median_error_mm\n";
  XyChart chart{"Time of the joint adjustment",
                "start, outliers, sigmas and covariance included; points at 0.3 px, 40 tags in the room",
                {"views", true, {}, {}},
                {"CPU time, s", true, {}, {}},
                {}};
  for (const int points : {0, 300, 1000, 3000}) {
    XySeries series;
    series.name = points == 0 ? "tags alone" : fmt::format("{} points", points);
    for (const int views : {5, 10, 20, 50, 100}) {
      if ((is_quick && views > 10) || views * points > 100000) continue;
      std::mt19937_64 rng(static_cast<std::uint64_t>(views + points));
      const FeatureRoom room = support::MakeFeatureRoom(views, 40, points, rng);
      const std::vector<ViewDetections> detections = DetectAll(room, rng);
      const FeatureModel features =
          support::FeaturesOfRoom(room, {0.3, 0, 0.005}, support::AnySimilarity(), rng);
      double observations = 0;
      for (const FeatureTrack& track : features.tracks)
        observations += static_cast<double>(track.seen.size());
      const double start_s = CpuS();
      const Registration registration = points == 0
                                            ? RegisterViews({room.camera}, room.tags, detections)
                                            : RegisterViews({room.camera}, room.tags, detections, features);
      const double time_s = CpuS() - start_s;
      MethodScore score;
      score.Add(registration, room);
      csv += fmt::format("{},{},{:.0f},{:.4g},{:.4g}\n", views, points, points == 0 ? 0 : observations,
                         time_s, 1000 * Median(score.errors_m));
      series.points.emplace_back(views, time_s);
    }
    chart.series.push_back(series);
  }
  Save(folder, "calib_registration_bundle", csv, chart);
}

// ---- stability ----

// What becomes of views: registered within 3 cm or within four sigma, left out, or wrong and not told.
struct Fate {
  double right = 0, left_out = 0, wrong = 0;

  void Add(const Registration& registration, const FeatureRoom& room) {
    left_out += static_cast<double>(room.poses.size() - registration.views.size());
    for (const RegisteredView& view : registration.views) {
      const double error_m = ErrorM(view, room);
      const bool is_right = error_m < 0.03 || error_m < 4 * view.position_sigma_m.norm();
      (is_right ? right : wrong) += 1;
    }
  }
  double Percent(double part) const { return 100 * part / std::max(1.0, right + left_out + wrong); }
};

struct Sweep {
  std::string name, label, subtitle;
  std::vector<double> values;
  // A room, its survey and what is seen of it, for one value.
  std::function<void(double value, std::mt19937_64& rng, Fate& fate)> run;
  bool may_be_wrong = false;  // the camera itself is: no sigma can know
};

FeatureRoom TwelveTags(std::mt19937_64& rng) { return support::MakeFeatureRoom(8, 24, 0, rng); }

void RunTags(double tags, std::mt19937_64& rng, Fate& fate) {
  FeatureRoom room = support::MakeFeatureRoom(1, 40, 0, rng);
  ViewDetections view = support::DetectTagsOf(room, room.tags, 0, kCornerNoisePx, rng);
  std::shuffle(view.tags.begin(), view.tags.end(), rng);
  if (view.tags.size() < static_cast<std::size_t>(tags)) return;
  view.tags.resize(static_cast<std::size_t>(tags));
  fate.Add(RegisterViews({room.camera}, room.tags, {view}), room);
}

void RunFocal(double off_percent, std::mt19937_64& rng, Fate& fate) {
  const FeatureRoom room = TwelveTags(rng);
  Camera camera = room.camera;
  camera.fx_px *= 1 + off_percent / 100;
  camera.fy_px *= 1 + off_percent / 100;
  fate.Add(RegisterViews({camera}, room.tags, DetectAll(room, rng)), room);
}

void RunSurvey(double sigma_mm, std::mt19937_64& rng, Fate& fate) {
  const FeatureRoom room = TwelveTags(rng);
  std::normal_distribution<double> normal(0, 1e-3 * sigma_mm);
  std::vector<SurveyedTag> survey = room.tags;
  for (SurveyedTag& tag : survey)
    tag.center_in_world += Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
  RegisterViewsOptions options;
  options.survey_sigma_m = std::max(1e-3, 1e-3 * sigma_mm);
  fate.Add(RegisterViews({room.camera}, survey, DetectAll(room, rng), options), room);
}

void RunOutliers(double percent, std::mt19937_64& rng, Fate& fate) {
  const FeatureRoom room = TwelveTags(rng);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<ViewDetections> detections = DetectAll(room, rng);
  for (ViewDetections& view : detections) {
    for (TagDetection& tag : view.tags) {
      if (100 * uniform(rng) >= percent) continue;
      const Eigen::Vector2d off(200 * (uniform(rng) - 0.5), 200 * (uniform(rng) - 0.5));
      for (Eigen::Vector2d& corner_px : tag.corners_px) corner_px += off;
    }
  }
  fate.Add(RegisterViews({room.camera}, room.tags, detections), room);
}

void RunFlips(double angle_deg, std::mt19937_64& rng, Fate& fate) {
  std::uniform_real_distribution<double> uniform(0, 1);
  FeatureRoom room = support::MakeFeatureRoom(1, 1, 0, rng);
  room.tags = {{0, 0.2, {0, 2, 1.4}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()}};
  const double angle = angle_deg * M_PI / 180, distance_m = 1.5 + 1.5 * uniform(rng);
  room.poses = {support::LookAt(
      room.tags[0].center_in_world + distance_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.02),
      room.tags[0].center_in_world)};
  const ViewDetections view = support::DetectTagsOf(room, room.tags, 0, kCornerNoisePx, rng);
  if (!view.tags.empty()) fate.Add(RegisterViews({room.camera}, room.tags, {view}), room);
}

std::vector<Sweep> Sweeps() {
  return {{"tags", "tags in the view", "one view alone", {1, 2, 3, 4, 6, 8, 10, 12}, RunTags},
          {"focal",
           "focal length off by, %",
           "8 views, 24 tags",
           {-30, -20, -10, -5, -2, -1, 0, 1, 2, 5, 10, 20, 30},
           RunFocal,
           true},
          {"survey",
           "survey error per axis, mm",
           "8 views, 24 tags; the sigma is told",
           {0, 1, 2, 5, 10, 20, 30, 50},
           RunSurvey},
          {"outliers",
           "detections shifted by up to 100 px, %",
           "8 views, 24 tags",
           {0, 5, 10, 15, 20, 30, 40},
           RunOutliers},
          {"flips",
           "view angle from the normal, degrees",
           "one tag of 0.2 m at 1.5 to 3 m",
           {0, 5, 10, 15, 20, 30, 40, 50, 60, 70},
           RunFlips}};
}

// Whether what good photos give is good.
bool StudyStability(const std::string& folder, bool is_quick) {
  std::string csv = "sweep,value,right_percent,left_out_percent,wrong_percent\n";
  bool is_good = true;
  for (const Sweep& sweep : Sweeps()) {
    const bool single = sweep.name == "tags" || sweep.name == "flips";
    const int draws = single ? (is_quick ? 10 : 150) : (is_quick ? 1 : 12);
    XyChart chart{"Registration: " + sweep.label,
                  fmt::format("{}; corners {} px rms", sweep.subtitle, kCornerNoisePx),
                  {sweep.label, false, {}, {}},
                  {"views, %", false, 0, 100},
                  {{"right", {}, {}}, {"left out and named", {}, {}}, {"wrong beyond its sigma", {}, {}}}};
    for (const double value : sweep.values) {
      std::mt19937_64 rng(17);
      Fate fate;
      for (int draw = 0; draw < draws; ++draw) sweep.run(value, rng, fate);
      const double parts[3] = {fate.Percent(fate.right), fate.Percent(fate.left_out),
                               fate.Percent(fate.wrong)};
      csv += fmt::format("{},{},{:.1f},{:.1f},{:.1f}\n", sweep.name, value, parts[0], parts[1], parts[2]);
      for (std::size_t s = 0; s < 3; ++s) chart.series[s].points.emplace_back(value, parts[s]);
      if (sweep.name == "tags" && value == 12 && parts[0] < 98) is_good = false;
      if (!sweep.may_be_wrong && parts[2] > 2 && !is_quick) is_good = false;
    }
    WriteText(folder + "/calib_registration_" + sweep.name + ".svg", XyChartsSvg({chart}));
  }
  WriteText(folder + "/calib_registration_stability.csv", csv);
  return is_good;
}

}  // namespace
}  // namespace luxfit

int main(int argc, char** argv) {
  const auto options = luxfit::support::ReadStudyOptions(argc, argv);
  if (!options) return 2;
  luxfit::StudyPnp(options->folder, options->is_quick);
  luxfit::StudyMethods(options->folder, options->is_quick);
  luxfit::StudyBundle(options->folder, options->is_quick);
  return luxfit::StudyStability(options->folder, options->is_quick) ? 0 : 1;
}
