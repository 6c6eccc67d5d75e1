#include "inverse/advise/room_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "forward/room/in_room.h"
#include "inverse/model/internal/intervals/known_parameters.h"

namespace luxfit {
namespace {

// Returns the point under the ceiling over (x, y); nothing where that lies outside the room.
std::optional<Eigen::Vector3d> UnderCeiling(const Room& room, double x, double y) {
  const Eigen::Vector3d eye(x, y, room.scene.Bounds().min().z() + kEyeHeightM);
  if (!IsInRoom(room.rays, eye)) return std::nullopt;
  const RayHit hit = room.rays.Trace(eye, Eigen::Vector3d::UnitZ());
  if (hit.facet < 0) return std::nullopt;
  return eye + std::max(0.0, hit.distance - kGuessedGapM) * Eigen::Vector3d::UnitZ();
}

std::vector<Eigen::Vector3d> CeilingGrid(const Room& room, int nx, int ny) {
  const Eigen::AlignedBox3d box = room.scene.Bounds();
  std::vector<Eigen::Vector3d> places;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const auto place = UnderCeiling(room, box.min().x() + (i + 0.5) * box.sizes().x() / nx,
                                      box.min().y() + (j + 0.5) * box.sizes().y() / ny);
      if (place) places.push_back(*place);
    }
  }
  return places;
}

// Returns places on the coarsest grid that has so many of them in the room.
std::vector<Eigen::Vector3d> GuessedPlaces(const Room& room, size_t count) {
  constexpr int kMostCells = 40;
  const Eigen::Vector3d size = room.scene.Bounds().sizes();
  std::vector<Eigen::Vector3d> grid;
  for (int cells = 1; cells <= kMostCells && grid.size() < count; ++cells) {
    // `cells` along the longer side.
    const double cell_m = std::max(size.x(), size.y()) / cells;
    grid = CeilingGrid(room, std::max(1, static_cast<int>(std::lround(size.x() / cell_m))),
                       std::max(1, static_cast<int>(std::lround(size.y() / cell_m))));
  }
  std::vector<Eigen::Vector3d> places;
  for (size_t i = 0; i < count; ++i) {
    places.push_back(grid.empty() ? room.scene.Bounds().center() : grid[i * grid.size() / count]);
  }
  return places;
}

double GuessedAlbedo(const Facet& facet) {
  constexpr double kFaces = 0.7;
  const double up = facet.Normal().z();
  if (up > kFaces) return 0.2;
  return up < -kFaces ? 0.7 : 0.5;
}

