// Finds how readings were probably taken, where they disagree with the light of a fit as they are given.
//
//   r_i = (y_i - g E(p_i, n_i, s_i)) / sigma_i,   sigma_i^2 = sigma_measured^2 + (q g E)^2        lx
//   score = mean min(r^2, 9), by place:   as given, and under each explanation
//
// y: measured. E: the fitted light at a place p, facing n, in state s. q: the predictions' relative sigma. g: the factor
// of the light that the readings which set the scale ask for; 1 where something else sets it. An explanation changes
// places, directions, states or the scale of the readings (inverse/check/internal/misreading.h). A place outside the
// room counts as 3 sigmas.
//
// An explanation holds where it passes the rule of all choices (inverse/select/one_standard_error.h) with two standard
// errors and half of the score, as contradictions of what is given do, and where its own score is below 3. What it has
// free is chosen by the readings of the other places. Explanations that the best one does not refuse by the same rule,
// or whose score is what chance gives, are returned beside it: they explain the readings equally. Readings that set the
// scale are wrong only where the others of their state are right.
//
// Fewer than four places tell nothing. The light must not rest on the readings that are explained: a fit to readings
// alone has followed their error. An error that all readings share is seen only where something else sets the scale.
//
// Source: the rule's; Efron and Tibshirani (1993), ch. 17 (prediction error on data left out).
#ifndef LUXFIT_INVERSE_CHECK_EXPLAIN_READINGS_H_
#define LUXFIT_INVERSE_CHECK_EXPLAIN_READINGS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "forward/direct/sensor.h"

namespace luxfit {

struct ReadingAsGiven {
  std::string id;  // of the place
  Sensor sensor;
  int state = 0;
  double measured_lx = 0;
  double sigma_lx = 0;  // of the measurement
  bool sets_scale = false;
};

// Says what sets the absolute scale of a light.
enum class ScaleSource {
  kReadings,  // those of ReadingAsGiven::sets_scale
  kOther,     // a calibrated camera or a known flux
  kNone,
};

// Holds a light whose readings are explained.
struct ExplainingLight {
  // Returns E, places x states, lx. NaN: the place is not in the room.
  std::function<Eigen::MatrixXd(const std::vector<Sensor>& places)> in_states;
  // Returns the height, m, of what a meter laid down at (x, y) would lie on; NaN where nothing is.
  std::function<double(double x, double y)> top_m;
  std::vector<std::string> states;
  Eigen::AlignedBox3d bounds;  // of the room
  double relative_sigma = 0;   // q
  ScaleSource scale = ScaleSource::kReadings;
};

struct ReadingExplanation {
  std::string as_if;   // completes "the readings look as if ..."
  std::string remedy;  // a clause without a full stop
  // Root mean square errors in percent of the mean reading, of the readings whose places are in the room; NaN where
  // nothing is predicted.
  double rms_percent_as_given = 0, rms_percent = 0;
  int places = 0, places_outside_as_given = 0, places_outside = 0;
  // Returns a reading as it would be, measured or not. Empty where nothing tells which of the readings are wrong.
  std::function<ReadingAsGiven(ReadingAsGiven)> so_read;
};

// Returns the explanations that hold, the best first; none where the readings agree as they are given, or nothing explains
// them. `readings`: measured ones, of states whose light is known.
std::vector<ReadingExplanation> ExplainReadings(const ExplainingLight& light,
                                                const std::vector<ReadingAsGiven>& readings);

// Says in one sentence, without a full stop, what explains the readings. `explanations`: one or more.
std::string InWords(const std::vector<ReadingExplanation>& explanations);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHECK_EXPLAIN_READINGS_H_
