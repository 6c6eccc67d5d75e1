#include "apps/report/report_room.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/report/display_cells.h"
#include "apps/stages/simulate/given_luminaire.h"
#include "apps/text/formats/base64.h"
#include "apps/text/formats/json_vectors.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr int kMaxDisplayCells = 50'000;

json FacetsJson(const FittedRoom& fitted, const DisplayCells& display) {
  const std::vector<Facet>& facets = fitted.room.patches.facets;
  Eigen::MatrixXd corners(static_cast<Eigen::Index>(facets.size()), 9);
  std::vector<uint16_t> kinds;
  kinds.reserve(4 * facets.size());
  for (size_t f = 0; f < facets.size(); ++f) {
    corners.row(static_cast<Eigen::Index>(f)) << facets[f].origin.transpose(), facets[f].edge_u.transpose(),
        facets[f].edge_v.transpose();
    kinds.push_back(facets[f].kind == FacetKind::kTriangle ? 1 : 0);
    kinds.push_back(static_cast<uint16_t>(facets[f].material));
    kinds.push_back(static_cast<uint16_t>(display.grids[f][0]));
    kinds.push_back(static_cast<uint16_t>(display.grids[f][1]));
  }
  return {{"count", facets.size()}, {"corners", Base64Floats(corners)}, {"kinds", Base64Shorts(kinds)}};
}

// Encodes i, j and upper of every cell, and the number of cells of each facet.
json CellPlacesJson(const FittedRoom& fitted, const DisplayCells& display) {
  std::vector<uint16_t> places;
  std::vector<int> counts(fitted.room.patches.facets.size(), 0);
  places.reserve(3 * display.cells.size());
  for (const DisplayCell& cell : display.cells) {
    ++counts[static_cast<size_t>(cell.facet)];
    places.push_back(static_cast<uint16_t>(cell.i));
    places.push_back(static_cast<uint16_t>(cell.j));
    places.push_back(cell.is_upper ? 1 : 0);
  }
  return {{"count", display.cells.size()}, {"places", Base64Shorts(places)}, {"of_facet", counts}};
}

std::vector<uint16_t> DirectShares(const Eigen::MatrixXd& direct, const Eigen::MatrixXd& total) {
  std::vector<uint16_t> shares;
  shares.reserve(static_cast<size_t>(total.size()));
  for (Eigen::Index k = 0; k < total.cols(); ++k) {
    for (Eigen::Index c = 0; c < total.rows(); ++c) {
      const double share = total(c, k) > 0 ? std::clamp(direct(c, k) / total(c, k), 0.0, 1.0) : 0;
      shares.push_back(static_cast<uint16_t>(std::lround(65535 * share)));
    }
  }
  return shares;
}

// Adds what cells get of the light on the surface behind each body: shares of the body's largest, which is added, too.
void AddBodies(const Eigen::MatrixXd& response, json& room) {
  std::vector<uint16_t> shares;
  shares.reserve(static_cast<size_t>(response.size()));
  room["body_largest"] = VectorJson(response.colwise().maxCoeff().transpose());
  for (const auto& of_body : response.colwise()) {
    const double largest = of_body.maxCoeff();
    for (const double value : of_body)
      shares.push_back(
          static_cast<uint16_t>(largest > 0 ? std::lround(65535 * std::max(value, 0.0) / largest) : 0));
  }
  room["body"] = Base64Shorts(shares);
}

// Returns luminous intensity (cd) over gamma in the half planes at C and C + 180 degrees.
json PlaneCurve(const Luminaire& luminaire, double c_rad) {
  const LuminaireAxes axes = AxesOf(luminaire);
  // C runs counter-clockwise seen from behind (forward/luminaire/photometry.h), against `across`.
  const Eigen::Vector3d along = std::cos(c_rad) * axes.along - std::sin(c_rad) * axes.across;
  json curve = json::array();
  for (int degrees = -180; degrees <= 180; degrees += 3) {
    const double gamma = degrees * M_PI / 180;
    const Eigen::Vector3d direction = std::cos(gamma) * luminaire.aim + std::sin(gamma) * along;
    const double cd = luminaire.flux_lm * IntensityPerLumen(luminaire, axes, direction).cd_per_lm;
    curve.push_back(std::round(1e4 * cd) / 1e4);
  }
  return curve;
}

json CurvesJson(const Luminaire& luminaire) {
  return {{"c0", PlaneCurve(luminaire, 0)}, {"c90", PlaneCurve(luminaire, M_PI / 2)}};
}

