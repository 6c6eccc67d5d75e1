// Outlines of luminaires as a pinhole camera sees them: rims projected to pixels, and pixels turned into rays.
//
// Metres in world, pixels. The rays are those of FindSeenOutlines.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_LUMINAIRE_OUTLINES_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_LUMINAIRE_OUTLINES_H_

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "inverse/observe/seen_luminaires.h"
#include "tests/support/calib/look_at.h"
#include "tests/support/calib/pinhole.h"
#include "tests/support/closed_forms.h"

namespace luxfit::support {

inline Camera OutlineCamera() { return Pinhole(800, 600, 600, {399.5, 299.5}); }

inline RegisteredView ViewFrom(const Eigen::Vector3d& eye, const Eigen::Vector3d& at) {
  RegisteredView view;
  view.cam_from_world = LookAt(eye, at);
  return view;
}

// Returns a point of the rim of the square from -1 to 1; `turn` runs from 0 to 4, one for each side.
inline Eigen::Vector2d OnSquare(double turn) {
  const int side = static_cast<int>(std::floor(turn));
  const double along = 2 * (turn - side) - 1;
  if (side == 0) return {1, along};
  if (side == 1) return {-along, 1};
  return side == 2 ? Eigen::Vector2d(-1, -along) : Eigen::Vector2d(along, -1);
}

// Returns points of a disc's circle or a rectangle's sides, as many on each side. None is a corner where
// `points` is a multiple of 4. `growth`: the rim's size over the luminaire's.
inline std::vector<Eigen::Vector3d> RimOf(const Luminaire& luminaire, int points, double growth = 1) {
  const LuminaireAxes axes = AxesOf(luminaire);
  const bool is_disc = luminaire.shape == LuminaireShape::kDisc;
  const Eigen::Vector2d half =
      0.5 * growth * Eigen::Vector2d(luminaire.size_m[0], luminaire.size_m[is_disc ? 0 : 1]);
  std::vector<Eigen::Vector3d> rim;
  rim.reserve(static_cast<size_t>(points));
  for (int i = 0; i < points; ++i) {
    const double share = (i + 0.5) / points;
    const Eigen::Vector2d unit =
        is_disc ? Eigen::Vector2d(std::cos(2 * kPi * share), std::sin(2 * kPi * share)) : OnSquare(4 * share);
    rim.push_back(luminaire.position + half[0] * unit[0] * axes.along + half[1] * unit[1] * axes.across);
  }
  return rim;
}

inline std::vector<Eigen::Vector2d> PixelsOf(const Camera& camera, const RegisteredView& view,
                                             const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(points.size());
  for (const Eigen::Vector3d& p : points) pixels.push_back(Project(camera, view.cam_from_world * p));
  return pixels;
}

// Returns the outline of a blob with that contour, which needs at least 6 pixels.
inline SeenOutline OutlineThrough(const Camera& camera, const RegisteredView& view,
                                  const std::vector<Eigen::Vector2d>& contour_px) {
  BrightBlob blob;
  blob.contour_px = contour_px;
  return FindSeenOutlines({camera}, {view}, {{0, 0, {blob}}}).at(0);
}

// Says how a view shows the rim. `shift_px` moves all of its pixels.
struct RimView {
  int view = 0, state = 0;
  double growth = 1;
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
};

// Returns the rim as 32 rays of a pinhole camera that looks at the luminaire.
inline SeenOutline OutlineFrom(const Eigen::Vector3d& eye, const Luminaire& luminaire,
                               const RimView& rim = {}) {
  const RegisteredView view = ViewFrom(eye, luminaire.position);
  std::vector<Eigen::Vector2d> contour_px = PixelsOf(OutlineCamera(), view, RimOf(luminaire, 32, rim.growth));
  for (Eigen::Vector2d& pixel : contour_px) pixel += rim.shift_px;
  SeenOutline outline = OutlineThrough(OutlineCamera(), view, contour_px);
  outline.view = rim.view;
  outline.state = rim.state;
  return outline;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_LUMINAIRE_OUTLINES_H_
