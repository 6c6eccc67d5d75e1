// Text in other encodings than UTF-8.
#ifndef LUXFIT_TESTS_SUPPORT_FORWARD_ENCODED_TEXT_H_
#define LUXFIT_TESTS_SUPPORT_FORWARD_ENCODED_TEXT_H_

#include <string>

namespace luxfit::support {

inline std::string InUtf16(const std::u16string& text, bool big_endian, bool with_mark) {
  std::string bytes;
  for (const char16_t unit : (with_mark ? u"\ufeff" : u"") + text) {
    const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xff);
    bytes += big_endian ? high : low;
    bytes += big_endian ? low : high;
  }
  return bytes;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_FORWARD_ENCODED_TEXT_H_
