// Cuts polygons in the plane: into rectangles where all corners have right angles, and along chords.
//
// Lengths in m. Polygons are simple and run counter-clockwise. Nearer than kPlanGapM two things are one place.
#ifndef LUXFIT_FORWARD_MESH_INTERNAL_PLAN_POLYGON_H_
#define LUXFIT_FORWARD_MESH_INTERNAL_PLAN_POLYGON_H_

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace luxfit {

using PlanPolygon = std::vector<Eigen::Vector2d>;

constexpr double kPlanGapM = 1e-3;

// Returns the area, m2; negative where the polygon runs clockwise.
double SignedAreaM2(const PlanPolygon& polygon);

double DistanceToSegmentM(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b);

// Tells whether two segments cross, or come nearer to each other than kPlanGapM.
bool SegmentsMeet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                  const Eigen::Vector2d& d);

// Tells whether a point lies in the polygon or at most kPlanGapM outside it.
bool IsInPolygon(const PlanPolygon& polygon, const Eigen::Vector2d& p);

// Tells whether the segment between corners i and j, no neighbours, lies inside the polygon.
bool IsChord(const PlanPolygon& polygon, size_t i, size_t j);

// Intervals of t between s0 and s1.
struct PlanStrip {
  double s0 = 0, s1 = 0;
  std::vector<std::pair<double, double>> intervals;  // ascending
};
struct PlanRectangle {
  double s0 = 0, s1 = 0, t0 = 0, t1 = 0;
};
// Returns the rectangles of strips, which ascend in s. Equal intervals of neighbours become one rectangle.
std::vector<PlanRectangle> MergedStrips(const std::vector<PlanStrip>& strips);

// Returns numbers sorted, those that differ by less than 1 um once.
std::vector<double> SortedCuts(std::vector<double> numbers);

// Returns the polygon as counter-clockwise rectangles of few pieces; none where a corner has no right angle.
std::vector<PlanPolygon> RectanglesOf(const PlanPolygon& polygon);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_INTERNAL_PLAN_POLYGON_H_
