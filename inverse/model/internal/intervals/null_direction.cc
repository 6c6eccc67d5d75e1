#include "inverse/model/internal/intervals/null_direction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

constexpr double kTakesPart = 0.1;

// Lists names: "a", "a and b", "a, b and c".
std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  return text;
}

std::string WordFor(const Parameter& parameter) {
  if (parameter.kind == ParameterKind::kLogFlux) return "flux";
  switch (parameter.quantity) {
    case LuminaireQuantity::kPositionX:
    case LuminaireQuantity::kPositionY:
      return "place";
    case LuminaireQuantity::kPositionZ:
      return "height";
    case LuminaireQuantity::kExponent:
      return "lobe";
    case LuminaireQuantity::kSizeAlong:
    case LuminaireQuantity::kSizeAcross:
      return "size";
    case LuminaireQuantity::kTiltAlong:
    case LuminaireQuantity::kTiltAcross:
    case LuminaireQuantity::kHeading:
      return "aim";
    case LuminaireQuantity::kGammaNode:
    case LuminaireQuantity::kSide:
      return "lobe";
    case LuminaireQuantity::kCell:
      return "emission";
  }
  return "";
}

std::vector<std::string> Unique(const std::vector<std::string>& names) {
  std::vector<std::string> unique;
  for (const std::string& name : names) {
    if (std::find(unique.begin(), unique.end(), name) == unique.end()) unique.push_back(name);
  }
  return unique;
}

// Holds the names that take part, by kind.
struct Parties {
  std::vector<std::string> fluxes, reflectances;   // owners
  std::vector<std::string> luminaires, own_words;  // owners of geometry or flux, and the quantity in words
  bool has_scale = false, has_geometry = false;

  explicit Parties(const std::vector<Parameter>& parameters) {
    for (const Parameter& p : parameters) {
      if (p.kind == ParameterKind::kLogCameraScale) has_scale = true;
      if (p.kind == ParameterKind::kAlbedo) reflectances.push_back(p.owner);
      if (p.kind == ParameterKind::kLogFlux) fluxes.push_back(p.owner);
      has_geometry = has_geometry || p.kind == ParameterKind::kLuminaire;
      if (p.kind == ParameterKind::kLuminaire || p.kind == ParameterKind::kLogFlux) {
        luminaires.push_back(p.owner);
        own_words.push_back(WordFor(p));
      }
    }
    luminaires = Unique(luminaires);
    own_words = Unique(own_words);
  }
};

void Describe(const Parties& parties, NullDirection& direction) {
  if (!parties.reflectances.empty() && parties.luminaires.empty() && !parties.has_scale) {
    direction.meaning =
        "the reflectance of " + Listed(parties.reflectances) + " changes nothing that was measured";
    direction.remedy = "photograph it in a registered view, or give it in [scene.albedo]";
  } else if (!parties.reflectances.empty()) {
    direction.meaning =
        "direct and reflected light are not told apart: " + Listed(NamesOf(direction.parameters)) +
        " trade off";
    direction.remedy =
        "photograph one state with a dark cloth on a surface, or one luminaire alone, or give one "
        "reflectance in "
        "[scene.albedo]";
  } else if (!parties.has_geometry && parties.has_scale) {
    direction.meaning = "the flux of " + Listed(parties.fluxes) +
                        " and the camera's scale are known only up to one common factor";
    direction.remedy =
        "name one reading in luxmeter.scale, at a place in the room, or give camera.cdm2_per_count_s or one "
        "flux_lm";
  } else if (!parties.has_geometry && parties.fluxes.size() > 1) {
    direction.meaning = "the fluxes of " + Listed(parties.fluxes) + " are known only together";
    direction.remedy =
        "photograph or read a state in which they are dimmed differently, or one of them alone";
  } else if (parties.luminaires.size() == 1 && !parties.has_scale) {
    direction.meaning = Listed(parties.own_words) + " of " + parties.luminaires.front() +
                        (parties.own_words.size() > 1 ? " trade off" : " changes nothing that was measured");
    direction.remedy = "add readings or views nearer to " + parties.luminaires.front() +
                       " and to its sides, or give its photometry, position_m or shape";
  } else {
    direction.meaning = Listed(NamesOf(direction.parameters)) + " trade off";
    direction.remedy = "more readings or views, one luminaire switched alone, or give what is known of them";
  }
}

}  // namespace

NullDirection DescribeNullDirection(const std::vector<Parameter>& parameters,
                                    const Eigen::VectorXd& direction) {
  if (direction.size() != static_cast<Eigen::Index>(parameters.size()))
    throw std::invalid_argument("DescribeNullDirection: expected one entry a parameter");
  std::vector<size_t> order;
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (std::abs(direction[static_cast<Eigen::Index>(i)]) > kTakesPart) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return std::abs(direction[static_cast<Eigen::Index>(a)]) >
           std::abs(direction[static_cast<Eigen::Index>(b)]);
  });
  NullDirection result;
  std::vector<Parameter> parties;
  for (const size_t i : order) {
    parties.push_back(parameters[i]);
    result.parameters.push_back(parameters[i].id());
  }
  Describe(Parties(parties), result);
  return result;
}

}  // namespace luxfit
