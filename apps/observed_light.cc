#include "apps/observed_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/linearize.h"
#include "calib/estimate_vignetting.h"
#include "calib/exposure_gains.h"

namespace luxfit {
namespace {

// Elements that two views must share before their exposures are compared.
constexpr size_t kMinShared = 30;
// Elements that vignetting is estimated from.
constexpr int kMaxElements = 400;
// Registration and element size move a ratio of two views by about this.
constexpr double kViewSigma = 0.005;
// Of ln exposure: vignetting that nobody corrects stays below.
constexpr double kWorthAWarning = 0.08;

double MedianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

int CameraOfView(const RegisteredSession& registered, int view) {
  return registered.registration.views[static_cast<size_t>(view)].camera;
}

const SessionPhoto* PhotoOf(const Session& session, const RegisteredSession& registered, int view,
                            int state) {
  const std::string& name = registered.registration.views[static_cast<size_t>(view)].view;
  for (const SessionPhoto& photo : session.photos) {
    if (photo.view == name && photo.state == session.states[static_cast<size_t>(state)].id) return &photo;
  }
  return nullptr;
}

// Luminance of an element by view.
using ViewsOfElement = std::map<int, std::map<int, double>>;

std::vector<ExposureRatio> RatiosOfViews(const ViewsOfElement& elements,
                                         const RegisteredSession& registered) {
  std::map<std::pair<int, int>, std::vector<double>> shared;
  for (const auto& [element, views] : elements) {
    for (auto a = views.begin(); a != views.end(); ++a) {
      for (auto b = std::next(a); b != views.end(); ++b) {
        if (CameraOfView(registered, a->first) == CameraOfView(registered, b->first))
          shared[{a->first, b->first}].push_back(std::log(a->second / b->second));
      }
    }
  }
  std::vector<ExposureRatio> ratios;
  for (auto& [views, logs] : shared) {
    if (logs.size() < kMinShared) continue;
    const double median = MedianOf(logs);
    for (double& value : logs) value = std::abs(value - median);
    const double spread = 1.85 * MedianOf(logs) / std::sqrt(static_cast<double>(logs.size()));
    ratios.push_back(
        {views.first, views.second, median, std::hypot(kViewSigma, spread), static_cast<int>(logs.size())});
  }
  return ratios;
}

VignettingSample SampleOf(const Observation& observation, const Camera& camera, const RegisteredView& view,
                          const Patches& patches, int photo, int states) {
  const Eigen::Vector3d center = patches.elements[static_cast<size_t>(observation.element)].center;
  VignettingSample sample;
  sample.photo = photo;
  sample.pixel = Project(camera, view.cam_from_world * center);
  sample.surface = observation.element * states + observation.state;
  sample.value = observation.relative_luminance;
  sample.relative_sigma =
      std::hypot(0.01, std::sqrt(observation.variance) / std::abs(observation.relative_luminance));
  return sample;
}

// Photos of registered views, numbered as they come.
class PhotoNumbers {
 public:
  int Of(const Observation& o) {
    return numbers_.emplace(std::pair(o.view, o.state), static_cast<int>(numbers_.size())).first->second;
  }
  int size() const { return static_cast<int>(numbers_.size()); }

