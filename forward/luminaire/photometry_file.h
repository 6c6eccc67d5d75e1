// Reads and writes photometric files (.ies, .ldt) as light needs them: distribution, flux, luminous opening.
//
// Errors in a file are std::runtime_error("FILE:LINE: field: expected X, got Y; remedy"). What could be read
// but was guessed, rounded to a supported shape or ignored stands in `notes`, one sentence each.
//
// A luminaire is written as .ies (LM-63-2002) and .ldt (EULUMDAT). Both hold the same table, so scaled that
// its integral is the luminaire's flux: absolute photometry, with no statement of lamps. Analytic
// distributions are tabulated: linear interpolation in gamma is then within 0.5 % of the peak of the
// distribution and its integral, before it is scaled, within 0.1 % of the flux. gamma has an even step (2.5,
// 1 or 0.5 deg) where one does, else smaller ones where the curve bends, down to 0.01 deg. That is enough up
// to cos^1e4; below cos^1 the fall to 0 in the last 0.02 deg above the horizontal is steeper than any step.
// Measured tables keep their angles, gamma completed to what LM-63 asks for (from 0 to 90 or 180). Those
// about another axis, or that leave planes out, are resampled (5 deg of C, 1 deg of gamma).
//
// C0 is the luminaire's heading in both; the opening's length is along C0 in .ies and along C90 in .ldt, as
// each format defines it. EULUMDAT has no spheres: a sphere is a disc there.
//
// ASCII, CRLF, lines of at most 80 characters of label and 132 of numbers; numbers in plain decimals: seven
// digits of the largest intensity in .ies, five in .ldt. Flux in lm, lengths in m (.ies, to 0.1 mm) and mm
// (.ldt, whole ones).
//
// Sources: forward/luminaire/internal/ies_file.h, forward/luminaire/internal/ldt_file.h; ANSI/IESNA
// LM-63-2002; Stockmar (1990, 1998), "EULUMDAT".
#ifndef LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_FILE_H_
#define LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_FILE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/luminaire/luminaire.h"
#include "forward/luminaire/photometry.h"

namespace luxfit {

// Holds one line of description, in the order of the file. A line without a name (1986) has an empty one.
// Text is UTF-8, whatever the file is in.
struct PhotometryKeyword {
  std::string name, text;
};

// Says by what the light of a file as read may differ from the light that its maker measured.
struct LightNote {
  enum class Of { kFlux, kOpening, kDistribution };
  Of of;  // the flux, the luminous opening or the distribution: a session that gives it does without the file's
  std::string text;
};

struct PhotometryFile {
  std::string name;    // as it was given
  std::string format;  // "IESNA:LM-63-2002", "EULUMDAT"
  std::vector<PhotometryKeyword> keywords;
  IntensityTable table;                              // normalised: cd per lm of the luminaire
  double luminaire_flux_lm = 0;                      // integral of the file's intensities
  double stated_flux_lm = 0;                         // what the file says of the same; 0: nothing
  double lamp_flux_lm = 0;                           // of its lamps; 0: absolute photometry
  double factor = 1;                                 // the file's own of its intensities: multiplier, ballast
  LuminaireShape shape = LuminaireShape::kPoint;     // of the luminous opening, seen along the aim
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  // along C0, across; or a diameter
  std::vector<std::string> notes;
  std::vector<LightNote> light_notes;  // those of the notes that change the light, but for TILT
  // How the flux depends on the tilt of the lamp (LM-63, TILT): factors to the flux at 0, by the angle between the aim
  // and straight down, linear between. Empty: the file gives none, or names one that was not found.
  std::vector<double> tilt_deg, tilt_factor;
  std::string missing_tilt_file;  // its name; empty: none is missing
};

// Returns the factor by which the flux differs where the luminaire is aimed there; 1 where the file gives none.
// Source: ANSI/IESNA LM-63-2002, sec. 5.11 (lamp-to-luminaire geometry, angles, multiplying factors).
double TiltFactor(const PhotometryFile& file, const Eigen::Vector3d& aim);

// Reads a file by its extension, .ies or .ldt. A TILT file of an .ies is looked for beside it.
PhotometryFile ReadPhotometry(const std::string& path);

// Reads the same from text; `name` gives the extension and stands in errors.
PhotometryFile ParsePhotometry(const std::string& text, const std::string& name);

// Holds what written files say of themselves. Characters beyond ASCII are replaced, and what is too long for
// the formats is cut.
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

// Returns the luminaire's distribution, flux and opening as a file has them. Throws std::invalid_argument for
// a flux that is not above 0, an exponent that is not, or a measured distribution without a table.
PhotometryFile TabulatedPhotometry(const Luminaire& luminaire);

// Returns both files as text; throws the same.
PhotometryTexts WritePhotometry(const Luminaire& luminaire, const PhotometryLabels& labels);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_FILE_H_
