#include "apps/export/radiance_scene.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/photometry_file.h"
#include "forward/room/one_line.h"

namespace luxfit {
namespace {

constexpr double kDegrees = 180 / M_PI;
constexpr double kLumensPerWatt = 179;
constexpr double kPointRadiusM = 0.002;
constexpr double kBackOffsetM = 1e-4;  // distance of the face that shines to the other side

std::ostringstream Writer() {
  std::ostringstream text;
  text.precision(10);
  return text;
}

void AddPoint(const Eigen::Vector3d& p, std::ostream& text) {
  text << "  " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
}

void AddPolygon(const std::string& material, const std::string& name,
                const std::vector<Eigen::Vector3d>& corners, std::ostream& text) {
  text << material << " polygon " << name << "\n0\n0\n" << 3 * corners.size() << '\n';
  for (const Eigen::Vector3d& p : corners) AddPoint(p, text);
}

// Writes a luminaire as Radiance sees it: one surface or several that share a modifier.
class LuminaireText {
 public:
  LuminaireText(const Luminaire& luminaire, std::string stem, double dimming, bool is_opaque)
      : luminaire_(luminaire),
        stem_(std::move(stem)),
        kind_(is_opaque ? "light" : "illum"),
        dimming_(dimming),
        axes_(AxesOf(luminaire)),
        table_(TabulatedPhotometry(luminaire).table) {}

  RadianceLuminaire Text() {
    if (!(dimming_ > 0)) return {};
    text_ << "# luminaire " << OneLine(luminaire_.id) << ", " << dimming_ * luminaire_.flux_lm << " lm\n";
    if (luminaire_.shape == LuminaireShape::kPoint || luminaire_.shape == LuminaireShape::kSphere) {
      AddSphere();
    } else if (luminaire_.emission.size() > 0) {
      AddCells();
    } else {
      AddFlat(luminaire_.position, luminaire_.size_m, 1, "");
    }
    return {text_.str(), IsDiffuse() ? "" : Table()};
  }

 private:
  bool IsFlat() const {
    return luminaire_.shape == LuminaireShape::kDisc || luminaire_.shape == LuminaireShape::kRectangle;
  }
  bool IsDiffuse() const { return IsFlat() && OpsOf(luminaire_.distribution).is_diffuse; }

  bool ShinesBack() const {
    const size_t n = table_.gamma_rad.size();
    for (size_t i = 0; i < table_.cd_per_lm.size(); ++i) {
      if (table_.gamma_rad[i % n] > M_PI / 2 + 1e-6 && table_.cd_per_lm[i] > 0) return true;
    }
    return false;
  }

  // Adds the modifier of an area, in lm per square metre; the table or cos(gamma) / pi makes luminance of it.
  std::string AddModifier(double share, double area_m2, const std::string& suffix) {
    const double radiance = dimming_ * share * luminaire_.flux_lm / area_m2 / kLumensPerWatt;
    const std::string name = stem_ + suffix;
    std::string modifier = "void";
    double value = radiance / M_PI;
    if (!IsDiffuse()) {
      modifier = name + "_lobe";
      value = radiance;
      AddLobe(modifier);
    }
    text_ << modifier << ' ' << kind_ << ' ' << name << "_light\n0\n0\n3 " << value << ' ' << value << ' '
          << value << '\n';
    return name + "_light";
  }

  void AddLobe(const std::string& name) {
    const bool is_round = table_.c_rad.size() < 2 || IsSymmetricAboutAim(table_);
    const Eigen::Vector3d c90 = luminaire_.aim.cross(axes_.along) * -1;
    text_ << "void brightdata " << name << '\n'
          << (is_round ? 4 : 5) << (IsFlat() ? " lf_flat " : " lf_point ") << stem_ << ".dat luxfit.cal "
          << (is_round ? "" : "lf_c ") << "lf_gamma\n0\n11";
    for (const Eigen::Vector3d& axis : {luminaire_.aim, axes_.along, c90})
      text_ << ' ' << axis.x() << ' ' << axis.y() << ' ' << axis.z();
    text_ << ' ' << kDegrees * table_.gamma_rad.back() << ' ' << kDegrees * FirstC() << '\n';
  }

