#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/stages/check/check_report.h"
#include "apps/stages/check/check_warnings.h"
#include "apps/stages/check/explain_check.h"
#include "apps/stages/observe/explained_photos.h"
#include "apps/stages/observe/found_furniture.h"
#include "apps/stages/paint_surfaces.h"
#include "apps/stages/register/registration_json.h"
#include "apps/stages/stages.h"
#include "apps/stages/warning_order.h"
#include "apps/text/formats/json_vectors.h"
#include "calib/colour/colour_temperature.h"
#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/luminaire_parts.h"
#include "forward/luminaire/photometry.h"
#include "inverse/check/luxmeter_check.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {
namespace {

using nlohmann::json;

json Vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

json ViewsJson(const Session& session, const Registration& registration) {
  json views = json::array();
  for (const RegisteredView& view : registration.views) {
    const Eigen::Isometry3d world_from_cam = view.cam_from_world.inverse();
    json rotation = json::array();
    for (int r = 0; r < 3; ++r) rotation.push_back(Vector(world_from_cam.linear().row(r).transpose()));
    views.push_back({{"view", view.view},
                     {"camera", session.cameras[static_cast<size_t>(view.camera)].id},
                     {"position_m", Vector(world_from_cam.translation())},
                     {"R_scene_from_camera", rotation},
                     {"method", MethodOf(view)},
                     {"tags", view.tags_used},
                     {"reprojection_rms_px", view.reprojection_rms_px},
                     {"position_sigma_m", Vector(view.position_sigma_m)}});
  }
  return views;
}

json MaterialsJson(const Session& session, const Room& room, const RoomFit& fit) {
  json materials = json::array();
  const std::vector<bool> by_indirect_light = ToldByIndirectLight(room, fit);
  for (size_t m = 0; m < room.scene.materials.size(); ++m) {
    const std::string& name = room.scene.materials[m];
    const bool given = session.scene->known_albedo_rgb.count(name) > 0;
    const bool estimated = fit.fit.state.albedo_free[m];
    const double sigma = SigmaOf(fit.fit, ParameterKind::kAlbedo, static_cast<int>(m));
    const bool determined = given || (estimated && std::isfinite(sigma) && fit.TellsDirectLight());
    json material = {
        {"name", name},
        {"source", given ? "given" : (determined ? "estimated" : (estimated ? "undetermined" : "unseen"))}};
    material["albedo"] = determined ? json(fit.fit.state.albedo[static_cast<Eigen::Index>(m)]) : json();
    const Eigen::Vector3d rgb = given ? session.scene->known_albedo_rgb.at(name)
                                      : Eigen::Vector3d(fit.albedo_rgb.col(static_cast<Eigen::Index>(m)));
    material["albedo_rgb"] = determined && rgb.allFinite() ? Vector(rgb) : json();
    material["sigma"] = determined ? json(sigma) : json();
    material["by_indirect_light"] = static_cast<bool>(by_indirect_light[m]);
    // Unseen materials are listed too, since they also reflect light.
    material["albedo_in_model"] = fit.fit.state.albedo[static_cast<Eigen::Index>(m)];
    if (fit.fit.state.tint.size() > 0)
      material["tint_in_model"] = Vector(fit.fit.state.tint.col(static_cast<Eigen::Index>(m)));
    materials.push_back(material);
  }
  return materials;
}

// Returns nodes as in session files: cd per 1000 lm of the luminaire's flux.
void AddNodes(const IntensityTable& table, json& entry) {
  constexpr double kDegrees = 180 / M_PI;
  for (size_t j = 0; j < table.gamma_rad.size(); ++j) {
    entry["gamma_deg"].push_back(kDegrees * table.gamma_rad[j]);
    entry["cd_per_klm"].push_back(1000 * table.cd_per_lm[j]);
  }
}

json EmissionJson(const Eigen::ArrayXXd& emission) {
  json rows = json::array();
  for (const auto column : emission.colwise())
    rows.push_back(std::vector<double>(column.begin(), column.end()));
  return rows;
}

json SizeJson(const Luminaire& luminaire) {
  if (luminaire.shape == LuminaireShape::kPoint) return json::array();
  if (luminaire.shape == LuminaireShape::kRectangle) return {luminaire.size_m[0], luminaire.size_m[1]};
  return json::array({luminaire.size_m[0]});
}

std::string PhotometryName(const Luminaire& luminaire, const SessionLuminaire& given) {
  const DistributionOps& ops = OpsOf(luminaire.distribution);
  return ops.has_table && !given.photometry_path.empty() ? given.photometry : ops.photometry;
}

// `ratio_sigma`: of the smaller side's share over the larger one's, which is 1 - smaller.
void AddShareUp(const Luminaire& luminaire, double ratio_sigma, json& entry) {
  const Eigen::VectorXd shares = PartShares(luminaire, PartKind::kSide);
  const double reference = shares.maxCoeff();
  entry["share_up"] = shares[1];
  entry["share_up_sigma"] = ratio_sigma * reference * reference;
}

// Returns the covariance of ln XYZ for channels with independent relative errors.
Eigen::Matrix3d LogCovariance(const Eigen::Matrix3d& xyz_from_rgb, const Eigen::Vector3d& rgb,
                              const Eigen::Vector3d& relative_sigma) {
  const Eigen::Vector3d xyz = xyz_from_rgb * rgb;
  const Eigen::Matrix3d slope = xyz.cwiseInverse().asDiagonal() * xyz_from_rgb * rgb.asDiagonal();
  return slope * relative_sigma.cwiseAbs2().asDiagonal() * slope.transpose();
}

void AddColourTemperature(const Session& session, const RoomFit& fit, Eigen::Index luminaire, json& entry) {
  if (session.cameras.empty() || !session.cameras[0].xyz_from_rgb || luminaire >= fit.light_rgb.cols())
    return;
  const Eigen::Matrix3d& matrix = *session.cameras[0].xyz_from_rgb;
  const Eigen::Vector3d rgb = fit.light_rgb.col(luminaire), sigma = fit.light_rgb_sigma.col(luminaire);
  if (!rgb.allFinite() || !sigma.allFinite()) return;
  const auto colour = ColourTemperatureOf(matrix * rgb, LogCovariance(matrix, rgb, sigma));
  if (!colour) return;
  entry["cct_k"] = colour->kelvin;
  entry["cct_sigma_k"] = colour->kelvin_sigma;
  entry["duv"] = colour->duv;
  entry["duv_sigma"] = colour->duv_sigma;
  entry["chromaticity_xy"] = {colour->xy.x(), colour->xy.y()};
}

json LuminairesJson(const Session& session, const RoomFit& fit, const std::vector<LuminaireFiles>& files) {
  json luminaires = json::array();
  for (size_t k = 0; k < fit.fit.state.luminaires.size(); ++k) {
    if (!fit.luminaire_found[k]) continue;
    const Luminaire& luminaire = fit.fit.state.luminaires[k];
    const DistributionOps& ops = OpsOf(luminaire.distribution);
    const int index = static_cast<int>(k);
    const auto sigma = [&](LuminaireQuantity quantity) {
      return SigmaOf(fit, ParameterKind::kLuminaire, index, quantity);
    };
    json entry = {{"id", luminaire.id},
                  {"position_m", Vector(luminaire.position)},
                  {"position_sigma_m",
                   {sigma(LuminaireQuantity::kPositionX), sigma(LuminaireQuantity::kPositionY),
                    sigma(LuminaireQuantity::kPositionZ)}},
                  {"aim", Vector(luminaire.aim)},
                  {"photometry", PhotometryName(luminaire, session.luminaires[k])},
                  {"shape", ToString(luminaire.shape)},
                  {"size_m", SizeJson(luminaire)}};
    // Without an absolute scale, lumens would have no meaning.
    const bool is_known = IsFluxKnown(fit, k);
    entry["flux_lm"] = is_known ? json(luminaire.flux_lm) : json();
    entry["flux_sigma_lm"] =
        is_known ? json(luminaire.flux_lm * SigmaOf(fit, ParameterKind::kLogFlux, index)) : json();
    if (!fit.absolute) entry["flux_relative"] = luminaire.flux_lm;
    if (fit.fit.state.free[k].tilt) {
      constexpr double kDegrees = 180 / M_PI;
      entry["aim_sigma_deg"] = {kDegrees * sigma(LuminaireQuantity::kTiltAlong),
                                kDegrees * sigma(LuminaireQuantity::kTiltAcross)};
    }
    if (DependsOnHeading(luminaire)) entry["heading"] = Vector(AxesOf(luminaire).along);
    if (fit.fit.state.free[k].heading) {
      constexpr double kDegrees = 180 / M_PI;
      entry["heading_sigma_deg"] = kDegrees * sigma(LuminaireQuantity::kHeading);
    }
    if (ops.has_table && session.luminaires[k].photometry_path.empty()) AddNodes(*luminaire.table, entry);
    if (fit.fit.state.free[k].sides) AddShareUp(luminaire, sigma(LuminaireQuantity::kSide), entry);
    if (luminaire.emission.size() > 0) entry["emission"] = EmissionJson(luminaire.emission);
    if (ops.has_exponent) {
      entry["cosine_exponent"] = luminaire.cosine_exponent;
      entry["cosine_exponent_sigma"] = luminaire.cosine_exponent * sigma(LuminaireQuantity::kExponent);
    }
    if (fit.tint_rgb.cols() > index && fit.tint_rgb.col(index).allFinite())
      entry["tint_rgb"] = Vector(fit.tint_rgb.col(index));
    AddColourTemperature(session, fit, index, entry);
    if (!files[k].ies.empty()) entry["files"] = {{"ies", files[k].ies}, {"ldt", files[k].ldt}};
    luminaires.push_back(entry);
  }
  return luminaires;
}

json DirectJson(const PredictedReading& prediction, const RoomFit& fit) {
  json by_luminaire = json::object();
  for (Eigen::Index k = 0; k < prediction.direct_lx.size(); ++k) {
    if (prediction.direct_lx[k] > 0)
      by_luminaire[fit.fit.state.luminaires[static_cast<size_t>(k)].id] = prediction.direct_lx[k];
  }
  return by_luminaire;
}

void AddLuxmeter(const std::vector<LuminaireReading>& readings, const RoomFit& fit,
                 const std::vector<ReadingExplanation>& explanations, RunContext& context, json& result) {
  result["luxmeter"] = json::array();
  const std::vector<PredictedReading> predictions = PredictedReadings(fit);
  for (size_t i = 0; i < predictions.size(); ++i) {
    const SessionReading& given = readings[i].given;
    const PredictedReading& prediction = predictions[i];
    const CheckedReading reading{readings[i].illuminance_lx, prediction.illuminance_lx,
                                 fit.data.readings[i].sigma_lx, prediction.sigma_lx};
    json entry = {{"id", given.id},
                  {"state", given.state},
                  {"role", ToString(given.role)},
                  {"measured_lx", given.is_measured ? json(reading.measured_lx) : json()}};
    const bool predicted = prediction.is_known && !readings[i].is_outside;
    entry["predicted_lx"] = predicted ? json(reading.predicted_lx) : json();
    for (const std::string name : {"measured", "predicted"}) entry[name + "_lux"] = entry[name + "_lx"];
    entry["direct_lx"] = predicted && fit.TellsDirectLight() ? json(prediction.direct_lx.sum()) : json();
    if (predicted && fit.TellsDirectLight()) entry["direct_by_luminaire_lx"] = DirectJson(prediction, fit);
    entry["sigma_lx"] = predicted ? json(prediction.parameter_sigma_lx) : json();
    entry["prediction_sigma_lx"] = predicted ? json(prediction.sigma_lx) : json();
    if (predicted) {
      constexpr double kTwoSided95 = 1.96;
      entry["interval95_lx"] = {std::max(0.0, reading.predicted_lx - kTwoSided95 * prediction.sigma_lx),
                                reading.predicted_lx + kTwoSided95 * prediction.sigma_lx};
    }
    if (given.is_measured) entry["measured_sigma_lx"] = reading.measured_sigma_lx;
    if (given.is_measured && predicted) entry["z"] = ZScore(reading);
    result["luxmeter"].push_back(entry);
  }
  WarnOfExplanations(explanations, context);
  const std::vector<NamedReading> named = CheckedReadings(result["luxmeter"]);
  std::vector<CheckedReading> checked;
  checked.reserve(named.size());
  for (const NamedReading& reading : named) checked.push_back(reading.reading);
  WarnOfCheck(named, context);
  result["summary"] = SummaryJson(SummarizeLuxmeter(checked));
  result["check"] = CheckJson(result["luxmeter"]);
  if (!explanations.empty()) result["check"]["explained"] = ExplainedJson(explanations);
}

json DirectShareJson(const DirectShare& share) {
  json candidates = json::array();
  for (const DirectShareCandidate& c : share.candidates)
    candidates.push_back({{"model", c.name},
                          {"share", c.share},
                          {"sigma", c.sigma},
                          {"rms", c.rms},
                          {"admissible", c.is_admissible}});
  return {{"share", share.share},
          {"interval95", {share.lower, share.upper}},
          {"determined", share.is_determined},
          {"candidates", candidates}};
}

}  // namespace

