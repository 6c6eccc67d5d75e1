#include "forward/luminaire/internal/ies_dialect.h"

#include <optional>
#include <string>

namespace luxfit {
namespace {

bool FitsAs(PhotometryText text, const std::function<bool(PhotometryText&)>& fits) {
  try {
    return fits(text);
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace

IesNumbers IesNumbersAhead(const PhotometryText& text, size_t vertical, size_t horizontal) {
  const size_t table = vertical + horizontal + vertical * horizontal;
  const size_t ahead = text.NumbersAhead();
  if (ahead != table && ahead != table + 3) return IesNumbers::kDoNotFit;
  const double first = PhotometryText(text).Number("vertical angles");
  if (ahead == table + 3) return first > 0 ? IesNumbers::kWithBallastLine : IesNumbers::kDoNotFit;
  return first <= 0 || first == 90 ? IesNumbers::kWithoutBallastLine : IesNumbers::kDoNotFit;
}

IesCommas CommasInNumbers(const PhotometryText& text, const std::function<bool(PhotometryText&)>& fits) {
  const std::optional<CommaInNumber> comma = text.FirstCommaInNumber();
  if (!comma) return IesCommas::kNone;
  const std::string with_points = text.RestWithDecimalPoints();
  const bool separate = FitsAs(text, fits);
  const bool decimal = FitsAs(PhotometryText(with_points, "", PhotometryText::Comma::kSeparates), fits);
  if (separate && !decimal) return IesCommas::kSeparate;
  if (!separate && !decimal) return IesCommas::kUnclear;
  if (separate)
    throw text.ErrorAt(
        comma->line, "numbers",
        "expected decimal points, got " + comma->shown +
            ", one number or two: the counts allow both; write a point or a blank for the comma");
  throw text.ErrorAt(comma->line, "numbers",
                     "expected decimal points, got decimal commas, such as " + comma->shown +
                         "; replace them by points: commas separate numbers in .ies");
}

}  // namespace luxfit
