#include "apps/commands/study/stage_fit_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "apps/charts/xy_chart_svg.h"
#include "apps/stages/prepared_session.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/json_vectors.h"

namespace luxfit {
namespace {

using nlohmann::json;

struct FitPoint {
  std::string factor;
  double value = 0;
  int patches = 0, photos = 0, luminaires = 0, observations = 0;
  double time_s = 0;  // processor time
  double position_mm = NAN, flux_percent = NAN, lux_percent = NAN;
  bool is_usable = true;
  std::vector<EstimatedLuminaire> found;
};

double ProcessorS() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

int PhotosOf(const std::vector<Observation>& observations) {
  std::set<std::pair<int, int>> photos;
  for (const Observation& o : observations) photos.insert({o.view, o.state});
  return static_cast<int>(photos.size());
}

class FitSweep {
 public:
  FitSweep(const PreparedSession& prepared, std::vector<EstimatedLuminaire> truth, int elements,
           RunContext& context)
      : prepared_(prepared), truth_(std::move(truth)), elements_(elements), context_(context) {}

  std::vector<FitPoint> Run() {
    OfElements();
    if (!prepared_.observations.empty()) {
      OfViews();
      OfStates();
      OfRoom("patch_size_m", {0.8, 0.6, 0.3}, [](RoomOptions& o, double v) { o.patches.patch_size_m = v; });
      OfRoom("element_size_m", {0.4, 0.2}, [](RoomOptions& o, double v) { o.patches.element_size_m = v; });
      OfRoom("rays", {16, 256},
             [](RoomOptions& o, double v) { o.form_factors.rays_per_element = static_cast<int>(v); });
    }
    OfLuminaires();
    for (FitPoint& point : points_) Score(point);
    return std::move(points_);
  }

 private:
  void Add(const std::string& factor, double value, const Session& session,
           const LinearizedSession& linearized, const Room& room, const SessionObservations& observed,
           double before_s) {
    FitPoint point;
    point.factor = factor;
    point.value = value;
    point.patches = static_cast<int>(room.patches.patches.size());
    point.photos = PhotosOf(observed.observations);
    point.luminaires = static_cast<int>(session.luminaires.size());
    point.observations = static_cast<int>(observed.observations.size());
    const double start_s = ProcessorS();
    try {
      const Refit refit = RefitSession(session, linearized, room, observed, context_);
      point.is_usable = !refit.undetermined;
      point.found = refit.luminaires;
      point.lux_percent = refit.mean_lux_error_percent;
    } catch (const std::runtime_error& e) {  // reported by the program instead of a result
      point.is_usable = false;
      std::fprintf(stderr, "fit chart %s = %g: %s\n", factor.c_str(), value, e.what());
    }
    point.time_s = before_s + ProcessorS() - start_s;
    std::fprintf(stderr, "fit chart %-16s %-6g %5.1f s of the processor\n", factor.c_str(), value,
                 point.time_s);
    points_.push_back(std::move(point));
  }

  // Adds to the observations what their photos show of luminaires: places in their states, and outlines.
  SessionObservations WithSeen(std::vector<Observation> observations) const {
    std::set<int> states;
    std::set<std::pair<int, int>> photos;
    for (const Observation& o : observations) {
      states.insert(o.state);
      photos.emplace(o.view, o.state);
    }
    SessionObservations kept{std::move(observations), {}, {}};
    std::copy_if(prepared_.seen.begin(), prepared_.seen.end(), std::back_inserter(kept.seen),
                 [&](const SeenPlace& place) {
                   return std::any_of(place.states.begin(), place.states.end(),
                                      [&](int state) { return states.count(state) > 0; });
                 });
    std::copy_if(prepared_.outlines.begin(), prepared_.outlines.end(), std::back_inserter(kept.outlines),
                 [&](const SeenOutline& outline) {
                   return photos.count({outline.view, outline.state}) > 0;
                 });
    return kept;
  }

  std::vector<Observation> Thinned() const { return ThinElements(prepared_.observations, elements_); }

