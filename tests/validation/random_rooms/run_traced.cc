#include "tests/validation/random_rooms/run_traced.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "apps/stages/check/check_warnings.h"
#include "apps/stages/check/explain_check.h"
#include "apps/stages/observe/explained_photos.h"
#include "inverse/fit/explaining_light.h"
#include "inverse/observe/as_if/internal/explained_observations.h"
#include "inverse/observe/state_conflicts.h"

namespace luxfit {
namespace {

void WarnOfPhotos(const std::vector<PhotoAsIf>& found, Findings& findings) {
  for (const PhotoAsIf& p : found) {
    const std::string name = PhotoName(p.view, p.state), other = PhotoName(p.view, p.as_if);
    if (!p.is_exchanged)
      findings.warnings.push_back({"photos_as_if", name + " looks as if it was " + other, ""});
    else if (p.state < p.as_if)
      findings.warnings.push_back({"photos_as_if", name + " and " + other + " look exchanged", ""});
  }
}

void LeaveOutOutlines(const std::vector<PhotoAsIf>& found, RoomObservations& given) {
  const auto is_of_one = [&](const SeenOutline& o) {
    return std::any_of(found.begin(), found.end(),
                       [&](const PhotoAsIf& p) { return p.view == o.view && p.state == o.state; });
  };
  given.outlines.erase(std::remove_if(given.outlines.begin(), given.outlines.end(), is_of_one),
                       given.outlines.end());
}

StateTable TableOf(const RoomObservations& given) {
  StateTable table;
  table.dimming = given.dimming;
  for (size_t s = 0; s < given.dimming.size(); ++s) table.states.push_back(StateName(s));
  for (const KnownLuminaire& known : given.luminaires) table.luminaires.push_back(known.luminaire.id);
  return table;
}

std::vector<PhotoSample> SamplesOf(const std::vector<Observation>& observations,
                                   const std::vector<StatedPhoto>& photos) {
  std::map<std::pair<int, int>, int> number;
  for (const StatedPhoto& photo : photos)
    number.emplace(std::pair(photo.view, photo.state), static_cast<int>(number.size()));
  std::vector<PhotoSample> samples;
  for (const Observation& o : observations) {
    PhotoSample sample;
    sample.element = o.element, sample.state = o.state, sample.photo = number.at({o.view, o.state});
    sample.log_value = sample.log_share = std::log(o.relative_luminance);
    sample.relative_sigma = std::sqrt(o.variance) / o.relative_luminance;
    samples.push_back(sample);
  }
  return samples;
}

struct CorrectedExposures {
  std::vector<Observation> observations;
  std::vector<Warning> warnings;
};

CorrectedExposures CorrectExposures(const Room& model, const std::vector<Eigen::VectorXd>& dimming,
                                    const std::vector<Observation>& observations) {
  const std::vector<StatedPhoto> photos = PhotosIn(observations);
  const std::vector<PhotoSample> samples = SamplesOf(observations, photos);
  OpenRadiometry open;
  open.vignetting = open.response = open.gain_is_stated = {false};
  const SelfCalibration found = SelfCalibrate(model.patches, dimming, samples, open);
  if (!found.is_possible) return {observations, {}};
  CorrectedExposures corrected{WithCorrections(observations, samples, found), {}};
  for (const int p : FindingsOf(found, open, {StatedVignetting::kNone}).wrong_photos) {
    const StatedPhoto& photo = photos[static_cast<size_t>(p)];
    corrected.warnings.push_back(
        {"exposure_metadata",
         fmt::format("{}: {:.2f} times as bright", PhotoName(photo.view, photo.state),
                     std::exp(found.log_gain[p])),
         ""});
  }
  return corrected;
}

void WarnOfConflicts(const RoomObservations& given, RoomFit& fit) {
  const std::vector<Luminaire>& luminaires = fit.fit.state.luminaires;
  for (const StateConflict& c : FindStateConflicts(given.seen, luminaires, given.dimming))
    fit.findings.warnings.push_back({"state_contradicted",
                                     luminaires[static_cast<size_t>(c.luminaire)].id + " in state " +
                                         StateName(static_cast<size_t>(c.state)),
                                     ""});
}

ReadingAsGiven AsGiven(const RoomObservations& given, size_t i, double sigma_lx) {
  const MeterReading& reading = given.meter.readings[i];
  return {PlaceName(i), reading.sensor, reading.state, reading.illuminance_lx, sigma_lx, reading.used};
}

std::vector<ReadingExplanation> ExplanationsOf(const Room& model, const RoomObservations& given,
                                               const RoomFit& fit) {
  const std::vector<PredictedReading> predicted = PredictedReadings(fit);
  std::vector<ReadingAsGiven> as_given;
  for (size_t i = 0; i < predicted.size(); ++i)
    if (predicted[i].is_known) as_given.push_back(AsGiven(given, i, fit.data.readings[i].sigma_lx));
  const StateTable table = TableOf(given);
  const std::optional<ExplainingLight> light = ExplainingLightOf(model, fit, table.states);
  return light ? ExplainReadings(*light, as_given) : std::vector<ReadingExplanation>();
}

void CheckReadings(const RoomObservations& given, const std::vector<ReadingExplanation>& explanations,
                   RoomFit& fit) {
  const std::vector<PredictedReading> predicted = PredictedReadings(fit);
  std::vector<NamedReading> checked;
  for (size_t i = 0; i < predicted.size(); ++i) {
    const MeterReading& reading = given.meter.readings[i];
    const double sigma_lx = fit.data.readings[i].sigma_lx;
    if (predicted[i].is_known && !reading.used)
      checked.push_back(
          {PlaceName(i),
           StateName(static_cast<size_t>(reading.state)),
           {reading.illuminance_lx, predicted[i].illuminance_lx, sigma_lx, predicted[i].sigma_lx}});
  }
  WarnOfExplanations(explanations, fit.findings);
  WarnOfCheck(checked, fit.findings);
}

// Reads the table of readings as the explanation has it.
void Apply(const ReadingExplanation& explanation, RoomObservations& given) {
  for (size_t i = 0; i < given.meter.readings.size(); ++i) {
    const ReadingAsGiven right = explanation.so_read(AsGiven(given, i, 0));
    MeterReading& reading = given.meter.readings[i];
    reading.sensor = right.sensor;
    reading.state = right.state;
    reading.illuminance_lx = right.measured_lx;
  }
}

}  // namespace

std::string StateName(size_t state) { return "s" + std::to_string(state); }
std::string PhotoName(int view, int state) {
  return fmt::format("v{}_{}", view, StateName(static_cast<size_t>(state)));
}
std::string PlaceName(size_t reading) { return "P" + std::to_string(reading); }

RoomFit RunTraced(const Room& model, RoomObservations given, bool applies) {
  std::vector<Warning> of_exposures;
  ExplainedObservations explained = ExplainObservations(
      model.patches, std::move(given.observations), TableOf(given),
      [&](const std::vector<Eigen::VectorXd>& dimming, const std::vector<Observation>& observations) {
        CorrectedExposures corrected = CorrectExposures(model, dimming, observations);
        of_exposures = std::move(corrected.warnings);
        return std::move(corrected.observations);
      });
  given.observations = std::move(explained.observations);
  LeaveOutOutlines(explained.photos_as_if, given);
  Findings of_photos;
  WarnOfPhotos(explained.photos_as_if, of_photos);
  const std::vector<StateExplanation>& states = explained.states_as_if;
  const bool is_of_table = states.size() == 1 && states.front().IsOfTable();
  if (applies && is_of_table) {
    given.dimming = states.front().dimming;
    of_photos.warnings.push_back({"session_corrected", InWords(states), ""});
  } else {
    WarnOfStates(states, of_photos);
  }
  of_photos.warnings.insert(of_photos.warnings.end(), of_exposures.begin(), of_exposures.end());
  RoomFit fit = FitRoom(model, given);
  std::vector<ReadingExplanation> readings = ExplanationsOf(model, given, fit);
  const bool is_sure = (states.empty() || is_of_table) && !fit.findings.IsUndetermined();
  if (applies && is_sure && readings.size() == 1 && readings.front().so_read) {
    of_photos.warnings.push_back({"session_corrected", InWords(readings), ""});
    Apply(readings.front(), given);
    fit = FitRoom(model, given);
    readings = ExplanationsOf(model, given, fit);
  }
  fit.findings.warnings.insert(fit.findings.warnings.begin(), of_photos.warnings.begin(),
                               of_photos.warnings.end());
  WarnOfConflicts(given, fit);
  CheckReadings(given, readings, fit);
  return fit;
}

}  // namespace luxfit
