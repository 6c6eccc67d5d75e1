// Shows values in false colours: a map that rises evenly in lightness, so that it also reads in grey print.
//
//   colour(t) linear in sRGB between nine anchors of viridis,   t = (value - lower) / (upper - lower)
//
// Values outside the range take its ends; NaN is a grey that the map does not hold.
// Source: van der Walt and Smith (2015), "A better default colormap for Matplotlib" (viridis, CC0).
#ifndef LUXFIT_APPS_EXPORT_FALSE_COLOURS_H_
#define LUXFIT_APPS_EXPORT_FALSE_COLOURS_H_

#include <Eigen/Core>
#include <string>

#include "calib/photo_files/image.h"

namespace luxfit {

// Return the colour of t and the colour of NaN; sRGB, 0..255.
Eigen::Vector3i FalseColour(double t);
Eigen::Vector3i UnknownColour();

struct ColourScale {
  double lower = 0, upper = 1;
  std::string label;  // "illuminance, lx"
};

// Returns the scale from 0 to the next of 1, 1.5, 2, 3, 5, 7 (times a power of ten) above all but the
// brightest 1 %. The scale is 0 to 1 where no value is known.
ColourScale ScaleOf(const ImagePlane& values, const std::string& label);

// Writes the picture, pixel for pixel at the top left, and below it a bar of the scale with its numbers.
// Throws std::runtime_error, naming the file, where it cannot be written.
void WriteFalseColourPng(const std::string& path, const ImagePlane& values, const ColourScale& scale);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_FALSE_COLOURS_H_
