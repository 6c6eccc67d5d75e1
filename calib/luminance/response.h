// The response of a camera that is not linear: counts -> exposure.
//
//   X_c = f_c(count),   f_c increasing, piecewise linear between knots, X relative to full scale
//
// X is proportional to luminance times relative exposure. What is outside the knots is taken at the nearest
// one. Gauge: a response is known up to one factor a channel; estimates set f_c(half scale) equal in all
// channels (a neutral grey of that count is neutral light) and the largest f_c at full scale to 1.
//
// Throws std::invalid_argument for fewer than two knots, knots or exposures that do not increase, numbers
// that are not finite.
#ifndef LUXFIT_CALIB_LUMINANCE_RESPONSE_H_
#define LUXFIT_CALIB_LUMINANCE_RESPONSE_H_

#include <Eigen/Core>
#include <array>

namespace luxfit {

class CameraResponse {
 public:
  // `exposure`: one curve a channel at the same counts.
  CameraResponse(Eigen::VectorXd counts, std::array<Eigen::VectorXd, 3> exposure);

  // The same with the standard deviation of ln X at every knot, > 0, where it is known.
  CameraResponse WithRelativeSigma(std::array<Eigen::VectorXd, 3> relative_sigma) const;

  double Exposure(size_t channel, double counts) const;
  double Counts(size_t channel, double exposure) const;  // the inverse
  double Slope(size_t channel, double counts) const;     // dX / dcount

  bool has_relative_sigma() const { return relative_sigma_[0].size() > 0; }
  double RelativeSigma(size_t channel, double counts) const;

  const Eigen::VectorXd& counts() const { return counts_; }
  const Eigen::VectorXd& exposure(size_t channel) const { return exposure_[channel]; }

 private:
  Eigen::VectorXd counts_;
  std::array<Eigen::VectorXd, 3> exposure_, relative_sigma_;
};

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_RESPONSE_H_
