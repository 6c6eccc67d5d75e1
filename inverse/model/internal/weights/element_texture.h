// Estimates how the reflectance of single elements departs from their material's: posters, carpets, wood, and
// whatever hides an element in all states alike.
//
//   Y_es = rho_m (1 + t_e) I_es,   t_e ~ N(0, tau_m^2)
//   t_e = sum_s u^2 m (Y - m) / (1 / tau^2 + sum_s u^2 m^2)          u: root weight of a row, m: its model at t = 0
//
// The states of one element share t_e. The fit eliminates it (inverse/model/internal/weights/row_whitening.h): ratios
// between states then tell the luminaires, which is near-field photometric stereo. One state alone cannot
// tell t_e from the light.
//
// rho_m is the mean over the elements that photos show, so their t_e have the mean 0. They are nearly the
// whole surface: the mean is known as well as that of plain paint. One row a material says so beside the
// whitened rows:
//   sum_e E[t_e | rows] / n = 0 +- sqrt(sum_e Var[t_e | rows]) / n
//
// tau_m is estimated for each material from the elements that at least two states show: the median normalised
// |t_e| is to be a Gaussian's. It is 0 where at least half of the elements, all but strays, scatter no more
// than their rows' errors say (one-sided, 99 %): plain paint costs nothing. An element more than kStraySigmas
// off (a poster on plain paint) gets a variance of its own, a ninth of its t_e^2: it keeps its ratios and
// loses its say on the material's reflectance, as with Cauchy's loss. Strays of plain materials have no such
// row.
//
// Sources: Golub and Pereyra (1973); Quéau et al. (2018), "LED-based photometric stereo" (ratios against
// albedo); Rousseeuw and Croux (1993) (scale by medians).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_ELEMENT_TEXTURE_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_ELEMENT_TEXTURE_H_

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/light_state.h"

namespace luxfit {

// Holds t_e and its prior's sigma for every row; 0 for rows that are no photo's.
struct ElementTexture {
  Eigen::VectorXd deviation, sigma;
  Eigen::VectorXd sigma_of_material;  // tau
};

// Says that a material's texture has the mean 0, for errors e of the rows weighted by their root weights:
//   sum_i coefficient_i e_i,   1 sigma
struct TextureMean {
  std::vector<std::pair<Eigen::Index, double>> terms;
};

constexpr double kStraySigmas = 3;
constexpr double kLeastDeparture = 0.003;

class TextureEstimator {
 public:
  TextureEstimator(const Room& room, const LightData& data);

  // Returns the texture for the model's values at t = 0 and the measured ones. `root_weight`: sqrt(weight) /
  // sigma of each row, 0 for rows that the fit leaves out.
  ElementTexture Estimate(const Eigen::VectorXd& model, const Eigen::VectorXd& measured,
                          const Eigen::VectorXd& root_weight) const;
  // Returns one row for each textured material. `model` and `root_weight` as in Estimate.
  std::vector<TextureMean> Means(const Eigen::VectorXd& model, const Eigen::VectorXd& root_weight,
                                 const ElementTexture& texture) const;
  // Returns the mean of 1 + t_e over the observed elements of each patch, 1 where there are none. Empty where
  // it departs from 1 by less than kLeastDeparture of the room's surface: the light then hardly notices.
  Eigen::VectorXd PatchFactors(const Room& room, const ElementTexture& texture) const;
  // Returns no texture.
  static ElementTexture None(Eigen::Index rows, Eigen::Index materials);

  // Rows of each observed element.
  const std::vector<std::vector<Eigen::Index>>& rows_of_element() const { return rows_; }

 private:
  std::vector<std::vector<Eigen::Index>> rows_;
  std::vector<int> material_, patch_;  // by element, as in rows_
  Eigen::Index materials_ = 0;
  bool has_several_states_ = false;  // for any element
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_ELEMENT_TEXTURE_H_
