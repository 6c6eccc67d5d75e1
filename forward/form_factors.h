// Form factors from receivers to patches, by cosine-weighted rays.
//
//   F_ej = (1 / A_e) int_e int_j cos(theta) cos(theta') / (pi r^2) V dA' dA
//        ~ (rays of receiver e that first meet the front of patch j) / rays
//
// Rays start on a low-discrepancy set of points of the receiver (its centre for a sensor) and leave by
// Malley's method: uniform on the unit disc, lifted to the hemisphere. The same additive sequence for all
// receivers, shifted at random per receiver (Cranley-Patterson), so errors of neighbours are independent; the
// shift is a hash of the receiver's index, so results repeat.
//
// Rows of elements sum to 1 in a closed room. Rays that leave the scene carry no light; those that meet the
// back of a facet started inside a solid and do not count. Both are reported: in a closed, consistently
// oriented room there are few.
// Source: Malley (1988), "A shading method for computer generated images"; Cohen
// and Wallace (1993), "Radiosity and Realistic Image Synthesis", sec. 4.2; Cranley and Patterson (1976).
#ifndef LUXFIT_FORWARD_FORM_FACTORS_H_
#define LUXFIT_FORWARD_FORM_FACTORS_H_

#include <Eigen/Core>

#include "forward/patches.h"
#include "forward/visibility.h"

namespace luxfit {

// receivers x patches
using FormFactorMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct FormFactors {
  FormFactorMatrix element_to_patch;  // elements x patches
  double escaped_fraction = 0;        // of the rays: left the scene
  double back_fraction = 0;           // of the rays: met the back of a facet
};

struct FormFactorOptions {
  int rays_per_element = 256;
};

// Throws std::invalid_argument if rays_per_element < 1.
FormFactors ComputeFormFactors(const RayScene& rays, const Patches& patches,
                               const FormFactorOptions& options = {});

// One row for a sensor point with a cosine response (a luxmeter): share of its irradiance from each patch's
// exitance.
Eigen::VectorXf SensorFormFactors(const RayScene& rays, const Patches& patches,
                                  const Eigen::Vector3d& p_in_world, const Eigen::Vector3d& normal,
                                  int ray_count = 16384);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FORM_FACTORS_H_
