#include "apps/text/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>

namespace luxfit {
namespace {

std::atomic<bool> was_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may write it");

void OnInterrupt(int /*signal*/) {
  const int error = errno;
  was_interrupted = true;
  constexpr char kWords[] = "\nluxfit: stopping with the best state so far; Ctrl-C again ends at once\n";
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
  sigaction(SIGINT, nullptr, &before_);
  if (before_.sa_handler != SIG_IGN) sigaction(SIGINT, &action, nullptr);
}

InterruptListener::~InterruptListener() { sigaction(SIGINT, &before_, nullptr); }

bool InterruptListener::WasInterrupted() { return was_interrupted; }

}  // namespace luxfit
