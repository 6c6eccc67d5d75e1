// Turns the bytes of a text file into UTF-8, whatever encoding they are in.
//
// In this order: UTF-16 and UTF-8 by their byte-order mark, which is dropped; UTF-16 without a mark, where a
// quarter of the bytes or more are NUL and all of them stand at even places (big-endian) or at odd ones
// (little-endian); UTF-8 where the bytes are valid; else Windows-1252, of which Latin-1 is a part. The last
// has a character for every byte, so no text is refused. Half a character at the end of UTF-16 is dropped, and
// a surrogate without its pair becomes U+FFFD.
//
// Sources: The Unicode Standard, sec. 3.9 (well-formed UTF-8, table 3-7) and 23.8 (byte-order mark); WHATWG
// Encoding Standard, index windows-1252.
#ifndef LUXFIT_FORWARD_ROOM_TEXT_ENCODING_H_
#define LUXFIT_FORWARD_ROOM_TEXT_ENCODING_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace luxfit {

// Returns valid UTF-8 without a byte-order mark. Text that is UTF-8 already comes back as it is.
std::string Utf8Text(std::string_view bytes);

// Returns the first byte that is not UTF-8 of a text that is neither UTF-8 nor UTF-16; nothing where it is one of them.
std::optional<std::size_t> FirstByteOfNoUnicode(std::string_view bytes);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_TEXT_ENCODING_H_
