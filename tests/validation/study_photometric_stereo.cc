// The classical ways to albedo compared, speed against accuracy: photometric stereo of an object, and of a
// room with and without interreflection.
//   study_photometric_stereo -o FOLDER [--quick] [--sphere FOLDER]
// Writes FOLDER/albedo_study.csv (every point), albedo_stereo_normals.svg, albedo_stereo.svg,
// albedo_stereo_uneven.svg (error against time by number of lights, lights alike and of uneven strength) and
// albedo_room.svg. Truths: a sphere with cast shadows, highlights and a bent curve, ray-cast in closed form;
// a room traced by unbiased Monte Carlo, with a poster that the model does not have. --sphere: the real grey
// and chrome spheres, albedo_sphere.svg beside them; the truth is the sphere's shape and that it is uniform.
// --quick: fewer points, and exit status 1 where robust fitting with a chosen curve is not the best of the
// object, or the room's albedo is off by 2 % and more.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/charts/xy_chart_svg.h"
#include "inverse/albedo/patch_albedo.h"
#include "inverse/albedo/photometric_stereo.h"
#include "inverse/model/fit_luminaires.h"
#include "tests/support/inverse/gray_sphere.h"
#include "tests/support/inverse/poster_room.h"
#include "tests/support/inverse/stereo_scene.h"
#include "tests/support/study_options.h"

