// Computes relative derivatives of what photos and meters would measure, luminaire by luminaire.
//
//   d ln Y_s / d theta = sum_k d_sk dY_k / d theta / sum_k d_sk Y_k
//
// Y_k: luminance of an element, or a reading at a sensor, by luminaire k fully on; d: dimming. Light adds, so one
// computation serves every state. Luminaires have no bodies here. Not for sparse rooms: they have no derivatives.
#ifndef LUXFIT_INVERSE_ADVISE_INTERNAL_LIGHT_DERIVATIVES_H_
#define LUXFIT_INVERSE_ADVISE_INTERNAL_LIGHT_DERIVATIVES_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/model/internal/light_model.h"

namespace luxfit {

struct RelativeRow {
  double value = 0;  // relative luminance, or lx
  Eigen::VectorXd
      derivative;  // by parameter; empty where there is no light, or a shadow edge crosses the element
};

class LightDerivatives {
 public:
  LightDerivatives(const Room& room, const LightState& state, const std::vector<Parameter>& parameters,
                   const std::vector<int>& elements, const std::vector<Sensor>& sensors);

  // Return the row of an element or a sensor, by its place in the lists that were given.
  RelativeRow OfElement(size_t place, const Eigen::VectorXd& dimming) const { return Row(place, dimming); }
  RelativeRow OfSensor(size_t place, const Eigen::VectorXd& dimming) const {
    return Row(elements_ + place, dimming);
  }

 private:
  RelativeRow Row(size_t place, const Eigen::VectorXd& dimming) const;

  size_t elements_ = 0;
  Prediction light_;  // rows: places x luminaires, the luminaire fastest
  std::vector<bool> in_penumbra_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ADVISE_INTERNAL_LIGHT_DERIVATIVES_H_
