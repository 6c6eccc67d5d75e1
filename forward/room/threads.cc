#include "forward/room/threads.h"

#include <tbb/global_control.h>

namespace luxfit {

struct ThreadLimit::State {
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads <= 0) return;
  state_ = std::unique_ptr<State>(
      new State{{tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads)}});
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace luxfit
