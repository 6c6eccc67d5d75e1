#include "forward/light/choose_accuracy.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

#include "forward/light/internal/adaptive_patches.h"
#include "forward/light/internal/room_again.h"
#include "forward/mesh/planes.h"

namespace luxfit {
namespace {

// Shares of the error. Patches may use what rays and sensors leave of kTogether, as a root of squares.
constexpr double kTogether = 0.85, kRaysShare = 0.3, kSensorsShare = 0.4, kBouncesShare = 0.05;
constexpr double kPatchesShare = 0.8;  // at least, also where those two missed theirs
constexpr size_t kMostTried = 100;  // sensors, for a root mean square that is within a tenth of that of all
constexpr int kFewestRays = 16, kMostSampled = 256, kHybridRays = 64, kFewestSensorRays = 1024;
constexpr double kFirstBoundPercent = 1;  // error_percent of AdaptivePatches at the first halving
constexpr double kOneDraw = 2;            // a sampled error over its sigma, at 95 %

std::string Percent(double percent) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", percent);
  return text;
}

std::string Number(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

// Returns the size of the first patches: those asked for, or larger ones that can be halved once. Where facets are long
// and narrow, or many, their number says more than the area.
double CoarsestPatchM(const Scene& scene, const AccuracyOptions& options) {
  double area_m2 = 0;
  for (const Facet& facet : scene.facets) area_m2 += facet.AreaM2();
  double size_m = std::max(options.coarsest_patch_m, std::sqrt(16 * area_m2 / options.max_patches));
  constexpr double kHalvingGrows = 8, kStep = 1.5, kHardlyFewer = 0.9;
  double before = std::numeric_limits<double>::infinity();
  for (;; size_m *= kStep) {
    const PatchCounts counts = CountPatches(scene, PatchesOfSize(size_m));
    const double bytes = counts.patches * counts.elements * sizeof(float);
    if (kHalvingGrows * bytes <= options.max_matrix_bytes) return size_m;
    const double facets = static_cast<double>(scene.facets.size());
    if (counts.patches > kHardlyFewer * before && counts.patches <= 2 * facets) return size_m;
    before = counts.patches;
  }
}

class Chooser {
 public:
  Chooser(const LitScene& lit, const AccuracyOptions& options)
      : all_(WithLongTrianglesMerged(lit)), lit_(WithFewSensors(all_)), options_(options) {
    coarsest_m_ = CoarsestPatchM(lit_.scene, options);
    choice_.options.solver.tolerance_percent = kBouncesShare * options.error_percent;
  }

  AccurateSceneLight Run() {
    choice_.options.rays_per_sensor = kFewestSensorRays;
    choice_.options.room.patches = PatchesOfSize(coarsest_m_);
    choice_.options.room.form_factors = {kHybridRays, FormFactorMethod::kHybrid};
    SceneLight last = Try(nullptr);
    if (last.room.patches.patches.empty()) {
      choice_.patches_because = choice_.rays_because = choice_.sensors_because = choice_.bounces_because =
          "no surface reflects: all light is direct";
      return {choice_, AtAllSensors(std::move(last))};
    }
    // Many facets: only rays can find the pairs that see one another.
    choice_.options.room.form_factors.method = last.room.form_factors.method;
    last = ChooseSensorRays(std::move(last));
    last = last.room.sparse ? DoubleRays(std::move(last), "") : ChooseRays(std::move(last));
    ChooseBounces(last);
    last = ChoosePatches(std::move(last));
    choice_.bounces_error_percent = last.light.error_percent;
    choice_.estimated_error_percent =
        std::hypot(choice_.patches_error_percent,
                   std::hypot(choice_.rays_error_percent, choice_.sensors_error_percent)) +
        choice_.bounces_error_percent;
    choice_.reached = choice_.estimated_error_percent <= options_.error_percent;
    return {choice_, AtAllSensors(std::move(last))};
  }

 private:
  static LitScene WithLongTrianglesMerged(LitScene lit) {
    lit.scene = WithTrianglesMerged(lit.scene);
    return lit;
  }

  // Returns the scene with sensors evenly taken from the list. What all of them cost is then paid once.
  static LitScene WithFewSensors(const LitScene& lit) {
    LitScene few = lit;
    const size_t count = lit.sensors.size();
    if (count <= kMostTried) return few;
    few.sensors.clear();
    for (size_t i = 0; i < kMostTried; ++i) few.sensors.push_back(lit.sensors[i * count / kMostTried]);
    return few;
  }

  // Computes the light of all sensors in the room that was chosen.
  SceneLight AtAllSensors(SceneLight chosen) const {
    if (lit_.sensors.size() == all_.sensors.size()) return chosen;
    chosen.receivers = MakeReceivers(chosen.room, {}, all_.sensors, choice_.options.rays_per_sensor);
    chosen.visibility.receivers =
        ComputeReceiverVisibility(chosen.room, chosen.receivers, all_.luminaires).receivers;
    chosen.light = Relight(all_, chosen, choice_.options.solver);
    return chosen;
  }

  static double ChangePercent(const ColourIlluminance& before, const ColourIlluminance& now) {
    return RelativeRmsPercent(before.total.cast<double>(), now.total.cast<double>());
  }

  // Computes the light by choice_.options as they stand.
  SceneLight Try(const ColourIlluminance* before) {
    SceneLight now = ComputeSceneLight(lit_, choice_.options);
    Record(now, before ? ChangePercent(*before, now.light) : 0);
    return now;
  }

  // Computes the same patches' light by other form factors.
  SceneLight TryFormFactors(SceneLight now, const ColourIlluminance& before) {
    now.room = WithFormFactors(std::move(now.room), choice_.options.room.form_factors);
    now.light = Relight(lit_, now, choice_.options.solver);
    Record(now, ChangePercent(before, now.light));
    return now;
  }

  void Record(const SceneLight& now, double change_percent) {
    const RoomOptions& room = choice_.options.room;
    choice_.tried.push_back({room.patches.patch_size_m, room.patches.element_size_m,
                             room.form_factors.rays_per_element, choice_.options.rays_per_sensor,
                             room.form_factors.method, static_cast<int>(now.room.patches.patches.size()),
                             static_cast<int>(now.room.patches.elements.size()), change_percent});
  }

  SceneLight ChooseSensorRays(SceneLight last) {
    const double allowed = kSensorsShare * options_.error_percent;
    while (true) {
      const ColourIlluminance before = last.light;
      choice_.options.rays_per_sensor *= 4;
      last = Regather(lit_, std::move(last), choice_.options);
      Record(last, ChangePercent(before, last.light));
      const double error = choice_.tried.back().change_percent / 2;
      choice_.sensors_error_percent = error;
      const bool enough = error <= allowed;
      if (!enough && 4 * choice_.options.rays_per_sensor <= options_.max_rays_per_sensor) continue;
      choice_.sensors_because = "a quarter of them changes it by twice " + Percent(error) +
                                (enough ? ", below " : ", no more are tried; more than ") + Percent(allowed);
      return last;
    }
  }

  SceneLight ChooseRays(SceneLight last) {
    const ColourIlluminance closed_form = last.light;
    const double allowed = kRaysShare * options_.error_percent;
    const std::string where = " on patches of " + Number(coarsest_m_) + " m";
    double change = 0;
    FormFactorOptions& form_factors = choice_.options.room.form_factors;
    for (int rays = kFewestRays; rays <= std::min(kMostSampled, options_.max_rays); rays *= 2) {
      form_factors = {rays, FormFactorMethod::kMalleyStratified};
      last = TryFormFactors(std::move(last), closed_form);
      change = kOneDraw * choice_.tried.back().change_percent;
      if (change > allowed) continue;
      choice_.rays_error_percent = change;
      choice_.rays_because = "twice its difference from closed forms is " + Percent(change) + ", below " +
                             Percent(allowed) + where;
      return last;
    }
    const std::string sampled_because = "twice the difference of sampling from closed forms is " +
                                        Percent(change) + ", more than " + Percent(allowed) + where;
    form_factors = {kHybridRays, FormFactorMethod::kHybrid};
    last.light = closed_form;
    return DoubleRays(std::move(last), sampled_because + "; ");
  }

  SceneLight DoubleRays(SceneLight last, const std::string& because) {
    const double allowed = kRaysShare * options_.error_percent;
    FormFactorOptions& form_factors = choice_.options.room.form_factors;
    double change = 0;
    do {
      form_factors.rays_per_element *= 2;
      const ColourIlluminance before = last.light;
      last = TryFormFactors(std::move(last), before);
      change = choice_.tried.back().change_percent;
    } while (change > allowed && form_factors.rays_per_element < options_.max_rays);
    choice_.rays_error_percent = change;
    choice_.rays_because = because + "half as many rays change it by " + Percent(change);
    return last;
  }

  // Chooses the bounces on the coarse patches: the number that a bound asks for hardly depends on the
  // patches.
  void ChooseBounces(const SceneLight& coarse) {
    RadiositySolverOptions iterated = choice_.options.solver;
    iterated.solver = RadiositySolver::kConjugateGradient;
    const int products = Relight(lit_, coarse, iterated).iterations + 1;
    RadiositySolverOptions series = choice_.options.solver;
    series.solver = RadiositySolver::kNeumann;
    for (series.bounces = 1; series.bounces < products; ++series.bounces) {
      const double bound = Relight(lit_, coarse, series).error_percent;
      if (bound > series.tolerance_percent) continue;
      choice_.options.solver = series;
      choice_.all_bounces = false;
      choice_.bounces_because = std::to_string(series.bounces) + " leave out at most " + Percent(bound) +
                                ", below a twentieth of the error, and cost less than all";
      return;
    }
    choice_.bounces_because = "all cost " + std::to_string(products) +
                              " products or a factorisation, no more than the " +
                              "bounces that would leave out " + Percent(series.tolerance_percent);
  }

  // Tells whether matrices for elements of half the size fit the memory.
  bool FinerFit(const Room& room) const {
    constexpr double kPatchesGrow = 2;       // most patches are split no further
    constexpr double kBytesPerRay = 2 * 24;  // pairs both ways, while they are made
    const double patches = kPatchesGrow * static_cast<double>(room.patches.patches.size());
    const double size_m = choice_.options.room.patches.element_size_m;
    double elements = 0;  // those of small facets stay as they are
    for (const Element& element : room.patches.elements)
      elements += std::clamp(4 * element.area_m2 / (size_m * size_m), 1.0, 4.0);
    const int rays = choice_.options.room.form_factors.rays_per_element;
    if (room.sparse) return elements * rays * kBytesPerRay <= choice_.options.room.max_matrix_bytes;
    return patches <= options_.max_patches && patches * elements * sizeof(float) <= options_.max_matrix_bytes;
  }

  // Chooses the coarsest patches that a halving shows to suffice.
  SceneLight ChoosePatches(SceneLight last) {
    const double left = std::pow(kTogether * options_.error_percent, 2) -
                        std::pow(choice_.rays_error_percent, 2) - std::pow(choice_.sensors_error_percent, 2);
    const double allowed = std::max(kPatchesShare * options_.error_percent, std::sqrt(std::max(0.0, left)));
    PatchesOptions sizes = PatchesOfSize(coarsest_m_);
    double bound_percent = kFirstBoundPercent, before = 0, error = std::numeric_limits<double>::infinity();
    choice_.patches_because = "no finer ones fit into memory to compare them with";
    while (error > allowed && FinerFit(last.room)) {
      sizes.element_size_m /= 2;
      const PatchesOptions coarse_patches = std::exchange(
          choice_.options.room.patches,
          AdaptivePatches(last.room, IndirectLx(last.light), lit_.luminaires, bound_percent, sizes));
      SceneLight finer = Try(&last.light);
      const double change = choice_.tried.back().change_percent;
      error = ErrorFrom(before, change);
      if (error + change <= allowed) {
        choice_.options.room.patches = coarse_patches;
        choice_.patches_error_percent = error + change;
        choice_.patches_because =
            "elements of half the size, patches split at half the variation, change the "
            "illuminance by " +
            Percent(change) + ": estimated error " + Percent(choice_.patches_error_percent) + ", below " +
            Percent(allowed);
        return last;
      }
      last = std::move(finer);
      choice_.patches_because =
          "elements of twice the size, patches split at twice the variation, change the illuminance by " +
          Percent(change) + ": estimated error " + Percent(error) +
          (error <= allowed ? ", below " + Percent(allowed)
                            : ", more than " + Percent(allowed) + ", but no finer ones fit into memory");
      before = change;
      bound_percent /= 2;
    }
    choice_.patches_error_percent = error;
    return last;
  }

  // Returns the indirect light of all luminaires.
  Eigen::VectorXf IndirectLx(const ColourIlluminance& light) const {
    return light.element_indirect * FluxesLm(lit_.luminaires).cast<float>();
  }

  // Returns the error of the finest patches from the last two changes; `before` 0: there was only one.
  static double ErrorFrom(double before, double change) {
    constexpr double kSlowest = 1.5;
    if (before == 0) return change;
    if (change == 0) return 0;
    const double ratio = before / change;
    return change * (ratio > 1 ? std::clamp(1 / (ratio - 1), 1.0, kSlowest) : kSlowest);
  }

  const LitScene all_;
  const LitScene lit_;  // with the sensors that choose
  const AccuracyOptions& options_;
  double coarsest_m_ = 0;
  AccuracyChoice choice_;
};

}  // namespace

AccurateSceneLight ChooseAccuracy(const LitScene& lit, const AccuracyOptions& options) {
  if (!(options.error_percent > 0))
    throw std::invalid_argument("ChooseAccuracy: expected an error > 0 percent");
  return Chooser(lit, options).Run();
}

}  // namespace luxfit
