// Returns a room whose patches stay and whose form factors are computed anew, as MakeRoom would with these options.
//
// Visibility and the form factors of sensors depend on the patches alone, and stay valid. Throws as MakeRoom does.
#ifndef LUXFIT_FORWARD_LIGHT_INTERNAL_ROOM_AGAIN_H_
#define LUXFIT_FORWARD_LIGHT_INTERNAL_ROOM_AGAIN_H_

#include "forward/light/room.h"

namespace luxfit {

Room WithFormFactors(Room room, const FormFactorOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_INTERNAL_ROOM_AGAIN_H_
