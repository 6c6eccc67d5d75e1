#include "forward/luminaire.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Nodes and weights of Gauss-Legendre quadrature on [-1/2, 1/2], weights summing to 1.
// Golub and Welsch (1969): eigenvalues of the Jacobi matrix.
std::vector<SurfaceSample> GaussLegendre(int order) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(order, order);
  for (int k = 1; k < order; ++k) {
    jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1.0);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobi);
  std::vector<SurfaceSample> nodes(static_cast<size_t>(order));
  for (int k = 0; k < order; ++k) {
    const double first = eigen.eigenvectors()(0, k);
    nodes[static_cast<size_t>(k)] = {0.5 * eigen.eigenvalues()(k), 0, first * first};
  }
  return nodes;
}

}  // namespace

std::string ToString(Distribution distribution) {
  switch (distribution) {
    case Distribution::kIsotropic:
      return "isotropic";
    case Distribution::kLambertian:
      return "lambertian";
    case Distribution::kCosinePower:
      return "cosine_power";
  }
  return "";
}

std::string ToString(LuminaireShape shape) {
  switch (shape) {
    case LuminaireShape::kPoint:
      return "point";
    case LuminaireShape::kDisc:
      return "disc";
    case LuminaireShape::kRectangle:
      return "rectangle";
    case LuminaireShape::kSphere:
      return "sphere";
  }
  return "";
}

Intensity IntensityPerLumen(const Luminaire& luminaire, double cosine_gamma) {
  if (luminaire.distribution == Distribution::kIsotropic) return {1 / (4 * kPi), 0, 0};
  if (cosine_gamma <= 0) return {};
  if (luminaire.distribution == Distribution::kLambertian) return {cosine_gamma / kPi, 1 / kPi, 0};
  const double m = luminaire.cosine_exponent;
  const double log_cosine = std::log(cosine_gamma);
  const double lobe = std::exp(m * log_cosine) / (2 * kPi);
  return {(m + 1) * lobe, (m + 1) * m * lobe / cosine_gamma, lobe * (1 + (m + 1) * log_cosine)};
}

std::vector<SurfaceSample> SampleSurface(LuminaireShape shape, int order) {
  if (order < 1) throw std::invalid_argument("SampleSurface: expected order >= 1");
  std::vector<SurfaceSample> samples;
  if (shape == LuminaireShape::kRectangle) {
    const std::vector<SurfaceSample> nodes = GaussLegendre(order);
    for (const SurfaceSample& u : nodes) {
      for (const SurfaceSample& v : nodes) samples.push_back({u.a, v.a, u.weight * v.weight});
    }
  } else if (shape == LuminaireShape::kDisc) {
    // Radius by Gauss-Legendre in r^2 (equal area), angle by the trapezoidal rule, exact for trigonometric
    // polynomials.
    const int spokes = 2 * order + 1;
    for (const SurfaceSample& node : GaussLegendre(order)) {
      const double radius = 0.5 * std::sqrt(node.a + 0.5);
      for (int k = 0; k < spokes; ++k) {
        const double angle = 2 * kPi * k / spokes;
        samples.push_back({radius * std::cos(angle), radius * std::sin(angle), node.weight / spokes});
      }
    }
  } else {
    samples.push_back({});
  }
  return samples;
}

LuminaireAxes AxesOf(const Luminaire& luminaire) {
  Eigen::Vector3d along = luminaire.heading - luminaire.heading.dot(luminaire.aim) * luminaire.aim;
  // A heading along the aim says nothing: take any perpendicular.
  if (along.norm() < 1e-6) along = luminaire.aim.unitOrthogonal();
  along.normalize();
  return {along, luminaire.aim.cross(along)};
}

}  // namespace luxfit
