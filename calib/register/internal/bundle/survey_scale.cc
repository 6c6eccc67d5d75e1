#include "calib/register/internal/bundle/survey_scale.h"

#include <cmath>

namespace luxfit {
namespace {

// Returns the chi-square quantile of 99 %; the error is below 0.1 from one degree of freedom on.
double ChiSquareQuantile(double degrees_of_freedom) {
  constexpr double kNormalQuantile = 2.3263;
  const double variance = 2 / (9 * degrees_of_freedom);
  return degrees_of_freedom * std::pow(1 - variance + kNormalQuantile * std::sqrt(variance), 3);
}

bool IsBeyondQuantile(double chi2, double determined) {
  return determined >= 1 && chi2 > ChiSquareQuantile(determined);
}

// Returns the projection onto the directions in which the survey alone tells the tag's place.
Eigen::Matrix3d SurveyedDirections(const BundleTag& tag) {
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
  if (tag.surface) directions -= tag.surface->normal * tag.surface->normal.transpose();
  return directions;
}

}  // namespace

bool SurveyScale::IsContradicted() const { return IsBeyondQuantile(chi2, determined); }

bool SurfaceScale::IsContradicted() const { return IsBeyondQuantile(chi2, determined); }

SurveyScale EstimateSurveyScale(const BundleContext& context, const BundleAdjustment& adjustment,
                                const BundleCovariance& covariance) {
  SurveyScale scale;
  const double variance_m2 = context.options.survey_sigma_m * context.options.survey_sigma_m;
  if (!covariance.determined || !(variance_m2 > 0) || adjustment.fixed_tag >= 0) return scale;
  double squared_m2 = 0;
  for (std::size_t i = 0; i < covariance.displaced_tags.size(); ++i) {
    const BundleTag& tag = adjustment.tags.at(covariance.displaced_tags[i]);
    const Eigen::Matrix3d directions = SurveyedDirections(tag);
    squared_m2 += (directions * tag.displacement_m).squaredNorm();
    scale.determined +=
        directions.trace() - (directions * covariance.of_displacements[i]).trace() / variance_m2;
  }
  scale.chi2 = squared_m2 / (covariance.variance_factor * variance_m2);
  if (scale.determined > 0)
    scale.sigma_m = std::sqrt(squared_m2 / (covariance.variance_factor * scale.determined));
  return scale;
}

SurfaceScale EstimateSurfaceScale(const BundleAdjustment& adjustment, const BundleCovariance& covariance) {
  SurfaceScale scale;
  for (std::size_t i = 0; i < covariance.displaced_tags.size(); ++i) {
    const int id = covariance.displaced_tags[i];
    const BundleTag& tag = adjustment.tags.at(id);
    if (!tag.surface) continue;
    const Eigen::Vector3d& n = tag.surface->normal;
    const double variance_m2 = tag.surface->sigma_m * tag.surface->sigma_m;
    const double off_m = n.dot(tag.displacement_m);
    const double squared = off_m * off_m / (covariance.variance_factor * variance_m2);
    const double determined = 1 - n.dot(covariance.of_displacements[i] * n) / variance_m2;
    scale.chi2 += squared;
    scale.determined += determined;
    constexpr double kLeast =
        0.01;  // below, the tag itself holds the frame there, and the others say nothing
    if (determined < kLeast) continue;
    const double sigmas = std::sqrt(squared / determined);
    if (sigmas <= scale.worst_sigmas) continue;
    scale.worst_sigmas = sigmas;
    scale.worst_tag = id;
  }
  return scale;
}

}  // namespace luxfit
