// How well a response is found, and how fast: Debevec-Malik against Robertson by samples; and where all of it
// fails, by exposures, their distance, noise and saturation.
//   study_response -o FOLDER [--quick]
// Writes FOLDER/calib_response.csv (every point), calib_response.svg (error against time) and
// calib_response_stability.svg (error by number and distance of exposures). Truths are closed
// formulas: a film's S-shaped curve and the encoding of sRGB in 8 bits; samples are means of 3 x 3 pixels of
// a sensor of 20 000 electrons. The error is that of ln exposure between 4 and 96 % of full scale, root mean
// square, after the one free factor. --quick: fewer points, and exit status 1 where a film curve is not found
// to 2 % from 1000 samples.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "apps/charts/xy_chart_svg.h"
#include "calib/luminance/response.h"
#include "tests/support/calib/camera_model.h"
#include "tests/support/study_options.h"

namespace {

using luxfit::BracketSamples;
using luxfit::CameraResponse;
using luxfit::support::CameraModel;

// The inverse of an increasing function on 0..1, by bisection.
double Inverse(const std::function<double(double)>& encoded, double y) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) (encoded((low + high) / 2) < y ? low : high) = (low + high) / 2;
  return low;
}

struct Curve {
  std::string name;
  std::function<double(double)> encoded;
};
const std::vector<Curve>& Curves() {
  static const std::vector<Curve> curves{{"film", luxfit::support::FilmEncoded},
                                         {"sRGB", luxfit::support::SrgbEncoded}};
  return curves;
}

// What one bracket is like.
struct Setup {
  int samples = 1000;
  int exposures = 7;
  double stops = 1;          // between neighbouring exposures
  double full_well = 20000;  // electrons of one pixel
  double brightest = 3.16;   // of the scene, in units of what saturates the middle exposure
};

BracketSamples Shots(const Curve& curve, const Setup& setup, std::mt19937_64& rng) {
  CameraModel camera;
  camera.response = curve.encoded;
  camera.bits = 8;
  camera.full_scale_counts = 255;
  camera.full_well = 9 * setup.full_well;
  // Three and a half decades.
  std::uniform_real_distribution<double> decades(-3.5, 0);
  std::array<luxfit::ImagePlane, 3> scene;
  for (luxfit::ImagePlane& plane : scene) {
    plane.resize(1, setup.samples);
    for (Eigen::Index i = 0; i < plane.size(); ++i)
      plane(0, i) = static_cast<float>(setup.brightest * std::pow(10, decades(rng)));
  }
  BracketSamples bracket;
  bracket.exposure_s.resize(setup.exposures);
  for (Eigen::MatrixXd& counts : bracket.counts) counts.resize(setup.samples, setup.exposures);
  for (int j = 0; j < setup.exposures; ++j) {
    bracket.exposure_s[j] = std::exp2(setup.stops * ((setup.exposures - 1) / 2.0 - j));
    const luxfit::Photo photo = luxfit::support::Shoot(camera, scene, bracket.exposure_s[j], rng);
    for (size_t c = 0; c < 3; ++c)
      bracket.counts[c].col(j) = photo.rgb_counts[c].row(0).transpose().cast<double>();
  }
  return bracket;
}

// Percent.
double ErrorOf(const CameraResponse& response, const Curve& curve) {
  Eigen::ArrayXd error(93);
  for (int i = 0; i < 93; ++i) {
    const double share = 0.04 + 0.01 * i;
    error[i] = std::log(response.Exposure(1, 255 * share) / Inverse(curve.encoded, share));
  }
  return 100 * std::sqrt((error - error.mean()).square().mean());
}

struct Timed {
  double error_percent, time_ms;
};
// Processor time, which other programs on the machine do not lengthen; everything here runs in one thread.
Timed Time(const std::function<std::optional<CameraResponse>()>& solve, const Curve& curve) {
  const std::clock_t start = std::clock();
  const std::optional<CameraResponse> response = solve();
  const double time_ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return {response ? ErrorOf(*response, curve) : NAN, time_ms};
}

class Study {
 public:
  Study(std::string folder, bool is_quick) : folder_(std::move(folder)), is_quick_(is_quick) {}

  // False where a film curve is not found to 2 % from 1000 samples.
  bool SpeedAndAccuracy() {
    luxfit::XyChart chart;
    chart.title = "Response of a camera: error against time";
    chart.subtitle = "50 to 10 000 samples of 7 exposures one stop apart, 8 bits; labels: samples";
    chart.x = {"processor time, ms", true, {}, {}};
    chart.y = {"rms error of ln exposure, %", true, {}, {}};
    bool is_found = true;
    const std::vector<int> counts = is_quick_ ? std::vector<int>{100, 1000}
                                              : std::vector<int>{50, 100, 200, 500, 1000, 2000, 5000, 10000};
    for (const Curve& curve : Curves()) {
      for (const std::string method : {"Debevec-Malik", "Robertson", "chosen"}) {
        luxfit::XySeries series{method + ", " + curve.name, {}, {}, true};
        for (const int count : counts) {
          if (method == "chosen" && count != 100 && count != 1000) continue;
          const Timed timed = Averaged(method, curve, {count}, "samples", count);
          series.points.push_back({timed.time_ms, timed.error_percent});
          // Points of some series lie close together: the ends will do.
          const bool is_end = count == counts.front() || count == counts.back();
          series.labels.push_back(is_end ? std::to_string(count) : "");
          if (method == "chosen" && count == 1000 && !(timed.error_percent < 2)) is_found = false;
        }
        chart.series.push_back(series);
      }
    }
    Write("calib_response.svg", luxfit::XyChartsSvg({chart}));
    return is_found;
  }

