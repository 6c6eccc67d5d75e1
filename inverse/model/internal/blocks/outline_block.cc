#include "inverse/model/internal/blocks/outline_block.h"

#include <ceres/jet.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <stdexcept>

#include "inverse/model/internal/blocks/outline_distance.h"

namespace luxfit {
namespace {

// The quantities that change an outline; exponents, tables and cells do not.
constexpr std::array<LuminaireQuantity, 8> kOutlineQuantities{
    LuminaireQuantity::kPositionX,  LuminaireQuantity::kPositionY,  LuminaireQuantity::kPositionZ,
    LuminaireQuantity::kSizeAlong,  LuminaireQuantity::kSizeAcross, LuminaireQuantity::kTiltAlong,
    LuminaireQuantity::kTiltAcross, LuminaireQuantity::kHeading};
using Jet = ceres::Jet<double, kOutlineQuantities.size()>;

// Returns where the quantity stands among those; their number: it changes no outline.
int PlaceOf(LuminaireQuantity quantity) {
  const auto* const found = std::find(kOutlineQuantities.begin(), kOutlineQuantities.end(), quantity);
  return static_cast<int>(found - kOutlineQuantities.begin());
}

Jet Variable(double value, LuminaireQuantity quantity) { return Jet(value, PlaceOf(quantity)); }

// Returns the outline with its derivatives; turns count from where the luminaire points.
Outline<Jet> WithDerivatives(const Luminaire& luminaire) {
  const LuminaireAxes axes = AxesOf(luminaire);
  const Jet tilt_along = Variable(0, LuminaireQuantity::kTiltAlong),
            tilt_across = Variable(0, LuminaireQuantity::kTiltAcross),
            heading = Variable(0, LuminaireQuantity::kHeading);
  using Vector = Eigen::Matrix<Jet, 3, 1>;
  const Vector aim = luminaire.aim.cast<Jet>(), along = axes.along.cast<Jet>(),
               across = axes.across.cast<Jet>();
  Outline<Jet> outline;
  for (int i = 0; i < 3; ++i)
    outline.position[i] = Variable(luminaire.position[i], static_cast<LuminaireQuantity>(i));
  outline.aim = aim + along * tilt_along + across * tilt_across;
  outline.along = along - aim * tilt_along + across * heading;
  outline.across = across - aim * tilt_across - along * heading;
  const bool is_round = luminaire.shape != LuminaireShape::kRectangle;
  outline.half_size[0] = 0.5 * Variable(luminaire.size_m[0], LuminaireQuantity::kSizeAlong);
  outline.half_size[1] =
      is_round ? outline.half_size[0] : 0.5 * Variable(luminaire.size_m[1], LuminaireQuantity::kSizeAcross);
  return outline;
}

Outline<double> OutlineOf(const Luminaire& luminaire) {
  const LuminaireAxes axes = AxesOf(luminaire);
  return {luminaire.position, luminaire.aim, axes.along, axes.across, 0.5 * luminaire.size_m};
}

constexpr int kPose = 6;  // quantities of a view's pose

// Returns the root of the views' covariances without what they share.
Eigen::MatrixXd ViewByView(const Eigen::MatrixXd& joint) {
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(joint.rows(), joint.rows());
  for (Eigen::Index v = 0; v + kPose <= joint.rows(); v += kPose) {
    const auto own = joint.middleRows(v, kPose);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(own * own.transpose());
    root.block(v, v, kPose, kPose) =
        eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  }
  return root;
}

}  // namespace

OutlineBlock::OutlineBlock(const LightData& data) : data_(data) {
  for (size_t o = 0; o < data.outlines.size(); ++o) {
    const LuminaireOutline& outline = data.outlines[o];
    if (outline.luminaire < 0 || data.dimming.empty() || outline.luminaire >= data.dimming.front().size())
      throw std::invalid_argument("LightModel: expected outlines of luminaires that the states have");
    for (size_t r = 0; r < outline.seen.rays.size(); ++r)
      rays_.emplace_back(static_cast<int>(o), static_cast<int>(r));
  }
}

RowResponse OutlineBlock::ResponseOf(const LightState& state, int row) const {
  const Luminaire& luminaire = state.luminaires[static_cast<size_t>(Of(row).luminaire)];
  const OutlineRay& ray = RayOf(row);
  return {0, ray.px_per_rad *
                 OutlineDistanceRad(luminaire.shape, OutlineOf(luminaire), Of(row).seen.eye, ray.direction)};
}

void OutlineBlock::AddOwnDerivatives(const LightState& state, const std::vector<Parameter>& parameters,
                                     double /*illuminance_lx*/, int row,
                                     Eigen::Ref<Eigen::RowVectorXd> derivatives) const {
  const int of = Of(row).luminaire;
  std::optional<Jet> distance;
  for (size_t p = 0; p < parameters.size(); ++p) {
    const Parameter& parameter = parameters[p];
    if (parameter.kind != ParameterKind::kLuminaire || !parameter.Concerns(of)) continue;
    const int place = PlaceOf(parameter.quantity);
    if (place == static_cast<int>(kOutlineQuantities.size())) continue;
    if (!distance) {
      const Luminaire& luminaire = state.luminaires[static_cast<size_t>(of)];
      distance = OutlineDistanceRad(luminaire.shape, WithDerivatives(luminaire), Of(row).seen.eye,
                                    Eigen::Matrix<Jet, 3, 1>(RayOf(row).direction.cast<Jet>()));
    }
    derivatives[static_cast<Eigen::Index>(p)] += RayOf(row).px_per_rad * distance->v[place];
  }
}

Eigen::MatrixXd OutlineBlock::PoseDerivativeOf(const LightState& state) const {
  using PoseJet = ceres::Jet<double, kPose>;
  using Vector = Eigen::Matrix<PoseJet, 3, 1>;
  Vector turn, shift;
  for (int i = 0; i < 3; ++i) turn[i] = PoseJet(0, i), shift[i] = PoseJet(0, 3 + i);
  Eigen::MatrixXd derivative(row_count(), kPose);
  for (int row = 0; row < row_count(); ++row) {
    const Luminaire& luminaire = state.luminaires[static_cast<size_t>(Of(row).luminaire)];
    const Outline<double> at = OutlineOf(luminaire);
    // The distance depends on the luminaire as seen from the eye.
    const Outline<PoseJet> outline{at.position.cast<PoseJet>() - shift, at.aim.cast<PoseJet>(),
                                   at.along.cast<PoseJet>(), at.across.cast<PoseJet>(),
                                   at.half_size.cast<PoseJet>()};
    const OutlineRay& ray = RayOf(row);
    const Vector direction = ray.direction.cast<PoseJet>();
    const PoseJet distance = OutlineDistanceRad(luminaire.shape, outline, Of(row).seen.eye,
                                                Vector(direction + turn.cross(direction)));
    derivative.row(row) = ray.px_per_rad * distance.v.transpose();
  }
  return derivative;
}

Eigen::MatrixXd OutlineBlock::RootOfViews(ViewErrors views) const {
  std::map<int, int> camera_of;  // by view
  int view_count = static_cast<int>(data_.pose_root.rows()) / kPose, camera_count = 0;
  for (const LuminaireOutline& outline : data_.outlines) {
    camera_of[outline.seen.view] = outline.seen.camera;
    view_count = std::max(view_count, outline.seen.view + 1);
    camera_count = std::max(camera_count, outline.seen.camera + 1);
  }
  const bool is_joint = views == ViewErrors::kJoint;
  const Eigen::MatrixXd pose = is_joint ? data_.pose_root : ViewByView(data_.pose_root);
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(Eigen::Index{view_count} * (kPose + 1),
                                               pose.cols() + (is_joint ? camera_count : view_count));
  for (int v = 0; v < view_count; ++v) {
    const Eigen::Index first = Eigen::Index{v} * (kPose + 1), first_pose = Eigen::Index{v} * kPose;
    if (first_pose + kPose <= pose.rows())
      root.block(first, 0, kPose, pose.cols()) = pose.middleRows(first_pose, kPose);
    const auto camera = camera_of.find(v);
    if (camera != camera_of.end())
      root(first + kPose, pose.cols() + (is_joint ? camera->second : v)) = kOutlineGrowthPx;
  }
  return root;
}

RowErrors OutlineBlock::SharedErrorsOf(const LightState& state, ViewErrors views) const {
  if (rays_.empty() || views == ViewErrors::kHeld) return {};
  RowErrors errors;
  errors.effect.resize(row_count(), kPose + 1);
  errors.effect.leftCols(kPose) = PoseDerivativeOf(state);
  errors.effect.rightCols(1).setOnes();  // a grown outline lies outside the model's
  errors.owner.reserve(rays_.size());
  for (int row = 0; row < row_count(); ++row) errors.owner.push_back(Of(row).seen.view);
  errors.root = RootOfViews(views);
  return errors;
}

std::optional<std::pair<int, int>> OutlineBlock::ClusterOf(int row) const {
  return std::make_pair(Of(row).seen.view, 0);
}

}  // namespace luxfit
