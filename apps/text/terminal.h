// Prints for a person who watches: colours and progress bars on a terminal, plain lines elsewhere.
//
// A stream counts as a terminal where isatty holds and TERM is not "dumb". Colours also require that NO_COLOR
// is not set.
// Source: ECMA-48 (SGR, EL); no-color.org.
#ifndef LUXFIT_APPS_TEXT_TERMINAL_H_
#define LUXFIT_APPS_TEXT_TERMINAL_H_

#include <atomic>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>

namespace luxfit {

bool IsTerminal(std::FILE* stream);

// Prints text to standard output. On a terminal, lines that begin with a warning, a finding or an error are
// coloured.
void PrintText(const std::string& text);
// Prints "luxfit: message" to standard error.
void PrintError(const std::string& message);

// Returns the lines in colour. Tests use it; other callers use PrintText.
std::string WithColours(const std::string& text);

// Shows on one line of a terminal how far a stage is and how long it will still take, redrawn ten times a
// second:
//
//   observe   49 photos of 8 registered views  [#########-----------]  1.2 s, 1.5 s to go
//
// The share follows from the number of finished parts where that is known, else from the time of the last
// run. Where standard error is no terminal, only the plain line is printed. At its end the line stays, with
// the time taken.
class ProgressLine {
 public:
  // `expected_s` of 0 means that the time is not known.
  ProgressLine(std::string text, double expected_s);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Counts one more of `total` parts as done. Any thread may call it.
  void Advance(int total);
  // Shows words behind the text while the line is redrawn. Elsewhere they are lines of their own, one in ten seconds
  // at most.
  void Say(const std::string& words);
  // Ends the line, because another one follows below it.
  void HandOver();

 private:
  void Draw();

  std::string text_;
  double expected_s_, start_s_;
  std::mutex said_mutex_;
  std::string said_;  // by Say
  double said_s_;     // when
  std::atomic<int> done_{0}, total_{0};
  std::atomic<bool> is_over_{false};
  std::thread drawer_;
};

// Returns the text of the bar alone: "[#####-----]  1.2 s, 1.2 s to go". A share below 0 means that it is not
// known.
std::string ProgressText(double share, double elapsed_s);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_TERMINAL_H_
