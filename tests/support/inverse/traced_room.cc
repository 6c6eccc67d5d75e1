#include "tests/support/inverse/traced_room.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "forward/light/light_tracer.h"
#include "forward/room/visibility.h"
#include "inverse/model/fit_uncertainty.h"
#include "tests/support/inverse/luminaire_outlines.h"
#include "tests/support/inverse/stated_errors.h"

namespace luxfit::support {
namespace {

constexpr double kScale = 2e-3;  // relative luminance per cd/m2

// Points that a camera sees of one element.
struct Sight {
  int element = 0, view = 0;
  std::vector<size_t> sensors;  // indices of traced points
};

struct Sights {
  std::vector<Sight> all;
  std::vector<Sensor> sensors;
  std::vector<double> albedo;  // by sensor
};

// Returns the centres of nine equal parts: pixels cover an element evenly.
std::vector<Eigen::Vector3d> PointsOf(const Element& element) {
  std::vector<Eigen::Vector3d> points;
  for (const int a : {-1, 0, 1})
    for (const int b : {-1, 0, 1})
      points.push_back(element.center + a / 3.0 * element.edge_u + b / 3.0 * element.edge_v);
  return points;
}

// The index of the traced point that the eye sees at p, or -1. `own`: the index of p itself, -1: not yet traced.
int SeenFrom(const Eigen::Vector3d& eye, const Eigen::Vector3d& p, const TracedRoom& room,
             const RayScene& rays, int& own, Sights& sights) {
  const RayHit hit = rays.Trace(eye, p - eye);
  if (hit.facet < 0 || !hit.front) return -1;
  const Facet& facet = room.truth.facets[static_cast<size_t>(hit.facet)];
  const Eigen::Vector3d q = facet.PointAt(hit.u, hit.v);
  const bool is_own = (q - p).norm() < 1e-3;
  if (is_own && own >= 0) return own;
  sights.sensors.push_back({LiftedOff(q, facet.Normal()), facet.Normal(), {}});
  sights.albedo.push_back(room.albedo[facet.material]);
  const int index = static_cast<int>(sights.sensors.size()) - 1;
  if (is_own) own = index;
  return index;
}

Sights SightsOf(const TracedRoom& room, const Room& model, const RayScene& rays) {
  constexpr double kLeastCosine = 0.1;
  Sights sights;
  for (size_t e = 0; e < model.patches.elements.size(); ++e) {
    const Element& element = model.patches.elements[e];
    const std::vector<Eigen::Vector3d> points = PointsOf(element);
    std::vector<int> own(points.size(), -1);
    for (size_t v = 0; v < room.eyes.size(); ++v) {
      const Eigen::Vector3d& eye = room.eyes[v];
      Sight sight;
      sight.element = static_cast<int>(e), sight.view = static_cast<int>(v);
      for (size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d lifted = LiftedOff(points[i], element.normal);
        if ((eye - lifted).dot(element.normal) <= kLeastCosine * (eye - lifted).norm()) continue;
        if (model.rays.Occluded(eye, lifted)) continue;
        const int sensor = SeenFrom(eye, points[i], room, rays, own[i], sights);
        if (sensor >= 0) sight.sensors.push_back(static_cast<size_t>(sensor));
      }
      // As in photos: the mean of what is seen must stand for the element's centre.
      if (sight.sensors.size() == points.size()) sights.all.push_back(std::move(sight));
    }
  }
  return sights;
}

// The variance of each point's indirect light by luminaire, lx2. Two replicates, which have the least of it, tell one
// point's badly: the relative error is pooled over all points.
Eigen::MatrixXd TracerVariance(const TracedIlluminance& lx) {
  Eigen::MatrixXd variance(lx.indirect.rows(), lx.indirect.cols());
  for (Eigen::Index k = 0; k < variance.cols(); ++k) {
    const double relative = lx.indirect_sigma.col(k).norm() / lx.indirect.col(k).norm();
    variance.col(k) = (relative * lx.indirect.col(k)).cwiseAbs2();
  }
  return variance;
}

void AddPhotos(const TracedRoom& room, const RayScene& rays, const Sights& sights,
               const TracedRoomOptions& options, std::mt19937_64& rng, RoomObservations& given) {
  LightTracerOptions tracer;
  tracer.paths_per_sensor = options.paths_per_point;
  tracer.replicates = 2;
  const TracedIlluminance lx =
      TraceIlluminance(room.truth, rays, room.luminaires, room.albedo, sights.sensors, tracer);
  const Eigen::MatrixXd tracer_lx2 = TracerVariance(lx);
  std::normal_distribution<double> normal;
  for (size_t s = 0; s < room.dimming.size(); ++s) {
    const Eigen::VectorXd illuminance = (lx.direct + lx.indirect) * room.dimming[s];
    const Eigen::VectorXd variance = tracer_lx2 * room.dimming[s].cwiseAbs2();
    for (const Sight& sight : sights.all) {
      double mean = 0, tracer_variance = 0;
      for (const size_t i : sight.sensors) {
        const double unit = kScale * sights.albedo[i] / (kPi * static_cast<double>(sight.sensors.size()));
        mean += unit * illuminance[static_cast<Eigen::Index>(i)];
        tracer_variance += unit * unit * variance[static_cast<Eigen::Index>(i)];
      }
      Observation o;
      o.element = sight.element, o.view = sight.view, o.state = static_cast<int>(s), o.pixels = 60;
      o.relative_luminance = mean * (1 + options.noise * normal(rng));
      o.variance = std::pow(options.noise * mean, 2) + tracer_variance;
      o.relative_rgb.setConstant(o.relative_luminance);
      given.observations.push_back(o);
    }
  }
}

void AddReadings(const TracedRoom& room, const RayScene& rays, const TracedRoomOptions& options,
                 std::mt19937_64& rng, RoomObservations& given) {
  LightTracerOptions tracer;
  tracer.paths_per_sensor = options.paths_per_reading;
  const TracedIlluminance lx =
      TraceIlluminance(room.truth, rays, room.luminaires, room.albedo, room.places, tracer);
  const Eigen::VectorXd read_lx = (lx.direct + lx.indirect) * room.dimming.back();
  std::normal_distribution<double> normal;
  for (size_t i = 0; i < room.places.size(); ++i) {
    const double value = read_lx[static_cast<Eigen::Index>(i)] * (1 + options.reading_noise * normal(rng));
    given.meter.readings.push_back(
        {room.places[i], static_cast<int>(room.dimming.size()) - 1, value, 0, i == 0, -1});
  }
}

double AreaOf(const Luminaire& luminaire) {
  if (luminaire.shape == LuminaireShape::kRectangle) return luminaire.size_m.prod();
  const double diameter = luminaire.shape == LuminaireShape::kPoint ? 0.08 : luminaire.size_m[0];
  return kPi / 4 * diameter * diameter;
}

// Whether an eye sees the opening bright: at least a tenth of what shines along the aim.
bool Shows(const Luminaire& luminaire, const Eigen::Vector3d& eye, const RayScene& rays) {
  const Eigen::Vector3d to_eye = (eye - luminaire.position).normalized();
  const auto intensity = [&](const Eigen::Vector3d& direction) {
    return IntensityPerLumen(luminaire, AxesOf(luminaire), direction).cd_per_lm;
  };
  const Eigen::Vector3d start = luminaire.position + 1e-3 * to_eye;
  return intensity(to_eye) > 0.1 * intensity(luminaire.aim) && !rays.Occluded(start, eye);
}

std::vector<int> StatesOf(const TracedRoom& room, size_t luminaire) {
  std::vector<int> states;
  for (size_t s = 0; s < room.dimming.size(); ++s)
    if (room.dimming[s][static_cast<Eigen::Index>(luminaire)] > 0) states.push_back(static_cast<int>(s));
  return states;
}

// The state in which the fewest are on: the first of these.
int QuietestOf(const TracedRoom& room, const std::vector<int>& states) {
  return *std::min_element(states.begin(), states.end(), [&](int a, int b) {
    const auto on = [&](int s) { return (room.dimming[static_cast<size_t>(s)].array() > 0).count(); };
    return on(a) < on(b);
  });
}

bool IsHidden(const TracedRoom& room, size_t luminaire) {
  return !room.is_hidden.empty() && room.is_hidden[luminaire];
}

bool IsFlat(const Luminaire& luminaire) {
  return luminaire.shape == LuminaireShape::kRectangle || luminaire.shape == LuminaireShape::kDisc;
}

void AddSeen(const TracedRoom& room, const RayScene& rays, const TracedRoomOptions& options,
             std::mt19937_64& rng, RoomObservations& given) {
  std::normal_distribution<double> normal;
  for (size_t k = 0; k < room.luminaires.size(); ++k) {
    if (IsHidden(room, k)) continue;
    const Luminaire& luminaire = room.luminaires[k];
    SeenPlace place;
    place.states = StatesOf(room, k);
    for (size_t v = 0; v < room.eyes.size(); ++v) {
      if (!Shows(luminaire, room.eyes[v], rays)) continue;
      ++place.views;
      if (!IsFlat(luminaire)) continue;
      RimView rim;
      rim.view = static_cast<int>(v), rim.state = QuietestOf(room, place.states);
      rim.shift_px = options.outline_sigma_px * Eigen::Vector2d(normal(rng), normal(rng));
      given.outlines.push_back(OutlineFrom(room.eyes[v], luminaire, rim));
    }
    if (place.views < 2) continue;
    place.sigma_m = options.place_sigma_m;
    for (int axis = 0; axis < 3; ++axis)
      place.position[axis] = luminaire.position[axis] + place.sigma_m * normal(rng);
    place.photos = place.views * static_cast<int>(place.states.size());
    place.area_m2 = AreaOf(luminaire);
    if (luminaire.shape == LuminaireShape::kRectangle) {
      place.size_m = luminaire.size_m, place.heading = luminaire.heading;
      if (place.size_m[0] < place.size_m[1]) {
        std::swap(place.size_m[0], place.size_m[1]);
        place.heading = luminaire.aim.cross(luminaire.heading);
      }
    }
    given.seen.push_back(place);
  }
}

// Prints by state how much of the photos the fit does not explain, and how large the rest's residuals are.
void PrintStates(const RoomFit& fit) {
  for (size_t s = 0; s < fit.data.dimming.size(); ++s) {
    int all = 0, unexplained = 0;
    double sum = 0;
    for (size_t i = 0; i < fit.data.observations.size() && fit.fit.weight.size() > 0; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (fit.data.observations[i].state != static_cast<int>(s) || fit.fit.weight[row] == 0) continue;
      ++all, unexplained += fit.fit.weight[row] < 0.25 ? 1 : 0;
      sum += std::pow(std::log(fit.fit.predicted[row] / fit.data.observations[i].relative_luminance), 2);
    }
    std::printf("  state %zu: %d rows, %.2f %% unexplained, rms %.2f %%\n", s, all, 100.0 * unexplained / all,
                100 * std::sqrt(sum / all));
  }
  std::printf("  model error %.2f %%\n", 100 * fit.fit.relative_sigma);
}

bool AreSwitchedTogether(const TracedRoom& room, Eigen::Index a, Eigen::Index b) {
  return std::all_of(room.dimming.begin(), room.dimming.end(),
                     [&](const Eigen::VectorXd& d) { return d[a] == d[b]; });
}

double WorstZ(const RoomFit& fit, int luminaire, const Eigen::Vector3d& truth) {
  double worst = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double sigma =
        SigmaOf(fit, ParameterKind::kLuminaire, luminaire, static_cast<LuminaireQuantity>(axis));
    const double off = fit.fit.state.luminaires[static_cast<size_t>(luminaire)].position[axis] - truth[axis];
    worst = std::max(worst, std::abs(off) / sigma);
  }
  return worst;
}

void ExpectLuminaire(const Luminaire& truth, bool is_outlined, const RoomFit& fit, size_t match,
                     const FoundLimits& limits) {
  const Luminaire& found = fit.fit.state.luminaires[match];
  const int index = static_cast<int>(match);
  const double off_mm = 1000 * (found.position - truth.position).norm();
  const double z = WorstZ(fit, index, truth.position);
  const double flux_percent = 100 * (found.flux_lm / truth.flux_lm - 1);
  const double flux_z =
      std::log(found.flux_lm / truth.flux_lm) / SigmaOf(fit, ParameterKind::kLogFlux, index);
  const double turned_deg =
      180 / kPi * std::atan2(found.aim.cross(truth.aim).norm(), found.aim.dot(truth.aim));
  std::printf(
      "  %-4s off by %7.1f mm (z %5.1f), flux %+7.2f %% (z %+5.1f), aim %5.1f deg, %s %s %.2f x %.2f m\n",
      truth.id.c_str(), off_mm, z, flux_percent, flux_z, turned_deg, ToString(found.distribution).c_str(),
      ToString(found.shape).c_str(), found.size_m[0], found.size_m[1]);
  EXPECT_LT(off_mm, is_outlined ? limits.outlined_off_mm : limits.off_mm) << truth.id;
  EXPECT_LT(z, limits.sigmas) << truth.id << " is not where the fit says, nor within its sigmas";
  EXPECT_LT(std::abs(flux_percent), limits.flux_percent) << truth.id;
}

StatedErrors ErrorsAlong(int axis, const TracedRoom& room, const RoomFit& fit,
                         const std::vector<size_t>& matches) {
  const FitUncertainty known = UncertaintyOf(fit.fit);
  std::vector<ParameterId> ids;
  std::vector<double> error;
  for (size_t k = 0; k < matches.size(); ++k) {
    const Luminaire& found = fit.fit.state.luminaires[matches[k]];
    const ParameterId id = {ParameterKind::kLuminaire, found.id, static_cast<LuminaireQuantity>(axis), 0};
    if (!(known.Covariance(id, id) > 0)) continue;  // held
    ids.push_back(id);
    error.push_back(found.position[axis] - room.luminaires[k].position[axis]);
  }
  StatedErrors errors;
  const auto n = static_cast<Eigen::Index>(ids.size());
  errors.kind.assign(ids.size(), ToString(ParameterKind::kLuminaire));
  errors.quantity.assign(ids.size(), ToString(static_cast<LuminaireQuantity>(axis)));
  errors.error = Eigen::Map<Eigen::VectorXd>(error.data(), n);
  errors.covariance = Eigen::MatrixXd::NullaryExpr(n, n, [&](Eigen::Index i, Eigen::Index j) {
    return known.Covariance(ids[static_cast<size_t>(i)], ids[static_cast<size_t>(j)]);
  });
  return errors;
}

// One of three means exceeds 2.4 standard errors by chance in 5 of 100 rooms.
void ExpectNoCommonError(const TracedRoom& room, const RoomFit& fit, const std::vector<size_t>& matches,
                         const FoundLimits& limits) {
  for (int axis = 0; axis < 3; ++axis) {
    const StatedErrors errors = ErrorsAlong(axis, room, fit, matches);
    ASSERT_GE(errors.error.size(), 2) << "axis " << axis;
    const MeanError mean = errors.MeanOf(errors.RowsOf(""));
    std::printf("  mean error along %c: %+.2f mm +- %.2f mm, z %+.2f\n", "xyz"[axis], 1000 * mean.mean,
                1000 * mean.standard_error, mean.Z());
    EXPECT_LT(std::abs(mean.Z()), 2.4) << "axis " << axis;
    EXPECT_LT(1000 * mean.standard_error, limits.common_error_mm) << "axis " << axis;
  }
}

// Prints status, rounds and warnings. Returns the mean error of the readings that only check, in percent.
double PrintCheck(const RoomObservations& given, const RoomFit& fit) {
  const std::vector<PredictedReading> predicted = PredictedReadings(fit);
  double sum = 0, worst = 0;
  int count = 0;
  for (size_t i = 0; i < predicted.size(); ++i) {
    const MeterReading& reading = given.meter.readings[i];
    if (reading.used || !predicted[i].is_known) continue;
    const double off = 100 * std::abs(predicted[i].illuminance_lx / reading.illuminance_lx - 1);
    sum += off, worst = std::max(worst, off), ++count;
  }
  const double mean = count > 0 ? sum / count : 0;
  PrintStates(fit);
  std::printf("  readings off by %.2f %% in the mean, %.2f %% at worst; %d rounds; %s\n", mean, worst,
              fit.rounds, fit.findings.IsUndetermined() ? "undetermined" : "done");
  for (const Warning& warning : fit.findings.warnings)
    std::printf("  %s: %s\n", warning.code.c_str(), warning.message.c_str());
  return mean;
}

// Returns a fit, and prints when its steps began and when it was done.
RoomFit FitTimed(const Room& model, const RoomObservations& given) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  FitRoomOptions timed;
  timed.on_step = [&](const std::string& step, const std::string&) {
    std::printf("  %5.1f s %s\n", seconds(), step.c_str());
    return std::shared_ptr<void>();
  };
  RoomFit fit = FitRoom(model, given, timed);
  std::printf("  %5.1f s done\n", seconds());
  return fit;
}

}  // namespace

