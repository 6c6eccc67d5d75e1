#include "inverse/model/internal/derivative_columns.h"

#include <algorithm>

namespace luxfit {

DerivativeColumns::DerivativeColumns(const LightState& state, const std::vector<Parameter>& parameters,
                                     const DimmingGroups& groups, bool reflected,
                                     const std::vector<bool>& is_told)
    : lit_(state.luminaires.size()), terms_(parameters.size()) {
  request_.reflected = reflected;
  const Eigen::VectorXd flux = FluxesLm(state.luminaires);
  const auto group_count = static_cast<Eigen::Index>(groups.groups.size());
  std::vector<Eigen::Triplet<float>> of_luminaires;
  for (Eigen::Index g = 0; g < group_count; ++g) {
    const LuminaireGroup& group = groups.groups[static_cast<size_t>(g)];
    for (size_t m = 0; m < group.luminaires.size(); ++m) {
      const int k = group.luminaires[m];
      const double lumens = group.share[m] * flux[k];
      lit_[static_cast<size_t>(k)] = {static_cast<int>(g), lumens};
      of_luminaires.emplace_back(k, static_cast<int>(g), static_cast<float>(lumens));
    }
  }
  const auto is_albedo = [](const Parameter& p) { return p.kind == ParameterKind::kAlbedo; };
  const auto materials = std::count_if(parameters.begin(), parameters.end(), is_albedo);
  for (size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    if (is_told[i]) continue;
    if (p.kind == ParameterKind::kLuminaire) {
      AddLuminaire(p, p.index, i);
      for (const int k : p.tied) AddLuminaire(p, k, i);
    } else if (is_albedo(p)) {
      const auto own = static_cast<Eigen::Index>(request_.materials.size());
      for (Eigen::Index g = 0; g < group_count; ++g) terms_[i].push_back({g, g * materials + own});
      request_.materials.push_back(p.index);
    }
  }
  request_.luminaire_sum.resize(static_cast<Eigen::Index>(lit_.size()), group_count);
  request_.luminaire_sum.setFromTriplets(of_luminaires.begin(), of_luminaires.end());
  request_.parameter_sum.resize(static_cast<Eigen::Index>(request_.parameters.size()), sum_count_);
  request_.parameter_sum.setFromTriplets(sums_.begin(), sums_.end());
}

void DerivativeColumns::AddLuminaire(const Parameter& p, int luminaire, size_t i) {
  const Lit& lit = lit_[static_cast<size_t>(luminaire)];
  if (lit.group < 0) return;
  std::vector<Term>& terms = terms_[i];
  auto term =
      std::find_if(terms.begin(), terms.end(), [&](const Term& known) { return known.group == lit.group; });
  if (term == terms.end()) term = terms.insert(term, Term{lit.group, sum_count_++});
  sums_.emplace_back(static_cast<int>(request_.parameters.size()), static_cast<int>(term->column),
                     static_cast<float>(lit.lumens));
  request_.parameters.push_back({luminaire, p.quantity, p.part});
}

}  // namespace luxfit
