#include "apps/report/display_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "forward/room/visibility.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

Patches Cut(const Scene& scene, double element_size_m) {
  return Subdivide(scene, RayScene(scene), {4 * element_size_m, element_size_m});
}

// Area-weighted sum over all cells of a facet, by the elements' areas.
double TotalOf(const Patches& patches, const DisplayCells& display, const Eigen::VectorXd& means) {
  double total = 0;
  for (size_t c = 0; c < display.cells.size(); ++c) {
    for (const int e : display.cells[c].elements)
      total += patches.elements[static_cast<size_t>(e)].area_m2 * means[static_cast<Eigen::Index>(c)];
  }
  return total;
}

TEST(DisplayCells, FewElementsStayAsTheyAre) {
  const Patches patches = Cut(support::ClosedRoom({3, 4, 2}), 0.25);
  const DisplayCells display = MergeForDisplay(patches, 50'000);
  ASSERT_EQ(display.cells.size(), patches.elements.size());
  EXPECT_EQ(display.merged, 1);
  for (const DisplayCell& cell : display.cells) EXPECT_EQ(cell.elements.size(), 1U);
}

// A room of 57 600 elements: fewer than 50 000 are drawn, none is lost, and light is kept.
TEST(DisplayCells, ManyElementsAreMergedAndLightIsKept) {
  const Patches patches = Cut(support::ClosedRoom({6, 6, 2}), 0.0456);
  ASSERT_GT(patches.elements.size(), 50'000U);
  const DisplayCells display = MergeForDisplay(patches, 50'000);
  EXPECT_LE(display.cells.size(), 50'000U);
  EXPECT_GT(display.cells.size(), 10'000U);
  EXPECT_EQ(display.merged, 2);
  std::vector<int> used(patches.elements.size(), 0);
  for (const DisplayCell& cell : display.cells) {
    for (const int e : cell.elements) ++used[static_cast<size_t>(e)];
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 1), static_cast<std::ptrdiff_t>(used.size()));
  Eigen::VectorXd lux(static_cast<Eigen::Index>(patches.elements.size()));
  double total = 0;
  for (size_t e = 0; e < patches.elements.size(); ++e) {
    const Eigen::Vector3d& p = patches.elements[e].center;
    lux[static_cast<Eigen::Index>(e)] = 100 + 30 * p.x() + 7 * p.y() * p.z();
    total += patches.elements[e].area_m2 * lux[static_cast<Eigen::Index>(e)];
  }
  EXPECT_NEAR(TotalOf(patches, display, CellMeans(patches, display, lux)), total, 1e-9 * total);
}

TEST(DisplayCells, AMergedCellHasTheAreaWeightedMeanOfItsElements) {
  Scene scene;
  scene.materials = {"wall"};
  scene.facets = FacetsFromPolygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0);
  const Patches patches = Cut(scene, 0.25);
  ASSERT_EQ(patches.elements.size(), 16U);
  const DisplayCells display = MergeForDisplay(patches, 4);
  ASSERT_EQ(display.cells.size(), 4U);
  Eigen::VectorXd x(16);
  for (Eigen::Index e = 0; e < 16; ++e) x[e] = patches.elements[static_cast<size_t>(e)].center.x();
  const Eigen::VectorXd means = CellMeans(patches, display, x);
  for (size_t c = 0; c < 4; ++c)
    EXPECT_NEAR(means[static_cast<Eigen::Index>(c)], display.cells[c].i == 0 ? 0.25 : 0.75, 1e-12);
}

TEST(DisplayCells, TrianglesAreMergedToo) {
  Scene scene;
  scene.materials = {"wall"};
  scene.facets = FacetsFromPolygon({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, 0);
  ASSERT_EQ(scene.facets.size(), 1U);
  const Patches patches = Cut(scene, 0.1);
  const DisplayCells display = MergeForDisplay(patches, 60);
  EXPECT_LE(display.cells.size(), 60U);
  EXPECT_GT(display.cells.size(), 10U);
  Eigen::VectorXd x(static_cast<Eigen::Index>(patches.elements.size()));
  for (size_t e = 0; e < patches.elements.size(); ++e)
    x[static_cast<Eigen::Index>(e)] = patches.elements[e].center.x();
  const Eigen::VectorXd means = CellMeans(patches, display, x);
  for (size_t c = 0; c < display.cells.size(); ++c) {
    const DisplayCell& cell = display.cells[c];
    const Eigen::Array2i& grid = display.grids[0];
    const double in_cell = (cell.is_upper ? 2.0 : 1.0) / 3;
    const Eigen::Vector3d centre =
        scene.facets[0].PointAt((cell.i + in_cell) / grid[0], (cell.j + in_cell) / grid[1]);
    const double middle = centre.x();
    EXPECT_NEAR(means[static_cast<Eigen::Index>(c)], middle, 0.5 / grid[0]) << c;
  }
}

TEST(DisplayCells, ACellOfEveryFacetIsLeft) {
  const Patches patches = Cut(support::ClosedRoom({3, 4, 2}), 0.25);
  const DisplayCells display = MergeForDisplay(patches, 1);
  EXPECT_EQ(display.cells.size(), patches.facets.size());
  EXPECT_THROW(MergeForDisplay(patches, 0), std::invalid_argument);
  EXPECT_THROW(CellMeans(patches, display, Eigen::VectorXd::Zero(3)), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