  void Stability() {
    luxfit::XyChart chart;
    chart.title = "Response of a camera: error by bracket";
    chart.subtitle =
        "film, 600 samples, 8 bits, mean of 4 brackets; two exposures determine nothing and are not drawn";
    chart.x = {"exposures in the bracket", false, {}, {}};
    chart.y = {"rms error of ln exposure, %", true, {}, {}};
    for (const double stops : {0.5, 1.0, 2.0, 3.0}) {
      luxfit::XySeries series{fmt::format("{:g} stops apart", stops), {}, {}, true};
      for (const int exposures : is_quick_ ? std::vector<int>{4} : std::vector<int>{2, 3, 4, 5, 7}) {
        Setup setup{600, exposures, stops};
        series.points.push_back(
            {exposures, MeanError(setup, fmt::format("exposures, {:g} stops", stops), exposures)});
      }
      chart.series.push_back(series);
    }
    Write("calib_response_stability.svg", luxfit::XyChartsSvg({chart}));
    for (const double full_well :
         is_quick_ ? std::vector<double>{} : std::vector<double>{20, 100, 500, 2000, 20000})
      MeanError({600, 7, 1, full_well}, "full well, electrons", full_well);
    for (const double brightest :
         is_quick_ ? std::vector<double>{} : std::vector<double>{0.1, 0.3, 1, 10, 30, 100})
      MeanError({600, 7, 1, 20000, brightest}, "brightest over saturation", brightest);
  }

  void WriteTable() const { Write("calib_response.csv", csv_); }

 private:
  int Seeds() const { return is_quick_ ? 2 : 4; }

  static std::optional<CameraResponse> Solve(const std::string& method,
                                             const std::vector<BracketSamples>& samples) {
    if (method == "Debevec-Malik") return luxfit::SolveDebevec(samples, {});
    if (method == "Robertson") return luxfit::SolveRobertson(samples, {});
    return luxfit::EstimateResponse(samples, {}).response;
  }

  Timed Averaged(const std::string& method, const Curve& curve, const Setup& setup, const std::string& sweep,
                 double value) {
    const int seeds = is_quick_ || method == "chosen" ? 1 : 3;
    Timed sum{0, 0};
    for (int seed = 0; seed < seeds; ++seed) {
      std::mt19937_64 rng(static_cast<unsigned>(1000 * seed + setup.samples));
      const std::vector<BracketSamples> samples{Shots(curve, setup, rng)};
      const Timed timed = Time([&] { return Solve(method, samples); }, curve);
      sum.error_percent += timed.error_percent / seeds;
      sum.time_ms += timed.time_ms / seeds;
    }
    csv_ += fmt::format("{},{},{},{:g},{:.4f},{:.2f},\n", sweep, curve.name, method, value, sum.error_percent,
                        sum.time_ms);
    return sum;
  }

  double MeanError(const Setup& setup, const std::string& sweep, double value) {
    const Curve& film = Curves()[0];
    double found = 0, error_sum = 0;
    for (int seed = 0; seed < Seeds(); ++seed) {
      std::mt19937_64 rng(static_cast<unsigned>(seed + 1));
      const auto response = Solve("chosen", {Shots(film, setup, rng)});
      const double error = response ? ErrorOf(*response, film) : NAN;
      error_sum += error;
      if (error < 3) found += 100.0 / Seeds();
    }
    csv_ += fmt::format("\"{}\",film,chosen,{:g},{:.4f},,{:.0f}\n", sweep, value, error_sum / Seeds(), found);
    return error_sum / Seeds();
  }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(std::filesystem::path(folder_) / name) << text;
  }

  std::string folder_;
  bool is_quick_;
  std::string csv_ = "sweep,curve,method,value,rms_error_percent,time_ms,found_percent\n";
};

}  // namespace

int main(int argc, char** argv) {
  const auto options = luxfit::support::ReadStudyOptions(argc, argv);
  if (!options) return 2;
  Study study(options->folder, options->is_quick);
  const bool is_found = study.SpeedAndAccuracy();
  study.Stability();
  study.WriteTable();
  if (!is_found)
    std::fprintf(stderr, "study_response: a film curve was not found to 2 %% from 1000 samples\n");
  return is_found ? 0 : 1;
}
