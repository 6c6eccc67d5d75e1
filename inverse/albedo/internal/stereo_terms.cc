#include "inverse/albedo/internal/stereo_terms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace luxfit {
namespace {

const Eigen::Vector3d kToCamera(0, 0, 1);

Eigen::Matrix<double, 3, 2> TangentsOf(const Eigen::Vector3d& direction) {
  Eigen::Matrix<double, 3, 2> tangents;
  tangents.col(0) = direction.unitOrthogonal();
  tangents.col(1) = direction.cross(tangents.col(0));
  return tangents;
}

}  // namespace

StereoPixel::StereoPixel(const StereoState& state, Eigen::Index pixel)
    : state_(state), albedo_(state.b.col(pixel).norm()), normal_(state.b.col(pixel) / albedo_) {}

StereoTerm StereoPixel::Term(Eigen::Index image, bool with_slopes) const {
  const Eigen::Vector3d light = state_.to_light.col(image);
  const Eigen::Vector3d sum = light + kToCamera;
  const double length = std::max(sum.norm(), 1e-9);
  const Eigen::Vector3d half = sum / length;
  CurveAngles angles;
  angles.mu = normal_.dot(light);
  angles.nu = std::max(0.0, normal_.z());
  angles.c = light.z();
  angles.eta = std::max(0.0, normal_.dot(half));
  const CurveValue curve = Evaluate(state_.curve, angles);
  const double strength = state_.strength[image];
  StereoTerm term;
  term.value = strength * albedo_ * curve.f + OffsetOf(state_.curve);
  if (!with_slopes) return term;
  // Derivative by the normal as if it were free in space. The length of b does not change the normal's.
  const Eigen::Vector3d d_normal = curve.d_mu * light + (angles.nu > 0 ? curve.d_nu : 0.0) * kToCamera +
                                   (angles.eta > 0 ? curve.d_eta : 0.0) * half;
  term.d_b = strength * (curve.f * normal_ + d_normal - d_normal.dot(normal_) * normal_);
  const Eigen::Vector3d d_half = (normal_ - normal_.dot(half) * half) / length;
  term.d_light =
      strength * albedo_ *
      (curve.d_mu * normal_ + curve.d_c * kToCamera + (angles.eta > 0 ? curve.d_eta : 0.0) * d_half);
  term.d_curve = strength * albedo_ * curve.d_parameters;
  if (state_.curve.kind == CurveKind::kOffset) term.d_curve[0] = 1;
  term.d_log_strength = strength * albedo_ * curve.f;
  return term;
}

SharedUnknowns::SharedUnknowns(const StereoProblem& problem, const StereoState& state) {
  const Eigen::Index images = problem.value.rows();
  curve_count_ = count_ = state.curve.parameters.size();
  direction_at_.assign(static_cast<size_t>(images), -1);
  tangents_.resize(static_cast<size_t>(images));
  std::vector<double> weight(static_cast<size_t>(count_), 0.0), deviation(static_cast<size_t>(count_), 0.0);
  for (Eigen::Index k = 0; k < images; ++k) {
    const double sigma_rad = problem.direction_sigma_rad[k];
    if (!(sigma_rad > 0)) continue;
    const size_t image = static_cast<size_t>(k);
    direction_at_[image] = count_;
    count_ += 2;
    tangents_[image] = TangentsOf(state.to_light.col(k));
    const double observations = static_cast<double>(problem.used.row(k).count());
    const Eigen::Vector2d back =
        tangents_[image].transpose() * (problem.to_light.col(k) - state.to_light.col(k));
    for (int axis = 0; axis < 2; ++axis) {
      weight.push_back(observations / (sigma_rad * sigma_rad));
      deviation.push_back(back[axis]);
    }
  }
  if (problem.strengths_free) {
    strength_at_ = count_;
    count_ += images;
    weight.resize(static_cast<size_t>(count_), 0.0);
    deviation.resize(static_cast<size_t>(count_), 0.0);
  }
  prior_weights_ = Eigen::Map<const Eigen::VectorXd>(weight.data(), count_);
  prior_deviation_ = Eigen::Map<const Eigen::VectorXd>(deviation.data(), count_);
}

std::vector<Eigen::VectorXd> SharedUnknowns::HeldDirections() const {
  if (strength_at_ < 0) return {};
  Eigen::VectorXd common = Eigen::VectorXd::Zero(count_);
  common.tail(count_ - strength_at_).setOnes();
  return {common.normalized()};
}

StereoState SharedUnknowns::Applied(StereoState state, const Eigen::VectorXd& step) const {
  // Longer steps would leave the range in which the linearization holds.
  constexpr double kLongest = 0.3;
  const Eigen::VectorXd dx = step.cwiseMax(-kLongest).cwiseMin(kLongest);
  state.curve.parameters += dx.head(curve_count_);
  state.curve = WithinBounds(state.curve);
  for (size_t k = 0; k < direction_at_.size(); ++k) {
    const Eigen::Index image = static_cast<Eigen::Index>(k);
    if (direction_at_[k] >= 0) {
      state.to_light.col(image) += tangents_[k] * dx.segment<2>(direction_at_[k]);
      state.to_light.col(image).normalize();
    }
    if (strength_at_ >= 0) state.strength[image] *= std::exp(dx[strength_at_ + image]);
  }
  return state;
}

}  // namespace luxfit
