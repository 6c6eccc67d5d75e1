// A small good session in a temporary folder, for tests that read it or break it.
#ifndef LUXFIT_TESTS_SUPPORT_APPS_TINY_SESSION_H_
#define LUXFIT_TESTS_SUPPORT_APPS_TINY_SESSION_H_

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "apps/session/session.h"
#include "tests/support/temp_folder.h"

namespace luxfit {

constexpr char kTinySession[] = R"(name = "tiny"

[scene]
mesh = "room.obj"
unit = "cm"

[scene.albedo]
floor = 0.25
wall = [0.7, 0.6, 0.5]

[tags]
family = "tag36h11"
map = "tags.json"

[registration]
method = "tags"

[[camera]]
id = "cam0"
intrinsics = "cam0.yaml"
response = "linear"
vignetting = "none"
black_level = 64
cdm2_per_count_s = 0.5

[photos]
table = "photos.csv"

[states]
Z = { Z = 1.0 }
all = { A = 0.5, Z = 1 }

[luminaires]
count = 3
max = 12

[[luminaire]]
id = "B"
photometry = "lambertian"
shape = "rectangle"
size_m = [0.6, 0.3]
position_m = [1.5, 2.0, 2.8]
position_sigma_m = 0.5
aim = [0, 0, -2]
heading = [1, 0, 0]
flux_lm = 3600.0
flux_sigma_lm = 500

[luxmeter]
readings = "luxmeter.csv"
scale = ["L1@all"]
fit = ["F*@Z"]
sensitivity = "cosine"
class = "B"
)";

class TinySessionTest : public ::testing::Test {
 protected:
  TinySessionTest() { Reset(); }

  void Reset() const {
    folder_.Write("session.toml", kTinySession);
    folder_.Write("room.obj", "v 0 0 0\n");
    folder_.Write("cam0.yaml", "%YAML:1.0\n");
    folder_.Write(
        "tags.json",
        R"([{"id": 0, "size_m": 0.2, "center_m": [0, 1, 1], "normal": [1, 0, 0], "up": [0, 0, 1]}])");
    folder_.Write("photos.csv",
                  "file,camera,view,state,exposure_s\n"
                  "photos/v0_Z.png,cam0,v0,Z,0.1\n"
                  "photos/v0_all.png,cam0,v0,all,0.05\n");
    folder_.Write("photos/v0_Z.png", "");
    folder_.Write("photos/v0_all.png", "");
    folder_.Write("luxmeter.csv",
                  "id,x_m,y_m,z_m,nx,ny,nz,state,lux\n"
                  "L1,1,2,0.75,0,0,2,all,320.5\n"
                  "F1,1,2,0.75,0,0,1,Z,120\n"
                  "P1,1,3,0.75,0,0,1,Z,\n");
  }

  Session Read() const { return ReadSession(folder_.Path("session.toml")); }

  std::string Error() const { return ErrorOf(folder_.Path("session.toml")); }

  static std::string ErrorOf(const std::string& path) {
    try {
      ReadSession(path);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  // The message after one replacement in an otherwise good session.
  std::string ErrorAfter(const std::string& file, const std::string& from, const std::string& to) const {
    Reset();
    folder_.Replace(file, from, to);
    return Error();
  }
  std::string ErrorAfter(const std::string& from, const std::string& to) const {
    return ErrorAfter("session.toml", from, to);
  }

  // "session.toml:LINE: ", the line counted in the good session.
  static std::string At(const std::string& text) {
    const std::string session = kTinySession;
    const auto end = session.begin() + static_cast<std::ptrdiff_t>(session.find(text));
    return "session.toml:" + std::to_string(1 + std::count(session.begin(), end, '\n')) + ": ";
  }

  TempFolder folder_;
};

}  // namespace luxfit

#endif  // LUXFIT_TESTS_SUPPORT_APPS_TINY_SESSION_H_
