#include "forward/room/one_line.h"

namespace luxfit {
namespace {

// Returns the number of bytes that the control character at `i` takes; 0 where there is none.
size_t ControlBytes(const std::string& text, size_t i) {
  const auto byte = static_cast<unsigned char>(text[i]);
  if (byte < 0x20 || byte == 0x7F) return 1;
  if (byte != 0xC2 || i + 1 == text.size()) return 0;
  const auto next = static_cast<unsigned char>(text[i + 1]);
  return next >= 0x80 && next < 0xA0 ? 2 : 0;
}

}  // namespace

bool HasControlCharacter(const std::string& text) {
  for (size_t i = 0; i < text.size(); ++i)
    if (ControlBytes(text, i) > 0) return true;
  return false;
}

std::string OneLine(std::string text) {
  for (size_t i = 0; i < text.size(); ++i)
    if (const size_t bytes = ControlBytes(text, i); bytes > 0) text.replace(i, bytes, " ");
  return text;
}

}  // namespace luxfit
