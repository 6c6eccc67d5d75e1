#include "forward/views/internal/vertex_interpolation.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

namespace luxfit {
namespace {

constexpr double kWeldM = 1e-4;  // coordinates of corners of different facets agree much better

// Identifies a vertex by place, plane and material: two facets must share these for their vertices to be one.
using VertexKey = std::tuple<int64_t, int64_t, int64_t, int64_t, int64_t, int64_t, int>;

VertexKey KeyOf(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, int material) {
  const auto round = [](double x, double step) { return static_cast<int64_t>(std::llround(x / step)); };
  return {round(p.x(), kWeldM),
          round(p.y(), kWeldM),
          round(p.z(), kWeldM),
          round(normal.x(), 1e-3),
          round(normal.y(), 1e-3),
          round(normal.z(), 1e-3),
          material};
}

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

struct Vertex {
  Eigen::Vector3d position;
  double angle = 0;           // angle that elements fill round it
  std::vector<int> elements;  // elements that touch it
};

struct Corner {
  int i, j;
  double angle;
};

// Returns the corners of cell (i, j), with the angle of the element there.
std::vector<Corner> CornersOfCell(const Element& element, int i, int j, bool triangle, bool upper) {
  const Eigen::Vector3d &u = element.edge_u, &v = element.edge_v;
  const double at_origin = Angle(u, v);
  if (!triangle)
    return {{i, j, at_origin},
            {i + 1, j, M_PI - at_origin},
            {i + 1, j + 1, at_origin},
            {i, j + 1, M_PI - at_origin}};
  const double at_u = Angle(-u, v - u), at_v = M_PI - at_origin - at_u;
  if (upper) return {{i + 1, j + 1, at_origin}, {i, j + 1, at_u}, {i + 1, j, at_v}};
  return {{i, j, at_origin}, {i + 1, j, at_u}, {i, j + 1, at_v}};
}

class Builder {
 public:
  Builder(const Scene& scene, const Patches& patches)
      : patches_(patches), vertices_of_element_(patches.elements.size()) {
    for (size_t f = 0; f < scene.facets.size(); ++f) AddFacet(scene.facets[f], patches.grids[f]);
  }

  VertexInterpolation Build() {
    std::vector<std::vector<std::pair<int, float>>> rows(vertices_.size());
    tbb::parallel_for(size_t{0}, vertices_.size(), [&](size_t v) { rows[v] = WeightsOf(vertices_[v]); });
    result_.first = {0};
    for (const auto& row : rows) {
      for (const auto& [element, weight] : row) {
        result_.element.push_back(element);
        result_.weight.push_back(weight);
      }
      result_.first.push_back(result_.element.size());
    }
    return std::move(result_);
  }

 private:
  void AddFacet(const Facet& facet, const FacetGrid& grid) {
    VertexLattice lattice;
    lattice.cells_u = grid.cells_u;
    lattice.cells_v = grid.cells_v;
    lattice.triangle = facet.kind == FacetKind::kTriangle;
    lattice.vertex_of_corner.assign(lattice.Index(0, grid.cells_v + 1), -1);
    for (int j = 0; j < grid.cells_v; ++j) {
      for (int i = 0; i < grid.cells_u; ++i) {
        for (int half = 0; half < grid.halves; ++half) {
          const int e = grid.element_of_cell[grid.Index(i, j, half == 1)];
          if (e < 0) continue;
          const Element& element = patches_.elements[static_cast<size_t>(e)];
          for (const Corner& corner : CornersOfCell(element, i, j, lattice.triangle, half == 1))
            Touch(facet, lattice, corner, e);
        }
      }
    }
    result_.lattices.push_back(std::move(lattice));
  }

  void Touch(const Facet& facet, VertexLattice& lattice, const Corner& corner, int element) {
    int& id = lattice.vertex_of_corner[lattice.Index(corner.i, corner.j)];
    if (id < 0) {
      const Eigen::Vector3d p = facet.PointAt(corner.i / static_cast<double>(lattice.cells_u),
                                              corner.j / static_cast<double>(lattice.cells_v));
      id = ids_.emplace(KeyOf(p, facet.Normal(), facet.material), static_cast<int>(vertices_.size()))
               .first->second;
      if (static_cast<size_t>(id) == vertices_.size()) vertices_.push_back({p, 0, {}});
    }
    Vertex& vertex = vertices_[static_cast<size_t>(id)];
    vertex.angle += corner.angle;
    vertex.elements.push_back(element);
    vertices_of_element_[static_cast<size_t>(element)].push_back(id);
  }

