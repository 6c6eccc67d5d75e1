// Predicts what was observed, with its Jacobian: the model that the fit inverts.
//
//   value_i = gain_i(theta) E_i(theta) + offset_i(theta),   E_i = h_i sum_k d_sk Phi_k E_ik(theta)
//
// Row i of a block of rows (inverse/model/internal/blocks/row_block.h) receives the illuminance E_i in state s.
// d: dimming, Phi: flux, E_ik: illuminance per lumen (forward/light/illuminance.h). The block states gain
// and offset. The gain of a photo's element is c rho / pi; that of a reading belongs to its meter and
// sensor. h = (1 - a + rho_body b) k, all frozen with the visibility. 1 - a + rho_body b is what the
// luminaires' bodies leave of the light (forward/light/covered_surfaces.h). k is the luminance of light
// exchanged in three channels between coloured surfaces, over that of light between grey ones:
//   k = sum_c v_c E_c / E        v: the channel's weight in the row, E_c: illuminance by rho_c = tint_c rho
// E_c is that of patches whose reflectance departs from their material's where the caller names them; k then exists
// for grey surfaces, too. In rooms that have clusters, E is that of light exchanged between those and E_c that between
// patches: k is then what clusters miss, too (defect correction).
// Photos hardly tell rho_body from the fluxes: it is held at kBodyAlbedo, and its sigma is a part of every
// covariance.
//
// Rows come block by block, in the order of RowBlocksOf. The Jacobian is rows x parameters and exact for
// frozen visibility, but for sizes that outlines tell: rows of light have no derivative by them (derivative_columns.h). Where the indirect light was measured (LightData::indirect_is_held), E is the direct
// illuminance alone and the offset holds the rest.
//
// Throws std::invalid_argument for indices out of range, and for readings beside measured indirect light.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_LIGHT_MODEL_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_LIGHT_MODEL_H_

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "forward/light/covered_surfaces.h"
#include "forward/light/illuminance.h"
#include "forward/light/room.h"
#include "inverse/model/internal/blocks/row_block.h"
#include "inverse/model/internal/channel_transports.h"
#include "inverse/model/internal/dimming_groups.h"
#include "inverse/model/light_state.h"

namespace luxfit {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Prediction {
  Eigen::VectorXd value;
  Eigen::VectorXd direct;   // the part of `value` that is direct light
  Eigen::VectorXd d_body;   // derivative by the reflectance of the bodies; empty: they hide nothing
  RowMajorMatrix jacobian;  // empty if not asked for
};

// How far a luminaire moves before what it lights is traced anew, in m. A shadow's edge moves about as far. Rows at
// an edge are left out, and patches, which are far larger, take only their mean from it.
constexpr double kStillM = 0.01;

class LightModel {
 public:
  // Keeps references: `room` and `data` must outlive it. Not to be shared by threads.
  LightModel(const Room& room, const LightData& data);

  // Computes the visible shares that Predict uses, and what bodies hide, for the luminaires where `state` has
  // them. `order` is that of ComputeVisibility.
  void FreezeVisibility(const LightState& state, int order = 3);
  // Does the same for those luminaires of which a point has moved by more than `still_m` since; what bodies and colours
  // do to reflected light follows at the same distance. Returns whether anything changed.
  bool RefreezeVisibility(const LightState& state, int order = 3, double still_m = kStillM);
  // Takes visible shares and channels over from a model of the same room: RefreezeVisibility then counts from there. Where
  // the indirect light is held, the other's elements have to be all, or the same.
  void TakeOver(const FrozenLight& frozen);
  FrozenLight frozen() const;
  // Freezes anew what bodies and colours do to reflected light, with the visibility as it is.
  void FreezeReflected(const LightState& state);
  // Sets what the next of these two counts with: the reflectance of each patch over that of its material.
  // Empty: all are like their material.
  void SetPatchFactor(Eigen::VectorXd factor) { patch_factor_ = std::move(factor); }
  // Says whether derivatives by luminaires' parameters contain reflected light (DerivativeRequest::reflected).
  void ReflectDerivatives(bool reflects) { reflects_derivatives_ = reflects; }
  // Marks rows that a shadow edge crosses, in the blocks that it spoils. There, a luminaire dimmed to more
  // than `min_dimming` is seen in part, or one that is a point stands at the receiver's horizon (point_horizon.h).
  std::vector<bool> InPenumbra(double min_dimming = 0.02) const;
  Prediction Predict(const LightState& state, const std::vector<Parameter>& parameters,
                     bool with_jacobian) const;