Eigen::VectorXd GuessedReflectances(const Room& room, const RoomKnowledge& known) {
  const auto count = static_cast<Eigen::Index>(room.scene.materials.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(count), area = sum;
  for (const Facet& facet : room.scene.facets) {
    sum[facet.material] += facet.AreaM2() * GuessedAlbedo(facet);
    area[facet.material] += facet.AreaM2();
  }
  Eigen::VectorXd albedo(count);
  for (Eigen::Index m = 0; m < count; ++m)
    albedo[m] = known.albedo[static_cast<size_t>(m)].value_or(area[m] > 0 ? sum[m] / area[m] : 0.5);
  return albedo;
}

bool HasKnownSize(const KnownLuminaire& known) {
  const bool is_point = known.luminaire.shape == LuminaireShape::kPoint;
  return known.file || (known.shape_is_known && (is_point || known.luminaire.size_m[0] > 0));
}

bool HasKnownLight(const KnownLuminaire& known) {
  return known.photometry == KnownPhotometry::kFile || known.photometry == KnownPhotometry::kLobe ||
         known.photometry == KnownPhotometry::kTable;
}

double KnownOrGuessedFlux(const KnownLuminaire& known) {
  const double of_file = known.file ? known.luminaire.flux_lm : 0;
  const double flux_lm = known.flux_lm.value_or(of_file);
  return flux_lm > 0 ? flux_lm : kGuessedFluxLm;
}

std::vector<Luminaire> GuessedLuminaires(const Room& room, const RoomKnowledge& known) {
  const auto unplaced = std::count_if(known.luminaires.begin(), known.luminaires.end(),
                                      [](const KnownLuminaire& l) { return !l.position_m; });
  const std::vector<Eigen::Vector3d> places = GuessedPlaces(room, static_cast<size_t>(unplaced));
  std::vector<Luminaire> luminaires;
  auto place = places.begin();
  for (const KnownLuminaire& of : known.luminaires) {
    Luminaire luminaire = of.luminaire;
    luminaire.position = of.position_m ? *of.position_m : *place++;
    luminaire.aim = of.aim.value_or(Eigen::Vector3d(0, 0, -1));
    luminaire.heading = of.heading.value_or(Eigen::Vector3d(1, 0, 0));
    if (!HasKnownLight(of)) luminaire.distribution = Distribution::kLambertian;
    if (!HasKnownSize(of)) {
      if (!of.shape_is_known) luminaire.shape = LuminaireShape::kRectangle;
      luminaire.size_m.setConstant(kGuessedPanelM);
    }
    luminaire.flux_lm = KnownOrGuessedFlux(of);
    luminaires.push_back(luminaire);
  }
  return luminaires;
}

// Returns the sigma that is known of a parameter: 0 where it is held, nothing where it is guessed.
std::optional<double> KnownSigma(const RoomKnowledge& known, const Parameter& parameter) {
  const auto index = static_cast<size_t>(parameter.index);
  if (parameter.kind == ParameterKind::kAlbedo)
    return known.albedo[index] ? std::optional(0.0) : std::nullopt;
  if (parameter.kind == ParameterKind::kLogCameraScale)
    return known.camera_is_absolute ? std::optional(0.0) : std::nullopt;
  const KnownLuminaire& of = known.luminaires[index];
  if (of.is_held) return 0;
  if (parameter.kind == ParameterKind::kLogFlux)
    return of.flux_sigma_lm ? std::optional(*of.flux_sigma_lm / KnownOrGuessedFlux(of)) : std::nullopt;
  if (parameter.quantity <= LuminaireQuantity::kPositionZ) return of.position_sigma_m;
  const bool is_size = parameter.quantity == LuminaireQuantity::kSizeAlong ||
                       parameter.quantity == LuminaireQuantity::kSizeAcross;
  return is_size && !HasKnownSize(of) ? std::nullopt : std::optional(0.0);
}

FitUncertainty GuessedUncertainty(const Room& room, const RoomKnowledge& known, const AdviceGiven& given) {
  LightState state = AllFree(room, given.luminaires, given.albedo);
  state.camera_scale_free = true;
  FitUncertainty fit;
  std::vector<double> variances;
  for (const Parameter& parameter : FreeParameters(room, state)) {
    const std::optional<double> sigma = KnownSigma(known, parameter);
    if (sigma && *sigma == 0) continue;
    fit.parameters.push_back(parameter.id());
    fit.is_determined.push_back(sigma.has_value());
    variances.push_back(sigma.value_or(0) * sigma.value_or(0));
  }
  fit.covariance =
      Eigen::VectorXd::Map(variances.data(), static_cast<Eigen::Index>(variances.size())).asDiagonal();
  fit.relative_model_sigma = kGuessedModelSigma;
  return fit;
}

template <typename IsGuessed>
void Assume(const std::vector<KnownLuminaire>& luminaires, const IsGuessed& is_guessed,
            const std::string& what, const std::string& value, std::vector<Assumption>& assumed) {
  Assumption assumption{what, {}, value};
  for (const KnownLuminaire& of : luminaires) {
    if (is_guessed(of)) assumption.of.push_back(of.luminaire.id);
  }
  if (!assumption.of.empty()) assumed.push_back(std::move(assumption));
}

// Materials of one reflectance are one assumption.
void AssumeAlbedo(const Room& room, const RoomKnowledge& known, const Eigen::VectorXd& albedo,
                  std::vector<Assumption>& assumed) {
  std::map<std::string, std::vector<std::string>> of_value;
  for (size_t m = 0; m < known.albedo.size(); ++m) {
    if (!known.albedo[m])
      of_value[fmt::format("{:.2g}", albedo[static_cast<Eigen::Index>(m)])].push_back(
          room.scene.materials[m]);
  }
  for (auto& [value, materials] : of_value) assumed.push_back({"reflectance", materials, value});
}

std::vector<Assumption> AssumptionsOf(const Room& room, const RoomKnowledge& known,
                                      const AdviceGiven& given) {
  std::vector<Assumption> assumed;
  const auto& luminaires = known.luminaires;
  Assume(
      luminaires, [](const KnownLuminaire& l) { return !l.position_m; }, "place",
      luminaires.size() == 1 ? "under the ceiling, in its middle" : "on a grid under the ceiling", assumed);
  Assume(
      luminaires, [](const KnownLuminaire& l) { return !HasKnownSize(l); }, "shape",
      fmt::format("panel of {0:g} m x {0:g} m", kGuessedPanelM), assumed);
  Assume(
      luminaires, [](const KnownLuminaire& l) { return !HasKnownLight(l); }, "distribution", "lambertian",
      assumed);
  Assume(
      luminaires, [](const KnownLuminaire& l) { return !l.flux_lm && !(l.file && l.luminaire.flux_lm > 0); },
      "flux", fmt::format("{:g} lm", kGuessedFluxLm), assumed);
  AssumeAlbedo(room, known, given.albedo, assumed);
  return assumed;
}

}  // namespace

RoomGuess GuessRoom(const Room& room, const RoomKnowledge& known) {
  if (room.scene.facets.empty()) throw std::invalid_argument("GuessRoom: expected a room with facets");
  if (known.luminaires.empty()) throw std::invalid_argument("GuessRoom: expected luminaires");
  if (known.albedo.size() != room.scene.materials.size())
    throw std::invalid_argument("GuessRoom: expected reflectances by material");
  RoomGuess guess;
  guess.given.luminaires = GuessedLuminaires(room, known);
  guess.given.albedo = GuessedReflectances(room, known);
  guess.given.fit = GuessedUncertainty(room, known, guess.given);
  guess.given.assumed_inflation = kGuessedInflation;
  guess.assumed = AssumptionsOf(room, known, guess.given);
  return guess;
}

int GuessedCount(const Room& room, int most) {
  double floor_m2 = 0;
  if (!room.scene.facets.empty()) {
    const double floor_z = room.scene.Bounds().min().z();
    for (const Facet& facet : room.scene.facets) {
      if (facet.Normal().z() > 0.7 && facet.origin.z() < floor_z + 0.1) floor_m2 += facet.AreaM2();
    }
  }
  return std::clamp(static_cast<int>(std::lround(floor_m2 / kM2PerLuminaire)), 1, std::max(1, most));
}

Camera GuessedCamera() {
  Camera camera;
  camera.width_px = 4000;
  camera.height_px = 3000;
  camera.fx_px = camera.fy_px = 0.5 * camera.width_px / std::tan(0.5 * kGuessedFieldDeg * M_PI / 180);
  camera.cx_px = 0.5 * (camera.width_px - 1);
  camera.cy_px = 0.5 * (camera.height_px - 1);
  return camera;
}

}  // namespace luxfit
