#include "forward/light/internal/adjoint.h"

#include <stdexcept>

#include "forward/light/internal/direct_columns.h"
#include "forward/light/internal/gather.h"

namespace luxfit {
namespace {

// Holds what a lux of direct light at each patch adds to the sum, and what a lm/m2 emitted there does.
struct Importance {
  Eigen::VectorXf direct;    // b = rho a
  Eigen::VectorXf exitance;  // a
};

Importance ComputeImportance(const Room& room, const Transport& transport, const Eigen::VectorXf& gathered) {
  // F^T x = A F (x / A), by reciprocity: the forward solver serves the adjoint too.
  const auto area = room.transport.patch_area_m2.array();
  Importance importance;
  importance.direct = area * transport.Exitance((gathered.array() / area).matrix()).col(0).array();
  importance.exitance =
      gathered.array() +
      area * transport.Irradiance((importance.direct.array() / area).matrix()).col(0).array();
  return importance;
}

// Holds what a lux of indirect light at each element adds to the sum, and what a lm/m2 emitted there does.
struct ElementImportance {
  Eigen::VectorXf illuminance, exitance;
};

ElementImportance ImportanceOfElements(const Room& room, const Receivers& receivers,
                                       const Eigen::VectorXd& albedo, const Eigen::VectorXd& weights) {
  const Eigen::Index observed = static_cast<Eigen::Index>(receivers.elements.size());
  ElementImportance importance;
  importance.exitance =
      receivers.sensor_to_element.transpose() * weights.tail(weights.size() - observed).cast<float>();
  importance.illuminance = importance.exitance.cwiseProduct(ElementAlbedo(room.patches, albedo));
  for (Eigen::Index r = 0; r < observed; ++r)
    importance.illuminance[receivers.elements[static_cast<size_t>(r)]] += static_cast<float>(weights[r]);
  return importance;
}

}  // namespace

AdjointDerivatives ComputeAdjoint(const Room& room, const Receivers& receivers,
                                  const LuminaireVisibility& visibility,
                                  const std::vector<Luminaire>& luminaires, const Eigen::VectorXd& albedo,
                                  const Eigen::VectorXd& weights, const DerivativeRequest& derivatives) {
  if (weights.size() != receivers.count())
    throw std::invalid_argument("ComputeAdjoint: expected one weight for every receiver");
  const Eigen::Index lamps = static_cast<Eigen::Index>(luminaires.size());
  const Eigen::Index patches = static_cast<Eigen::Index>(room.patches.patches.size());
  Eigen::VectorXd flux(lamps);
  for (Eigen::Index k = 0; k < lamps; ++k) flux[k] = luminaires[static_cast<size_t>(k)].flux_lm;
  const DirectColumns direct = ComputeDirectColumns(room, receivers, visibility, luminaires, derivatives);
  // J per lm, or per unit of each column of direct light.
  Eigen::VectorXd per_column = direct.receivers.cast<double>().transpose() * weights;
  AdjointDerivatives result;
  result.d_patch_albedo.setZero(patches);
  result.d_albedo.setZero(albedo.size());
  if (patches > 0) {
    const Transport transport(room.transport, albedo);
    const ElementImportance at = ImportanceOfElements(room, receivers, albedo, weights);
    const Importance importance =
        ComputeImportance(room, transport, room.form_factors.element_to_patch.transpose() * at.illuminance);
    // The columns already hold the direct light that receivers see.
    const Eigen::MatrixXf at_patches = PatchMean(room.patches, direct.elements);
    per_column +=
        (at_patches.transpose() * importance.direct +
         direct.elements.transpose() * at.exitance.cwiseProduct(ElementAlbedo(room.patches, albedo)))
            .cast<double>();
    const Eigen::VectorXf element_lit = direct.elements.leftCols(lamps) * flux.cast<float>();
    const Eigen::VectorXf lit = at_patches.leftCols(lamps) * flux.cast<float>();
    const Eigen::VectorXf exitance = transport.Exitance(lit).col(0);
    const Eigen::VectorXf total = lit + transport.Irradiance(exitance).col(0);
    result.d_patch_albedo = importance.exitance.cwiseProduct(total).cast<double>();
    const Eigen::VectorXf element_total = element_lit + IndirectAtElements(room, exitance).col(0);
    for (Eigen::Index e = 0; e < element_total.size(); ++e) {
      result.d_patch_albedo[room.patches.elements[static_cast<size_t>(e)].patch] +=
          static_cast<double>(at.exitance[e] * element_total[e]);
    }
    for (Eigen::Index i = 0; i < patches; ++i)
      result.d_albedo[room.transport.patch_material[static_cast<size_t>(i)]] += result.d_patch_albedo[i];
  }
  result.d_flux = per_column.head(lamps);
  result.sum_lx = result.d_flux.dot(flux);
  result.d_parameters = per_column.tail(static_cast<Eigen::Index>(derivatives.parameters.size()));
  for (size_t p = 0; p < derivatives.parameters.size(); ++p)
    result.d_parameters[static_cast<Eigen::Index>(p)] *= flux[derivatives.parameters[p].luminaire];
  return result;
}

}  // namespace luxfit