  // Returns what each row receives of the light that each surface reflects, by way of all reflections: rows x
  // surfaces, in the rows' units. Bodies and colours do not count. Not for sparse rooms.
  RowMajorMatrix LightReflectedBy(const LightState& state, const std::vector<CoveredSurface>& surfaces) const;

  // The places of all rows; a place of several rows is there once. -1: the row receives no light.
  const Receivers& receivers() const { return receivers_; }
  int ReceiverOf(int row) const { return rows_[static_cast<size_t>(row)].receiver; }
  int row_count() const { return static_cast<int>(rows_.size()); }
  const std::vector<std::unique_ptr<RowBlock>>& blocks() const { return blocks_; }
  // The block of a row, and the row's place in it.
  const RowBlock& BlockOf(int row) const {
    return *blocks_[static_cast<size_t>(rows_[static_cast<size_t>(row)].block)];
  }
  int block_index(int row) const { return rows_[static_cast<size_t>(row)].block; }
  int PlaceInBlock(int row) const { return rows_[static_cast<size_t>(row)].place; }

 private:
  struct Row {
    int block = 0, place = 0;
    int receiver = -1, state = 0;  // -1: the row receives no light
  };
  // Computes what the bodies of `state` hide of each row's light. `total`: without them, per lumen.
  void FreezeBodies(const LightState& state, const Transport& transport, const Eigen::MatrixXf& total);
  // Returns whether luminaires or reflectances have changed so much that reflected light is due anew.
  bool IsReflectedStale(const LightState& state, double still_m) const;
  // Computes what coloured and textured surfaces, and patches instead of clusters, add to each row's light. `grey`: of
  // plain grey surfaces; `totals`: of each channel, or of grey.
  void FreezeColour(const LightState& state, const Eigen::MatrixXf& grey,
                    const std::vector<Eigen::MatrixXf>& totals);
  // Returns the transport for the reflectances, factored once for those of the last call.
  const Transport& TransportFor(const Eigen::VectorXd& albedo) const;
  // Returns by parameter whether it is a size that rows of outlines depend on.
  std::vector<bool> SizesThatOutlinesTell(const LightState& state,
                                          const std::vector<Parameter>& parameters) const;
  // Returns illuminance per lumen at the receivers.
  Illuminance Light(const LightState& state, const DerivativeRequest& request) const;

  const Room& room_;
  const Room& exchange_;  // whose patches exchange light: room_, or its clusters
  const LightData& data_;
  std::vector<std::unique_ptr<RowBlock>> blocks_;
  std::vector<Row> rows_;
  DimmingGroups groups_;
  Receivers receivers_;
  std::optional<Receivers> of_patches_;  // the same where `exchange_` has clusters, to gather from patches
  LuminaireVisibility visibility_;
  std::vector<Luminaire> frozen_;  // those of `visibility_`
  int frozen_order_ = 0;
  struct Reflectors {
    std::vector<Luminaire> luminaires;
    Eigen::VectorXd albedo;
  };
  std::optional<Reflectors> reflected_at_;  // of `hidden_`, `reflected_` and `colour_`
  Eigen::VectorXd hidden_, reflected_;      // a and b; empty: no body hides anything
  Eigen::VectorXd colour_;                  // k; empty: the surfaces are grey
  std::shared_ptr<const ChannelTransports> channels_;
  bool reflects_derivatives_ = true;
  Eigen::VectorXd patch_factor_;
  // For the reflectances of the last call: a fit that holds them mostly needs no second factorisation.
  mutable std::optional<Transport> transport_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_LIGHT_MODEL_H_
