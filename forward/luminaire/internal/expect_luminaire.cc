#include "forward/luminaire/internal/expect_luminaire.h"

#include <cmath>
#include <string>

#include "forward/luminaire/distribution_ops.h"
#include "forward/room/internal/expect_valid.h"

namespace luxfit {
namespace {

void ExpectLuminaire(const Luminaire& luminaire, const std::string& name) {
  ExpectThat(luminaire.position.allFinite(), name, "a finite position");
  ExpectThat(luminaire.aim.allFinite() && luminaire.aim.norm() > 0, name, "a finite aim other than 0");
  ExpectThat(luminaire.heading.allFinite(), name, "a finite heading");
  ExpectThat(luminaire.size_m.allFinite() && (luminaire.size_m.array() >= 0).all(), name,
             "a finite size >= 0");
  ExpectThat(std::isfinite(luminaire.flux_lm), name, "a finite flux");
  const char* const missing = OpsOf(luminaire.distribution).missing(luminaire);
  ExpectThat(missing == nullptr, name, missing);
  ExpectThat(luminaire.emission.size() == 0 ||
                 ((luminaire.emission >= 0).all() && std::abs(luminaire.emission.sum() - 1) < 1e-6),
             name, "shares of cells >= 0 that sum to 1");
}

}  // namespace

void ExpectValid(const Luminaire& luminaire) {
  ExpectLuminaire(luminaire, "luminaire \"" + luminaire.id + "\"");
}

void ExpectValid(const std::vector<Luminaire>& luminaires) {
  for (size_t k = 0; k < luminaires.size(); ++k)
    ExpectLuminaire(luminaires[k], "luminaire " + std::to_string(k) + " (\"" + luminaires[k].id + "\")");
}

}  // namespace luxfit
