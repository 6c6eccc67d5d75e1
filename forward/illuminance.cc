#include "forward/illuminance.h"

#include "forward/internal/direct_columns.h"
#include "forward/internal/gather.h"

namespace luxfit {

Illuminance ComputeIlluminance(const Room& room, const Receivers& receivers,
                               const LuminaireVisibility& visibility,
                               const std::vector<Luminaire>& luminaires, const Eigen::VectorXd& albedo,
                               const DerivativeRequest& derivatives) {
  const Eigen::Index lamps = static_cast<Eigen::Index>(luminaires.size());
  const Eigen::Index parameters = static_cast<Eigen::Index>(derivatives.parameters.size());
  const Eigen::Index materials = static_cast<Eigen::Index>(derivatives.materials.size());
  const Eigen::Index elements = static_cast<Eigen::Index>(room.patches.elements.size());

  DirectColumns columns = ComputeDirectColumns(room, receivers, visibility, luminaires, derivatives);
  const Eigen::MatrixXf& at_elements = columns.elements;
  Eigen::MatrixXf& at_receivers = columns.receivers;

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
    const Eigen::MatrixXf indirect = IndirectAtElements(room, exitance);
    Eigen::MatrixXf reflected = indirect;  // exitance of elements
    reflected.leftCols(lamps + parameters) += at_elements;
    const Eigen::MatrixXf lit = reflected.leftCols(lamps);
    const Eigen::VectorXf element_albedo = ElementAlbedo(room.patches, albedo);
    reflected.array().colwise() *= element_albedo.array();
    for (Eigen::Index m = 0; m < materials; ++m) {
      const Eigen::VectorXf of_material = ElementAlbedo(
          room.patches, Eigen::VectorXd::Unit(albedo.size(), derivatives.materials[static_cast<size_t>(m)]));
      for (Eigen::Index k = 0; k < lamps; ++k)
        reflected.col(lamps + parameters + k * materials + m) += of_material.cwiseProduct(lit.col(k));
    }
    const Eigen::MatrixXf gathered = GatherAtReceivers(receivers, indirect, reflected);
    at_receivers += gathered.leftCols(lamps + parameters);
    result.d_albedo = gathered.rightCols(lamps * materials);
  }
  result.total = at_receivers.leftCols(lamps);
  result.d_luminaire = at_receivers.rightCols(parameters);
  return result;
}

}  // namespace luxfit
