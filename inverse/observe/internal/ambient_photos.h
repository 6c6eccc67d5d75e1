// Takes ambient light out of photos of a room: the photo of a view with all luminaires off, as much of it as each of the view's
// photos shows (inverse/observe/ambient_light.h).
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_AMBIENT_PHOTOS_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_AMBIENT_PHOTOS_H_

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/register/registration.h"
#include "forward/light/room.h"
#include "inverse/observe/ambient_light.h"
#include "inverse/observe/as_if/states_as_if.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/room_photos.h"

namespace luxfit {

// Returns whether some photo shows ambient light alone.
bool HasAmbient(const RoomPhotos& photos, const StateTable& states);

class AmbientPhotos {
 public:
  // `maps`: of the views. Reads every photo of a registered view.
  AmbientPhotos(const Room& room, const std::vector<PixelMap>& maps, const RoomPhotos& photos,
                const std::vector<RegisteredView>& views, const StateTable& states);

  bool IsDark(int state) const { return is_dark_[static_cast<size_t>(state)]; }
  std::vector<std::string> ViewsWithout(const RoomPhotos& photos) const;

  // Reads a photo without ambient light, where its view has a photo of that; else the photo. `view`: of the registration.
  std::shared_ptr<const LuminanceImage> Read(const RoomPhotos& photos, size_t photo, int view) const;

  // Notes how much ambient light was subtracted from each observation of that photo. Where none was, for the view has no photo of
  // it, subtracts what other views show there; elements of which none does are left out.
  std::vector<Observation> Noted(const std::vector<Observation>& observations, const RoomPhotos& photos,
                                 size_t photo) const;

  const AmbientLight& light() const { return light_; }

 private:
  std::vector<bool> is_dark_;               // by state: all luminaires are off
  std::vector<std::optional<size_t>> off_;  // by photo: that of its view with all luminaires off
  std::vector<double> gains_;               // of cameras, over the unit of `light_`
  AmbientLight light_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_AMBIENT_PHOTOS_H_
