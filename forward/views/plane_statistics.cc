#include "forward/views/illuminance_plane.h"

#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

void AddUncertainty(const Eigen::MatrixXd& factor, const std::vector<bool>& counts, Eigen::Index least,
                    double model, PlaneStatistics& s) {
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(factor.cols());
  for (Eigen::Index i = 0; i < factor.rows(); ++i) {
    if (counts[static_cast<size_t>(i)]) mean += factor.row(i) / s.points;
  }
  s.average_sigma_lx = std::hypot(mean.norm(), model * s.average_lx);
  s.least_sigma_lx = std::hypot(factor.row(least).norm(), model * s.least_lx);
  if (!(s.least_lx > 0)) return;
  const double parameters = (factor.row(least) / s.least_lx - mean / s.average_lx).norm();
  s.uniformity_sigma = s.uniformity * std::hypot(parameters, model * std::sqrt(1 + 1.0 / s.points));
}

}  // namespace

PlaneStatistics StatisticsOf(const Eigen::VectorXd& illuminance_lx, const std::vector<bool>& counts,
                             const Eigen::MatrixXd& factor, double relative_model_error) {
  if (static_cast<size_t>(illuminance_lx.size()) != counts.size() ||
      (factor.size() > 0 && factor.rows() != illuminance_lx.size()))
    throw std::invalid_argument("StatisticsOf: expected one flag and one row of the factor a point");
  PlaneStatistics s;
  Eigen::Index least = -1;
  double sum = 0;
  for (Eigen::Index i = 0; i < illuminance_lx.size(); ++i) {
    if (!counts[static_cast<size_t>(i)]) continue;
    const double value = illuminance_lx[i];
    if (least < 0 || value < s.least_lx) {
      least = i;
      s.least_lx = value;
    }
    s.largest_lx = s.points == 0 ? value : std::max(s.largest_lx, value);
    sum += value;
    ++s.points;
  }
  if (s.points == 0) return s;
  s.average_lx = sum / s.points;
  if (s.average_lx > 0) s.uniformity = s.least_lx / s.average_lx;
  if (s.largest_lx > 0) s.diversity = s.least_lx / s.largest_lx;
  if (factor.size() > 0) AddUncertainty(factor, counts, least, relative_model_error, s);
  return s;
}

}  // namespace luxfit
