#include "apps/stages/session_light.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "apps/stages/fit_stop.h"
#include "apps/stages/simulate/given_luminaire.h"
#include "calib/colour/camera_colours.h"
#include "forward/luminaire/distribution_ops.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {
namespace {

KnownPhotometry PhotometryOf(const SessionLuminaire& given) {
  if (!given.photometry_path.empty()) return KnownPhotometry::kFile;
  if (given.photometry == "auto") return KnownPhotometry::kNothing;
  const DistributionOps* const ops = FindDistribution(given.photometry);
  if (ops == nullptr || !ops->has_table) return KnownPhotometry::kLobe;
  return given.gamma_deg.empty() ? KnownPhotometry::kTableOpen : KnownPhotometry::kTable;
}

Meter MeterOf(const Session& session, const std::vector<LuminaireReading>& readings) {
  const SessionLuxmeter& given = session.luxmeter;
  Meter meter;
  meter.common_sigma = given.common_sigma;
  meter.sensor_sigma = given.sensor_sigma;
  std::map<std::string, int> sensors;
  for (const LuminaireReading& measured : readings) {
    const SessionReading& reading = measured.given;
    MeterReading taken;
    taken.sensor = {reading.position_m, reading.normal, given.response};
    taken.state = std::max(0, StateIndex(session, reading.state));
    taken.illuminance_lx = measured.illuminance_lx;
    taken.ambient_lx = measured.ambient_lx;
    taken.used = reading.role != ReadingRole::kCheck && !measured.is_outside;
    if (!reading.sensor.empty())
      taken.sensor_index = sensors.emplace(reading.sensor, static_cast<int>(sensors.size())).first->second;
    meter.readings.push_back(taken);
  }
  meter.sensor_count = static_cast<int>(sensors.size());
  return meter;
}

StatedVignetting VignettingOf(const SessionCamera& camera) {
  if (camera.vignetting == "none") return StatedVignetting::kNone;
  return camera.vignetting == "estimate" ? StatedVignetting::kEstimate : StatedVignetting::kFlatField;
}

}  // namespace

KnownLuminaire KnownOf(const SessionLuminaire& given) {
  KnownLuminaire known;
  GivenLuminaire read = ReadGivenLuminaire(given);
  known.luminaire = std::move(read.luminaire);
  known.file = std::move(read.file);
  known.photometry = PhotometryOf(given);
  known.photometry_name = given.photometry;
  known.shape_is_known = given.shape.has_value();
  known.position_m = given.position_m;
  known.position_sigma_m = given.position_sigma_m;
  known.aim = given.aim;
  known.heading = given.heading;
  known.flux_lm = given.flux_lm;
  known.flux_sigma_lm = given.flux_sigma_lm;
  known.is_held = given.is_held;
  return known;
}

std::vector<std::optional<double>> KnownAlbedo(const Session& session, const Room& room) {
  std::vector<std::optional<double>> known(room.scene.materials.size());
  for (size_t m = 0; session.scene && m < known.size(); ++m) {
    const auto given = session.scene->known_albedo_rgb.find(room.scene.materials[m]);
    if (given != session.scene->known_albedo_rgb.end())
      known[m] = LuminanceWeights(session).dot(given->second);
  }
  return known;
}

std::vector<int> NeutralMaterials(const Session& session, const Room& room) {
  std::vector<int> neutral;
  const std::vector<std::string>& materials = room.scene.materials;
  for (size_t m = 0; session.scene && m < materials.size(); ++m) {
    const std::vector<std::string>& stated = session.scene->neutral;
    if (std::find(stated.begin(), stated.end(), materials[m]) != stated.end())
      neutral.push_back(static_cast<int>(m));
  }
  return neutral;
}

std::vector<Eigen::VectorXd> DimmingOf(const Session& session) {
  std::vector<Eigen::VectorXd> by_state;
  for (const SessionState& state : session.states) {
    Eigen::VectorXd dimming = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(session.luminaires.size()));
    for (size_t k = 0; k < session.luminaires.size(); ++k) {
      const auto on = state.dimming.find(session.luminaires[k].id);
      if (on != state.dimming.end()) dimming[static_cast<Eigen::Index>(k)] = on->second;
    }
    by_state.push_back(std::move(dimming));
  }
  return by_state;
}

StateTable StateTableOf(const Session& session) {
  StateTable table;
  for (const SessionState& state : session.states) table.states.push_back(state.id);
  for (const SessionLuminaire& luminaire : session.luminaires) table.luminaires.push_back(luminaire.id);
  table.dimming = DimmingOf(session);
  return table;
}

RoomPhotos RoomPhotosOf(const Session& session, const LinearizedPhotos& photos) {
  RoomPhotos given;
  for (const LinearizedCamera& camera : photos.cameras)
    given.cameras.push_back({VignettingOf(camera.given), !camera.vignetting,
                             !camera.response || camera.given.response == "srgb", camera.Cdm2PerUnit()});
  for (const LinearizedPhoto& photo : photos.photos)
    given.photos.push_back({photo.view, photo.camera, StateIndex(session, photo.state),
                            photo.bracket.front().relative_exposure_s});
  return given;
}

RoomObservations RoomObservationsOf(const Session& session, const LinearizedSession& linearized,
                                    const Room& room, const Evidence& observed) {
  RoomObservations given;
  for (const SessionLuminaire& luminaire : session.luminaires) given.luminaires.push_back(KnownOf(luminaire));
  given.luminaires_are_named = !session.count_is_estimated;
  given.dimming = DimmingOf(session);
  given.observations = observed.observations;
  given.seen = observed.seen;
  given.outlines = observed.outlines;
  given.views = observed.views;
  given.pose_covariance = observed.pose_covariance;
  given.ambient_spread = observed.ambient_spread;
  const Eigen::Vector3d weights = LuminanceWeights(session);
  given.luminance_weights = weights / weights.sum();
  given.channels_are_of_sensor = !session.cameras.empty() && session.cameras[0].colours == kSensorColours;
  given.luminance_weights_are_assumed = !session.cameras.empty() && session.cameras[0].colours.empty();
  given.neutral = NeutralMaterials(session, room);
  given.meter = MeterOf(session, linearized.readings);
  given.albedo = KnownAlbedo(session, room);
  given.camera_scale = StatedScale(RoomPhotosOf(session, linearized.photos));
  return given;
}

Session WithCountedLuminaires(Session session, const LinearizedSession& linearized, const Room& room,
                              const Evidence& observed, RunContext& context) {
  const std::vector<std::string> groups = OpenGroups(session);
  if (!session.count_is_estimated && groups.empty()) return session;
  const StageTimer timer(context, "count", "how many luminaires there are");
  CountLuminairesOptions options;
  options.max_count = session.max_luminaires;
  if (context.stop) options.stop_reason = [stop = context.stop] { return stop->ReasonOfCount(); };
  const RoomObservations given = RoomObservationsOf(session, linearized, room, observed);
  if (session.count_is_estimated)
    return WithMoreLuminaires(std::move(session), CountLuminaires(room, given, options, context));
  for (const std::string& group : groups) {
    options.group = group;
    const RoomObservations alone = InOneState(given, StateOfGroupAlone(session, group));
    session = WithCountedGroup(std::move(session), group, CountLuminaires(room, alone, options, context));
  }
  return session;
}

}  // namespace luxfit
