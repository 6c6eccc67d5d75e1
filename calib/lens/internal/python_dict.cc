#include "calib/lens/internal/python_dict.h"

#include <cctype>
#include <charconv>
#include <stdexcept>

namespace luxfit {
namespace {

class Reader {
 public:
  Reader(const std::string& source, const std::string& file) : source_(source), file_(file) {}

  std::map<std::string, PythonValue> Dict() {
    std::map<std::string, PythonValue> entries;
    Expect('{', "a dictionary in braces");
    while (!Take('}')) {
      const PythonValue key = Value(0);
      if (!key.is_text) Fail("a quoted key");
      Expect(':', "a colon after the key '" + key.text + "'");
      entries[key.text] = Value(0);
      if (!Take(',') && Peek() != '}') Fail("a comma or the closing brace");
    }
    return entries;
  }

 private:
  [[noreturn]] void Fail(const std::string& expected) {
    const std::string got =
        at_ < source_.size() ? "'" + std::string(1, source_[at_]) + "'" : "the end of the file";
    throw std::runtime_error(file_ + ":" + std::to_string(line_) + ": expected " + expected + ", got " + got);
  }

  void SkipBlank() {
    bool in_comment = false;
    for (; at_ < source_.size(); ++at_) {
      const char c = source_[at_];
      if (c == '\n') {
        ++line_;
        in_comment = false;
      } else if (c == '#') {
        in_comment = true;
      } else if (!in_comment && std::isspace(static_cast<unsigned char>(c)) == 0) {
        return;
      }
    }
  }

  // Returns the next character that is neither space nor comment; 0 at the end.
  char Peek() {
    SkipBlank();
    return at_ < source_.size() ? source_[at_] : '\0';
  }

  bool Take(char wanted) {
    if (Peek() != wanted || at_ >= source_.size()) return false;
    ++at_;
    return true;
  }

  void Expect(char wanted, const std::string& expected) {
    if (!Take(wanted)) Fail(expected);
  }

  PythonValue Value(int depth) {
    constexpr int kMaxDepth = 64;
    if (depth > kMaxDepth) Fail("fewer lists in lists");
    const char first = Peek();
    PythonValue value;
    value.line = line_;
    if (first == '[' || first == '(') return List(first == '[' ? ']' : ')', depth);
    if (first == '\'' || first == '"') return String();
    std::string word;
    while (at_ < source_.size() && (std::isalnum(static_cast<unsigned char>(source_[at_])) != 0 ||
                                    std::string("+-._").find(source_[at_]) != std::string::npos))
      word += source_[at_++];
    if (word.empty()) Fail("a string, a number or a list");
    if ((word == "b" || word == "r") && at_ < source_.size() && (source_[at_] == '\'' || source_[at_] == '"'))
      return String();
    double number = 0;
    const char* const begin = word.data() + (word[0] == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), number);
    if (error == std::errc() && end == word.data() + word.size()) {
      value.is_numbers = true;
      value.numbers = {number};
    }
    return value;
  }

  PythonValue List(char close, int depth) {
    PythonValue list;
    list.line = line_;
    list.is_numbers = true;
    ++at_;
    while (!Take(close)) {
      const PythonValue element = Value(depth + 1);
      list.is_numbers = list.is_numbers && element.is_numbers && element.numbers.size() == 1;
      if (list.is_numbers) list.numbers.push_back(element.numbers[0]);
      if (!Take(',') && Peek() != close) Fail("a comma or the end of the list");
    }
    return list;
  }

  PythonValue String() {
    PythonValue value;
    value.line = line_;
    value.is_text = true;
    const char quote = source_[at_++];
    while (at_ < source_.size() && source_[at_] != quote && source_[at_] != '\n') {
      if (source_[at_] == '\\' && at_ + 1 < source_.size()) value.text += source_[at_++];
      if (source_[at_] == '\n') ++line_;
      value.text += source_[at_++];
    }
    if (at_ >= source_.size() || source_[at_] != quote) Fail("the string's closing quote");
    ++at_;
    return value;
  }

  const std::string& source_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

std::map<std::string, PythonValue> ParsePythonDict(const std::string& source, const std::string& file) {
  return Reader(source, file).Dict();
}

}  // namespace luxfit
