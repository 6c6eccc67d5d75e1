// Estimates by how much photos of a room differ in light that is not the room's, and takes it out of their signatures.
//
//   ln Y_avs - ln Y_bvs = g_as - g_bs + sum_k (c_ak r_a^2k - c_bk r_b^2k)        v: place of the mesh that views a and b see
//
// g: gain of a view in a state: light that flickers, an exposure that is off. c: vignetting of the view's camera; r: distance
// of the pixel from the picture's centre over half its diagonal. Views that keep them contradict each other all over
// walls that are where the mesh has them, and agree by chance on planes in front of them.
//
// Half of the places may be furniture that the mesh lacks: the fit starts from least absolute differences, and goes on with
// weights that fall with the square (inverse/select/internal/robust_rows.h). Where no correction is larger than a third of the tolerance with which signatures
// are compared, the views stay as they are; so they do where views differ afterwards by more than the tolerance of both (1 sigma): tones that
// were mapped locally are no gains, and views without them would agree by chance.
//
// A factor common to a state is not determined, and is left alone. The final calibration of photos is another step, which
// knows how luminaires add up (inverse/observe/camera/self_calibration.h): this one must stand a mesh that lacks furniture, and a
// wrong table of states.
// Source: Goldman (2010), "Vignette and exposure calibration and compensation", eq. 1, in logarithms; Holland and Welsch (1977) for the weights.
#ifndef LUXFIT_INVERSE_FURNITURE_PHOTO_GAINS_H_
#define LUXFIT_INVERSE_FURNITURE_PHOTO_GAINS_H_

#include <Eigen/Core>
#include <vector>

#include "forward/room/scene.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {

constexpr int kVignettingTerms = 2;

struct PhotoGains {
  Eigen::MatrixXd log_gain;    // views x states, g
  Eigen::MatrixXd vignetting;  // kVignettingTerms x cameras, c
  bool matter = false;         // some exceed a third of the tolerance, and explain what views differ by
};

// `tolerance`: of ln Y, as in FurnitureOptions.
PhotoGains EstimatePhotoGains(const Scene& mesh, const std::vector<SignatureView>& views, double tolerance);

// Returns the views without the gains that matter.
std::vector<SignatureView> WithoutGains(std::vector<SignatureView> views, const PhotoGains& gains);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_PHOTO_GAINS_H_
