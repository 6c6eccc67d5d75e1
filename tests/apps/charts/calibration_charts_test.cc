// Pictures of a calibration, by what they must show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "apps/charts/coverage_svg.h"
#include "apps/charts/residual_svg.h"
#include "apps/charts/rig_svg.h"
#include "apps/charts/uncertainty_svg.h"

namespace luxfit {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

TEST(ResidualSvg, MagnifiesByARoundNumber) {
  const ImageFrame frame{640, 480};
  // 8 % of 640 px over 0.2 px is 256.
  EXPECT_EQ(ResidualMagnification(frame, {{{10, 10}, {0.2, 0}, false}, {{90, 90}, {9, 9}, true}}), 200);
  EXPECT_EQ(ResidualMagnification(frame, {}), 1);
  EXPECT_EQ(ResidualMagnification(frame, {{{10, 10}, {0, 0}, false}}), 1);
  EXPECT_THAT(ResidualVectorsSvg(frame, {{{10, 10}, {0.2, 0}, false}}), HasSubstr("200 times magnified"));
}

// A vector begins at the corner's pixel and ends where its magnified residual points.
TEST(ResidualSvg, DrawsPredictedLessSeen) {
  const ImageFrame frame{430, 430};  // drawn at its own size
  const std::string svg = ResidualVectorsSvg(frame, {{{99.5, 49.5}, {0.2, -0.1}, false}});
  EXPECT_THAT(svg, HasSubstr("<line x1=\"138.0\" y1=\"60.0\" x2=\"158.0\" y2=\"50.0\"")) << "100 times";
}

TEST(ResidualSvg, OutliersWithoutAResidualAreCrossesAlone) {
  const std::string svg = ResidualVectorsSvg({640, 480}, {{{10, 10}, {kNoValue, kNoValue}, true}});
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_EQ(ResidualHistogramSvg({{{10, 10}, {kNoValue, kNoValue}, true}}, 0.1), "");
  EXPECT_EQ(ResidualHistogramSvg({{{10, 10}, {0.1, 0}, false}}, 0), "");
}

TEST(CoverageSvg, HatchesCellsWithoutCorners) {
  Eigen::MatrixXi counts(1, 2);
  counts << 0, 7;
  const std::string svg = CoverageSvg({640, 480}, counts, {}, {{500, 200}});
  EXPECT_THAT(svg, HasSubstr("fill=\"url(#no-corner)\""));
  EXPECT_THAT(svg, HasSubstr(">7</text>"));
}

TEST(CoverageSvg, NothingLacksOutsideTheImageCircle) {
  Eigen::MatrixXi counts(1, 2);
  counts << 0, 7;
  const std::string svg = CoverageSvg({640, 480}, counts, {{480, 240}, 200}, {{500, 200}});
  EXPECT_THAT(svg, Not(HasSubstr("fill=\"url(#no-corner)\"")));
}

TEST(UncertaintySvg, LeavesBlankWhatLiesOutsideTheImageCircle) {
  UncertaintyMap map;
  map.width_px = 640;
  map.height_px = 480;
  map.sigma_px = Eigen::MatrixXd::Constant(1, 2, kNoValue);
  const auto hatched = [&] {
    const std::string svg = UncertaintySvg(map, {});
    std::size_t count = 0;
    for (std::size_t at = 0; (at = svg.find("fill=\"url(#unknown)\"", at)) != std::string::npos; ++at)
      ++count;
    return count;
  };
  EXPECT_EQ(hatched(), 2U);
  map.circle = {{480, 240}, 200};
  EXPECT_EQ(hatched(), 1U);
}

DrawnCamera CameraAt(const std::string& name, double x_m) {
  DrawnCamera camera;
  camera.name = name;
  camera.rig_from_cam.translation().x() = x_m;
  camera.corner_directions = {
      Eigen::Vector3d(-0.4, -0.3, 0.87), {0.4, -0.3, 0.87}, {0.4, 0.3, 0.87}, {-0.4, 0.3, 0.87}};
  return camera;
}

TEST(RigSvg, DimensionsAreInMillimetres) {
  DrawnRig rig;
  rig.cameras = {CameraAt("left", 0), CameraAt("right", 0.0831)};
  for (const double z_m : {0.4, 0.6})
    rig.boards.push_back(
        {Eigen::Vector3d(-0.1, -0.1, z_m), {0.1, -0.1, z_m}, {0.1, 0.1, z_m}, {-0.1, 0.1, z_m}});
  EXPECT_THAT(RigSvg(rig, RigView::kPlan), HasSubstr("left to right: 83.1 mm"));
  const std::string side = RigSvg(rig, RigView::kSide);
  EXPECT_THAT(side, HasSubstr("nearest board: 400 mm"));
  EXPECT_THAT(side, HasSubstr("farthest board: 600 mm"));
}

TEST(RigSvg, DrawsOneCameraWithoutBoardsAndWithoutAField) {
  DrawnRig rig;
  rig.cameras = {CameraAt("<alone>", 0)};
  rig.cameras[0].corner_directions.fill(Eigen::Vector3d::Constant(kNoValue));
  for (const RigView view : {RigView::kPlan, RigView::kSide}) {
    const std::string svg = RigSvg(rig, view);
    EXPECT_THAT(svg, HasSubstr("&lt;alone&gt;"));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
  }
}

}  // namespace
}  // namespace luxfit
