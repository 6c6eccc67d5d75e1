// Takes the first Ctrl-C (SIGINT) or SIGTERM as a wish to stop early. A second one ends the program at once. A program
// that was started with such a signal ignored, as a script starts jobs in the background, goes on ignoring it.
//
// Source: POSIX.1-2017, sigaction (SA_RESETHAND).
#ifndef LUXFIT_APPS_TEXT_INTERRUPT_H_
#define LUXFIT_APPS_TEXT_INTERRUPT_H_

#include <array>
#include <csignal>

namespace luxfit {

// Listens from construction to destruction; one at a time.
class InterruptListener {
 public:
  InterruptListener();
  ~InterruptListener();
  InterruptListener(const InterruptListener&) = delete;
  InterruptListener& operator=(const InterruptListener&) = delete;

  // Returns whether such a signal came since construction. Any thread may call it.
  static bool WasInterrupted();

 private:
  std::array<struct sigaction, 2> before_ = {};
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_INTERRUPT_H_
