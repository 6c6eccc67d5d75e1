#include "apps/text/formats/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include "apps/text/input_error.h"
#include "forward/room/text_encoding.h"

namespace luxfit {
namespace {

std::string WithLineFeeds(const std::string& text) {
  std::string lines;
  lines.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    const bool is_return = text[i] == '\r';
    if (is_return && i + 1 < text.size() && text[i + 1] == '\n') continue;
    lines += is_return ? '\n' : text[i];
  }
  return lines;
}

// Says which byte is not UTF-8, and what it may be.
std::string WordsOf(const std::string& bytes, size_t at) {
  return fmt::format("got the byte 0x{:02X}, which in Windows-1252 is \"{}\"",
                     static_cast<unsigned char>(bytes[at]), Utf8Text(std::string_view(bytes).substr(at, 1)));
}

void ExpectUtf8(const std::string& path, const std::string& bytes) {
  const std::optional<size_t> at = FirstByteOfNoUnicode(bytes);
  if (!at) return;
  const std::string before = WithLineFeeds(bytes.substr(0, *at));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  throw InputError(
      {path, static_cast<int>(line)}, "",
      fmt::format("expected text in UTF-8, {}; save the file as UTF-8 (spreadsheets call it \"CSV UTF-8\")",
                  WordsOf(bytes, *at)));
}

}  // namespace

std::string ReadTextFile(const std::string& path, const std::string& what) {
  std::ifstream file(path, std::ios::binary);
  std::error_code error;
  if (!file || std::filesystem::is_directory(path, error))
    throw InputError({path}, "",
                     "expected " + what + " that can be read, got none; check the path and its rights");
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  ExpectUtf8(path, bytes);
  return WithLineFeeds(Utf8Text(bytes));
}

void ExpectUtf8Path(const std::string& path) {
  const std::optional<size_t> at = FirstByteOfNoUnicode(path);
  if (!at) return;
  throw InputError({Utf8Text(path)}, "",
                   fmt::format("expected a path in UTF-8, as results name their files, {}; rename the folder",
                               WordsOf(path, *at)));
}

}  // namespace luxfit