std::vector<size_t> MatchesOf(const TracedRoom& room, const RoomFit& fit) {
  std::vector<size_t> matches;
  std::vector<bool> is_taken(room.luminaires.size(), false);
  for (size_t k = 0; k < room.luminaires.size(); ++k) {
    size_t nearest = room.luminaires.size();
    const auto off = [&](size_t i) {
      return (fit.fit.state.luminaires[i].position - room.luminaires[k].position).norm();
    };
    for (size_t j = 0; j < room.luminaires.size(); ++j) {
      if (is_taken[j] ||
          !AreSwitchedTogether(room, static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)))
        continue;
      if (nearest == room.luminaires.size() || off(j) < off(nearest)) nearest = j;
    }
    is_taken[nearest] = true;
    matches.push_back(nearest);
  }
  return matches;
}

RoomObservations ObserveTraced(const TracedRoom& room, const Room& model, std::mt19937_64& rng,
                               const TracedRoomOptions& options) {
  RoomObservations given;
  given.dimming = room.dimming;
  for (const Luminaire& luminaire : room.luminaires) {
    given.luminaires.emplace_back();
    given.luminaires.back().luminaire.id = luminaire.id;
  }
  const RayScene rays(room.truth);
  AddPhotos(room, rays, SightsOf(room, model, rays), options, rng, given);
  AddReadings(room, rays, options, rng, given);
  AddSeen(room, rays, options, rng, given);
  std::vector<int> states(room.dimming.size());
  std::iota(states.begin(), states.end(), 0);
  for (const Eigen::Vector3d& eye : room.eyes) given.views.push_back({eye, {}, states});
  return given;
}

void ExpectFound(const TracedRoom& room, const Room& model, const RoomObservations& given,
                 const FoundLimits& limits) {
  const RoomFit fit = FitTimed(model, given);
  ASSERT_TRUE(fit.IsUsable()) << fit.fit.message;
  const std::vector<size_t> matches = MatchesOf(room, fit);
  for (size_t k = 0; k < matches.size(); ++k)
    ExpectLuminaire(room.luminaires[k], IsFlat(room.luminaires[k]) && !IsHidden(room, k), fit, matches[k],
                    limits);
  ExpectNoCommonError(room, fit, matches, limits);
  EXPECT_LT(PrintCheck(given, fit), limits.reading_percent);
}

}  // namespace luxfit::support
