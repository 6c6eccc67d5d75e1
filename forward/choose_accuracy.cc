#include "forward/choose_accuracy.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace luxfit {
namespace {

// Shares of the error: together, as a root of squares and a twentieth, they stay below it.
constexpr double kPatchesShare = 0.9, kRaysShare = 0.3, kBouncesShare = 0.05;
constexpr int kFewestRays = 16, kMostSampled = 256, kHybridRays = 64;
constexpr double kOneDraw = 2;  // of a sampled error over its sigma, at 95 %

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

class Chooser {
 public:
  Chooser(const LitScene& lit, const AccuracyOptions& options) : lit_(lit), options_(options) {
    double area_m2 = 0;
    for (const Facet& facet : lit.scene.facets) area_m2 += facet.AreaM2();
    // Two halvings are always to be had.
    coarsest_m_ = std::max(options.coarsest_patch_m, std::sqrt(16 * area_m2 / options.max_patches));
    choice_.options.solver.tolerance_percent = kBouncesShare * options.error_percent;
  }

  AccurateSceneLight Run() {
    SceneLight last = Try(coarsest_m_, {kHybridRays, FormFactorMethod::kHybrid}, nullptr);
    if (last.room.patches.patches.empty()) {
      choice_.patches_because = choice_.rays_because = choice_.bounces_because =
          "no surface reflects: all light is direct";
      return {choice_, std::move(last)};
    }
    last = ChooseRays(std::move(last));
    ChooseBounces(last);
    last = ChoosePatches(std::move(last));
    choice_.bounces_error_percent = last.light.error_percent;
    choice_.estimated_error_percent =
        std::hypot(choice_.patches_error_percent, choice_.rays_error_percent) + choice_.bounces_error_percent;
    choice_.reached = choice_.estimated_error_percent <= options_.error_percent;
    return {choice_, std::move(last)};
  }

 private:
  SceneLight Try(double patch_size_m, const FormFactorOptions& form_factors, const SceneLight* before) {
    choice_.options.room.patches = PatchesOfSize(patch_size_m);
    choice_.options.room.form_factors = form_factors;
    SceneLight now = ComputeSceneLight(lit_, choice_.options);
    const double change =
        before ? RelativeRmsPercent(before->light.total.cast<double>(), now.light.total.cast<double>()) : 0;
    choice_.tried.push_back({patch_size_m, form_factors.rays_per_element, form_factors.method,
                             static_cast<int>(now.room.patches.patches.size()),
                             static_cast<int>(now.room.patches.elements.size()), change});
    return now;
  }

  SceneLight ChooseRays(SceneLight closed_form) {
    const double allowed = kRaysShare * options_.error_percent;
    const std::string where = " on patches of " + Number(coarsest_m_) + " m";
    double change = 0;
    for (int rays = kFewestRays; rays <= std::min(kMostSampled, options_.max_rays); rays *= 2) {
      SceneLight sampled = Try(coarsest_m_, {rays, FormFactorMethod::kMalleyStratified}, &closed_form);
      change = kOneDraw * choice_.tried.back().change_percent;
      if (change > allowed) continue;
      choice_.rays_error_percent = change;
      choice_.rays_because = "twice its difference from closed forms is " + Percent(change) + ", below " +
                             Percent(allowed) + where;
      return sampled;
    }
    const std::string sampled_because = "twice the difference of sampling from closed forms is " +
                                        Percent(change) + ", more than " + Percent(allowed) + where;
    SceneLight last = std::move(closed_form);
    int rays = kHybridRays;
    do {
      rays *= 2;
      last = Try(coarsest_m_, {rays, FormFactorMethod::kHybrid}, &last);
      change = choice_.tried.back().change_percent;
    } while (change > allowed && rays < options_.max_rays);
    choice_.rays_error_percent = change;
    choice_.rays_because =
        sampled_because + "; half as many rays for shadows change it by " + Percent(change);
    return last;
  }

  // The number of bounces that a bound asks for hardly depends on the patches: found on the coarse ones.
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

  bool Fits(const TriedAccuracy& tried) const {
    // A half of the size makes four of each.
    return 4.0 * tried.patches <= options_.max_patches &&
           4.0 * tried.patches * 4.0 * tried.elements * sizeof(float) <= options_.max_matrix_bytes;
  }

  SceneLight ChoosePatches(SceneLight last) {
    const double allowed = kPatchesShare * options_.error_percent;
    const FormFactorOptions form_factors = choice_.options.room.form_factors;
    double size_m = coarsest_m_, before = 0, error = 0;
    while (true) {
      if (!Fits(choice_.tried.back())) break;
      size_m /= 2;
      last = Try(size_m, form_factors, &last);
      const double change = choice_.tried.back().change_percent;
      error = ErrorFrom(before, change);
      before = change;
      if (error <= allowed) break;
    }
    choice_.patches_error_percent = error;
    const bool reached = before > 0 && error <= allowed;
    choice_.patches_because =
        "twice the size changes the illuminance by " + Percent(before) + ": estimated error " +
        Percent(error) +
        (reached ? ", below " + Percent(allowed)
                 : ", more than " + Percent(allowed) + ", but no finer ones fit into memory");
    return last;
  }

  // Of the finest patches, from the last two changes; `before` 0: there was only one.
  static double ErrorFrom(double before, double change) {
    constexpr double kSlowest = 1.5;
    if (before == 0) return kSlowest * change;
    if (change == 0) return 0;
    const double ratio = before / change;
    return change * (ratio > 1 ? std::clamp(1 / (ratio - 1), 1.0, kSlowest) : kSlowest);
  }

  const LitScene& lit_;
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
