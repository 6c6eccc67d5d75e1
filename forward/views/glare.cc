#include "forward/views/glare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "forward/direct/internal/luminous_surface.h"

namespace luxfit {
namespace {

constexpr double kDegreesPerRad = 180 / M_PI;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Table 4.1 of CIE 117 ends here.
constexpr double kLargestSide = 3, kLargestHeight = 1.9;

// Holds where a direction meets the plane at distance 1 before the eye.
struct SightPlace {
  bool is_ahead = false;
  double height = 0, aside = 0;  // H / D above the line of sight, T / D to either side

  double Radius() const { return std::hypot(height, aside); }
};

SightPlace PlaceInSight(const Observer& observer, const Eigen::Vector3d& towards) {
  const Eigen::Vector3d& sight = observer.sight;
  const Eigen::Vector3d side = sight.cross(Eigen::Vector3d::UnitZ()).normalized();
  const double ahead = towards.dot(sight);
  if (!(ahead > 0)) return {};
  return {true, towards.dot(side.cross(sight)) / ahead, std::abs(towards.dot(side)) / ahead};
}

double IndexBelow(double radius) { return 1 + (radius < 0.6 ? 0.8 : 1.2) * radius; }

double IndexAbove(const SightPlace& at) {
  const double sigma_deg = std::atan(at.Radius()) * kDegreesPerRad;
  const double tau_deg = std::atan2(at.aside, at.height) * kDegreesPerRad;
  const double linear = 35.2 - 0.31889 * tau_deg - 1.22 * std::exp(-2 * tau_deg / 9);
  const double square = 21 + 0.26667 * tau_deg - 0.002963 * tau_deg * tau_deg;
  return std::exp(1e-3 * linear * sigma_deg + 1e-5 * square * sigma_deg * sigma_deg);
}

// Describes a piece of a luminous surface as seen from the eye: where, how large, how bright.
struct Piece {
  Eigen::Vector3d at;
  double solid_angle_sr = 0;
  double luminance_cd_m2 = 0;
};

// Returns the emission of the cell of an uneven surface over its mean.
double RelativeEmission(const Luminaire& luminaire, const SurfaceSample& sample) {
  const Eigen::ArrayXXd& emission = luminaire.emission;
  if (emission.size() == 0) return 1;
  const auto cell = [](double at, Eigen::Index count) {
    return std::clamp(static_cast<Eigen::Index>((at + 0.5) * static_cast<double>(count)), Eigen::Index{0},
                      count - 1);
  };
  return emission(cell(sample.a, emission.rows()), cell(sample.b, emission.cols())) *
         static_cast<double>(emission.size());
}

std::vector<Piece> PiecesOfSurface(const Luminaire& luminaire, const Eigen::Vector3d& eye, int order) {
  const LuminousSurface surface(luminaire);
  const Eigen::Vector2d& sides_m = surface.sides();
  const double area_m2 = surface.area_m2();
  std::vector<Piece> pieces;
  for (const SurfaceSample& sample : SampleSurface(luminaire.shape, order)) {
    const Eigen::Vector3d at = luminaire.position + sample.a * sides_m[0] * surface.axes().along +
                               sample.b * sides_m[1] * surface.axes().across;
    const Eigen::Vector3d to_eye = eye - at;
    const double distance_m = to_eye.norm();
    const Eigen::Vector3d direction = to_eye / distance_m;
    const double cosine = std::abs(direction.dot(luminaire.aim));
    const double intensity_cd = luminaire.flux_lm * surface.IntensityTowards(direction).cd_per_lm;
    if (cosine < 1e-6 || !(intensity_cd > 0)) continue;
    pieces.push_back({at, sample.weight * area_m2 * cosine / (distance_m * distance_m),
                      RelativeEmission(luminaire, sample) * intensity_cd / (area_m2 * cosine)});
  }
  return pieces;
}

// Returns the pieces of a sphere, which is as bright all over and is seen as a disc.
std::vector<Piece> PiecesOfSphere(const Luminaire& luminaire, const Eigen::Vector3d& eye, int order) {
  const Eigen::Vector3d to_eye = eye - luminaire.position;
  const double distance_m = to_eye.norm(), radius_m = 0.5 * luminaire.size_m[0];
  if (!(distance_m > radius_m)) return {};
  const Eigen::Vector3d normal = to_eye / distance_m;
  const Eigen::Vector3d along = normal.unitOrthogonal(), across = normal.cross(along);
  const double area_m2 = M_PI * radius_m * radius_m;
  const double intensity_cd =
      luminaire.flux_lm * IntensityPerLumen(luminaire, AxesOf(luminaire), normal).cd_per_lm;
  std::vector<Piece> pieces;
  for (const SurfaceSample& sample : SampleSurface(LuminaireShape::kDisc, order)) {
    const Eigen::Vector3d at =
        luminaire.position + radius_m * normal + 2 * radius_m * (sample.a * along + sample.b * across);
    pieces.push_back({at, sample.weight * area_m2 / (distance_m * distance_m), intensity_cd / area_m2});
  }
  return pieces;
}

}  // namespace

double PositionIndex(const Observer& observer, const Eigen::Vector3d& towards) {
  const SightPlace at = PlaceInSight(observer, towards);
  if (!at.is_ahead || at.aside > kLargestSide || at.height > kLargestHeight) return kInfinity;
  return at.height < 0 ? IndexBelow(at.Radius()) : IndexAbove(at);
}

double HemisphereIndex(const Observer& observer, const Eigen::Vector3d& towards) {
  constexpr double kLargestIndex = 16, kLargestRadius = 3;
  const SightPlace at = PlaceInSight(observer, towards);
  if (!at.is_ahead) return kInfinity;
  if (at.height < 0) return IndexBelow(std::min(at.Radius(), kLargestRadius));
  return std::min(IndexAbove(at), kLargestIndex);
}

GlareSource GlareOf(const RayScene& rays, const Luminaire& luminaire, const Observer& observer, int order) {
  GlareSource source;
  source.is_defined = luminaire.shape != LuminaireShape::kPoint && luminaire.size_m[0] > 0;
  if (!source.is_defined) return source;
  const std::vector<Piece> pieces = luminaire.shape == LuminaireShape::kSphere
                                        ? PiecesOfSphere(luminaire, observer.eye, order)
                                        : PiecesOfSurface(luminaire, observer.eye, order);
  double weighted = 0;
  for (const Piece& piece : pieces) {
    if (rays.Occluded(observer.eye, piece.at)) continue;
    source.solid_angle_sr += piece.solid_angle_sr;
    weighted += piece.solid_angle_sr * piece.luminance_cd_m2;
    const double index = PositionIndex(observer, (piece.at - observer.eye).normalized());
    if (!std::isfinite(index)) continue;
    source.sum += piece.luminance_cd_m2 * piece.luminance_cd_m2 * piece.solid_angle_sr / (index * index);
    source.least_index = source.least_index > 0 ? std::min(source.least_index, index) : index;
  }
  if (source.solid_angle_sr > 0) source.luminance_cd_m2 = weighted / source.solid_angle_sr;
  return source;
}

double UnifiedGlareRating(double sum, double background_cd_m2) {
  if (!(background_cd_m2 > 0))
    throw std::invalid_argument("UnifiedGlareRating: expected a background luminance > 0");
  return sum > 0 ? 8 * std::log10(0.25 * sum / background_cd_m2) : -kInfinity;
}

double DaylightGlareProbability(double sum, double vertical_lx) {
  if (!(vertical_lx > 0))
    throw std::invalid_argument("DaylightGlareProbability: expected an illuminance > 0");
  constexpr double kLowLightLx = 1000;
  const double dgp =
      5.87e-5 * vertical_lx + 9.18e-2 * std::log10(1 + sum / std::pow(vertical_lx, 1.87)) + 0.16;
  const double low = std::exp(0.024 * vertical_lx - 4);
  return std::min(1.0, vertical_lx < kLowLightLx ? dgp * low / (1 + low) : dgp);
}

}  // namespace luxfit
