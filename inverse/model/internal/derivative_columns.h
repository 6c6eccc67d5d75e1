// Maps each parameter of a fit to columns of the light's derivatives.
//
// The light of luminaires that are dimmed in one proportion (inverse/model/internal/dimming_groups.h), or that share a
// number of their type, is added up before it is reflected: a row sees their sum alone. Twenty panels in four
// rows need the columns of four luminaires for each reflectance and for each number of their type. A column holds
// lx at the group's full dimming.
//
// Sizes that rows of outlines depend on have no columns: light far from a luminaire hardly depends on its size, so that small errors of
// its distribution or of reflectances would make it tell a wrong one, as surely as its rows are many. Information is cut
// between the two kinds of rows.
//
// Source: Liu, Bayarri and Berger (2009), "Modularization in Bayesian analysis".
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_DERIVATIVE_COLUMNS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_DERIVATIVE_COLUMNS_H_

#include <Eigen/SparseCore>
#include <vector>

#include "forward/light/illuminance.h"
#include "inverse/model/internal/dimming_groups.h"
#include "inverse/model/light_state.h"

namespace luxfit {

class DerivativeColumns {
 public:
  struct Term {
    Eigen::Index group = 0, column = 0;
  };

  // `reflected`: DerivativeRequest::reflected. `is_told`: the parameters that outlines tell, so that light need not.
  DerivativeColumns(const LightState& state, const std::vector<Parameter>& parameters,
                    const DimmingGroups& groups, bool reflected, const std::vector<bool>& is_told);

  const DerivativeRequest& request() const { return request_; }
  // Returns the columns of d_luminaire or d_albedo whose sum, each times its group's dimming, is the derivative of
  // the light by the parameter. Empty: the light does not depend on it, or by its flux.
  const std::vector<Term>& Of(size_t parameter) const { return terms_[parameter]; }

 private:
  struct Lit {
    int group = -1;  // never on
    double lumens = 0;
  };
  void AddLuminaire(const Parameter& p, int luminaire, size_t i);

  DerivativeRequest request_;
  std::vector<Lit> lit_;  // by luminaire
  std::vector<std::vector<Term>> terms_;
  std::vector<Eigen::Triplet<float>> sums_;
  Eigen::Index sum_count_ = 0;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_DERIVATIVE_COLUMNS_H_
