// The photos of fixtures/office as the library takes them: states in the order A, B, C, D, all, evening.
#ifndef LUXFIT_TESTS_SUPPORT_OFFICE_PHOTOS_H_
#define LUXFIT_TESTS_SUPPORT_OFFICE_PHOTOS_H_

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "calib/photo_files/image.h"
#include "inverse/observe/as_if/states_as_if.h"
#include "inverse/observe/room_photos.h"
#include "tests/support/office_truth.h"

namespace luxfit::support {

inline StateTable OfficeStates() {
  StateTable table{{"A", "B", "C", "D", "all", "evening"}, {"A", "B", "C", "D"}, {}};
  for (int k = 0; k < 4; ++k) table.dimming.emplace_back(Eigen::VectorXd::Unit(4, k));
  table.dimming.emplace_back(Eigen::VectorXd::Ones(4));
  table.dimming.emplace_back(Eigen::Vector4d(0.3, 0, 1, 1));
  return table;
}

inline int OfficeStateIndex(const std::string& state) {
  const std::vector<std::string> states = OfficeStates().states;
  return static_cast<int>(std::find(states.begin(), states.end(), state) - states.begin());
}

inline RoomPhotos OfficePhotos() {
  RoomPhotos photos;
  photos.cameras.emplace_back();
  std::vector<LuminanceImage> images;
  for (const std::vector<std::string>& row : OfficeTable("photos.csv")) {
    if (row[0] == "file") continue;
    photos.photos.push_back({row[2], 0, OfficeStateIndex(row[3]), std::stod(row[4])});
    images.push_back(ToRelativeLuminance(ReadPhoto(kOfficeFolder + row[0]), std::stod(row[4])));
  }
  photos.read = InMemory(std::move(images));
  return photos;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_OFFICE_PHOTOS_H_
