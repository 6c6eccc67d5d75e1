// Tells by counting how an .ies file writes its numbers, where programs depart from LM-63.
//
//   numbers after the opening's height = [3 +] V + H + V H      V, H: numbers of vertical and horizontal angles
//
// Some leave out the three: ballast factor, the number after it and the watts. LM-63 lets commas separate
// numbers, but some programs write decimal commas. A comma between two digits is read as a separator if only
// that fits the counts.
#ifndef LUXFIT_FORWARD_LUMINAIRE_INTERNAL_IES_DIALECT_H_
#define LUXFIT_FORWARD_LUMINAIRE_INTERNAL_IES_DIALECT_H_

#include <cstddef>
#include <functional>

#include "forward/luminaire/internal/photometry_text.h"

namespace luxfit {

// How the numbers that are left fit the counts.
enum class IesNumbers { kDoNotFit, kWithBallastLine, kWithoutBallastLine };

// `text` stands behind the height. Without the line the next number is the first vertical angle: 90, or 0 and
// less, which no ballast factor is. A file that is cut short by three numbers is thus none without the line.
IesNumbers IesNumbersAhead(const PhotometryText& text, size_t vertical, size_t horizontal);

// Says what commas between two digits are; kUnclear where neither reading fits: the file has another fault.
// `fits` reads what is left and returns whether its numbers fit; it may throw std::runtime_error where they do
// not. Throws std::runtime_error where only decimal commas fit, or both readings do.
enum class IesCommas { kNone, kSeparate, kUnclear };
IesCommas CommasInNumbers(const PhotometryText& text, const std::function<bool(PhotometryText&)>& fits);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_INTERNAL_IES_DIALECT_H_
