#include "inverse/choose/internal/detail/scene_detail.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "calib/luminance/median.h"
#include "forward/light/illuminance.h"
#include "inverse/model/internal/discretisation_bias.h"

namespace luxfit {
namespace {

constexpr int kMostBounces = 4;
constexpr int kMaxDetailElements = 800;

const Patch& PatchAt(const Room& room, int patch) { return room.patches.patches[static_cast<size_t>(patch)]; }

// Numbers the elements that the fit used, in their order.
std::map<int, int> NumberUsed(const LightData& data, const LuminaireFit& fit) {
  std::map<int, int> number;
  for (size_t i = 0; i < data.observations.size(); ++i) {
    if (fit.weight[static_cast<Eigen::Index>(i)] > 0) number.emplace(data.observations[i].element, 0);
  }
  int count = 0;
  for (auto& [element, n] : number) n = count++;
  return number;
}

// Returns the rows that are compared: observations that the fit used, of elements taken evenly.
std::vector<size_t> RowsOf(const LightData& data, const LuminaireFit& fit, const std::map<int, int>& number) {
  const int count = static_cast<int>(number.size());
  const int stride = std::max(1, (count + kMaxDetailElements - 1) / kMaxDetailElements);
  std::vector<size_t> rows;
  rows.reserve(data.observations.size());
  for (size_t i = 0; i < data.observations.size(); ++i) {
    const bool is_used = fit.weight[static_cast<Eigen::Index>(i)] > 0;
    if (is_used && number.at(data.observations[i].element) % stride == 0) rows.push_back(i);
  }
  return rows;
}

// Returns the robust size of the light left out relative to the prediction, like the fit's model error.
double Relative(const LuminaireFit& fit, const std::vector<size_t>& rows, const Eigen::VectorXd& left_out) {
  std::vector<double> relative;
  relative.reserve(rows.size());
  for (size_t i = 0; i < rows.size(); ++i)
    relative.push_back(
        std::abs(left_out[static_cast<Eigen::Index>(i)] / fit.predicted[static_cast<Eigen::Index>(rows[i])]));
  return kSigmaPerMad * Quantile(std::move(relative), 0.5);
}

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

// Returns what fewer reflections leave out of the rows: rows x (0, 1, ... kMostBounces reflections).
Eigen::MatrixXd LeftOutByBounces(const Room& room, const LightData& data, const LightState& state,
                                 const std::vector<size_t>& rows, const Transport& transport,
                                 const Eigen::MatrixXf& direct, const Eigen::MatrixXf& exitance) {
  Eigen::VectorXf albedo(direct.rows());
  for (Eigen::Index p = 0; p < albedo.size(); ++p)
    albedo[p] = static_cast<float>(state.albedo[PatchAt(room, static_cast<int>(p)).material]);
  Eigen::MatrixXd left_out(static_cast<Eigen::Index>(rows.size()), kMostBounces + 1);
  Eigen::MatrixXf truncated = Eigen::MatrixXf::Zero(direct.rows(), direct.cols());
  for (int n = 0; n <= kMostBounces; ++n) {
    left_out.col(n) = AtRows(room, data, state, rows, exitance - truncated);
    truncated = albedo.asDiagonal() * (direct + transport.Irradiance(truncated));
  }
  return left_out;
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

// Returns what elements twice as large lose beyond those in use, for the compared rows. An element's light is
// taken at its centre, so it errs by the square of its size.
Eigen::VectorXd LeftOutByLargerElements(const Room& room, const LightData& data, const LightState& state,
                                        const std::vector<size_t>& rows) {
  LightData part;
  part.dimming = data.dimming;
  part.indirect_is_held = true;
  part.observations.reserve(rows.size());
  for (const size_t row : rows) part.observations.push_back(data.observations[row]);
  return 3 * DiscretisationBias(room, part, state, 2 * kMaxDetailElements);
}

template <typename Piece>
double MedianSizeM(const std::vector<Piece>& pieces) {
  std::vector<double> sizes;
  sizes.reserve(pieces.size());
  for (const Piece& piece : pieces) sizes.push_back(std::max(piece.edge_u.norm(), piece.edge_v.norm()));
  return Quantile(std::move(sizes), 0.5);
}

EffectChoice ChooseBounces(const LuminaireFit& fit, const Eigen::MatrixXd& shift) {
  std::vector<EffectCandidate> among;
  among.reserve(static_cast<size_t>(shift.cols()) + 1);
  for (Eigen::Index n = 0; n < shift.cols(); ++n)
    among.push_back({std::to_string(n), LargestShiftOf(fit, shift.col(n))});
  among.push_back({"all", {}});
  return ChooseByEffect(std::move(among));
}

// `shift`: by twice the size.
EffectChoice ChooseSize(const LuminaireFit& fit, const Eigen::VectorXd& shift) {
  return ChooseByEffect(
      {{"twice as large", LargestShiftOf(fit, shift)}, {"as used", LargestShiftOf(fit, shift / 3)}});
}

EffectChoice ChooseRows(const Room& room, const LightData& data, const LuminaireFit& fit,
                        const std::vector<ParameterPrior>& priors, const std::map<int, int>& number) {
  std::vector<bool> is_in_half;
  is_in_half.reserve(data.observations.size());
  for (const Observation& o : data.observations) {
    const auto found = number.find(o.element);
    is_in_half.push_back(found != number.end() && found->second % 2 == 0);
  }
  return ChooseByEffect(
      {{"half", LargestShiftOf(fit, ShiftByPart(room, data, fit, priors, is_in_half))}, {"all", {}}});
}

}  // namespace

EffectChoice ChooseByEffect(std::vector<EffectCandidate> among) {
  EffectChoice choice{std::move(among), 0};
  while (choice.chosen + 1 < choice.among.size() && !(choice.Chosen().effect.sigmas < kWorthSigmas))
    ++choice.chosen;
  return choice;
}

SceneDetail CompareDetail(const Room& room, const LightData& data, const LuminaireFit& fit,
                          const std::vector<ParameterPrior>& priors) {
  SceneDetail detail;
  if (!fit.IsUsable() || data.observations.empty() || room.sparse || fit.covariance.size() == 0)
    return detail;
  const std::map<int, int> number = NumberUsed(data, fit);
  const std::vector<size_t> rows = RowsOf(data, fit, number);
  if (rows.empty()) return detail;
  const LightState& state = fit.state;
  const Transport transport(room.transport, state.albedo);
  const Eigen::MatrixXf direct = PatchDirect(room, data, state);
  const Eigen::MatrixXf exitance = transport.Exitance(direct);
  const Eigen::VectorXd patches =
      AtRows(room, data, state, rows, exitance - OverPairsOfPatches(room, exitance));
  const Eigen::VectorXd elements = LeftOutByLargerElements(room, data, state, rows);
  const Eigen::MatrixXd bounces = LeftOutByBounces(room, data, state, rows, transport, direct, exitance);
  Eigen::MatrixXd lost(bounces.rows(), bounces.cols() + 2);
  lost << bounces, patches, elements;
  const Eigen::MatrixXd shift = ParameterShift(room, data, fit, priors, rows, lost);
  detail.bounces = ChooseBounces(fit, shift.leftCols(bounces.cols()));
  detail.patches = ChooseSize(fit, shift.col(bounces.cols()));
  detail.elements = ChooseSize(fit, shift.col(bounces.cols() + 1));
  detail.rows = ChooseRows(room, data, fit, priors, number);
  detail.patch_size_m = MedianSizeM(room.patches.patches);
  detail.element_size_m = MedianSizeM(room.patches.elements);
  detail.patch_error = Relative(fit, rows, patches) / 3;
  detail.element_error = Relative(fit, rows, elements) / 3;
  detail.model_error = fit.relative_sigma;
  detail.is_compared = true;
  return detail;
}

}  // namespace luxfit
