// Writes planes of named quantities as one OpenEXR picture.
//
// An OpenEXR picture holds what the three colours of calib/photo_files/image.h cannot. The call gives the
// channels as a list; the file stores them by name, as the format does. Values are 32-bit floats, ZIP
// compressed; NaN and infinity are kept. All planes are height x width and of one size.
//
// Throws std::runtime_error, naming the file, where it cannot be written. Throws
// std::invalid_argument for no planes, planes that differ in size, and names that are empty or given twice.
// Source: OpenEXR 3.1, "Technical Introduction to OpenEXR" (channels, ZIP).
#ifndef LUXFIT_APPS_EXPORT_EXR_CHANNELS_H_
#define LUXFIT_APPS_EXPORT_EXR_CHANNELS_H_

#include <map>
#include <string>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

struct ExrChannel {
  std::string name;  // "illuminance_lx"
  ImagePlane values;
};

// Writes the file whole or not at all. `comments` are text attributes of the header.
void WriteExrChannels(const std::string& path, const std::vector<ExrChannel>& channels,
                      const std::map<std::string, std::string>& comments = {});

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_EXR_CHANNELS_H_
