#include "inverse/furniture/internal/signature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace luxfit {

bool Signatures::Add(const SignatureView& view, double u, double v) {
  const int left = static_cast<int>(u), top = static_cast<int>(v);
  const auto a = static_cast<float>(u - left), b = static_cast<float>(v - top);
  const auto at = [&](int column, int row) {
    return (static_cast<size_t>(row) * static_cast<size_t>(view.width_px) + static_cast<size_t>(column)) *
           static_cast<size_t>(states_);
  };
  const size_t p00 = at(left, top), p10 = at(left + 1, top), p01 = at(left, top + 1),
               p11 = at(left + 1, top + 1);
  int known = 0;
  for (int s = 0; s < states_; ++s) {
    const auto i = static_cast<size_t>(s);
    const float* const y = view.log_luminance.data();
    const float value =
        (1 - b) * ((1 - a) * y[p00 + i] + a * y[p10 + i]) + b * ((1 - a) * y[p01 + i] + a * y[p11 + i]);
    value_.push_back(value);
    variance_.push_back(view.variance[p00 + i]);
    known += std::isfinite(value) ? 1 : 0;
  }
  if (known >= FewestStates()) return true;
  DropLast();
  return false;
}

void Signatures::DropLast() {
  value_.resize(value_.size() - static_cast<size_t>(states_));
  variance_.resize(value_.size());
}

bool Signatures::Agree(int a, int b, double tolerance) const {
  const auto states = static_cast<size_t>(states_);
  const size_t i = static_cast<size_t>(a) * states, j = static_cast<size_t>(b) * states;
  const auto t2 = static_cast<float>(tolerance * tolerance);
  const auto most = static_cast<float>(states_);
  float sum = 0;
  int known = 0;
  for (size_t s = 0; s < static_cast<size_t>(states_); ++s) {
    const float d = value_[i + s] - value_[j + s];
    if (!std::isfinite(d)) continue;
    ++known;
    sum += d * d / (t2 + variance_[i + s] + variance_[j + s]);
    if (sum >= most) return false;
  }
  return known >= FewestStates() && sum < static_cast<float>(known);
}

double Signatures::Difference(int a, int b, double tolerance) const {
  const auto states = static_cast<size_t>(states_);
  const size_t i = static_cast<size_t>(a) * states, j = static_cast<size_t>(b) * states;
  const auto t2 = static_cast<float>(tolerance * tolerance);
  double sum = 0;
  int known = 0;
  for (size_t s = 0; s < states; ++s) {
    const float d = value_[i + s] - value_[j + s];
    if (!std::isfinite(d)) continue;
    ++known;
    sum += d * d / (t2 + variance_[i + s] + variance_[j + s]);
  }
  return known < FewestStates() ? std::numeric_limits<double>::quiet_NaN() : sum / known;
}

std::uint64_t Signatures::LargestAgreement(double tolerance) const {
  const int among = std::min(count(), kMostViews);
  std::array<std::uint64_t, kMostViews> agree{};
  for (int a = 0; a < among; ++a) {
    agree[static_cast<size_t>(a)] |= std::uint64_t{1} << a;
    for (int b = a + 1; b < among; ++b) {
      if (!Agree(a, b, tolerance)) continue;
      agree[static_cast<size_t>(a)] |= std::uint64_t{1} << b;
      agree[static_cast<size_t>(b)] |= std::uint64_t{1} << a;
    }
  }
  return *std::max_element(agree.begin(), agree.begin() + among, [](std::uint64_t a, std::uint64_t b) {
    return __builtin_popcountll(a) < __builtin_popcountll(b);
  });
}

}  // namespace luxfit
