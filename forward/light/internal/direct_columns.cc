#include "forward/light/internal/direct_columns.h"

#include <tbb/parallel_for.h>

#include <map>
#include <optional>
#include <utility>

#include "forward/direct/direct_light.h"
#include "forward/direct/internal/part_light.h"
#include "forward/direct/internal/shadowed_light.h"
#include "forward/direct/sensor.h"
#include "forward/luminaire/internal/expect_luminaire.h"

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
    case LuminaireQuantity::kGammaNode:
    case LuminaireQuantity::kSide:
    case LuminaireQuantity::kCell:
      break;  // light of a part, no derivative of the whole
  }
  return 0;
}

std::optional<PartKind> PartKindOf(LuminaireQuantity quantity) {
  if (quantity == LuminaireQuantity::kGammaNode) return PartKind::kGammaNode;
  if (quantity == LuminaireQuantity::kSide) return PartKind::kSide;
  if (quantity == LuminaireQuantity::kCell) return PartKind::kCell;
  return {};
}

// Describes one place. Its light is measured at `place`, its shadows at the probes of `element`, if it is
// one.
struct Spot {
  Sensor place;
  const Element* element = nullptr;
  bool triangle = false;
};

class ColumnFiller {
 public:
  ColumnFiller(const RayScene& rays, const std::vector<Luminaire>& luminaires,
               const DerivativeRequest& derivatives)
      : rays_(rays), luminaires_(luminaires), derivatives_(derivatives), is_derived_(luminaires.size()) {
    std::map<std::pair<int, LuminaireQuantity>, int> known;
    for (const LuminaireParameter& parameter : derivatives.parameters) {
      parts_of_parameter_.push_back(-1);
      const std::optional<PartKind> kind = PartKindOf(parameter.quantity);
      if (!kind) {
        is_derived_[static_cast<size_t>(parameter.luminaire)] = true;
        continue;
      }
      const auto [at, is_new] =
          known.try_emplace({parameter.luminaire, parameter.quantity}, static_cast<int>(parts_.size()));
      if (is_new)
        parts_.push_back(
            {parameter.luminaire, PartLight(luminaires[static_cast<size_t>(parameter.luminaire)], *kind)});
      parts_of_parameter_.back() = at->second;
    }
  }

  // Fills the columns of the luminaires, then those of the parameters.
  template <typename Row, typename Shares>
  void Fill(const Spot& spot, const Shares& visible, Row&& row) const {
    const bool is_cosine = spot.place.response.kind == ResponseKind::kCosine;
    if (derivatives_.parameters.empty() && is_cosine) {
      FillValues(spot.place, visible, row);
      return;
    }
    std::vector<DirectIlluminance> direct(luminaires_.size());
    std::vector<double> share(luminaires_.size());
    for (size_t k = 0; k < luminaires_.size(); ++k) {
      share[k] = static_cast<double>(visible[static_cast<Eigen::Index>(k)]);
      if (share[k] == 0) continue;
      if (is_cosine && !is_derived_[k]) {
        FillValue(spot.place, k, share[k], row);
        continue;
      }
      direct[k] = SensorIlluminancePerLumen(luminaires_[k], spot.place);
      row[static_cast<Eigen::Index>(k)] = static_cast<float>(share[k] * direct[k].lx_per_lm);
      if (!derivatives_.moving_shadows || derivatives_.parameters.empty() || share[k] == 1 || !is_cosine)
        continue;
      direct[k] = Shadowed(spot, luminaires_[k]);
      share[k] = 1;  // its derivatives are those of the visible part already
    }
    const std::vector<Eigen::VectorXd> light_of_parts = LightOfParts(spot.place, visible);
    for (size_t p = 0; p < derivatives_.parameters.size(); ++p) {
      const LuminaireParameter& parameter = derivatives_.parameters[p];
      const size_t k = static_cast<size_t>(parameter.luminaire);
      if (const int parts = parts_of_parameter_[p]; parts >= 0) {
        row[static_cast<Eigen::Index>(luminaires_.size() + p)] =
            static_cast<float>(light_of_parts[static_cast<size_t>(parts)][parameter.part]);
        continue;
      }
      row[static_cast<Eigen::Index>(luminaires_.size() + p)] =
          static_cast<float>(share[k] * DerivativeOf(direct[k], parameter.quantity));
    }
  }

 private:
  template <typename Row, typename Shares>
  void FillValues(const Sensor& place, const Shares& visible, Row&& row) const {
    for (size_t k = 0; k < luminaires_.size(); ++k) {
      const auto share = static_cast<double>(visible[static_cast<Eigen::Index>(k)]);
      if (share != 0) FillValue(place, k, share, row);
    }
  }

