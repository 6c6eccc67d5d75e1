// Factors the exchange of light between surfaces that are not all as grey and as even as their materials.
//
// A channel's reflectances are rho_c = tint_c rho, those of patches that depart from their material times their factor.
// The exchange between plain grey surfaces of the same rho is what light in the channels is compared with.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_CHANNEL_TRANSPORTS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_CHANNEL_TRANSPORTS_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "forward/radiosity/transport.h"

namespace luxfit {

// Returns the reflectances by material in each channel: three, or those given where there is no tint.
std::vector<Eigen::VectorXd> ChannelAlbedo(const Eigen::VectorXd& albedo, const Eigen::Matrix3Xd& tint);

class ChannelTransports {
 public:
  // `exchange`: whose patches exchange grey light: `room`, or its clusters. `albedo`: by material; `tint`: by material,
  // empty for one channel; `patch_factor`: by patch of `room`, empty for 1. Both rooms must outlive it.
  ChannelTransports(const Room& room, const Room& exchange, Eigen::VectorXd albedo, Eigen::Matrix3Xd tint,
                    Eigen::VectorXd patch_factor);

  const Transport& grey() const { return grey_; }
  const std::vector<Transport>& channels() const { return channels_; }

  // Returns whether they serve other reflectances, too: what light in the channels is over grey light changes little where
  // no reflectance changes by more than `still_albedo`.
  bool Serve(const Eigen::VectorXd& albedo, const Eigen::Matrix3Xd& tint, const Eigen::VectorXd& patch_factor,
             double still_albedo) const;

 private:
  Eigen::VectorXd albedo_;
  Eigen::Matrix3Xd tint_;
  Eigen::VectorXd patch_factor_;
  Transport grey_;
  std::vector<Transport> channels_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_CHANNEL_TRANSPORTS_H_
