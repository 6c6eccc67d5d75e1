#include "forward/light/element_albedo.h"

#include <algorithm>

#include "forward/radiosity/transport.h"

namespace luxfit {

Eigen::VectorXf ElementAlbedo(const Patches& patches, const Eigen::VectorXd& albedo,
                              const Eigen::VectorXd& patch_factor) {
  Eigen::VectorXf of_elements(static_cast<Eigen::Index>(patches.elements.size()));
  for (Eigen::Index e = 0; e < of_elements.size(); ++e) {
    const int patch = patches.elements[static_cast<size_t>(e)].patch;
    double rho = albedo[patches.patches[static_cast<size_t>(patch)].material];
    if (patch_factor.size() > 0) rho = std::min(rho * patch_factor[patch], Transport::kMostReflectance);
    of_elements[e] = static_cast<float>(rho);
  }
  return of_elements;
}

}  // namespace luxfit
