#include "forward/room/text_encoding.h"

#include <array>
#include <cstddef>

namespace luxfit {
namespace {

constexpr char32_t kReplacement = 0xfffd;
constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";

// Characters of the bytes 0x80 to 0x9f; five bytes have none and stay control characters.
constexpr std::array<char32_t, 32> kWindows1252 = {
    0x20ac, 0x81,   0x201a, 0x192,  0x201e, 0x2026, 0x2020, 0x2021, 0x2c6,  0x2030, 0x160,
    0x2039, 0x152,  0x8d,   0x17d,  0x8f,   0x90,   0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
    0x2013, 0x2014, 0x2dc,  0x2122, 0x161,  0x203a, 0x153,  0x9d,   0x17e,  0x178};

unsigned ByteAt(std::string_view bytes, size_t at) { return static_cast<unsigned char>(bytes[at]); }

void AppendUtf8(std::string& out, char32_t character) {
  const auto byte = [&out](char32_t value) { out += static_cast<char>(value); };
  if (character < 0x80) return byte(character);
  if (character < 0x800) {
    byte(0xc0 | (character >> 6));
  } else {
    if (character < 0x10000) {
      byte(0xe0 | (character >> 12));
    } else {
      byte(0xf0 | (character >> 18));
      byte(0x80 | ((character >> 12) & 0x3f));
    }
    byte(0x80 | ((character >> 6) & 0x3f));
  }
  byte(0x80 | (character & 0x3f));
}

// The length of the well-formed character there; 0 where it is none.
size_t Utf8LengthAt(std::string_view bytes, size_t at) {
  const unsigned first = ByteAt(bytes, at);
  if (first < 0x80) return 1;
  if (first < 0xc2 || first > 0xf4) return 0;
  const size_t length = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (at + length > bytes.size()) return 0;
  for (size_t i = 1; i < length; ++i) {
    if ((ByteAt(bytes, at + i) & 0xc0) != 0x80) return 0;
  }
  // No longer than it must be, no surrogates, none beyond U+10FFFF.
  const unsigned second = ByteAt(bytes, at + 1);
  const bool outside = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                       (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return outside ? 0 : length;
}

// Returns where the text is no longer UTF-8; its size where it is to its end.
size_t EndOfUtf8(std::string_view bytes) {
  size_t at = 0;
  while (at < bytes.size()) {
    const size_t length = Utf8LengthAt(bytes, at);
    if (length == 0) break;
    at += length;
  }
  return at;
}

enum class ByteOrder { kNone, kLittle, kBig };

ByteOrder MarkedOrder(std::string_view bytes) {
  if (bytes.substr(0, 2) == "\xff\xfe") return ByteOrder::kLittle;
  return bytes.substr(0, 2) == "\xfe\xff" ? ByteOrder::kBig : ByteOrder::kNone;
}

// Digits, blanks and line ends make up most of a photometric file: in UTF-16 one byte of each is NUL.
ByteOrder OrderByNuls(std::string_view bytes) {
  std::array<size_t, 2> nuls{};
  for (size_t i = 0; i < bytes.size(); ++i) nuls[i % 2] += bytes[i] == '\0' ? 1 : 0;
  if (4 * (nuls[0] + nuls[1]) < bytes.size() || (nuls[0] == 0) == (nuls[1] == 0)) return ByteOrder::kNone;
  return nuls[0] == 0 ? ByteOrder::kLittle : ByteOrder::kBig;
}

ByteOrder OrderOf(std::string_view bytes) {
  const ByteOrder marked = MarkedOrder(bytes);
  return marked == ByteOrder::kNone ? OrderByNuls(bytes) : marked;
}

std::string FromUtf16(std::string_view bytes, ByteOrder order) {
  const size_t count = bytes.size() / 2;
  const auto unit = [&](size_t i) -> char32_t {
    const unsigned a = ByteAt(bytes, 2 * i), b = ByteAt(bytes, 2 * i + 1);
    return order == ByteOrder::kBig ? a << 8 | b : b << 8 | a;
  };
  std::string out;
  out.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const char32_t high = unit(i);
    if (high < 0xd800 || high > 0xdfff) {
      AppendUtf8(out, high);
      continue;
    }
    const char32_t low = high < 0xdc00 && i + 1 < count ? unit(i + 1) : 0;
    const bool is_pair = low >= 0xdc00 && low <= 0xdfff;
    AppendUtf8(out, is_pair ? 0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00) : kReplacement);
    if (is_pair) ++i;
  }
  return out;
}

std::string FromWindows1252(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size());
  for (size_t i = 0; i < bytes.size(); ++i) {
    const unsigned byte = ByteAt(bytes, i);
    AppendUtf8(out, byte >= 0x80 && byte < 0xa0 ? kWindows1252[byte - 0x80] : byte);
  }
  return out;
}

}  // namespace

std::optional<std::size_t> FirstByteOfNoUnicode(std::string_view bytes) {
  if (OrderOf(bytes) != ByteOrder::kNone) return std::nullopt;
  const size_t end = EndOfUtf8(bytes);
  if (end == bytes.size()) return std::nullopt;
  return end;
}

std::string Utf8Text(std::string_view bytes) {
  const ByteOrder order = OrderOf(bytes);
  std::string text;
  if (order != ByteOrder::kNone) {
    text = FromUtf16(bytes, order);
    bytes = text;
  }
  // A program that converts a file may leave the mark that it found, and add its own.
  while (bytes.substr(0, kUtf8Mark.size()) == kUtf8Mark) bytes.remove_prefix(kUtf8Mark.size());
  return EndOfUtf8(bytes) == bytes.size() ? std::string(bytes) : FromWindows1252(bytes);
}

}  // namespace luxfit
