// The views of fixtures/office as signatures, registered in its surveyed tags.
#ifndef LUXFIT_TESTS_SUPPORT_OFFICE_VIEWS_H_
#define LUXFIT_TESTS_SUPPORT_OFFICE_VIEWS_H_

#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "forward/light/room.h"
#include "forward/mesh/outline.h"
#include "inverse/furniture/signature_view.h"
#include "inverse/observe/observe_photos.h"
#include "inverse/observe/room_signatures.h"
#include "tests/support/office_photos.h"

namespace luxfit::support {

inline Scene EmptyOffice() { return SceneFrom(OutlineOfBox({6, 4, 2.8})); }

inline const std::vector<SignatureView>& OfficeViews() {
  static const std::vector<SignatureView> views = [] {
    const std::vector<Camera> cameras{ReadCamera(kOfficeFolder + "cam0.yaml")};
    const RoomPhotos photos = OfficePhotos();
    const StateTable states = OfficeStates();
    const Room room = MakeRoom(EmptyOffice());
    const PhotoObservations observed =
        ObservePhotos(room, cameras, ReadTagMap(kOfficeFolder + "tags.json"), photos, states);
    return SignaturesOf(photos, cameras, observed.registration.views, static_cast<int>(states.states.size()));
  }();
  return views;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_OFFICE_VIEWS_H_
