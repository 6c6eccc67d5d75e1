#include "inverse/choose/internal/detail/colour_detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/choose/internal/left_out.h"
#include "inverse/model/internal/measured_indirect.h"

namespace luxfit {
namespace {

constexpr int kMaxColourElements = 1000;
constexpr int kMinRows = 20;
constexpr size_t kFewColouredFacets = 8, kFewPatches = 40;
constexpr double kLeastColourSigma = 5e-4;  // for a ratio of channels

// Holds one channel of one observation.
struct Row {
  int channel = 0, material = 0, facet = 0, patch = 0, element = 0;
  int luminaire = -1;  // index of the only luminaire that is on
  bool is_left_out = false;
  int group = 0;                    // rows of one group share their errors
  double value = 0, grey = 0;       // value of the channel; as predicted for grey surfaces
  double indirect = 0, direct = 0;  // for a white surface
};

int OnlyLuminaire(const Eigen::VectorXd& dimming) {
  int lit = -1;
  for (int k = 0; k < static_cast<int>(dimming.size()); ++k) {
    if (dimming[k] > 0) lit = lit < 0 ? k : -2;
    if (lit == -2) return -1;
  }
  return lit;
}

LightData InChannel(LightData data, Eigen::Index channel) {
  for (Observation& o : data.observations) o.relative_luminance = o.relative_rgb[channel];
  return data;
}

std::vector<Row> RowsOf(const Room& room, const LightData& data, const LuminaireFit& fit) {
  const LightData measured = WithMeasuredIndirect(room, data);
  std::array<LightData, 3> channels;
  for (size_t c = 0; c < 3; ++c)
    channels[c] = WithMeasuredIndirect(room, InChannel(data, static_cast<Eigen::Index>(c)));
  std::map<int, int> order;
  for (const Observation& o : data.observations) order.emplace(o.element, 0);
  int count = 0;
  for (auto& [element, number] : order) number = count++;
  const int stride = std::max(1, (count + kMaxColourElements - 1) / kMaxColourElements);
  std::vector<Row> rows;
  rows.reserve(3 * data.observations.size() / static_cast<size_t>(stride));
  for (size_t i = 0; i < data.observations.size(); ++i) {
    const Observation& o = measured.observations[i];
    const bool is_used = fit.weight[static_cast<Eigen::Index>(i)] > 0;
    if (!is_used || order.at(o.element) % stride != 0 || !(o.relative_rgb.minCoeff() > 0)) continue;
    const Patch& patch = room.patches.PatchOf(o.element);
    Row row;
    row.material = patch.material;
    row.facet = patch.facet;
    row.patch = room.patches.elements[static_cast<size_t>(o.element)].patch;
    row.luminaire = OnlyLuminaire(data.dimming[static_cast<size_t>(o.state)]);
    row.element = o.element;
    const double rho = fit.state.albedo[row.material];
    row.direct = std::max(0.0, o.relative_luminance / rho - o.relative_indirect);
    for (size_t c = 0; c < 3; ++c) {
      row.channel = static_cast<int>(c);
      row.value = o.relative_rgb[row.channel];
      row.indirect = channels[c].observations[i].relative_indirect;
      row.grey = rho * (row.indirect + row.direct);
      rows.push_back(row);
    }
  }
  return rows;
}

// FactorsOf returns the median of each key's ratios of value to model; FactorOf gives 1 for a key without
// any.
using Ratios = std::map<int, std::vector<double>>;
using Factors = std::map<int, double>;
Factors FactorsOf(const Ratios& ratios) {
  Factors factors;
  for (const auto& [key, list] : ratios) factors[key] = Median(list);
  return factors;
}
// Returns the relative sigma of a median of ratios, of which `independent` have errors of their own.
double SigmaOfMedian(const std::vector<double>& ratios, size_t independent) {
  const double median = Median(ratios);
  std::vector<double> deviations;
  deviations.reserve(ratios.size());
  for (const double ratio : ratios) deviations.push_back(std::abs(ratio / median - 1));
  constexpr double kMedianOverMean = 1.2533;  // of normal errors
  return kMedianOverMean * kSigmaPerMad * Median(std::move(deviations)) /
         std::sqrt(static_cast<double>(independent));
}
double FactorOf(const Factors& factors, int key) {
  const auto found = factors.find(key);
  return found == factors.end() ? 1 : found->second;
}

// Leaves out every fifth patch; where patches are few, as on small furniture, every fifth element. Rows are
// judged by facets where there are enough of them.
void Cut(std::vector<Row>& rows) {
  std::set<int> facets, patches;
  for (const Row& row : rows) {
    facets.insert(row.facet);
    patches.insert(row.patch);
  }
  const auto piece_of = [&](const Row& row) {
    return patches.size() < kFewPatches ? row.element : row.patch;
  };
  std::map<int, int> number;
  for (const Row& row : rows) number.emplace(piece_of(row), 0);
  int count = 0;
  for (auto& [piece, n] : number) n = count++;
  for (Row& row : rows) {
    row.is_left_out = IsLeftOut(number.at(piece_of(row)));
    row.group = facets.size() < kFewColouredFacets ? piece_of(row) : row.facet;
  }
}

// Scores the rows left out. `modelled` has one value for each row.
GroupScores Score(const std::vector<Row>& rows, const std::vector<double>& modelled, double sigma) {
  GroupScores scores;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].is_left_out) continue;
    scores[rows[i].group].Add((modelled[i] / rows[i].value - 1) / sigma);
  }
  return scores;
}

