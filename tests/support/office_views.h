// The views of fixtures/office as signatures, registered in its surveyed tags.
#ifndef LUXFIT_TESTS_SUPPORT_OFFICE_VIEWS_H_
#define LUXFIT_TESTS_SUPPORT_OFFICE_VIEWS_H_

#include <map>
#include <string>
#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "calib/luminance/image.h"
#include "forward/light/room.h"
#include "forward/room/outline.h"
#include "inverse/furniture/signature_view.h"
#include "inverse/observe/observe_photos.h"
#include "tests/support/office_truth.h"

namespace luxfit::support {

inline Scene EmptyOffice() { return SceneFrom(OutlineOfBox({6, 4, 2.8})); }

inline const std::vector<SignatureView>& OfficeViews() {
  static const std::vector<SignatureView> views = [] {
    const std::vector<Camera> cameras{ReadCamera(kOfficeFolder + "cam0.yaml")};
    std::map<std::string, int> states;
    std::vector<RoomPhoto> photos;
    for (const std::vector<std::string>& row : OfficeTable("photos.csv")) {
      if (row[0] == "file") continue;
      const int state = states.emplace(row[3], static_cast<int>(states.size())).first->second;
      photos.push_back(
          {row[2], 0, state, ToRelativeLuminance(ReadPhoto(kOfficeFolder + row[0]), std::stod(row[4]))});
    }
    const Room room = MakeRoom(EmptyOffice());
    const PhotoObservations observed =
        ObservePhotos(room, cameras, ReadTagMap(kOfficeFolder + "tags.json"), photos);
    std::vector<SignatureView> of_office;
    for (const RegisteredView& view : observed.registration.views) {
      std::vector<const LuminanceImage*> images(states.size());
      for (const RoomPhoto& photo : photos)
        if (photo.view == view.view) images[static_cast<size_t>(photo.state)] = &photo.image;
      of_office.push_back(MakeSignatureView(cameras[0], view.cam_from_world, images));
      of_office.back().pose_covariance = view.covariance;
    }
    return of_office;
  }();
  return views;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_OFFICE_VIEWS_H_
