#include "inverse/advise/internal/candidate_information.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "inverse/advise/internal/photo_view.h"
#include "inverse/fit/internal/room_light.h"
#include "inverse/observe/observe.h"

namespace luxfit {
namespace {

// Enough for derivatives that vary smoothly; each stands for several.
constexpr size_t kSampledElements = 2000;
constexpr double kLeastShareOfBrightest = 0.02;

std::vector<int> SampleElements(const Room& room) {
  const size_t all = room.patches.elements.size(), count = std::min(all, kSampledElements);
  std::vector<int> sample;
  sample.reserve(count);
  for (size_t i = 0; i < count; ++i) sample.push_back(static_cast<int>(i * all / count));
  return sample;
}

double RowsPerElement(const Room& room, const std::vector<int>& sample) {
  if (sample.empty()) return 1;
  return static_cast<double>(room.patches.elements.size()) / static_cast<double>(sample.size());
}

// Elements err by the model's error and by what registration leaves; half of the variance is the patch's.
PhotoSigmas SigmasOf(double relative_model_sigma) {
  const double half = std::sqrt(0.5) * std::hypot(relative_model_sigma, kLeastBetweenViews);
  return {half, half, kLeastBetweenViews};
}

std::vector<Sensor> SensorsOf(const AdviceGiven& given) {
  std::vector<Sensor> sensors;
  for (const ReadingCandidate& reading : given.readings) sensors.push_back(reading.sensor);
  for (const ReadingCandidate& reading : given.predicted) sensors.push_back(reading.sensor);
  return sensors;
}

}  // namespace

CandidateInformation::CandidateInformation(const Room& room, const AdviceGiven& given,
                                           const PriorKnowledge& known)
    : given_(given),
      known_(known),
      sample_(SampleElements(room)),
      light_(room, known.state, known.parameters, sample_, SensorsOf(given)),
      taken_(SigmasOf(given.fit.relative_model_sigma), RowsPerElement(room, sample_)),
      visible_(given.views.size()),
      outlines_(given.views.size()) {
  tbb::parallel_for(size_t{0}, given.views.size(), [&](size_t v) {
    const AdviceView& view = given.views[v];
    visible_[v] = VisibleElements(room, sample_, view.camera, view.cam_from_world);
    outlines_[v] = OutlinesIn(room, view);
  });
  MakePhotoRows(room);
  MakeReadings();
  Eigen::MatrixXd all = Nothing();
  for (const PhotoCandidate& photo : given.taken) {
    all += OfPhoto(photo);
    TakePhoto(photo);
  }
  inflation_ = given.taken.empty() ? given.assumed_inflation : VarianceInflation(known.covariance, all);
}

std::vector<CandidateInformation::OutlinePart> CandidateInformation::OutlinesIn(
    const Room& room, const AdviceView& view) const {
  std::vector<OutlinePart> parts;
  for (int k = 0; k < static_cast<int>(known_.state.luminaires.size()); ++k) {
    OutlinePart part;
    part.luminaire = k;
    std::vector<Parameter> own;
    for (size_t p = 0; p < known_.parameters.size(); ++p) {
      const Parameter& parameter = known_.parameters[p];
      if (parameter.kind != ParameterKind::kLuminaire || !parameter.Concerns(k)) continue;
      own.push_back(parameter);
      part.parameters.push_back(static_cast<Eigen::Index>(p));
    }
    part.information = OutlineInformation(room, known_.state, own, k, view.camera, view.cam_from_world);
    if (part.information.size() > 0) parts.push_back(std::move(part));
  }
  return parts;
}

void CandidateInformation::MakePhotoRows(const Room& room) {
  rows_.resize(given_.dimming.size());
  for (size_t s = 0; s < rows_.size(); ++s) {
    for (size_t i = 0; i < sample_.size(); ++i) {
      PhotoRow& row = rows_[s].emplace_back();
      row.element = sample_[i];
      row.patch = room.patches.elements[static_cast<size_t>(sample_[i])].patch;
      row.state = static_cast<int>(s);
      row.derivative = light_.OfElement(i, given_.dimming[s]).derivative;
    }
  }
}

void CandidateInformation::MakeReadings() {
  std::vector<double> brightest(given_.dimming.size(), 0);
  for (size_t r = 0; r < given_.readings.size(); ++r) {
    const auto state = static_cast<size_t>(given_.readings[r].state);
    readings_.push_back(light_.OfSensor(r, given_.dimming[state]));
    brightest[state] = std::max(brightest[state], readings_.back().value);
  }
  for (size_t r = 0; r < readings_.size(); ++r) {
    const auto state = static_cast<size_t>(given_.readings[r].state);
    if (readings_[r].value < kLeastShareOfBrightest * brightest[state]) TakeReading(r);
  }
}

Eigen::VectorXd CandidateInformation::DerivativeOfPredicted(size_t reading) const {
  const auto state = static_cast<size_t>(given_.predicted[reading].state);
  return light_.OfSensor(given_.readings.size() + reading, given_.dimming[state]).derivative;
}

std::vector<PhotoRow> CandidateInformation::RowsOf(const PhotoCandidate& photo) const {
  std::vector<PhotoRow> rows;
  for (const int i : visible_[static_cast<size_t>(photo.view)]) {
    const PhotoRow& row = rows_[static_cast<size_t>(photo.state)][static_cast<size_t>(i)];
    if (row.derivative.size() > 0) rows.push_back(row);
  }
  return rows;
}

bool CandidateInformation::IsNewOutline(const PhotoCandidate& photo, int luminaire) const {
  return given_.dimming[static_cast<size_t>(photo.state)][luminaire] > 0 &&
         shown_.count({photo.view, luminaire}) == 0;
}

Eigen::MatrixXd CandidateInformation::Nothing() const {
  return Eigen::MatrixXd::Zero(known_.covariance.rows(), known_.covariance.cols());
}

Eigen::MatrixXd CandidateInformation::OfPhoto(const PhotoCandidate& photo) const {
  Eigen::MatrixXd information = taken_.InformationOf(RowsOf(photo));
  if (information.size() == 0) information = Nothing();
  for (const OutlinePart& part : outlines_[static_cast<size_t>(photo.view)]) {
    if (IsNewOutline(photo, part.luminaire))
      information(part.parameters, part.parameters) += part.information;
  }
  return information / inflation_;
}

Eigen::MatrixXd CandidateInformation::OfReading(size_t candidate) const {
  const Eigen::VectorXd& derivative = readings_[candidate].derivative;
  if (derivative.size() == 0) return Nothing();
  const bool scale_is_free =
      given_.is_absolute &&
      std::any_of(known_.parameters.begin(), known_.parameters.end(),
                  [](const Parameter& p) { return p.kind == ParameterKind::kLogMeterScale; });
  const double sigma = std::hypot(RelativeReadingSigma(given_.meter_common_sigma, scale_is_free),
                                  given_.fit.relative_model_sigma);
  return derivative * derivative.transpose() / (sigma * sigma);
}

void CandidateInformation::TakePhoto(const PhotoCandidate& photo) {
  taken_.Add(RowsOf(photo));
  for (const OutlinePart& part : outlines_[static_cast<size_t>(photo.view)]) {
    if (IsNewOutline(photo, part.luminaire)) shown_.insert({photo.view, part.luminaire});
  }
}

}  // namespace luxfit
