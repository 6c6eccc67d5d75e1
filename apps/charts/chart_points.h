// Measures the points of a chart of speed against accuracy: it times each way to compute the same illuminance
// and compares it with the light tracer.
//
//   error    root mean square over sensors and luminaires (each alone) of illuminance over reference - 1
//   time     subdivision, form factors, sensors' rows, direct light and solution; the best of several runs
//            where they are short
//
// One-factor sweeps start from the automatic choice (forward/light/choose_accuracy.h), which is measured
// first. `asked_error` marks automatic choices for other errors. The product method x rays x patch size
// follows, coarse points first. Points that would exceed the budget, judged by the time of their neighbours,
// are skipped and listed.
//
// Sensors are taken as cosine-corrected, the only kind that the tracer has.
// Source: the reference is that of forward/light/light_tracer.h, which shares no patch with what is measured.
#ifndef LUXFIT_APPS_CHARTS_CHART_POINTS_H_
#define LUXFIT_APPS_CHARTS_CHART_POINTS_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "forward/light/choose_accuracy.h"

namespace luxfit {

struct ChartPoint {
  std::string factor;  // automatic, asked_error, method, rays, patch_size, bounces, solver or grid
  FormFactorMethod method = FormFactorMethod::kHybrid;
  int rays = 0;
  double patch_size_m = 0, element_size_m = 0;  // largest patch, smallest element
  bool adaptive = false;                        // patches split where illuminance varies
  std::optional<int> bounces;                   // absent: all
  RadiositySolver solver = RadiositySolver::kAuto;
  int patches = 0;
  double time_s = 0, error_percent = 0;
  std::optional<double> estimated_error_percent;  // for automatic choices only
  bool on_front = false;                          // no other is both faster and more accurate
  bool automatic = false;
};

struct SkippedPoint {
  ChartPoint point;
  double expected_s = 0;
};

struct ChartReference {
  Eigen::MatrixXd lx_per_lm;  // sensors x luminaires
  double sigma_percent = 0;   // its own standard error, rms; smaller errors cannot be resolved
  int paths_per_sensor = 0;
};

struct Chart {
  std::vector<ChartPoint> points;
  std::vector<SkippedPoint> skipped;
  ChartReference reference;
  AccuracyChoice choice;  // the automatic one
  double choosing_s = 0;  // including the result that it ends with
};

Chart MeasureChart(const LitScene& lit, double error_percent, double budget_s);

// Marks the points that no other point beats by being no slower, no less accurate, and better in one of the
// two. Values within one percent of each other count as equal.
void MarkFront(std::vector<ChartPoint>& points);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_CHART_POINTS_H_
