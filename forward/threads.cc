#include "forward/threads.h"

#include <cblas.h>
#include <tbb/global_control.h>

namespace luxfit {

struct ThreadLimit::State {
  tbb::global_control tbb_limit;
  int blas_threads_before;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads <= 0) return;
  state_ = std::unique_ptr<State>(
      new State{{tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads)},
                openblas_get_num_threads()});
  openblas_set_num_threads(threads);
}

ThreadLimit::~ThreadLimit() {
  if (state_) openblas_set_num_threads(state_->blas_threads_before);
}

}  // namespace luxfit