  // The last point has all elements, and is the reference where no truth is given.
  void OfElements() {
    std::set<int> observed;
    for (const Observation& o : prepared_.observations) observed.insert(o.element);
    std::vector<int> counts;
    for (int n = elements_ / 4; n < static_cast<int>(observed.size()); n *= 2)
      counts.push_back(std::max(n, 1));
    counts.push_back(std::max(1, static_cast<int>(observed.size())));
    for (const int n : counts)
      Add("elements", n, prepared_.session, prepared_.linearized, prepared_.room,
          {ThinElements(prepared_.observations, n), prepared_.seen, prepared_.outlines}, 0);
    if (truth_.empty()) truth_ = points_.back().found;
  }

  void OfViews() {
    const std::vector<Observation> all = Thinned();
    std::set<int> views;
    for (const Observation& o : all) views.insert(o.view);
    for (size_t n = 1; n <= views.size(); n *= 2) {
      const int last = *std::next(views.begin(), static_cast<std::ptrdiff_t>(n - 1));
      std::vector<Observation> kept;
      std::copy_if(all.begin(), all.end(), std::back_inserter(kept),
                   [&](const Observation& o) { return o.view <= last; });
      Add("views", static_cast<double>(n), prepared_.session, prepared_.linearized, prepared_.room,
          {kept, {}, WithSeen(kept).outlines}, 0);
    }
  }

  void OfStates() {
    const std::vector<Observation> all = Thinned();
    std::set<int> states;
    for (const Observation& o : all) states.insert(o.state);
    size_t n = 0;
    for (const int last : states) {
      ++n;
      if (n < prepared_.session.luminaires.size()) continue;  // too few to tell luminaires apart
      std::vector<Observation> kept;
      std::copy_if(all.begin(), all.end(), std::back_inserter(kept),
                   [&](const Observation& o) { return o.state <= last; });
      Add("states", static_cast<double>(n), prepared_.session, prepared_.linearized, prepared_.room,
          WithSeen(kept), 0);
    }
  }

  void OfRoom(const std::string& factor, const std::vector<double>& values,
              const std::function<void(RoomOptions&, double)>& set) {
    const Scene scene = LoadMesh(prepared_.session).scene;
    for (const double value : values) {
      RoomOptions options;
      set(options, value);
      const double start_s = ProcessorS();
      const Room room = MakeRoom(scene, options);
      const double before_s = ProcessorS() - start_s;
      RunContext own;
      own.out = context_.out;
      own.is_quiet = true;
      SessionObservations observed =
          ObserveSession(prepared_.session, prepared_.linearized.photos, prepared_.registered, room, own);
      observed.observations = ThinElements(observed.observations, elements_);
      Add(factor, value, prepared_.session, prepared_.linearized, room, observed, before_s);
    }
  }

  // Keeps the first luminaires alone, in the states that need no other.
  void OfLuminaires() {
    const std::vector<Observation> all = Thinned();
    for (size_t n = 1; n <= prepared_.session.luminaires.size(); ++n) {
      Session session = prepared_.session;
      session.luminaires.resize(n);
      std::set<std::string> ids, states;
      for (const SessionLuminaire& l : session.luminaires) ids.insert(l.id);
      for (SessionState& state : session.states) {
        const bool is_own = std::all_of(state.dimming.begin(), state.dimming.end(), [&](const auto& on) {
          return on.second == 0 || ids.count(on.first) > 0;
        });
        if (is_own) states.insert(state.id);
      }
      std::vector<Observation> kept;
      std::copy_if(all.begin(), all.end(), std::back_inserter(kept), [&](const Observation& o) {
        return states.count(session.states[static_cast<size_t>(o.state)].id) > 0;
      });
      LinearizedSession linearized = prepared_.linearized;
      std::vector<LuminaireReading>& readings = linearized.readings;
      readings.erase(
          std::remove_if(readings.begin(), readings.end(),
                         [&](const LuminaireReading& r) { return states.count(r.given.state) == 0; }),
          readings.end());
      // Without the reading that set the scale, another one sets it.
      const bool has_scale = std::any_of(readings.begin(), readings.end(), [](const LuminaireReading& r) {
        return r.given.role != ReadingRole::kCheck;
      });
      if (!has_scale && !readings.empty()) readings.front().given.role = ReadingRole::kScale;
      if (kept.empty() && readings.empty()) continue;
      Add("luminaires", static_cast<double>(n), session, linearized, prepared_.room, WithSeen(kept), 0);
    }
  }