json ChoicesJson(const RunContext& context) {
  json choices = json::array();
  for (const Choice& c : context.choices)
    choices.push_back({{"what", c.what}, {"chosen", c.chosen}, {"among", c.among}, {"because", c.because}});
  return choices;
}

json TypesJson(const RoomFit& fit) {
  const auto id = [&](int k) { return fit.fit.state.luminaires[static_cast<size_t>(k)].id; };
  json types = json::array();
  for (const LuminaireType& type : fit.types) {
    json ids = json::array(), deviating = json::array();
    for (const int k : type.luminaires) ids.push_back(id(k));
    for (const DeviatingFlux& flux : type.deviating)
      deviating.push_back({{"id", id(flux.luminaire)}, {"flux_ratio", flux.ratio}, {"z", flux.z}});
    types.push_back({{"luminaires", ids},
                     {"flux_lm", fit.absolute ? json(type.flux) : json(nullptr)},
                     {"flux_spread", NumberOrNull(type.relative_spread)},
                     {"deviating", deviating}});
  }
  return types;
}

void AddStatus(const RunContext& context, json& artifact) {
  std::vector<std::string> because;
  for (const Warning& w : context.warnings) {
    if (w.is_of_outcome && std::count(because.begin(), because.end(), w.code) == 0) because.push_back(w.code);
  }
  artifact["status"] = because.empty() ? "done" : "undetermined";
  artifact.erase("status_because");  // the artifact may be an earlier one
  if (!because.empty()) artifact["status_because"] = because;
}

