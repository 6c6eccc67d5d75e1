// Adaptive quadrature in one and two dimensions, independent of forward/.
#ifndef LUXFIT_TESTS_SUPPORT_FORWARD_ADAPTIVE_INTEGRAL_H_
#define LUXFIT_TESTS_SUPPORT_FORWARD_ADAPTIVE_INTEGRAL_H_

#include <cmath>

namespace luxfit::support {

// Simpson's rule, halved until both halves together agree with the whole to 15 times the tolerance (Lyness,
// 1969). Kinks only make it halve more often.
template <typename Function>
double AdaptiveIntegral(const Function& f, double a, double b, double tolerance) {
  struct Piece {
    const Function& f;
    double Of(double a, double fa, double fm, double b, double fb, double tolerance, int depth) const {
      const double m = 0.5 * (a + b), h = (b - a) / 6;
      const double left = f(0.5 * (a + m)), right = f(0.5 * (m + b));
      const double whole = h * (fa + 4 * fm + fb);
      const double halves = 0.5 * h * (fa + 4 * left + 2 * fm + 4 * right + fb);
      if (depth == 0 || std::abs(halves - whole) < 15 * tolerance) return halves + (halves - whole) / 15;
      return Of(a, fa, left, m, fm, 0.5 * tolerance, depth - 1) +
             Of(m, fm, right, b, fb, 0.5 * tolerance, depth - 1);
    }
  };
  // Four pieces, so that no even function deceives it.
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const double from = a + 0.25 * k * (b - a), to = from + 0.25 * (b - a), middle = 0.5 * (from + to);
    sum += Piece{f}.Of(from, f(from), f(middle), to, f(to), 0.25 * tolerance, 30);
  }
  return sum;
}

// Mean of f(a, b) over the unit square [-1/2, 1/2]^2, or over the disc of diameter 1.
template <typename Function>
double MeanOverSquare(const Function& f, double tolerance) {
  const auto row = [&](double b) {
    return AdaptiveIntegral([&](double a) { return f(a, b); }, -0.5, 0.5, 0.1 * tolerance);
  };
  return AdaptiveIntegral(row, -0.5, 0.5, tolerance);
}
template <typename Function>
double MeanOverDisc(const Function& f, double tolerance) {
  const double pi = std::acos(-1.0);
  // b = sin(t) / 2, a = u cos(t) / 2: dA = cos^2(t) / 4 du dt, smooth up to the rim.
  const auto row = [&](double t) {
    const double b = 0.5 * std::sin(t), half = 0.5 * std::cos(t);
    return half * half * AdaptiveIntegral([&](double u) { return f(u * half, b); }, -1, 1, 0.1 * tolerance);
  };
  return AdaptiveIntegral(row, -0.5 * pi, 0.5 * pi, tolerance) * 4 / pi;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_FORWARD_ADAPTIVE_INTEGRAL_H_
