// A density of one variable, tabulated for sampling: uniform shares become places that follow the density.
#ifndef LUXFIT_FORWARD_LUMINAIRE_INTERNAL_TABULATED_H_
#define LUXFIT_FORWARD_LUMINAIRE_INTERNAL_TABULATED_H_

#include <algorithm>
#include <vector>

namespace luxfit {

// A density over [low, high], tabulated: its integral and the inverse of its cumulative distribution.
class Tabulated {
 public:
  template <typename Density>
  Tabulated(double low, double high, const Density& density) : low_(low), step_((high - low) / kCells) {
    cumulative_[0] = 0;
    for (int i = 0; i < kCells; ++i) {
      // Simpson's rule in each cell.
      const double x = low + i * step_;
      cumulative_[static_cast<size_t>(i) + 1] =
          cumulative_[static_cast<size_t>(i)] +
          step_ / 6 * (density(x) + 4 * density(x + step_ / 2) + density(x + step_));
    }
  }
  double Total() const { return cumulative_.back(); }
  double Quantile(double share) const {
    const double target = share * Total();
    const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, target);
    const double before = *(above - 1), rise = *above - before;
    const double cell = static_cast<double>(above - 1 - cumulative_.begin());
    return low_ + step_ * (cell + (rise > 0 ? (target - before) / rise : 0.5));
  }

 private:
  static constexpr int kCells = 2048;
  double low_, step_;
  std::vector<double> cumulative_ = std::vector<double>(kCells + 1);
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_INTERNAL_TABULATED_H_
