#include "inverse/choose/internal/scene_detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "calib/luminance/median.h"
#include "forward/light/illuminance.h"
#include "inverse/choose/internal/left_out.h"
#include "inverse/model/internal/discretisation_bias.h"

namespace luxfit {
namespace {

constexpr int kMostBounces = 4;
constexpr int kMaxDetailElements = 800;

const Patch& PatchAt(const Room& room, int patch) { return room.patches.patches[static_cast<size_t>(patch)]; }

// Returns the rows that are compared: observations that the fit used, of elements taken evenly.
std::vector<size_t> RowsOf(const LightData& data, const LuminaireFit& fit) {
  std::map<int, int> order;
  for (size_t i = 0; i < data.observations.size(); ++i) {
    if (fit.weight[static_cast<Eigen::Index>(i)] > 0) order.emplace(data.observations[i].element, 0);
  }
  int count = 0;
  for (auto& [element, number] : order) number = count++;
  const int stride = std::max(1, (count + kMaxDetailElements - 1) / kMaxDetailElements);
  std::vector<size_t> rows;
  rows.reserve(data.observations.size());
  for (size_t i = 0; i < data.observations.size(); ++i) {
    const bool is_used = fit.weight[static_cast<Eigen::Index>(i)] > 0;
    if (is_used && order.at(data.observations[i].element) % stride == 0) rows.push_back(i);
  }
  return rows;
}

// Scores predictions that replace the fit's.
class Comparison {
 public:
  Comparison(const Room& room, const LightData& data, const LuminaireFit& fit, std::vector<size_t> rows)
      : room_(room), data_(data), fit_(fit), rows_(std::move(rows)) {}

  const std::vector<size_t>& rows() const { return rows_; }

  // `left_out`: light left out of each row, in its unit.
  GroupScores Score(const Eigen::VectorXd& left_out) const {
    const std::vector<double> factor = MaterialFactors(left_out);
    GroupScores scores;
    for (size_t i = 0; i < rows_.size(); ++i) {
      if (!IsLeftOut(i)) continue;
      const Observation& o = data_.observations[rows_[i]];
      const Patch& patch = room_.patches.PatchOf(o.element);
      const double modelled = factor[static_cast<size_t>(patch.material)] * Modelled(left_out, i);
      scores[patch.facet].Add((modelled - o.relative_luminance) / std::sqrt(VarianceOf(o)));
    }
    return scores;
  }

  // Returns the robust size of `left_out` relative to the prediction, like the fit's model error.
  double Relative(const Eigen::VectorXd& left_out) const {
    std::vector<double> relative;
    relative.reserve(rows_.size());
    for (size_t i = 0; i < rows_.size(); ++i)
      relative.push_back(std::abs(left_out[static_cast<Eigen::Index>(i)] / Predicted(i)));
    return kSigmaPerMad * Quantile(std::move(relative), 0.5);
  }

 private:
  bool IsLeftOut(size_t i) const {
    const auto element = static_cast<size_t>(data_.observations[rows_[i]].element);
    return luxfit::IsLeftOut(room_.patches.elements[element].patch);
  }
  double Predicted(size_t i) const { return fit_.predicted[static_cast<Eigen::Index>(rows_[i])]; }
  double Modelled(const Eigen::VectorXd& left_out, size_t i) const {
    return Predicted(i) - left_out[static_cast<Eigen::Index>(i)];
  }
  double VarianceOf(const Observation& o) const {
    return o.variance + std::pow(fit_.relative_sigma * o.relative_luminance, 2);
  }

