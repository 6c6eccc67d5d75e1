#include "inverse/model/internal/part_smoothness.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <map>

#include "forward/luminaire/luminaire_parts.h"

namespace luxfit {
namespace {

constexpr double kRightAngle = M_PI / 2;

// Maps each part to its parameter. The reference part's value is the constant 1.
struct PartPlaces {
  std::map<int, int> parameter_of_part;
  int reference = -1;

  PartPlaces(const std::vector<Parameter>& parameters, int luminaire, LuminaireQuantity quantity) {
    for (size_t i = 0; i < parameters.size(); ++i) {
      if (!parameters[i].Is(ParameterKind::kLuminaire, luminaire, quantity)) continue;
      parameter_of_part[parameters[i].part] = static_cast<int>(i);
      reference = parameters[i].reference;
    }
  }
  void Add(int part, double coefficient, SmoothnessRow& row) const {
    const auto place = parameter_of_part.find(part);
    if (place != parameter_of_part.end()) row.terms.emplace_back(place->second, coefficient);
    if (part == reference) row.constant += coefficient;
  }
};

void AddTableRows(const Luminaire& luminaire, const PartPlaces& places, double sigma,
                  std::vector<SmoothnessRow>& rows) {
  const std::vector<double>& gamma_rad = luminaire.table->gamma_rad;
  const Eigen::VectorXd flux = NodeFlux(gamma_rad);
  const int n = static_cast<int>(gamma_rad.size());
  for (int j = 0; j + 1 < n; ++j) {
    if (std::abs(gamma_rad[static_cast<size_t>(j)] - kRightAngle) < 1e-6) continue;
    SmoothnessRow row;
    // Shares over that of the reference become intensities over its intensity.
    const auto add = [&](int node, double coefficient) {
      places.Add(node, coefficient * flux[places.reference] / (flux[node] * sigma), row);
    };
    add(j, -2);
    add(j + 1, j == 0 ? 2 : 1);
    if (j > 0) add(j - 1, 1);
    rows.push_back(std::move(row));
  }
}

void AddCellRows(const Luminaire& luminaire, const PartPlaces& places, double sigma,
                 std::vector<SmoothnessRow>& rows) {
  const int along = static_cast<int>(luminaire.emission.rows());
  const int across = static_cast<int>(luminaire.emission.cols());
  const auto add = [&](int a, int b) {
    SmoothnessRow row;
    places.Add(a, 1 / sigma, row);
    places.Add(b, -1 / sigma, row);
    rows.push_back(std::move(row));
  };
  for (int j = 0; j < across; ++j) {
    for (int i = 0; i < along; ++i) {
      const int cell = i + along * j;
      if (i + 1 < along) add(cell, cell + 1);
      if (j + 1 < across) add(cell, cell + along);
    }
  }
}

}  // namespace

double SmoothnessRow::Value(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  double value = constant;
  for (const auto& [index, coefficient] : terms) value += coefficient * x[index];
  return value;
}

std::vector<SmoothnessRow> SmoothnessRows(const LightState& state, const std::vector<Parameter>& parameters) {
  std::vector<SmoothnessRow> rows;
  for (size_t k = 0; k < state.luminaires.size(); ++k) {
    const int index = static_cast<int>(k);
    const PartPlaces nodes(parameters, index, LuminaireQuantity::kGammaNode);
    const PartPlaces cells(parameters, index, LuminaireQuantity::kCell);
    if (nodes.reference >= 0) AddTableRows(state.luminaires[k], nodes, state.free[k].table_sigma, rows);
    if (cells.reference >= 0) AddCellRows(state.luminaires[k], cells, state.free[k].emission_sigma, rows);
  }
  return rows;
}

void AddSmoothness(const std::vector<SmoothnessRow>& rows, Eigen::MatrixXd& hessian) {
  for (const SmoothnessRow& row : rows) {
    for (const auto& [i, a] : row.terms) {
      for (const auto& [j, b] : row.terms) hessian(i, j) += a * b;
    }
  }
}

double EffectiveParts(const Eigen::MatrixXd& data_hessian, const std::vector<SmoothnessRow>& rows,
                      const std::vector<Parameter>& parameters) {
  if (rows.empty()) return 0;
  Eigen::MatrixXd penalised = data_hessian;
  AddSmoothness(rows, penalised);
  std::vector<Eigen::Index> parts;
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (IsPart(parameters[i])) parts.push_back(static_cast<Eigen::Index>(i));
  }
  // A parameter that no row depends on counts as 0.
  penalised.diagonal().array() += 1e-12 * penalised.diagonal().maxCoeff() + 1e-300;
  const Eigen::MatrixXd shrinkage = penalised.ldlt().solve(data_hessian);
  double trace = 0;
  for (const Eigen::Index i : parts) trace += shrinkage(i, i);
  return trace;
}

}  // namespace luxfit
