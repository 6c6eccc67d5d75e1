// The views of fixtures/office as signatures, registered in its surveyed tags.
#ifndef LUXFIT_TESTS_SUPPORT_OFFICE_VIEWS_H_
#define LUXFIT_TESTS_SUPPORT_OFFICE_VIEWS_H_

#include <memory>
#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "forward/light/room.h"
#include "forward/mesh/outline.h"
#include "inverse/furniture/signature_view.h"
#include "inverse/observe/observe_photos.h"
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
    std::vector<SignatureView> of_office;
    for (const RegisteredView& view : observed.registration.views) {
      std::vector<std::shared_ptr<const LuminanceImage>> kept(states.states.size());
      std::vector<const LuminanceImage*> images(states.states.size());
      for (size_t i = 0; i < photos.photos.size(); ++i) {
        if (photos.photos[i].view != view.view) continue;
        const auto state = static_cast<size_t>(photos.photos[i].state);
        kept[state] = photos.read(i);
        images[state] = kept[state].get();
      }
      of_office.push_back(MakeSignatureView(cameras[0], view.cam_from_world, images));
      of_office.back().pose_covariance = view.covariance;
    }
    return of_office;
  }();
  return views;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_OFFICE_VIEWS_H_