  std::vector<double> MaterialFactors(const Eigen::VectorXd& left_out) const {
    const size_t materials = room_.scene.materials.size();
    std::vector<double> product(materials, 0), square(materials, 0), factor(materials, 1);
    for (size_t i = 0; i < rows_.size(); ++i) {
      if (IsLeftOut(i)) continue;
      const Observation& o = data_.observations[rows_[i]];
      const size_t m = static_cast<size_t>(room_.patches.PatchOf(o.element).material);
      const double weight = fit_.weight[static_cast<Eigen::Index>(rows_[i])] / VarianceOf(o);
      product[m] += weight * Modelled(left_out, i) * o.relative_luminance;
      square[m] += weight * Modelled(left_out, i) * Modelled(left_out, i);
    }
    for (size_t m = 0; m < materials; ++m) {
      if (fit_.state.albedo_free[m] && square[m] > 0 && product[m] > 0) factor[m] = product[m] / square[m];
    }
    return factor;
  }

  const Room& room_;
  const LightData& data_;
  const LuminaireFit& fit_;
  std::vector<size_t> rows_;
};

// Returns the direct light of every patch, patches x states, in lx.
Eigen::MatrixXf PatchDirect(const Room& room, const LightData& data, const LightState& state) {
  std::vector<int> elements;
  elements.reserve(3 * room.patches.patches.size());
  for (const Patch& patch : room.patches.patches) {
    for (const int quarter : {1, 2, 3})
      elements.push_back(patch.first_element +
                         std::min(patch.element_count - 1, patch.element_count * quarter / 4));
  }
  const Receivers receivers = MakeReceivers(room, elements, {});
  const Illuminance light = ComputeDirectIlluminance(
      room, receivers, ComputeReceiverVisibility(room, receivers, state.luminaires, 2), state.luminaires);
  const Eigen::MatrixXf sampled = light.direct * LumensByState(data, state.luminaires);
  Eigen::MatrixXf direct(static_cast<Eigen::Index>(room.patches.patches.size()), sampled.cols());
  for (Eigen::Index p = 0; p < direct.rows(); ++p)
    direct.row(p) = sampled.middleRows(3 * p, 3).colwise().mean();
  return direct;
}

// Returns what `exitance` (patches x states) adds to the rows, in their unit.
Eigen::VectorXd AtRows(const Room& room, const LightData& data, const LightState& state,
                       const std::vector<size_t>& rows, const Eigen::MatrixXf& exitance) {
  Eigen::VectorXd value(static_cast<Eigen::Index>(rows.size()));
  for (size_t i = 0; i < rows.size(); ++i) {
    const Observation& o = data.observations[rows[i]];
    const double rho = state.albedo[room.patches.PatchOf(o.element).material];
    const float lx = room.form_factors.element_to_patch.row(o.element).dot(exitance.col(o.state));
    value[static_cast<Eigen::Index>(i)] = state.camera_scale * rho / M_PI * static_cast<double>(lx);
  }
  return value;
}

DetailChoice CompareBounces(const Comparison& comparison, const Room& room, const LightData& data,
                            const LightState& state, const Transport& transport,
                            const Eigen::MatrixXf& direct, const Eigen::MatrixXf& exitance) {
  Eigen::VectorXf albedo(direct.rows());
  for (Eigen::Index p = 0; p < albedo.size(); ++p)
    albedo[p] = static_cast<float>(state.albedo[PatchAt(room, static_cast<int>(p)).material]);
  std::vector<std::string> names;
  std::vector<GroupScores> scores;
  Eigen::MatrixXf truncated = Eigen::MatrixXf::Zero(direct.rows(), direct.cols());
  for (int n = 0; n <= kMostBounces; ++n) {
    names.push_back(std::to_string(n));
    scores.push_back(comparison.Score(AtRows(room, data, state, comparison.rows(), exitance - truncated)));
    truncated = albedo.asDiagonal() * (direct + transport.Irradiance(truncated));
  }
  names.emplace_back("all");
  scores.push_back(
      comparison.Score(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(comparison.rows().size()))));
  return ChooseDetail(names, scores);
}

// Returns the 2 x 2 block to which a cell of a facet's grid belongs, from the cell's centre and edges.
using Parent = std::tuple<int, int, int>;
Parent ParentOf(const Room& room, int facet, const Eigen::Vector3d& center, const Eigen::Vector3d& edge_u,
                const Eigen::Vector3d& edge_v) {
  const Facet& of = room.scene.facets[static_cast<size_t>(facet)];
  const Eigen::Vector2d at = of.CoordinatesOf(center);
  const double u = at.x() * of.edge_u.norm() / std::max(1e-9, edge_u.norm());
  const double v = at.y() * of.edge_v.norm() / std::max(1e-9, edge_v.norm());
  return {facet, static_cast<int>(std::floor(u / 2)), static_cast<int>(std::floor(v / 2))};
}

// Replaces each row of `values` (one for each patch) by the area mean over 2 x 2 patches.
Eigen::MatrixXf OverPairsOfPatches(const Room& room, const Eigen::MatrixXf& values) {
  std::map<Parent, std::vector<Eigen::Index>> members;
  for (Eigen::Index p = 0; p < values.rows(); ++p) {
    const Patch& patch = PatchAt(room, static_cast<int>(p));
    members[ParentOf(room, patch.facet, patch.center, patch.edge_u, patch.edge_v)].push_back(p);
  }
  Eigen::MatrixXf means = values;
  for (const auto& [parent, patches] : members) {
    Eigen::RowVectorXf sum = Eigen::RowVectorXf::Zero(values.cols());
    float area = 0;
    for (const Eigen::Index p : patches) {
      const float own = room.transport.patch_area_m2[p];
      sum += own * values.row(p);
      area += own;
    }
    for (const Eigen::Index p : patches) {
      if (area > 0) means.row(p) = sum / area;
    }
  }
  return means;
}

// Returns what elements twice as large lose beyond those in use, for the comparison's rows. An element's
// light is taken at its centre, so it errs by the square of its size.
Eigen::VectorXd LeftOutByLargerElements(const Room& room, const LightData& data, const LightState& state,
                                        const std::vector<size_t>& rows) {
  LightData part;
  part.dimming = data.dimming;
  part.indirect_is_held = true;
  part.observations.reserve(rows.size());
  for (const size_t row : rows) part.observations.push_back(data.observations[row]);
  return -3 * DiscretisationBias(room, part, state, 2 * kMaxDetailElements);
}

template <typename Piece>
double MedianSizeM(const std::vector<Piece>& pieces) {
  std::vector<double> sizes;
  sizes.reserve(pieces.size());
  for (const Piece& piece : pieces) sizes.push_back(std::max(piece.edge_u.norm(), piece.edge_v.norm()));
  return Quantile(std::move(sizes), 0.5);
}

}  // namespace