double SigmaOf(const std::vector<Row>& rows, const std::vector<double>& modelled) {
  std::vector<double> relative;
  relative.reserve(rows.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].is_left_out) relative.push_back(std::abs(modelled[i] / rows[i].value - 1));
  }
  return relative.empty() ? kLeastColourSigma
                          : std::max(kLeastColourSigma, kSigmaPerMad * Median(std::move(relative)));
}

bool IsEnough(const std::vector<Row>& rows) {
  const auto out = std::count_if(rows.begin(), rows.end(), [](const Row& r) { return r.is_left_out; });
  return out >= kMinRows && static_cast<std::ptrdiff_t>(rows.size()) - out >= kMinRows;
}

DetailChoice CompareMaterial(std::vector<Row> rows) {
  Cut(rows);
  if (!IsEnough(rows)) return {};
  Ratios ratios;
  for (const Row& row : rows) {
    if (!row.is_left_out) ratios[row.channel].push_back(row.value / row.grey);
  }
  const Factors factors = FactorsOf(ratios);
  std::vector<double> grey, coloured;
  grey.reserve(rows.size());
  coloured.reserve(rows.size());
  for (const Row& row : rows) {
    grey.push_back(row.grey);
    coloured.push_back(FactorOf(factors, row.channel) * row.grey);
  }
  const double sigma = SigmaOf(rows, coloured);
  return ChooseDetail({"grey", "coloured"}, {Score(rows, grey, sigma), Score(rows, coloured, sigma)});
}

