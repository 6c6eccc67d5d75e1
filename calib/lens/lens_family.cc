#include "calib/lens/lens_family.h"

#include <algorithm>
#include <cctype>

#include "calib/lens/internal/lens.h"

namespace luxfit {
namespace {

// Returns the whole number that follows a prefix; -1 where the text is anything else.
int NumberAfter(const std::string& text, const std::string& prefix) {
  if (text.compare(0, prefix.size(), prefix) != 0) return -1;
  const std::string digits = text.substr(prefix.size());
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (digits.empty() || digits.size() > 3 || !std::all_of(digits.begin(), digits.end(), is_digit)) return -1;
  return std::stoi(digits);
}

int SizeOf(const LensKind& kind) {
  const LensOps& ops = OpsOf(kind.lens);
  return ops.size == nullptr ? 0 : kind.*ops.size;
}

}  // namespace

const std::array<LensOps, 3>& Lenses() {
  static const std::array<LensOps, 3> lenses = {OpenCvLens(), FisheyeLens(), SplinedLens()};
  return lenses;
}

const LensOps& OpsOf(LensModel lens) {
  const auto& lenses = Lenses();
  return *std::find_if(lenses.begin(), lenses.end(), [lens](const LensOps& ops) { return ops.lens == lens; });
}

bool operator==(const LensKind& a, const LensKind& b) { return a.lens == b.lens && SizeOf(a) == SizeOf(b); }

LensKind KindOfSize(LensModel lens, int size) {
  const LensOps& ops = OpsOf(lens);
  LensKind kind{lens, 0, 0};
  kind.*(ops.size == nullptr ? &LensKind::coefficients : ops.size) = size;
  return kind;
}

double ParameterCount(const LensKind& kind, double height_over_width) {
  // Control points are equally dense along x and y.
  return OpsOf(kind.lens).has_control_points ? 2.0 * kind.knots * (kind.knots * height_over_width + 2)
                                             : 4.0 + kind.coefficients;
}

std::string ToString(const LensKind& kind) {
  const LensOps& ops = OpsOf(kind.lens);
  return ops.size == nullptr ? ops.key : ops.key + std::to_string(kind.*ops.size);
}

std::optional<LensKind> LensKindOf(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const LensOps& ops : Lenses()) {
    if (ops.size == nullptr && lower == ops.key) return KindOfSize(ops.lens, ops.coefficients);
    const int size = ops.size == nullptr ? -1 : NumberAfter(lower, ops.key);
    if (size >= 0 && ops.has_size(size)) return KindOfSize(ops.lens, size);
  }
  return std::nullopt;
}

}  // namespace luxfit