namespace {

using luxfit::CurveKind;
using luxfit::PhotometricStereo;
using luxfit::StereoData;
using luxfit::StereoMethod;

struct Variant {
  std::string name;
  StereoMethod method;
  bool curves;  // chosen among all; else Lambert's
};
const std::vector<Variant>& Variants() {
  static const std::vector<Variant> variants{
      {"least squares", StereoMethod::kLeastSquares, false},
      {"without shadows", StereoMethod::kWithoutShadows, false},
      {"robust", StereoMethod::kRobust, false},
      {"robust, strengths unknown", StereoMethod::kRobustStrengths, false},
      {"robust, curve chosen", StereoMethod::kRobust, true},
      {"robust, strengths and curve", StereoMethod::kRobustStrengths, true}};
  return variants;
}

// Processor time, which other programs on the machine do not lengthen.
double TimeMs(const std::function<void()>& run) {
  const std::clock_t start = std::clock();
  run();
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

struct Solved {
  PhotometricStereo result;
  double time_ms = 0;
};
Solved Solve(const Variant& variant, const StereoData& data) {
  luxfit::PhotometricStereoOptions options;
  options.method = variant.method;
  options.covariance = false;
  if (!variant.curves) options.curves = {CurveKind::kLambert};
  Solved solved;
  solved.time_ms = TimeMs([&] { solved.result = luxfit::SolvePhotometricStereo(data, options); });
  return solved;
}

class Study {
 public:
  Study(std::string folder, bool is_quick) : folder_(std::move(folder)), is_quick_(is_quick) {
    std::filesystem::create_directories(folder_);
  }

  // False where the best variant is none with a chosen curve, lights alike.
  bool Object() {
    const bool is_best = ObjectCharts(false, "albedo_stereo_normals.svg", "albedo_stereo.svg");
    ObjectCharts(true, "", "albedo_stereo_uneven.svg");
    return is_best;
  }

  // False where the albedo from measured radiosity is off by 2 % and more.
  bool RoomChart() {
    luxfit::XyChart chart;
    chart.title = "Albedo of a room: with and without interreflection";
    chart.subtitle =
        "luminaires known, a poster that is not in the model; no direct light on the ceiling; labels: "
        "element "
        "size, m";
    chart.x = {"processor time, ms", true, {}, {}};
    chart.y = {"mean error of the materials' albedo, %", true, {}, {}};
    for (const char* name : {"direct light only", "measured radiosity", "radiosity solved"})
      chart.series.push_back({name, {}, {}, true});
    bool is_good = true;
    for (const double size_m : is_quick_ ? std::vector<double>{0.5} : std::vector<double>{0.5, 0.25, 0.125}) {
      const luxfit::Room room = luxfit::support::PosterRoomModel(size_m);
      std::mt19937_64 rng(3);
      const luxfit::LightData data = luxfit::support::PosterRoomData(room, 0.005, 2048, rng);
      for (size_t way = 0; way < chart.series.size(); ++way) {
        Eigen::VectorXd albedo;
        const double time_ms =
            TimeMs([&] { albedo = way < 2 ? FromRatios(room, data, way == 1) : FromFit(room, data); });
        const double error = MeanErrorPercent(albedo, luxfit::support::PosterRoomAlbedo());
        chart.series[way].points.push_back({time_ms, error});
        chart.series[way].labels.push_back(fmt::format("{:g}", size_m));
        Line("room", chart.series[way].name, fmt::format("elements {:g} m", size_m), time_ms, NAN, error);
        if (way == 1 && !(error < 2)) is_good = false;
      }
    }
    Write("albedo_room.svg", luxfit::XyChartsSvg({chart}));
    return is_good;
  }

  void RealSphere(const std::string& data_folder) {
    const luxfit::support::GraySphere set = luxfit::support::ReadGraySphere(data_folder);
    const luxfit::support::GrayPixels pixels = luxfit::support::PixelsOf(set);
    const StereoData given{pixels.value, set.given_lights, {}, {}};
    const StereoData chrome = luxfit::support::WithMirrorSphereLights(set, pixels);
    luxfit::XyChart chart;
    chart.title = "The real grey sphere under twelve lights";
    chart.subtitle = "labels: variant; the best is at the lower left";
    chart.x = {"mean error of normals, degrees", false, 0, 17};
    chart.y = {"albedo: standard deviation over mean, %", false, 0, {}};
    for (const auto& [name, data] : {std::pair<std::string, const StereoData&>{"given directions", given},
                                     {"chrome sphere's", chrome}}) {
      luxfit::XySeries series{name, {}, {}, false};
      for (const Variant& variant : Variants()) {
        const Solved solved = Solve(variant, data);
        const double degrees = luxfit::support::MeanAngleDeg(solved.result.normal, pixels.normal);
        const double variation = luxfit::support::VariationPercent(solved.result.albedo);
        series.points.push_back({degrees, variation});
        series.labels.push_back(variant.name);
        Line("sphere, " + name, variant.name, luxfit::Describe(solved.result.curve), solved.time_ms, degrees,
             variation);
      }
      chart.series.push_back(series);
    }
    Write("albedo_sphere.svg", luxfit::XyChartsSvg({chart}));
  }

  void Close() const {
    std::ofstream(folder_ + "/albedo_study.csv")
        << "scene,variant,setting,processor_time_ms,normal_error_deg,albedo_error_percent\n"
        << csv_;
  }

 private:
  bool ObjectCharts(bool uneven, const std::string& normals_file, const std::string& albedo_file) {
    luxfit::XyChart normals, albedo;
    normals.title = "Photometric stereo: error of normals against time";
    albedo.title = uneven ? "Photometric stereo, lights of uneven strength"
                          : "Photometric stereo: error of albedo against time";
    normals.subtitle = "shadows, highlights, f = mu^0.85, noise 0.5 %, 2800 pixels; labels: lights";
    albedo.subtitle = uneven ? "strengths scatter by 15 %, taken as alike; else as before; labels: lights"
                             : normals.subtitle;
    normals.x = albedo.x = {"processor time, ms", true, {}, {}};
    normals.y = {"mean error of normals, degrees", true, {}, {}};
    albedo.y = {"mean error of albedo, %", true, {}, {}};
    double best = INFINITY, best_of_curve = INFINITY;
    for (const Variant& variant : Variants()) {
      luxfit::XySeries of_normals{variant.name, {}, {}, true}, of_albedo = of_normals;
      for (const int lights : is_quick_ ? std::vector<int>{12} : std::vector<int>{6, 8, 12, 20, 32}) {
        const luxfit::support::StereoPicture picture = PictureOf(lights, uneven);
        const Solved solved = Solve(variant, {picture.value, picture.to_light, {}, {}});
        // Few lights leave some pixels without three that are lit: they are NaN, and counted.
        const std::vector<Eigen::Index> known = KnownPixels(solved.result.albedo);
        const Eigen::Matrix3Xd found = solved.result.normal(Eigen::all, known);
        const Eigen::Matrix3Xd truth = picture.normal(Eigen::all, known);
        const double degrees = luxfit::support::MeanAngleDeg(found, truth);
        const double percent =
            luxfit::support::AlbedoErrorPercent(solved.result.albedo(known), picture.albedo(known));
        const double share = static_cast<double>(known.size()) / static_cast<double>(picture.albedo.size());
        of_normals.points.push_back({solved.time_ms, degrees});
        of_albedo.points.push_back({solved.time_ms, percent});
        of_normals.labels.push_back(std::to_string(lights));
        of_albedo.labels.push_back(std::to_string(lights));
        Line(uneven ? "object, uneven lights" : "object", variant.name,
             fmt::format("{} lights, {}, {:.1f} % of the pixels", lights, ToString(solved.result.curve.kind),
                         100 * share),
             solved.time_ms, degrees, percent);
        if (lights != 12) continue;
        best = std::min(best, degrees);
        if (variant.curves) best_of_curve = std::min(best_of_curve, degrees);
      }
      normals.series.push_back(of_normals);
      albedo.series.push_back(of_albedo);
    }
    if (!normals_file.empty()) Write(normals_file, luxfit::XyChartsSvg({normals}));
    Write(albedo_file, luxfit::XyChartsSvg({albedo}));
    return best_of_curve <= best;
  }

  static std::vector<Eigen::Index> KnownPixels(const Eigen::VectorXd& albedo) {
    std::vector<Eigen::Index> known;
    for (Eigen::Index i = 0; i < albedo.size(); ++i) {
      if (std::isfinite(albedo[i])) known.push_back(i);
    }
    return known;
  }

  // Of the materials that something is known of: the ceiling has no direct light.
  static double MeanErrorPercent(const Eigen::VectorXd& albedo, const Eigen::VectorXd& truth) {
    double sum = 0;
    int count = 0;
    for (Eigen::Index m = 0; m < albedo.size(); ++m) {
      if (!std::isfinite(albedo[m])) continue;
      sum += std::abs(albedo[m] / truth[m] - 1);
      ++count;
    }
    return 100 * sum / count;
  }

  static luxfit::support::StereoPicture PictureOf(int lights, bool uneven) {
    std::mt19937_64 rng(5);
    luxfit::support::StereoScene scene;
    scene.exponent = 0.85;
    std::normal_distribution<double> scatter(0, 0.15);
    for (int k = 0; uneven && k < lights; ++k) scene.strength.push_back(std::exp(scatter(rng)));
    return luxfit::support::RenderStereo(scene, luxfit::support::LightsAround(lights), rng);
  }

  static Eigen::VectorXd FromRatios(const luxfit::Room& room, const luxfit::LightData& data,
                                    bool interreflection) {
    luxfit::PatchAlbedoOptions options;
    options.interreflection = interreflection;
    const luxfit::PatchAlbedo result =
        luxfit::EstimatePatchAlbedo(room, data, luxfit::support::PosterRoomLight(), options);
    return Eigen::Vector3d(result.materials[0].albedo, result.materials[1].albedo,
                           result.materials[2].albedo);
  }

  // The full model with nothing but the albedo free, from a start that knows nothing.
  static Eigen::VectorXd FromFit(const luxfit::Room& room, const luxfit::LightData& data) {
    luxfit::LightState start = luxfit::support::PosterRoomLight();
    for (luxfit::FreeQuantities& free : start.free) free = {false, false, false, false, false};
    start.albedo.setConstant(0.5);
    start.camera_scale_free = false;
    return luxfit::FitLuminaires(room, data, start).state.albedo;
  }

  void Line(const std::string& scene, const std::string& variant, const std::string& setting, double time_ms,
            double degrees, double percent) {
    const std::string angle = std::isfinite(degrees) ? fmt::format("{:.3f}", degrees) : "";
    csv_ += fmt::format("\"{}\",\"{}\",\"{}\",{:.1f},{},{:.3f}\n", scene, variant, setting, time_ms, angle,
                        percent);
    std::printf("%-42s %-26s %-46s %9.1f ms %7s deg %7.2f %%\n", scene.c_str(), variant.c_str(),
                setting.c_str(), time_ms, angle.c_str(), percent);
  }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ + "/" + name) << text;
  }

  std::string folder_, csv_;
  bool is_quick_;
};

}  // namespace

int main(int argc, char** argv) {
  const auto options = luxfit::support::ReadStudyOptions(argc, argv);
  if (!options) return 2;
  Study study(options->folder, options->is_quick);
  const bool object = study.Object();
  const bool room = study.RoomChart();
  if (!options->sphere.empty()) study.RealSphere(options->sphere);
  study.Close();
  return object && room ? 0 : 1;
}
