// What an IES file means: its table in the luminaire's frame, its flux, the shape of its opening.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/luminaire/internal/ies_file.h"
#include "forward/luminaire/internal/photometry_planes.h"
#include "forward/luminaire/internal/photometry_text.h"

namespace luxfit {
namespace {

constexpr double kMetresPerFoot = 0.3048;
constexpr double kLineWidthM = 0.001;  // of an opening that has a length and no width

// What the measures of the luminous opening mean: table 1 of LM-63-2002, and section 4.12 of 1995 where a
// negative measure stands alone.
struct Opening {
  LuminaireShape shape = LuminaireShape::kPoint;
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
  std::string note;
};

bool Same(double a, double b) { return std::abs(a - b) <= 1e-6 * std::max(a, b); }

// Negative height: round about a horizontal axis, or about every axis.
Opening RoundSolid(double width, double length, double height, bool is_1995) {
  const double w = std::abs(width), l = std::abs(length), h = std::abs(height);
  if (width < 0 && length == 0 && !is_1995)
    return {LuminaireShape::kSphere, {h, 0}, "the opening, a vertical disc, was taken as a sphere"};
  if ((width < 0 && length == 0 && Same(w, h)) || (width < 0 && length < 0 && Same(w, h) && Same(l, h)))
    return {LuminaireShape::kSphere, {h, 0}, ""};
  const bool along = width <= 0 && length > 0 && (w == 0 || (!is_1995 && Same(w, h)));
  const bool across = length <= 0 && width > 0 && (l == 0 || (!is_1995 && Same(l, h)));
  if (along) return {LuminaireShape::kRectangle, {l, h}, "the opening, a cylinder, was taken as flat"};
  if (across) return {LuminaireShape::kRectangle, {h, w}, "the opening, a cylinder, was taken as flat"};
  return {LuminaireShape::kSphere,
          {std::cbrt(std::max(w, kLineWidthM) * std::max(l, kLineWidthM) * h), 0},
          "the opening, an ellipsoid, was taken as a sphere of its volume"};
}

Opening OpeningOf(const IesFile& file) {
  const double metres = file.in_feet ? kMetresPerFoot : 1;
  const double width = metres * file.width, length = metres * file.length, height = metres * file.height;
  const double w = std::abs(width), l = std::abs(length);
  if (height < 0) return RoundSolid(width, length, height, file.version <= IesVersion::k1995);
  if (w == 0 && l == 0) {
    if (height == 0) return {};
    return {LuminaireShape::kPoint, {0, 0}, "the opening has a height only and was taken as a point"};
  }
  Opening opening;
  if (height > 0) opening.note = "the luminous sides of the opening were left out; ";
  if (width < 0 || length < 0) {
    opening.shape = LuminaireShape::kDisc;
    opening.size_m[0] = w == 0 || l == 0 ? std::max(w, l) : std::sqrt(w * l);
    if (w > 0 && l > 0 && !Same(w, l)) opening.note += "the ellipse was taken as a disc of its area; ";
  } else {
    opening.shape = LuminaireShape::kRectangle;
    opening.size_m = {std::max(length, kLineWidthM), std::max(width, kLineWidthM)};
    if (w == 0 || l == 0) opening.note += "the opening has no width and was taken as 1 mm wide; ";
  }
  if (!opening.note.empty()) opening.note.resize(opening.note.size() - 2);
  return opening;
}

// Linear between the angles, constant beyond them.
double FactorAt(const std::vector<double>& angle_deg, const std::vector<double>& factor, double deg) {
  if (angle_deg.empty()) return 1;
  const auto above = std::lower_bound(angle_deg.begin(), angle_deg.end(), deg);
  if (above == angle_deg.end()) return factor.back();
  const auto i = static_cast<size_t>(above - angle_deg.begin());
  if (i == 0 || *above == deg) return factor[i];
  const double share = (deg - angle_deg[i - 1]) / (*above - angle_deg[i - 1]);
  return factor[i - 1] + share * (factor[i] - factor[i - 1]);
}

double TiltFactorAt0(const IesTilt& tilt) { return FactorAt(tilt.angle_deg, tilt.factor, 0); }

double ScaleOf(const IesFile& file) {
  const bool third_multiplies = file.version <= IesVersion::k1991;
  return file.multiplier * file.ballast_factor * (third_multiplies ? file.third_factor : 1) *
         TiltFactorAt0(file.tilt);
}

// Planes at -C beside those at C, where a file of type A or B begins at 0: symmetric to both sides.
struct Sides {
  std::vector<double> angle_deg;  // rising
  std::vector<size_t> column;
};
Sides BothSides(const std::vector<double>& deg) {
  Sides sides;
  const bool mirrored = deg.front() == 0;
  for (size_t i = deg.size(); mirrored && i-- > 1;) {
    sides.angle_deg.push_back(-deg[i]);
    sides.column.push_back(i);
  }
  for (size_t i = 0; i < deg.size(); ++i) {
    sides.angle_deg.push_back(deg[i]);
    sides.column.push_back(i);
  }
  return sides;
}

// gamma = 90 + V, C = -H.
IntensityTable TableOfTypeA(const IesFile& file, const std::vector<double>& cd) {
  const Sides sides = BothSides(file.horizontal_deg);
  const size_t n = file.vertical_deg.size();
  std::vector<double> c_deg, gamma_deg, intensity;
  for (const double v : file.vertical_deg) gamma_deg.push_back(90 + v);
  for (size_t i = sides.angle_deg.size(); i-- > 0;) {
    c_deg.push_back(-sides.angle_deg[i]);
    const auto row = cd.begin() + static_cast<std::ptrdiff_t>(sides.column[i] * n);
    intensity.insert(intensity.end(), row, row + static_cast<std::ptrdiff_t>(n));
  }
  return ExpandPlanes(RadFromDeg(c_deg), RadFromDeg(gamma_deg), intensity, PlaneSymmetry::kPartial);
}

// The pole is H = -90, the luminaire's +y; V runs round it from straight down towards C0.
IntensityTable TableOfTypeB(const IesFile& file, const std::vector<double>& cd) {
  const Sides sides = BothSides(file.horizontal_deg);
  const size_t n = file.vertical_deg.size();
  std::vector<double> gamma_deg, intensity;
  for (const double h : sides.angle_deg) gamma_deg.push_back(90 + h);
  for (size_t v = 0; v < n; ++v) {
    for (const size_t column : sides.column) intensity.push_back(cd[column * n + v]);
  }
  IntensityTable table =
      ExpandPlanes(RadFromDeg(file.vertical_deg), RadFromDeg(gamma_deg), intensity, PlaneSymmetry::kPartial);
  table.table_from_luminaire << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  return table;
}

// Tells whether the outermost directions of a file have light, so that more may lie beyond them.
bool ShinesAtItsEdge(const IesFile& file) {
  constexpr double kDark = 0.01;  // of the peak: the scatter of a measurement
  const size_t vertical = file.vertical_deg.size(), horizontal = file.horizontal_deg.size();
  double edge = 0;
  for (size_t h = 0; h < horizontal; ++h) {
    for (size_t v = 0; v < vertical; ++v) {
      // Files that begin at 0 are the same on both sides.
      const bool is_side = h + 1 == horizontal || (h == 0 && file.horizontal_deg[0] != 0);
      if (is_side || v == 0 || v + 1 == vertical) edge = std::max(edge, file.candela[h * vertical + v]);
    }
  }
  return edge > kDark * *std::max_element(file.candela.begin(), file.candela.end());
}

void AddNotes(const IesFile& file, const Opening& opening, PhotometryFile& photometry) {
  photometry.notes = file.notes;
  photometry.light_notes = file.light_notes;
  if (!opening.note.empty()) AddLightNote(photometry, LightNote::Of::kOpening, opening.note);
  if (file.tilt.source != "NONE") {
    photometry.notes.emplace_back(file.tilt.angle_deg.empty()
                                      ? "the TILT file was not read: its factors are left out"
                                      : "its TILT factors apply by the angle between aim and straight down");
  }
  const double last = file.horizontal_deg.back();
  if (file.type == IesType::kC && last > 180 && last < 360 && file.horizontal_deg.front() == 0)
    photometry.notes.push_back("the planes end at " + NumberText(last) +
                               " degrees: the circle was closed with C0");
  if (file.type == IesType::kC) return;
  const std::string dark = "photometry of type A or B: directions that the file does not give are dark";
  if (ShinesAtItsEdge(file)) {
    AddLightNote(photometry, LightNote::Of::kDistribution, dark);
  } else {
    photometry.notes.push_back(dark);
  }
}

}  // namespace

double TiltFactor(const PhotometryFile& file, const Eigen::Vector3d& aim) {
  constexpr double kDegrees = 180 / M_PI;
  const double off_down = std::acos(std::clamp(-aim.normalized().z(), -1.0, 1.0));
  return FactorAt(file.tilt_deg, file.tilt_factor, kDegrees * off_down);
}

PhotometryFile PhotometryOf(const IesFile& file) {
  std::vector<double> cd = file.candela;
  const double scale = ScaleOf(file);
  for (double& value : cd) value *= scale;
  PhotometryFile photometry;
  photometry.name = file.name;
  photometry.format = file.version == IesVersion::k1986 ? "IES LM-63-1986" : FirstLineOf(file.version);
  photometry.keywords = file.keywords;
  if (file.lumens_per_lamp > 0) photometry.lamp_flux_lm = file.lamps * file.lumens_per_lamp;
  photometry.factor = scale;
  const Opening opening = OpeningOf(file);
  photometry.shape = opening.shape;
  photometry.size_m = opening.size_m;
  AddNotes(file, opening, photometry);
  const double at_0 = TiltFactorAt0(file.tilt);
  if (at_0 > 0) {  // else the file has no light to scale, which is refused below
    photometry.tilt_deg = file.tilt.angle_deg;
    for (const double factor : file.tilt.factor) photometry.tilt_factor.push_back(factor / at_0);
  }
  if (file.tilt.source != "NONE" && file.tilt.angle_deg.empty())
    photometry.missing_tilt_file = file.tilt.source;
  const IntensityTable table =
      file.type == IesType::kA ? TableOfTypeA(file, cd)
      : file.type == IesType::kB
          ? TableOfTypeB(file, cd)
          : ExpandPlanes(RadFromDeg(file.horizontal_deg), RadFromDeg(file.vertical_deg), cd,
                         IesPlaneSymmetry(file.horizontal_deg));
  return WithTable(std::move(photometry), table, file.name);
}

IesFile MakeIes(const PhotometryFile& photometry) {
  PhotometryPlanes planes = PlanesOf(photometry.table, photometry.luminaire_flux_lm);
  IesFile file;
  file.keywords = photometry.keywords;
  file.vertical_deg = planes.gamma_deg;
  file.horizontal_deg = planes.c_deg;
  if (planes.c_deg.size() > 1) {
    // The standard closes the circle.
    file.horizontal_deg.push_back(360);
    const std::vector<double> first(
        planes.intensity.begin(),
        planes.intensity.begin() + static_cast<std::ptrdiff_t>(planes.gamma_deg.size()));
    planes.intensity.insert(planes.intensity.end(), first.begin(), first.end());
  }
  file.candela = std::move(planes.intensity);
  const Eigen::Vector2d size_m = photometry.size_m;
  if (photometry.shape == LuminaireShape::kRectangle) {
    file.length = size_m[0];
    file.width = size_m[1];
  } else if (photometry.shape != LuminaireShape::kPoint) {
    file.width = file.length = -size_m[0];  // since 2002 a round opening has two equal measures
    file.height = photometry.shape == LuminaireShape::kSphere ? -size_m[0] : 0;
  }
  return file;
}

}  // namespace luxfit
