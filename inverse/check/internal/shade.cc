#include "inverse/check/internal/shade.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace luxfit {
namespace {

class Shades {
 public:
  Shades(const std::vector<NamedReading>& readings, double factor, double z_limit)
      : readings_(readings), factor_(factor), z_limit_(z_limit) {}

  std::vector<std::string> Run() const {
    std::vector<std::string> shading;
    std::map<std::string, std::set<std::string>> lit, shaded;  // places by luminaire
    shading.reserve(readings_.size());
    for (const NamedReading& named : readings_) {
      shading.push_back(LuminaireOf(named));
      if (!shading.back().empty()) shaded[shading.back()].insert(named.id);
      for (const auto& [id, direct_lx] : named.direct_lx)
        if (factor_ * direct_lx > ChanceLx(named)) lit[id].insert(named.id);
    }
    for (std::string& luminaire : shading)
      if (!luminaire.empty() && 3 * shaded[luminaire].size() >= lit[luminaire].size()) luminaire.clear();
    std::vector<std::string> all = shading;
    for (size_t i = 0; i < readings_.size(); ++i)
      if (all[i].empty()) all[i] = OfOtherStates(readings_[i], shading);
    return all;
  }

 private:
  double ChanceLx(const NamedReading& named) const {
    return z_limit_ * std::hypot(named.reading.measured_sigma_lx, named.reading.predicted_sigma_lx);
  }
  double MissingLx(const NamedReading& named) const {
    return factor_ * named.reading.predicted_lx - named.reading.measured_lx;
  }

  // Returns whether the luminaire's light arrives in another state.
  bool IsRefuted(const std::string& place, const std::string& luminaire) const {
    return std::any_of(readings_.begin(), readings_.end(), [&](const NamedReading& other) {
      return other.id == place &&
             std::any_of(other.direct_lx.begin(), other.direct_lx.end(), [&](const auto& of) {
               return of.first == luminaire && factor_ * of.second - MissingLx(other) > ChanceLx(other);
             });
    });
  }

  bool IsInShade(const NamedReading& named, const std::string& luminaire, double direct_lx) const {
    constexpr double kLeastShare = 2.0 / 3;
    const double missing_lx = MissingLx(named);
    return missing_lx > ChanceLx(named) && direct_lx >= kLeastShare * missing_lx &&
           !IsRefuted(named.id, luminaire);
  }

  std::string LuminaireOf(const NamedReading& named) const {
    std::string luminaire;
    double least_lx = 0;
    for (const auto& [id, given_lx] : named.direct_lx) {
      const double left_lx = std::abs(MissingLx(named) - factor_ * given_lx);
      if (!IsInShade(named, id, factor_ * given_lx) || (!luminaire.empty() && left_lx >= least_lx)) continue;
      luminaire = id, least_lx = left_lx;
    }
    return luminaire;
  }

  // Names the luminaire that the place is in the shade of in another state. One thing may hide parts of several luminaires: a state
  // with all of them then misses more light than one of them gives.
  std::string OfOtherStates(const NamedReading& named, const std::vector<std::string>& shading) const {
    if (MissingLx(named) <= ChanceLx(named)) return "";
    for (size_t i = 0; i < readings_.size(); ++i) {
      const auto is_on = [&](const auto& of) { return of.first == shading[i] && of.second > 0; };
      if (readings_[i].id == named.id && !shading[i].empty() &&
          std::any_of(named.direct_lx.begin(), named.direct_lx.end(), is_on))
        return shading[i];
    }
    return "";
  }

  const std::vector<NamedReading>& readings_;
  double factor_, z_limit_;
};

}  // namespace

std::vector<std::string> ShadingLuminaires(const std::vector<NamedReading>& readings, double factor,
                                           double z_limit) {
  return Shades(readings, factor, z_limit).Run();
}

}  // namespace luxfit
