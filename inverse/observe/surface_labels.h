// Tells in which views an element of the mesh shows itself, and in which something else stands before it.
//
//   ln Y_evs = mu_es + c_ev + r_evs + noise      z_ev = 1: the element;   c ~ N(0, c^2), r ~ N(0, r^2)
//   ln Y_evs = mu_es + k_ev + l_evs + noise      z_ev = 0: something else; k ~ N(0, c^2 + k^2), l ~ N(0, r^2 + l^2)
//   ln p(z_v) = sum_e h z_ev + sum_(e~f) b [z_ev = z_fv] + const      neighbours in a photo agree (Potts)
//
// Y_evs: luminance of element e in view v and state s; mu: the element's own. Furniture that the mesh lacks, a
// highlight, a person: each shows in some views of an element and not in others, in all states at once. What views
// agree on is the element; so labels need no light and no reflectance. c, r: scatter of views of one surface
// (registration, interpolation within the element), robust. k, l, h: by expectation-maximisation.
//
// The posterior of the labels of one element runs over its views as candidates of mu and over "none of them":
//   w_a ~ p_a / m_a prod_(b != a) (p_b N_ab + (1 - p_b) M_ab)      N, M: densities of both rows above, m_a: views that agree
//   w_0 ~ mean_a (1 - p_a) prod_(b != a) (1 - p_b) M_ab            p: prior by the neighbours, mean field
// Where two views of an element disagree and neighbours do not help, each is own with less than one half.
//
// Sources: Dempster, Laird, Rubin (1977); Potts (1952); Zhang, Brady, Smith (2001), IEEE TMI 20(1), hidden Markov
// random fields by EM with mean fields. The model of the element's views is the house's.
#ifndef LUXFIT_INVERSE_OBSERVE_SURFACE_LABELS_H_
#define LUXFIT_INVERSE_OBSERVE_SURFACE_LABELS_H_

#include <vector>

#include "forward/light/room.h"
#include "inverse/observe/observe.h"

namespace luxfit {

struct ElementView {
  int element = 0;
  int view = 0;
  double own_probability = 1;  // that the view shows the element itself
};

struct SurfaceLabels {
  std::vector<ElementView> views;  // by element, then view
  bool is_estimated = false;  // false: too few elements are shared by views, and all are taken as their own
  double common_sigma = 0;    // c, of ln Y
  double state_sigma = 0;     // r, of ln Y
  double other_share = 0;     // of all views of elements that show something else
};

SurfaceLabels LabelSurfaces(const Room& room, const std::vector<Observation>& observations);

// Returns the observations of elements that show themselves: own_probability > 1/2.
std::vector<Observation> OfOwnSurface(const std::vector<Observation>& observations,
                                      const SurfaceLabels& labels);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_SURFACE_LABELS_H_