  void Score(FitPoint& point) const {
    if (!point.is_usable || point.found.empty()) return;
    std::vector<EstimatedLuminaire> truth;
    for (const EstimatedLuminaire& t : truth_) {
      const bool is_asked = point.found.size() >= truth_.size() ||
                            std::any_of(point.found.begin(), point.found.end(),
                                        [&](const EstimatedLuminaire& f) { return f.id == t.id; });
      if (is_asked) truth.push_back(t);
    }
    const FitScore score = ScoreFit(point.found, truth, false);
    point.position_mm = 1e3 * score.position_error_m;
    point.flux_percent = 100 * score.flux_error;
  }

  const PreparedSession& prepared_;
  std::vector<EstimatedLuminaire> truth_;
  int elements_;
  RunContext& context_;
  std::vector<FitPoint> points_;
};

std::string CellOrEmpty(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : ""; }

std::string Csv(const std::vector<FitPoint>& points) {
  std::string text =
      "factor,value,patches,photos,luminaires,observations,processor_time_s,usable,position_mm,flux_percent,"
      "lux_percent\n";
  for (const FitPoint& p : points)
    text += fmt::format("{},{:g},{},{},{},{},{:.3g},{:d},{},{},{}\n", p.factor, p.value, p.patches, p.photos,
                        p.luminaires, p.observations, p.time_s, p.is_usable, CellOrEmpty(p.position_mm),
                        CellOrEmpty(p.flux_percent), CellOrEmpty(p.lux_percent));
  return text;
}

std::vector<std::string> FactorsOf(const std::vector<FitPoint>& points) {
  std::vector<std::string> factors;
  for (const FitPoint& p : points) {
    if (std::count(factors.begin(), factors.end(), p.factor) == 0) factors.push_back(p.factor);
  }
  return factors;
}

std::string ErrorSvg(const std::vector<FitPoint>& points, const std::string& title, const std::string& unit,
                     const std::function<double(const FitPoint&)>& error) {
  XyChart chart;
  chart.title = title;
  chart.subtitle = "one thing varied at a time; labels: its value; the best is at the lower left";
  chart.x = {"processor time of form factors and fit, s", true, {}, {}};
  chart.y = {unit, true, {}, {}};
  for (const std::string& factor : FactorsOf(points)) {
    XySeries series{factor, {}, {}, true};
    for (const FitPoint& p : points) {
      if (p.factor != factor) continue;
      series.points.push_back({p.time_s, error(p)});
      series.labels.push_back(fmt::format("{:g}", p.value));
    }
    chart.series.push_back(std::move(series));
  }
  return XyChartsSvg({chart});
}

struct Cost {
  std::string name, factor;
  std::function<double(const FitPoint&)> size;
};
const std::vector<Cost>& Costs() {
  static const std::vector<Cost> costs{
      {"patches", "patch_size_m", [](const FitPoint& p) { return p.patches; }},
      {"photos", "views", [](const FitPoint& p) { return p.photos; }},
      {"luminaires", "luminaires", [](const FitPoint& p) { return p.luminaires; }}};
  return costs;
}

// Returns the slope of ln time over ln size; NaN for fewer than two sizes.
double Slope(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points)
    mean += p.array().log().matrix() / static_cast<double>(points.size());
  double xx = 0, xy = 0;
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Vector2d d = p.array().log().matrix() - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
  }
  return xx > 1e-12 ? xy / xx : NAN;
}

