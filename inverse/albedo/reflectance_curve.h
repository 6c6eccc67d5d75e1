// Evaluates how the radiance of a surface depends on the angles of light and view, up to its albedo.
//
//   value = strength * (albedo * f(mu, nu, c, eta)) + a
//   lambert       f = mu
//   offset        f = mu              a: light that is always there, relative to the brightest value
//   exponent      f = mu^g            a response or a terminator that is not linear
//   oren_nayar    f = mu (A + B max(0, c - mu nu) / max(mu, nu)),   A, B of the roughness
//   gloss         f = mu^g + k eta^m  a broad highlight on top
//
// mu: cosine of normal and light, nu: of normal and view, c: of light and view, eta: of normal and the half
// vector of light and view. f is 0 where mu <= 0. Directions are unit vectors; all quantities here are
// dimensionless.
// Throws std::invalid_argument where the number of parameters is not that of the kind.
// Sources: Oren and Nayar (1994), "Generalization of Lambert's reflectance model", eq. 30; Blinn (1977),
// "Models of light reflection for computer synthesized pictures".
#ifndef LUXFIT_INVERSE_ALBEDO_REFLECTANCE_CURVE_H_
#define LUXFIT_INVERSE_ALBEDO_REFLECTANCE_CURVE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

namespace luxfit {

enum class CurveKind { kLambert, kOffset, kExponent, kOrenNayar, kGloss };

constexpr int kMaxCurveParameters = 3;

struct ReflectanceCurve {
  CurveKind kind = CurveKind::kLambert;
  // offset: a / brightest value · exponent: ln g · oren_nayar: variance of the facets' slope angle, rad2 ·
  // gloss: ln g, k, ln m
  Eigen::VectorXd parameters;
};

// Returns all kinds, from the simplest to the one with most parameters.
const std::vector<CurveKind>& AllCurveKinds();
std::string ToString(CurveKind kind);
// Describes the curve in words: "exponent g = 0.86".
std::string Describe(const ReflectanceCurve& curve);

int ParameterCount(CurveKind kind);
// Returns a curve close to Lambert, at which a search may start.
ReflectanceCurve StartCurve(CurveKind kind);
// Returns the nearest parameters with a meaning: roughness >= 0, highlights >= 0, ...
ReflectanceCurve WithinBounds(ReflectanceCurve curve);
// Returns whether a parameter stopped at such a bound: the data then do not follow this curve.
bool IsAtBound(const ReflectanceCurve& curve);

struct CurveAngles {
  double mu = 0, nu = 1, c = 0, eta = 0;
};
struct CurveValue {
  double f = 0;
  double d_mu = 0, d_nu = 0, d_c = 0, d_eta = 0;
  Eigen::Vector3d d_parameters = Eigen::Vector3d::Zero();  // derivatives of f, without the offset
};
CurveValue Evaluate(const ReflectanceCurve& curve, const CurveAngles& angles);

// Returns a / brightest value; 0 except for kOffset.
double OffsetOf(const ReflectanceCurve& curve);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_REFLECTANCE_CURVE_H_
