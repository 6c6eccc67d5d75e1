// Describes one kind of observation to the fit: a block of rows of the least-squares problem.
//
//   value_i = gain_i E_i + offset_i,   d value_i / d p = gain_i dE_i / dp + own_i(p)
//
// For each row, a block knows:
// - where it receives light, and in which state;
// - the measured value and its variance;
// - how the illuminance E (lx) converts to the row's unit;
// - which other rows share its error.
// LightModel, FitLuminaires and its covariance know blocks only. A new kind of observation is a new block in
// its own file and one line in RowBlocksOf.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_ROW_BLOCK_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_ROW_BLOCK_H_

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/light_state.h"

namespace luxfit {

// Says where a row receives light: at an element of the room, at a sensor, or nowhere (an outline).
struct RowReceiver {
  int element = -1;
  const Sensor* sensor = nullptr;
  int state = 0;
};

struct RowResponse {
  double gain = 1;  // in the row's unit per lx
  double offset = 0;
};

// Holds errors a ~ N(0, root root^T) that rows of a block share. Row i is off by effect.row(i) times the p quantities of
// its owner, a[p owner .. p owner + p).
struct RowErrors {
  Eigen::MatrixXd effect;  // rows x p, in the row's unit
  std::vector<int> owner;  // by row
  Eigen::MatrixXd root;    // (p owners) x independent errors
};

// Whether errors of views are held, count with their covariances among each other, or each for itself. The last
// keeps what belongs to one view apart from the others.
enum class ViewErrors { kHeld, kJoint, kViewByView };

class RowBlock {
 public:
  virtual ~RowBlock() = default;
  virtual int row_count() const = 0;
  virtual RowReceiver ReceiverOf(int row) const = 0;

  // The measured value, its variance without the model's error, and whether the fit uses it.
  virtual double ValueOf(int row) const = 0;
  virtual double VarianceOf(int row) const = 0;
  virtual bool IsUsed(int row) const = 0;
  // Whether a row far from the model counts less. Rows that are few, each meant, are not down-weighted.
  virtual bool IsRobust() const = 0;
  // Whether a shadow edge across the receiver spoils the row: its dependence on positions is then not smooth.
  virtual bool IsSpoiltByPenumbra() const = 0;

  // Returns the channels' weights in the row's value, for a state with tints. They are those of the luminance
  // where the row is illuminance.
  virtual Eigen::Vector3d ChannelWeightsOf(const LightState& /*state*/, int /*row*/) const {
    return Eigen::Vector3d::Zero();
  }
  virtual RowResponse ResponseOf(const LightState& state, int row) const = 0;
  // Adds the derivatives of the row's value by the parameters, by way of gain and offset, with the illuminance held.
  // None by luminaires' numbers and fluxes where the row receives light.
  virtual void AddOwnDerivatives(const LightState& state, const std::vector<Parameter>& parameters,
                                 double illuminance_lx, int row,
                                 Eigen::Ref<Eigen::RowVectorXd> derivatives) const = 0;

  // Returns the cluster, whose rows share their model error. None: the row stands alone.
  virtual std::optional<std::pair<int, int>> ClusterOf(int row) const = 0;
  // Returns what the model's discretisation leaves out of each row, in its unit.
  virtual Eigen::VectorXd BiasOf(const LightState& state) const = 0;
  // Returns the errors that rows share, which the fit eliminates. No effect: none.
  virtual RowErrors SharedErrorsOf(const LightState& /*state*/, ViewErrors /*views*/) const { return {}; }
};

// Makes one block for each kind of observation. The first block that has rows carries the model's relative
// error, which its rows' scatter estimates.
std::vector<std::unique_ptr<RowBlock>> RowBlocksOf(const Room& room, const LightData& data);

// Returns the first row of the luxmeter's readings.
inline Eigen::Index FirstReadingRow(const LightData& data) {
  return static_cast<Eigen::Index>(data.observations.size());
}

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_ROW_BLOCK_H_
