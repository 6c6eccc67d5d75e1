#include "forward/luminaire/internal/photometry_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

namespace luxfit {
namespace {

constexpr double kLargest = 1e9;  // no angle, length, flux or intensity of a luminaire comes near
constexpr double kLeastStep = 1e-6;

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0' || c == '\x1a'; }
bool IsLineEnd(char c) { return c == '\n' || c == '\r'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsDecimalComma(std::string_view text, size_t at) {
  return text[at] == ',' && IsDigit(text[at - 1]) && IsDigit(text[at + 1]);
}

// A token as it can stand in a message: printable, short.
std::string Shown(std::string_view token) {
  constexpr size_t kLongest = 24;
  std::string shown;
  for (const char c : token.substr(0, kLongest)) shown += c >= ' ' && c <= '~' ? c : '?';
  return "\"" + shown + (token.size() > kLongest ? "...\"" : "\"");
}

}  // namespace

PhotometryText::PhotometryText(std::string_view text, std::string name, Comma comma)
    : text_(text), name_(std::move(name)), comma_(comma) {}

bool PhotometryText::AtEnd() const {
  for (const char c : text_) {
    if (!IsBlank(c) && !IsLineEnd(c)) return false;
  }
  return true;
}

size_t PhotometryText::NumbersAhead() const {
  PhotometryText ahead = *this;
  size_t count = 0;
  try {
    for (;; ++count) ahead.Number("");
  } catch (const std::runtime_error&) {  // also at the end
    return count;
  }
}

std::optional<CommaInNumber> PhotometryText::FirstCommaInNumber() const {
  PhotometryText ahead = *this;
  ahead.comma_ = Comma::kDecimal;
  while (!ahead.AtEnd()) {
    const std::string_view token = ahead.Token("");
    if (token.find_first_not_of("0123456789+-.,eE") != std::string_view::npos) break;
    for (size_t i = 1; i + 1 < token.size(); ++i) {
      if (IsDecimalComma(token, i)) return CommaInNumber{ahead.line_, Shown(token)};
    }
  }
  return std::nullopt;
}

std::string PhotometryText::RestWithDecimalPoints() const {
  std::string rest(text_);
  for (size_t i = 1; i + 1 < rest.size(); ++i) {
    if (IsDecimalComma(text_, i)) rest[i] = '.';
  }
  return rest;
}

std::runtime_error PhotometryText::Error(const std::string& field, const std::string& message) const {
  return ErrorAt(line_, field, message);
}

std::runtime_error PhotometryText::ErrorAt(int line, const std::string& field,
                                           const std::string& message) const {
  return std::runtime_error(name_ + ":" + std::to_string(line) + ": " + field + ": " + message);
}

std::string PhotometryText::Line(const std::string& field) {
  if (text_.empty())
    throw ErrorAt(next_line_, field, "expected a line, got the end of the file; the file is cut short");
  line_ = next_line_;
  const size_t end = text_.find_first_of("\r\n");
  std::string line(text_.substr(0, end));
  if (end == std::string_view::npos) {
    text_ = {};
    return line;
  }
  const bool both = text_[end] == '\r' && end + 1 < text_.size() && text_[end + 1] == '\n';
  text_.remove_prefix(end + (both ? 2 : 1));
  ++next_line_;
  return line;
}

double PhotometryText::LineNumber(const std::string& field) {
  const std::string line = Line(field);
  return Parse(Trimmed(line), field);
}

int PhotometryText::LineCount(const std::string& field, int least, int most) {
  return Whole(LineNumber(field), field, least, most);
}

std::string_view PhotometryText::Token(const std::string& field) {
  const auto separates = [this](char c) { return IsBlank(c) || (c == ',' && comma_ == Comma::kSeparates); };
  size_t at = 0;
  for (; at < text_.size() && (separates(text_[at]) || IsLineEnd(text_[at])); ++at) {
    // CRLF counts once.
    if (text_[at] == '\n' || (text_[at] == '\r' && (at + 1 == text_.size() || text_[at + 1] != '\n')))
      ++next_line_;
  }
  line_ = next_line_;
  if (at == text_.size())
    throw Error(field,
                "expected a number, got the end of the file; the file is cut short, or a count in it is "
                "too large");
  size_t end = at;
  while (end < text_.size() && !separates(text_[end]) && !IsLineEnd(text_[end])) ++end;
  const std::string_view token = text_.substr(at, end - at);
  text_.remove_prefix(end);
  return token;
}

double PhotometryText::Parse(std::string_view token, const std::string& field) {
  std::string point(token);
  const size_t comma = point.find(',');
  if (comma_ == Comma::kDecimal && comma != std::string::npos && point.find('.') == std::string::npos &&
      point.find(',', comma + 1) == std::string::npos) {
    point[comma] = '.';
    ++decimal_commas_;
  }
  const char* first = point.data();
  const char* const last = first + point.size();
  if (point.size() > 1 && *first == '+' && first[1] != '-') ++first;
  double value = 0;
  const std::from_chars_result read = std::from_chars(first, last, value);
  // Out of range is either too large or, with a negative exponent, too small to matter.
  const bool tiny = read.ec == std::errc::result_out_of_range && read.ptr == last &&
                    (point.find("e-") != std::string::npos || point.find("E-") != std::string::npos);
  if (tiny) return 0;
  if (read.ec != std::errc() || read.ptr != last || !std::isfinite(value))
    throw Error(field, "expected a number, got " + Shown(token) + "; write it with a decimal point, no unit");
  if (std::abs(value) > kLargest)
    throw Error(field, "expected a number up to 1e9, got " + Shown(token) + "; correct it");
  return value;
}

int PhotometryText::Whole(double value, const std::string& field, int least, int most) const {
  if (value != std::floor(value) || value < least || value > most)
    throw Error(field, "expected a whole number from " + std::to_string(least) + " to " +
                           std::to_string(most) + ", got " + NumberText(value) + "; correct it");
  return static_cast<int>(value);
}

void PhotometryText::ExpectRoom(const std::string& field, size_t count) const {
  // Each number takes a digit and something between it and the next.
  if (count <= text_.size() / 2 + 1) return;
  throw Error(field, "expected " + std::to_string(count) + " numbers, but only " +
                         std::to_string(text_.size()) +
                         " bytes are left; the file is cut short, or a count in "
                         "it is too large");
}

double PhotometryText::Number(const std::string& field) { return Parse(Token(field), field); }

double PhotometryText::NumberWithin(const std::string& field, double least, double most) {
  const double value = Number(field);
  if (value < least || value > most)
    throw Error(field, "expected a number from " + NumberText(least) + " to " + NumberText(most) + ", got " +
                           NumberText(value) + "; correct it");
  return value;
}

int PhotometryText::Count(const std::string& field, int least, int most) {
  return Whole(Number(field), field, least, most);
}

std::vector<double> PhotometryText::Numbers(const std::string& field, size_t count, double least) {
  ExpectRoom(field, count);
  std::vector<double> values;
  values.reserve(count);
  while (values.size() < count) values.push_back(NumberWithin(field, least, kLargest));
  return values;
}

std::vector<double> PhotometryText::Rising(const std::string& field, size_t count, double least,
                                           double most) {
  ExpectRoom(field, count);
  std::vector<double> values;
  values.reserve(count);
  while (values.size() < count) {
    const double value = NumberWithin(field, least, most);
    if (!values.empty() && value - values.back() < kLeastStep)
      throw Error(field, "expected rising angles, got " + NumberText(value) + " after " +
                             NumberText(values.back()) +
                             "; put them, and the intensities with them, in order");
    values.push_back(value);
  }
  return values;
}

std::string NumberText(double value) {
  std::array<char, 32> text{};
  const double size = std::abs(value);
  // Plain decimals where they fit: not every program that loads the files reads 1e+05.
  const bool is_plain = size == 0 || (size >= 1e-9 && size < 1e12);
  const std::to_chars_result end =
      is_plain ? std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed)
               : std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::string_view Trimmed(std::string_view text) {
  while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string FileBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad())
    throw std::runtime_error(path + ": expected a readable file; check the name and its permissions");
  return bytes;
}

}  // namespace luxfit
