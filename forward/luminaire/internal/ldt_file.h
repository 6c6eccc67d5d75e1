// EULUMDAT photometric files (.ldt), read and written.
//
//   intensity = cd_per_klm * conversion factor * lamp flux / 1000
//
// The lamp flux is that of the first lamp set; further sets are alternatives, kept and not used. A negative
// number of lamps means absolute photometry: the set's flux is the luminaire's. Isym 3 stores its planes from
// C270 through C0 to C90. EULUMDAT's C0 plane lies across a linear luminaire, so the length of the luminous
// area runs along C90 and its width along C0.
//
// A decimal comma is read as a point, with a note. Text becomes UTF-8 (text_encoding.h).
// Sources: Stockmar (1990), "EULUMDAT - ein Leuchtendatenformat fuer den europaeischen Beleuchtungsplaner";
// Stockmar (1998), "EULUMDAT/2".
#ifndef LUXFIT_FORWARD_LUMINAIRE_INTERNAL_LDT_FILE_H_
#define LUXFIT_FORWARD_LUMINAIRE_INTERNAL_LDT_FILE_H_

#include <array>
#include <string>
#include <vector>

#include "forward/luminaire/photometry_file.h"

namespace luxfit {

struct LdtLamps {
  int count = 1;  // negative: absolute photometry
  std::string type;
  double flux_lm = 0;  // of all lamps of the set
  std::string colour, rendering, power;
};

// As the file has it, in its own units.
struct LdtFile {
  std::string name;  // for messages
  std::string company;
  int type_indicator = 1;                     // 1: point with symmetry, 2: linear, 3: point without
  int symmetry = 0;                           // Isym, 0 to 4
  int planes = 0;                             // Mc, all round
  double c_step_deg = 0, gamma_step_deg = 0;  // 0: not equidistant
  std::string report, luminaire, number, file, date;
  double length_mm = 0, width_mm = 0, height_mm = 0;
  double area_length_mm = 0, area_width_mm = 0;  // width 0: round
  std::array<double, 4> area_height_mm{};        // at C0, C90, C180, C270
  double downward_percent = 100, light_output_percent = 100, conversion_factor = 1, tilt_deg = 0;
  std::vector<LdtLamps> lamps;  // one at least
  std::array<double, 10> direct_ratio{};
  std::vector<double> c_deg;  // all planes
  std::vector<double> gamma_deg;
  std::vector<double> cd_per_klm;  // stored planes x gamma, gamma running fastest
  std::vector<std::string> notes;  // what the reader passed over
  std::vector<LightNote> light_notes;
};

// Throw std::runtime_error("NAME:LINE: field: expected X, got Y; remedy").
LdtFile ParseLdt(const std::string& text, const std::string& name);
LdtFile ReadLdt(const std::string& path);

// The file's text; reads back equal, number for number.
std::string LdtText(const LdtFile& file);

// The planes that are stored: their indices into c_deg.
std::vector<size_t> StoredPlanes(int symmetry, size_t planes);

PhotometryFile PhotometryOf(const LdtFile& file);

// Absolute photometry with every plane; downward flux and direct ratios by forward/luminaire/internal/flux_share.h. Throws
// std::invalid_argument for an empty table.
LdtFile MakeLdt(const PhotometryFile& photometry);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_INTERNAL_LDT_FILE_H_
