// Writes the office's photos as a phone names and encodes them: IMG_8970.JPG and on, 8 bits, the curve of sRGB, EXIF with camera, time and
// exposure. A first hour begins with these (tests/house/first_hour.sh).
//   phone_office FOLDER
#include <cstdio>
#include <string>

#include "tests/support/apps/phone_photos.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: phone_office FOLDER\n");
    return 2;
  }
  constexpr int kSecondsApart = 20;
  int count = 0;
  for (const luxfit::support::OfficePhoto& photo : luxfit::support::OfficePhotos()) {
    const std::string name = "/IMG_" + std::to_string(8970 + count) + ".JPG";
    luxfit::support::WritePhoneShot(argv[1] + name, {photo, 0, kSecondsApart * count++});
  }
  return 0;
}
