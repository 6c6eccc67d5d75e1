// Holds whether readings alone tell direct light from light that the walls reflect.
//
//   share = sum_i D_i / sum_i E_i        D: direct part of reading i, E: all of it, over the readings fitted
//
// The interval holds the shares of all models that the readings admit. The share is determined where the
// interval is narrow. inverse/choose/internal/profile_direct_share.h explains the method.
#ifndef LUXFIT_INVERSE_CHOOSE_DIRECT_SHARE_H_
#define LUXFIT_INVERSE_CHOOSE_DIRECT_SHARE_H_

#include <string>
#include <vector>

namespace luxfit {

struct DirectShareCandidate {
  std::string name;
  double share = 0, sigma = 0;
  double rms = 0;  // rms of residuals over sigma, with one model error for all candidates
  bool is_admissible = false;
};

struct DirectShare {
  double share = 0;             // share by the fit
  double lower = 0, upper = 1;  // 95 %
  bool is_determined = false;
  std::vector<DirectShareCandidate> candidates;  // the fit comes first
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_DIRECT_SHARE_H_
