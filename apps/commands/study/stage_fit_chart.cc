#include "apps/commands/study/stage_fit_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "apps/charts/xy_chart_svg.h"
#include "apps/commands/study/internal/earlier_chart.h"
#include "apps/commands/study/internal/fit_chart_points.h"
#include "apps/commands/study/internal/fit_chart_svg.h"
#include "apps/stages/prepared_session.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/json_vectors.h"

namespace luxfit {
namespace {

using nlohmann::json;

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
    if (!prepared_.observed.observations.empty()) {
      OfViews();
      OfStates();
      OfRoom("patch_size_m", {0.8, 0.6, 0.3}, [](RoomOptions& o, double v) { o.patches.patch_size_m = v; });
      OfRoom("element_size_m", {0.4, 0.2}, [](RoomOptions& o, double v) { o.patches.element_size_m = v; });
      OfRoom("rays", {16, 256},
             [](RoomOptions& o, double v) { o.form_factors.rays_per_element = static_cast<int>(v); });
    }
    OfLuminaires();
    for (size_t i = 0; i < points_.size(); ++i) Score(points_[i], found_[i]);
    return std::move(points_);
  }

 private:
  void Add(const std::string& factor, double value, const Session& session,
           const LinearizedSession& linearized, const Room& room, const Evidence& observed, double before_s) {
    FitPoint point;
    point.factor = factor;
    point.value = value;
    point.patches = static_cast<int>(room.patches.patches.size());
    point.photos = PhotosOf(observed.observations);
    point.luminaires = static_cast<int>(session.luminaires.size());
    point.observations = static_cast<int>(observed.observations.size());
    std::vector<EstimatedLuminaire> found;
    const double start_s = ProcessorS();
    try {
      const Refit refit = RefitSession(session, linearized, room, observed, context_);
      point.is_usable = !refit.undetermined;
      found = refit.luminaires;
      point.lux_percent = refit.mean_lux_error_percent;
    } catch (const std::runtime_error& e) {  // reported by the program instead of a result
      point.is_usable = false;
      std::fprintf(stderr, "fit chart %s = %g: %s\n", factor.c_str(), value, e.what());
    }
    point.time_s = before_s + ProcessorS() - start_s;
    std::fprintf(stderr, "fit chart %-16s %-6g %5.1f s of the processor\n", factor.c_str(), value,
                 point.time_s);
    points_.push_back(std::move(point));
    found_.push_back(std::move(found));
  }

  // Observes again in those photos alone: what they show of luminaires goes with the others.
  Evidence ObservedIn(const std::function<bool(const LinearizedPhoto&)>& is_kept) const {
    RunContext own;
    own.out = context_.out;
    own.is_quiet = true;
    return Thinned(ObserveKeptPhotos(prepared_, is_kept, own), elements_);
  }

  // The last point has all elements, and is the reference where no truth is given.
  void OfElements() {
    std::set<int> observed;
    for (const Observation& o : prepared_.observed.observations) observed.insert(o.element);
    std::vector<int> counts;
    for (int n = elements_ / 4; n < static_cast<int>(observed.size()); n *= 2)
      counts.push_back(std::max(n, 1));
    counts.push_back(std::max(1, static_cast<int>(observed.size())));
    for (const int n : counts)
      Add("elements", n, prepared_.session, prepared_.linearized, prepared_.room,
          Thinned(prepared_.observed, n), 0);
    if (truth_.empty()) truth_ = found_.back();
  }

  void OfViews() {
    std::set<int> observed;
    for (const Observation& o : prepared_.observed.observations) observed.insert(o.view);
    std::set<std::string> views;
    for (const int v : observed) {
      views.insert(prepared_.registered.registration.views[static_cast<size_t>(v)].view);
      const size_t n = views.size();
      if ((n & (n - 1)) != 0) continue;  // powers of two
      Add("views", static_cast<double>(n), prepared_.session, prepared_.linearized, prepared_.room,
          ObservedIn([&](const LinearizedPhoto& photo) { return views.count(photo.view) > 0; }), 0);
    }
  }

