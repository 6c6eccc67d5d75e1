#include "calib/luminance/response.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace luxfit {
namespace {

void ExpectIncreasing(const Eigen::VectorXd& values, const std::string& name) {
  for (Eigen::Index i = 1; i < values.size(); ++i) {
    if (!(values[i] > values[i - 1]))
      throw std::invalid_argument("CameraResponse: " + name + ": expected values that increase, got " +
                                  std::to_string(values[i - 1]) + ", " + std::to_string(values[i]));
  }
}

// Returns the interval of ascending knots that holds x, or the nearest one.
Eigen::Index IntervalOf(const Eigen::VectorXd& knots, double x) {
  const double* const at = std::upper_bound(knots.data(), knots.data() + knots.size(), x);
  return std::clamp<Eigen::Index>(at - knots.data() - 1, 0, knots.size() - 2);
}

double Interpolate(const Eigen::VectorXd& knots, const Eigen::VectorXd& values, double x) {
  const Eigen::Index i = IntervalOf(knots, x);
  const double share = std::clamp((x - knots[i]) / (knots[i + 1] - knots[i]), 0.0, 1.0);
  return values[i] + share * (values[i + 1] - values[i]);
}

}  // namespace

CameraResponse::CameraResponse(Eigen::VectorXd counts, std::array<Eigen::VectorXd, 3> exposure)
    : counts_(std::move(counts)), exposure_(std::move(exposure)) {
  if (counts_.size() < 2 || !counts_.allFinite())
    throw std::invalid_argument("CameraResponse: counts: expected two finite knots or more");
  ExpectIncreasing(counts_, "counts");
  for (const Eigen::VectorXd& curve : exposure_) {
    if (curve.size() != counts_.size() || !curve.allFinite())
      throw std::invalid_argument("CameraResponse: exposure: expected one finite value a knot");
    ExpectIncreasing(curve, "exposure");
  }
}

CameraResponse CameraResponse::WithRelativeSigma(std::array<Eigen::VectorXd, 3> relative_sigma) const {
  for (const Eigen::VectorXd& sigma : relative_sigma) {
    if (sigma.size() != counts_.size() || !sigma.allFinite() || !(sigma.array() > 0).all())
      throw std::invalid_argument("CameraResponse: relative_sigma: expected one value > 0 a knot");
  }
  CameraResponse response = *this;
  response.relative_sigma_ = std::move(relative_sigma);
  return response;
}

double CameraResponse::RelativeSigma(size_t channel, double counts) const {
  return Interpolate(counts_, relative_sigma_[channel], counts);
}

double CameraResponse::Exposure(size_t channel, double counts) const {
  return Interpolate(counts_, exposure_[channel], counts);
}

double CameraResponse::Counts(size_t channel, double exposure) const {
  return Interpolate(exposure_[channel], counts_, exposure);
}

double CameraResponse::Slope(size_t channel, double counts) const {
  const Eigen::Index i = IntervalOf(counts_, counts);
  const Eigen::VectorXd& curve = exposure_[channel];
  return (curve[i + 1] - curve[i]) / (counts_[i + 1] - counts_[i]);
}

}  // namespace luxfit
