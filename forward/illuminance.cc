#include "forward/illuminance.h"

#include <tbb/parallel_for.h>

#include "forward/dense_product.h"
#include "forward/direct_light.h"
#include "forward/sensor.h"

namespace luxfit {
namespace {

double DerivativeOf(const DirectIlluminance& direct, LuminaireQuantity quantity) {
  switch (quantity) {
    case LuminaireQuantity::kPositionX:
      return direct.d_position.x();
    case LuminaireQuantity::kPositionY:
      return direct.d_position.y();
    case LuminaireQuantity::kPositionZ:
      return direct.d_position.z();
    case LuminaireQuantity::kExponent:
      return direct.d_exponent;
    case LuminaireQuantity::kSizeAlong:
      return direct.d_size[0];
    case LuminaireQuantity::kSizeAcross:
      return direct.d_size[1];
    case LuminaireQuantity::kTiltAlong:
      return direct.d_tilt[0];
    case LuminaireQuantity::kTiltAcross:
      return direct.d_tilt[1];
    case LuminaireQuantity::kHeading:
      return direct.d_heading;
  }
  return 0;
}

// Direct light at one place: columns for the luminaires, then for the parameters.
template <typename Row, typename Shares>
void FillDirect(const Sensor& place, const std::vector<Luminaire>& luminaires,
                const std::vector<LuminaireParameter>& parameters, const Shares& visible, Row&& row) {
  std::vector<DirectIlluminance> direct(luminaires.size());
  for (size_t k = 0; k < luminaires.size(); ++k) {
    if (visible[static_cast<Eigen::Index>(k)] == 0) continue;
    direct[k] = SensorIlluminancePerLumen(luminaires[k], place);
    row[static_cast<Eigen::Index>(k)] =
        visible[static_cast<Eigen::Index>(k)] * static_cast<float>(direct[k].lx_per_lm);
  }
  for (size_t p = 0; p < parameters.size(); ++p) {
    const size_t k = static_cast<size_t>(parameters[p].luminaire);
    row[static_cast<Eigen::Index>(luminaires.size() + p)] =
        visible[static_cast<Eigen::Index>(k)] *
        static_cast<float>(DerivativeOf(direct[k], parameters[p].quantity));
  }
}

}  // namespace

Illuminance ComputeIlluminance(const Room& room, const Receivers& receivers,
                               const LuminaireVisibility& visibility,
                               const std::vector<Luminaire>& luminaires, const Eigen::VectorXd& albedo,
                               const DerivativeRequest& derivatives) {
  const Eigen::Index lamps = static_cast<Eigen::Index>(luminaires.size());
  const Eigen::Index parameters = static_cast<Eigen::Index>(derivatives.parameters.size());
  const Eigen::Index materials = static_cast<Eigen::Index>(derivatives.materials.size());
  const Eigen::Index elements = static_cast<Eigen::Index>(room.patches.elements.size());

  Eigen::MatrixXf at_elements = Eigen::MatrixXf::Zero(elements, lamps + parameters);
  Eigen::MatrixXf at_receivers = Eigen::MatrixXf::Zero(receivers.count(), lamps + parameters);
  tbb::parallel_for(Eigen::Index{0}, elements, [&](Eigen::Index e) {
    const Element& element = room.patches.elements[static_cast<size_t>(e)];
    FillDirect({element.center, element.normal, {}}, luminaires, derivatives.parameters,
               visibility.elements.row(e), at_elements.row(e));
  });
  const Eigen::Index observed = static_cast<Eigen::Index>(receivers.elements.size());
  tbb::parallel_for(Eigen::Index{0}, static_cast<Eigen::Index>(receivers.count()), [&](Eigen::Index r) {
    if (r < observed) {
      at_receivers.row(r) = at_elements.row(receivers.elements[static_cast<size_t>(r)]);
    } else {
      FillDirect(receivers.points[static_cast<size_t>(r)], luminaires, derivatives.parameters,
                 visibility.receivers.row(r), at_receivers.row(r));
    }
  });

  Illuminance result;
  result.direct = at_receivers.leftCols(lamps);
  result.d_albedo.setZero(receivers.count(), lamps * materials);
  if (elements > 0) {
    const Transport transport(room.transport, albedo);
    const Eigen::MatrixXf patch_direct = PatchMean(room.patches, at_elements);
    Eigen::MatrixXf exitance(patch_direct.rows(), lamps + parameters + lamps * materials);
    exitance.leftCols(lamps + parameters) = transport.Exitance(patch_direct);
    if (materials > 0) {
      const Eigen::MatrixXf patch_total =
          patch_direct.leftCols(lamps) + transport.Irradiance(exitance.leftCols(lamps));
      for (Eigen::Index m = 0; m < materials; ++m) {
        const Eigen::MatrixXf d =
            transport.ExitanceDerivative(derivatives.materials[static_cast<size_t>(m)], patch_total);
        for (Eigen::Index k = 0; k < lamps; ++k)
          exitance.col(lamps + parameters + k * materials + m) = d.col(k);
      }
    }
    const Eigen::MatrixXf indirect = Product(receivers.gather, exitance);
    at_receivers += indirect.leftCols(lamps + parameters);
    result.d_albedo = indirect.rightCols(lamps * materials);
  }
  result.total = at_receivers.leftCols(lamps);
  result.d_luminaire = at_receivers.rightCols(parameters);
  return result;
}

}  // namespace luxfit
