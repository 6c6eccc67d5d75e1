// A luminaire: where it hangs, how it shines, how large it is.
//
// Luminous intensity per lumen, gamma from the aim (nadir of the photometry):
//   isotropic      I = 1 / (4 pi)
//   Lambertian     I = cos(gamma) / pi                         gamma < 90 deg, else 0
//   cosine-power   I = (m + 1) cos^m(gamma) / (2 pi)           gamma < 90 deg, else 0
//   measured       a table over C and gamma, forward/luminaire/photometry.h; C0 along the heading
// each integrates to 1 lm over the sphere. A luminaire of finite size is that intensity spread evenly over
// its shape: the rectangle size_m[0] (along heading) x size_m[1], or the disc of diameter size_m[0], both
// perpendicular to aim.
//
// Units: m, lm, cd. World frame.
// Source: IES Lighting Handbook, 10th ed., ch. 5 (intensity and flux); cosine-power lobe: Wood (1964).
#ifndef LUXFIT_FORWARD_LUMINAIRE_LUMINAIRE_H_
#define LUXFIT_FORWARD_LUMINAIRE_LUMINAIRE_H_

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace luxfit {

struct IntensityTable;

enum class Distribution { kIsotropic, kLambertian, kCosinePower, kMeasured };
enum class LuminaireShape { kPoint, kDisc, kRectangle, kSphere };

std::string ToString(Distribution distribution);
std::string ToString(LuminaireShape shape);

struct Luminaire {
  std::string id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // centre, in world
  Eigen::Vector3d aim{0, 0, -1};                       // unit: direction of gamma = 0
  Eigen::Vector3d heading{1, 0, 0};                    // unit: the C0 half-plane, direction of size_m[0]
  Distribution distribution = Distribution::kLambertian;
  double cosine_exponent = 1;                             // m, of cosine-power only; > 0
  std::shared_ptr<const IntensityTable> table = nullptr;  // of measured only; normalised to 1 lm
  LuminaireShape shape = LuminaireShape::kPoint;
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
  // Of a rectangle: shares of the flux of its cells, along the heading x across, that sum to 1; empty: even.
  Eigen::ArrayXXd emission;
  double flux_lm = 1;
};

// Luminous intensity per lumen (cd/lm) of an analytic distribution at angle gamma from the aim, and its
// derivatives. Throws std::invalid_argument for a measured one, which needs the direction. A loop over many
// directions looks the function up once: forward/luminaire/distribution_ops.h.
struct Intensity {
  double cd_per_lm = 0;
  double d_cosine = 0;    // with respect to cos(gamma)
  double d_exponent = 0;  // with respect to m
};
Intensity IntensityPerLumen(const Luminaire& luminaire, double cosine_gamma);

// Points of the luminous surface in units of its size along heading and across (a, b in [-1/2, 1/2]), with
// weights that sum to 1: Gauss-Legendre on the rectangle, equal-area rings on the disc, one point for point
// and sphere. `order` points a side.
struct SurfaceSample {
  double a = 0, b = 0;
  double weight = 1;
};
std::vector<SurfaceSample> SampleSurface(LuminaireShape shape, int order);

// The direction across: b's axis, aim x heading (heading is made perpendicular to aim first).
struct LuminaireAxes {
  Eigen::Vector3d along, across;
};
LuminaireAxes AxesOf(const Luminaire& luminaire);

// Luminous fluxes in lm, one for each luminaire.
Eigen::VectorXd FluxesLm(const std::vector<Luminaire>& luminaires);

// Whether shape or light tells the heading: of a rectangle, or of a table that is not the same all round.
bool DependsOnHeading(const Luminaire& luminaire);

// Luminous intensity per lumen of any distribution towards a unit vector in world. A change d of the
// direction that keeps its length changes it by d_direction . d.
struct DirectedIntensity {
  double cd_per_lm = 0;
  Eigen::Vector3d d_direction = Eigen::Vector3d::Zero();
  double d_exponent = 0;  // with respect to m
};
DirectedIntensity IntensityPerLumen(const Luminaire& luminaire, const LuminaireAxes& axes,
                                    const Eigen::Vector3d& direction);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_LUMINAIRE_H_