json WarningsJson(const RunContext& context) {
  json warnings = json::array();
  for (const Warning& w : context.warnings)
    warnings.push_back({{"code", w.code}, {"message", w.message}, {"remedy", w.remedy}});
  return warnings;
}

json ResultJson(const Session& session, const std::vector<LuminaireReading>& readings, const Room& room,
                const RegisteredSession& registered, const Evidence& observed, const RoomFit& fit,
                const std::vector<LuminaireFiles>& files, RunContext& context) {
  json result = ProvenanceJson("luxfit-result-1", context.provenance);
  result["session"] = session.name;
  result["session_file"] = session.path;
  AddLuxmeter(readings, fit, ExplainCheck(session, readings, room, fit), context, result);
  PutCausesFirst(context.warnings);
  AddStatus(context, result);
  if (fit.stopped) result["stopped"] = {{"reason", fit.stopped->reason}, {"step", fit.stopped->step}};
  if (!registered.misplaced.empty()) result["misplaced_photos"] = MisplacedJson(registered.misplaced);
  if (!observed.photos_as_if.empty())
    result["photos_as_if"] = PhotosAsIfJson(session, registered.registration, observed.photos_as_if);
  if (!observed.states_as_if.empty()) result["states_as_if"] = StatesAsIfJson(observed.states_as_if);
  result["views"] = ViewsJson(session, registered.registration);
  result["reprojection_rms_px"] = registered.registration.reprojection_rms_px;
  result["materials"] = MaterialsJson(session, room, fit);
  const json surfaces = PaintSurfacesJson(room, fit, context);
  if (!surfaces.empty()) result["surfaces"] = surfaces;
  if (session.scene && !session.scene->furniture.empty())
    result["furniture"] = BoxesJson(session.scene->furniture);
  if (session.scene && !session.scene->walls.empty()) result["walls_moved"] = WallsJson(session.scene->walls);
  if (session.scene && !session.scene->moves.empty())
    result["furniture_moved"] = MovesJson(session.scene->moves);
  if (session.scene && !session.scene->parts.empty())
    result["painted_parts"] = PartsJson(session.scene->parts);
  result["luminaires"] = LuminairesJson(session, fit, files);
  if (!fit.types.empty()) result["luminaire_types"] = TypesJson(fit);
  // Relative luminance per cd/m2, by which the camera is a luminance meter.
  if (fit.absolute && !fit.data.observations.empty()) result["camera_scale"] = fit.fit.state.camera_scale;
  result["luminaire_bodies"] = ToString(fit.fit.state.bodies);
  result["luminance_weights"] = Vector(fit.data.luminance_weights);
  if (fit.direct_share) result["direct_share"] = DirectShareJson(*fit.direct_share);
  result["choices"] = ChoicesJson(context);
  result["warnings"] = WarningsJson(context);
  result["timing_s"] = context.timing_s;
  result["model"] = {{"patches", room.patches.patches.size()},
                     {"elements", room.patches.elements.size()},
                     {"bounces", "all"},
                     {"rays_escaped_fraction", room.form_factors.escaped_fraction},
                     {"observations", fit.data.observations.size()},
                     {"parameters", fit.fit.parameters.size()},
                     {"relative_model_error", fit.fit.relative_sigma}};
  return result;
}

}  // namespace luxfit
