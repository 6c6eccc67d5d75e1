// Limits the cores that forward's parallel loops and dense products use, for as long as it lives.
// Program-wide.
#ifndef LUXFIT_FORWARD_ROOM_THREADS_H_
#define LUXFIT_FORWARD_ROOM_THREADS_H_

#include <memory>

namespace luxfit {

class ThreadLimit {
 public:
  // 0: all cores.
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_THREADS_H_