SceneDetail CompareDetail(const Room& room, const LightData& data, const LuminaireFit& fit) {
  SceneDetail detail;
  if (!fit.IsUsable() || data.observations.empty() || room.sparse) return detail;
  const Comparison comparison(room, data, fit, RowsOf(data, fit));
  const LightState& state = fit.state;
  const Transport transport(room.transport, state.albedo);
  const Eigen::MatrixXf direct = PatchDirect(room, data, state);
  const Eigen::MatrixXf exitance = transport.Exitance(direct);
  const std::vector<size_t>& rows = comparison.rows();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  if (comparison.Score(none).empty()) return detail;
  detail.bounces = CompareBounces(comparison, room, data, state, transport, direct, exitance);
  const Eigen::VectorXd patches =
      AtRows(room, data, state, rows, exitance - OverPairsOfPatches(room, exitance));
  const Eigen::VectorXd elements = LeftOutByLargerElements(room, data, state, rows);
  const std::vector<std::string> sizes{"twice as large", "as used"};
  detail.patches = ChooseDetail(sizes, {comparison.Score(patches), comparison.Score(none)});
  detail.elements = ChooseDetail(sizes, {comparison.Score(elements), comparison.Score(none)});
  detail.patch_size_m = MedianSizeM(room.patches.patches);
  detail.element_size_m = MedianSizeM(room.patches.elements);
  detail.patch_error = comparison.Relative(patches) / 3;
  detail.element_error = comparison.Relative(elements) / 3;
  detail.model_error = fit.relative_sigma;
  detail.is_compared = true;
  return detail;
}

}  // namespace luxfit