  std::vector<std::pair<int, float>> WeightsOf(const Vertex& vertex) const {
    std::vector<int> elements = vertex.elements;
    if (vertex.angle < 2 * M_PI - 1e-3) {  // at a border: their neighbours too
      for (const int e : vertex.elements) {
        for (const int v : vertices_of_element_[static_cast<size_t>(e)]) {
          const std::vector<int>& more = vertices_[static_cast<size_t>(v)].elements;
          elements.insert(elements.end(), more.begin(), more.end());
        }
      }
      std::sort(elements.begin(), elements.end());
      elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    }
    return PlaneFit(vertex.position, elements);
  }

  // Returns the weights of the elements' values in the value at p of the plane fitted to them: mean plus
  // slope. Directions in which the elements do not spread have no slope.
  std::vector<std::pair<int, float>> PlaneFit(const Eigen::Vector3d& p,
                                              const std::vector<int>& elements) const {
    const double count = static_cast<double>(elements.size());
    const auto center = [&](int e) { return patches_.elements[static_cast<size_t>(e)].center; };
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const int e : elements) mean += center(e) / count;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const int e : elements) spread += (center(e) - mean) * (center(e) - mean).transpose();
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();
    if ((p - mean).squaredNorm() > 1e-18) {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(spread);
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d direction = eigen.eigenvectors().col(axis);
        if (eigen.eigenvalues()[axis] > 1e-6 * eigen.eigenvalues()[2])
          slope += direction.dot(p - mean) / eigen.eigenvalues()[axis] * direction;
      }
    }
    std::vector<std::pair<int, float>> weights;
    weights.reserve(elements.size());
    for (const int e : elements)
      weights.emplace_back(e, static_cast<float>(1 / count + slope.dot(center(e) - mean)));
    return weights;
  }

  const Patches& patches_;
  VertexInterpolation result_;
  std::vector<Vertex> vertices_;
  std::vector<std::vector<int>> vertices_of_element_;
  std::map<VertexKey, int> ids_;
};

}  // namespace

VertexInterpolation MakeVertexInterpolation(const Scene& scene, const Patches& patches) {
  return Builder(scene, patches).Build();
}

Eigen::MatrixXf AtVertices(const VertexInterpolation& interpolation, const Eigen::MatrixXf& at_elements) {
  Eigen::MatrixXf values = Eigen::MatrixXf::Zero(interpolation.VertexCount(), at_elements.cols());
  for (Eigen::Index v = 0; v < values.rows(); ++v) {
    for (size_t k = interpolation.first[static_cast<size_t>(v)];
         k < interpolation.first[static_cast<size_t>(v) + 1]; ++k)
      values.row(v) += interpolation.weight[k] * at_elements.row(interpolation.element[k]);
  }
  return values;
}

std::array<VertexShare, 4> VerticesAt(const VertexInterpolation& interpolation, int facet, double u,
                                      double v) {
  const VertexLattice& lattice = interpolation.lattices[static_cast<size_t>(facet)];
  const double x = std::clamp(u, 0.0, 1.0) * lattice.cells_u, y = std::clamp(v, 0.0, 1.0) * lattice.cells_v;
  int i = std::min(static_cast<int>(x), lattice.cells_u - 1);
  const int j = std::min(static_cast<int>(y), lattice.cells_v - 1);
  if (lattice.triangle) i = std::min(i, lattice.cells_u - 1 - j);  // rounding past the hypotenuse
  const float a = static_cast<float>(x - i), b = static_cast<float>(y - j);
  const auto at = [&](int di, int dj) { return lattice.vertex_of_corner[lattice.Index(i + di, j + dj)]; };
  std::array<VertexShare, 4> shares;
  if (!lattice.triangle) {
    shares = {
        {{at(0, 0), (1 - a) * (1 - b)}, {at(1, 0), a * (1 - b)}, {at(1, 1), a * b}, {at(0, 1), (1 - a) * b}}};
  } else if (a + b <= 1 || i + j == lattice.cells_u - 1) {
    shares = {{{at(0, 0), std::max(0.0f, 1 - a - b)}, {at(1, 0), a}, {at(0, 1), b}, {}}};
  } else {
    shares = {{{at(1, 1), a + b - 1}, {at(0, 1), 1 - a}, {at(1, 0), 1 - b}, {}}};
  }
  float sum = 0;
  for (VertexShare& share : shares) {
    if (share.vertex < 0) share.share = 0;
    sum += share.share;
  }
  for (VertexShare& share : shares) share.share = sum > 0 ? share.share / sum : 0;
  return shares;
}

Eigen::RowVectorXf Interpolate(const VertexInterpolation& interpolation, const Eigen::MatrixXf& at_vertices,
                               int facet, double u, double v) {
  Eigen::RowVectorXf value = Eigen::RowVectorXf::Zero(at_vertices.cols());
  for (const VertexShare& share : VerticesAt(interpolation, facet, u, v)) {
    if (share.share > 0) value += share.share * at_vertices.row(share.vertex);
  }
  return value;
}

}  // namespace luxfit
