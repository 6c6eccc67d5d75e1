// Limits the cores that parallel loops and dense products of forward/ use, as long as it lives.
//
// The limit holds for the whole program.
#ifndef LUXFIT_FORWARD_ROOM_THREADS_H_
#define LUXFIT_FORWARD_ROOM_THREADS_H_

#include <memory>

namespace luxfit {

class ThreadLimit {
 public:
  // 0 means all cores.
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