  template <typename Row>
  void FillValue(const Sensor& place, size_t k, double share, Row&& row) const {
    row[static_cast<Eigen::Index>(k)] =
        static_cast<float>(share * DirectLxPerLumen(luminaires_[k], place.position, place.normal));
  }

  struct Parts {
    int luminaire = 0;
    PartLight light;
  };

  // Returns the light of every part, times the share of the whole that the place sees.
  template <typename Shares>
  std::vector<Eigen::VectorXd> LightOfParts(const Sensor& place, const Shares& visible) const {
    std::vector<Eigen::VectorXd> light;
    light.reserve(parts_.size());
    for (const Parts& parts : parts_) {
      const double share = static_cast<double>(visible[parts.luminaire]);
      light.emplace_back(share == 0 ? Eigen::VectorXd::Zero(parts.light.size()).eval()
                                    : (share * parts.light.At(place)).eval());
    }
    return light;
  }

  DirectIlluminance Shadowed(const Spot& spot, const Luminaire& luminaire) const {
    if (spot.element == nullptr)
      return ShadowedIlluminancePerLumen(rays_, luminaire, spot.place.position, spot.place.normal);
    DirectIlluminance mean;
    const std::vector<Eigen::Vector3d> probes = ProbesOf(*spot.element, spot.triangle);
    for (const Eigen::Vector3d& p : probes) {
      mean.AddScaled(1.0 / static_cast<double>(probes.size()),
                     ShadowedIlluminancePerLumen(rays_, luminaire, p, spot.place.normal));
    }
    return mean;
  }

  const RayScene& rays_;
  const std::vector<Luminaire>& luminaires_;
  const DerivativeRequest& derivatives_;
  std::vector<bool> is_derived_;  // by luminaire: its derivatives are asked for
  std::vector<Parts> parts_;
  std::vector<int> parts_of_parameter_;  // index of the parts; -1: a derivative of the whole
};

Spot SpotOf(const Patches& patches, int element) {
  const Element& e = patches.elements[static_cast<size_t>(element)];
  return {{e.center, e.normal, {}}, &e, patches.IsTriangle(e.patch)};
}

}  // namespace

DirectColumns ComputeDirectColumns(const Room& room, const Receivers& receivers,
                                   const LuminaireVisibility& visibility,
                                   const std::vector<Luminaire>& luminaires,
                                   const DerivativeRequest& derivatives) {
  if (!derivatives.reflected && !derivatives.parameters.empty()) {
    DirectColumns values = ComputeDirectColumns(room, receivers, visibility, luminaires, {});
    values.receivers = ComputeReceiverColumns(room, receivers, visibility, luminaires, derivatives);
    return values;
  }
  ExpectValid(luminaires);
  const auto elements = static_cast<int>(room.patches.elements.size());
  const auto columns = static_cast<Eigen::Index>(luminaires.size() + derivatives.parameters.size());
  const ColumnFiller filler(room.rays, luminaires, derivatives);
  DirectColumns result{Eigen::MatrixXf::Zero(elements, columns),
                       Eigen::MatrixXf::Zero(receivers.count(), columns)};
  tbb::parallel_for(0, elements, [&](int e) {
    filler.Fill(SpotOf(room.patches, e), visibility.elements.row(e), result.elements.row(e));
  });
  const auto observed = static_cast<int>(receivers.elements.size());
  tbb::parallel_for(0, receivers.count(), [&](int r) {
    if (r < observed) {
      result.receivers.row(r) = result.elements.row(receivers.elements[static_cast<size_t>(r)]);
    } else {
      const Sensor& sensor = receivers.points[static_cast<size_t>(r)];
      filler.Fill({sensor}, visibility.receivers.row(r), result.receivers.row(r));
    }
  });
  return result;
}

Eigen::MatrixXf ComputeReceiverColumns(const Room& room, const Receivers& receivers,
                                       const LuminaireVisibility& visibility,
                                       const std::vector<Luminaire>& luminaires,
                                       const DerivativeRequest& derivatives) {
  ExpectValid(luminaires);
  const auto columns = static_cast<Eigen::Index>(luminaires.size() + derivatives.parameters.size());
  const ColumnFiller filler(room.rays, luminaires, derivatives);
  Eigen::MatrixXf result = Eigen::MatrixXf::Zero(receivers.count(), columns);
  const auto observed = static_cast<int>(receivers.elements.size());
  tbb::parallel_for(0, receivers.count(), [&](int r) {
    const Spot spot = r < observed ? SpotOf(room.patches, receivers.elements[static_cast<size_t>(r)])
                                   : Spot{receivers.points[static_cast<size_t>(r)]};
    filler.Fill(spot, visibility.receivers.row(r), result.row(r));
  });
  return result;
}

}  // namespace luxfit
