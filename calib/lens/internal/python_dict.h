// Reads the outermost entries of a Python dictionary literal, the form of mrcal's .cameramodel files.
//
// The reader understands strings ('...', "...", with b or r before them), numbers, nested lists and tuples,
// and words (None, True). It skips comments to the end of the line. It evaluates nothing. It replaces mrcal's
// own reader in C, which reads past the end of truncated text.
//
// Throws std::runtime_error("FILE:LINE: expected ..., got ...").
// Source: The Python Language Reference, sec. 2.4 and 6.2.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_PYTHON_DICT_H_
#define LUXFIT_CALIB_LENS_INTERNAL_PYTHON_DICT_H_

#include <map>
#include <string>
#include <vector>

namespace luxfit {

struct PythonValue {
  int line = 0;
  std::string text;             // a string without quotes, escapes as they stand; else empty
  std::vector<double> numbers;  // one number, or a list that holds only numbers
  bool is_text = false;
  bool is_numbers = false;
};

// Returns the entries of `source` by key. Errors name `file`.
std::map<std::string, PythonValue> ParsePythonDict(const std::string& source, const std::string& file);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_PYTHON_DICT_H_
