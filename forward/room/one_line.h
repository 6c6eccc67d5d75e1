// Keeps a name on one line of a text file: control characters become blanks.
//
// Control characters are those below U+0020, U+007F and U+0080 to U+009F (UTF-8). Radiance's oconv executes a
// line that begins with `!`, and PLY, EULUMDAT and COLMAP end a record with its line. A name that the user or
// a mesh gave must therefore never bring a line break into a file that another program reads.
#ifndef LUXFIT_FORWARD_ROOM_ONE_LINE_H_
#define LUXFIT_FORWARD_ROOM_ONE_LINE_H_

#include <string>

namespace luxfit {

bool HasControlCharacter(const std::string& text);

std::string OneLine(std::string text);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_ONE_LINE_H_
