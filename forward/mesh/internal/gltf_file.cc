#include "forward/mesh/internal/gltf_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "forward/mesh/internal/json_place.h"

namespace luxfit {
namespace {

constexpr std::string_view kGlbMagic = "glTF";
constexpr size_t kGlbHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr size_t kMaxBufferBytes = size_t{1} << 31;

struct Container {
  std::string_view json, binary;
};

Container ContainerOf(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, kGlbMagic.size()) != kGlbMagic) return {bytes, {}};
  if (bytes.size() < kGlbHeaderBytes)
    throw std::runtime_error(name + ": expected a GLB header, got the file's end; it is truncated");
  const uint32_t version = LittleEndian(bytes.data() + 4, 4), length = LittleEndian(bytes.data() + 8, 4);
  if (version != 2)
    throw std::runtime_error(name + ": expected GLB version 2, got " + std::to_string(version) +
                             "; export it as glTF 2.0");
  if (length > bytes.size())
    throw std::runtime_error(name + ": expected " + std::to_string(length) +
                             " bytes as its header says, got " + std::to_string(bytes.size()) +
                             "; the file is truncated");
  Container result;
  std::string_view rest = bytes.substr(0, length);
  rest.remove_prefix(std::min(kGlbHeaderBytes, rest.size()));
  for (int chunk = 0; rest.size() >= kChunkHeaderBytes; ++chunk) {
    const size_t size = LittleEndian(rest.data(), 4);
    const uint32_t type = LittleEndian(rest.data() + 4, 4);
    rest.remove_prefix(kChunkHeaderBytes);
    if (size > rest.size())
      throw std::runtime_error(name + ": chunk " + std::to_string(chunk) + ": expected " +
                               std::to_string(size) + " bytes, got " + std::to_string(rest.size()) +
                               "; export it again");
    if (chunk == 0 && type == kJsonChunk) result.json = rest.substr(0, size);
    if (chunk == 1 && type == kBinaryChunk) result.binary = rest.substr(0, size);
    rest.remove_prefix(size);
  }
  return result;
}

nlohmann::json DocumentOf(std::string_view json, const std::string& name) {
  try {
    return nlohmann::json::parse(json);
  } catch (const nlohmann::json::parse_error& error) {
    const size_t byte = std::min(error.byte, json.size());
    const auto line = 1 + std::count(json.begin(), json.begin() + static_cast<std::ptrdiff_t>(byte), '\n');
    throw std::runtime_error(name + ":" + std::to_string(line) +
                             ": expected the JSON of a glTF file, got something else; is it truncated? "
                             "export it again");
  } catch (const nlohmann::json::exception&) {  // a number past the range of doubles
    throw std::runtime_error(name + ": expected numbers within 1e308, got one beyond; export it again");
  }
}

int Base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::string FromBase64(std::string_view text, const JsonPlace& place) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = Base64Digit(c);
    if (digit < 0) place.Fail("expected base64, got another character in it; export it again");
    bits = bits << 6 | static_cast<uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

int HexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string BytesOfFile(const std::string& uri, size_t length, const std::string& folder,
                        const JsonPlace& place) {
  if (folder.empty() || uri.find("://") != std::string::npos)
    place.Fail("expected a buffer within the file or beside it, got \"" + uri.substr(0, 40) +
               "\"; export it as GLB");
  const std::optional<std::string> file_name = PercentDecoded(uri);
  if (!file_name) place.Fail("expected two hexadecimal digits after each %, got others");
  const std::filesystem::path path = std::filesystem::path(folder) / *file_name;
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error);
  if (!is_file || std::filesystem::file_size(path, error) < length)
    place.Fail("expected " + std::to_string(length) + " bytes in " + path.string() + ", got " +
               (is_file ? "fewer; it is truncated" : "no such file; keep it beside the .gltf"));
  std::string bytes(length, '\0');
  if (!std::ifstream(path, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(length)))
    place.Fail("expected a file, got one that cannot be read: " + path.string());
  return bytes;
}

std::string BufferOf(const JsonPlace& place, size_t length, std::string_view binary,
                     const std::string& folder) {
  if (!place.Has("uri")) return std::string(binary);
  const JsonPlace uri = place.At("uri");
  const std::string& text = uri.Text();
  if (text.substr(0, 5) != "data:") return BytesOfFile(text, length, folder, uri);
  constexpr std::string_view kBase64 = ";base64,";
  const size_t comma = text.find(',');
  const size_t mark = text.find(kBase64);
  if (mark == std::string::npos || mark + kBase64.size() != comma + 1)
    uri.Fail("expected data in base64, got another encoding; export it as GLB");
  return FromBase64(std::string_view(text).substr(comma + 1), uri);
}

}  // namespace

std::optional<std::string> PercentDecoded(const std::string& uri) {
  std::string path;
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      path += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? HexDigit(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? HexDigit(uri[i + 2]) : -1;
    if (high < 0 || low < 0) return std::nullopt;
    path += static_cast<char>(16 * high + low);
    i += 2;
  }
  return path;
}

GltfFile ParseGltfFile(std::string_view bytes, const std::string& name, const std::string& folder) {
  const Container container = ContainerOf(bytes, name);
  GltfFile file{DocumentOf(container.json, name), {}};
  const JsonPlace root(file.document, name);
  if (!root.Has("buffers")) return file;
  const JsonPlace buffers = root.At("buffers");
  size_t total = 0;
  file.buffers.reserve(buffers.Count());
  for (size_t b = 0; b < buffers.Count(); ++b) {
    const JsonPlace buffer = buffers.At(b);
    const size_t length = buffer.At("byteLength").Integer();
    total += length;
    if (total > kMaxBufferBytes) buffer.Fail("expected buffers of 2 GiB in all, got more");
    // Only the first buffer may lie in the chunk of a GLB.
    file.buffers.push_back(BufferOf(buffer, length, b == 0 ? container.binary : std::string_view(), folder));
    if (file.buffers.back().size() < length)
      buffer.Fail("expected " + std::to_string(length) + " bytes as byteLength says, got " +
                  std::to_string(file.buffers.back().size()) + "; is the file truncated? export it again");
  }
  return file;
}

}  // namespace luxfit
