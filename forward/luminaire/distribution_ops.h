// Lists the distributions of luminaires: one row each, with its intensity and what its callers ask of it.
//
//   int I dOmega = 1 lm, I in cd per lm        (forward/luminaire/luminaire.h has the equations)
//
// A new distribution is a value of Distribution, one file that makes its row (such as
// luminaire/internal/cosine_power_distribution.cc) and the row's line in distribution_ops.cc. No other file tells
// distributions apart by their names. Files that name one make a luminaire of it: a start, a candidate, a table.
//
// Functions take a luminaire of the row's own distribution, for which `missing` returns nullptr. A loop over many
// directions looks its row up once.
#ifndef LUXFIT_FORWARD_LUMINAIRE_DISTRIBUTION_OPS_H_
#define LUXFIT_FORWARD_LUMINAIRE_DISTRIBUTION_OPS_H_

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "forward/luminaire/luminaire.h"

namespace luxfit {

// Returns the intensity by cos(gamma), of distributions that depend on it alone.
using IntensityAboutAim = Intensity (*)(const Luminaire& luminaire, double cosine_gamma);

struct DistributionOps {
  Distribution distribution = Distribution::kLambertian;
  const char* name = "";        // in choices, messages and labels
  const char* photometry = "";  // in sessions and results

  // Fields of Luminaire that it has, and that a fit may free.
  bool has_exponent = false;  // cosine_exponent
  bool has_table = false;     // table; the shares of its nodes
  bool has_aim = true;        // false: the same in all directions, so that no turn changes it

  bool is_tried = false;    // where the distribution is to be estimated
  bool is_diffuse = false;  // I = cos(gamma) / pi: the luminance of a flat surface is the same from all sides
  double last_gamma_deg = 90;  // dark beyond it: 90 or 180; a table has angles of its own

  IntensityAboutAim about_aim = nullptr;  // nullptr: it may depend on C, too
  // Intensity towards a unit vector in world.
  DirectedIntensity (*towards)(const Luminaire& luminaire, const LuminaireAxes& axes,
                               const Eigen::Vector3d& direction) = nullptr;
  // Whether turning it about the aim changes next to nothing.
  bool (*is_symmetric_about_aim)(const Luminaire& luminaire) = nullptr;
  // Whether a flat luminaire may be taken as dark behind.
  bool (*shines_to_one_side)(const Luminaire& luminaire) = nullptr;
  // Exponent of the cosine-power lobe that is as narrow, >= 1.
  double (*sharpness)(const Luminaire& luminaire) = nullptr;
  // Returns the words for a parameter that is missing or out of range, for messages ("a finite exponent above 0"); nullptr: none is.
  const char* (*missing)(const Luminaire& luminaire) = nullptr;
};

// All distributions, in the order of Distribution: those with fewer parameters first.
const std::array<DistributionOps, 4>& Distributions();
const DistributionOps& OpsOf(Distribution distribution);

// Returns about_aim, or that of a table with one plane about the aim. nullptr: the intensity may depend on C.
IntensityAboutAim AboutAimOf(const Luminaire& luminaire);

// The distribution that sessions and results call so; nullptr where none is.
const DistributionOps* FindDistribution(const std::string& photometry);

// Returns the names that sessions use, of all distributions or of those for which `holds` is true.
std::vector<std::string> PhotometryNames(bool (*holds)(const DistributionOps&) = nullptr);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_DISTRIBUTION_OPS_H_