// Returns the 95 % ellipsoid of a normal distribution; null where the data did not determine the position.
json EllipsoidJson(const Eigen::Matrix3d& covariance_m2) {
  if (!covariance_m2.allFinite()) return {};
  const double radius = std::sqrt(7.8147);  // chi squared of three degrees of freedom at 95 %
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance_m2);
  const Eigen::Vector3d semi_axes_m = radius * eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  Eigen::Matrix3d axes = eigen.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  return {{"semi_axes_m", VectorJson(semi_axes_m)}, {"axes", MatrixJson(axes.transpose())}};
}

}  // namespace

json ReportRoomJson(const FittedRoom& fitted) {
  const Patches& patches = fitted.room.patches;
  if (patches.elements.empty()) return nullptr;
  const DisplayCells display = MergeForDisplay(patches, kMaxDisplayCells);
  const PlaceLight& light = fitted.light->AtElements();
  const Eigen::MatrixXd total = CellMeans(patches, display, light.total_lx);
  const Eigen::MatrixXd direct = CellMeans(patches, display, light.direct_lx);
  const Eigen::AlignedBox3d box = fitted.room.scene.Bounds();
  json room = {
      {"facets", FacetsJson(fitted, display)},    {"cells", CellPlacesJson(fitted, display)},
      {"elements", patches.elements.size()},      {"merged", display.merged},
      {"total", Base64Floats(total.transpose())}, {"direct", Base64Shorts(DirectShares(direct, total))},
      {"materials", fitted.room.scene.materials}, {"albedo", VectorJson(fitted.albedo)},
      {"min_m", VectorJson(box.min())},           {"max_m", VectorJson(box.max())}};
  if (light.body_response.size() > 0) AddBodies(CellMeans(patches, display, light.body_response), room);
  return room;
}

json ReportLuminairesJson(const FittedRoom& fitted, const FitUncertainty& fit) {
  json luminaires = json::array();
  for (size_t k = 0; k < fitted.luminaires.size(); ++k) {
    const Luminaire& luminaire = fitted.luminaires[k];
    const LuminaireAxes axes = AxesOf(luminaire);
    json entry = {{"id", luminaire.id},
                  {"position_m", VectorJson(luminaire.position)},
                  {"aim", VectorJson(luminaire.aim)},
                  {"along", VectorJson(axes.along)},
                  {"across", VectorJson(axes.across)},
                  {"shape", ToString(luminaire.shape)},
                  {"size_m", VectorJson(luminaire.size_m)},
                  {"flux", luminaire.flux_lm},
                  {"curves", CurvesJson(luminaire)},
                  {"ellipsoid", EllipsoidJson(PositionCovariance(fit, luminaire.id))}};
    const GivenLuminaire given = ReadGivenLuminaire(fitted.session.luminaires[k]);
    if (given.file && given.file->luminaire_flux_lm > 0) {
      Luminaire stated = luminaire;
      stated.flux_lm = given.file->luminaire_flux_lm * TiltFactor(*given.file, luminaire.aim);
      entry["given"] = CurvesJson(stated);
      entry["given"]["flux_lm"] = stated.flux_lm;
      entry["given"]["file"] = fitted.session.luminaires[k].photometry;
    }
    luminaires.push_back(entry);
  }
  return luminaires;
}

json ReportCamerasJson(const FittedRoom& fitted) {
  json cameras = json::array();
  for (const RegisteredView& view : fitted.registered.registration.views) {
    const Camera& camera = fitted.registered.cameras[static_cast<size_t>(view.camera)];
    const Eigen::Isometry3d world_from_cam = view.cam_from_world.inverse();
    const double right = camera.width_px - 1.0, bottom = camera.height_px - 1.0;
    json corners = json::array();
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(0, 0), Eigen::Vector2d(right, 0),
                                         Eigen::Vector2d(right, bottom), Eigen::Vector2d(0, bottom)}) {
      const Eigen::Vector3d direction = world_from_cam.linear() * Unproject(camera, pixel);
      // A corner outside the lens's image circle has no ray.
      if (direction.allFinite()) corners.push_back(VectorJson(direction));
    }
    cameras.push_back({{"view", view.view},
                       {"position_m", VectorJson(world_from_cam.translation())},
                       {"forward", VectorJson(world_from_cam.linear().col(2))},
                       {"corners", corners}});
  }
  return cameras;
}

json ReportTagsJson(const FittedRoom& fitted) {
  json tags = json::array();
  const std::vector<SurveyedTag>& survey = fitted.session.tags.survey.empty()
                                               ? fitted.registered.registration.placed_tags
                                               : fitted.session.tags.survey;
  for (const SurveyedTag& tag : survey) {
    json corners = json::array();
    for (const Eigen::Vector3d& corner : TagCornersInWorld(tag)) corners.push_back(VectorJson(corner));
    tags.push_back({{"id", tag.id}, {"corners_m", corners}});
  }
  return tags;
}

}  // namespace luxfit
