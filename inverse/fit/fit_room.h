// Fits luminaires and reflectances to what photos and a luxmeter say of a room: luxfit's front door.
//
//   first guess -> models by left-out data -> scale -> all parameters together -> what detail the data support
//
// The steps: a start (places seen in photos or searched for), several starts where places compete, the simplest model of
// each luminaire that data left out support (inverse/choose), the absolute scale, and FitLuminaires on all observations with
// the interreflection solved. The result holds values, covariance, choices with their reasons and warnings with their
// remedies.
//
// Throws std::invalid_argument where sizes do not match: no luminaires, dimming that is not one entry a luminaire, a state
// out of range, an albedo list of another length than the room's materials, neither observations nor readings to fit to.
// What the data do not determine is no exception: see `findings` and RoomFit::IsUsable.
#ifndef LUXFIT_INVERSE_FIT_FIT_ROOM_H_
#define LUXFIT_INVERSE_FIT_FIT_ROOM_H_

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forward/light/room.h"
#include "inverse/choose/direct_share.h"
#include "inverse/fit/findings.h"
#include "inverse/fit/room_observations.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

struct FitRoomOptions {
  // Observed elements used until the models are chosen: positions are then known to a few millimetres.
  int max_elements_to_choose = 2000;
  // Called as a step begins, with its name ("guess", "choose", "refine", "detail", "fit") and what it does in words. The
  // token that it returns is released as the step ends. Empty: nobody listens.
  std::function<std::shared_ptr<void>(const std::string& step, const std::string& words)> on_step;
};

struct RoomFit {
  LuminaireFit fit;
  LightData data;                     // that was fitted to: views of one element merged
  std::vector<bool> luminaire_found;  // without a place it gives no light
  Eigen::Matrix3Xd albedo_rgb;        // by material; NaN where not estimated
  // By luminaire, relative to their mean (inverse/choose/colour_detail.h); empty where they are alike.
  Eigen::Matrix3Xd tint_rgb;
  bool absolute = false;                    // whether fluxes are in lm
  std::optional<DirectShare> direct_share;  // of fits to readings alone with reflectances free
  Findings findings;

  bool IsUsable() const { return fit.IsUsable(); }
  // Whether light that comes straight is told from light that comes by the walls.
  bool TellsDirectLight() const { return !direct_share || direct_share->is_determined; }
};

RoomFit FitRoom(const Room& room, const RoomObservations& observations, const FitRoomOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_FIT_ROOM_H_
