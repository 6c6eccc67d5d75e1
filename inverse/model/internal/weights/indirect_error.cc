#include "inverse/model/internal/weights/indirect_error.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace luxfit {
namespace {

constexpr double kLeastSigma = 0.1;  // of the rows' own, which contain the scatter of all residuals

// Holds the modes in which the residuals show t, for one length: z_j ~ N(0, s^2 + tau^2 d_j).
struct VisibleModes {
  Eigen::VectorXd variance;  // d
  Eigen::VectorXd squares;   // z^2
};

// Holds the residuals without the part of t: their number without parameters, and their sum of squares.
struct FreeRows {
  double count = 0, squares = 0;
};

Eigen::MatrixXd SquareRootOf(const Eigen::MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

// `seen`: B^T M B. `gradient`: B^T r.
VisibleModes ModesOf(const Eigen::MatrixXd& seen, const Eigen::VectorXd& gradient,
                     const Eigen::MatrixXd& correlation) {
  // Light has the precision of float. In modes below the least noise, the largest t hardly shows.
  constexpr double kPrecision = 1e-6;
  const Eigen::MatrixXd root = SquareRootOf(correlation);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(root.transpose() * seen * root);
  const Eigen::VectorXd along = eigen.eigenvectors().transpose() * (root.transpose() * gradient);
  const Eigen::VectorXd& d = eigen.eigenvalues();  // ascending
  const double least = std::max(kPrecision * d[d.size() - 1], kLeastSigma * kLeastSigma);
  Eigen::Index first = 0;
  while (first < d.size() && !(d[first] > least)) ++first;
  const Eigen::Index count = d.size() - first;
  VisibleModes modes;
  modes.variance = d.tail(count);
  modes.squares = along.tail(count).cwiseAbs2().cwiseQuotient(modes.variance);
  return modes;
}

double LogLikelihood(const VisibleModes& modes, const FreeRows& rows, double tau, double sigma) {
  const double noise = sigma * sigma;
  const Eigen::ArrayXd variance = noise + tau * tau * modes.variance.array();
  const double others = std::max(0.0, rows.count - static_cast<double>(modes.variance.size()));
  const double other_squares = std::max(0.0, rows.squares - modes.squares.sum());
  return -0.5 * (variance.log().sum() + (modes.squares.array() / variance).sum() + others * std::log(noise) +
                 other_squares / noise);
}

// Collects a mean over weights that are given as logarithms.
class LogMean {
 public:
  void Add(double value, double log_weight) {
    if (log_weight > largest_) {
      const double scale = std::exp(largest_ - log_weight);
      sum_ *= scale, weight_ *= scale, largest_ = log_weight;
    }
    const double weight = std::exp(log_weight - largest_);
    sum_ += weight * value, weight_ += weight;
  }
  double Mean() const { return weight_ > 0 ? sum_ / weight_ : 0; }
  double LogWeight() const { return largest_ + std::log(weight_); }

 private:
  double sum_ = 0, weight_ = 0, largest_ = -std::numeric_limits<double>::infinity();
};

// Returns the mean of tau^2 over the likelihood, whose integral is the log weight.
LogMean MeanVariance(const VisibleModes& modes, const FreeRows& rows) {
  constexpr int kTaus = 50, kSigmas = 24;
  LogMean mean;
  for (int i = 0; i < kTaus; ++i) {
    const double tau = (i + 0.5) / kTaus;
    for (int j = 0; j < kSigmas; ++j) {
      const double sigma = std::pow(kLeastSigma, (j + 0.5) / kSigmas);
      mean.Add(tau * tau, LogLikelihood(modes, rows, tau, sigma));
    }
  }
  return mean;
}

std::vector<double> LengthsOf(const IndirectCells& cells) {
  Eigen::AlignedBox3d box;
  for (Eigen::Index p = 0; p < cells.center.cols(); ++p) box.extend(Eigen::Vector3d(cells.center.col(p)));
  std::vector<double> lengths{0};
  for (double length = cells.side_m; length > 0 && length < box.diagonal().norm(); length *= 2)
    lengths.push_back(length);
  return lengths;
}

// Returns the axis that the normal is nearest to, and its sign, from 0 to 5.
int FacingOf(const Eigen::Vector3d& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<int>(axis) + (normal[axis] > 0 ? 1 : 0);
}

}  // namespace

std::vector<bool> MaterialsWithoutPhotos(const Room& room, const LightData& data,
                                         const Eigen::VectorXd& weight) {
  std::vector<bool> without(room.scene.materials.size(), true);
  for (size_t i = 0; i < data.observations.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (row >= weight.size() || !(weight[row] > 0)) continue;
    without[static_cast<size_t>(room.patches.PatchOf(data.observations[i].element).material)] = false;
  }
  return without;
}

IndirectCells CutIntoCells(const Room& room, const std::vector<bool>& is_cut) {
  double area_m2 = 0;
  Eigen::AlignedBox3d box;
  const auto each = [&](const auto& take) {
    for (size_t e = 0; e < room.patches.elements.size(); ++e) {
      const Element& element = room.patches.elements[e];
      const int material = room.patches.PatchOf(static_cast<int>(e)).material;
      if (is_cut[static_cast<size_t>(material)] && element.area_m2 > 0)
        take(static_cast<int>(e), element, material);
    }
  };
  each([&](int, const Element& element, int) {
    area_m2 += element.area_m2;
    box.extend(element.center);
  });
  IndirectCells cells;
  cells.side_m = std::sqrt(area_m2 / kMostCells);
  std::map<std::array<int, 5>, size_t> known;
  std::vector<Eigen::Vector3d> moment;
  std::vector<double> area;
  each([&](int e, const Element& element, int material) {
    const Eigen::Array3i at = ((element.center - box.min()) / cells.side_m).array().floor().cast<int>();
    const int facing = FacingOf(element.normal);
    const auto [place, is_new] = known.try_emplace({material, facing, at[0], at[1], at[2]}, known.size());
    if (is_new) {
      cells.surfaces.push_back({-1, material, 1, {}});
      cells.surface_of.push_back({material, facing});
      moment.emplace_back(Eigen::Vector3d::Zero());
      area.push_back(0);
    }
    const size_t p = place->second;
    cells.surfaces[p].elements.emplace_back(e, element.area_m2);
    moment[p] += element.area_m2 * element.center;
    area[p] += element.area_m2;
  });
  const auto count = static_cast<Eigen::Index>(area.size());
  cells.area_m2 = Eigen::Map<const Eigen::VectorXd>(area.data(), count);
  cells.center.resize(3, count);
  for (Eigen::Index p = 0; p < count; ++p)
    cells.center.col(p) = moment[static_cast<size_t>(p)] / cells.area_m2[p];
  return cells;
}

Eigen::MatrixXd CellCorrelation(const IndirectCells& cells, double length_m) {
  const Eigen::Index count = cells.area_m2.size();
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(count, count);
  // Takes the mean of each material out of a vector over cells: t - 1 (a^T t) / a^T 1.
  Eigen::MatrixXd centred = Eigen::MatrixXd::Identity(count, count);
  std::map<int, double> area_of_material;
  for (Eigen::Index p = 0; p < count; ++p)
    area_of_material[cells.surface_of[static_cast<size_t>(p)][0]] += cells.area_m2[p];
  for (Eigen::Index p = 0; p < count; ++p) {
    const std::array<int, 2>& own = cells.surface_of[static_cast<size_t>(p)];
    for (Eigen::Index q = 0; q < count; ++q) {
      const std::array<int, 2>& other = cells.surface_of[static_cast<size_t>(q)];
      if (own[0] == other[0]) centred(p, q) -= cells.area_m2[q] / area_of_material[own[0]];
      if (own != other || !(length_m > 0)) continue;
      const double distance_m = (cells.center.col(p) - cells.center.col(q)).norm();
      correlation(p, q) = std::exp(-0.5 * std::pow(distance_m / length_m, 2));
    }
  }
  return centred * correlation * centred.transpose();
}

Eigen::MatrixXd RootOfCellErrors(const WeightedRows& rows, const Eigen::VectorXd& prior_gradient,
                                 const Eigen::MatrixXd& effect, const IndirectCells& cells, int used_rows) {
  const Eigen::MatrixXd information = rows.jacobian.transpose() * rows.jacobian;
  const Eigen::MatrixXd inverse = InverseOf(information + rows.prior_information);
  const Eigen::MatrixXd moved = rows.jacobian.transpose() * effect;
  const Eigen::MatrixXd seen = effect.transpose() * effect - moved.transpose() * inverse * moved;
  // Weights were refreshed after the last step, so the state is not quite their minimum. What a step would still
  // take up is no residual: modes that hardly show would take it for a large t.
  const Eigen::VectorXd residual =
      rows.residual -
      rows.jacobian * (inverse * (rows.jacobian.transpose() * rows.residual + prior_gradient));
  const Eigen::VectorXd gradient = effect.transpose() * residual;
  const FreeRows free{used_rows - (inverse * information).trace(), residual.squaredNorm()};

  std::vector<Eigen::MatrixXd> correlations;
  std::vector<LogMean> means;
  double largest = -std::numeric_limits<double>::infinity();
  for (const double length_m : LengthsOf(cells)) {
    correlations.push_back(CellCorrelation(cells, length_m));
    means.push_back(MeanVariance(ModesOf(seen, gradient, correlations.back()), free));
    largest = std::max(largest, means.back().LogWeight());
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(effect.cols(), effect.cols());
  double weights = 0;
  for (size_t l = 0; l < means.size(); ++l) {
    const double weight = std::exp(means[l].LogWeight() - largest);
    covariance += weight * means[l].Mean() * correlations[l];
    weights += weight;
  }
  return SquareRootOf(covariance / weights);
}

}  // namespace luxfit
