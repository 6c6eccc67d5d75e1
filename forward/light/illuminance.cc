#include "forward/light/illuminance.h"

#include <algorithm>
#include <utility>

#include "forward/factors/form_factors.h"
#include "forward/light/internal/direct_columns.h"
#include "forward/light/internal/gather.h"
#include "forward/radiosity/internal/sparse_transport.h"

namespace luxfit {
namespace {

// Counts the columns of light: luminaires, (sums of) their parameters, then reflectances, sum-major.
struct Columns {
  Eigen::Index lamps = 0, parameters = 0;
  const std::vector<int>& materials;
  Eigen::SparseMatrix<float> sum = {};  // lamps x sums

  Eigen::Index lit() const { return lamps + parameters; }
  Eigen::Index sums() const { return materials.empty() ? 0 : sum.cols(); }
  Eigen::Index albedo(Eigen::Index of_sum, size_t material) const {
    return lit() + of_sum * static_cast<Eigen::Index>(materials.size()) + static_cast<Eigen::Index>(material);
  }
};

Eigen::SparseMatrix<float> SumsOrEach(const Eigen::SparseMatrix<float>& sums, Eigen::Index terms) {
  if (sums.cols() > 0) return sums;
  Eigen::SparseMatrix<float> each(terms, terms);
  each.setIdentity();
  return each;
}

// Returns columns of luminaires, and sums of those of parameters.
Eigen::MatrixXf Summed(Eigen::MatrixXf columns, Eigen::Index lamps, const Eigen::SparseMatrix<float>& sum) {
  if (sum.cols() == 0) return columns;
  Eigen::MatrixXf summed(columns.rows(), lamps + sum.cols());
  summed.leftCols(lamps) = columns.leftCols(lamps);
  summed.rightCols(sum.cols()) = columns.rightCols(columns.cols() - lamps) * sum;
  return summed;
}

// Returns receivers x columns, by way of the indirect light of every element.
Eigen::MatrixXf GatherThroughElements(const Room& room, const Receivers& receivers,
                                      const Eigen::MatrixXf& at_elements, const Transport& transport,
                                      const Columns& columns, const Eigen::MatrixXf& exitance) {
  const Eigen::MatrixXf indirect = IndirectAtElements(room, exitance);
  Eigen::MatrixXf reflected = indirect;  // exitance of elements
  reflected.leftCols(columns.lit()) += at_elements;
  const Eigen::MatrixXf lit = columns.sums() > 0
                                  ? Eigen::MatrixXf(reflected.leftCols(columns.lamps) * columns.sum)
                                  : Eigen::MatrixXf();
  const Eigen::VectorXf element_albedo =
      ElementAlbedo(room.patches, transport.albedo(), transport.patch_factor());
  reflected.array().colwise() *= element_albedo.array();
  for (size_t m = 0; m < columns.materials.size(); ++m) {
    const Eigen::VectorXf of_material =
        ElementAlbedo(room.patches, Eigen::VectorXd::Unit(transport.albedo().size(), columns.materials[m]),
                      transport.patch_factor());
    for (Eigen::Index k = 0; k < columns.sums(); ++k)
      reflected.col(columns.albedo(k, m)) += of_material.cwiseProduct(lit.col(k));
  }
  return GatherAtReceivers(receivers, indirect, reflected);
}

// Returns the same from the products of PrepareGather:
//   sensor:  sum_m rho_m (G_m D + (G F)_m M),   by rho_m: G_m D + (G F)_m M and what M changes
Eigen::MatrixXf GatherPrepared(const Room& room, const Receivers& receivers,
                               const Eigen::MatrixXf& at_elements, const Eigen::VectorXd& albedo,
                               const Columns& columns, const Eigen::MatrixXf& exitance) {
  Eigen::MatrixXf gathered = Eigen::MatrixXf::Zero(receivers.count(), exitance.cols());
  const auto elements = static_cast<Eigen::Index>(receivers.elements.size());
  const auto sensors = static_cast<Eigen::Index>(receivers.sensors.size());
  if (elements > 0) gathered.topRows(elements) = Product(receivers.element_to_patch, exitance);
  if (sensors == 0) return gathered;
  for (size_t m = 0; m < receivers.sensor_to_patch.size(); ++m) {
    const auto material = static_cast<Eigen::Index>(m);
    const Eigen::VectorXf of_material =
        ElementAlbedo(room.patches, Eigen::VectorXd::Unit(albedo.size(), material));
    Eigen::MatrixXf reflected = receivers.sensor_to_patch[m] * exitance;
    reflected.leftCols(columns.lit()) +=
        receivers.sensor_to_element * (of_material.asDiagonal() * at_elements);
    gathered.bottomRows(sensors) += static_cast<float>(albedo[material]) * reflected;
    const auto asked = std::find(columns.materials.begin(), columns.materials.end(), static_cast<int>(m));
    if (asked == columns.materials.end()) continue;
    const auto column = static_cast<size_t>(asked - columns.materials.begin());
    const Eigen::MatrixXf lit = reflected.leftCols(columns.lamps) * columns.sum;
    for (Eigen::Index k = 0; k < columns.sums(); ++k)
      gathered.col(columns.albedo(k, column)).tail(sensors) += lit.col(k);
  }
  return gathered;
}

Eigen::MatrixXf Gather(const Room& room, const Receivers& receivers, const Eigen::MatrixXf& at_elements,
                       const Transport& transport, const Columns& layout, const Eigen::MatrixXf& exitance) {
  // The products are by material.
  if (IsPrepared(receivers) && transport.patch_factor().size() == 0)
    return GatherPrepared(room, receivers, at_elements, transport.albedo(), layout, exitance);
  return GatherThroughElements(room, receivers, at_elements, transport, layout, exitance);
}

}  // namespace

Illuminance ComputeIlluminance(const Room& room, const Receivers& receivers,
                               const LuminaireVisibility& visibility,
                               const std::vector<Luminaire>& luminaires, const Eigen::VectorXd& albedo,
                               const DerivativeRequest& derivatives) {
  return ComputeIlluminance(room, receivers, visibility, luminaires, Transport(room.transport, albedo),
                            derivatives);
}

Illuminance ComputeIlluminance(const Room& room, const Receivers& receivers,
                               const LuminaireVisibility& visibility,
                               const std::vector<Luminaire>& luminaires, const Transport& transport,
                               const DerivativeRequest& derivatives) {
  const Eigen::Index lamps = static_cast<Eigen::Index>(luminaires.size());
  const Eigen::Index materials = static_cast<Eigen::Index>(derivatives.materials.size());
  const Eigen::Index elements = static_cast<Eigen::Index>(room.patches.elements.size());

  DirectColumns columns = ComputeDirectColumns(room, receivers, visibility, luminaires, derivatives);
  const Eigen::MatrixXf at_elements =
      derivatives.reflected ? Summed(std::move(columns.elements), lamps, derivatives.parameter_sum)
                            : std::move(columns.elements);
  Eigen::MatrixXf at_receivers = Summed(std::move(columns.receivers), lamps, derivatives.parameter_sum);
  const Columns layout{lamps, at_elements.cols() - lamps, derivatives.materials,
                       SumsOrEach(derivatives.luminaire_sum, lamps)};
  const Eigen::Index of_albedo = layout.sums() * materials;

  Illuminance result;
  result.direct = at_receivers.leftCols(lamps);
  result.d_albedo.setZero(receivers.count(), of_albedo);
  if (elements > 0) {
    const Eigen::MatrixXf patch_direct = PatchMean(room.patches, at_elements);
    Eigen::MatrixXf exitance(patch_direct.rows(), layout.lit() + of_albedo);
    exitance.leftCols(layout.lit()) = transport.Exitance(patch_direct);
    if (materials > 0) {
      const Eigen::MatrixXf summed_direct = patch_direct.leftCols(lamps) * layout.sum;
      const Eigen::MatrixXf summed_exitance = exitance.leftCols(lamps) * layout.sum;
      exitance.rightCols(of_albedo) = transport.ExitanceDerivatives(
          derivatives.materials, summed_direct + transport.Irradiance(summed_exitance));
    }
    const Eigen::MatrixXf gathered = Gather(room, receivers, at_elements, transport, layout, exitance);
    at_receivers.leftCols(layout.lit()) += gathered.leftCols(layout.lit());
    result.d_albedo = gathered.rightCols(of_albedo);
  }
  result.total = at_receivers.leftCols(lamps);
  result.d_luminaire = at_receivers.rightCols(at_receivers.cols() - lamps);
  return result;
}

std::vector<Eigen::MatrixXf> ComputeTotals(const Room& room, const Receivers& receivers,
                                           const LuminaireVisibility& visibility,
                                           const std::vector<Luminaire>& luminaires,
                                           const std::vector<const Transport*>& transports) {
  const DirectColumns direct = ComputeDirectColumns(room, receivers, visibility, luminaires, {});
  std::vector<Eigen::MatrixXf> totals(transports.size(), direct.receivers);
  if (room.patches.elements.empty()) return totals;
  const Eigen::MatrixXf patch_direct = PatchMean(room.patches, direct.elements);
  const Columns layout{static_cast<Eigen::Index>(luminaires.size()), 0, {}};
  for (size_t i = 0; i < transports.size(); ++i)
    totals[i] += Gather(room, receivers, direct.elements, *transports[i], layout,
                        transports[i]->Exitance(patch_direct));
  return totals;
}

Illuminance ComputeDirectIlluminance(const Room& room, const Receivers& receivers,
                                     const LuminaireVisibility& visibility,
                                     const std::vector<Luminaire>& luminaires,
                                     const DerivativeRequest& derivatives) {
  const auto lamps = static_cast<Eigen::Index>(luminaires.size());
  const Eigen::MatrixXf columns =
      Summed(ComputeReceiverColumns(room, receivers, visibility, luminaires, derivatives), lamps,
             derivatives.parameter_sum);
  Illuminance result;
  result.direct = columns.leftCols(lamps);
  result.total = result.direct;
  result.d_luminaire = columns.rightCols(columns.cols() - lamps);
  return result;
}

Eigen::MatrixXf IndirectAtElements(const Room& room, const Eigen::MatrixXf& patch_exitance) {
  if (!room.sparse) return Product(room.form_factors.element_to_patch, patch_exitance);
  const Eigen::VectorXf root_area = room.transport.patch_area_m2.cwiseSqrt();
  const Eigen::MatrixXf at_patches =
      root_area.cwiseInverse().asDiagonal() * room.sparse->Times(root_area.asDiagonal() * patch_exitance);
  Eigen::MatrixXf at_elements(static_cast<Eigen::Index>(room.patches.elements.size()), patch_exitance.cols());
  for (Eigen::Index e = 0; e < at_elements.rows(); ++e)
    at_elements.row(e) = at_patches.row(room.patches.elements[static_cast<size_t>(e)].patch);
  return at_elements;
}

}  // namespace luxfit
