// Returns the seconds of a monotonic clock, to measure durations.
#ifndef LUXFIT_APPS_TEXT_SECONDS_H_
#define LUXFIT_APPS_TEXT_SECONDS_H_

#include <chrono>

namespace luxfit {

inline double NowS() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_SECONDS_H_