  double FirstC() const { return table_.c_rad.empty() ? 0 : table_.c_rad.front(); }

  // Returns the table of cd per lm: over gamma, or over C and gamma.
  std::string Table() const {
    std::ostringstream text = Writer();
    const bool is_round = table_.c_rad.size() < 2 || IsSymmetricAboutAim(table_);
    text << "# cd per lm over " << (is_round ? "" : "C and ") << "gamma, degrees\n" << (is_round ? 1 : 2);
    const auto add_angles = [&](const std::vector<double>& angles) {
      text << "\n0 0 " << angles.size();
      for (const double angle : angles) text << ' ' << kDegrees * angle;
    };
    if (!is_round) add_angles(table_.c_rad);
    add_angles(table_.gamma_rad);
    const size_t n = table_.gamma_rad.size(), planes = is_round ? 1 : table_.c_rad.size();
    for (size_t i = 0; i < planes * n; ++i) text << (i % n == 0 ? "\n" : " ") << table_.cd_per_lm[i];
    text << '\n';
    return text.str();
  }

  void AddSphere() {
    const bool is_point = luminaire_.shape == LuminaireShape::kPoint || !(luminaire_.size_m[0] > 0);
    const double radius = is_point ? kPointRadiusM : luminaire_.size_m[0] / 2;
    const std::string light = AddModifier(1, M_PI * radius * radius, "");
    const Eigen::Vector3d& p = luminaire_.position;
    text_ << light << " sphere " << stem_ << "_surface\n0\n0\n4 " << p.x() << ' ' << p.y() << ' ' << p.z()
          << ' ' << radius << '\n';
  }

  void AddCells() {
    const Eigen::Index along = luminaire_.emission.rows(), across = luminaire_.emission.cols();
    const Eigen::Vector2d size(luminaire_.size_m[0] / static_cast<double>(along),
                               luminaire_.size_m[1] / static_cast<double>(across));
    for (Eigen::Index j = 0; j < across; ++j) {
      for (Eigen::Index i = 0; i < along; ++i) {
        const double share = luminaire_.emission(i, j);
        if (!(share > 0)) continue;
        const double a = (static_cast<double>(i) + 0.5) * size[0] - luminaire_.size_m[0] / 2;
        const double b = (static_cast<double>(j) + 0.5) * size[1] - luminaire_.size_m[1] / 2;
        const Eigen::Vector3d centre = luminaire_.position + a * axes_.along + b * axes_.across;
        AddFlat(centre, size, share, "_" + std::to_string(i) + "_" + std::to_string(j));
      }
    }
  }

  void AddFlat(const Eigen::Vector3d& centre, const Eigen::Vector2d& size_m, double share,
               const std::string& suffix) {
    const bool is_disc = luminaire_.shape == LuminaireShape::kDisc;
    const double area_m2 = is_disc ? M_PI * size_m[0] * size_m[0] / 4 : size_m[0] * size_m[1];
    const std::string light = AddModifier(share, area_m2, suffix);
    AddFace(light, suffix + "_surface", centre, size_m, luminaire_.aim);
    if (!IsDiffuse() && ShinesBack())
      AddFace(light, suffix + "_back", centre - kBackOffsetM * luminaire_.aim, size_m, -luminaire_.aim);
  }

  void AddFace(const std::string& light, const std::string& suffix, const Eigen::Vector3d& centre,
               const Eigen::Vector2d& size_m, const Eigen::Vector3d& normal) {
    if (luminaire_.shape == LuminaireShape::kDisc) {
      text_ << light << " ring " << stem_ << suffix << "\n0\n0\n8\n";
      AddPoint(centre, text_);
      AddPoint(normal, text_);
      text_ << "  0 " << size_m[0] / 2 << '\n';
      return;
    }
    const Eigen::Vector3d u = size_m[0] / 2 * axes_.along;
    const Eigen::Vector3d v = size_m[1] / 2 * normal.cross(axes_.along).normalized();
    AddPolygon(light, stem_ + suffix, {centre - u - v, centre + u - v, centre + u + v, centre - u + v},
               text_);
  }

