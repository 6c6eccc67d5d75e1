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
  directions_.resize(static_cast<size_t>(images));
  tangents_.resize(static_cast<size_t>(images));
  std::vector<double> weight(static_cast<size_t>(count_), 0.0), prior(static_cast<size_t>(count_), 0.0);
  for (Eigen::Index k = 0; k < images; ++k) {
    const double sigma_rad = problem.direction_sigma_rad[k];
    if (!(sigma_rad > 0)) continue;
    const size_t image = static_cast<size_t>(k);
    direction_at_[image] = count_;
    count_ += 2;
    directions_[image] = state.to_light.col(k);
    tangents_[image] = TangentsOf(directions_[image]);
    const double observations = static_cast<double>(problem.used.row(k).count());
    const Eigen::Vector2d back =
        tangents_[image].transpose() * (problem.to_light.col(k) - directions_[image]);
    for (int axis = 0; axis < 2; ++axis) {
      weight.push_back(observations / (sigma_rad * sigma_rad));
      prior.push_back(back[axis]);
    }
  }
  if (problem.strengths_free) {
    strength_at_ = count_;
    count_ += images;
    weight.resize(static_cast<size_t>(count_), 0.0);
    prior.resize(static_cast<size_t>(count_), 0.0);
  }
  held_.setZero(count_);
  if (problem.strengths_free) held_.tail(images).setConstant(1 / std::sqrt(static_cast<double>(images)));
  // No data pull there, so a small weight holds it. A large one would damp the strengths' own steps.
  held_weight_ = static_cast<double>(problem.used.count());
  prior_weight_ = Eigen::Map<const Eigen::VectorXd>(weight.data(), count_);
  prior_x_ = Eigen::Map<const Eigen::VectorXd>(prior.data(), count_);
  SetBounds(state.curve);
}

void SharedUnknowns::SetBounds(const ReflectanceCurve& curve) {
  // Longer steps would leave the range in which the linearization holds.
  constexpr double kLongest = 0.3;
  // Steps end a little beyond the curve's bound, so that WithinBounds puts the parameter exactly on it.
  constexpr double kBeyond = 1e-9;
  upper_ = Eigen::VectorXd::Constant(count_, kLongest);
  lower_ = -upper_;
  for (const double sign : {-1.0, 1.0}) {
    ReflectanceCurve end = curve;
    end.parameters.array() += sign * kLongest;
    Eigen::VectorXd& bound = sign < 0 ? lower_ : upper_;
    bound.head(curve_count_) = (WithinBounds(end).parameters - curve.parameters).array() + sign * kBeyond;
  }
}

StereoState SharedUnknowns::Applied(StereoState state, const Eigen::VectorXd& x) const {
  state.curve.parameters += x.head(curve_count_);
  state.curve = WithinBounds(state.curve);
  for (size_t k = 0; k < direction_at_.size(); ++k) {
    const Eigen::Index image = static_cast<Eigen::Index>(k);
    if (direction_at_[k] >= 0) {
      state.to_light.col(image) += tangents_[k] * x.segment<2>(direction_at_[k]);
      state.to_light.col(image).normalize();
    }
    if (strength_at_ >= 0) state.strength[image] *= std::exp(x[strength_at_ + image]);
  }
  return state;
}

SharedUnknowns SharedUnknowns::At(const Eigen::VectorXd& x) const {
  SharedUnknowns here = *this;
  for (size_t k = 0; k < direction_at_.size(); ++k) {
    if (direction_at_[k] < 0) continue;
    const Eigen::Vector3d moved = directions_[k] + tangents_[k] * x.segment<2>(direction_at_[k]);
    const Eigen::Vector3d direction = moved.normalized();
    here.tangents_[k] -= direction * (direction.transpose() * tangents_[k]);
    here.tangents_[k] /= moved.norm();
  }
  return here;
}

void SharedUnknowns::AddPriors(const Eigen::VectorXd& x, NormalEquations& equations) const {
  const Eigen::VectorXd off = x - prior_x_;
  equations.matrix.diagonal() += prior_weight_;
  equations.gradient += prior_weight_.cwiseProduct(off);
  equations.squares += prior_weight_.dot(off.cwiseAbs2());
  const double along = held_.dot(x);
  equations.matrix += held_weight_ * held_ * held_.transpose();
  equations.gradient += held_weight_ * along * held_;
  equations.squares += held_weight_ * along * along;
}

}  // namespace luxfit
