#include "apps/text/interrupt.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>

namespace luxfit {
namespace {

constexpr std::array<int, 2> kWishes = {SIGINT, SIGTERM};
std::atomic<bool> was_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may write it");

void OnInterrupt(int /*signal*/) {
  const int error = errno;
  was_interrupted = true;
  constexpr char kWords[] =
      "\nluxfit: stopping with the best state so far; the same signal again (Ctrl-C) ends at once\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kWords, sizeof(kWords) - 1);
  errno = error;
}

}  // namespace

InterruptListener::InterruptListener() {
  was_interrupted = false;
  struct sigaction action = {};
  action.sa_handler = OnInterrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigemptyset(&action.sa_mask);
  for (size_t i = 0; i < kWishes.size(); ++i) {
    sigaction(kWishes[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kWishes[i], &action, nullptr);
  }
}

InterruptListener::~InterruptListener() {
  for (size_t i = 0; i < kWishes.size(); ++i) sigaction(kWishes[i], &before_[i], nullptr);
  was_interrupted = false;  // the wish was for those who listened
}

bool InterruptListener::WasInterrupted() { return was_interrupted; }

}  // namespace luxfit
