#include "tests/validation/office_texture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

constexpr double kCellM = 0.02;    // of the grid over which means are taken
constexpr double kTagSizes = 1.5;  // a tag's paper, and the edge round it that its detection needs
constexpr int kRaysPerSide = 3;    // of a pixel

// Draws numbers in [0, 1), the same on every machine.
class Dice {
 public:
  explicit Dice(uint64_t seed) : state_(Mix(seed)) {}
  double operator()() {
    state_ = Mix(state_);
    return UnitFrom(state_);
  }
  double Between(double low, double high) { return low + (high - low) * (*this)(); }
  // Three even draws make a number of sigma 1 within +-3.
  double Normal() {
    const double a = (*this)(), b = (*this)(), c = (*this)();
    return 2 * (a + b + c) - 3;
  }

 private:
  uint64_t state_;
};

// Returns the middle of cell k of a grid that fills the unit square, row by row.
Eigen::Array2d MiddleOf(int k, int columns, int rows) {
  const int row = k / columns;
  return {(k % columns + 0.5) / columns, (row + 0.5) / rows};
}

double Carpet(const Eigen::Vector2d& p_m) {
  constexpr double kTileM = 0.25, kTileSigma = 0.2, kStripeM = 0.05;
  const auto i = static_cast<uint64_t>(p_m.x() / kTileM), j = static_cast<uint64_t>(p_m.y() / kTileM);
  const double stripe = std::fmod(p_m.x(), 2 * kStripeM) < kStripeM ? 1.1 : 0.9;
  return stripe * (1 + kTileSigma * Dice(1000 * i + j).Normal());
}

double Wood(const Eigen::Vector2d& p_m) {
  constexpr double kBoardM = 0.12, kGrainM = 0.04, kWaveM = 0.7;
  const double board = Dice(static_cast<uint64_t>(p_m.y() / kBoardM)).Between(0.9, 1.1);
  const double wave = 0.8 * std::sin(2 * M_PI * p_m.x() / kWaveM);
  return board * (1 + 0.05 * std::sin(2 * M_PI * p_m.y() / kGrainM + wave));
}

struct Poster {
  Eigen::AlignedBox2d box;  // on the wall, m
  double factor = 1;
};

// Returns the factor of the first poster that covers the place; 1 where none does.
double PostersAt(const std::vector<Poster>& posters, const Eigen::Vector2d& p_m) {
  for (const Poster& poster : posters)
    if (poster.box.contains(p_m)) return poster.factor;
  return 1;
}

double CoveredShare(const std::vector<Poster>& posters, const Eigen::Vector2d& wall_m) {
  constexpr int kSteps = 60;
  int covered = 0;
  for (int k = 0; k < kSteps * kSteps; ++k) {
    const Eigen::Array2d place_m = MiddleOf(k, kSteps, kSteps) * wall_m.array();
    covered += PostersAt(posters, place_m) == 1 ? 0 : 1;
  }
  return static_cast<double>(covered) / (kSteps * kSteps);
}

std::vector<Poster> DrawPosters(const Eigen::Vector2d& wall_m, uint64_t seed) {
  constexpr double kCovered = 0.5, kDarkShare = 0.27;  // the share makes their mean factor 1
  Dice dice(seed);
  std::vector<Poster> posters;
  while (CoveredShare(posters, wall_m) < kCovered) {
    // Braces: the order of the draws is that of the text.
    const Eigen::Array2d size_m{dice.Between(0.4, 1.2), dice.Between(0.4, 1.2)}, place{dice(), dice()};
    const Eigen::Vector2d corner = place * (wall_m.array() - size_m);
    const bool is_dark = dice() < kDarkShare;
    const double factor = is_dark ? dice.Between(0.3, 0.9) : dice.Between(1.05, 1.25);
    posters.push_back({{corner, corner + size_m.matrix()}, factor});
  }
  return posters;
}

Eigen::Vector3d VectorOf(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

}  // namespace

