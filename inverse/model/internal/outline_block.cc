#include "inverse/model/internal/outline_block.h"

#include <ceres/jet.h>

#include <stdexcept>

#include "inverse/model/internal/outline_distance.h"

namespace luxfit {
namespace {

// The derivative by each quantity; exponents, tables and cells do not change an outline.
constexpr int kOutlineQuantities = static_cast<int>(LuminaireQuantity::kSide) + 1;
using Jet = ceres::Jet<double, kOutlineQuantities>;

Jet Variable(double value, LuminaireQuantity quantity) { return Jet(value, static_cast<int>(quantity)); }

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

double OutlineBlock::OwnDerivative(const LightState& state, const Parameter& parameter,
                                   double /*illuminance_lx*/, int row) const {
  if (parameter.kind != ParameterKind::kLuminaire || !parameter.Concerns(Of(row).luminaire)) return 0;
  const Luminaire& luminaire = state.luminaires[static_cast<size_t>(Of(row).luminaire)];
  const OutlineRay& ray = RayOf(row);
  const Eigen::Matrix<Jet, 3, 1> direction = ray.direction.cast<Jet>();
  const Jet distance =
      OutlineDistanceRad(luminaire.shape, WithDerivatives(luminaire), Of(row).seen.eye, direction);
  return ray.px_per_rad * distance.v[static_cast<int>(parameter.quantity)];
}

Eigen::MatrixXd OutlineBlock::PoseDerivativeOf(const LightState& state) const {
  using PoseJet = ceres::Jet<double, 6>;
  using Vector = Eigen::Matrix<PoseJet, 3, 1>;
  Vector turn, shift;
  for (int i = 0; i < 3; ++i) turn[i] = PoseJet(0, i), shift[i] = PoseJet(0, 3 + i);
  Eigen::MatrixXd derivative(row_count(), 6);
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

std::optional<std::pair<int, int>> OutlineBlock::ClusterOf(int row) const {
  return std::make_pair(Of(row).seen.view, 0);
}

}  // namespace luxfit
