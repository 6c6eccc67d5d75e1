// Between a table in cd, as files have it, and the normalised one of a PhotometryFile.
#ifndef LUXFIT_FORWARD_LUMINAIRE_INTERNAL_PHOTOMETRY_PLANES_H_
#define LUXFIT_FORWARD_LUMINAIRE_INTERNAL_PHOTOMETRY_PLANES_H_

#include <string>
#include <utility>
#include <vector>

#include "forward/luminaire/photometry_file.h"

namespace luxfit {

std::vector<double> RadFromDeg(const std::vector<double>& deg);

// `file` with the table normalised and its flux. Throws std::runtime_error naming the file if it has no flux.
PhotometryFile WithTable(PhotometryFile file, const IntensityTable& table_cd, const std::string& name);

// Adds a note on what changes the light; `File` has notes and light_notes.
template <typename File>
void AddLightNote(File& file, LightNote::Of of, std::string text) {
  file.notes.push_back(text);
  file.light_notes.push_back({of, std::move(text)});
}

// The table about the luminaire's own axis, all round: as it is, or resampled where it is about another axis
// or leaves planes out.
IntensityTable InLuminaireFrame(const IntensityTable& table);

// Planes of the C-gamma system for writing: one if all are alike, else from 0 to below 360 deg.
struct PhotometryPlanes {
  std::vector<double> c_deg, gamma_deg;
  std::vector<double> intensity;  // c x gamma, gamma running fastest
};
// `scale` times the table in the luminaire's frame.
PhotometryPlanes PlanesOf(const IntensityTable& table, double scale);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_INTERNAL_PHOTOMETRY_PLANES_H_
