// Lens calibration: speed against accuracy of lens models and image counts, and where it stops working.
//
//   study_lens_models -o FOLDER [--quick]
//
// Boards of known truth (OpenCV's projection, 0.3 px of noise). Writes calib_lens_models.csv and
// calib_lens_models_{opencv8,fisheye}.svg (CPU time against the error of directions over the inner 80 % of
// the image, one line a lens, one point an image count), and calib_lens_stability.csv with
// calib_lens_{outliers,focal_start,images,tilt}.svg: of several seeds, how many calibrations are right, how
// many are refused, and how many are wrong and pass. Ends with 1 where one is wrong by more than 1 % of the
// focal length and passes, or where a plain set of images fails.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "apps/charts/xy_chart_svg.h"
#include "apps/text/formats/artifact.h"
#include "calib/calibrate/calibration.h"
#include "calib/luminance/median.h"
#include "tests/support/calib/board_views.h"
#include "tests/support/study_options.h"

namespace luxfit {
namespace {

using support::BoardViewsOptions;

double CpuS() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Truth {
  std::string name;
  Camera camera;
  double nearest_m, farthest_m;
  std::vector<std::string> lenses;
};

std::vector<Truth> Truths() {
  return {{"opencv8",
           support::OpenCv8Camera(),
           0.35,
           0.9,
           {"opencv4", "opencv5", "opencv8", "opencv12", "splined8", "splined12"}},
          {"fisheye",
           support::FisheyeCamera(),
           0.15,
           0.45,
           {"opencv5", "opencv8", "fisheye", "splined8", "splined12"}}};
}

CalibrationInput Views(const Truth& truth, int images, unsigned seed) {
  std::mt19937_64 rng(seed);
  BoardViewsOptions options;
  options.images = images;
  options.nearest_m = truth.nearest_m;
  options.farthest_m = truth.farthest_m;
  return support::ViewsOf(truth.camera, options, rng);
}

struct Measured {
  double time_s = 0, error_px = 0, held_out_px = 0, rms_px = 0;
};

// Medians over the seeds; NaN where no fit came of it.
Measured Measure(const Truth& truth, const std::string& lens, int images, int seeds) {
  std::vector<double> times, errors, held_out, rms;
  CalibrateCamerasOptions options;
  options.lenses = {*LensKindOf(lens)};
  for (int seed = 0; seed < seeds; ++seed) {
    const CalibrationInput input = Views(truth, images, static_cast<unsigned>(seed + 1));
    const double start_s = CpuS();
    const Calibration result = CalibrateCameras(input, options);
    if (!result.converged) continue;
    times.push_back(CpuS() - start_s);
    errors.push_back(support::LensDifferencePx(truth.camera, result.cameras[0].camera, 0.8));
    held_out.push_back(result.held_out_px);
    rms.push_back(result.rms_px);
    if (std::isnan(errors.back())) errors.back() = std::numeric_limits<double>::infinity();
  }
  return {Median(times), Median(errors), Median(held_out), Median(rms)};
}

void WriteModels(const std::string& folder, bool quick) {
  std::string csv = "truth,lens,images,cpu_s,error_px,held_out_px,rms_px\n";
  const std::vector<int> counts = quick ? std::vector<int>{6} : std::vector<int>{6, 10, 20, 40};
  for (const Truth& truth : Truths()) {
    XyChart chart;
    chart.title = "Lens models before a " + truth.name + " lens, 0.3 px of noise";
    chart.subtitle =
        "median of seeds; points: 6, 10, 20 and 40 images; the seed and five held-out fits included";
    chart.x = {"CPU time, s", true, {}, {}};
    chart.y = {"error of directions, inner 80 % of the image, px", true, {}, {}};
    for (const std::string& lens : truth.lenses) {
      if (quick && lens == "splined12") continue;
      XySeries series;
      series.name = lens;
      for (const int images : counts) {
        const Measured m = Measure(truth, lens, images, quick ? 1 : 3);
        csv += fmt::format("{},{},{},{:.3g},{:.4g},{:.4g},{:.4g}\n", truth.name, lens, images, m.time_s,
                           m.error_px, m.held_out_px, m.rms_px);
        series.points.emplace_back(m.time_s, m.error_px);
      }
      chart.series.push_back(std::move(series));
    }
    WriteText(folder + "/calib_lens_models_" + truth.name + ".svg", XyChartsSvg({chart}));
  }
  WriteText(folder + "/calib_lens_models.csv", csv);
}

// ---- stability ----

struct Case {
  BoardViewsOptions views;
  double focal_start_share = 0;  // of the true one; 0: scanned
};

struct Sweep {
  std::string name, label;
  std::vector<double> values;
  Case (*at)(double value);
};

Case Plain(int images) {
  Case plain;
  plain.views.images = images;
  return plain;
}

std::vector<Sweep> Sweeps() {
  return {{"outliers",
           "wrong corners, %",
           {0, 5, 10, 15, 20, 25, 30, 35, 40},
           [](double value) {
             Case c = Plain(20);
             c.views.outlier_share = value / 100;
             return c;
           }},
          {"focal_start",
           "start of the focal length, % of the true one",
           {70, 80, 90, 100, 110, 120, 130},
           [](double value) {
             Case c = Plain(12);
             c.focal_start_share = value / 100;
             return c;
           }},
          {"images",
           "images",
           {2, 3, 4, 5, 6, 8, 12, 16},
           [](double value) { return Plain(static_cast<int>(value)); }},
          {"tilt", "largest tilt of the board, degrees", {1, 3, 5, 8, 12, 18, 25, 35, 50}, [](double value) {
             Case c = Plain(12);
             c.views.tilt_deg = value;
             return c;
           }}};
}

struct Outcome {
  int right = 0, refused = 0, wrong = 0, cases = 0;
  std::vector<double> focal_errors_percent;
};

constexpr double kRightPercent = 1;

Outcome Try(const Case& conditions, int seeds) {
  Outcome outcome;
  const Camera truth = support::OpenCv8Camera();
  CalibrateCamerasOptions options;
  options.lenses = {{LensModel::kOpenCv, 5, 0}};
  options.focal_start_px = conditions.focal_start_share * truth.fx_px;
  for (int seed = 0; seed < seeds; ++seed) {
    std::mt19937_64 rng(static_cast<unsigned>(100 + seed));
    const Calibration result = CalibrateCameras(support::ViewsOf(truth, conditions.views, rng), options);
    const double error_percent =
        result.converged ? 100 * std::abs(result.cameras[0].camera.fx_px / truth.fx_px - 1) : 100;
    outcome.focal_errors_percent.push_back(error_percent);
    outcome.right += error_percent < kRightPercent ? 1 : 0;
    outcome.refused += result.IsUsable() ? 0 : 1;
    outcome.wrong += result.IsUsable() && error_percent >= kRightPercent ? 1 : 0;
    ++outcome.cases;
  }
  return outcome;
}

// How many were wrong and passed.
int WriteStability(const std::string& folder, bool quick) {
  std::string csv = "sweep,value,cases,right,refused,wrong_and_passed,median_focal_error_percent\n";
  int wrong = 0;
  for (const Sweep& sweep : Sweeps()) {
    XyChart chart;
    chart.title = "Calibration against " + sweep.label;
    chart.subtitle = "right: focal length within 1 %; refused: a gate failed, with the reason";
    chart.x = {sweep.label, false, {}, {}};
    chart.y = {"calibrations, %", false, 0.0, 100.0};
    XySeries right{"right", {}, {}, true}, refused{"refused", {}, {}, true},
        passed{"wrong and passed", {}, {}, true};
    for (std::size_t i = 0; i < sweep.values.size(); ++i) {
      if (quick && i % 8 != 0) continue;
      const Outcome o = Try(sweep.at(sweep.values[i]), quick ? 1 : 10);
      csv += fmt::format("{},{:g},{},{},{},{},{:.3g}\n", sweep.name, sweep.values[i], o.cases, o.right,
                         o.refused, o.wrong, Median(o.focal_errors_percent));
      const double percent = 100.0 / o.cases;
      right.points.emplace_back(sweep.values[i], percent * o.right);
      refused.points.emplace_back(sweep.values[i], percent * o.refused);
      passed.points.emplace_back(sweep.values[i], percent * o.wrong);
      wrong += o.wrong;
    }
    chart.series = {right, refused, passed};
    WriteText(folder + "/calib_lens_" + sweep.name + ".svg", XyChartsSvg({chart}));
  }
  WriteText(folder + "/calib_lens_stability.csv", csv);
  return wrong;
}

int Run(const std::string& folder, bool quick) {
  WriteModels(folder, quick);
  const int wrong = WriteStability(folder, quick);
  const Outcome plain = Try(Plain(12), 2);
  if (wrong > 0) std::fprintf(stderr, "study_lens_models: %d calibrations were wrong and passed\n", wrong);
  if (plain.right < plain.cases) std::fprintf(stderr, "study_lens_models: a plain set of images failed\n");
  return wrong == 0 && plain.right == plain.cases ? 0 : 1;
}

}  // namespace
}  // namespace luxfit

int main(int argc, char** argv) {
  const auto options = luxfit::support::ReadStudyOptions(argc, argv);
  if (!options) return 2;
  return luxfit::Run(options->folder, options->is_quick);
}
