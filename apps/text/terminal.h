// What differs where a person watches: colours and progress bars on a terminal, plain lines elsewhere.
//
// A stream is a terminal where it is one (isatty), TERM is not "dumb" and, for colours, NO_COLOR is not set.
// Source: ECMA-48 (SGR, EL); no-color.org.
#ifndef LUXFIT_APPS_TEXT_TERMINAL_H_
#define LUXFIT_APPS_TEXT_TERMINAL_H_

#include <atomic>
#include <cstdio>
#include <string>
#include <thread>

namespace luxfit {

bool IsTerminal(std::FILE* stream);

// Text to standard output: on a terminal, lines that begin with a warning, a finding or an error get its
// colour.
void PrintText(const std::string& text);
// "luxfit: message" to standard error.
void PrintError(const std::string& message);

// Lines in colour; for tests, PrintText otherwise.
std::string WithColours(const std::string& text);

// One line on a terminal that tells how far a stage is and how long it will take still, redrawn ten times a
// second:
//
//   observe   49 photos of 8 registered views  [#########-----------]  1.2 s, 1.5 s to go
//
// by what is done of a known number, else by the time that it took the last time. Where standard error is no
// terminal there is the plain line alone. At its end the line stays, with the time taken.
class ProgressLine {
 public:
  // `expected_s` 0: not known.
  ProgressLine(std::string text, double expected_s);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Any thread may tell; of `total` one more is done.
  void Advance(int total);
  // Another line takes the terminal's place below.
  void HandOver();

 private:
  void Draw();

  std::string text_;
  double expected_s_, start_s_;
  std::atomic<int> done_{0}, total_{0};
  std::atomic<bool> is_over_{false};
  std::thread drawer_;
};

// The bar's text, without the line's: "[#####-----]  1.2 s, 1.2 s to go". share < 0: not known.
std::string ProgressText(double share, double elapsed_s);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_TERMINAL_H_
