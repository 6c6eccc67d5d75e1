// The office that an independent renderer photographed, behind a lens that adds a share of each picture's mean to every pixel: the
// share is found, and luminaires come out as through a clear lens.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "forward/light/room.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "inverse/observe/observe_photos.h"
#include "tests/support/office_fit.h"
#include "tests/support/office_photos.h"
#include "tests/support/office_truth.h"

namespace luxfit {
namespace {

using support::kOfficeFolder;

const Room& TheRoom() {
  static const Room room = MakeRoom(ReadScene(kOfficeFolder + "room.obj"));
  return room;
}

RoomPhotos VeiledPhotos(double share) {
  static const RoomPhotos clear = support::OfficePhotos();
  RoomPhotos photos = clear;
  photos.read = [share](size_t i) {
    LuminanceImage image = *clear.read(i);
    for (ImagePlane& plane : image.relative_rgb) plane += static_cast<float>(share) * plane.mean();
    image.relative_luminance += static_cast<float>(share) * image.relative_luminance.mean();
    return std::make_shared<const LuminanceImage>(std::move(image));
  };
  return photos;
}

ObservedPhotos Observed(double share) {
  return ObservePhotos(TheRoom(), {ReadCamera(kOfficeFolder + "cam0.yaml")},
                       ReadTagMap(kOfficeFolder + "tags.json"), VeiledPhotos(share), support::OfficeStates())
      .observed;
}

VeilingGlare Found(const ObservedPhotos& observed, double share) {
  const auto& found = observed.veiling_glare.at(0);
  EXPECT_TRUE(found);
  if (!found) return {};
  std::printf("veil of %.1f %%: g %.2f +- %.2f %%, views differ by %.2f %%, without by %.2f %%\n",
              100 * share, 100 * found->share, 100 * found->sigma, 100 * found->difference,
              100 * found->difference_without);
  return *found;
}

// The picture's mean holds the veil: what is found is g / (1 + g).
TEST(VeiledOffice, ShareIsFound) {
  for (const double share : {0.005, 0.01, 0.02, 0.05}) {
    const VeilingGlare found = Found(Observed(share), share);
    EXPECT_TRUE(found.IsFound());
    EXPECT_NEAR(found.share, share / (1 + share), 0.0006);
  }
  EXPECT_FALSE(Found(Observed(0), 0).IsFound());
}

TEST(VeiledOffice, LuminairesComeOutAsThroughAClearLens) {
  const ObservedPhotos observed = Observed(0.02);
  const support::OfficeError worst = support::WorstOfOffice(support::FitOffice(TheRoom(), observed.evidence));
  std::printf("worst position %.2f mm, worst flux %.2f %%\n", 1000 * worst.position_m,
              100 * worst.flux_share);
  EXPECT_LT(worst.position_m, 0.0053);  // 3.55 mm
  EXPECT_LT(worst.flux_share, 0.016);   // 1.05 %
}

}  // namespace
}  // namespace luxfit
