#include "forward/views/surface_view.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "forward/direct/internal/shadowed_light.h"
#include "forward/light/illuminance.h"
#include "forward/views/internal/vertex_interpolation.h"

namespace luxfit {
namespace {

// Describes where a ray meets a luminous surface, and how bright that is.
struct LuminousHit {
  double distance = std::numeric_limits<double>::infinity();
  double luminance_cd_m2 = 0;
};

// Returns the luminous intensity, cd, towards a place so far that the luminaire is a point.
double IntensityTowards(Luminaire luminaire, const Eigen::Vector3d& direction) {
  luminaire.shape = LuminaireShape::kPoint;
  return luminaire.flux_lm *
         DirectIlluminancePerLumen(luminaire, luminaire.position + direction, -direction).lx_per_lm;
}

LuminousHit MeetSphere(const Luminaire& luminaire, const Eigen::Vector3d& origin,
                       const Eigen::Vector3d& direction) {
  const double radius = luminaire.size_m[0] / 2;
  const Eigen::Vector3d to_center = luminaire.position - origin;
  const double along = to_center.dot(direction);
  const double discriminant = along * along - to_center.squaredNorm() + radius * radius;
  if (!(radius > 0) || discriminant < 0 || along <= std::sqrt(discriminant)) return {};
  return {along - std::sqrt(discriminant),
          IntensityTowards(luminaire, -direction) / (M_PI * radius * radius)};
}

LuminousHit MeetLuminaire(const Luminaire& luminaire, const Eigen::Vector3d& origin,
                          const Eigen::Vector3d& direction) {
  if (luminaire.shape == LuminaireShape::kSphere) return MeetSphere(luminaire, origin, direction);
  const double cosine = -luminaire.aim.dot(direction);
  if (luminaire.shape == LuminaireShape::kPoint || cosine <= 1e-6) return {};
  const double distance = -luminaire.aim.dot(luminaire.position - origin) / cosine;
  if (distance <= 0) return {};
  const LuminaireAxes axes = AxesOf(luminaire);
  const Eigen::Vector3d at = origin + distance * direction - luminaire.position;
  const Eigen::Vector2d place(axes.along.dot(at), axes.across.dot(at));
  const bool disc = luminaire.shape == LuminaireShape::kDisc;
  const bool met = disc ? place.norm() < luminaire.size_m[0] / 2
                        : (place.cwiseAbs().array() < luminaire.size_m.array() / 2).all();
  if (!met) return {};
  const double area_m2 =
      disc ? M_PI / 4 * luminaire.size_m[0] * luminaire.size_m[0] : luminaire.size_m[0] * luminaire.size_m[1];
  return {distance, IntensityTowards(luminaire, -direction) / (area_m2 * cosine)};
}

// Returns the illuminance (lx, one per channel) of a point of a facet's front.
Eigen::RowVectorXd IlluminanceAt(const Room& room, const LitRoom& lit, int facet, double u, double v,
                                 const ViewOptions& options) {
  const Facet& surface = room.scene.facets[static_cast<size_t>(facet)];
  const Eigen::Vector3d p = surface.PointAt(u, v), normal = surface.Normal();
  ShadowOptions shadows;
  shadows.grid = options.shadow_grid;
  double direct_lx = 0;
  for (const Luminaire& luminaire : lit.luminaires)
    direct_lx += luminaire.flux_lm * VisibleIlluminancePerLumen(room.rays, luminaire, p, normal, shadows);
  const Eigen::RowVectorXd indirect_lx =
      Interpolate(*lit.interpolation, lit.vertex_indirect_lx, facet, u, v).cast<double>().cwiseMax(0.0);
  return indirect_lx.array() + direct_lx;
}

// Returns the direct light of each luminaire at each element, lx (elements x luminaires).
Eigen::MatrixXf DirectAtElements(const Room& room, const std::vector<Luminaire>& luminaires) {
  const auto elements = static_cast<Eigen::Index>(room.patches.elements.size());
  const LuminaireVisibility visibility = ComputeVisibility(room, {}, luminaires);
  Eigen::MatrixXf direct_lx = Eigen::MatrixXf::Zero(elements, static_cast<Eigen::Index>(luminaires.size()));
  tbb::parallel_for(Eigen::Index{0}, elements, [&](Eigen::Index e) {
    const Element& element = room.patches.elements[static_cast<size_t>(e)];
    for (Eigen::Index k = 0; k < direct_lx.cols(); ++k) {
      const float visible = visibility.elements(e, k);
      if (visible == 0) continue;
      const Luminaire& luminaire = luminaires[static_cast<size_t>(k)];
      direct_lx(e, k) =
          visible *
          static_cast<float>(luminaire.flux_lm *
                             DirectIlluminancePerLumen(luminaire, element.center, element.normal).lx_per_lm);
    }
  });
  return direct_lx;
}

// Returns for each column of direct light at elements the reflected light at vertices, lx (vertices x channels). Each
// channel's exchange of light is solved once for all columns.
std::vector<Eigen::MatrixXf> ReflectedAtVertices(const Room& room, const VertexInterpolation& interpolation,
                                                 const Eigen::MatrixXf& element_direct_lx,
                                                 const Eigen::MatrixXd& albedo) {
  const Eigen::MatrixXf patch_direct_lx = PatchMean(room.patches, element_direct_lx);
  std::vector<Eigen::MatrixXf> reflected_lx(static_cast<size_t>(element_direct_lx.cols()),
                                            Eigen::MatrixXf(interpolation.VertexCount(), albedo.cols()));
  for (Eigen::Index c = 0; c < albedo.cols(); ++c) {
    const Eigen::MatrixXf exitance = Transport(room.transport, albedo.col(c)).Exitance(patch_direct_lx);
    const Eigen::MatrixXf at_vertices = AtVertices(interpolation, IndirectAtElements(room, exitance));
    for (Eigen::Index k = 0; k < at_vertices.cols(); ++k)
      reflected_lx[static_cast<size_t>(k)].col(c) = at_vertices.col(k);
  }
  return reflected_lx;
}

void ExpectAllMaterials(const Room& room, const Eigen::MatrixXd& albedo) {
  if (albedo.rows() != static_cast<Eigen::Index>(room.scene.materials.size()))
    throw std::invalid_argument("LightRoom: expected one row of reflectances a material");
}

std::shared_ptr<const VertexInterpolation> InterpolationOf(const Room& room) {
  return std::make_shared<const VertexInterpolation>(MakeVertexInterpolation(room.scene, room.patches));
}

}  // namespace

LitRoom LightRoom(const Room& room, const std::vector<Luminaire>& luminaires, const Eigen::MatrixXd& albedo) {
  ExpectAllMaterials(room, albedo);
  LitRoom lit{luminaires, albedo, {}, InterpolationOf(room)};
  const Eigen::MatrixXf direct_lx = DirectAtElements(room, luminaires).rowwise().sum();
  lit.vertex_indirect_lx = ReflectedAtVertices(room, *lit.interpolation, direct_lx, albedo).front();
  return lit;
}

std::vector<LitRoom> LightRoomByEach(const Room& room, const std::vector<Luminaire>& luminaires,
                                     const Eigen::MatrixXd& albedo) {
  ExpectAllMaterials(room, albedo);
  const auto interpolation = InterpolationOf(room);
  std::vector<Eigen::MatrixXf> reflected_lx =
      ReflectedAtVertices(room, *interpolation, DirectAtElements(room, luminaires), albedo);
  std::vector<LitRoom> lit;
  lit.reserve(luminaires.size());
  for (size_t k = 0; k < luminaires.size(); ++k)
    lit.push_back({{luminaires[k]}, albedo, std::move(reflected_lx[k]), interpolation});
  return lit;
}

Eigen::MatrixXd RenderView(const Room& room, const LitRoom& lit, const Eigen::Vector3d& origin,
                           const Eigen::Matrix3Xd& directions, const ViewOptions& options) {
  Eigen::MatrixXd luminance = Eigen::MatrixXd::Zero(directions.cols(), lit.albedo.cols());
  tbb::parallel_for(Eigen::Index{0}, directions.cols(), [&](Eigen::Index i) {
    const Eigen::Vector3d direction = directions.col(i);
    if (!direction.allFinite()) return;  // outside the camera's field of view
    const RayHit hit = room.rays.Trace(origin, direction);
    LuminousHit nearest;
    for (const Luminaire& luminaire : lit.luminaires) {
      const LuminousHit lamp = MeetLuminaire(luminaire, origin, direction);
      if (lamp.distance < nearest.distance) nearest = lamp;
    }
    if (nearest.distance < (hit.facet < 0 ? std::numeric_limits<double>::infinity() : hit.distance)) {
      luminance.row(i).setConstant(nearest.luminance_cd_m2);
    } else if (hit.facet >= 0 && hit.front) {
      const int material = room.scene.facets[static_cast<size_t>(hit.facet)].material;
      luminance.row(i) =
          lit.albedo.row(material).cwiseProduct(IlluminanceAt(room, lit, hit.facet, hit.u, hit.v, options)) /
          M_PI;
    }
  });
  return luminance;
}

}  // namespace luxfit