  void OfStates() {
    std::set<int> observed;
    for (const Observation& o : prepared_.observed.observations) observed.insert(o.state);
    std::set<std::string> states;
    for (const int s : observed) {
      states.insert(prepared_.session.states[static_cast<size_t>(s)].id);
      if (states.size() < prepared_.session.luminaires.size()) continue;  // too few to tell luminaires apart
      Add("states", static_cast<double>(states.size()), prepared_.session, prepared_.linearized,
          prepared_.room,
          ObservedIn([&](const LinearizedPhoto& photo) { return states.count(photo.state) > 0; }), 0);
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
      Evidence observed =
          ObserveSession(prepared_.session, prepared_.linearized.photos, prepared_.registered, room, own);
      Add(factor, value, prepared_.session, prepared_.linearized, room,
          Thinned(std::move(observed), elements_), before_s);
    }
  }

  // Keeps the first luminaires alone, in the states that need no other.
  void OfLuminaires() {
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
      const Evidence observed =
          ObservedIn([&](const LinearizedPhoto& photo) { return states.count(photo.state) > 0; });
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
      if (observed.observations.empty() && readings.empty()) continue;
      Add("luminaires", static_cast<double>(n), session, linearized, prepared_.room, observed, 0);
    }
  }

  void Score(FitPoint& point, const std::vector<EstimatedLuminaire>& found) const {
    if (!point.is_usable || found.empty()) return;
    std::vector<EstimatedLuminaire> truth;
    for (const EstimatedLuminaire& t : truth_) {
      const bool is_asked =
          found.size() >= truth_.size() ||
          std::any_of(found.begin(), found.end(), [&](const EstimatedLuminaire& f) { return f.id == t.id; });
      if (is_asked) truth.push_back(t);
    }
    const FitScore score = ScoreFit(found, truth, false);
    point.position_mm = 1e3 * score.position_error_m;
    point.flux_percent = 100 * score.flux_error;
  }

  const PreparedSession& prepared_;
  std::vector<EstimatedLuminaire> truth_;
  int elements_;
  RunContext& context_;
  std::vector<FitPoint> points_;
  std::vector<std::vector<EstimatedLuminaire>> found_;  // by point
};

json PointJson(const FitPoint& p) {
  return {{"factor", p.factor},
          {"value", p.value},
          {"patches", p.patches},
          {"photos", p.photos},
          {"luminaires", p.luminaires},
          {"observations", p.observations},
          {"processor_time_s", p.time_s},
          {"usable", p.is_usable},
          {"position_mm", NumberOrNull(p.position_mm)},
          {"flux_percent", NumberOrNull(p.flux_percent)},
          {"lux_percent", NumberOrNull(p.lux_percent)}};
}

json Artifact(const Session& session, const FitChartOptions& options, const std::vector<FitPoint>& points,
              const RunContext& context) {
  json artifact = ProvenanceJson("luxfit-fit-chart-1", context.provenance);
  artifact["session"] = session.name;
  artifact["elements"] = options.elements;
  artifact["reference"] =
      options.truth_path.empty() ? "the fit to all observed elements" : options.truth_path;
  artifact["points"] = json::array();
  for (const FitPoint& p : points) artifact["points"].push_back(PointJson(p));
  artifact["slopes"] = json::object();
  for (const auto& [name, slope] : FitSlopes(points)) artifact["slopes"][name] = NumberOrNull(slope);
  artifact["warnings"] = WarningsJson(context);
  return artifact;
}

// Returns the points of the earlier chart; none where none was named.
std::vector<FitPoint> PointsBefore(const Session& session, const FitChartOptions& options,
                                   RunContext& context) {
  if (options.before.path.empty()) return {};
  const CsvTable table =
      ReadEarlierChart(options.before.path, {ChartKind::kFit, session.name, options.truth_path});
  context.provenance.inputs.push_back(table.path);
  return FitPointsOf(table);
}

}  // namespace

json FitChartOfSession(const Session& session, const FitChartOptions& options, RunContext& context) {
  std::vector<EstimatedLuminaire> truth;
  if (!options.truth_path.empty()) {
    truth = ReadTruth(options.truth_path);
    context.provenance.inputs.push_back(options.truth_path);
  }
  const std::vector<FitPoint> before = PointsBefore(session, options, context);
  const PreparedSession prepared = PrepareSession(session, context);
  const std::vector<FitPoint> points = FitSweep(prepared, truth, options.elements, context).Run();
  json artifact = Artifact(session, options, points, context);
  WriteText(context.out + "/fit.csv", FitChartCsv(points));
  for (const FitPicture& picture : FitPictures(points, session.name, before, options.before.names)) {
    const std::string svg = XyChartsSvg({picture.chart});
    if (!svg.empty()) WriteText(context.out + "/" + picture.file, svg);
  }
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
