// Any bytes as a glTF or GLB file: the reader must answer with a scene or a std::runtime_error.
//
// Run by .ci/fuzz.sh. Source: LLVM, "libFuzzer".
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "tests/fuzz/use_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace luxfit;
  try {
    UseScene(ParseScene({reinterpret_cast<const char*>(data), size}, MeshFormat::kGltf, "fuzz"));
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}
