// Estimates the sigma of the tag survey from a solved bundle adjustment, as a variance component, and tests
// whether tags lie on the surfaces that they are laid on.
//
//   sigma_new^2 = sum |P_t d_t|^2 / (c r),   r = sum tr(P_t) - tr(P_t Cov_t) / sigma^2
//   q = sum |P_t d_t|^2 / (c sigma^2)
//
// d_t: displacement of tag t (m), Cov_t: its covariance, sigma: the survey's sigma in the adjustment (m, per
// axis), c: factor of all variances from the corners' residuals. P_t = I, and I - n n^T for a tag on a surface
// of normal n: what remains of d_t in the plane. r is the number of displacements that the photos determine.
// The prior alone holds the common rigid motion of all tags, so it does not count. Photos that say nothing
// leave Cov_t = sigma^2 P_t, so r = 0.
//
// q has r degrees of freedom where the survey is as accurate as the adjustment assumes. Beyond the chi-square
// quantile of 99 % the displacements contradict that. Below it the estimate's own scatter, 1 / sqrt(2 r), is
// no reason to doubt what the user says. Repeated with the new sigma, the formula converges to the maximum of
// the restricted likelihood.
//
// The same holds with P_t = n n^T and the sigma s of tags on their surfaces. A single tag is off its surface by
//   |n . d_t| / sqrt(c (s^2 - n^T Cov_t n))
// of its own sigmas; among all tags, this is largest for one that hangs off its surface alone.
//
// Assumes surveyed tags with survey_sigma_m > 0; else nothing is determined (r = 0).
// Source: Koch (1999), "Parameter estimation and hypothesis testing in linear models", 3.6; Foerstner and
// Wrobel (2016), "Photogrammetric computer vision", 4.2.4; Wilson and Hilferty (1931) for the quantile; Baarda
// (1968), "A testing procedure for use in geodetic networks", for single tags.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_SURVEY_SCALE_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_SURVEY_SCALE_H_

#include "calib/register/internal/bundle/bundle_adjustment.h"
#include "calib/register/internal/bundle/bundle_covariance.h"

namespace luxfit {

struct SurveyScale {
  double sigma_m = 0;     // estimate, before the factor c
  double chi2 = 0;        // q
  double determined = 0;  // r

  // Returns whether q exceeds the chi-square quantile of 99 %. Less than one determined displacement
  // contradicts nothing.
  bool IsContradicted() const;
};

// `covariance`: that of `adjustment`.
SurveyScale EstimateSurveyScale(const BundleContext& context, const BundleAdjustment& adjustment,
                                const BundleCovariance& covariance);

struct SurfaceScale {
  double chi2 = 0;          // q along the normals
  double determined = 0;    // r
  int worst_tag = -1;       // that hangs furthest off its surface; -1: no tag can be checked
  double worst_sigmas = 0;  // how far

  bool IsContradicted() const;
};

SurfaceScale EstimateSurfaceScale(const BundleAdjustment& adjustment, const BundleCovariance& covariance);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_SURVEY_SCALE_H_
