// IES LM-63 photometric files (.ies): 1986, 1991, 1995, 2002 and 2019, read and written.
//
//   intensity = candela * multiplier * ballast factor * (1986 and 1991 only: ballast-lamp photometric factor)
//
// The number after the ballast factor is that photometric factor in 1986 and 1991, reserved in 1995 and 2002,
// and a code of how the file was made in 2019 (1.1xxxx): it multiplies in the first two only. Lumens of -1
// mean absolute photometry.
//
// Frames. Type C is the luminaire's own (forward/luminaire/photometry.h). Type A: same vertical axis, V from the
// horizontal up, H clockwise seen from above, so gamma = 90 + V, C = -H. Type B: the planes share the
// horizontal axis across C0; (H, V) = (0, 0) is straight down and (0, 90) along C0. Planes of type A and B
// that are not given are dark. The luminous opening's length runs along C0, its width across. Its negative
// measures mean round; what is no point, rectangle, disc or sphere becomes the nearest of them, with a note.
// Sources: ANSI/IESNA LM-63-2002 and its predecessors of 1986, 1991, 1995; ANSI/IES LM-63-19.
#ifndef LUXFIT_FORWARD_LUMINAIRE_INTERNAL_IES_FILE_H_
#define LUXFIT_FORWARD_LUMINAIRE_INTERNAL_IES_FILE_H_

#include <string>
#include <vector>

#include "forward/luminaire/photometry_file.h"

namespace luxfit {

enum class IesVersion { k1986, k1991, k1995, k2002, k2019 };
enum class IesType { kC = 1, kB = 2, kA = 3 };

// How the flux depends on the luminaire's tilt.
struct IesTilt {
  std::string source = "NONE";            // NONE, INCLUDE or the name of a file
  int lamp_geometry = 1;                  // 1: base up or down, 2: horizontal across, 3: horizontal along
  std::vector<double> angle_deg, factor;  // empty: none, or in a file that was not read
};

// As the file has it, in its own units.
struct IesFile {
  std::string name;  // for messages
  IesVersion version = IesVersion::k2002;
  std::vector<PhotometryKeyword> keywords;
  IesTilt tilt;
  int lamps = 1;
  double lumens_per_lamp = -1;  // -1: absolute
  double multiplier = 1;
  IesType type = IesType::kC;
  bool in_feet = false;
  double width = 0, length = 0, height = 0;  // of the luminous opening
  double ballast_factor = 1, third_factor = 1, input_w = 0;
  std::vector<double> vertical_deg, horizontal_deg;
  std::vector<double> candela;     // horizontal x vertical, vertical running fastest
  std::vector<std::string> notes;  // what the reader passed over
  std::vector<LightNote> light_notes;
};

// Throw std::runtime_error("NAME:LINE: field: expected X, got Y; remedy"). ReadIes also reads the TILT file, by
// its name, beside the .ies.
IesFile ParseIes(const std::string& text, const std::string& name);
IesFile ReadIes(const std::string& path);

// The file's text; reads back equal, number for number. TILT data of another file are included.
std::string IesText(const IesFile& file);

// The first line of a file of that version; empty for 1986, whose first line is free text.
const std::string& FirstLineOf(IesVersion version);

// Which planes of type C the horizontal angles give; kPartial where they are none of the standard's sets.
PlaneSymmetry IesPlaneSymmetry(const std::vector<double>& horizontal_deg);

PhotometryFile PhotometryOf(const IesFile& file);

// Absolute photometry of type C, LM-63-2002. Throws std::invalid_argument for an empty table.
IesFile MakeIes(const PhotometryFile& photometry);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_INTERNAL_IES_FILE_H_
