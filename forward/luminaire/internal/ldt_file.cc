#include "forward/luminaire/internal/ldt_file.h"

#include <algorithm>
#include <cmath>

#include "forward/luminaire/internal/flux_share.h"
#include "forward/luminaire/internal/photometry_planes.h"
#include "forward/luminaire/internal/photometry_text.h"
#include "forward/room/text_encoding.h"

namespace luxfit {
namespace {

std::vector<LdtLamps> ReadLamps(PhotometryText& text) {
  const int sets = text.LineCount("number of lamp sets", 1, kMostCounted);
  std::vector<LdtLamps> lamps;
  for (int i = 0; i < sets; ++i) {  // each needs six lines, so the text's end bounds the list
    LdtLamps set;
    set.count = text.LineCount("number of lamps", -kMostCounted, kMostCounted);
    set.type = text.Line("type of lamps");
    set.flux_lm = text.LineNumber("total flux of the lamps");
    if (i == 0 && !(set.flux_lm > 0))
      throw text.Error("total flux of the lamps", "expected > 0 lm, got " + NumberText(set.flux_lm) +
                                                      "; intensities are per 1000 lm of it");
    set.colour = text.Line("colour of the lamps");
    set.rendering = text.Line("colour rendering of the lamps");
    set.power = text.Line("power of the lamps");
    lamps.push_back(std::move(set));
  }
  return lamps;
}

void ReadDimensions(PhotometryText& text, LdtFile& file) {
  file.length_mm = text.LineNumber("length of the luminaire");
  file.width_mm = text.LineNumber("width of the luminaire");
  file.height_mm = text.LineNumber("height of the luminaire");
  file.area_length_mm = text.LineNumber("length of the luminous area");
  file.area_width_mm = text.LineNumber("width of the luminous area");
  if (file.area_length_mm < 0 || file.area_width_mm < 0)
    throw text.Error("luminous area", "expected a length and a width >= 0 mm, got " +
                                          NumberText(file.area_length_mm) + " and " +
                                          NumberText(file.area_width_mm) + "; a round area has width 0");
  for (double& height : file.area_height_mm) height = text.LineNumber("height of the luminous area");
}

// The angles at which the symmetry's stored planes must begin and end.
struct PlaneRange {
  double first, last;
};
PlaneRange RangeOf(int symmetry) {
  if (symmetry == 2) return {0, 180};
  if (symmetry == 3) return {270, 90};
  return {0, 90};
}

void ExpectPlanes(const PhotometryText& text, const LdtFile& file) {
  if (file.symmetry < 2) return;
  const std::vector<size_t> stored = StoredPlanes(file.symmetry, file.c_deg.size());
  const PlaneRange range = RangeOf(file.symmetry);
  const double first = file.c_deg[stored.front()], last = file.c_deg[stored.back()];
  if (std::abs(first - range.first) < 1e-3 && std::abs(last - range.last) < 1e-3) return;
  throw text.Error("C angles", "expected planes for Isym " + std::to_string(file.symmetry) + " from " +
                                   NumberText(range.first) + " to " + NumberText(range.last) + ", got " +
                                   NumberText(first) + " to " + NumberText(last) +
                                   "; correct Isym, Mc or the angles");
}

void ReadTable(PhotometryText& text, LdtFile& file, size_t gammas) {
  const auto planes = static_cast<size_t>(file.planes);
  file.c_deg = text.Rising("C angles", planes, 0, 360);
  if (planes > 1 && file.c_deg.back() - file.c_deg.front() >= 360)
    throw text.Error("C angles", "expected the last plane before 360 degrees, got " +
                                     NumberText(file.c_deg.back()) + "; C360 is C0: leave it out");
  ExpectPlanes(text, file);
  file.gamma_deg = text.Rising("gamma angles", gammas, 0, 180);
  file.cd_per_klm =
      text.Numbers("luminous intensities", StoredPlanes(file.symmetry, planes).size() * gammas, 0);
  if (*std::max_element(file.cd_per_klm.begin(), file.cd_per_klm.end()) <= 0)
    throw text.Error("luminous intensities", "expected light in some direction, got 0 everywhere");
}

// Unlike in .ies, surplus numbers are no error: makers' files have them whose flux is as stated.
void NoteWhatFollows(const PhotometryText& text, LdtFile& file) {
  if (text.AtEnd()) return;
  const size_t surplus = text.NumbersAhead();
  if (surplus == 0) {
    file.notes.emplace_back("what follows the last intensity was ignored");
    return;
  }
  AddLightNote(file, LightNote::Of::kDistribution,
               std::to_string(surplus) + (surplus == 1 ? " number" : " numbers") +
                   " after the last intensity not read: a count in the file may be too small");
}

// Symmetry and number of planes, which must go together.
void ReadSymmetry(PhotometryText& text, LdtFile& file) {
  file.symmetry = text.LineCount("Isym", 0, 4);
  file.planes = text.LineCount("Mc, number of C planes", 1, kMostCounted);
  const int multiple = file.symmetry == 2 ? 2 : file.symmetry > 2 ? 4 : 1;
  if (file.planes % multiple != 0)
    throw text.Error("Mc, number of C planes", "expected a multiple of " + std::to_string(multiple) +
                                                   " for Isym " + std::to_string(file.symmetry) + ", got " +
                                                   std::to_string(file.planes) + "; correct one of them");
}

}  // namespace

std::vector<size_t> StoredPlanes(int symmetry, size_t planes) {
  size_t first = 0, count = planes;
  if (symmetry == 1) count = 1;
  if (symmetry == 2 || symmetry == 3) count = planes / 2 + 1;
  if (symmetry == 3) first = 3 * planes / 4;
  if (symmetry == 4) count = planes / 4 + 1;
  std::vector<size_t> stored;
  for (size_t i = 0; i < count; ++i) stored.push_back((first + i) % planes);
  return stored;
}

LdtFile ParseLdt(const std::string& bytes, const std::string& name) {
  const std::string utf8 = Utf8Text(bytes);
  PhotometryText text(utf8, name, PhotometryText::Comma::kDecimal);
  if (text.AtEnd()) throw text.ErrorAt(1, "file", "expected an EULUMDAT file, got nothing");
  LdtFile file;
  file.name = name;
  file.company = text.Line("company");
  file.type_indicator = text.LineCount("Ityp", 0, 3);
  ReadSymmetry(text, file);
  file.c_step_deg = text.LineNumber("Dc, distance of C planes");
  const auto gammas = static_cast<size_t>(text.LineCount("Ng, number of gamma angles", 2, kMostCounted));
  file.gamma_step_deg = text.LineNumber("Dg, distance of gamma angles");
  file.report = text.Line("measurement report");
  file.luminaire = text.Line("luminaire name");
  file.number = text.Line("luminaire number");
  file.file = text.Line("file name");
  file.date = text.Line("date and user");
  ReadDimensions(text, file);
  file.downward_percent = text.LineNumber("downward flux fraction");
  file.light_output_percent = text.LineNumber("light output ratio");
  file.conversion_factor = text.LineNumber("conversion factor");
  if (file.conversion_factor < 1e-6 || file.conversion_factor > 1e6)
    throw text.Error("conversion factor", "expected > 0, got " + NumberText(file.conversion_factor) +
                                              "; intensities are multiplied by it: usually 1");
  file.tilt_deg = text.LineNumber("tilt during measurement");
  file.lamps = ReadLamps(text);
  for (double& ratio : file.direct_ratio) ratio = text.LineNumber("direct ratio");
  ReadTable(text, file, gammas);
  NoteWhatFollows(text, file);
  if (text.decimal_commas() > 0)
    file.notes.push_back(std::to_string(text.decimal_commas()) + " decimal commas were read as points");
  return file;
}

LdtFile ReadLdt(const std::string& path) { return ParseLdt(FileBytes(path), path); }

std::string LdtText(const LdtFile& file) {
  std::string out;
  const auto line = [&out](const std::string& text) { out += text + "\r\n"; };
  const auto number = [&line](double value) { line(NumberText(value)); };
  line(file.company);
  for (const int value : {file.type_indicator, file.symmetry, file.planes}) number(value);
  number(file.c_step_deg);
  number(static_cast<double>(file.gamma_deg.size()));
  number(file.gamma_step_deg);
  for (const std::string& text : {file.report, file.luminaire, file.number, file.file, file.date}) line(text);
  for (const double value :
       {file.length_mm, file.width_mm, file.height_mm, file.area_length_mm, file.area_width_mm})
    number(value);
  for (const double height : file.area_height_mm) number(height);
  for (const double value :
       {file.downward_percent, file.light_output_percent, file.conversion_factor, file.tilt_deg})
    number(value);
  number(static_cast<double>(file.lamps.size()));
  for (const LdtLamps& set : file.lamps) {
    number(set.count);
    line(set.type);
    number(set.flux_lm);
    for (const std::string& text : {set.colour, set.rendering, set.power}) line(text);
  }
  for (const double ratio : file.direct_ratio) number(ratio);
  for (const std::vector<double>* values : {&file.c_deg, &file.gamma_deg, &file.cd_per_klm}) {
    for (const double value : *values) number(value);
  }
  return out;
}

PhotometryFile PhotometryOf(const LdtFile& file) {
  PhotometryFile photometry;
  photometry.format = "EULUMDAT";
  photometry.keywords = {
      {"MANUFAC", file.company},        {"TEST", file.report}, {"LUMINAIRE", file.luminaire},
      {"LUMCAT", file.number},          {"FILE", file.file},   {"DATE", file.date},
      {"LAMP", file.lamps.front().type}};
  photometry.name = file.name;
  photometry.notes = file.notes;
  photometry.light_notes = file.light_notes;
  const LdtLamps& lamps = file.lamps.front();
  if (lamps.count >= 0) photometry.lamp_flux_lm = lamps.flux_lm;
  photometry.factor = file.conversion_factor;
  photometry.stated_flux_lm = lamps.flux_lm * file.light_output_percent / 100;
  if (file.lamps.size() > 1)
    AddLightNote(photometry, LightNote::Of::kFlux,
                 "the first of " + std::to_string(file.lamps.size()) + " lamp sets was used");
  if (file.area_length_mm > 0 && file.area_width_mm > 0) {
    photometry.shape = LuminaireShape::kRectangle;
    photometry.size_m = {file.area_width_mm / 1000, file.area_length_mm / 1000};
  } else if (file.area_length_mm > 0 || file.area_width_mm > 0) {
    photometry.shape = LuminaireShape::kDisc;
    photometry.size_m[0] = std::max(file.area_length_mm, file.area_width_mm) / 1000;
  }
  if (*std::max_element(file.area_height_mm.begin(), file.area_height_mm.end()) > 0)
    AddLightNote(photometry, LightNote::Of::kOpening, "the luminous sides of the opening were left out");
  const double scale = file.conversion_factor * lamps.flux_lm / 1000;
  std::vector<double> cd = file.cd_per_klm, c_deg;
  for (double& value : cd) value *= scale;
  const PlaneSymmetry symmetries[] = {PlaneSymmetry::kNone, PlaneSymmetry::kRotational,
                                      PlaneSymmetry::kC0C180, PlaneSymmetry::kC90C270,
                                      PlaneSymmetry::kQuadrant};
  for (const size_t plane : StoredPlanes(file.symmetry, file.c_deg.size())) {
    // C270 to C90 rises through 360.
    const bool past_360 = file.symmetry == 3 && file.c_deg[plane] <= 90;
    c_deg.push_back(file.c_deg[plane] + (past_360 ? 360 : 0));
  }
  const PlaneSymmetry symmetry = c_deg.size() == 1 ? PlaneSymmetry::kRotational : symmetries[file.symmetry];
  return WithTable(std::move(photometry),
                   ExpandPlanes(RadFromDeg(c_deg), RadFromDeg(file.gamma_deg), cd, symmetry), file.name);
}

namespace {

// The step of angles that are evenly spaced, else 0.
double EvenStep(const std::vector<double>& deg) {
  const double step = deg.size() < 2 ? 0 : deg[1] - deg[0];
  for (size_t i = 1; i < deg.size(); ++i) {
    if (std::abs(deg[i] - deg[i - 1] - step) > 1e-6) return 0;
  }
  return step;
}

}  // namespace

LdtFile MakeLdt(const PhotometryFile& photometry) {
  const IntensityTable table = InLuminaireFrame(photometry.table);
  const PhotometryPlanes planes = PlanesOf(table, 1000);
  LdtFile file;
  const auto keyword = [&](const std::string& name) {
    for (const PhotometryKeyword& k : photometry.keywords) {
      if (k.name == name) return k.text;
    }
    return std::string();
  };
  file.company = keyword("MANUFAC");
  file.report = keyword("TEST");
  file.luminaire = keyword("LUMINAIRE");
  file.number = keyword("LUMCAT");
  file.file = keyword("FILE");
  file.date = keyword("DATE");
  file.symmetry = planes.c_deg.size() == 1 ? 1 : 0;
  file.type_indicator = file.symmetry == 1 ? 1 : 3;
  file.planes = static_cast<int>(planes.c_deg.size());
  file.c_deg = planes.c_deg;
  file.gamma_deg = planes.gamma_deg;
  file.c_step_deg = EvenStep(planes.c_deg);
  file.gamma_step_deg = EvenStep(planes.gamma_deg);
  file.cd_per_klm = planes.intensity;
  const bool rectangle = photometry.shape == LuminaireShape::kRectangle;
  file.area_length_mm = 1000 * photometry.size_m[rectangle ? 1 : 0];
  file.area_width_mm = rectangle ? 1000 * photometry.size_m[0] : 0;
  // Of the housing nothing is known but that it holds the opening.
  file.length_mm = file.area_length_mm;
  file.width_mm = file.area_width_mm;
  const FluxShares shares = FluxSharesOf(table);
  file.downward_percent = 100 * shares.downward;
  file.direct_ratio = shares.direct_ratio;
  LdtLamps lamps;
  lamps.count = -1;
  lamps.type = keyword("LAMP");
  lamps.flux_lm = photometry.luminaire_flux_lm;
  file.lamps = {lamps};
  return file;
}

}  // namespace luxfit
