// Identifies the parameters of the light model, in code and in files.
//
// An id says what a parameter is and to which owner it belongs: a quantity of a luminaire, its flux, a
// material's reflectance, a scale. It means the same in another fit of the same room. NameOf writes it for
// people; no code reads such a name back.
#ifndef LUXFIT_INVERSE_MODEL_PARAMETER_H_
#define LUXFIT_INVERSE_MODEL_PARAMETER_H_

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "forward/light/illuminance.h"

namespace luxfit {

enum class ParameterKind {
  kLuminaire,
  kLogFlux,
  kAlbedo,
  kLogCameraScale,
  kLogMeterScale,
  kLogSensorGain,
  kAmbientShare
};

// Returns whether the quantity is a share of one of several parts: kGammaNode, kCell and kSide.
bool HasParts(LuminaireQuantity quantity);

struct ParameterId {
  ParameterKind kind = ParameterKind::kLuminaire;
  std::string
      owner;  // id of the luminaire, name of the material, number of the sensor or state; empty for scales
  LuminaireQuantity quantity = LuminaireQuantity::kPositionX;  // for kLuminaire
  int part = 0;                                                // where HasParts
};
bool operator==(const ParameterId& a, const ParameterId& b);
bool operator!=(const ParameterId& a, const ParameterId& b);

// Returns a name for people: "position x of A", "log flux of A", "albedo of floor".
std::string NameOf(const ParameterId& id);
std::vector<std::string> NamesOf(const std::vector<ParameterId>& ids);

// Convert to and from the words of files: "luminaire", "log_flux", "position_x", "size_along", ... Other
// words give none.
std::string ToString(ParameterKind kind);
std::optional<ParameterKind> ParameterKindFrom(const std::string& word);
std::string ToString(LuminaireQuantity quantity);
std::optional<LuminaireQuantity> LuminaireQuantityFrom(const std::string& word);

// Holds the directions from which tilts and headings count: unit vectors in world, across = aim x along.
struct AimFrame {
  Eigen::Vector3d aim{0, 0, -1}, along{1, 0, 0}, across{0, -1, 0};
};

// Describes one free parameter of a fit.
struct Parameter {
  ParameterKind kind = ParameterKind::kLuminaire;
  int index = 0;  // index of the luminaire, the material, the sensor or the state
  LuminaireQuantity quantity = LuminaireQuantity::kPositionX;
  double lower = 0, upper = 0;
  std::string owner;  // as in ParameterId
  // Where HasParts: the value is the share of `part` over that of `reference`. The reference is the
  // largest at the start and not a parameter itself.
  int part = 0, reference = 0;
  // For kTiltAlong, kTiltAcross and kHeading: the luminaire's frame when the parameter was made.
  AimFrame frame = {};
  std::vector<int> tied = {};  // other luminaires of the same type, which share the quantity

  ParameterId id() const { return {kind, owner, quantity, part}; }
  // Returns whether it is that quantity of that owner. `of` is compared for kLuminaire only.
  bool Is(ParameterKind of_kind, int of_index, LuminaireQuantity of) const {
    return kind == of_kind && index == of_index && (kind != ParameterKind::kLuminaire || quantity == of);
  }
  // Returns whether it changes that luminaire, material or sensor.
  bool Concerns(int of_index) const {
    return index == of_index || std::find(tied.begin(), tied.end(), of_index) != tied.end();
  }
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_PARAMETER_H_