 private:
  std::map<std::pair<int, int>, int> numbers_;
};

void Correct(Observation& observation, double factor) {
  observation.relative_luminance /= factor;
  observation.relative_rgb /= factor;
  observation.variance /= factor * factor;
}

void RecordVignetting(const SessionCamera& camera, const VignettingEstimate& estimate, RunContext& context,
                      nlohmann::json& artifact) {
  const auto& k = estimate.vignetting.coefficients;
  artifact["vignetting"].push_back({{"camera", camera.id},
                                    {"is_determined", estimate.is_determined},
                                    {"coefficients", std::vector<double>(k.begin(), k.end())},
                                    {"radius_px", estimate.vignetting.radius_px},
                                    {"corner_sigma", estimate.corner_sigma},
                                    {"residual_rms", estimate.residual_rms},
                                    {"held_out_error", estimate.held_out_error}});
  if (!estimate.is_determined) {
    context.warnings.push_back(
        {"vignetting_undetermined",
         fmt::format("the vignetting of camera \"{}\" is not determined: {}; none was corrected", camera.id,
                     estimate.message),
         "add views that show the same walls in their middle and at their border, or give a flat field as "
         "vignetting"});
    return;
  }
  std::string scores;
  for (size_t order = 0; order < estimate.held_out_error.size(); ++order)
    scores += fmt::format("{}{} {:.3f}", order == 0 ? "" : ", ", order, estimate.held_out_error[order]);
  context.choices.push_back(
      {"vignetting of " + camera.id,
       fmt::format("order {}", k.size()),
       {"0", "1", "2", "3"},
       fmt::format(
           "simplest whose error on surfaces held out is the best's within its standard error ({}); at the "
           "corner {:.1f} +- {:.1f} % of the centre",
           scores, 100 * std::exp(k.sum()), 100 * estimate.corner_sigma)});
}

}  // namespace

void WarnOfExposures(const Session& session, const RegisteredSession& registered,
                     const std::vector<Observation>& observations, RunContext& context) {
  const int views = static_cast<int>(registered.registration.views.size());
  std::map<int, ViewsOfElement> states;
  for (const Observation& o : observations) states[o.state][o.element][o.view] = o.relative_luminance;
  for (const auto& [state, elements] : states) {
    const std::vector<ExposureRatio> ratios = RatiosOfViews(elements, registered);
    ExposureGainsOptions options;
    options.least = kWorthAWarning;
    const ExposureGains gains = SolveGains(views, ratios, options);
    for (const int view : gains.off) {
      const SessionPhoto* const photo = PhotoOf(session, registered, view, state);
      if (!photo) continue;
      const double factor = std::exp(gains.log_gain[view]);
      context.warnings.push_back(
          {"exposure_metadata",
           fmt::format("{}: surfaces are {:.3f} times as bright as in the other views of state {}: its "
                       "exposure is not "
                       "the stated one, or the light had changed",
                       PhotoName(session, photo->bracket.front()), factor, photo->state),
           fmt::format("check its exposure_s and ISO (automatic ISO?): {:.3f} times the stated exposure "
                       "would fit; or "
                       "take it again",
                       factor)});
    }
  }
}

std::vector<Observation> WithEstimatedVignetting(const Session& session, const RegisteredSession& registered,
                                                 const Patches& patches,
                                                 std::vector<Observation> observations, RunContext& context,
                                                 nlohmann::json& artifact) {
  const int states = static_cast<int>(session.states.size());
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    if (session.cameras[c].vignetting != "estimate") continue;
    std::vector<Observation> of_camera;
    for (const Observation& o : observations) {
      if (static_cast<size_t>(CameraOfView(registered, o.view)) == c) of_camera.push_back(o);
    }
    const Camera& camera = registered.cameras[c];
    const auto sample_of = [&](const Observation& o, PhotoNumbers& numbers) {
      const RegisteredView& view = registered.registration.views[static_cast<size_t>(o.view)];
      return SampleOf(o, camera, view, patches, numbers.Of(o), states);
    };
    PhotoNumbers numbers;
    for (const Observation& o : of_camera) numbers.Of(o);
    std::vector<VignettingSample> samples;
    for (const Observation& o : ThinElements(of_camera, kMaxElements))
      samples.push_back(sample_of(o, numbers));
    const VignettingEstimate estimate =
        EstimateVignetting(samples, numbers.size(), NoVignetting(camera.width_px, camera.height_px));
    RecordVignetting(session.cameras[c], estimate, context, artifact);
    for (Observation& o : observations) {
      if (static_cast<size_t>(CameraOfView(registered, o.view)) != c) continue;
      const VignettingSample sample = sample_of(o, numbers);
      Correct(o, estimate.vignetting.At(sample.pixel) * std::exp(estimate.log_gain[sample.photo]));
    }
  }
  return observations;
}

}  // namespace luxfit