OfficeTexture::OfficeTexture(const std::filesystem::path& office)
    : scene_(ReadScene((office / "room.obj").string())),
      rays_(scene_),
      camera_(ReadCamera((office / "cam0.yaml").string())),
      tags_(ReadTagMap((office / "tags.json").string())) {
  const nlohmann::json truth = nlohmann::json::parse(std::ifstream(office / "truth.json"));
  for (const nlohmann::json& json : truth.at("views")) {
    View& view = views_[json.at("view").get<std::string>()];
    view.eye = VectorOf(json.at("position_m"));
    for (int row = 0; row < 3; ++row)
      view.world_from_cam.row(row) = VectorOf(json.at("R_scene_from_camera").at(static_cast<size_t>(row)));
  }
  DrawPatterns();
  MakeMeansOne();
}

void OfficeTexture::DrawPatterns() {
  patterns_.resize(scene_.facets.size());
  for (size_t f = 0; f < patterns_.size(); ++f) {
    const Facet& facet = scene_.facets[f];
    const std::string& material = scene_.materials[static_cast<size_t>(facet.material)];
    if (material == "floor") patterns_[f] = Carpet;
    if ((material == "desk" || material == "cabinet") && facet.Normal().z() > 0.99) patterns_[f] = Wood;
    if (material == "wall" || material == "wall_accent") {
      const std::vector<Poster> posters = DrawPosters({facet.edge_u.norm(), facet.edge_v.norm()}, f);
      patterns_[f] = [posters](const Eigen::Vector2d& p_m) { return PostersAt(posters, p_m); };
    }
  }
}

void OfficeTexture::MakeMeansOne() {
  const auto materials = static_cast<Eigen::Index>(scene_.materials.size());
  Eigen::VectorXd area_m2 = Eigen::VectorXd::Constant(materials, 1e-9), sum_m2 = area_m2;
  VisitSurface([&](int facet, double u, double v, double cell_m2) {
    if (!IsTextured(facet, u, v) || !IsSeen(facet, FacetOf(facet).PointAt(u, v))) return;
    area_m2[FacetOf(facet).material] += cell_m2;
    sum_m2[FacetOf(facet).material] += cell_m2 * PatternAt(facet, u, v);
  });
  scale_ = area_m2.cwiseQuotient(sum_m2);
}

void OfficeTexture::VisitSurface(const Visit& visit) const {
  for (size_t f = 0; f < scene_.facets.size(); ++f) {
    const Facet& facet = scene_.facets[f];
    const int facet_index = static_cast<int>(f);
    const int cells_u = std::max(2, static_cast<int>(std::ceil(facet.edge_u.norm() / kCellM)));
    const int cells_v = std::max(2, static_cast<int>(std::ceil(facet.edge_v.norm() / kCellM)));
    for (int k = 0; k < cells_u * cells_v; ++k) {
      const Eigen::Array2d uv = MiddleOf(k, cells_u, cells_v);
      if (!IsInsideSolid(facet_index, facet.PointAt(uv[0], uv[1])))
        visit(facet_index, uv[0], uv[1], facet.AreaM2() / (cells_u * cells_v));
    }
  }
}

bool OfficeTexture::IsInsideSolid(int facet, const Eigen::Vector3d& p) const {
  const Eigen::Vector3d normal = FacetOf(facet).Normal();
  const RayHit hit = rays_.Trace(LiftedOff(p, normal), normal);
  return hit.facet >= 0 && !hit.front;
}

bool OfficeTexture::IsNearTag(const Eigen::Vector3d& p) const {
  return std::any_of(tags_.begin(), tags_.end(), [&](const SurveyedTag& tag) {
    return (p - tag.center_in_world).norm() < kTagSizes * tag.size_m;
  });
}

