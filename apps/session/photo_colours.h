// Takes a camera's colours from its photos where the session says nothing of them.
//
// - RAW: the sensor's matrix (calib/colour/camera_colours.h).
// - response = "srgb": the primaries of the first photo's colour profile, else sRGB's.
// - Others keep the weights of the format, and `colours` stays empty: nothing tells them.
#ifndef LUXFIT_APPS_SESSION_PHOTO_COLOURS_H_
#define LUXFIT_APPS_SESSION_PHOTO_COLOURS_H_

#include "apps/session/session.h"

namespace luxfit {

Session WithColoursOfPhotos(Session session);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTO_COLOURS_H_
