// Any bytes as a session, as areas of a report, as OpenCV's camera file, or as texts of a JSON artifact: readers must
// answer with what they read or with a std::runtime_error of UTF-8, and the writer with JSON that reads back. The first
// byte says which.
//
// Run by .ci/fuzz.sh. Source: LLVM, "libFuzzer".
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "apps/session/report_targets.h"
#include "apps/session/session.h"
#include "apps/text/formats/artifact.h"
#include "calib/lens/camera_file.h"

namespace {

using namespace luxfit;

// One folder a process, with the files that a session may name.
const std::string& Folder() {
  static const std::string folder = [] {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("luxfit_fuzz_session_" + std::to_string(getpid()));
    std::filesystem::create_directories(path);
    const auto write = [&](const char* name, const char* text) { std::ofstream(path / name) << text; };
    write("room.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    write("lamp.ies", "");
    write("cam.yaml", "");
    write("lux.csv", "id,x_m,y_m,z_m,nx,ny,nz,state,lux\nL1,1,1,1,0,0,1,all,100\n");
    write("photos.csv", "file,camera,view,state,exposure_s\na.png,cam0,v0,all,1\n");
    write("a.png", "");
    write("tags.json", "[]");
    return path.string() + "/";
  }();
  return folder;
}

std::string Written(const char* name, const char* data, size_t size) {
  std::ofstream(Folder() + name, std::ios::binary).write(data, static_cast<std::streamsize>(size));
  return Folder() + name;
}

// The strict writer throws for what is no UTF-8.
void ExpectUtf8(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
  } catch (const nlohmann::json::exception&) {
    std::abort();
  }
}

void UseSession(const Session& session) {
  ExpectUtf8(session.name);
  for (const SessionLuminaire& luminaire : session.luminaires) ExpectUtf8(luminaire.id);
  for (const SessionState& state : session.states) ExpectUtf8(state.id);
  for (const SessionReading& reading : session.luxmeter.readings) {
    if (!reading.position_m.allFinite()) std::abort();
  }
}

void UseCamera(const std::string& file) {
  const Camera camera = ReadCamera(file, "cam0");
  if (!std::isfinite(camera.fx_px + camera.cx_px) || camera.width_px < 1) std::abort();
  Project(camera, {0.1, -0.2, 1});
}

// Names of files are the texts that nobody has checked.
void UseWriter(const std::string& text) {
  const size_t half = text.size() / 2;
  const nlohmann::json artifact = {{"name", text}, {text.substr(0, half), {text.substr(half), 1.5}}};
  if (!nlohmann::json::parse(JsonText(artifact)).is_object()) std::abort();
}

void Use(int reader, const char* text, size_t size) {
  switch (reader) {
    case 0:
      UseSession(ReadSession(Written("session.toml", text, size)));
      break;
    case 1:
      ReadTargets(Written("targets.toml", text, size));
      break;
    case 2:
      UseCamera(Written("camera.yaml", text, size));
      break;
    default:
      UseWriter(std::string(text, size));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 1) return 0;
  const int reader = data[0] % 4;
  try {
    Use(reader, reinterpret_cast<const char*>(data) + 1, size - 1);
  } catch (const std::runtime_error& error) {
    if (reader < 2) ExpectUtf8(error.what());
  }
  return 0;
}