  const Luminaire& luminaire_;
  const std::string stem_, kind_;
  const double dimming_;
  const LuminaireAxes axes_;
  const IntensityTable table_;
  std::ostringstream text_ = Writer();
};

// Radiance ends a name at white space, and executes a line that begins with `!`.
void ExpectIdentifier(const std::string& name) {
  const bool is_plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c > ' ' && c != 0x7F && c != '!' && c != '#' && c != '"' && c != '\'';
  });
  if (name.empty() || !is_plain)
    throw std::invalid_argument(
        "Radiance scene: expected a name without white space, quotes, ! and #, got \"" + OneLine(name) +
        "\"");
}

void ExpectNames(const std::vector<std::string>& names, Eigen::Index materials) {
  if (static_cast<Eigen::Index>(names.size()) != materials)
    throw std::invalid_argument("Radiance scene: expected one name a material");
  for (const std::string& name : names) ExpectIdentifier(name);
}

}  // namespace

std::string RadianceMaterials(const std::vector<std::string>& names, const Eigen::Matrix3Xd& albedo_rgb) {
  ExpectNames(names, albedo_rgb.cols());
  std::ostringstream text = Writer();
  for (size_t m = 0; m < names.size(); ++m) {
    const auto rgb = albedo_rgb.col(static_cast<Eigen::Index>(m));
    text << "void plastic " << names[m] << "\n0\n0\n5 " << rgb[0] << ' ' << rgb[1] << ' ' << rgb[2]
         << " 0 0\n\n";
  }
  return text.str();
}

std::string RadianceSurfaces(const Scene& scene, const std::vector<std::string>& names) {
  ExpectNames(names, static_cast<Eigen::Index>(scene.materials.size()));
  std::ostringstream text = Writer();
  const std::vector<Facet> facets = SurfaceFacets(scene);
  for (size_t f = 0; f < facets.size(); ++f) {
    const Facet& facet = facets[f];
    std::vector<Eigen::Vector3d> corners{facet.PointAt(0, 0), facet.PointAt(1, 0)};
    if (facet.kind == FacetKind::kParallelogram) corners.push_back(facet.PointAt(1, 1));
    corners.push_back(facet.PointAt(0, 1));
    AddPolygon(names[static_cast<size_t>(facet.material)], "facet" + std::to_string(f), corners, text);
  }
  return text.str();
}

RadianceLuminaire RadianceSceneOf(const Luminaire& luminaire, const std::string& stem, double dimming,
                                  bool is_opaque) {
  ExpectIdentifier(stem);
  return LuminaireText(luminaire, stem, dimming, is_opaque).Text();
}

std::string RadianceFunctions() {
  return R"({ Intensity tables of luxfit: cd per lm over gamma, or over C and gamma, in degrees.
  A1-A3: aim, A4-A6: heading (C0), A7-A9: C90, A10: last gamma of the table, A11: its first C.
  D: the direction of the ray, towards the luminaire; light leaves along -D. }
lf_clip(x) : if(x - 1, 1, if(-1 - x, -1, x));
lf_cos = lf_clip(-(Dx*A1 + Dy*A2 + Dz*A3));
lf_gamma = 57.29577951308232 * acos(lf_cos);
lf_c0 = 57.29577951308232 * atan2(-(Dx*A7 + Dy*A8 + Dz*A9), -(Dx*A4 + Dy*A5 + Dz*A6));
lf_c = lf_c0 + if(A11 - lf_c0, 360, 0);
lf_point(v) = if(lf_gamma - A10 - 1e-6, 0, v);
lf_flat(v) = lf_point(v) / if(abs(Rdot) - 0.001, abs(Rdot), 0.001);
)";
}

}  // namespace luxfit
