// The text of a photometric file, read line by line and then number by number, with line numbers for errors.
//
// Text is UTF-8 without a byte-order mark (text_encoding.h). Lines end in LF, CRLF or CR; the ^Z of DOS is dropped. Every number is finite and at
// most 1e9 in magnitude. Counts are held against what is left of the text before anything is allocated.
// Throws std::runtime_error("FILE:LINE: field: expected X, got Y; remedy").
#ifndef LUXFIT_FORWARD_LUMINAIRE_INTERNAL_PHOTOMETRY_TEXT_H_
#define LUXFIT_FORWARD_LUMINAIRE_INTERNAL_PHOTOMETRY_TEXT_H_

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace luxfit {

// Of anything that a file counts: what is left of its text bounds it further.
inline constexpr int kMostCounted = 1000000;

struct CommaInNumber {
  int line = 0;
  std::string shown;  // what it stands in, as a message shows it
};

class PhotometryText {
 public:
  // Commas separate numbers in .ies and stand for the decimal point in .ldt.
  enum class Comma { kSeparates, kDecimal };
  PhotometryText(std::string_view text, std::string name, Comma comma);

  int line() const { return line_; }  // of what was read last
  int decimal_commas() const { return decimal_commas_; }
  bool AtEnd() const;  // nothing but blanks is left

  // How many numbers are left, up to the end or the first that is none.
  size_t NumbersAhead() const;

  // The first comma between two digits of the numbers ahead, and the text that is left with such commas as points.
  std::optional<CommaInNumber> FirstCommaInNumber() const;
  std::string RestWithDecimalPoints() const;

  std::runtime_error Error(const std::string& field, const std::string& message) const;
  std::runtime_error ErrorAt(int line, const std::string& field, const std::string& message) const;

  std::string Line(const std::string& field);   // the next line without its end
  double LineNumber(const std::string& field);  // a line that holds one number
  int LineCount(const std::string& field, int least, int most);

  // Separated by blanks and line ends, wherever the lines break.
  double Number(const std::string& field);
  double NumberWithin(const std::string& field, double least, double most);
  int Count(const std::string& field, int least, int most);
  std::vector<double> Numbers(const std::string& field, size_t count, double least);
  std::vector<double> Rising(const std::string& field, size_t count, double least, double most);

 private:
  std::string_view Token(const std::string& field);
  double Parse(std::string_view token, const std::string& field);
  int Whole(double value, const std::string& field, int least, int most) const;
  void ExpectRoom(const std::string& field, size_t count) const;

  std::string_view text_;  // what is left
  std::string name_;
  Comma comma_;
  int line_ = 0, next_line_ = 1;
  int decimal_commas_ = 0;
};

// As short as it can be written so that it reads back the same.
std::string NumberText(double value);

// Without blanks at both ends.
std::string_view Trimmed(std::string_view text);

// The bytes of a file. Throws std::runtime_error naming it.
std::string FileBytes(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_INTERNAL_PHOTOMETRY_TEXT_H_
