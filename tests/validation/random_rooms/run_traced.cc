#include "tests/validation/random_rooms/run_traced.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "apps/stages/check_warnings.h"
#include "apps/stages/explain_check.h"
#include "apps/stages/observe/explained_photos.h"
#include "inverse/fit/explaining_light.h"
#include "inverse/observe/evidence.h"
#include "inverse/observe/state_conflicts.h"

namespace luxfit {
namespace {

void LeaveOutPhotos(const Room& model, RoomObservations& given, Findings& findings) {
  const std::vector<PhotoAsIf> found = FindPhotosAsIf(model.patches, given.observations);
  for (const PhotoAsIf& p : found) {
    const std::string name = PhotoName(p.view, p.state), other = PhotoName(p.view, p.as_if);
    if (!p.is_exchanged)
      findings.warnings.push_back({"photos_as_if", name + " looks as if it was " + other, ""});
    else if (p.state < p.as_if)
      findings.warnings.push_back({"photos_as_if", name + " and " + other + " look exchanged", ""});
  }
  given.observations = WithoutPhotos(given.observations, found);
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

void CheckReadings(const Room& model, const RoomObservations& given, RoomFit& fit) {
  const std::vector<PredictedReading> predicted = PredictedReadings(fit);
  std::vector<NamedReading> checked;
  std::vector<ReadingAsGiven> as_given;
  for (size_t i = 0; i < predicted.size(); ++i) {
    const MeterReading& reading = given.meter.readings[i];
    if (!predicted[i].is_known) continue;
    const double sigma_lx = fit.data.readings[i].sigma_lx;
    as_given.push_back(
        {PlaceName(i), reading.sensor, reading.state, reading.illuminance_lx, sigma_lx, reading.used});
    if (!reading.used)
      checked.push_back(
          {PlaceName(i),
           StateName(static_cast<size_t>(reading.state)),
           {reading.illuminance_lx, predicted[i].illuminance_lx, sigma_lx, predicted[i].sigma_lx}});
  }
  const StateTable table = TableOf(given);
  if (const std::optional<ExplainingLight> light = ExplainingLightOf(model, fit, table.states))
    WarnOfExplanations(ExplainReadings(*light, as_given), fit.findings);
  WarnOfCheck(checked, fit.findings);
}

}  // namespace

std::string StateName(size_t state) { return "s" + std::to_string(state); }
std::string PhotoName(int view, int state) {
  return fmt::format("v{}_{}", view, StateName(static_cast<size_t>(state)));
}
std::string PlaceName(size_t reading) { return "P" + std::to_string(reading); }

RoomFit RunTraced(const Room& model, RoomObservations given) {
  Findings of_photos;
  LeaveOutPhotos(model, given, of_photos);
  const StateTable table = TableOf(given);
  std::vector<StateExplanation> states = FindStatesAsIf(model.patches, given.observations, table);
  CorrectedExposures corrected = CorrectExposures(model, DimmingSeen(table, states), given.observations);
  if (states.empty()) {
    if (auto alone = StatesByThemselves(model.patches, corrected.observations, table)) {
      states.push_back(*std::move(alone));
      corrected = CorrectExposures(model, DimmingSeen(table, states), given.observations);
    }
  }
  WarnOfStates(states, of_photos);
  given.observations = std::move(corrected.observations);
  of_photos.warnings.insert(of_photos.warnings.end(), corrected.warnings.begin(), corrected.warnings.end());
  RoomFit fit = FitRoom(model, given);
  fit.findings.warnings.insert(fit.findings.warnings.begin(), of_photos.warnings.begin(),
                               of_photos.warnings.end());
  WarnOfConflicts(given, fit);
  CheckReadings(model, given, fit);
  return fit;
}

}  // namespace luxfit
