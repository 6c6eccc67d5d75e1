// Exchanges light on the tree of hierarchical radiosity.
//
// Light is gathered over links, pushed to the leaves, reflected and pulled up. Illuminances are in lx,
// exitances in lm/m2.
#ifndef LUXFIT_FORWARD_RADIOSITY_INTERNAL_LIGHT_EXCHANGE_H_
#define LUXFIT_FORWARD_RADIOSITY_INTERNAL_LIGHT_EXCHANGE_H_

#include <vector>

#include "forward/radiosity/internal/directional.h"
#include "forward/radiosity/internal/light_links.h"
#include "forward/radiosity/internal/light_tree.h"

namespace luxfit {

class LightExchange {
 public:
  LightExchange(const LightTree& tree, const std::vector<float>& albedo_by_facet);

  // Makes room for the tree's new nodes; the children of a leaf just cut start with its light.
  void Grow();
  void Inherit(int parent);
  // Sets the light of a leaf. `direct_lx` is the mean over the share `free` (0 to 1) of the leaf that lies in
  // no solid. `landing` is the share of the light leaving from there that meets a reflecting side.
  void SetDirect(int leaf, float direct_lx, float free, float landing) {
    direct_lx_[static_cast<size_t>(leaf)] = direct_lx;
    free_[static_cast<size_t>(leaf)] = free;
    landing_[static_cast<size_t>(leaf)] = landing;
  }
  // Reflects the direct light, and `ambient_lx` besides, a first guess of the light that links will bring.
  void Start(float ambient_lx);
  // Makes one pass over the links (sorted by receiver), then scales all that was received to the flux that
  // left and landed. Links treat a source as even: the light that they lose from its brighter or dimmer parts
  // does not cancel over all receivers. Returns the area mean of |change of exitance|, lm/m2.
  double Gather(const std::vector<LightLink>& links);

  float direct_lx(int leaf) const { return direct_lx_[static_cast<size_t>(leaf)]; }
  float illuminance_lx(int leaf) const {
    const size_t n = static_cast<size_t>(leaf);
    return free_[n] > 0 ? direct_lx_[n] + received_lx_[n] : 0;
  }
  // Return the area mean of the exitance, and its rms deviation (elements only).
  float exitance(int node) const { return exitance_[static_cast<size_t>(node)]; }
  float spread(int node) const { return spread_[static_cast<size_t>(node)]; }
  double MeanIlluminance() const;

 private:
  void Push();
  void Balance(double landing_lm);
  double LandingFlux() const;
  double Reflect();  // leaves, and up from them
  void PullElement(int node);
  void PullCluster(int node);

  const LightTree& tree_;
  const std::vector<float>& albedo_;
  std::vector<DirectionalLight> cosine_;                                             // by facet
  std::vector<float> direct_lx_, received_lx_, exitance_, spread_, free_, landing_;  // by node
  std::vector<DirectionalLight> field_, intensity_;  // by cluster: arriving, leaving
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_INTERNAL_LIGHT_EXCHANGE_H_
