// Cuts the surfaces that photos show into segments of like paint, where the mesh does not tell materials.
//
//   x_e = ln rho_e            rho_e: median over states of pi Y_es / (c E_es)    inverse/albedo/patch_albedo.h
//   rho = exp(robust mean of x_e over the segment)
//   sigma = rho hypot(scatter of its patches' means / sqrt(patches), sigma_rho / rho of the fit's materials there)
//
// Segments grow from even patches over elements that adjoin, across planes too, and elsewhere on one plane
// (inverse/albedo/internal/like_regions.h): a room's walls are one segment where they have one paint, a desk is one. The
// variance of x_e is that by which elements that adjoin scatter. The error that a segment's elements share is that of the
// light there: kLeastSharedSigma, or what the fit says if that is more. Neighbours are two segments where they differ by
// 3 sigmas and more. What adjoins nothing and is smaller than 0.3 m2 is left out.
//
// Lengths in m, areas in m2, world frame; reflectances are dimensionless.
// Throws std::invalid_argument as EstimatePatchAlbedo does.
// Sources: those of both headers.
#ifndef LUXFIT_INVERSE_ALBEDO_PAINT_SEGMENTS_H_
#define LUXFIT_INVERSE_ALBEDO_PAINT_SEGMENTS_H_

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/light_state.h"

namespace luxfit {

// The light of a fit errs by so much between places, relative (1 sigma; docs/accuracy.md).
constexpr double kLeastSharedSigma = 0.02;

struct ElementReflectance {
  int element = 0;
  double albedo = 0;
  // Gives red, green and blue, as neutral light shows them; NaN: not known.
  Eigen::Vector3d albedo_rgb = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

struct PaintSegment {
  std::vector<int> elements;  // that photos show
  double area_m2 = 0;         // theirs
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // mean by area; shorter than 1 where planes face apart
  double low_m = 0, high_m = 0;                      // heights of the elements' centres
  double albedo = 0, sigma = 0;
  Eigen::Vector3d albedo_rgb = Eigen::Vector3d::Zero();  // NaN: not known
};

struct PaintSegments {
  std::vector<PaintSegment> segments;  // the largest first
  double element_sigma = 0;            // of x_e
  double shared_sigma = 0;
  double least_z = std::numeric_limits<double>::infinity();  // of segments that adjoin; infinity: none do
};

// `relative_sigma`: by material, of the fit's reflectances; it counts for the segments' sigmas alone.
PaintSegments SegmentPaints(const Patches& patches, const std::vector<ElementReflectance>& reflectances,
                            double shared_sigma, const Eigen::VectorXd& relative_sigma);

// Does so by the light of a fit.
PaintSegments SegmentPaints(const Room& room, const LightData& data, const LuminaireFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_PAINT_SEGMENTS_H_
