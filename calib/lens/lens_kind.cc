#include "calib/lens/lens_kind.h"

#include <algorithm>
#include <cctype>

namespace luxfit {
namespace {

constexpr int kMostKnots = 64;  // a control point every half degree of a usual lens

// The whole number that follows a prefix; -1 where the text is not that.
int NumberAfter(const std::string& text, const std::string& prefix) {
  if (text.compare(0, prefix.size(), prefix) != 0) return -1;
  const std::string digits = text.substr(prefix.size());
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (digits.empty() || digits.size() > 3 || !std::all_of(digits.begin(), digits.end(), is_digit)) return -1;
  return std::stoi(digits);
}

}  // namespace

bool operator==(const LensKind& a, const LensKind& b) {
  if (a.lens != b.lens) return false;
  return a.lens == LensModel::kOpenCv    ? a.coefficients == b.coefficients
         : a.lens == LensModel::kSplined ? a.knots == b.knots
                                         : true;
}

std::string ToString(const LensKind& kind) {
  switch (kind.lens) {
    case LensModel::kFisheye:
      return "FISHEYE";
    case LensModel::kSplined:
      return "SPLINED" + std::to_string(kind.knots);
    case LensModel::kOpenCv:
      break;
  }
  return "OPENCV" + std::to_string(kind.coefficients);
}

std::optional<LensKind> LensKindOf(const std::string& name) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  if (upper == "FISHEYE") return LensKind{LensModel::kFisheye, 4, 0};
  const int coefficients = NumberAfter(upper, "OPENCV"), knots = NumberAfter(upper, "SPLINED");
  if (coefficients == 4 || coefficients == 5 || coefficients == 8 || coefficients == 12)
    return LensKind{LensModel::kOpenCv, coefficients, 0};
  if (knots == 0 || (knots >= 4 && knots <= kMostKnots)) return LensKind{LensModel::kSplined, 0, knots};
  return std::nullopt;
}

}  // namespace luxfit
