// Describes one kind of observation to the fit: a block of rows of the least-squares problem.
//
//   value_i = gain_i E_i + offset_i,   d value_i / d p = gain_i dE_i / dp + own_i(p)
//
// A block knows where each of its rows receives light and in which state, what was measured and how sure it is, what the
// illuminance E (lx) becomes in its own unit, and which rows share their error. LightModel, FitLuminaires and its covariance
// know blocks only. A new kind of observation is a new block in a file of its own and a line in RowBlocksOf.
#ifndef LUXFIT_INVERSE_MODEL_ROW_BLOCK_H_
#define LUXFIT_INVERSE_MODEL_ROW_BLOCK_H_

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/light_data.h"
#include "inverse/model/light_state.h"

namespace luxfit {

// Where a row receives light: an element of the room, or a sensor.
struct RowReceiver {
  int element = -1;
  const Sensor* sensor = nullptr;
  int state = 0;
};

struct RowResponse {
  double gain = 1;  // of illuminance, in the row's unit per lx
  double offset = 0;
};

class RowBlock {
 public:
  virtual ~RowBlock() = default;
  virtual int row_count() const = 0;
  virtual RowReceiver ReceiverOf(int row) const = 0;

  // What was measured, its variance without the model's error, and whether it is fitted to.
  virtual double ValueOf(int row) const = 0;
  virtual double VarianceOf(int row) const = 0;
  virtual bool IsUsed(int row) const = 0;
  // Whether a shadow's edge across the receiver spoils the row: its dependence on positions is then not smooth.
  virtual bool IsSpoiltByPenumbra() const = 0;

  virtual RowResponse ResponseOf(const LightState& state, int row) const = 0;
  // With the illuminance held: what the parameter does to gain and offset.
  virtual double OwnDerivative(const LightState& state, const Parameter& parameter, double illuminance_lx,
                               int row) const = 0;

  // Rows of one cluster share their model error; none: the row stands alone.
  virtual std::optional<std::pair<int, int>> ClusterOf(int row) const = 0;
  // What the model's discretisation leaves out of each row, in its unit.
  virtual Eigen::VectorXd BiasOf(const LightState& state) const = 0;
};

// The kinds of observation that there are. The first block that has rows carries the model's relative error: its rows are
// robust, and their scatter estimates that error.
std::vector<std::unique_ptr<RowBlock>> RowBlocksOf(const Room& room, const LightData& data);

// Where the luxmeter's readings stand among all rows.
inline Eigen::Index FirstReadingRow(const LightData& data) {
  return static_cast<Eigen::Index>(data.observations.size());
}

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_ROW_BLOCK_H_
