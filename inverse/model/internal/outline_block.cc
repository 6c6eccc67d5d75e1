#include "inverse/model/internal/outline_block.h"

#include <ceres/jet.h>

#include <stdexcept>

#include "inverse/model/internal/outline_distance.h"

namespace luxfit {
namespace {

// Places of the quantities that change an outline, in the derivative of a Jet.
constexpr int kQuantities = 8;
using Jet = ceres::Jet<double, kQuantities>;

int PlaceOf(LuminaireQuantity quantity) {
  switch (quantity) {
    case LuminaireQuantity::kPositionX:
      return 0;
    case LuminaireQuantity::kPositionY:
      return 1;
    case LuminaireQuantity::kPositionZ:
      return 2;
    case LuminaireQuantity::kSizeAlong:
      return 3;
    case LuminaireQuantity::kSizeAcross:
      return 4;
    case LuminaireQuantity::kTiltAlong:
      return 5;
    case LuminaireQuantity::kTiltAcross:
      return 6;
    case LuminaireQuantity::kHeading:
      return 7;
    case LuminaireQuantity::kExponent:
    case LuminaireQuantity::kGammaNode:
    case LuminaireQuantity::kCell:
      return -1;
  }
  return -1;
}

// Returns the outline with its derivatives; turns count from where the luminaire points.
Outline<Jet> WithDerivatives(const Luminaire& luminaire) {
  const LuminaireAxes axes = AxesOf(luminaire);
  const auto variable = [](double value, int place) { return Jet(value, place); };
  const Jet tilt_along = variable(0, 5), tilt_across = variable(0, 6), heading = variable(0, 7);
  using Vector = Eigen::Matrix<Jet, 3, 1>;
  const Vector aim = luminaire.aim.cast<Jet>(), along = axes.along.cast<Jet>(),
               across = axes.across.cast<Jet>();
  Outline<Jet> outline;
  for (int i = 0; i < 3; ++i) outline.position[i] = variable(luminaire.position[i], i);
  outline.aim = aim + along * tilt_along + across * tilt_across;
  outline.along = along - aim * tilt_along + across * heading;
  outline.across = across - aim * tilt_across - along * heading;
  const bool is_disc = luminaire.shape != LuminaireShape::kRectangle;
  outline.half_size[0] = 0.5 * variable(luminaire.size_m[0], 3);
  outline.half_size[1] = is_disc ? outline.half_size[0] : 0.5 * variable(luminaire.size_m[1], 4);
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
  if (parameter.kind != ParameterKind::kLuminaire || parameter.index != Of(row).luminaire) return 0;
  const int place = PlaceOf(parameter.quantity);
  if (place < 0) return 0;
  const Luminaire& luminaire = state.luminaires[static_cast<size_t>(parameter.index)];
  const OutlineRay& ray = RayOf(row);
  const Eigen::Matrix<Jet, 3, 1> direction = ray.direction.cast<Jet>();
  const Jet distance =
      OutlineDistanceRad(luminaire.shape, WithDerivatives(luminaire), Of(row).seen.eye, direction);
  return ray.px_per_rad * distance.v[place];
}

std::optional<std::pair<int, int>> OutlineBlock::ClusterOf(int row) const {
  return std::make_pair(Of(row).seen.view, 0);
}

}  // namespace luxfit
