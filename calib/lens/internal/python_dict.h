// The outermost entries of a Python dictionary literal, which mrcal's .cameramodel files are.
//
// Understands strings ('...', "...", with b or r before them), numbers, lists and tuples in each other, words
// (None, True) and comments to the end of the line; nothing is evaluated. mrcal's own reader in C reads past
// the end of texts that are cut short.
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
  std::string text;             // of a string without its quotes (escapes as they stand); else empty
  std::vector<double> numbers;  // of a number, or of a list of nothing but numbers
  bool is_text = false;
  bool is_numbers = false;
};

std::map<std::string, PythonValue> ParsePythonDict(const std::string& source, const std::string& file);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_PYTHON_DICT_H_