std::string CostSvg(const std::vector<FitPoint>& points, json& slopes) {
  XyChart chart;
  chart.title = "Cost of the fit";
  chart.subtitle = "processor time over size, each relative to its largest; linear would have slope 1";
  chart.x = {"size, of the largest", true, {}, {}};
  chart.y = {"time, of the largest's", true, {}, {}};
  slopes = json::object();
  for (const Cost& cost : Costs()) {
    std::vector<Eigen::Vector2d> sizes;
    for (const FitPoint& p : points) {
      if (p.factor == cost.factor && p.is_usable) sizes.emplace_back(cost.size(p), p.time_s);
    }
    if (sizes.size() < 2) continue;
    const double slope = Slope(sizes);
    slopes[cost.name] = NumberOrNull(slope);
    const auto largest = std::max_element(sizes.begin(), sizes.end(),
                                          [](const auto& a, const auto& b) { return a.x() < b.x(); });
    const Eigen::Vector2d unit = *largest;
    XySeries series{fmt::format("{}: slope {:.2f}", cost.name, slope), {}, {}, true};
    for (const Eigen::Vector2d& p : sizes) series.points.push_back(p.cwiseQuotient(unit));
    chart.series.push_back(std::move(series));
  }
  return XyChartsSvg({chart});
}

}  // namespace

json FitChartOfSession(const Session& session, const FitChartOptions& options, RunContext& context) {
  std::vector<EstimatedLuminaire> truth;
  if (!options.truth_path.empty()) {
    truth = ReadTruth(options.truth_path);
    context.provenance.inputs.push_back(options.truth_path);
  }
  const PreparedSession prepared = PrepareSession(session, context);
  const std::vector<FitPoint> points = FitSweep(prepared, truth, options.elements, context).Run();
  json artifact = ProvenanceJson("luxfit-fit-chart-1", context.provenance);
  artifact["session"] = session.name;
  artifact["elements"] = options.elements;
  artifact["reference"] = truth.empty() ? "the fit to all observed elements" : options.truth_path;
  artifact["points"] = json::array();
  for (const FitPoint& p : points)
    artifact["points"].push_back({{"factor", p.factor},
                                  {"value", p.value},
                                  {"patches", p.patches},
                                  {"photos", p.photos},
                                  {"luminaires", p.luminaires},
                                  {"observations", p.observations},
                                  {"processor_time_s", p.time_s},
                                  {"usable", p.is_usable},
                                  {"position_mm", NumberOrNull(p.position_mm)},
                                  {"flux_percent", NumberOrNull(p.flux_percent)},
                                  {"lux_percent", NumberOrNull(p.lux_percent)}});
  WriteText(context.out + "/fit.csv", Csv(points));
  const std::string name = session.name + ": ";
  const auto write = [&](const std::string& file, const std::string& svg) {
    if (!svg.empty()) WriteText(context.out + "/" + file, svg);
  };
  write("fit_position.svg",
        ErrorSvg(points, name + "luminaires' places against time", "median error of position, mm",
                 [](const FitPoint& p) { return p.position_mm; }));
  write("fit_flux.svg", ErrorSvg(points, name + "luminaires' fluxes against time", "median error of flux, %",
                                 [](const FitPoint& p) { return p.flux_percent; }));
  write("fit_lux.svg", ErrorSvg(points, name + "readings against time", "mean error, % of the mean reading",
                                [](const FitPoint& p) { return p.lux_percent; }));
  write("fit_cost.svg", CostSvg(points, artifact["slopes"]));
  artifact["warnings"] = WarningsJson(context);
  WriteJson(context.out + "/stages/fit_chart.json", artifact);
  return artifact;
}

std::string FitChartTable(const json& artifact) {
  std::string text = fmt::format(
      "session {}: against {}\n\nfactor            value  patches  photos   time s  position mm  flux %   "
      "lux %\n",
      artifact["session"].get<std::string>(), artifact["reference"].get<std::string>());
  const auto cell = [](const json& v) {
    return v.is_number() ? fmt::format("{:.2f}", v.get<double>()) : std::string("-");
  };
  for (const json& p : artifact["points"])
    text += fmt::format("{:<16} {:>6g} {:>8} {:>7} {:>8.2f} {:>12} {:>7} {:>7}\n",
                        p["factor"].get<std::string>(), p["value"].get<double>(), p["patches"].get<int>(),
                        p["photos"].get<int>(), p["processor_time_s"].get<double>(), cell(p["position_mm"]),
                        cell(p["flux_percent"]), cell(p["lux_percent"]));
  text += "\ncost, slope of ln time over ln size (1: linear):";
  for (const auto& [name, slope] : artifact["slopes"].items())
    text += fmt::format(" {} {}", name, cell(slope));
  return text + "\n";
}

}  // namespace luxfit
