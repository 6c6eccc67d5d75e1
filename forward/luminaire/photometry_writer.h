// A luminaire's distribution as the files that lighting programs load: .ies (LM-63-2002) and .ldt (EULUMDAT).
//
// Both hold the same table, so scaled that its integral is the luminaire's flux: absolute photometry, with no
// statement of lamps. Analytic distributions are tabulated: linear interpolation in gamma is then within
// 0.5 % of the peak of the distribution and its integral, before it is scaled, within 0.1 % of the flux.
// gamma has an even step (2.5, 1 or 0.5 deg) where one does, else smaller ones where the curve bends, down to
// 0.01 deg: enough up to cos^1e4; below cos^1 the fall to 0 in the last 0.02 deg above the horizontal is
// steeper than any step. Measured tables keep their angles, gamma completed to what LM-63 asks for (from 0 to
// 90 or 180); those about another axis, or that leave planes out, are resampled (5 deg of C, 1 deg of gamma).
//
// C0 is the luminaire's heading in both; the opening's length is along C0 in .ies and along C90 in .ldt, as
// each format defines it. EULUMDAT has no spheres: a sphere is a disc there.
//
// ASCII, CRLF, lines of at most 80 characters of label and 132 of numbers; numbers in plain decimals: seven
// digits of the largest intensity in .ies, five in .ldt. Flux in lm, lengths in m (.ies, to 0.1 mm) and mm
// (.ldt, whole ones). Sources: ANSI/IESNA LM-63-2002; Stockmar (1990, 1998), "EULUMDAT".
#ifndef LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_WRITER_H_
#define LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_WRITER_H_

#include <string>
#include <vector>

#include "forward/luminaire/luminaire.h"
#include "forward/luminaire/photometry_file.h"

namespace luxfit {

// What the files say of themselves. Beyond ASCII, and what is too long for the formats, is replaced or cut.
struct PhotometryLabels {
  std::string test;        // what the data come from
  std::string laboratory;  // who made them of it
  std::string manufacturer, catalogue_number, luminaire;
  std::string issue_date;
  std::vector<std::string> remarks;  // .ies only
};

struct PhotometryTexts {
  std::string ies, ldt;
};

// The luminaire's distribution, flux and opening. Throws std::invalid_argument for a flux that is not above
// 0, an exponent that is not, or a measured distribution without a table.
PhotometryFile TabulatedPhotometry(const Luminaire& luminaire);

// The same as text; throws the same.
PhotometryTexts WritePhotometry(const Luminaire& luminaire, const PhotometryLabels& labels);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_WRITER_H_
