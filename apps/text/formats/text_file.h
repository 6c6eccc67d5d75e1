// Reads a text file as UTF-8 with lines that end in LF, whatever wrote it.
//
// UTF-16 is converted, a byte-order mark is dropped, CRLF and CR become LF. Windows-1252 and Latin-1 are refused: which
// of the many such encodings a file is in, nothing tells. Files without a byte above 0x7F are the same in all.
//
// Throws std::runtime_error("FILE[:LINE]: expected ..., got ...; remedy") for those, and where it cannot be read.
#ifndef LUXFIT_APPS_TEXT_FORMATS_TEXT_FILE_H_
#define LUXFIT_APPS_TEXT_FORMATS_TEXT_FILE_H_

#include <string>

namespace luxfit {

// `what`: what the file should be, for the error ("a table").
std::string ReadTextFile(const std::string& path, const std::string& what);

// Expects the name of a file or folder in UTF-8, as results can name no other.
void ExpectUtf8Path(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FORMATS_TEXT_FILE_H_
