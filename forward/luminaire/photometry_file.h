// A photometric file (.ies, .ldt) as light needs it: distribution, flux, luminous opening.
//
// Errors in a file are std::runtime_error("FILE:LINE: field: expected X, got Y; mend"). What could be read
// but was guessed, rounded to a supported shape or ignored stands in `notes`, one sentence each. Sources:
// forward/luminaire/internal/ies_file.h, forward/luminaire/internal/ldt_file.h.
#ifndef LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_FILE_H_
#define LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_FILE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/luminaire/luminaire.h"
#include "forward/luminaire/photometry.h"

namespace luxfit {

// One line of description, in the order of the file. A line without a name (1986) has an empty one. Bytes as
// in the file: usually Latin-1.
struct PhotometryKeyword {
  std::string name, text;
};

struct PhotometryFile {
  std::string format;  // "IESNA:LM-63-2002", "EULUMDAT"
  std::vector<PhotometryKeyword> keywords;
  IntensityTable table;                              // normalised: cd per lm of the luminaire
  double luminaire_flux_lm = 0;                      // integral of the file's intensities
  double stated_flux_lm = 0;                         // what the file says of the same; 0: nothing
  double lamp_flux_lm = 0;                           // of its lamps; 0: absolute photometry
  LuminaireShape shape = LuminaireShape::kPoint;     // of the luminous opening, seen along the aim
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  // along C0, across; or a diameter
  std::vector<std::string> notes;
};

// By the extension, .ies or .ldt. A TILT file of an .ies is looked for beside it.
PhotometryFile ReadPhotometry(const std::string& path);

// The same from text; `name` gives the extension and stands in errors.
PhotometryFile ParsePhotometry(const std::string& text, const std::string& name);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_FILE_H_
