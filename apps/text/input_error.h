// Makes the error for a fault in a file or flag that the user wrote.
//
// Every message reads "FILE:LINE: key: expected X, got Y; remedy". The line is left out where a file has none
// (a folder, a missing file). The caller prints what() and ends with exit status 2.
#ifndef LUXFIT_APPS_TEXT_INPUT_ERROR_H_
#define LUXFIT_APPS_TEXT_INPUT_ERROR_H_

#include <stdexcept>
#include <string>

namespace luxfit {

struct SourcePlace {
  std::string file;  // as the user would open it
  int line = 0;      // from 1; 0: none
};

// `message` holds everything after the key: "expected ..., got ...; ...". An empty key is left out.
std::runtime_error InputError(const SourcePlace& place, const std::string& key, const std::string& message);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_INPUT_ERROR_H_
