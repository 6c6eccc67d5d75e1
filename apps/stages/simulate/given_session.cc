#include "apps/stages/simulate/given_session.h"

#include <algorithm>

#include "apps/stages/simulate/given_luminaire.h"
#include "apps/text/input_error.h"
#include "apps/text/suggest.h"
#include "forward/direct/luminaire_body.h"
#include "forward/luminaire/distribution_ops.h"

namespace luxfit {
namespace {

std::runtime_error MissingKey(const Session& session, size_t index, const std::string& key,
                              const std::string& message) {
  const SessionLuminaire& given = session.luminaires[index];
  if (given.line == 0) {
    return InputError({session.path, 0}, "luminaire",
                      "expected a [[luminaire]] with id = " + Quoted(given.id) +
                          ", which [states] names, got none; its position_m and photometry are needed");
  }
  return InputError({session.path, given.line}, "luminaire[" + std::to_string(index) + "]." + key, message);
}

// Checks that everything that light depends on is given, since nothing is estimated here.
void ExpectGiven(const Session& session, const std::string& command) {
  if (session.luminaires.empty())
    throw InputError({session.path, 0}, "luminaire", "expected at least one [[luminaire]], got none; add it");
  for (size_t k = 0; k < session.luminaires.size(); ++k) {
    const SessionLuminaire& given = session.luminaires[k];
    if (given.line == 0 || !given.position_m)
      throw MissingKey(session, k, "position_m",
                       "expected a position, got nothing; add position_m = [x, y, z]");
    if (given.photometry == "auto")
      throw MissingKey(
          session, k, "photometry",
          "expected a distribution, got \"auto\": " + command +
              " estimates nothing; give a file (.ies, .ldt), " +
              ListQuoted(PhotometryNames([](const DistributionOps& o) { return !o.has_table; })));
    const DistributionOps* const ops = FindDistribution(given.photometry);  // null: a file
    if (ops != nullptr && ops->has_exponent && !given.cosine_exponent)
      throw MissingKey(
          session, k, "cosine_exponent",
          "expected the exponent of the cosine-power lobe, got nothing; add cosine_exponent = 3");
    if (ops != nullptr && ops->has_table && given.gamma_deg.empty())
      throw MissingKey(session, k, "gamma_deg",
                       "expected the nodes of the table, got nothing; add gamma_deg and cd_per_klm");
    if (!given.flux_lm && given.photometry_path.empty())
      throw MissingKey(session, k, "flux_lm", "expected a flux, got nothing; add flux_lm = 3000");
  }
}

}  // namespace

Eigen::Matrix3Xd GivenAlbedo(const Session& session, const Scene& scene) {
  Eigen::Matrix3Xd albedo(3, static_cast<Eigen::Index>(scene.materials.size()));
  std::vector<std::string> missing;
  for (size_t m = 0; m < scene.materials.size(); ++m) {
    if (scene.materials[m] == kLuminaireBodyMaterial) {
      albedo.col(static_cast<Eigen::Index>(m)).setZero();
      continue;
    }
    const auto known = session.scene->known_albedo_rgb.find(scene.materials[m]);
    if (known == session.scene->known_albedo_rgb.end()) {
      missing.push_back(Quoted(scene.materials[m]));
    } else {
      albedo.col(static_cast<Eigen::Index>(m)) = known->second;
    }
  }
  if (!missing.empty())
    throw InputError({session.path, session.scene->line}, "scene.albedo",
                     "expected a reflectance for every material of the mesh, got none for " +
                         ListNames(missing) + "; add a line such as " + missing.front() + " = 0.5");
  return albedo;
}

std::vector<Luminaire> GivenLuminaires(const Session& session, const std::string& command,
                                       RunContext& context) {
  ExpectGiven(session, command);
  std::vector<Luminaire> luminaires;
  for (size_t k = 0; k < session.luminaires.size(); ++k) {
    const GivenLuminaire known = ReadGivenLuminaire(session.luminaires[k]);
    const Luminaire& luminaire = known.luminaire;
    const bool flat =
        luminaire.shape == LuminaireShape::kDisc || luminaire.shape == LuminaireShape::kRectangle;
    if (flat && !(luminaire.size_m[0] > 0))
      throw MissingKey(session, k, "size_m",
                       "expected the size of a " + ToString(luminaire.shape) + ", got nothing; add size_m");
    if (known.file) {
      RecordPhotometryFile(luminaire.id, *known.file, context);
      if (!session.luminaires[k].flux_lm) WarnOfTilt(luminaire, *known.file, context);
    }
    luminaires.push_back(luminaire);
  }
  return luminaires;
}

ReadingPlaces PlacesOfReadings(const Session& session) {
  ReadingPlaces places;
  for (const SessionReading& reading : session.luxmeter.readings) {
    const Sensor sensor{reading.position_m, reading.normal, session.luxmeter.response};
    const auto known = std::find(places.sensors.begin(), places.sensors.end(), sensor);
    places.sensor_of_reading.push_back(static_cast<Eigen::Index>(known - places.sensors.begin()));
    if (known == places.sensors.end()) places.sensors.push_back(sensor);
  }
  return places;
}

GivenScene ReadGivenScene(const Session& session, const std::string& command, RunContext& context) {
  GivenScene given;
  given.lit.luminaires = GivenLuminaires(session, command, context);
  if (session.scene) {
    LoadedMesh mesh = LoadMesh(session);
    given.lit.scene = WithLuminaireBodies(std::move(mesh.scene), given.lit.luminaires);
    given.findings = std::move(mesh.findings);
  }
  given.lit.albedo_rgb = GivenAlbedo(session, given.lit.scene);
  if (!session.cameras.empty()) given.lit.channel_weights = session.cameras[0].luminance_weights;
  given.places = PlacesOfReadings(session);
  given.lit.sensors = given.places.sensors;
  context.choices.push_back({"bodies of luminaires",
                             "opaque, black",
                             {"opaque, black", "none"},
                             "flat luminaires that shine to one side shade and absorb; others are left out"});
  return given;
}

}  // namespace luxfit
