// Any bytes as an OBJ or PLY file: the reader must answer with a scene or a std::runtime_error.
//
// The first byte chooses the format. Run by .ci/fuzz.sh. Source: LLVM, "libFuzzer".
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "tests/fuzz/use_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace luxfit;
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    UseScene(ParseScene(bytes, data[0] % 2 == 0 ? MeshFormat::kObj : MeshFormat::kPly, "fuzz"));
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}
