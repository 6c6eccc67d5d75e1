#include "inverse/albedo/reflectance_curve.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace luxfit {
namespace {

// Below this cosine a power of it is taken as a straight line, so that its slope stays finite.
constexpr double kSmallCosine = 1e-3;
// Lower limit of cosines in a denominator.
constexpr double kLeastCosine = 0.05;

struct Bounds {
  double start, lower, upper;
};

std::vector<Bounds> BoundsOf(CurveKind kind) {
  const Bounds log_exponent{0, -1, 1};
  switch (kind) {
    case CurveKind::kLambert:
      return {};
    case CurveKind::kOffset:
      return {{0, -0.3, 0.3}};
    case CurveKind::kExponent:
      return {log_exponent};
    case CurveKind::kOrenNayar:
      return {{0.02, 0, 1}};
    case CurveKind::kGloss:
      return {log_exponent, {0.05, 0, 2}, {std::log(10), std::log(2), std::log(200)}};
  }
  return {};
}

// Adds mu^g and its slopes by mu and ln g.
void AddPower(double mu, double log_g, CurveValue& value) {
  const double g = std::exp(log_g);
  const double base = std::max(mu, kSmallCosine);
  const double power = std::pow(base, g);
  const double share = mu / base;  // below kSmallCosine: a straight line to 0
  value.f += power * share;
  value.d_mu += mu > kSmallCosine ? g * power / mu : power / base;
  value.d_parameters[0] += power * share * g * std::log(base);
}

void AddRoughness(const CurveAngles& angles, double variance, CurveValue& value) {
  const double a = 1 - 0.5 * variance / (variance + 0.33);
  const double b = 0.45 * variance / (variance + 0.09);
  const double d_a = -0.5 * 0.33 / std::pow(variance + 0.33, 2);
  const double d_b = 0.45 * 0.09 / std::pow(variance + 0.09, 2);
  const double larger = std::max({angles.mu, angles.nu, kLeastCosine});
  const double across = std::max(0.0, angles.c - angles.mu * angles.nu);
  const double factor = a + b * across / larger;
  double d_factor_mu = 0, d_factor_nu = 0;
  if (across > 0) {
    d_factor_mu = -b * angles.nu / larger;
    d_factor_nu = -b * angles.mu / larger;
    if (larger == angles.mu) {
      d_factor_mu -= b * across / (larger * larger);
    } else if (larger == angles.nu) {
      d_factor_nu -= b * across / (larger * larger);
    }
  }
  value.f += angles.mu * factor;
  value.d_mu += factor + angles.mu * d_factor_mu;
  value.d_nu += angles.mu * d_factor_nu;
  value.d_c += across > 0 ? angles.mu * b / larger : 0;
  value.d_parameters[0] += angles.mu * (d_a + d_b * across / larger);
}

void AddHighlight(double eta, double share, double log_m, CurveValue& value) {
  if (eta <= kSmallCosine) return;
  const double m = std::exp(log_m);
  const double lobe = std::pow(eta, m);
  value.f += share * lobe;
  value.d_eta += share * m * lobe / eta;
  value.d_parameters[1] += lobe;
  value.d_parameters[2] += share * lobe * m * std::log(eta);
}

void ExpectParameters(const ReflectanceCurve& curve) {
  if (curve.parameters.size() == ParameterCount(curve.kind)) return;
  throw std::invalid_argument("ReflectanceCurve: expected " + std::to_string(ParameterCount(curve.kind)) +
                              " parameters for " + ToString(curve.kind));
}

}  // namespace

const std::vector<CurveKind>& AllCurveKinds() {
  static const std::vector<CurveKind> kinds{CurveKind::kLambert, CurveKind::kOffset, CurveKind::kExponent,
                                            CurveKind::kOrenNayar, CurveKind::kGloss};
  return kinds;
}

std::string ToString(CurveKind kind) {
  switch (kind) {
    case CurveKind::kLambert:
      return "lambert";
    case CurveKind::kOffset:
      return "offset";
    case CurveKind::kExponent:
      return "exponent";
    case CurveKind::kOrenNayar:
      return "oren_nayar";
    case CurveKind::kGloss:
      return "gloss";
  }
  return "";
}

std::string Describe(const ReflectanceCurve& curve) {
  ExpectParameters(curve);
  const auto& p = curve.parameters;
  char text[120] = "";
  if (curve.kind == CurveKind::kOffset)
    std::snprintf(text, sizeof text, " of %.1f %% of the brightest value", 100 * p[0]);
  if (curve.kind == CurveKind::kExponent) std::snprintf(text, sizeof text, " %.3f", std::exp(p[0]));
  if (curve.kind == CurveKind::kOrenNayar)
    std::snprintf(text, sizeof text, ", roughness %.3f rad", std::sqrt(p[0]));
  if (curve.kind == CurveKind::kGloss)
    std::snprintf(text, sizeof text, ": exponent %.3f and a highlight of %.3f with exponent %.1f",
                  std::exp(p[0]), p[1], std::exp(p[2]));
  return ToString(curve.kind) + text;
}

int ParameterCount(CurveKind kind) { return static_cast<int>(BoundsOf(kind).size()); }

ReflectanceCurve StartCurve(CurveKind kind) {
  const std::vector<Bounds> bounds = BoundsOf(kind);
  ReflectanceCurve curve{kind, Eigen::VectorXd(static_cast<Eigen::Index>(bounds.size()))};
  for (size_t i = 0; i < bounds.size(); ++i) curve.parameters[static_cast<Eigen::Index>(i)] = bounds[i].start;
  return curve;
}

ReflectanceCurve WithinBounds(ReflectanceCurve curve) {
  ExpectParameters(curve);
  const std::vector<Bounds> bounds = BoundsOf(curve.kind);
  for (size_t i = 0; i < bounds.size(); ++i) {
    double& value = curve.parameters[static_cast<Eigen::Index>(i)];
    value = std::clamp(value, bounds[i].lower, bounds[i].upper);
  }
  return curve;
}

bool IsAtBound(const ReflectanceCurve& curve) {
  ExpectParameters(curve);
  const std::vector<Bounds> bounds = BoundsOf(curve.kind);
  for (size_t i = 0; i < bounds.size(); ++i) {
    const double value = curve.parameters[static_cast<Eigen::Index>(i)];
    if (value <= bounds[i].lower || value >= bounds[i].upper) return true;
  }
  return false;
}

CurveValue Evaluate(const ReflectanceCurve& curve, const CurveAngles& angles) {
  ExpectParameters(curve);
  CurveValue value;
  if (angles.mu <= 0) return value;
  const auto& p = curve.parameters;
  switch (curve.kind) {
    case CurveKind::kLambert:
    case CurveKind::kOffset:
      value.f = angles.mu;
      value.d_mu = 1;
      break;
    case CurveKind::kExponent:
      AddPower(angles.mu, p[0], value);
      break;
    case CurveKind::kOrenNayar:
      AddRoughness(angles, p[0], value);
      break;
    case CurveKind::kGloss:
      AddPower(angles.mu, p[0], value);
      AddHighlight(angles.eta, p[1], p[2], value);
      break;
  }
  return value;
}

double OffsetOf(const ReflectanceCurve& curve) {
  return curve.kind == CurveKind::kOffset ? curve.parameters[0] : 0;
}

}  // namespace luxfit
