// Reads the container of a glTF 2.0 asset: its JSON and the bytes of its buffers.
//
// The asset is JSON text, whose buffers are base64 within it or files beside it, or GLB, which holds both.
// Every buffer has at least the length that the JSON states; all together have at most 2 GiB.
//
// Throws std::runtime_error("FILE:LINE: ..." or "FILE: /JSON/POINTER: expected ..., got ...; remedy").
// Source: Khronos Group, "glTF 2.0 specification" (ISO/IEC 12113:2022), 3.6.1 and 4; base64: RFC 4648.
#ifndef LUXFIT_FORWARD_MESH_INTERNAL_GLTF_FILE_H_
#define LUXFIT_FORWARD_MESH_INTERNAL_GLTF_FILE_H_

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace luxfit {

struct GltfFile {
  nlohmann::json document;
  std::vector<std::string> buffers;
};

// Parses a text or GLB asset that messages call `name`. Buffers in other files are read from `folder`, and
// refused where it is empty.
GltfFile ParseGltfFile(std::string_view bytes, const std::string& name, const std::string& folder);

// Decodes a reference to a file, which is percent-encoded: "my%20room.bin". Returns nothing where it is not.
std::optional<std::string> PercentDecoded(const std::string& uri);

// Reads a whole number of `size` <= 4 bytes: glTF is little-endian on every machine.
inline uint32_t LittleEndian(const char* bytes, size_t size) {
  uint32_t value = 0;
  for (size_t i = 0; i < size; ++i) value |= uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  return value;
}

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_INTERNAL_GLTF_FILE_H_