bool OfficeTexture::IsSeen(int facet, const Eigen::Vector3d& p) const {
  const Eigen::Vector3d normal = FacetOf(facet).Normal();
  return std::any_of(views_.begin(), views_.end(), [&](const auto& named) {
    const View& view = named.second;
    if (normal.dot(view.eye - p) <= 0) return false;
    const Eigen::Vector2d px = Project(camera_, view.world_from_cam.transpose() * (p - view.eye));
    const bool is_inside = px.x() >= 0 && px.y() >= 0 && px.x() <= camera_.width_px - 1 &&
                           px.y() <= camera_.height_px - 1;  // false for NaN
    return is_inside && !rays_.Occluded(LiftedOff(p, normal), view.eye);
  });
}

bool OfficeTexture::IsTextured(int facet, double u, double v) const {
  return patterns_[static_cast<size_t>(facet)] && !IsNearTag(FacetOf(facet).PointAt(u, v));
}

double OfficeTexture::PatternAt(int facet, double u, double v) const {
  const Facet& f = FacetOf(facet);
  // A ray tracer's place may lie a rounding error off the facet.
  return patterns_[static_cast<size_t>(facet)](
      {std::clamp(u, 0., 1.) * f.edge_u.norm(), std::clamp(v, 0., 1.) * f.edge_v.norm()});
}

double OfficeTexture::FactorAt(int facet, double u, double v) const {
  return IsTextured(facet, u, v) ? scale_[FacetOf(facet).material] * PatternAt(facet, u, v) : 1;
}

cv::Mat OfficeTexture::FactorsIn(const std::string& view) const {
  const View& from = views_.at(view);
  cv::Mat factors(camera_.height_px, camera_.width_px, CV_32F);
  factors.forEach<float>([&](float& factor, const int* at) {
    constexpr int kRays = kRaysPerSide * kRaysPerSide;
    double sum = 0;
    for (int k = 0; k < kRays; ++k) {
      const Eigen::Array2d in_pixel = MiddleOf(k, kRaysPerSide, kRaysPerSide) - 0.5;
      const Eigen::Vector2d pixel(at[1] + in_pixel[0], at[0] + in_pixel[1]);
      const Eigen::Vector3d direction = Unproject(camera_, pixel);
      const RayHit hit = rays_.Trace(from.eye, from.world_from_cam * direction);
      sum += hit.facet >= 0 && hit.front ? FactorAt(hit.facet, hit.u, hit.v) : 1;
    }
    factor = static_cast<float>(sum / kRays);
  });
  return factors;
}

void OfficeTexture::PrintMeans() const {
  const auto materials = static_cast<Eigen::Index>(scene_.materials.size());
  Eigen::VectorXd area_m2 = Eigen::VectorXd::Zero(materials), sum_m2 = area_m2;
  Eigen::VectorXd seen_m2 = area_m2, seen_sum_m2 = area_m2, squares_m2 = area_m2;
  VisitSurface([&](int facet, double u, double v, double cell_m2) {
    const int m = FacetOf(facet).material;
    const double factor = FactorAt(facet, u, v);
    area_m2[m] += cell_m2;
    sum_m2[m] += cell_m2 * factor;
    squares_m2[m] += cell_m2 * (factor - 1) * (factor - 1);
    if (!IsSeen(facet, FacetOf(facet).PointAt(u, v))) return;
    seen_m2[m] += cell_m2;
    seen_sum_m2[m] += cell_m2 * factor;
  });
  std::printf("%-12s %9s %12s %9s %9s %17s\n", "material", "area, m2", "mean factor", "sigma", "seen, m2",
              "mean where seen");
  for (Eigen::Index m = 0; m < materials; ++m) {
    std::printf("%-12s %9.2f %12.4f %9.3f %9.2f %17.4f\n", scene_.materials[static_cast<size_t>(m)].c_str(),
                area_m2[m], sum_m2[m] / area_m2[m], std::sqrt(squares_m2[m] / area_m2[m]), seen_m2[m],
                seen_sum_m2[m] / seen_m2[m]);
  }
}

}  // namespace luxfit
