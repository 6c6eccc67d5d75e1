// Reads the tone curve that the colour profile of a photo's file states: how its counts were encoded.
//
//   X_c = f_c(count / full scale)
//
// - ICC profiles of JPEG, HEIC, HEIF, PNG and TIFF: the tone curves of red, green and blue (rTRC, gTRC, bTRC) and the primaries
//   (rXYZ, gXYZ, bXYZ, less the adaptation to D50, chad), by LittleCMS.
// - Coding points of HEIC and HEIF (nclx): powers of 2.2 and 2.8, linear, sRGB, PQ and HLG. Others (BT.709 among them) are written by
//   encoders that were told nothing; they state no curve.
//
// A profile says how a display should show counts. What a camera does beyond it, it does not say. Reading throws nothing: a file
// that has no profile, or a broken one, states no curve.
// Sources: ICC.1:2010, 10.5 and 10.15; ISO/IEC 23091-2 (transfer characteristics); ITU-R BT.2100-2, tables 4 and 5 (PQ, HLG).
#ifndef LUXFIT_CALIB_LUMINANCE_COLOUR_PROFILE_H_
#define LUXFIT_CALIB_LUMINANCE_COLOUR_PROFILE_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "calib/luminance/response.h"

namespace luxfit {

struct ColourProfile {
  std::string name;                       // "Display P3", "PQ (SMPTE ST 2084)"
  std::array<Eigen::VectorXd, 3> curves;  // f_c at shares 0, 1/255, ... 1 of full scale; f_c(1) = 1
  // Takes linear red, green and blue to CIE 1931 XYZ, whose white is that of the profile's display. Empty where the file
  // states only a curve.
  std::optional<Eigen::Matrix3d> xyz_from_rgb = {};

  // Returns the curves as a response, which is taken to err as SrgbResponse does.
  CameraResponse Response(double full_scale_counts) const;
  // Returns the largest |ln| of a curve over sRGB's, from 5 % of full scale on.
  double DifferenceFromSrgb() const;
};

std::optional<ColourProfile> ReadColourProfile(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_COLOUR_PROFILE_H_