// Compares tints on rows with one luminaire on. Both models free reflectances by material and channel.
void CompareLuminaires(std::vector<Row> rows, ColourDetail& detail) {
  rows.erase(std::remove_if(rows.begin(), rows.end(), [](const Row& r) { return r.luminaire < 0; }),
             rows.end());
  Cut(rows);
  std::map<int, int> seen;
  for (const Row& row : rows) ++seen[row.luminaire];
  if (seen.size() < 2 || !IsEnough(rows)) return;
  const auto material_key = [](const Row& r) { return 3 * r.material + r.channel; };
  Ratios ratios;
  for (const Row& row : rows) {
    if (!row.is_left_out) ratios[material_key(row)].push_back(row.value / row.grey);
  }
  const Factors reflectance = FactorsOf(ratios);
  // Tints and reflectances are found in turn, by medians with the other held. Where a few luminaires differ,
  // the first reflectances are a mixture.
  constexpr int kTurns = 4;
  Factors tints, refitted = reflectance;
  Ratios direct;
  const auto tint_of = [&](const Row& row) { return FactorOf(tints, 3 * row.luminaire + row.channel); };
  // The tint applies to the direct light; the measured indirect light contains it already.
  const auto tinted = [&](const Row& row) {
    return row.grey / (row.indirect + row.direct) * (row.indirect + tint_of(row) * row.direct);
  };
  for (int turn = 0; turn < kTurns; ++turn) {
    Ratios again;
    direct.clear();
    for (const Row& row : rows) {
      if (row.is_left_out || row.direct <= row.indirect) continue;
      const double rho = row.grey / (row.indirect + row.direct) * FactorOf(refitted, material_key(row));
      direct[3 * row.luminaire + row.channel].push_back((row.value - rho * row.indirect) /
                                                        (rho * row.direct));
    }
    tints = FactorsOf(direct);
    for (const Row& row : rows) {
      if (!row.is_left_out) again[material_key(row)].push_back(row.value / tinted(row));
    }
    refitted = FactorsOf(again);
  }
  std::vector<double> alike, own;
  alike.reserve(rows.size());
  own.reserve(rows.size());
  for (const Row& row : rows) {
    alike.push_back(FactorOf(reflectance, material_key(row)) * row.grey);
    own.push_back(FactorOf(refitted, material_key(row)) * tinted(row));
  }
  const double sigma = SigmaOf(rows, own);
  detail.luminaires =
      ChooseDetail({"alike", "each its own"}, {Score(rows, alike, sigma), Score(rows, own, sigma)});
  std::map<int, std::set<int>> patches;
  for (const Row& row : rows) patches[row.luminaire].insert(row.patch);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& [luminaire, count] : seen) {
    for (int c = 0; c < 3; ++c) {
      const int key = 3 * luminaire + c;
      detail.tint(c, luminaire) = FactorOf(tints, key);
      if (const auto seen_by = direct.find(key); seen_by != direct.end())
        detail.tint_sigma(c, luminaire) = SigmaOfMedian(seen_by->second, patches.at(luminaire).size());
    }
    mean += detail.tint.col(luminaire) / static_cast<double>(seen.size());
  }
  for (const auto& [luminaire, count] : seen)
    detail.tint.col(luminaire) = detail.tint.col(luminaire).cwiseQuotient(mean);
}

void FindNeutralLight(const std::vector<Row>& rows, const std::vector<int>& neutral, ColourDetail& detail) {
  const bool differ = !detail.luminaires.among.empty() && detail.luminaires.chosen != 0;
  Ratios ratios;
  std::set<int> patches;
  for (const Row& row : rows) {
    const bool is_neutral = std::find(neutral.begin(), neutral.end(), row.material) != neutral.end();
    if (!is_neutral || row.direct <= row.indirect || (differ && row.luminaire < 0)) continue;
    const double tint = differ ? detail.tint(row.channel, row.luminaire) : 1;
    const double rho = row.grey / (row.indirect + row.direct),
                 light = (row.value / rho - row.indirect) / (tint * row.direct);
    if (!(light > 0)) continue;
    ratios[row.channel].push_back(light);
    patches.insert(row.patch);
  }
  for (const auto& [channel, of_channel] : ratios) {
    if (of_channel.size() < kMinRows) continue;
    detail.neutral_light[channel] = Median(of_channel);
    detail.neutral_light_sigma[channel] = SigmaOfMedian(of_channel, patches.size());
  }
}

}  // namespace

ColourDetail CompareColours(const Room& room, const LightData& data, const LuminaireFit& fit,
                            const std::vector<int>& neutral) {
  ColourDetail detail;
  const size_t materials = room.scene.materials.size();
  detail.materials.resize(materials);
  detail.tint.setConstant(3, static_cast<Eigen::Index>(fit.state.luminaires.size()),
                          std::numeric_limits<double>::quiet_NaN());
  detail.tint_sigma = detail.tint;
  detail.neutral_light.setConstant(std::numeric_limits<double>::quiet_NaN());
  detail.neutral_light_sigma = detail.neutral_light;
  if (!fit.IsUsable() || data.observations.empty()) return detail;
  const std::vector<Row> rows = RowsOf(room, data, fit);
  std::vector<std::vector<Row>> of_material(materials);
  for (const Row& row : rows) of_material[static_cast<size_t>(row.material)].push_back(row);
  for (size_t m = 0; m < materials; ++m) {
    if (fit.state.albedo_free[m]) detail.materials[m] = CompareMaterial(of_material[m]);
  }
  CompareLuminaires(rows, detail);
  FindNeutralLight(rows, neutral, detail);
  return detail;
}

}  // namespace luxfit
