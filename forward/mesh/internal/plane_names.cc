#include "forward/mesh/internal/plane_names.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace luxfit {
namespace {

constexpr double kLargeM2 = 0.3;

// Returns by triangle the number of the piece that hangs together.
std::vector<int> PiecesOf(const ScanMesh& mesh) {
  std::vector<int> piece(mesh.triangles.size(), -1);
  int count = 0;
  for (size_t start = 0; start < piece.size(); ++start) {
    if (piece[start] >= 0) continue;
    std::vector<size_t> stack{start};
    piece[start] = count;
    while (!stack.empty()) {
      const size_t t = stack.back();
      stack.pop_back();
      for (const int n : mesh.across[t]) {
        if (n < 0 || piece[static_cast<size_t>(n)] >= 0) continue;
        piece[static_cast<size_t>(n)] = count;
        stack.push_back(static_cast<size_t>(n));
      }
    }
    ++count;
  }
  return piece;
}

// Names large planes by what they are in a room, and numbers those of a kind by area.
class PlaneNames {
 public:
  PlaneNames(const ScanMesh& mesh, const PlanarRegions& regions) {
    low_.assign(regions.planes.size(), std::numeric_limits<double>::infinity());
    high_.assign(regions.planes.size(), -std::numeric_limits<double>::infinity());
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (regions.of_triangle[t] < 0) continue;
      const auto region = static_cast<size_t>(regions.of_triangle[t]);
      for (size_t k = 0; k < 3; ++k) {
        low_[region] = std::min(low_[region], mesh.Corner(t, k).z());
        high_[region] = std::max(high_[region], mesh.Corner(t, k).z());
      }
    }
    floor_m_ = *std::min_element(low_.begin(), low_.end());
    ceiling_m_ = *std::max_element(high_.begin(), high_.end());
  }

  std::string NameOf(size_t region, const Plane& plane) {
    const std::string kind = KindOf(region, plane);
    const int number = ++count_[kind];
    const bool is_single = number == 1 && (kind == "floor" || kind == "ceiling");
    return is_single ? kind : kind + " " + std::to_string(number);
  }

 private:
  std::string KindOf(size_t region, const Plane& plane) const {
    constexpr double kLevel = 0.95, kUpright = 0.3, kEnd = 0.1, kTall = 0.7;
    const double height_m = ceiling_m_ - floor_m_;
    if (plane.normal.z() > kLevel && high_[region] < floor_m_ + kEnd * height_m) return "floor";
    if (plane.normal.z() < -kLevel && low_[region] > ceiling_m_ - kEnd * height_m) return "ceiling";
    if (std::abs(plane.normal.z()) < kUpright && high_[region] - low_[region] > kTall * height_m)
      return "wall";
    return "surface";
  }

  std::vector<double> low_, high_;  // by region, m
  double floor_m_ = 0, ceiling_m_ = 0;
  std::map<std::string, int> count_;
};

// Returns by region the piece that it belongs to; -1: one that is small as a whole.
std::vector<int> LargePieceOf(const ScanMesh& mesh, const PlanarRegions& regions) {
  const std::vector<int> pieces = PiecesOf(mesh);
  std::vector<int> piece_of(regions.planes.size(), -1);
  std::vector<double> piece_m2(pieces.size(), 0);
  for (size_t t = 0; t < pieces.size(); ++t) {
    if (regions.of_triangle[t] >= 0) piece_of[static_cast<size_t>(regions.of_triangle[t])] = pieces[t];
    piece_m2[static_cast<size_t>(pieces[t])] += 0.5 * mesh.AreaNormal(t).norm();
  }
  for (int& piece : piece_of)
    if (piece >= 0 && piece_m2[static_cast<size_t>(piece)] < kLargeM2) piece = -1;
  return piece_of;
}

}  // namespace

std::vector<int> NamePlanes(const ScanMesh& mesh, const PlanarRegions& regions, const std::string& named,
                            std::vector<std::string>& materials) {
  std::vector<int> material = regions.material;
  const auto at = std::find(materials.begin(), materials.end(), named);
  if (at == materials.end()) return material;
  const auto unnamed = static_cast<int>(at - materials.begin());
  const std::vector<std::string> given = std::exchange(materials, {});
  const auto add = [&materials](std::string name) {
    materials.push_back(std::move(name));
    return static_cast<int>(materials.size()) - 1;
  };
  const std::vector<int> piece_of = LargePieceOf(mesh, regions);
  PlaneNames names(mesh, regions);
  std::map<int, int> details;  // by piece
  for (size_t r = 0; r < material.size(); ++r) {
    if (regions.material[r] != unnamed) continue;
    if (regions.area_m2[r] >= kLargeM2) {
      material[r] = add(names.NameOf(r, regions.planes[r]));
      continue;
    }
    const auto [of_piece, is_new] = details.try_emplace(piece_of[r], 0);
    if (is_new) of_piece->second = add("details " + std::to_string(details.size()));
    material[r] = of_piece->second;
  }
  std::map<int, int> others;
  for (size_t r = 0; r < material.size(); ++r) {
    if (regions.material[r] == unnamed) continue;
    const auto [other, is_new] = others.try_emplace(regions.material[r], 0);
    if (is_new) other->second = add(given[static_cast<size_t>(regions.material[r])]);
    material[r] = other->second;
  }
  return material;
}

}  // namespace luxfit
